//! What the policies and landmarks promise, in numbers one can look at.

use lucerna_softfloat::{F24, F32, Flagged, Flags, Float, Format, FormatCode, Policy, Rounding};

const FLUSHED: Flags = Flags::from_bits(0x03);

fn f24(bits: u32) -> F24 {
    F24::from_bits(bits)
}

fn is<T: PartialEq + core::fmt::Debug>(ours: Flagged<T>, value: T, flags: Flags) {
    assert_eq!((ours.value, ours.flags), (value, flags));
}

#[test]
fn landmarks() {
    assert_eq!(F24::ONE.to_bits(), 0x3F_0000);
    assert_eq!(F24::MAX.to_bits(), 0x7E_FFFF);
    assert_eq!(F24::MIN_POSITIVE.to_bits(), 0x01_0000);
    assert_eq!(F24::MIN_SUBNORMAL.to_bits(), 0x00_0001);
    assert_eq!(F24::INFINITY.to_bits(), 0x7F_0000);
    assert_eq!(F24::NAN.to_bits(), 0x7F_8000);
    assert_eq!((F24::ONE / F24::from_i32(3)).to_bits(), 0x3D_5555);
    assert_eq!(F32::NAN.to_bits(), 0x7FC0_0000);
    assert_eq!(
        (F32::ONE.to_f32(), F32::MAX.to_f32(), F32::MIN_POSITIVE.to_f32()),
        (1.0, f32::MAX, f32::MIN_POSITIVE)
    );
}

#[test]
fn a_subnormal_operand_is_flushed_silently_and_keeps_its_sign() {
    let (least, one) = (f24(0x80_0001), F24::ONE);
    is(least.add_with(one, Policy::FLUSH), one, Flags::NONE);
    is(least.mul_with(one, Policy::FLUSH), f24(0x80_0000), Flags::NONE);
    is(least.sqrt_with(Policy::FLUSH), f24(0x80_0000), Flags::NONE);
    is(one.div_with(least, Policy::FLUSH), f24(0xFF_0000), Flags::DIVIDE_BY_ZERO);
    is(F24::INFINITY.mul_with(least, Policy::FLUSH), F24::NAN, Flags::INVALID);
    is(least.eq_with(F24::ZERO, Policy::FLUSH), true, Flags::NONE);
    is(least.lt_with(F24::ZERO, Policy::GRADUAL), true, Flags::NONE);
    is(least.to_i32_with(Rounding::NearestEven, Policy::FLUSH), 0, Flags::NONE);
    is(least.to_i32_with(Rounding::NearestEven, Policy::GRADUAL), 0, Flags::INEXACT);
}

#[test]
fn a_tiny_result_is_flushed_even_if_exact() {
    let (a, b) = (f24(0x01_8000), f24(0x01_0000));
    is(a.sub_with(b, Policy::GRADUAL), f24(0x00_8000), Flags::NONE);
    is(a.sub_with(b, Policy::FLUSH), F24::ZERO, FLUSHED);
    is(b.sub_with(a, Policy::FLUSH), f24(0x80_0000), FLUSHED);
}

#[test]
fn flushing_decides_after_rounding() {
    let least_normal = F24::MIN_POSITIVE;
    // (1 − 2^-17) · 2^-62 needs no rounding if exponents are unbounded, so it is tiny; as a subnormal it is a tie and
    // goes to the least normal number.
    let just_below_one = f24(0x3E_FFFF);
    is(just_below_one.mul_with(least_normal, Policy::GRADUAL), least_normal, FLUSHED);
    is(just_below_one.mul_with(least_normal, Policy::FLUSH), F24::ZERO, FLUSHED);
    // (1 − 2^-16) · (1 + 2^-16) · 2^-62 rounds up to the least normal number even so: not tiny, and not flushed.
    let (a, b) = (f24(0x3E_FFFE), f24(0x01_0001));
    is(a.mul_with(b, Policy::GRADUAL), least_normal, Flags::INEXACT);
    is(a.mul_with(b, Policy::FLUSH), least_normal, Flags::INEXACT);
}

#[test]
fn invalid_is_for_signalling_operands_and_operations_without_a_result() {
    let (signalling, quiet, one) = (f24(0x7F_0001), f24(0xFF_8123), F24::ONE);
    is(signalling.add_with(one, Policy::GRADUAL), F24::NAN, Flags::INVALID);
    is(quiet.add_with(one, Policy::GRADUAL), F24::NAN, Flags::NONE);
    is(F24::INFINITY.sub_with(F24::INFINITY, Policy::GRADUAL), F24::NAN, Flags::INVALID);
    is(F24::ZERO.div_with(F24::ZERO, Policy::GRADUAL), F24::NAN, Flags::INVALID);
    is(one.neg().sqrt_with(Policy::GRADUAL), F24::NAN, Flags::INVALID);
    is(quiet.lt_with(one, Policy::GRADUAL), false, Flags::INVALID);
    is(quiet.lt_quiet_with(one, Policy::GRADUAL), false, Flags::NONE);
    is(quiet.min_with(one, Policy::GRADUAL), one, Flags::NONE);
    is(quiet.to_u32_with(Rounding::TowardZero, Policy::GRADUAL), u32::MAX, Flags::INVALID);
}

#[test]
fn overflow_is_inexact_too() {
    is(F24::MAX.add_with(F24::MAX, Policy::GRADUAL), F24::INFINITY, Flags::OVERFLOW | Flags::INEXACT);
    is(F32::MAX.convert_with::<7, 16>(Policy::GRADUAL), F24::INFINITY, Flags::OVERFLOW | Flags::INEXACT);
    // Half a unit over the largest number, the tie goes to the even neighbour: infinity.
    let tie = F32::from_f32(F24::MAX.to_f32() + 2.0_f32.powi(63 - 17));
    is(tie.convert_with::<7, 16>(Policy::GRADUAL), F24::INFINITY, Flags::OVERFLOW | Flags::INEXACT);
    let below = F32::from_bits(tie.to_bits() - 1);
    is(below.convert_with::<7, 16>(Policy::GRADUAL), F24::MAX, Flags::INEXACT);
}

#[test]
fn everything_is_known_to_the_compiler() {
    const SUM: F24 = F24::from_f32(1.5).add(F24::from_u32(2)).mul(F24::from_i32(-2)).div(F24::from_f64(0.5));
    const ROOT: Flagged<F24> = SUM.neg().sqrt_with(Policy::FLUSH);
    assert_eq!((SUM.to_f32(), ROOT.value.to_f64(), ROOT.flags), (-14.0, 3.741668701171875, Flags::INEXACT));
}

#[test]
fn the_trait_is_the_methods() {
    fn hypotenuse<F: Format>(a: f32, b: f32) -> F {
        F::from_f32(a).square().add(F::from_f32(b).square()).sqrt()
    }
    assert_eq!(hypotenuse::<F32>(3.0, 4.0).to_f32(), 5.0);
    assert_eq!(hypotenuse::<F24>(3.0, 4.0).to_f32(), 5.0);
    assert_eq!((F24::NAME, F24::CODE as u32, F32::NAME, F32::CODE as u32), ("f24", 1, "f32", 0));
    assert_eq!(FormatCode::from_bits(1), Some(FormatCode::F24));
    assert_eq!(FormatCode::from_bits(3), None);
    assert_eq!(<F24 as Format>::from_bits(0xAB3F_0000), F24::ONE);
}

#[test]
fn numbers_and_flags_print_readably() {
    assert_eq!(format!("{:?}", F24::ONE), "3F0000 (1.0)");
    assert_eq!(format!("{}", Float::<4, 3>::from_f32(1.5)), "1.5");
    assert_eq!(format!("{:?}", Flags::INEXACT | Flags::OVERFLOW), "INEXACT | OVERFLOW");
    assert_eq!(format!("{:?}", Flags::NONE), "NONE");
}

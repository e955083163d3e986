//! Conversions: ten million random operands each, against the host's casts or the clear version.

mod common;

use common::exact::{self, Exact, INEXACT, INVALID};
use common::operands::Random;
use common::outcome;
use lucerna_softfloat::{F24, F32, Flagged, Policy, Rounding};

const COUNT: usize = 10_000_000;
const POLICIES: [Policy; 2] = [Policy::GRADUAL, Policy::FLUSH];

#[test]
fn f32_to_f24_is_the_clear_versions() {
    let mut random = Random::new(80);
    for _ in 0..COUNT / 2 {
        let (a, b): (F32, F32) = random.pair();
        // Random exponents mostly leave F24's range: half of the operands are brought into it.
        let near = F32::from_bits(b.to_bits() & 0x807F_FFFF | (127 - 85 + random.below(155)) << 23);
        for a in [a, near] {
            for policy in POLICIES {
                let read = exact::read(a, policy);
                let expected = if !a.is_finite() {
                    let bits = if a.is_nan() { 0x7F_8000 } else { 0x7F_0000 | a.to_bits() >> 31 << 23 };
                    (bits, if a.is_signalling() { INVALID } else { 0 })
                } else {
                    Exact::of(read).round::<7, 16>(policy)
                };
                assert_eq!(outcome(a.convert_with::<7, 16>(policy)), expected, "{a:?}, {policy:?}");
            }
        }
    }
}

#[test]
fn f64_to_f32_is_the_hosts_cast() {
    let mut random = Random::new(81);
    for _ in 0..COUNT {
        let bits = random.bits();
        let near = bits & !(0x7FF << 52) | (1023 - 155 + u64::from(random.below(290))) << 52;
        for bits in [bits, near] {
            let x = f64::from_bits(bits);
            let expected = if x.is_nan() { F32::NAN.to_bits() } else { (x as f32).to_bits() };
            assert_eq!(F32::from_f64(x).to_bits(), expected, "{x:e}");
        }
    }
}

#[test]
fn f64_to_f24_is_the_clear_versions() {
    let mut random = Random::new(82);
    for _ in 0..COUNT / 2 {
        let near = random.bits() & !(0x7FF << 52) | (1023 - 85 + u64::from(random.below(155))) << 52;
        for x in [f64::from_bits(near), f64::from_bits(near & !0xFFF_FFFF_FFFF), f64::from_bits(near & 0x1FF)]
        {
            for policy in POLICIES {
                let expected = match x.is_subnormal() && policy == Policy::FLUSH {
                    true => (u32::from(x.is_sign_negative()) << 23, 0),
                    false => Exact::of_f64(x).round::<7, 16>(policy),
                };
                assert_eq!(outcome(F24::from_f64_with(x, policy)), expected, "{x:e}, {policy:?}");
            }
        }
    }
}

fn integer<T>(ours: Flagged<T>) -> (T, u8) {
    (ours.value, ours.flags.bits())
}

#[test]
fn to_integers_is_the_hosts_rounding_and_cast() {
    let mut random = Random::new(83);
    for _ in 0..COUNT {
        let (any, b): (F32, F32) = random.pair();
        // Most numbers are far from any integer: half of the operands get an exponent of −4 to 35.
        let near = F32::from_bits(b.to_bits() & 0x807F_FFFF | (123 + random.below(40)) << 23);
        for a in [any, near] {
            let x = exact::to_f64(a);
            for rounding in [Rounding::NearestEven, Rounding::TowardZero] {
                let whole = match rounding {
                    Rounding::NearestEven => x.round_ties_even(),
                    Rounding::TowardZero => x.trunc(),
                };
                let flags = |least: f64, most: f64| match whole {
                    _ if !(whole >= least && whole <= most) => INVALID,
                    _ if whole != x => INEXACT,
                    _ => 0,
                };
                let signed = if x.is_nan() { i32::MAX } else { whole as i32 };
                let unsigned = if x.is_nan() { u32::MAX } else { whole as u32 };
                let signed = (signed, flags(f64::from(i32::MIN), f64::from(i32::MAX)));
                let unsigned = (unsigned, flags(0.0, f64::from(u32::MAX)));
                assert_eq!(integer(a.to_i32_with(rounding, Policy::GRADUAL)), signed, "{a:?}");
                assert_eq!(integer(a.to_u32_with(rounding, Policy::GRADUAL)), unsigned, "{a:?}");
            }
        }
    }
}

#[test]
fn from_integers_is_the_hosts_cast() {
    let mut random = Random::new(84);
    for _ in 0..COUNT {
        let x = (random.bits() >> 32) as u32 >> random.below(32);
        for x in [x, x.wrapping_neg()] {
            assert_eq!(F32::from_u32(x).to_bits(), (x as f32).to_bits());
            assert_eq!(F32::from_i32(x as i32).to_bits(), (x as i32 as f32).to_bits());
            let expected = Exact::of_f64(f64::from(x)).round::<7, 16>(Policy::GRADUAL);
            assert_eq!(outcome(F24::from_u32_with(x, Policy::GRADUAL)), expected, "{x}");
            let expected = Exact::of_f64(f64::from(x as i32)).round::<7, 16>(Policy::GRADUAL);
            assert_eq!(outcome(F24::from_i32_with(x as i32, Policy::GRADUAL)), expected, "{x}");
        }
    }
}

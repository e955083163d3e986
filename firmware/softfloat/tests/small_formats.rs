//! The same generic source in two 8-bit formats, over all pairs of operands, against f64 rounded once. f64 holds every
//! sum and product of these exactly, and a quotient or root that it must round is inexact in them too: so it tells the
//! flags as well.

mod common;

use common::exact::{self, DIVIDE_BY_ZERO, Exact, INEXACT, INVALID};
use common::{Outcome, outcome};
use lucerna_softfloat::{F24, F32, Float, Policy, Rounding, Subnormals};

const POLICIES: [Policy; 2] = [Policy::GRADUAL, Policy::FLUSH];

fn all<const EXP: u32, const FRAC: u32>() -> impl Iterator<Item = Float<EXP, FRAC>> {
    (0..1 << (1 + EXP + FRAC)).map(Float::from_bits)
}

fn pairs<const EXP: u32, const FRAC: u32>() -> impl Iterator<Item = (Float<EXP, FRAC>, Float<EXP, FRAC>)> {
    all().flat_map(|a| all().map(move |b| (a, b)))
}

/// A value rounded to the format, with the flags of rounding; `invalid` is known by the caller.
fn rounded<const EXP: u32, const FRAC: u32>(value: f64, invalid: bool, policy: Policy) -> Outcome {
    let sign = u32::from(value.is_sign_negative()) << (EXP + FRAC);
    let infinity = ((1 << EXP) - 1) << FRAC;
    let invalid = if invalid { INVALID } else { 0 };
    if value.is_nan() {
        (infinity | 1 << (FRAC - 1), invalid)
    } else if value.is_infinite() {
        (sign | infinity, invalid)
    } else {
        Exact::of_f64(value).round::<EXP, FRAC>(policy)
    }
}

fn binary<const EXP: u32, const FRAC: u32>(
    ours: impl Fn(Float<EXP, FRAC>, Float<EXP, FRAC>, Policy) -> Outcome,
    host: impl Fn(f64, f64) -> f64,
    divides: bool,
) {
    for policy in POLICIES {
        for (a, b) in pairs() {
            let (x, y) = (exact::to_f64(exact::read(a, policy)), exact::to_f64(exact::read(b, policy)));
            let value = host(x, y);
            let invalid =
                a.is_signalling() || b.is_signalling() || value.is_nan() && !x.is_nan() && !y.is_nan();
            let (bits, mut flags) = rounded::<EXP, FRAC>(value, invalid, policy);
            if divides && y == 0.0 && x.is_finite() && x != 0.0 {
                flags |= DIVIDE_BY_ZERO;
            }
            assert_eq!(ours(a, b, policy), (bits, flags), "{a:?}, {b:?}, {policy:?}");
        }
    }
}

fn arithmetic<const EXP: u32, const FRAC: u32>() {
    binary::<EXP, FRAC>(|a, b, p| outcome(a.add_with(b, p)), |x, y| x + y, false);
    binary::<EXP, FRAC>(|a, b, p| outcome(a.sub_with(b, p)), |x, y| x - y, false);
    binary::<EXP, FRAC>(|a, b, p| outcome(a.mul_with(b, p)), |x, y| x * y, false);
    binary::<EXP, FRAC>(|a, b, p| outcome(a.div_with(b, p)), |x, y| x / y, true);
    for (a, b) in pairs::<EXP, FRAC>() {
        assert_eq!(a.add(b), a.add_with(b, Policy::GRADUAL).value);
        assert_eq!(a.sub(b), a.sub_with(b, Policy::GRADUAL).value);
        assert_eq!(a.mul(b), a.mul_with(b, Policy::GRADUAL).value);
        assert_eq!(a.div(b), a.div_with(b, Policy::GRADUAL).value);
    }
}

fn roots_and_squares<const EXP: u32, const FRAC: u32>() {
    for policy in POLICIES {
        for a in all::<EXP, FRAC>() {
            let x = exact::to_f64(exact::read(a, policy));
            let invalid = a.is_signalling() || x < 0.0;
            let expected = rounded::<EXP, FRAC>(x.sqrt(), invalid, policy);
            assert_eq!(outcome(a.sqrt_with(policy)), expected, "{a:?}, {policy:?}");
            let expected = rounded::<EXP, FRAC>(x * x, a.is_signalling(), policy);
            assert_eq!(outcome(a.square_with(policy)), expected, "{a:?}, {policy:?}");
        }
    }
}

fn order<const EXP: u32, const FRAC: u32>() {
    for policy in POLICIES {
        for (a, b) in pairs::<EXP, FRAC>() {
            let (read_a, read_b) = (exact::read(a, policy), exact::read(b, policy));
            let (x, y) = (exact::to_f64(read_a), exact::to_f64(read_b));
            let any = if a.is_nan() || b.is_nan() { INVALID } else { 0 };
            let signalling = if a.is_signalling() || b.is_signalling() { INVALID } else { 0 };
            let truth = |x: lucerna_softfloat::Flagged<bool>| (x.value, x.flags.bits());
            assert_eq!(truth(a.lt_with(b, policy)), (x < y, any));
            assert_eq!(truth(a.le_with(b, policy)), (x <= y, any));
            assert_eq!(truth(a.eq_with(b, policy)), (x == y, signalling));
            assert_eq!(truth(a.lt_quiet_with(b, policy)), (x < y, signalling));
            assert_eq!(truth(a.le_quiet_with(b, policy)), (x <= y, signalling));
            assert_eq!(truth(a.eq_signalling_with(b, policy)), (x == y, any));

            let a_is_less = x < y || x == y && a.is_sign_negative();
            let (min, max) = match (a.is_nan(), b.is_nan()) {
                (true, true) => (Float::NAN, Float::NAN),
                (true, false) => (read_b, read_b),
                (false, true) => (read_a, read_a),
                (false, false) if a_is_less => (read_a, read_b),
                (false, false) => (read_b, read_a),
            };
            assert_eq!(outcome(a.min_with(b, policy)), (min.to_bits(), signalling), "{a:?}, {b:?}");
            assert_eq!(outcome(a.max_with(b, policy)), (max.to_bits(), signalling), "{a:?}, {b:?}");
        }
    }
}

/// To another format, by value.
fn conversions<const EXP: u32, const FRAC: u32, const EXP2: u32, const FRAC2: u32>() {
    for policy in POLICIES {
        for a in all::<EXP, FRAC>() {
            let x = exact::to_f64(exact::read(a, policy));
            let expected = rounded::<EXP2, FRAC2>(x, a.is_signalling(), policy);
            assert_eq!(outcome(a.convert_with::<EXP2, FRAC2>(policy)), expected, "{a:?}, {policy:?}");
        }
    }
}

fn integers<const EXP: u32, const FRAC: u32>() {
    for policy in POLICIES {
        for a in all::<EXP, FRAC>() {
            let x = exact::to_f64(exact::read(a, policy));
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
                // The host's casts saturate too, but make a NaN 0.
                let (i32_expected, u32_expected) =
                    if x.is_nan() { (i32::MAX, u32::MAX) } else { (whole as i32, whole as u32) };
                let ours = a.to_i32_with(rounding, policy);
                let expected = (i32_expected, flags(f64::from(i32::MIN), f64::from(i32::MAX)));
                assert_eq!((ours.value, ours.flags.bits()), expected, "{a:?}");
                let ours = a.to_u32_with(rounding, policy);
                let expected = (u32_expected, flags(0.0, f64::from(u32::MAX)));
                assert_eq!((ours.value, ours.flags.bits()), expected, "{a:?}");
            }
        }
        for x in -70_000..70_000 {
            let expected = rounded::<EXP, FRAC>(f64::from(x), false, policy);
            assert_eq!(outcome(Float::<EXP, FRAC>::from_i32_with(x, policy)), expected, "{x}");
            let x = x as u32;
            let expected = rounded::<EXP, FRAC>(f64::from(x), false, policy);
            assert_eq!(outcome(Float::<EXP, FRAC>::from_u32_with(x, policy)), expected, "{x}");
        }
    }
}

fn host<const EXP: u32, const FRAC: u32>() {
    for a in all::<EXP, FRAC>() {
        let x = exact::to_f64(a);
        assert!(a.to_f64().to_bits() == x.to_bits() && a.to_f32().to_bits() == (x as f32).to_bits(), "{a:?}");
        let back = if a.is_nan() { Float::NAN } else { a };
        assert_eq!((Float::from_f64(x), Float::from_f32(x as f32)), (back, back));
    }
}

macro_rules! format {
    ($name:ident, $exp:literal, $frac:literal) => {
        mod $name {
            use super::*;

            #[test]
            fn arithmetic_with_flags() {
                arithmetic::<$exp, $frac>();
            }

            #[test]
            fn square_roots_and_squares() {
                roots_and_squares::<$exp, $frac>();
            }

            #[test]
            fn comparisons_minimum_and_maximum() {
                order::<$exp, $frac>();
            }

            #[test]
            fn conversions_between_formats() {
                conversions::<$exp, $frac, 4, 3>();
                conversions::<$exp, $frac, 5, 2>();
                conversions::<$exp, $frac, 7, 16>();
                conversions::<$exp, $frac, 8, 23>();
            }

            #[test]
            fn conversions_to_and_from_integers() {
                integers::<$exp, $frac>();
            }

            #[test]
            fn conversions_to_and_from_the_hosts_formats() {
                host::<$exp, $frac>();
            }
        }
    };
}

format!(format_1_4_3, 4, 3);
format!(format_1_5_2, 5, 2);
// The least format there is: nearly every operand is special.
format!(format_1_2_2, 2, 2);
// Few exponents and a long fraction: even a root can be subnormal.
format!(format_1_3_7, 3, 7);

#[test]
fn the_usual_formats_are_instances() {
    assert_eq!((F24::WIDTH, F24::BIAS, F32::WIDTH, F32::BIAS), (24, 63, 32, 127));
    assert_eq!(Policy::default().subnormals, Subnormals::Gradual);
}

//! Ten million operand pairs an operation, against the host's own f32 (for F32), the host's f64 rounded once (for F24,
//! exact since 53 ≥ 2·17 + 2), and for the flags against the clear version.

mod common;

use common::exact::{self, Exact, Operation};
use common::operands::Random;
use common::{Outcome, outcome};
use lucerna_softfloat::{F24, F32, Float, Policy};

const PAIRS: usize = 10_000_000;
/// Of which so many go through the slower clear version too, with flags, under each policy.
const FLAGGED: usize = 2_500_000;

fn canonical(x: f32) -> u32 {
    if x.is_nan() { F32::NAN.to_bits() } else { x.to_bits() }
}

/// Quieted, since the host's `min` and `max` may treat a signalling NaN either way.
fn as_host(x: F32) -> f32 {
    if x.is_nan() { f32::NAN } else { f32::from_bits(x.to_bits()) }
}

fn f32_pairs(seed: u64, ours: fn(F32, F32) -> F32, host: fn(f32, f32) -> f32) {
    let mut random = Random::new(seed);
    for _ in 0..PAIRS {
        let (a, b) = random.pair();
        let expected = canonical(host(as_host(a), as_host(b)));
        assert_eq!(ours(a, b).to_bits(), expected, "{a:?}, {b:?}");
    }
}

fn f24_pairs(seed: u64, ours: fn(F24, F24) -> F24, host: fn(f64, f64) -> f64) {
    let mut random = Random::new(seed);
    for _ in 0..PAIRS {
        let (a, b) = random.pair();
        let value = host(exact::to_f64(a), exact::to_f64(b));
        assert_eq!(ours(a, b).to_bits(), rounded_once(value), "{a:?}, {b:?}");
    }
}

/// An f64 rounded to F24.
fn rounded_once(value: f64) -> u32 {
    let sign = u32::from(value.is_sign_negative()) << 23;
    if value.is_nan() {
        0x7F_8000
    } else if value.is_infinite() {
        sign | 0x7F_0000
    } else {
        Exact::of_f64(value).round::<7, 16>(Policy::GRADUAL).0
    }
}

fn flagged<const EXP: u32, const FRAC: u32>(
    seed: u64,
    ours: fn(Float<EXP, FRAC>, Float<EXP, FRAC>, Policy) -> Outcome,
    clear: fn(Float<EXP, FRAC>, Float<EXP, FRAC>, Policy) -> Outcome,
) {
    let mut random = Random::new(seed);
    for policy in [Policy::GRADUAL, Policy::FLUSH] {
        for _ in 0..FLAGGED {
            let (a, b) = random.pair();
            assert_eq!(ours(a, b, policy), clear(a, b, policy), "{a:?}, {b:?}, {policy:?}");
        }
    }
}

macro_rules! operation {
    ($name:ident, $operation:ident, $seed:literal, $with:ident, $host:tt) => {
        mod $name {
            use super::*;

            #[test]
            fn f32_is_the_hosts() {
                f32_pairs($seed, F32::$name, |a, b| a $host b);
            }

            #[test]
            fn f24_is_f64_rounded_once() {
                f24_pairs($seed + 1, F24::$name, |a, b| a $host b);
            }

            #[test]
            fn flags_are_those_of_the_clear_version() {
                let clear = |a, b, policy| exact::binary(Operation::$operation, a, b, policy);
                flagged::<8, 23>($seed + 2, |a, b, policy| outcome(a.$with(b, policy)), clear);
                let clear = |a, b, policy| exact::binary(Operation::$operation, a, b, policy);
                flagged::<7, 16>($seed + 3, |a, b, policy| outcome(a.$with(b, policy)), clear);
            }
        }
    };
}

operation!(add, Add, 10, add_with, +);
operation!(sub, Sub, 20, sub_with, -);
operation!(mul, Mul, 30, mul_with, *);
operation!(div, Div, 40, div_with, /);

#[test]
fn sqrt_and_square_of_f32_are_the_hosts() {
    f32_pairs(50, |a, _| a.sqrt(), |a, _| a.sqrt());
    f32_pairs(51, |a, _| a.square(), |a, _| a * a);
}

#[test]
fn sqrt_and_square_flags_are_those_of_the_clear_version() {
    flagged::<8, 23>(52, |a, _, p| outcome(a.sqrt_with(p)), |a, _, p| exact::sqrt(a, p));
    flagged::<7, 16>(53, |a, _, p| outcome(a.sqrt_with(p)), |a, _, p| exact::sqrt(a, p));
    let clear = |a, _, p| exact::binary(Operation::Mul, a, a, p);
    flagged::<8, 23>(54, |a, _, p| outcome(a.square_with(p)), clear);
    let clear = |a, _, p| exact::binary(Operation::Mul, a, a, p);
    flagged::<7, 16>(55, |a, _, p| outcome(a.square_with(p)), clear);
}

#[test]
fn comparisons_are_the_hosts() {
    let mut random = Random::new(60);
    for _ in 0..PAIRS {
        let (a, b): (F32, F32) = random.pair();
        let (x, y) = (as_host(a), as_host(b));
        assert_eq!((a.lt(b), a.le(b), a.eq(b)), (x < y, x <= y, x == y), "{a:?}, {b:?}");
        let (a, b): (F24, F24) = random.pair();
        let (x, y) = (exact::to_f64(a), exact::to_f64(b));
        assert_eq!((a.lt(b), a.le(b), a.eq(b)), (x < y, x <= y, x == y), "{a:?}, {b:?}");
    }
}

#[test]
fn min_and_max_are_the_hosts_but_for_zeros_which_are_ordered() {
    f32_pairs(70, F32::min, |a, b| {
        if a == b && a.is_sign_negative() {
            a
        } else if a == b {
            b
        } else {
            a.min(b)
        }
    });
    f32_pairs(71, F32::max, |a, b| {
        if a == b && a.is_sign_negative() {
            b
        } else if a == b {
            a
        } else {
            a.max(b)
        }
    });
}

/// Formats at the ends of what `EXP` and `FRAC` may be, and two usual ones.
#[test]
fn any_size_of_format_is_the_clear_version() {
    fn format<const EXP: u32, const FRAC: u32>() {
        let mut random = Random::new(u64::from(EXP * 32 + FRAC));
        for round in 0..400_000 {
            let policy = if round % 2 == 0 { Policy::GRADUAL } else { Policy::FLUSH };
            let (a, b): (Float<EXP, FRAC>, Float<EXP, FRAC>) = random.pair();
            for (operation, ours) in [
                (Operation::Add, a.add_with(b, policy)),
                (Operation::Sub, a.sub_with(b, policy)),
                (Operation::Mul, a.mul_with(b, policy)),
                (Operation::Div, a.div_with(b, policy)),
            ] {
                assert_eq!(
                    outcome(ours),
                    exact::binary(operation, a, b, policy),
                    "{operation:?} {a:?}, {b:?}"
                );
            }
            assert_eq!(outcome(a.sqrt_with(policy)), exact::sqrt(a, policy), "sqrt {a:?}");
        }
    }
    format::<2, 23>();
    format::<2, 2>();
    format::<8, 2>();
    format::<8, 7>();
    format::<5, 10>();
    format::<3, 22>();
}

//! Laws that hold for every operand.

use lucerna_softfloat::{F24, F32, Flags, Policy};
use proptest::prelude::*;

fn any_f24() -> impl Strategy<Value = F24> {
    any::<u32>().prop_map(F24::from_bits)
}

fn any_policy() -> impl Strategy<Value = Policy> {
    prop_oneof![Just(Policy::GRADUAL), Just(Policy::FLUSH)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn sums_and_products_commute(a in any_f24(), b in any_f24(), policy in any_policy()) {
        prop_assert_eq!(a.add_with(b, policy), b.add_with(a, policy));
        prop_assert_eq!(a.mul_with(b, policy), b.mul_with(a, policy));
    }

    #[test]
    fn plain_methods_are_the_gradual_values(a in any::<u32>(), b in any::<u32>()) {
        let (a, b) = (F32::from_bits(a), F32::from_bits(b));
        prop_assert_eq!(a.add(b), a.add_with(b, Policy::GRADUAL).value);
        prop_assert_eq!(a.sub(b), a.sub_with(b, Policy::GRADUAL).value);
        prop_assert_eq!(a.mul(b), a.mul_with(b, Policy::GRADUAL).value);
        prop_assert_eq!(a.div(b), a.div_with(b, Policy::GRADUAL).value);
        prop_assert_eq!(a.sqrt(), a.sqrt_with(Policy::GRADUAL).value);
        prop_assert_eq!((a + b, a - b, a * b, a / b), (a.add(b), a.sub(b), a.mul(b), a.div(b)));
    }

    #[test]
    fn rounding_keeps_order(x in any::<f32>(), y in any::<f32>()) {
        let (x, y) = if x <= y { (x, y) } else { (y, x) };
        prop_assert!(F24::from_f32(x).le(F24::from_f32(y)));
    }

    #[test]
    fn flushed_results_are_never_subnormal(a in any_f24(), b in any_f24()) {
        for result in [
            a.add_with(b, Policy::FLUSH),
            a.sub_with(b, Policy::FLUSH),
            a.mul_with(b, Policy::FLUSH),
            a.div_with(b, Policy::FLUSH),
            a.sqrt_with(Policy::FLUSH),
            a.min_with(b, Policy::FLUSH),
        ] {
            prop_assert!(!result.value.is_subnormal());
        }
    }

    #[test]
    fn underflow_and_overflow_are_inexact(a in any_f24(), b in any_f24(), policy in any_policy()) {
        for result in [a.add_with(b, policy), a.mul_with(b, policy), a.div_with(b, policy)] {
            let flags = result.flags;
            let ends = flags.contains(Flags::UNDERFLOW) || flags.contains(Flags::OVERFLOW);
            prop_assert!(!ends || flags.contains(Flags::INEXACT));
        }
    }

    #[test]
    fn integers_that_fit_come_back(x in -131_072..=131_072_i32) {
        prop_assert_eq!(F24::from_i32(x).to_i32(lucerna_softfloat::Rounding::TowardZero), x);
    }

    #[test]
    fn bits_above_the_width_are_ignored(bits in any::<u32>()) {
        prop_assert_eq!(F24::from_bits(bits), F24::from_bits(bits & 0xFF_FFFF));
    }
}

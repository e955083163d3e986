//! Every F24 there is: roots and squares by digest, conversions there and back.

mod common;

use common::exact;
use lucerna_softfloat::{F24, F32};

/// FNV-1a-64 of results as little-endian words, over all inputs in ascending order.
fn digest(operation: fn(F24) -> F24) -> u64 {
    let mut digest = 0xCBF2_9CE4_8422_2325_u64;
    for bits in 0..1 << 24 {
        for byte in operation(F24::from_bits(bits)).to_bits().to_le_bytes() {
            digest = (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3);
        }
    }
    digest
}

#[test]
fn square_roots_have_the_known_digest() {
    assert_eq!(digest(F24::sqrt), 0x4D3F_C7E7_A2DD_3CC8);
}

#[test]
fn squares_have_the_known_digest() {
    assert_eq!(digest(F24::square), 0x21AC_3620_D4BC_5F45);
}

#[test]
fn a_square_is_the_product_with_itself() {
    for a in (0..1 << 24).map(F24::from_bits) {
        assert_eq!(a.square(), a.mul(a));
    }
}

#[test]
fn every_number_comes_back_from_wider_formats() {
    for a in (0..1 << 24).map(F24::from_bits) {
        let back = if a.is_nan() { F24::NAN } else { a };
        assert_eq!(a.convert::<8, 23>().convert::<7, 16>(), back);
        assert_eq!(F24::from_f32(a.to_f32()), back);
        assert_eq!(F24::from_f64(a.to_f64()), back);
        assert_eq!(a.to_f64().to_bits(), exact::to_f64(a).to_bits());
        assert_eq!(f64::from(a.to_f32()).to_bits(), a.to_f64().to_bits());
        assert_eq!(F32::from_f32(a.to_f32()), a.convert());
    }
}

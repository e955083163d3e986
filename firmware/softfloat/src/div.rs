//! Quotient: two numbers in, one out, correctly rounded.

use crate::float::Parts;
use crate::{Flagged, Flags, Float, Policy};

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// `self / other`.
    #[inline]
    #[must_use]
    pub const fn div(self, other: Self) -> Self {
        self.quotient::<false>(other, Policy::GRADUAL).value
    }

    /// `self / other` with flags.
    #[inline]
    pub const fn div_with(self, other: Self, policy: Policy) -> Flagged<Self> {
        self.quotient::<true>(other, policy)
    }

    #[inline(always)]
    const fn quotient<const FLAGS: bool>(self, other: Self, policy: Policy) -> Flagged<Self> {
        if self.is_rare() || other.is_rare() {
            return self.quotient_rare::<FLAGS>(other, policy);
        }
        Self::quotient_of::<FLAGS>(self.parts(), other.parts(), policy)
    }

    #[inline(always)]
    const fn quotient_of<const FLAGS: bool>(a: Parts, b: Parts, policy: Policy) -> Flagged<Self> {
        let below = (a.significand < b.significand) as u32;
        let (quotient, inexact) = ratio(a.significand << (23 - FRAC), b.significand << (23 - FRAC), below);
        let exponent = a.exponent - b.exponent + Self::BIAS - below as i32;
        Self::round_never_halfway::<FLAGS>(a.sign ^ b.sign, exponent, quotient, inexact, policy)
    }

    /// The quotient where an operand is zero, subnormal, infinite or NaN.
    #[cold]
    #[inline(never)]
    const fn quotient_rare<const FLAGS: bool>(self, other: Self, policy: Policy) -> Flagged<Self> {
        let (a, b) = (self.read(policy), other.read(policy));
        if a.is_nan() || b.is_nan() {
            return a.nan_of(b);
        }
        let sign = a.sign() ^ b.sign();
        if a.is_infinite() && b.is_infinite() || a.is_zero() && b.is_zero() {
            return Flagged::new(Self::NAN, Flags::INVALID);
        }
        if a.is_infinite() {
            return Flagged::exact(Self::from_bits(sign | Self::INFINITE));
        }
        if a.is_zero() || b.is_infinite() {
            return Flagged::exact(Self::from_bits(sign));
        }
        if b.is_zero() {
            return Flagged::new(Self::from_bits(sign | Self::INFINITE), Flags::DIVIDE_BY_ZERO);
        }
        Self::quotient_of::<FLAGS>(a.normalised(), b.normalised(), policy)
    }
}

/// ⌊2^(24 + below) · a / b⌋, and whether something was left; `a` and `b` are in 2^23..2^24, and the quotient in
/// 2^24..2^25: one bit more than the longest fraction, for rounding.
///
/// The reciprocal of `b` from a table is short of it by a part e < 1.25 · 2^-13. One Newton step, q·(1 + e), is short by
/// e² of the quotient: below one unit of its last place and never too much, which the exact remainder mends.
#[inline(always)]
const fn ratio(a: u32, b: u32, below: u32) -> (u32, bool) {
    let a = a << below;
    let reciprocal = reciprocal(b) as u64;
    let error = (1 << 39) - b as u64 * reciprocal; // e · 2^39
    let first = a as u64 * reciprocal; // a / b · 2^39
    // Below 2^40 · 1.25 · 2^23: the product fits.
    let quotient = (first + ((first * (error >> 3)) >> 36)) >> 15;
    let rest = ((a as u64) << 24) - quotient * b as u64;
    let short = rest >= b as u64;
    ((quotient + short as u64) as u32, rest != if short { b as u64 } else { 0 })
}

/// 2^39 / b for b in 2^23..2^24, never too large, short by less than 1.25 · 2^-13 of it: a chord in each of 64 intervals.
#[inline(always)]
const fn reciprocal(b: u32) -> u32 {
    let (start, slope) = RECIPROCAL[(b >> 17 & 63) as usize];
    start as u32 - ((slope as u32 * (b & 0x1_FFFF)) >> 17)
}

/// The chords' values at the intervals' starts, lowered to lie under the curve, and their falls.
static RECIPROCAL: [(u16, u16); 64] = {
    let mut table = [(0, 0); 64];
    let mut i = 0_u64;
    while i < 64 {
        // Scaled by a further 2^16.
        let (start, middle, end) = ((1 << 38) / (64 + i), (1 << 39) / (129 + 2 * i), (1 << 38) / (65 + i));
        let sag = (start + end) / 2 - middle;
        let fall = (start - end).div_ceil(1 << 16);
        table[i as usize] = (((start - sag) >> 16) as u16 - 2, fall as u16);
        i += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    /// The bound on which the single mending step rests, for every divisor there is.
    #[test]
    fn the_reciprocal_is_never_too_large_and_short_by_little() {
        for b in 1_u64 << 23..1 << 24 {
            let product = b * u64::from(reciprocal(b as u32));
            let error = (1_u64 << 39).checked_sub(product).expect("too large");
            assert!(error < 5 << (39 - 15), "{b:X}: {error:X}");
        }
    }

    #[test]
    fn the_ratio_is_the_integer_quotient() {
        let mut state = 1_u64;
        for _ in 0..4_000_000 {
            state = state.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
            // One time in four the divisor is near its least or most.
            let (a, mut b) = (state as u32 >> 9 | 1 << 23, (state >> 40) as u32 | 1 << 23);
            match state >> 30 & 7 {
                0 => b &= 0x80_00FF,
                1 => b |= 0xFF_FF00,
                _ => (),
            }
            let below = (a < b) as u32;
            let (dividend, divisor) = (u64::from(a) << (24 + below), u64::from(b));
            let expected = ((dividend / divisor) as u32, dividend % divisor != 0);
            assert_eq!(ratio(a, b, below), expected, "{a:X} / {b:X}");
        }
    }
}

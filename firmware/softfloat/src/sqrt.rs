//! Square root: a number in, one out, correctly rounded.

use crate::float::Parts;
use crate::{Flagged, Flags, Float, Policy};

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// The square root.
    #[inline]
    #[must_use]
    pub const fn sqrt(self) -> Self {
        self.root::<false>(Policy::GRADUAL).value
    }

    /// The square root with flags.
    #[inline]
    pub const fn sqrt_with(self, policy: Policy) -> Flagged<Self> {
        self.root::<true>(policy)
    }

    #[inline(always)]
    const fn root<const FLAGS: bool>(self, policy: Policy) -> Flagged<Self> {
        if self.is_rare() || self.is_sign_negative() {
            return self.root_rare::<FLAGS>(policy);
        }
        Self::root_of::<FLAGS>(self.parts(), policy)
    }

    #[inline(always)]
    const fn root_of<const FLAGS: bool>(a: Parts, policy: Policy) -> Flagged<Self> {
        let unbiased = a.exponent - Self::BIAS;
        let odd = (unbiased & 1) as u32;
        let (root, inexact) = root_of_fixed(a.significand << (30 - FRAC + odd));
        Self::round_never_halfway::<FLAGS>(0, (unbiased >> 1) + Self::BIAS, root, inexact, policy)
    }

    /// The root of a zero, subnormal, infinity, NaN or negative number.
    #[cold]
    #[inline(never)]
    const fn root_rare<const FLAGS: bool>(self, policy: Policy) -> Flagged<Self> {
        let a = self.read(policy);
        if a.is_nan() {
            return a.nan_of(a);
        }
        if a.is_zero() {
            return Flagged::exact(a);
        }
        if a.is_sign_negative() {
            return Flagged::new(Self::NAN, Flags::INVALID);
        }
        if a.is_infinite() {
            return Flagged::exact(a);
        }
        Self::root_of::<FLAGS>(a.normalised(), policy)
    }
}

/// ⌊√(s · 2^18)⌋, and whether something was left, for s in 2^30..2^32: a root in 2^24..2^25, one bit more than the
/// longest fraction, for rounding.
///
/// With r the reciprocal root from a table, s·r is short of the root by the factor √(1 − e), where e = 1 − s·r² is below
/// 2^-12; one Newton step, (1 + e/2), leaves ⅜e² of it, less than one unit of the last place and never too much, which
/// the exact remainder mends.
#[inline(always)]
const fn root_of_fixed(s: u32) -> (u32, bool) {
    let reciprocal = reciprocal_root(s) as u64; // 2^31 / √s, about
    let product = s as u64 * reciprocal; // 2^31 · √s, about
    let error = (1 << 62) - product * reciprocal; // e · 2^62
    let first = product >> 15;
    let second = first + ((first * (error >> 32)) >> 31);
    let root = second >> 7;
    let rest = ((s as u64) << 18) - root * root;
    let step = 2 * root + 1;
    let short = rest >= step;
    ((root + short as u64) as u32, rest != if short { step } else { 0 })
}

/// 2^31 / √s for s in 2^30..2^32, never too large, and short by less than 2^-13 of it: a chord in each of 96 intervals.
#[inline(always)]
const fn reciprocal_root(s: u32) -> u32 {
    let (start, slope) = RECIPROCAL_ROOT[(s >> 25) as usize];
    start as u32 - ((slope as u32 * (s >> 9 & 0xFFFF)) >> 16)
}

/// The chords' values at the intervals' starts, lowered to lie under the curve, and their falls. The first 32 entries
/// are never read; with them no index can be out of bounds.
static RECIPROCAL_ROOT: [(u16, u16); 128] = {
    /// 2^32 / √(i / 64): the curve, scaled by a further 2^16.
    const fn curve(i: u64) -> u64 {
        ((1 << 70) / i as u128).isqrt() as u64
    }
    let mut table = [(0, 0); 128];
    let mut i = 32;
    while i < 128 {
        let (start, middle, end) = (curve(2 * i), curve(2 * i + 1), curve(2 * i + 2));
        let sag = (start + end) / 2 - middle;
        let fall = (start - end).div_ceil(1 << 16);
        table[i as usize] = (((start - sag) >> 16) as u16 - 1, fall as u16);
        i += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Every significand an `F32` can have, at both parities of the exponent.
    fn every_square() -> impl Iterator<Item = u32> {
        (1 << 23..1 << 24).flat_map(|significand| [significand << 7, significand << 8])
    }

    /// The bound on which the single mending step rests.
    #[test]
    fn the_reciprocal_root_is_never_too_large_and_short_by_little() {
        for s in every_square() {
            let reciprocal = u64::from(reciprocal_root(s));
            let product = u64::from(s) * reciprocal * reciprocal;
            let error = (1_u64 << 62).checked_sub(product).expect("too large");
            assert!(error < 1 << (62 - 12), "{s:X}: {error:X}");
        }
    }

    #[test]
    fn the_root_is_the_integer_root_for_every_significand() {
        for s in every_square() {
            let (root, inexact) = root_of_fixed(s);
            let (root, square) = (u64::from(root), u64::from(s) << 18);
            assert!(root * root <= square && square < (root + 1) * (root + 1), "{s:X}: {root:X}");
            assert_eq!(inexact, root * root != square, "{s:X}");
        }
    }
}

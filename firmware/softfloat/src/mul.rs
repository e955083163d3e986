//! Product and square: two numbers in, one out, correctly rounded.

use crate::float::Parts;
use crate::round::TOP;
use crate::{Flagged, Flags, Float, Policy};

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// `self · other`.
    #[inline]
    #[must_use]
    pub const fn mul(self, other: Self) -> Self {
        self.product::<false>(other, Policy::GRADUAL).value
    }

    /// `self · self`.
    #[inline]
    #[must_use]
    pub const fn square(self) -> Self {
        self.product::<false>(self, Policy::GRADUAL).value
    }

    /// `self · other` with flags.
    #[inline]
    pub const fn mul_with(self, other: Self, policy: Policy) -> Flagged<Self> {
        self.product::<true>(other, policy)
    }

    /// `self · self` with flags.
    #[inline]
    pub const fn square_with(self, policy: Policy) -> Flagged<Self> {
        self.product::<true>(self, policy)
    }

    #[inline(always)]
    const fn product<const FLAGS: bool>(self, other: Self, policy: Policy) -> Flagged<Self> {
        if self.is_rare() || other.is_rare() {
            return self.product_rare::<FLAGS>(other, policy);
        }
        Self::product_of::<FLAGS>(self.parts(), other.parts(), policy)
    }

    #[inline(always)]
    const fn product_of<const FLAGS: bool>(a: Parts, b: Parts, policy: Policy) -> Flagged<Self> {
        // The product of two significands in [1, 2) is in [1, 4): its leading bit is at TOP or just below.
        let product = ((a.significand as u64) * (b.significand as u64)) << (TOP - 1 - 2 * FRAC);
        let carry = (product >> TOP) as u32;
        let exponent = a.exponent + b.exponent - Self::BIAS + carry as i32;
        Self::round::<FLAGS>(a.sign ^ b.sign, exponent, product << (1 - carry), policy)
    }

    /// The product where an operand is zero, subnormal, infinite or NaN.
    #[cold]
    #[inline(never)]
    const fn product_rare<const FLAGS: bool>(self, other: Self, policy: Policy) -> Flagged<Self> {
        let (a, b) = (self.read(policy), other.read(policy));
        if a.is_nan() || b.is_nan() {
            return a.nan_of(b);
        }
        let sign = a.sign() ^ b.sign();
        if a.is_infinite() || b.is_infinite() {
            if a.is_zero() || b.is_zero() {
                return Flagged::new(Self::NAN, Flags::INVALID);
            }
            return Flagged::exact(Self::from_bits(sign | Self::INFINITE));
        }
        if a.is_zero() || b.is_zero() {
            return Flagged::exact(Self::from_bits(sign));
        }
        Self::product_of::<FLAGS>(a.normalised(), b.normalised(), policy)
    }
}

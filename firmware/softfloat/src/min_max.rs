//! Minimum and maximum: two numbers in, one of them out.

use crate::{Flagged, Flags, Float, Policy};

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// The lesser (−0 is less than +0). A NaN gives way to a number; two NaNs give the canonical one.
    #[inline]
    #[must_use]
    pub const fn min(self, other: Self) -> Self {
        self.min_with(other, Policy::GRADUAL).value
    }

    /// The greater (+0 is greater than −0). A NaN gives way to a number; two NaNs give the canonical one.
    #[inline]
    #[must_use]
    pub const fn max(self, other: Self) -> Self {
        self.max_with(other, Policy::GRADUAL).value
    }

    /// [`min`](Self::min) with flags: a signalling NaN raises invalid.
    #[inline]
    pub const fn min_with(self, other: Self, policy: Policy) -> Flagged<Self> {
        let (a, b) = (self.read(policy), other.read(policy));
        a.pick(b, a.order_strict() <= b.order_strict())
    }

    /// [`max`](Self::max) with flags: a signalling NaN raises invalid.
    #[inline]
    pub const fn max_with(self, other: Self, policy: Policy) -> Flagged<Self> {
        let (a, b) = (self.read(policy), other.read(policy));
        a.pick(b, a.order_strict() >= b.order_strict())
    }

    /// `self` if `first` (and it is a number), else `other`.
    #[inline]
    const fn pick(self, other: Self, first: bool) -> Flagged<Self> {
        let value = match (self.is_nan(), other.is_nan()) {
            (true, true) => Self::NAN,
            (true, false) => other,
            (false, true) => self,
            (false, false) => {
                if first {
                    self
                } else {
                    other
                }
            }
        };
        Flagged::new(value, Flags::INVALID.when(self.is_signalling() || other.is_signalling()))
    }

    /// As [`order`](Self::order), but −0 comes just before +0.
    #[inline]
    const fn order_strict(self) -> i32 {
        self.order() - self.is_sign_negative() as i32
    }
}

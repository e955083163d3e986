//! Comparisons: two numbers in, a truth value out; false whenever an operand is NaN.

use crate::{Flagged, Flags, Float, Policy};

/// Which NaN operands raise invalid.
#[derive(Clone, Copy)]
enum Raises {
    AnyNan,
    SignallingNan,
}

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// `self < other`.
    #[inline]
    #[must_use]
    pub const fn lt(self, other: Self) -> bool {
        (self.order() < other.order()) & !self.unordered(other)
    }

    /// `self ≤ other`.
    #[inline]
    #[must_use]
    pub const fn le(self, other: Self) -> bool {
        (self.order() <= other.order()) & !self.unordered(other)
    }

    /// `self = other` as numbers: the zeros are equal, a NaN equals nothing.
    #[inline]
    #[must_use]
    pub const fn eq(self, other: Self) -> bool {
        (self.order() == other.order()) & !self.unordered(other)
    }

    /// `self < other`; any NaN raises invalid.
    #[inline]
    pub const fn lt_with(self, other: Self, policy: Policy) -> Flagged<bool> {
        let (a, b) = (self.read(policy), other.read(policy));
        Flagged::new(a.lt(b), a.compare_flags(b, Raises::AnyNan))
    }

    /// `self ≤ other`; any NaN raises invalid.
    #[inline]
    pub const fn le_with(self, other: Self, policy: Policy) -> Flagged<bool> {
        let (a, b) = (self.read(policy), other.read(policy));
        Flagged::new(a.le(b), a.compare_flags(b, Raises::AnyNan))
    }

    /// `self = other`; only a signalling NaN raises invalid.
    #[inline]
    pub const fn eq_with(self, other: Self, policy: Policy) -> Flagged<bool> {
        let (a, b) = (self.read(policy), other.read(policy));
        Flagged::new(a.eq(b), a.compare_flags(b, Raises::SignallingNan))
    }

    /// `self < other`; only a signalling NaN raises invalid.
    #[inline]
    pub const fn lt_quiet_with(self, other: Self, policy: Policy) -> Flagged<bool> {
        let (a, b) = (self.read(policy), other.read(policy));
        Flagged::new(a.lt(b), a.compare_flags(b, Raises::SignallingNan))
    }

    /// `self ≤ other`; only a signalling NaN raises invalid.
    #[inline]
    pub const fn le_quiet_with(self, other: Self, policy: Policy) -> Flagged<bool> {
        let (a, b) = (self.read(policy), other.read(policy));
        Flagged::new(a.le(b), a.compare_flags(b, Raises::SignallingNan))
    }

    /// `self = other`; any NaN raises invalid.
    #[inline]
    pub const fn eq_signalling_with(self, other: Self, policy: Policy) -> Flagged<bool> {
        let (a, b) = (self.read(policy), other.read(policy));
        Flagged::new(a.eq(b), a.compare_flags(b, Raises::AnyNan))
    }

    /// An integer that orders as the number does; both zeros give 0.
    #[inline]
    pub(crate) const fn order(self) -> i32 {
        // Negated by its complement plus one: signs are hard to predict, so no branch.
        let negative = -(self.is_sign_negative() as i32);
        (self.magnitude() as i32 ^ negative) - negative
    }

    #[inline]
    pub(crate) const fn unordered(self, other: Self) -> bool {
        self.is_nan() | other.is_nan()
    }

    #[inline]
    const fn compare_flags(self, other: Self, raises: Raises) -> Flags {
        Flags::INVALID.when(match raises {
            Raises::AnyNan => self.unordered(other),
            Raises::SignallingNan => self.is_signalling() | other.is_signalling(),
        })
    }
}

//! Sum and difference: two numbers in, one out, correctly rounded.

use crate::round::TOP;
use crate::{Flagged, Flags, Float, Policy};

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// `self + other`.
    #[inline]
    #[must_use]
    pub const fn add(self, other: Self) -> Self {
        self.sum::<false>(other, Policy::GRADUAL).value
    }

    /// `self − other`.
    #[inline]
    #[must_use]
    pub const fn sub(self, other: Self) -> Self {
        self.sum::<false>(other.neg(), Policy::GRADUAL).value
    }

    /// `self + other` with flags.
    #[inline]
    pub const fn add_with(self, other: Self, policy: Policy) -> Flagged<Self> {
        self.sum::<true>(other, policy)
    }

    /// `self − other` with flags.
    #[inline]
    pub const fn sub_with(self, other: Self, policy: Policy) -> Flagged<Self> {
        self.sum::<true>(other.neg(), policy)
    }

    #[inline(always)]
    const fn sum<const FLAGS: bool>(self, other: Self, policy: Policy) -> Flagged<Self> {
        let (a, b) = (self.read(policy), other.read(policy));
        if !a.is_finite() || !b.is_finite() {
            return a.sum_special(b);
        }
        let (large, small) = if a.magnitude() >= b.magnitude() { (a, b) } else { (b, a) };
        let (large_exponent, x) = large.aligned();
        let (small_exponent, y) = small.aligned();
        // The bits shifted out are zeros: further than GUARD the smaller operand only tells on which side of the larger
        // one the sum lies, and it does so from there too.
        let distance = large_exponent - small_exponent;
        let y = y >> if distance < Self::GUARD { distance } else { Self::GUARD };
        let sum = if a.sign() == b.sign() { x + y } else { x - y };
        if sum == 0 {
            // −0 only from two negative zeros.
            return Flagged::exact(Self::from_bits(a.sign() & b.sign()));
        }
        let shift = sum.leading_zeros() as i32 - (63 - TOP as i32);
        Self::round::<FLAGS>(large.sign(), large_exponent as i32 + 1 - shift, sum << shift, policy)
    }

    /// Zeros below a significand whose leading bit leaves room for the sum's carry under [`TOP`].
    const GUARD: u32 = TOP - 1 - FRAC;

    /// A finite number's exponent (a subnormal's is that of the least normal number) and its significand above
    /// [`GUARD`](Self::GUARD) zeros.
    #[inline(always)]
    const fn aligned(self) -> (u32, u64) {
        let normal = (self.exponent() != 0) as u32;
        let significand = self.to_bits() & Self::FRACTION | normal << FRAC;
        (self.exponent() + 1 - normal, (significand as u64) << Self::GUARD)
    }

    /// The sum where an operand is infinite or NaN.
    #[cold]
    #[inline(never)]
    const fn sum_special(self, other: Self) -> Flagged<Self> {
        if self.is_nan() || other.is_nan() {
            return self.nan_of(other);
        }
        if self.is_infinite() && other.is_infinite() && self.sign() != other.sign() {
            return Flagged::new(Self::NAN, Flags::INVALID);
        }
        Flagged::exact(if self.is_infinite() { self } else { other })
    }

    /// The result of an operation with a NaN operand.
    pub(crate) const fn nan_of(self, other: Self) -> Flagged<Self> {
        Flagged::new(Self::NAN, Flags::INVALID.when(self.is_signalling() || other.is_signalling()))
    }
}

//! The one place where results are rounded: an exact (or sticky) significand in, the packed number and flags out.

use crate::{Flagged, Flags, Float, Policy};

/// Where the leading bit of a significand to be rounded stands; one bit is left above it for the carry.
pub(crate) const TOP: u32 = 62;

/// Where the leading bit of a quotient or root stands: one bit more than the longest fraction is below it.
pub(crate) const QUOTIENT_TOP: u32 = 24;

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// Bits below the kept ones.
    const DROP: u32 = TOP - FRAC;

    /// Rounds (−1)^sign · significand / 2^[`TOP`] · 2^(exponent − BIAS) to the nearest number, ties to even. The
    /// lowest bit may stand for any number of lost ones.
    #[inline(always)]
    pub(crate) const fn round<const FLAGS: bool>(
        sign: u32,
        exponent: i32,
        significand: u64,
        policy: Policy,
    ) -> Flagged<Self> {
        if Self::is_marginal(exponent) {
            return Self::round_marginal(sign, exponent, significand, policy);
        }
        let value = Self::pack(sign, exponent, Self::nearest(significand));
        Flagged::new(value, Flags::INEXACT.when(FLAGS && Self::loses(significand)))
    }

    /// The same for quotients and roots, which within normal numbers never lie halfway between two: the leading bit is
    /// at [`QUOTIENT_TOP`], and `inexact` says whether anything is left beyond the lowest.
    #[inline(always)]
    pub(crate) const fn round_never_halfway<const FLAGS: bool>(
        sign: u32,
        exponent: i32,
        quotient: u32,
        inexact: bool,
        policy: Policy,
    ) -> Flagged<Self> {
        if Self::is_marginal(exponent) {
            let significand = (quotient as u64) << (TOP - QUOTIENT_TOP) | inexact as u64;
            return Self::round_marginal(sign, exponent, significand, policy);
        }
        let drop = QUOTIENT_TOP - FRAC;
        let value = Self::pack(sign, exponent, (quotient + (1 << (drop - 1))) >> drop);
        let loses = inexact | (quotient << (32 - drop) != 0);
        Flagged::new(value, Flags::INEXACT.when(FLAGS && loses))
    }

    /// Whether the result may be tiny or overflow. Of an exponent field's two extremes one is for subnormals, the other
    /// for infinities, and the largest finite one may round up into it.
    #[inline(always)]
    const fn is_marginal(exponent: i32) -> bool {
        (exponent as u32).wrapping_sub(1) >= Self::EXPONENT_MAX - 2
    }

    /// A number from its rounded significand. The leading bit adds one to the exponent field, and so does a carry out of
    /// the fraction.
    #[inline(always)]
    const fn pack(sign: u32, exponent: i32, kept: u32) -> Self {
        Self::from_bits((sign | ((exponent as u32 - 1) << FRAC)) + kept)
    }

    /// Rounds at the ends of the range, where [`is_marginal`](Self::is_marginal).
    #[cold]
    #[inline(never)]
    const fn round_marginal(sign: u32, exponent: i32, significand: u64, policy: Policy) -> Flagged<Self> {
        if exponent < 1 {
            return Self::round_tiny(sign, exponent, significand, policy);
        }
        let carries = Self::nearest(significand) >> (FRAC + 1) != 0;
        if exponent + carries as i32 >= Self::EXPONENT_MAX as i32 {
            return Flagged::new(
                Self::from_bits(sign | Self::INFINITE),
                Flags::OVERFLOW.union(Flags::INEXACT),
            );
        }
        let value = Self::pack(sign, exponent, Self::nearest(significand));
        Flagged::new(value, Flags::INEXACT.when(Self::loses(significand)))
    }

    /// Rounds where the leading bit is below the least normal number's.
    const fn round_tiny(sign: u32, exponent: i32, significand: u64, policy: Policy) -> Flagged<Self> {
        // Tiny after rounding: not even a carry, with exponents unbounded, reaches the least normal number.
        let tiny = exponent < 0 || Self::nearest(significand) < Self::HIDDEN << 1;
        if policy.flushes() && tiny {
            return Flagged::new(Self::from_bits(sign), Flags::UNDERFLOW.union(Flags::INEXACT));
        }
        let shifted = shift_right_sticky(significand, (1 - exponent) as u32);
        let inexact = Self::loses(shifted);
        let flags = Flags::INEXACT.when(inexact).union(Flags::UNDERFLOW.when(inexact && tiny));
        Flagged::new(Self::from_bits(sign | Self::nearest(shifted)), flags)
    }

    /// The kept bits, rounded.
    #[inline(always)]
    const fn nearest(significand: u64) -> u32 {
        let just_below_half = (1 << (Self::DROP - 1)) - 1;
        let odd = significand >> Self::DROP & 1;
        ((significand + just_below_half + odd) >> Self::DROP) as u32
    }

    #[inline(always)]
    const fn loses(significand: u64) -> bool {
        significand << (64 - Self::DROP) != 0
    }
}

/// Shifts right; the lowest bit remembers whether anything was lost.
#[inline]
pub(crate) const fn shift_right_sticky(value: u64, by: u32) -> u64 {
    if by == 0 {
        return value;
    }
    if by > 63 {
        return (value != 0) as u64;
    }
    value >> by | (value << (64 - by) != 0) as u64
}

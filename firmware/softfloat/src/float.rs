//! The number itself: bits in, fields and classes out; free.

/// A binary floating-point number: a sign, `EXP` exponent bits and `FRAC` fraction bits, in the low bits of a `u32`.
///
/// `EXP` is 2 to 8 and `FRAC` 2 to 23, so that every number of every format is exactly an `f32`; other sizes do not
/// compile. The upper bits are zero.
///
/// `==` and `Hash` are of the bits; see [`eq`](Float::eq) for the IEEE comparison.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default)]
#[repr(transparent)]
pub struct Float<const EXP: u32, const FRAC: u32>(u32);

/// IEEE 754 single precision, 1-8-23.
pub type F32 = Float<8, 23>;

/// The accelerator's 24-bit format, 1-7-16, bias 63.
pub type F24 = Float<7, 16>;

/// A finite number taken apart: (−1)^sign · significand / 2^FRAC · 2^(exponent − BIAS).
#[derive(Clone, Copy)]
pub(crate) struct Parts {
    /// The sign bit, in its place.
    pub sign: u32,
    /// The biased exponent; below 1 for a subnormal that was normalised.
    pub exponent: i32,
    /// The significand, its leading bit at `FRAC`.
    pub significand: u32,
}

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// Bits in all.
    pub const WIDTH: u32 = {
        assert!(EXP >= 2 && EXP <= 8, "EXP must be 2 to 8");
        assert!(FRAC >= 2 && FRAC <= 23, "FRAC must be 2 to 23");
        1 + EXP + FRAC
    };
    /// The exponent field of 1.0.
    pub const BIAS: i32 = (1 << (EXP - 1)) - 1;

    pub(crate) const SIGN_BIT: u32 = 1 << (Self::WIDTH - 1);
    pub(crate) const MAGNITUDE: u32 = Self::SIGN_BIT - 1;
    pub(crate) const HIDDEN: u32 = 1 << FRAC;
    pub(crate) const FRACTION: u32 = Self::HIDDEN - 1;
    pub(crate) const QUIET: u32 = 1 << (FRAC - 1);
    pub(crate) const EXPONENT_MAX: u32 = (1 << EXP) - 1;
    pub(crate) const INFINITE: u32 = Self::EXPONENT_MAX << FRAC;

    /// Positive zero.
    pub const ZERO: Self = Self(0);
    /// One.
    pub const ONE: Self = Self((Self::BIAS as u32) << FRAC);
    /// Positive infinity.
    pub const INFINITY: Self = Self(Self::INFINITE);
    /// The canonical quiet NaN: sign clear, only the top fraction bit set.
    pub const NAN: Self = Self(Self::INFINITE | Self::QUIET);
    /// The largest finite number.
    pub const MAX: Self = Self(Self::INFINITE - 1);
    /// The least positive normal number.
    pub const MIN_POSITIVE: Self = Self(Self::HIDDEN);
    /// The least positive number, a subnormal.
    pub const MIN_SUBNORMAL: Self = Self(1);

    /// The number with these bits; bits above [`WIDTH`](Self::WIDTH) are ignored.
    #[inline]
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits & (Self::SIGN_BIT | Self::MAGNITUDE))
    }

    /// The bits, right-aligned.
    #[inline]
    #[must_use]
    pub const fn to_bits(self) -> u32 {
        self.0
    }

    /// Whether it is a NaN of either kind.
    #[inline]
    #[must_use]
    pub const fn is_nan(self) -> bool {
        self.magnitude() > Self::INFINITE
    }

    /// Whether it is a signalling NaN.
    #[inline]
    #[must_use]
    pub const fn is_signalling(self) -> bool {
        self.is_nan() && self.0 & Self::QUIET == 0
    }

    /// Whether it is an infinity.
    #[inline]
    #[must_use]
    pub const fn is_infinite(self) -> bool {
        self.magnitude() == Self::INFINITE
    }

    /// Whether it is neither infinite nor a NaN.
    #[inline]
    #[must_use]
    pub const fn is_finite(self) -> bool {
        self.magnitude() < Self::INFINITE
    }

    /// Whether it is a zero of either sign.
    #[inline]
    #[must_use]
    pub const fn is_zero(self) -> bool {
        self.magnitude() == 0
    }

    /// Whether it is below the least normal number and not zero.
    #[inline]
    #[must_use]
    pub const fn is_subnormal(self) -> bool {
        self.magnitude().wrapping_sub(1) < Self::FRACTION
    }

    /// Whether the sign bit is set.
    #[inline]
    #[must_use]
    pub const fn is_sign_negative(self) -> bool {
        self.0 & Self::SIGN_BIT != 0
    }

    /// The sign bit flipped, of a NaN too; no flags.
    #[inline]
    #[must_use]
    pub const fn neg(self) -> Self {
        Self(self.0 ^ Self::SIGN_BIT)
    }

    /// The sign bit cleared, of a NaN too; no flags.
    #[inline]
    #[must_use]
    pub const fn abs(self) -> Self {
        Self(self.0 & Self::MAGNITUDE)
    }

    #[inline]
    pub(crate) const fn magnitude(self) -> u32 {
        self.0 & Self::MAGNITUDE
    }

    #[inline]
    pub(crate) const fn sign(self) -> u32 {
        self.0 & Self::SIGN_BIT
    }

    #[inline]
    pub(crate) const fn exponent(self) -> u32 {
        self.magnitude() >> FRAC
    }

    /// Zero, subnormal, infinite or NaN: the exponent field is all zeros or all ones.
    #[inline]
    pub(crate) const fn is_rare(self) -> bool {
        // Both exponents, plus one, have nothing above their lowest bit.
        self.0.wrapping_add(Self::HIDDEN) & (Self::INFINITE & !Self::HIDDEN) == 0
    }

    /// The operand as the policy reads it.
    #[inline]
    pub(crate) const fn read(self, policy: crate::Policy) -> Self {
        if policy.flushes() && self.exponent() == 0 { Self(self.sign()) } else { self }
    }

    /// The parts of a normal number.
    #[inline]
    pub(crate) const fn parts(self) -> Parts {
        Parts {
            sign: self.sign(),
            exponent: self.exponent() as i32,
            significand: self.0 & Self::FRACTION | Self::HIDDEN,
        }
    }

    /// The parts of any finite number but zero.
    #[inline]
    pub(crate) const fn normalised(self) -> Parts {
        if self.exponent() != 0 {
            return self.parts();
        }
        let shift = self.magnitude().leading_zeros() - (31 - FRAC);
        Parts { sign: self.sign(), exponent: 1 - shift as i32, significand: self.magnitude() << shift }
    }
}

//! From one format to another: a number in, the nearest number of the other format out.

use crate::round::TOP;
use crate::{Flagged, Flags, Float, Policy};

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// The nearest number of another format.
    #[inline]
    #[must_use]
    pub const fn convert<const EXP2: u32, const FRAC2: u32>(self) -> Float<EXP2, FRAC2> {
        self.convert_with(Policy::GRADUAL).value
    }

    /// The nearest number of another format, with flags.
    pub const fn convert_with<const EXP2: u32, const FRAC2: u32>(
        self,
        policy: Policy,
    ) -> Flagged<Float<EXP2, FRAC2>> {
        let a = self.read(policy);
        if a.is_nan() {
            return Flagged::new(Float::NAN, Flags::INVALID.when(a.is_signalling()));
        }
        if EXP == EXP2 && FRAC == FRAC2 {
            return Flagged::exact(Float::from_bits(a.to_bits()));
        }
        let negative = a.is_sign_negative();
        if a.is_infinite() {
            return Flagged::exact(Float::signed(negative, Float::<EXP2, FRAC2>::INFINITE));
        }
        if a.is_zero() {
            return Flagged::exact(Float::signed(negative, 0));
        }
        let parts = a.normalised();
        Float::from_scaled(
            negative,
            parts.exponent - Self::BIAS,
            (parts.significand as u64) << (TOP - FRAC),
            policy,
        )
    }

    /// The nearest number to ±significand / 2^[`TOP`] · 2^scale, for any scale.
    pub(crate) const fn from_scaled(
        negative: bool,
        scale: i32,
        significand: u64,
        policy: Policy,
    ) -> Flagged<Self> {
        let sign = if negative { Self::SIGN_BIT } else { 0 };
        Self::round::<true>(sign, scale + Self::BIAS, significand, policy)
    }

    pub(crate) const fn signed(negative: bool, magnitude: u32) -> Self {
        Self::from_bits(magnitude | if negative { Self::SIGN_BIT } else { 0 })
    }
}

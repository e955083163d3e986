//! To and from the host's `f32` and `f64`: towards the host exactly, from it rounded to nearest.

use crate::round::TOP;
use crate::{F32, Flagged, Flags, Float, Policy};

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// The nearest number to a host `f32`; a NaN becomes the canonical one.
    #[inline]
    #[must_use]
    pub const fn from_f32(x: f32) -> Self {
        Self::from_f32_with(x, Policy::GRADUAL).value
    }

    /// The nearest number to a host `f32`, with flags.
    #[inline]
    pub const fn from_f32_with(x: f32, policy: Policy) -> Flagged<Self> {
        F32::from_bits(x.to_bits()).convert_with(policy)
    }

    /// The same number as a host `f32`; a NaN becomes the canonical one.
    #[inline]
    #[must_use]
    pub const fn to_f32(self) -> f32 {
        f32::from_bits(self.convert::<8, 23>().to_bits())
    }

    /// The nearest number to a host `f64`, rounded once; a NaN becomes the canonical one.
    #[inline]
    #[must_use]
    pub const fn from_f64(x: f64) -> Self {
        Self::from_f64_with(x, Policy::GRADUAL).value
    }

    /// The nearest number to a host `f64`, rounded once, with flags.
    pub const fn from_f64_with(x: f64, policy: Policy) -> Flagged<Self> {
        const FRACTION: u64 = (1 << 52) - 1;
        let (bits, negative) = (x.to_bits(), x.is_sign_negative());
        let (exponent, fraction) = ((bits >> 52 & 0x7FF) as i32, bits & FRACTION);
        if exponent == 0x7FF {
            return match fraction {
                0 => Flagged::exact(Self::signed(negative, Self::INFINITE)),
                _ => Flagged::new(Self::NAN, Flags::INVALID.when(fraction >> 51 == 0)),
            };
        }
        if exponent == 0 && (fraction == 0 || policy.flushes()) {
            return Flagged::exact(Self::signed(negative, 0));
        }
        // A subnormal f64 is far below half of any format's least number: it need not be normalised to the last bit.
        let significand = if exponent == 0 { 1 << TOP } else { (fraction | (FRACTION + 1)) << (TOP - 52) };
        Self::from_scaled(negative, exponent - 1023, significand, policy)
    }

    /// The same number as a host `f64`; a NaN becomes the canonical one.
    #[must_use]
    pub const fn to_f64(self) -> f64 {
        let sign = (self.sign() as u64) << (64 - Self::WIDTH);
        if self.is_nan() {
            return f64::from_bits(0x7FF8 << 48);
        }
        if self.is_infinite() {
            return f64::from_bits(sign | 0x7FF << 52);
        }
        if self.is_zero() {
            return f64::from_bits(sign);
        }
        let parts = self.normalised();
        let exponent = (parts.exponent - Self::BIAS + 1023) as u64;
        let fraction = (parts.significand & Self::FRACTION) as u64;
        f64::from_bits(sign | exponent << 52 | fraction << (52 - FRAC))
    }
}

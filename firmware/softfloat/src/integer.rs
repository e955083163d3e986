//! To and from 32-bit integers: saturating, a NaN to the largest value, as RISC-V has it.

use crate::round::{TOP, shift_right_sticky};
use crate::{Flagged, Flags, Float, Policy, Rounding};

impl<const EXP: u32, const FRAC: u32> Float<EXP, FRAC> {
    /// The nearest number to an integer.
    #[inline]
    #[must_use]
    pub const fn from_i32(x: i32) -> Self {
        Self::from_i32_with(x, Policy::GRADUAL).value
    }

    /// The nearest number to an integer.
    #[inline]
    #[must_use]
    pub const fn from_u32(x: u32) -> Self {
        Self::from_u32_with(x, Policy::GRADUAL).value
    }

    /// The nearest number to an integer, with flags.
    pub const fn from_i32_with(x: i32, policy: Policy) -> Flagged<Self> {
        Self::from_magnitude(x < 0, x.unsigned_abs(), policy)
    }

    /// The nearest number to an integer, with flags.
    pub const fn from_u32_with(x: u32, policy: Policy) -> Flagged<Self> {
        Self::from_magnitude(false, x, policy)
    }

    /// The integer, saturated; a NaN gives `i32::MAX`.
    #[inline]
    #[must_use]
    pub const fn to_i32(self, rounding: Rounding) -> i32 {
        self.to_i32_with(rounding, Policy::GRADUAL).value
    }

    /// The integer, saturated: anything below zero gives 0 (unless it rounds there, with invalid); a NaN gives
    /// `u32::MAX`.
    #[inline]
    #[must_use]
    pub const fn to_u32(self, rounding: Rounding) -> u32 {
        self.to_u32_with(rounding, Policy::GRADUAL).value
    }

    /// [`to_i32`](Self::to_i32) with flags: invalid, alone, when the rounded value is out of range.
    pub const fn to_i32_with(self, rounding: Rounding, policy: Policy) -> Flagged<i32> {
        let clamped = self.to_integer(i32::MIN as i64, i32::MAX as i64, rounding, policy);
        Flagged::new(clamped.value as i32, clamped.flags)
    }

    /// [`to_u32`](Self::to_u32) with flags: invalid, alone, when the rounded value is out of range.
    pub const fn to_u32_with(self, rounding: Rounding, policy: Policy) -> Flagged<u32> {
        let clamped = self.to_integer(0, u32::MAX as i64, rounding, policy);
        Flagged::new(clamped.value as u32, clamped.flags)
    }

    const fn from_magnitude(negative: bool, magnitude: u32, policy: Policy) -> Flagged<Self> {
        if magnitude == 0 {
            return Flagged::exact(Self::ZERO);
        }
        let leading = 31 - magnitude.leading_zeros();
        Self::from_scaled(negative, leading as i32, (magnitude as u64) << (TOP - leading), policy)
    }

    /// The value rounded to an integer and clamped to `least..=most`.
    const fn to_integer(self, least: i64, most: i64, rounding: Rounding, policy: Policy) -> Flagged<i64> {
        let a = self.read(policy);
        if a.is_nan() {
            return Flagged::new(most, Flags::INVALID);
        }
        if a.is_zero() {
            return Flagged::exact(0);
        }
        let parts = a.normalised();
        let scale = parts.exponent - Self::BIAS;
        let negative = a.is_sign_negative();
        if scale > 32 || a.is_infinite() {
            return Flagged::new(if negative { least } else { most }, Flags::INVALID);
        }
        // Fixed point with 30 fraction bits: below 2^63, and what shifts out only has to be known of.
        let wide = (parts.significand as u64) << (62 - 32 - FRAC);
        let fixed = if scale >= 0 { wide << scale } else { shift_right_sticky(wide, -scale as u32) };
        let (whole, rest) = ((fixed >> 30) as i64, fixed & ((1 << 30) - 1));
        let half = 1 << 29;
        let up = match rounding {
            Rounding::NearestEven => rest > half || rest == half && whole & 1 == 1,
            Rounding::TowardZero => false,
        };
        let rounded = whole + up as i64;
        let value = if negative { -rounded } else { rounded };
        if value < least {
            Flagged::new(least, Flags::INVALID)
        } else if value > most {
            Flagged::new(most, Flags::INVALID)
        } else {
            Flagged::new(value, Flags::INEXACT.when(rest != 0))
        }
    }
}

//! What a datapath asks of its numbers, so that one source serves every format: free.

use crate::{F24, F32, Line, PlainLine};

/// The number formats a device can be built with, as numbered in its capability register.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u8)]
pub enum FormatCode {
    /// IEEE 754 single precision, 1-8-23.
    F32 = 0,
    /// 1-7-16.
    F24 = 1,
    /// Numbers outside the datapath are f32, those inside binary64: for studies on a host, no hardware has it.
    F64 = 2,
}

impl FormatCode {
    /// The format with this number in the capability register, if there is one.
    #[must_use]
    pub const fn from_bits(bits: u32) -> Option<FormatCode> {
        match bits {
            0 => Some(FormatCode::F32),
            1 => Some(FormatCode::F24),
            2 => Some(FormatCode::F64),
            _ => None,
        }
    }

    /// "f32", "f24" or "f64".
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            FormatCode::F32 => "f32",
            FormatCode::F24 => "f24",
            FormatCode::F64 => "f64",
        }
    }
}

/// A number format a datapath can be built of. Every operation rounds to nearest even with gradual subnormals, and gives
/// the canonical NaN, so that all implementations of one [`CODE`](Format::CODE) agree to the bit.
pub trait Format: Copy + core::fmt::Debug + PartialEq + 'static {
    /// "f32" or "f24".
    const NAME: &'static str;
    /// The number in the capability register.
    const CODE: FormatCode;
    /// Whether an operation costs more than a branch that is mispredicted now and then: so it is for soft formats, and a
    /// shortcut that saves operations then pays.
    const COSTLY: bool = true;
    /// Positive zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Lines in a plane.
    type Line: Line<Self>;
    /// The number with these bits; upper bits are ignored.
    fn from_bits(bits: u32) -> Self;
    /// The bits, right-aligned.
    fn to_bits(self) -> u32;
    /// The nearest number to a host `f32`; a NaN becomes the canonical one.
    fn from_f32(x: f32) -> Self;
    /// The same number as a host `f32`.
    fn to_f32(self) -> f32;
    /// `self + other`.
    #[must_use]
    fn add(self, other: Self) -> Self;
    /// `self − other`.
    #[must_use]
    fn sub(self, other: Self) -> Self;
    /// `self · other`.
    #[must_use]
    fn mul(self, other: Self) -> Self;
    /// `self / other`.
    #[must_use]
    fn div(self, other: Self) -> Self;
    /// `self · self`.
    #[must_use]
    fn square(self) -> Self;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// `self < other`; false with a NaN.
    fn lt(self, other: Self) -> bool;
    /// `self ≤ other`; false with a NaN.
    fn le(self, other: Self) -> bool;
    /// `self = other` as numbers; false with a NaN.
    fn eq(self, other: Self) -> bool;
    /// `⌊self · 2^log2⌋`, clipped to ±2^24; 0 for a NaN. `log2` is at most 31.
    #[inline]
    #[must_use]
    fn floor_scaled(self, log2: u32) -> i32 {
        floor(self.to_f32() * power_of_two(log2 as i32))
    }
    /// `integer · 2^-log2`, rounded once when `integer` is within ±2^24. `log2` is at most 31.
    #[inline]
    #[must_use]
    fn from_scaled(integer: i32, log2: u32) -> Self {
        Self::from_f32(integer as f32 * power_of_two(-(log2 as i32)))
    }
    /// `(row[0] · with[0] + row[1] · with[1]) + row[2] · with[2]` of each row, every product and sum rounded.
    #[inline]
    #[must_use]
    fn dots<const N: usize>(rows: [&[Self; 3]; N], with: &[Self; 3]) -> [Self; N] {
        rows.map(|row| row[0].mul(with[0]).add(row[1].mul(with[1])).add(row[2].mul(with[2])))
    }
    /// `point + direction · t` on both axes, product and sum rounded.
    #[inline]
    #[must_use]
    fn along(point: [Self; 2], direction: [Self; 2], t: Self) -> [Self; 2] {
        [0, 1].map(|axis| point[axis].add(direction[axis].mul(t)))
    }
    /// The nearest byte to `byte · self`, halves up, after the product has been rounded to the format; 0 for a NaN.
    #[inline]
    #[must_use]
    fn times_byte(self, byte: u8) -> u8 {
        let twice = Self::from_scaled(byte.into(), 0).mul(self).floor_scaled(1);
        ((twice + 1) >> 1).clamp(0, 0xFF) as u8
    }
}

/// The limit of [`Format::floor_scaled`], to which every integer is an f32.
const FLOOR_LIMIT: f32 = (1 << 24) as f32;

#[inline]
const fn power_of_two(exponent: i32) -> f32 {
    f32::from_bits(((127 + exponent) as u32) << 23)
}

#[inline]
fn floor(x: f32) -> i32 {
    let clipped = x.clamp(-FLOOR_LIMIT, FLOOR_LIMIT);
    // Toward zero; a NaN becomes 0.
    let whole = clipped as i32;
    whole - i32::from(whole as f32 > clipped)
}

macro_rules! soft_format {
    ($float:ty, $code:expr) => {
        impl Format for $float {
            const NAME: &'static str = $code.name();
            const CODE: FormatCode = $code;
            const ZERO: Self = <$float>::ZERO;
            const ONE: Self = <$float>::ONE;
            type Line = PlainLine<Self>;
            #[inline]
            fn from_bits(bits: u32) -> Self {
                <$float>::from_bits(bits)
            }
            #[inline]
            fn to_bits(self) -> u32 {
                <$float>::to_bits(self)
            }
            #[inline]
            fn from_f32(x: f32) -> Self {
                <$float>::from_f32(x)
            }
            #[inline]
            fn to_f32(self) -> f32 {
                <$float>::to_f32(self)
            }
            #[inline]
            fn add(self, other: Self) -> Self {
                <$float>::add(self, other)
            }
            #[inline]
            fn sub(self, other: Self) -> Self {
                <$float>::sub(self, other)
            }
            #[inline]
            fn mul(self, other: Self) -> Self {
                <$float>::mul(self, other)
            }
            #[inline]
            fn div(self, other: Self) -> Self {
                <$float>::div(self, other)
            }
            #[inline]
            fn square(self) -> Self {
                <$float>::square(self)
            }
            #[inline]
            fn sqrt(self) -> Self {
                <$float>::sqrt(self)
            }
            #[inline]
            fn lt(self, other: Self) -> bool {
                <$float>::lt(self, other)
            }
            #[inline]
            fn le(self, other: Self) -> bool {
                <$float>::le(self, other)
            }
            #[inline]
            fn eq(self, other: Self) -> bool {
                <$float>::eq(self, other)
            }
        }
    };
}

soft_format!(F32, FormatCode::F32);
soft_format!(F24, FormatCode::F24);

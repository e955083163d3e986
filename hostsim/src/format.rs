//! Number formats that the host computes for the device; in: the same bits as the soft formats, out: the same bits; cost: one
//! host operation, and for F24 its rounding, where that can make a difference.
//!
//! [`HostF32`] is the host's own f32. [`HostF24`] computes in f64 and rounds once to 1-7-16, which is exact because
//! 53 >= 2·17 + 2; its lines do without most roundings. Both are chosen for speed only, and tests hold them against the soft
//! formats. [`HostF64`] is no device's: it tells what a job would come to if arithmetic did not matter.

use lucerna_softfloat::{F32, Format, FormatCode, PlainLine};

pub use f24::HostF24;

/// The comparisons of [`Format`] on a host number in `self.0`.
macro_rules! host_comparisons {
    () => {
        #[inline(always)]
        fn lt(self, other: Self) -> bool {
            self.0 < other.0
        }
        #[inline(always)]
        fn le(self, other: Self) -> bool {
            self.0 <= other.0
        }
        #[inline(always)]
        fn eq(self, other: Self) -> bool {
            self.0 == other.0
        }
    };
}

/// All its operations, when no result has to be rounded.
macro_rules! host_arithmetic {
    () => {
        #[inline(always)]
        fn add(self, other: Self) -> Self {
            Self(self.0 + other.0)
        }
        #[inline(always)]
        fn sub(self, other: Self) -> Self {
            Self(self.0 - other.0)
        }
        #[inline(always)]
        fn mul(self, other: Self) -> Self {
            Self(self.0 * other.0)
        }
        #[inline(always)]
        fn div(self, other: Self) -> Self {
            Self(self.0 / other.0)
        }
        #[inline(always)]
        fn square(self) -> Self {
            Self(self.0 * self.0)
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            Self(self.0.sqrt())
        }
        host_comparisons!();
    };
}

/// The limit of [`Format::floor_scaled`].
const FLOOR_LIMIT: f64 = (1 << 24) as f64;
/// Added to a small number, it leaves no room for a fraction, and the integer in the low bits.
const ANCHOR: f64 = 1.5 * (1u64 << 52) as f64;

/// 2^exponent, of exponents within ±31.
#[inline(always)]
const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// The next integer at or below, clipped.
#[inline(always)]
fn floor(x: f64) -> i32 {
    if x.abs() <= FLOOR_LIMIT {
        let anchored = x + ANCHOR;
        // The addition rounded to nearest.
        return anchored.to_bits() as i32 - i32::from(anchored - ANCHOR > x);
    }
    floor_rare(x)
}

/// Beyond the limit, or not a number.
#[cold]
fn floor_rare(x: f64) -> i32 {
    x.clamp(-FLOOR_LIMIT, FLOOR_LIMIT) as i32
}

/// The host's f32, its NaN made canonical where bits leave it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HostF32(f32);

impl Format for HostF32 {
    type Line = PlainLine<Self>;
    const NAME: &'static str = "f32";
    const CODE: FormatCode = FormatCode::F32;
    const COSTLY: bool = false;
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Self(f32::from_bits(bits))
    }
    #[inline(always)]
    fn to_bits(self) -> u32 {
        if self.0.is_nan() { F32::from_f32(f32::NAN).to_bits() } else { self.0.to_bits() }
    }
    fn from_f32(x: f32) -> Self {
        Self(x)
    }
    fn to_f32(self) -> f32 {
        self.0
    }
    #[inline(always)]
    fn floor_scaled(self, log2: u32) -> i32 {
        floor(f64::from(self.0) * power_of_two(log2 as i32))
    }
    host_arithmetic!();
}

/// The study format: words are f32, everything between them is f64.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HostF64(f64);

impl Format for HostF64 {
    type Line = PlainLine<Self>;
    const NAME: &'static str = "f64";
    const CODE: FormatCode = FormatCode::F64;
    const COSTLY: bool = false;
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Self(f32::from_bits(bits).into())
    }
    #[inline(always)]
    fn to_bits(self) -> u32 {
        HostF32(self.0 as f32).to_bits()
    }
    fn from_f32(x: f32) -> Self {
        Self(x.into())
    }
    fn to_f32(self) -> f32 {
        self.0 as f32
    }
    #[inline(always)]
    fn floor_scaled(self, log2: u32) -> i32 {
        floor(self.0 * power_of_two(log2 as i32))
    }
    #[inline(always)]
    fn from_scaled(integer: i32, log2: u32) -> Self {
        Self(f64::from(integer) * power_of_two(-(log2 as i32)))
    }
    host_arithmetic!();
}

mod f24;
mod line;
#[cfg(test)]
mod tests;

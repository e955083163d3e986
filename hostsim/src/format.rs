//! Number formats that the host computes for the device; in: the same bits as the soft formats, out: the same bits; cost: one
//! host operation, and for F24 one rounding.
//!
//! [`HostF32`] is the host's own f32. [`HostF24`] computes in f64 and rounds once to 1-7-16, which is exact because
//! 53 >= 2·17 + 2. Both are chosen for speed only, and tests hold them against the soft formats. [`HostF64`] is no device's:
//! it tells what a job would come to if arithmetic did not matter.

use lucerna_softfloat::{F24, F32, Format, FormatCode, PlainLine};

use line::Line24;

/// The operations of [`Format`] on a host number in `self.0`, each result through `$finish`.
macro_rules! host_arithmetic {
    ($finish:expr) => {
        #[inline(always)]
        fn add(self, other: Self) -> Self {
            $finish(self.0 + other.0)
        }
        #[inline(always)]
        fn sub(self, other: Self) -> Self {
            $finish(self.0 - other.0)
        }
        #[inline(always)]
        fn mul(self, other: Self) -> Self {
            $finish(self.0 * other.0)
        }
        #[inline(always)]
        fn div(self, other: Self) -> Self {
            $finish(self.0 / other.0)
        }
        #[inline(always)]
        fn square(self) -> Self {
            $finish(self.0 * self.0)
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            $finish(self.0.sqrt())
        }
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
    host_arithmetic!(Self);
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
    host_arithmetic!(Self);
}

/// A number of the 1-7-16 format, held as the f64 of the same value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HostF24(f64);

/// Fraction bits that f64 has and F24 has not.
const SPARE: u32 = 52 - 16;
/// Bias of f64 less bias of F24.
const REBIAS: u64 = 1023 - 63;
/// 2^-62, the least normal of F24.
const LEAST_NORMAL: f64 = f64::from_bits((1023 - 62) << 52);
/// 2^64, where F24 overflows (after rounding).
const OVERFLOW: f64 = f64::from_bits((1023 + 64) << 52);
/// 2^-78, F24's least subnormal.
const QUANTUM: f64 = f64::from_bits((1023 - 78) << 52);

/// The nearest F24 value to an f64, ties to even.
#[inline(always)]
fn rounded(x: f64) -> HostF24 {
    let nearest = nearest(x);
    let magnitude = nearest.to_bits() << 1;
    // Exponents from that of the least normal number to below that of the overflow, whatever the sign.
    let least = LEAST_NORMAL.to_bits() << 1;
    let normal = magnitude.wrapping_sub(least) < (OVERFLOW.to_bits() << 1) - least;
    if normal | (x == 0.0) { HostF24(nearest) } else { rounded_rare(x) }
}

/// An f64 rounded to 17 bits, ties to even: the nearest F24 value if that is a normal number, because below 2^-62 a result of
/// 2^-62 is that of the coarser subnormal grid as well.
#[inline(always)]
fn nearest(x: f64) -> f64 {
    let bits = x.to_bits();
    let to_even = (1u64 << (SPARE - 1)) - 1 + (bits >> SPARE & 1);
    f64::from_bits(bits.wrapping_add(to_even) >> SPARE << SPARE)
}

/// Subnormals, infinities, NaN.
#[cold]
fn rounded_rare(x: f64) -> HostF24 {
    HostF24(if x.is_nan() {
        f64::NAN
    } else if x.abs() >= 1.0 {
        f64::INFINITY.copysign(x)
    } else {
        // At 1.5·2^52 quanta, an f64's last bit is one quantum: the addition rounds to a whole number of them.
        let anchor = 1.5 * QUANTUM * (1u64 << 52) as f64;
        ((x.abs() + anchor) - anchor).copysign(x)
    })
}

impl Format for HostF24 {
    type Line = Line24;
    const NAME: &'static str = "f24";
    const CODE: FormatCode = FormatCode::F24;
    const COSTLY: bool = false;
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        let (exponent, fraction) = (bits >> 16 & 0x7f, bits & 0xffff);
        if bits & 0x7f_ffff == 0 {
            return Self(if bits & 0x80_0000 == 0 { 0.0 } else { -0.0 });
        }
        if exponent == 0 || exponent == 0x7f {
            return Self(F24::from_bits(bits).to_f64());
        }
        let sign = u64::from(bits >> 23 & 1) << 63;
        Self(f64::from_bits(sign | (u64::from(exponent) + REBIAS) << 52 | u64::from(fraction) << SPARE))
    }
    #[inline(always)]
    fn to_bits(self) -> u32 {
        let magnitude = self.0.abs();
        if (LEAST_NORMAL..OVERFLOW).contains(&magnitude) {
            let bits = self.0.to_bits();
            let body = ((bits >> SPARE) & 0x7ff_ffff) as u32 - ((REBIAS as u32) << 16);
            return body | ((bits >> 63) as u32) << 23;
        }
        F24::from_f64(self.0).to_bits()
    }
    fn from_f32(x: f32) -> Self {
        rounded(f64::from(x))
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
        if integer.unsigned_abs() <= 1 << 17 {
            return Self(f64::from(integer) * power_of_two(-(log2 as i32)));
        }
        // By way of f32, as the provided method rounds integers beyond 2^24.
        rounded(f64::from(integer as f32) * power_of_two(-(log2 as i32)))
    }
    host_arithmetic!(rounded);
}

mod line;
#[cfg(test)]
mod tests;

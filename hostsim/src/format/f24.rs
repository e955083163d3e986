//! The 1-7-16 format by binary64; in: numbers, out: the bits of the soft format; cost: one host operation and five to ten for
//! its rounding.
//!
//! An f64 is rounded by adding something so large that no digits are left but those of F24, and taking it off again. Both take the
//! host's own rounding, to nearest and ties to even, and neither needs a branch: what cannot be rounded so is found by one
//! compare, for several operations at once where a method is a whole formula.

use lucerna_softfloat::{F24, Format, FormatCode};

use super::line::Line24;
use super::{floor, power_of_two};

/// A number of the 1-7-16 format, held as the f64 of the same value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HostF24(pub(super) f64);

/// Fraction bits that f64 has and F24 has not.
const SPARE: u32 = 52 - 16;
/// 2^36: a number so many times its size leaves it 17 bits.
const COARSER: f64 = (1u64 << SPARE) as f64;
/// 2^-62, the least normal of F24.
const LEAST_NORMAL: f64 = f64::from_bits((1023 - 62) << 52);
/// 2^64, where F24 overflows (after rounding).
const OVERFLOW: f64 = f64::from_bits((1023 + 64) << 52);
/// 2^-960: with exponents so much smaller, an f64 has its exponent and the first 16 bits of its fraction where F24 has them, and
/// is subnormal where F24 is.
const REBIAS: f64 = f64::from_bits((1023 - 960) << 52);
const UNBIAS: f64 = 1.0 / REBIAS;
const SIGN: u64 = 1 << 63;
/// The anchor of what is rounded to a whole number of subnormals, of either sign.
const LEAST_ANCHOR: f64 = 1.5 * COARSER * LEAST_NORMAL;
/// The least anchor of what is rounded to 2^64.
const OVERFLOW_ANCHOR: f64 = COARSER * OVERFLOW * (1.0 - 1.0 / (1u64 << 18) as f64);

/// What is added to a product or a quotient of F24 numbers and taken off again to round it: 2^36 times its size, so that the
/// last bit of the sum is the last that F24 has of it, but no less than makes it the last bit of F24's subnormals.
///
/// The sum begins with another power of two than the anchor only if the number is within 2^-36 of itself to one. A product has
/// 34 bits and a quotient is off a 17-bit number by 2^-34 of itself, so then it is that power, and the sum exact. And of a tie,
/// which has 18 bits, the anchor is even in the last bit of the sum, so it goes to even.
#[inline(always)]
fn anchor(x: f64) -> f64 {
    let anchor = x.abs() * COARSER;
    if anchor < LEAST_ANCHOR { LEAST_ANCHOR } else { anchor }
}

/// The nearest F24 value to a product, a quotient or an f32, ties to even.
#[inline(always)]
fn rounded(x: f64) -> HostF24 {
    let anchor = anchor(x);
    // The sign is that of x already, but for zero.
    if anchor < OVERFLOW_ANCHOR { HostF24((x + anchor - anchor).copysign(x)) } else { beyond(x) }
}

/// Infinite, or not a number.
#[cold]
fn beyond(x: f64) -> HostF24 {
    HostF24(if x.is_nan() { f64::NAN } else { f64::INFINITY.copysign(x) })
}

/// A finite f64 rounded to 17 bits, ties to even (Veltkamp's splitting): the nearest F24 value if that is a normal number. A
/// tie has 18 bits, so 2^36 times it is even in the last bit of the sum, and goes to even as well. Zero keeps its sign.
///
/// A sum of F24 numbers is one if it is below 2^-62, as all of them are multiples of the least: so this rounds every sum that
/// does not overflow.
#[inline(always)]
pub(super) fn split(x: f64) -> f64 {
    let high = x * (COARSER + 1.0);
    high - (high - x)
}

/// A sum of two F24 numbers, rounded.
#[inline(always)]
fn sum(x: f64) -> HostF24 {
    let nearest = split(x);
    if nearest.abs() < OVERFLOW { HostF24(nearest) } else { beyond(x) }
}

/// A product of two F24 numbers.
#[derive(Clone, Copy)]
struct Product {
    /// Rounded, unless it overflows; a zero is positive.
    rounded: f64,
    /// What it was rounded by.
    anchor: f64,
}

impl Product {
    #[inline(always)]
    fn new(a: HostF24, b: HostF24) -> Self {
        let product = a.0 * b.0;
        let anchor = anchor(product);
        Self { rounded: product + anchor - anchor, anchor }
    }
}

/// Whether sums of numbers that have these anchors are those of F24: not even all terms together come to 2^63, and no sum is 0,
/// whose sign takes those of the terms.
#[inline(always)]
fn is_certain<const N: usize>(anchors: [f64; N], sums: [f64; N]) -> bool {
    // The product of two F24 numbers that are not 0 is none in f64 either.
    (anchors.iter().sum::<f64>() < OVERFLOW_ANCHOR / 2.0) & (sums.iter().product::<f64>() != 0.0)
}

/// An integer of more digits than F24 has.
#[cold]
#[inline(never)]
fn wide(integer: i32, log2: u32) -> HostF24 {
    // By way of f32, as the provided method rounds integers beyond 2^24.
    rounded(f64::from(integer as f32) * power_of_two(-(log2 as i32)))
}

#[cold]
#[inline(never)]
fn dots_rare<const N: usize>(rows: [[HostF24; 3]; N], with: [HostF24; 3]) -> [HostF24; N] {
    rows.map(|row| row[0].mul(with[0]).add(row[1].mul(with[1])).add(row[2].mul(with[2])))
}

#[cold]
#[inline(never)]
fn along_rare(point: [HostF24; 2], direction: [HostF24; 2], t: HostF24) -> [HostF24; 2] {
    [0, 1].map(|axis| point[axis].add(direction[axis].mul(t)))
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
        if !bits & 0x7f_0000 == 0 {
            return Self(F24::from_bits(bits).to_f64());
        }
        // The sign runs down to where the exponent begins, and stays at the top only.
        let spread = (i64::from(bits) << 40 >> 4) as u64;
        Self(f64::from_bits(spread & (SIGN | 0x7f_ffff << SPARE)) * UNBIAS)
    }
    #[inline(always)]
    fn to_bits(self) -> u32 {
        let bits = ((self.0 * REBIAS).to_bits() >> SPARE) as u32;
        if bits & 0x780_0000 == 0 {
            return bits & 0x7f_ffff | bits >> 4 & 0x80_0000;
        }
        F24::from_f64(self.0).to_bits()
    }
    #[inline(always)]
    fn from_f32(x: f32) -> Self {
        rounded(f64::from(x))
    }
    fn to_f32(self) -> f32 {
        self.0 as f32
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        sum(self.0 + other.0)
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        sum(self.0 - other.0)
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        rounded(self.0 * other.0)
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        rounded(self.0 / other.0)
    }
    #[inline(always)]
    fn square(self) -> Self {
        rounded(self.0 * self.0)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.0.sqrt();
        // Far from overflow, and from the least normal number.
        if root < OVERFLOW { Self(split(root)) } else { beyond(root) }
    }
    host_comparisons!();
    #[inline(always)]
    fn floor_scaled(self, log2: u32) -> i32 {
        floor(self.0 * power_of_two(log2 as i32))
    }
    #[inline(always)]
    fn from_scaled(integer: i32, log2: u32) -> Self {
        let exact = f64::from(integer) * power_of_two(-(log2 as i32));
        // Up to 2^17, whatever its sign.
        if integer.wrapping_add(1 << 17) as u32 <= 1 << 18 { Self(exact) } else { wide(integer, log2) }
    }
    #[inline(always)]
    fn dots<const N: usize>(rows: [&[Self; 3]; N], with: &[Self; 3]) -> [Self; N] {
        let products = rows.map(|row| [0, 1, 2].map(|i| Product::new(row[i], with[i])));
        let sums = products.map(|[a, b, c]| split(split(a.rounded + b.rounded) + c.rounded));
        let anchors = products.map(|[a, b, c]| a.anchor + b.anchor + c.anchor);
        if is_certain(anchors, sums) { sums.map(Self) } else { dots_rare(rows.map(|row| *row), *with) }
    }
    #[inline(always)]
    fn along(point: [Self; 2], direction: [Self; 2], t: Self) -> [Self; 2] {
        let products = direction.map(|direction| Product::new(direction, t));
        let sums = [0, 1].map(|axis| split(point[axis].0 + products[axis].rounded));
        let anchors = [0, 1].map(|axis| point[axis].0.abs() * COARSER + products[axis].anchor);
        if is_certain(anchors, sums) { sums.map(Self) } else { along_rare(point, direction, t) }
    }
    #[inline(always)]
    fn times_byte(self, byte: u8) -> u8 {
        // Clipping and rounding change places where all is clipped alike. A NaN becomes 0.
        let factor = if self.0 > 0.0 { self.0 } else { 0.0 };
        let factor = if factor < 256.0 { factor } else { 256.0 };
        // Digits that subnormals have not are far below one half.
        let product = split(f64::from(byte) * factor);
        let clipped = if product < 255.0 { product } else { 255.0 };
        // From 2^32 on an f64 has 20 binary digits after the point: all that a number from 1/8 on has, and less is not rounded to 1/2.
        ((clipped + (0.5 + (1u64 << 32) as f64)).to_bits() >> 20) as u8
    }
}

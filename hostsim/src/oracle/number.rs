//! The oracles' arithmetic: the host's own f32 and f64, and 1-7-16 as f64 rounded once. Cost: one to five ns an operation.

/// Arithmetic rounded to nearest even after every operation.
pub trait Number: Copy + PartialOrd {
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// From f32, rounded.
    fn from_f32(x: f32) -> Self;
    /// Exact: both formats fit into f64.
    fn to_f64(self) -> f64;
    /// As a word in device memory: the low bits, and one canonical NaN.
    fn to_bits(self) -> u32;
    /// Rounded sum.
    fn add(self, o: Self) -> Self;
    /// Rounded difference.
    fn sub(self, o: Self) -> Self;
    /// Rounded product.
    fn mul(self, o: Self) -> Self;
    /// Rounded quotient.
    fn div(self, o: Self) -> Self;
}

impl Number for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;

    #[inline]
    fn from_f32(x: f32) -> Self {
        x
    }
    fn to_f64(self) -> f64 {
        self.into()
    }
    fn to_bits(self) -> u32 {
        if self.is_nan() { 0x7fc0_0000 } else { Self::to_bits(self) }
    }
    #[inline]
    fn add(self, o: Self) -> Self {
        self + o
    }
    #[inline]
    fn sub(self, o: Self) -> Self {
        self - o
    }
    #[inline]
    fn mul(self, o: Self) -> Self {
        self * o
    }
    #[inline]
    fn div(self, o: Self) -> Self {
        self / o
    }
}

impl Number for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;

    fn from_f32(x: f32) -> Self {
        x.into()
    }
    fn to_f64(self) -> f64 {
        self
    }
    /// Of the nearest f32: words are not wider.
    fn to_bits(self) -> u32 {
        Number::to_bits(self as f32)
    }
    fn add(self, o: Self) -> Self {
        self + o
    }
    fn sub(self, o: Self) -> Self {
        self - o
    }
    fn mul(self, o: Self) -> Self {
        self * o
    }
    fn div(self, o: Self) -> Self {
        self / o
    }
}

/// A number of 1-7-16 bits, held in an f32, which has room for every one of them.
///
/// Each operation is that of f64 rounded once to 17 significant bits. That is exact: f64 has more than twice as many, and a sum,
/// product or quotient of two such numbers is never so near the middle of two others that the first rounding could hide
/// on which side it is.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Bits24(f32);

impl Bits24 {
    /// The bits f64 has in its fraction beyond 16.
    const SPARE: u32 = 52 - 16;
    /// 2^-62, the least normal number.
    const LEAST_NORMAL: f64 = f64::from_bits((1023 - 62) << 52);
    /// 2^64, the first number too large.
    const TOO_LARGE: f64 = f64::from_bits((1023 + 64) << 52);
    /// 1.5 · 2^52 times the least subnormal number, 2^-78: adding it leaves no room for bits below.
    const COARSE: f64 = 1.5 * f64::from_bits((1023 + 52 - 78) << 52);

    #[inline]
    fn round(x: f64) -> Self {
        let magnitude = x.abs();
        if (Self::LEAST_NORMAL..Self::TOO_LARGE).contains(&magnitude) {
            let bits = x.to_bits();
            let even = bits >> Self::SPARE & 1;
            let half = (1 << (Self::SPARE - 1)) - 1;
            let rounded = f64::from_bits((bits + half + even) & !((1 << Self::SPARE) - 1));
            return Self(if rounded.abs() >= Self::TOO_LARGE {
                f32::INFINITY.copysign(rounded as f32)
            } else {
                rounded as f32
            });
        }
        Self::round_rare(x)
    }

    #[cold]
    fn round_rare(x: f64) -> Self {
        Self(if x.is_nan() {
            f32::NAN
        } else if x.abs() >= Self::TOO_LARGE {
            f32::INFINITY.copysign(x as f32)
        } else {
            (((x.abs() + Self::COARSE) - Self::COARSE).copysign(x)) as f32
        })
    }
}

impl Number for Bits24 {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    fn from_f32(x: f32) -> Self {
        Self::round(x.into())
    }
    fn to_f64(self) -> f64 {
        self.0.into()
    }
    fn to_bits(self) -> u32 {
        let x = f64::from(self.0);
        let sign = u32::from(self.0.is_sign_negative()) << 23;
        if x.is_nan() {
            0x7f_8000
        } else if x.is_infinite() {
            sign | 0x7f_0000
        } else if x.abs() < Self::LEAST_NORMAL {
            // In units of the least subnormal number.
            sign | (x.abs() / Self::LEAST_NORMAL * 65536.0) as u32
        } else {
            let bits = x.to_bits();
            let exponent = (bits >> 52 & 0x7ff) as u32 + 63 - 1023;
            sign | exponent << 16 | (bits >> Self::SPARE & 0xffff) as u32
        }
    }
    #[inline]
    fn add(self, o: Self) -> Self {
        Self::round(f64::from(self.0) + f64::from(o.0))
    }
    #[inline]
    fn sub(self, o: Self) -> Self {
        Self::round(f64::from(self.0) - f64::from(o.0))
    }
    #[inline]
    fn mul(self, o: Self) -> Self {
        Self::round(f64::from(self.0) * f64::from(o.0))
    }
    #[inline]
    fn div(self, o: Self) -> Self {
        Self::round(f64::from(self.0) / f64::from(o.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landmarks() {
        let bits = |x: f64| Bits24::round(x).to_bits();
        let two = |e: i32| 2f64.powi(e);
        assert_eq!(bits(1.0), 0x3f_0000);
        assert_eq!(bits(-1.0), 0xbf_0000);
        assert_eq!(bits(1.0 / 3.0), 0x3d_5555);
        assert_eq!(bits(two(-62)), 0x01_0000);
        assert_eq!(bits(two(-78)), 0x00_0001);
        assert_eq!(bits((2.0 - two(-16)) * two(63)), 0x7e_ffff);
        assert_eq!(bits(two(64)), 0x7f_0000);
        assert_eq!(bits(f64::NEG_INFINITY), 0xff_0000);
        assert_eq!(bits(f64::NAN), 0x7f_8000);
        assert_eq!(bits(-0.0), 0x80_0000);
    }

    #[test]
    fn ties_go_to_even() {
        let bits = |x: f64| Bits24::round(x).to_bits();
        let two = |e: i32| 2f64.powi(e);
        assert_eq!(bits(1.0 + two(-17)), 0x3f_0000);
        assert_eq!(bits(1.0 + 3.0 * two(-17)), 0x3f_0002);
        // The half below the least subnormal goes to zero, anything more to it; the sign stays.
        assert_eq!(bits(-two(-79)), 0x80_0000);
        assert_eq!(bits(two(-79) * 1.001), 0x00_0001);
        assert_eq!(bits(3.0 * two(-79)), 0x00_0002);
        // Carry into the exponent: from subnormal to normal, and over the top.
        assert_eq!(bits(two(-62) - two(-80)), 0x01_0000);
        assert_eq!(bits((2.0 - two(-17)) * two(63)), 0x7f_0000);
        assert_eq!(bits((2.0 - two(-17) - two(-30)) * two(63)), 0x7e_ffff);
    }

    #[test]
    fn every_pattern_survives() {
        for pattern in 0u32..1 << 24 {
            let fraction = f64::from(pattern & 0xffff);
            let exponent = (pattern >> 16 & 0x7f) as i32;
            let sign = if pattern >> 23 == 1 { -1.0 } else { 1.0 };
            if exponent == 0x7f {
                continue;
            }
            let x = if exponent == 0 {
                fraction * 2f64.powi(-78)
            } else {
                (65536.0 + fraction) * 2f64.powi(exponent - 63 - 16)
            };
            assert_eq!(Bits24::round(sign * x).to_bits(), pattern);
        }
    }

    #[test]
    fn nan_of_the_host_is_made_canonical() {
        let nan = Number::div(f32::ZERO, f32::ZERO);
        assert_eq!(Number::to_bits(nan), 0x7fc0_0000);
        assert_eq!(Bits24::ZERO.div(Bits24::ZERO).to_bits(), 0x7f_8000);
    }
}

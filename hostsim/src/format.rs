//! Number formats that the host computes for the device; in: the same bits as the soft formats, out: the same bits; cost: one
//! host operation, and for F24 one rounding.
//!
//! [`HostF32`] is the host's own f32. [`HostF24`] computes in f64 and rounds once to 1-7-16, which is exact because
//! 53 >= 2·17 + 2. Both are chosen for speed only, and tests hold them against the soft formats.

use lucerna_softfloat::{F24, F32, Format, FormatCode};

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

/// The host's f32, its NaN made canonical where bits leave it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HostF32(f32);

impl Format for HostF32 {
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
    let magnitude = x.abs();
    if (LEAST_NORMAL..OVERFLOW).contains(&magnitude) {
        let bits = x.to_bits();
        let to_even = (1u64 << (SPARE - 1)) - 1 + (bits >> SPARE & 1);
        let nearest = f64::from_bits((bits + to_even) >> SPARE << SPARE);
        return HostF24(if nearest.abs() >= OVERFLOW { f64::INFINITY.copysign(x) } else { nearest });
    }
    if x == 0.0 { HostF24(x) } else { rounded_rare(x) }
}

/// Subnormals, infinities, NaN.
#[cold]
fn rounded_rare(x: f64) -> HostF24 {
    HostF24(if x.is_nan() {
        f64::NAN
    } else if x.abs() >= OVERFLOW {
        f64::INFINITY.copysign(x)
    } else {
        // At 1.5·2^52 quanta, an f64's last bit is one quantum: the addition rounds to a whole number of them.
        let anchor = 1.5 * QUANTUM * (1u64 << 52) as f64;
        ((x.abs() + anchor) - anchor).copysign(x)
    })
}

impl Format for HostF24 {
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
    host_arithmetic!(rounded);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Bits with all exponents, and the special values more often than chance has them.
    fn bits(width: u32) -> impl Strategy<Value = u32> {
        let special =
            prop::sample::select(vec![0u32, 1, 2, 0x7f_ffff, 0x80_0000, 0x80_0001, 0x01_0000, 0x00_ffff]);
        let top = if width == 24 { 0x7f_0000u32 } else { 0x7f80_0000 };
        prop_oneof![6 => any::<u32>(), 1 => special, 1 => Just(top), 1 => Just(top | 0x4000), 1 => Just(top - 1)]
            .prop_map(move |bits| if width == 24 { bits & 0xff_ffff } else { bits })
    }

    fn same<H: Format, S: Format>(a: u32, b: u32) -> Result<(), TestCaseError> {
        let (ha, hb, sa, sb) = (H::from_bits(a), H::from_bits(b), S::from_bits(a), S::from_bits(b));
        let host = [ha.add(hb), ha.sub(hb), ha.mul(hb), ha.div(hb), ha.square(), ha.sqrt()].map(H::to_bits);
        let soft = [sa.add(sb), sa.sub(sb), sa.mul(sb), sa.div(sb), sa.square(), sa.sqrt()].map(S::to_bits);
        prop_assert_eq!(host, soft, "{:08x} {:08x}", a, b);
        prop_assert_eq!((ha.lt(hb), ha.le(hb), ha.eq(hb)), (sa.lt(sb), sa.le(sb), sa.eq(sb)));
        let x = f32::from_bits(a);
        prop_assert_eq!(H::from_f32(x).to_bits(), S::from_f32(x).to_bits());
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200_000))]
        #[test]
        fn f32_is_the_soft_one((a, b) in (bits(32), bits(32))) {
            same::<HostF32, F32>(a, b)?;
        }
        #[test]
        fn f24_is_the_soft_one((a, b) in (bits(24), bits(24))) {
            same::<HostF24, F24>(a, b)?;
        }
        /// Results near the least normal and near overflow.
        #[test]
        fn f24_at_its_edges((a, b) in (bits(24), prop::sample::select(vec![0x20_0000u32, 0x1f_ffff, 0x5f_0001, 0x3f_0000]))) {
            same::<HostF24, F24>(a, b)?;
            same::<HostF24, F24>(0x20_0000 | a & 0xffff, b)?;
        }
    }
}

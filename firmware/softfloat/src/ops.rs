//! Operators and printing: `a + b` is `a.add(b)`; a number prints as its bits and its value.

use crate::Float;
use core::{fmt, ops};

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl<const EXP: u32, const FRAC: u32> ops::$trait for Float<EXP, FRAC> {
            type Output = Self;
            #[inline]
            fn $method(self, other: Self) -> Self {
                Float::$method(self, other)
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<const EXP: u32, const FRAC: u32> ops::Neg for Float<EXP, FRAC> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Float::neg(self)
    }
}

impl<const EXP: u32, const FRAC: u32> fmt::Debug for Float<EXP, FRAC> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = Self::WIDTH.div_ceil(4) as usize;
        write!(f, "{:0digits$X} ({:?})", self.to_bits(), self.to_f32())
    }
}

/// As the host's `f32` of the same value prints.
impl<const EXP: u32, const FRAC: u32> fmt::Display for Float<EXP, FRAC> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.to_f32(), f)
    }
}

#[cfg(feature = "defmt")]
impl<const EXP: u32, const FRAC: u32> defmt::Format for Float<EXP, FRAC> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{=u32:X} ({=f32})", self.to_bits(), self.to_f32());
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for crate::Flags {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{=u8:X}", self.bits());
    }
}

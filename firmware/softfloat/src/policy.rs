//! What IEEE 754 leaves to the builder, said explicitly: in, a choice; out, nothing.

/// What becomes of numbers below the least normal one.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Subnormals {
    /// IEEE 754: they lose precision gradually.
    #[default]
    Gradual,
    /// A subnormal operand is read as a zero of its sign, silently; a result that is still below the least normal
    /// number *after rounding* becomes a zero of its sign and raises underflow and inexact. This is what x86 does with
    /// DAZ and FTZ set. (Flushing before rounding would differ in multiplication only.)
    Flush,
}

/// How an operation treats what the standard leaves open.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Policy {
    /// What becomes of subnormal operands and results.
    pub subnormals: Subnormals,
}

impl Policy {
    /// IEEE 754 as written.
    pub const GRADUAL: Policy = Policy { subnormals: Subnormals::Gradual };
    /// Subnormals flushed to zero, on input and output.
    pub const FLUSH: Policy = Policy { subnormals: Subnormals::Flush };

    pub(crate) const fn flushes(self) -> bool {
        matches!(self.subnormals, Subnormals::Flush)
    }
}

/// How a fraction is dropped in a conversion to an integer.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Rounding {
    /// To the nearest integer, ties to the even one.
    #[default]
    NearestEven,
    /// Towards zero, as a cast does.
    TowardZero,
}

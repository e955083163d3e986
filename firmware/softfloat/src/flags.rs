//! IEEE exception flags, returned with a value rather than kept in a global: in, nothing; out, five bits.

/// The five IEEE 754 exceptions as a bit set, numbered as Berkeley TestFloat and RISC-V `fflags` number them.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default)]
#[must_use]
pub struct Flags(u8);

impl Flags {
    /// No exception: the result is exact.
    pub const NONE: Flags = Flags(0);
    /// The result was rounded.
    pub const INEXACT: Flags = Flags(0x01);
    /// The result is inexact and, rounded as if exponents had no bound, below the least normal number.
    pub const UNDERFLOW: Flags = Flags(0x02);
    /// The result, rounded as if exponents had no bound, is beyond the largest number.
    pub const OVERFLOW: Flags = Flags(0x04);
    /// An exact infinity from finite operands.
    pub const DIVIDE_BY_ZERO: Flags = Flags(0x08);
    /// An operand was a signalling NaN, or the operation has no meaningful result.
    pub const INVALID: Flags = Flags(0x10);

    /// The set with these bits; bits beyond the five are dropped.
    pub const fn from_bits(bits: u8) -> Flags {
        Flags(bits & 0x1F)
    }

    /// The bits: inexact 01, underflow 02, overflow 04, divide by zero 08, invalid 10.
    #[must_use]
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// Both sets together.
    #[inline]
    pub const fn union(self, other: Flags) -> Flags {
        Flags(self.0 | other.0)
    }

    /// Whether every flag of `other` is here.
    #[must_use]
    pub const fn contains(self, other: Flags) -> bool {
        self.0 & other.0 == other.0
    }

    /// Whether nothing was raised.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// `self` when `raised`, else nothing; without a branch, as this sits on every operation's path.
    #[inline(always)]
    pub(crate) const fn when(self, raised: bool) -> Flags {
        Flags(self.0 & (raised as u8).wrapping_neg())
    }
}

impl core::ops::BitOr for Flags {
    type Output = Flags;
    fn bitor(self, other: Flags) -> Flags {
        self.union(other)
    }
}

impl core::ops::BitOrAssign for Flags {
    fn bitor_assign(&mut self, other: Flags) {
        *self = self.union(other);
    }
}

impl core::fmt::Debug for Flags {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        const NAMES: [&str; 5] = ["INEXACT", "UNDERFLOW", "OVERFLOW", "DIVIDE_BY_ZERO", "INVALID"];
        let mut separator = "";
        for (bit, name) in NAMES.iter().enumerate() {
            if self.0 >> bit & 1 == 1 {
                write!(f, "{separator}{name}")?;
                separator = " | ";
            }
        }
        if self.is_empty() { f.write_str("NONE") } else { Ok(()) }
    }
}

/// A value with the exceptions met in making it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[must_use]
pub struct Flagged<T> {
    /// The result.
    pub value: T,
    /// The exceptions raised.
    pub flags: Flags,
}

impl<T: Copy> Flagged<T> {
    #[inline(always)]
    pub(crate) const fn new(value: T, flags: Flags) -> Self {
        Flagged { value, flags }
    }

    /// The value changed, the flags kept.
    #[inline]
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Flagged<U> {
        Flagged { value: change(self.value), flags: self.flags }
    }

    /// An exact result.
    #[inline(always)]
    pub(crate) const fn exact(value: T) -> Self {
        Flagged { value, flags: Flags::NONE }
    }
}

//! What a register is: bits, total over nonsense. In: any 32-bit word. Out: fields of it. Cost: a shift and a mask.
//!
//! The generated types are made of these. Nothing here touches a bus: a driver takes the offset and the bits to its bus, a
//! device gets them from there.

use core::fmt;

/// A register with fields: a newtype over its 32 bits.
///
/// Every word is a value of it, also one which no legal setting gives; an illegal encoding shows when its field is read.
pub trait Register: Copy + Eq + Default + fmt::Debug {
    /// Name with its block, as in the documents: `pree.CONFIG`.
    const NAME: &'static str;
    /// Byte offset from the start of the map.
    const OFFSET: u32;
    /// Value after reset; bits which the build of a device decides are 0.
    const RESET: u32;
    /// Bits which belong to a field that reads as something.
    const READABLE: u32;
    /// Bits which belong to a field that a write changes or acts on.
    const WRITABLE: u32;

    /// Takes a word as it is, unused bits included.
    fn from_bits(bits: u32) -> Self;
    /// The word.
    fn bits(self) -> u32;
}

/// Where a field lies in its register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name as in the documents: `HAZARD`.
    pub name: &'static str,
    /// Number of its lowest bit.
    pub shift: u32,
    /// Bits it has, 1 to 32.
    pub width: u32,
}

impl Field {
    /// The bits of the register it takes.
    pub const fn mask(self) -> u32 {
        (u32::MAX >> (32 - self.width)) << self.shift
    }

    /// Its value in a register's word.
    pub const fn get(self, word: u32) -> u32 {
        (word & self.mask()) >> self.shift
    }

    /// The word with its value replaced; upper bits of a value too wide are dropped.
    #[must_use]
    pub const fn put(self, word: u32, value: u32) -> u32 {
        (word & !self.mask()) | ((value << self.shift) & self.mask())
    }
}

/// A register as a table entry, for traces, register dumps, fuzzers and tests.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// Name with its block: `window[2].BASE`.
    pub name: &'static str,
    /// Byte offset from the start of the map.
    pub offset: u32,
    /// Value after reset; bits which the build of a device decides are 0.
    pub reset: u32,
    /// Bits a read gives; all others read as 0.
    pub readable: u32,
    /// Bits a write changes or acts on; all others are ignored.
    pub writable: u32,
    /// Bits which act once when 1 is written, and read as 0.
    pub pulses: u32,
    /// Bits which are cleared by writing 1.
    pub clears: u32,
    /// Its fields, from the lowest bit up.
    pub fields: &'static [Field],
}

/// A block of registers as a table entry.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Name: `pree`.
    pub name: &'static str,
    /// Byte offset of the first instance.
    pub base: u32,
    /// Instances, 1 unless the block is an array.
    pub count: u32,
    /// Bytes from an instance to the next; the size of the block if there is one instance.
    pub stride: u32,
}

/// A half of a 64-bit counter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Half {
    /// Bits 31 to 0.
    Low,
    /// Bits 63 to 32.
    High,
}

impl Half {
    /// These 32 bits of a count.
    pub const fn of(self, count: u64) -> u32 {
        match self {
            Self::Low => count as u32,
            Self::High => (count >> 32) as u32,
        }
    }
}

/// A field holds bits which its encoding does not define.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Illegal {
    /// The field's value.
    pub bits: u32,
}

impl fmt::Display for Illegal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "illegal field value {}", self.bits)
    }
}

impl core::error::Error for Illegal {}

//! The device's side. In: the accesses of a bus, clocks. Out: words, the interrupt line. Cost: the device's.

use core::fmt;

/// A device a [`Model`](crate::Model) can drive: registers, memory, a clock and an interrupt line.
pub trait Target {
    /// Reads the register at byte `offset`.
    fn read(&mut self, offset: u32) -> Result<u32, TargetError>;

    /// Writes the register at byte `offset`.
    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError>;

    /// Reads device memory from byte `address`; nothing changes.
    fn load(&self, address: u32, words: &mut [u32]) -> Result<(), TargetError>;

    /// Writes device memory from byte `address`; all of the words or, on an error, none.
    fn store(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError>;

    /// One clock: the truth.
    fn tick(&mut self);

    /// The state after `cycles` ticks, reached faster.
    fn advance(&mut self, cycles: u64) {
        for _ in 0..cycles {
            self.tick();
        }
    }

    /// The level of the interrupt line.
    fn interrupt(&self) -> bool;
}

/// A device that is lent stays where it is: one too large to move need not be.
impl<T: Target + ?Sized> Target for &mut T {
    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        T::read(self, offset)
    }
    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        T::write(self, offset, value)
    }
    fn load(&self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
        T::load(self, address, words)
    }
    fn store(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
        T::store(self, address, words)
    }
    fn tick(&mut self) {
        T::tick(self);
    }
    fn advance(&mut self, cycles: u64) {
        T::advance(self, cycles);
    }
    fn interrupt(&self) -> bool {
        T::interrupt(self)
    }
}

/// Why a device does not answer an access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum TargetError {
    /// No register has this offset.
    Unmapped,
    /// The offset or address is not a multiple of 4.
    Misaligned,
    /// A word of the block lies outside device memory.
    OutOfRange,
}

impl fmt::Display for TargetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unmapped => "no register has this offset: check it against the register map",
            Self::Misaligned => "the address is not a multiple of 4: align it to a word",
            Self::OutOfRange => "the block leaves device memory: keep it below MEMORY_BYTES",
        })
    }
}

impl core::error::Error for TargetError {}

/// The plainest target, for this crate's tests: registers and memory that keep what is written, and an
/// interrupt after a set clock.
#[cfg(test)]
pub(crate) mod ram {
    use super::{Target, TargetError};

    #[derive(Clone, Debug, Default, PartialEq, Eq)]
    pub(crate) struct Ram {
        pub(crate) registers: [u32; 8],
        pub(crate) memory: [u32; 16],
        pub(crate) clock: u64,
        pub(crate) interrupt_at: Option<u64>,
    }

    fn range(address: u32, count: usize, size: usize) -> Result<core::ops::Range<usize>, TargetError> {
        if !address.is_multiple_of(4) {
            return Err(TargetError::Misaligned);
        }
        let first = address as usize / 4;
        if first + count > size { Err(TargetError::OutOfRange) } else { Ok(first..first + count) }
    }

    impl Target for Ram {
        fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
            Ok(self.registers[range(offset, 1, 8)?][0])
        }

        fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
            self.registers[range(offset, 1, 8)?][0] = value;
            Ok(())
        }

        fn load(&self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
            words.copy_from_slice(&self.memory[range(address, words.len(), 16)?]);
            Ok(())
        }

        fn store(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
            self.memory[range(address, words.len(), 16)?].copy_from_slice(words);
            Ok(())
        }

        fn tick(&mut self) {
            self.clock += 1;
        }

        fn interrupt(&self) -> bool {
            self.interrupt_at.is_some_and(|at| self.clock >= at)
        }
    }
}

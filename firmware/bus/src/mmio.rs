//! Registers and device memory mapped into the address space. In: offsets and addresses, checked against the
//! two mapped lengths. Out: words. Cost: one volatile access a word, one fence a register access.
//!
//! The only `unsafe` of the project's libraries is in this file.
#![allow(unsafe_code)]

use core::fmt;
use core::ptr::NonNull;
use core::sync::atomic::{Ordering, fence};

use crate::Bus;

/// A run of mapped words: every use is checked against its length, so that no safe call can leave it.
#[derive(Debug)]
struct Window {
    base: NonNull<u32>,
    words: usize,
}

impl Window {
    /// The pointer to the first of `count` words at byte `offset`.
    fn at(&self, offset: u32, count: usize) -> Result<NonNull<u32>, MmioError> {
        if !offset.is_multiple_of(4) {
            return Err(MmioError::Misaligned);
        }
        let first = offset as usize / 4;
        if first > self.words || count > self.words - first {
            return Err(MmioError::OutOfRange);
        }
        // SAFETY: first <= words, and `Mmio::new`'s caller vouches for `words` words from `base`.
        Ok(unsafe { self.base.add(first) })
    }
}

/// A memory-mapped device.
#[derive(Debug)]
pub struct Mmio {
    registers: Window,
    memory: Window,
}

// SAFETY: the two windows belong to this value alone (see `Mmio::new`), and a mapped device is the same seen
// from every thread or interrupt level.
unsafe impl Send for Mmio {}

impl Mmio {
    /// A device whose registers and memory are mapped at these places, lengths in bytes (whole words count).
    ///
    /// # Safety
    /// Both windows must be mapped, aligned to 4, valid for volatile 32-bit reads and writes for as long as
    /// the value lives, and used by nobody but the device and this value.
    pub const unsafe fn new(
        registers: NonNull<u32>,
        register_bytes: u32,
        memory: NonNull<u32>,
        memory_bytes: u32,
    ) -> Self {
        Self {
            registers: Window { base: registers, words: register_bytes as usize / 4 },
            memory: Window { base: memory, words: memory_bytes as usize / 4 },
        }
    }
}

impl Bus for Mmio {
    type Error = MmioError;

    fn read(&mut self, offset: u32) -> Result<u32, MmioError> {
        let register = self.registers.at(offset, 1)?;
        // SAFETY: `at` has checked that one word of the register window lies here.
        let value = unsafe { register.read_volatile() };
        // What the register says of memory (done, ring space) holds for the memory reads that follow.
        fence(Ordering::SeqCst);
        Ok(value)
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), MmioError> {
        let register = self.registers.at(offset, 1)?;
        // A doorbell must not overtake the records it announces.
        fence(Ordering::SeqCst);
        // SAFETY: `at` has checked that one word of the register window lies here.
        unsafe { register.write_volatile(value) };
        Ok(())
    }

    fn read_block(&mut self, address: u32, words: &mut [u32]) -> Result<(), MmioError> {
        let base = self.memory.at(address, words.len())?;
        for (index, word) in words.iter_mut().enumerate() {
            // SAFETY: `at` has checked `words.len()` words of the memory window from here.
            *word = unsafe { base.add(index).read_volatile() };
        }
        Ok(())
    }

    fn write_block(&mut self, address: u32, words: &[u32]) -> Result<(), MmioError> {
        let base = self.memory.at(address, words.len())?;
        for (index, word) in words.iter().enumerate() {
            // SAFETY: `at` has checked `words.len()` words of the memory window from here.
            unsafe { base.add(index).write_volatile(*word) };
        }
        Ok(())
    }
}

/// Why an access was not made; the device has seen nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum MmioError {
    /// The offset or address is not a multiple of 4.
    Misaligned,
    /// The access leaves the mapped window.
    OutOfRange,
}

impl fmt::Display for MmioError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Misaligned => "the address is not a multiple of 4: align it to a word",
            Self::OutOfRange => {
                "the access leaves the mapped window: map more of the device, or ask for less"
            }
        })
    }
}

impl core::error::Error for MmioError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn over(registers: &mut [u32], memory: &mut [u32]) -> Mmio {
        let sizes = (registers.len() as u32 * 4, memory.len() as u32 * 4);
        let at = |words: &mut [u32]| NonNull::new(words.as_mut_ptr()).unwrap();
        // SAFETY: each test keeps both arrays alive, and to this bus alone, until its last access.
        unsafe { Mmio::new(at(registers), sizes.0, at(memory), sizes.1) }
    }

    #[test]
    fn reads_and_writes_reach_the_mapped_words() {
        let (mut registers, mut memory) = ([7, 8, 9], [0; 8]);
        let mut bus = over(&mut registers, &mut memory);
        assert_eq!(bus.read(8), Ok(9));
        bus.write(4, 80).unwrap();
        bus.write_block(20, &[1, 2, 3]).unwrap();
        let mut back = [0; 4];
        bus.read_block(16, &mut back).unwrap();
        assert_eq!(back, [0, 1, 2, 3]);
        assert_eq!(registers, [7, 80, 9]);
        assert_eq!(memory, [0, 0, 0, 0, 0, 1, 2, 3]);
    }

    #[test]
    fn no_safe_call_leaves_a_window() {
        let (mut registers, mut memory) = ([0; 2], [0; 4]);
        let mut bus = over(&mut registers, &mut memory);
        assert_eq!(bus.read(8), Err(MmioError::OutOfRange));
        assert_eq!(bus.read(u32::MAX - 3), Err(MmioError::OutOfRange));
        assert_eq!(bus.read(1), Err(MmioError::Misaligned));
        assert_eq!(bus.write(8, 1), Err(MmioError::OutOfRange));
        assert_eq!(bus.write_block(8, &[1; 3]), Err(MmioError::OutOfRange));
        assert_eq!(bus.write_block(2, &[1]), Err(MmioError::Misaligned));
        assert_eq!(bus.read_block(20, &mut []), Err(MmioError::OutOfRange));
        assert_eq!(bus.read_block(16, &mut []), Ok(()), "nothing from the very end is still inside");
        assert_eq!(bus.read_block(u32::MAX - 3, &mut [0; 2]), Err(MmioError::OutOfRange));
        assert_eq!(memory, [0; 4]);
    }
}

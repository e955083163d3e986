//! The driver's side. In: a register's byte offset, or a device-memory byte address and words. Out: words, or
//! the back end's error. Cost: one bus access a call.

/// A way to a device: its 32-bit registers by byte offset, its memory by byte address.
///
/// Every call is one access; a failed one may or may not have reached the device (the answer may be what was
/// lost), so whoever sees an error must treat the device's state as unknown.
pub trait Bus {
    /// What a failed access says.
    type Error: core::fmt::Debug + Copy;

    /// Reads the register at byte `offset`.
    fn read(&mut self, offset: u32) -> Result<u32, Self::Error>;

    /// Writes the register at byte `offset`.
    fn write(&mut self, offset: u32, value: u32) -> Result<(), Self::Error>;

    /// Reads consecutive words of device memory from byte `address`, a multiple of 4.
    fn read_block(&mut self, address: u32, words: &mut [u32]) -> Result<(), Self::Error>;

    /// Writes consecutive words of device memory from byte `address`, a multiple of 4. All words are in device
    /// memory before the next register access takes effect, so a doorbell may follow at once.
    fn write_block(&mut self, address: u32, words: &[u32]) -> Result<(), Self::Error>;
}

impl<B: Bus + ?Sized> Bus for &mut B {
    type Error = B::Error;

    fn read(&mut self, offset: u32) -> Result<u32, B::Error> {
        (**self).read(offset)
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), B::Error> {
        (**self).write(offset, value)
    }

    fn read_block(&mut self, address: u32, words: &mut [u32]) -> Result<(), B::Error> {
        (**self).read_block(address, words)
    }

    fn write_block(&mut self, address: u32, words: &[u32]) -> Result<(), B::Error> {
        (**self).write_block(address, words)
    }
}

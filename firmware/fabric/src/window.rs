//! Memory windows; in: base and limit registers, out: buffers that lie wholly inside one; cost: one compare at a job's start.
//!
//! A unit never forms an address of its own: it indexes a [`Buffer`], and a `Buffer` is only made by
//! [`Windows::buffer`], which checks it. So nothing outside the windows can be touched, whatever the registers say.

/// Why a buffer was refused.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BufferError {
    /// Its base is not a multiple of four, or no single window holds all of it.
    Outside,
    /// Its size in bytes, or its end, does not fit 32 bits.
    TooLarge,
}

/// Byte addresses `base..limit`; empty when `limit <= base`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Window {
    /// The first byte address inside.
    pub base: u32,
    /// The first byte address outside.
    pub limit: u32,
}

/// The windows a device may touch, clipped to its memory.
#[derive(Clone, Copy, Debug)]
pub struct Windows<const COUNT: usize> {
    windows: [Window; COUNT],
    memory_bytes: u32,
}

impl<const COUNT: usize> Windows<COUNT> {
    /// `memory_bytes` is the size of the memory: no window reaches beyond it.
    pub const fn new(windows: [Window; COUNT], memory_bytes: u32) -> Self {
        Self { windows, memory_bytes }
    }

    /// `count` records of `stride` words from byte address `base` on, if one window holds them all.
    ///
    /// # Errors
    /// [`BufferError`]; a buffer of no record is refused only when its base is misaligned.
    pub fn buffer(&self, base: u32, count: u32, stride: u32) -> Result<Buffer, BufferError> {
        let words = count.checked_mul(stride).ok_or(BufferError::TooLarge)?;
        let bytes = words.checked_mul(4).ok_or(BufferError::TooLarge)?;
        let end = base.checked_add(bytes).ok_or(BufferError::TooLarge)?;
        let holds = |window: &Window| base >= window.base && end <= window.limit.min(self.memory_bytes);
        if !base.is_multiple_of(4) || (bytes > 0 && !self.windows.iter().any(holds)) {
            return Err(BufferError::Outside);
        }
        Ok(Buffer { first: base / 4, count, stride })
    }
}

/// `count` records of `stride` words, all inside one window.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Buffer {
    first: u32,
    count: u32,
    stride: u32,
}

impl Buffer {
    /// A buffer of no record.
    pub const EMPTY: Self = Self { first: 0, count: 0, stride: 1 };

    /// How many records it has.
    #[inline]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// The byte address of a record, also of one past the end (for fault reports).
    #[inline]
    pub const fn address(&self, record: u32) -> u32 {
        self.first.wrapping_add(record.wrapping_mul(self.stride)).wrapping_mul(4)
    }

    /// `W` words of a record, from word `offset` of it on; `None` when there is no such record or it is shorter.
    #[inline]
    pub fn read<'m, const W: usize>(
        &self,
        memory: &'m [u32],
        record: u32,
        offset: u32,
    ) -> Option<&'m [u32; W]> {
        let first = self.word(record, offset, W)?;
        memory.get(first..)?.first_chunk()
    }

    /// The same, to be written.
    #[inline]
    pub fn write<'m, const W: usize>(
        &self,
        memory: &'m mut [u32],
        record: u32,
        offset: u32,
    ) -> Option<&'m mut [u32; W]> {
        let first = self.word(record, offset, W)?;
        memory.get_mut(first..)?.first_chunk_mut()
    }

    /// All records, when they are `W` words each; else none.
    #[inline]
    pub fn records<'m, const W: usize>(&self, memory: &'m [u32]) -> &'m [[u32; W]] {
        let words = self.count as usize * self.stride as usize;
        let first = self.first as usize;
        match memory.get(first..first + words) {
            Some(words) if W == self.stride as usize => words.as_chunks().0,
            _ => &[],
        }
    }

    #[inline]
    fn word(&self, record: u32, offset: u32, words: usize) -> Option<usize> {
        (record < self.count && offset as usize + words <= self.stride as usize)
            .then(|| self.first as usize + record as usize * self.stride as usize + offset as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::{Buffer, BufferError, Window, Windows};

    const WINDOWS: Windows<2> =
        Windows::new([Window { base: 16, limit: 48 }, Window { base: 64, limit: 4096 }], 128);

    #[test]
    fn a_buffer_lies_in_one_window_to_the_last_byte() {
        assert!(WINDOWS.buffer(16, 2, 4).is_ok());
        assert_eq!(WINDOWS.buffer(16, 9, 1), Err(BufferError::Outside));
        assert_eq!(WINDOWS.buffer(12, 1, 1), Err(BufferError::Outside));
        assert_eq!(WINDOWS.buffer(18, 1, 1), Err(BufferError::Outside));
        assert_eq!(WINDOWS.buffer(44, 1, 8), Err(BufferError::Outside), "across two windows");
    }

    #[test]
    fn a_window_does_not_reach_beyond_the_memory() {
        assert!(WINDOWS.buffer(64, 16, 1).is_ok());
        assert_eq!(WINDOWS.buffer(64, 17, 1), Err(BufferError::Outside));
    }

    #[test]
    fn sizes_that_overflow_are_refused() {
        assert_eq!(WINDOWS.buffer(64, u32::MAX, 16), Err(BufferError::TooLarge));
        assert_eq!(WINDOWS.buffer(64, u32::MAX / 4, 1), Err(BufferError::TooLarge));
    }

    #[test]
    fn records_outside_are_not_there() {
        let memory = [0u32; 32];
        let buffer = WINDOWS.buffer(16, 2, 4).unwrap();
        assert!(buffer.read::<4>(&memory, 1, 0).is_some());
        assert!(buffer.read::<4>(&memory, 2, 0).is_none());
        assert!(buffer.read::<4>(&memory, 1, 1).is_none(), "over the record's end");
        assert!(Buffer::EMPTY.read::<1>(&memory, 0, 0).is_none());
    }
}

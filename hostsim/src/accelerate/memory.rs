//! The device's memory on a host; in: a size, out: zeroed words on a cache-line boundary; cost: the words.

/// Words in a host's cache line, and in a hit point.
const LINE_WORDS: usize = 16;

/// Words whose first one begins a cache line, so that a hit point never lies across two.
#[derive(Debug)]
pub struct HostMemory {
    words: Vec<u32>,
    skip: usize,
    len: usize,
}

/// The words of so many bytes, if 32-bit addresses reach them.
pub fn words(bytes: u64) -> Option<usize> {
    u32::try_from(bytes).ok().map(|bytes| bytes.div_ceil(4) as usize)
}

impl HostMemory {
    /// Zeros.
    pub fn new(len: usize) -> Self {
        let words = vec![0; len + LINE_WORDS];
        let skip = words.as_ptr().align_offset(4 * LINE_WORDS).min(LINE_WORDS);
        Self { words, skip, len }
    }
}

impl AsRef<[u32]> for HostMemory {
    #[inline]
    fn as_ref(&self) -> &[u32] {
        &self.words[self.skip..][..self.len]
    }
}

impl AsMut<[u32]> for HostMemory {
    #[inline]
    fn as_mut(&mut self) -> &mut [u32] {
        &mut self.words[self.skip..][..self.len]
    }
}

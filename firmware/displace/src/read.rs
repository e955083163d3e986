//! Texture and normal read (§4.1); in: two addresses, out: two texels; cost: two cycles, and what the memory takes on a miss.
//!
//! One unified cache with one port: the texture's word in one cycle, the normal map's in the next. It blocks: in this
//! semi-pipelined unit nothing could overtake a miss. As in the height cache, the line on its way in is forwarded (P17).

use lucerna_fabric::cache::Tags;
use lucerna_fabric::window::Buffer;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::{Job, Map};
use crate::record::RESULT_WORDS;

/// A hit on its way to its colour.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Fetch {
    /// The ray's number in the job.
    pub number: u32,
    /// Its steps.
    pub steps: u32,
    /// All of its result but the colour.
    pub result: [u32; RESULT_WORDS as usize],
    /// Number of the texture's word before the read, the word after it.
    pub texture: u32,
    /// Of the normal map's.
    pub normal: u32,
}

/// What is done next.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Next {
    /// Nothing: there is no hit.
    Idle,
    /// The texture is read.
    Texture,
    /// The normal map is read.
    Normal,
    /// Both are handed on.
    Done,
}

/// The read unit with its cache.
#[derive(Clone, Debug)]
pub struct Read<const LINES: usize> {
    next: Next,
    fetch: Fetch,
    /// The line that is waited for.
    waiting: Option<u32>,
    /// It came in this cycle.
    served: bool,
    /// The texture and normal cache.
    pub cache: Tags<LINES>,
}

impl<const LINES: usize> Read<LINES> {
    /// An idle unit.
    pub fn new(cache: Tags<LINES>) -> Self {
        Self { next: Next::Idle, fetch: Fetch::default(), waiting: None, served: false, cache }
    }

    /// Drops what it does and empties the cache.
    pub fn clear(&mut self) {
        self.next = Next::Idle;
        self.waiting = None;
        self.served = false;
        self.cache.clear();
    }

    /// Whether it takes a hit.
    #[inline]
    pub fn is_idle(&self) -> bool {
        self.next == Next::Idle
    }

    /// Whether it waits for a line.
    #[inline]
    pub const fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// Whether both texels are there.
    #[inline]
    pub fn is_done(&self) -> bool {
        self.next == Next::Done
    }

    /// Gives both texels away.
    #[inline]
    pub fn take(&mut self) -> Option<Fetch> {
        if !self.is_done() {
            return None;
        }
        self.next = Next::Idle;
        Some(self.fetch)
    }

    /// Has both texels of a hit.
    #[cfg(feature = "shortcut")]
    #[inline]
    pub(crate) const fn hold(&mut self, fetch: Fetch) {
        (self.fetch, self.next) = (fetch, Next::Done);
    }

    /// Both accesses of a hit in an idle unit, if its lines are there: says so. If not, nothing has changed but what the access that
    /// finds its line changes again.
    #[cfg(feature = "shortcut")]
    #[inline]
    pub(crate) fn read_both<F: Format>(
        &mut self,
        fetch: &mut Fetch,
        job: &Job<F>,
        memory: &[u32],
        counters: &mut Counters,
    ) -> bool {
        let (texture, normals) = (&job.texture.words, &job.normals.words);
        let found = self.cache.lookup(texture.address(fetch.texture))
            && self.cache.lookup(normals.address(fetch.normal));
        if found {
            counters.read_busy += 2;
            counters.texture_accesses += 2;
            counters.texture_hits += 2;
            fetch.texture = word(texture, fetch.texture, memory);
            fetch.normal = word(normals, fetch.normal, memory);
        }
        found
    }

    /// Takes a hit; its first access is in this cycle.
    #[inline]
    pub fn begin(&mut self, fetch: Fetch) {
        self.fetch = fetch;
        self.next = Next::Texture;
    }

    /// A line has come.
    pub fn fill(&mut self, line: u32, counters: &mut Counters) {
        self.cache.fill(line);
        counters.texture_fills += 1;
        if self.waiting == Some(line) {
            self.waiting = None;
            self.served = true;
        }
    }

    /// This cycle's access, if there is one; gives the line that is to be asked for.
    #[inline]
    pub fn access<F: Format>(
        &mut self,
        job: &Job<F>,
        memory: &[u32],
        counters: &mut Counters,
    ) -> Option<u32> {
        if self.waiting.is_some() {
            counters.read_stalls += 1;
            return None;
        }
        match self.next {
            Next::Idle | Next::Done => None,
            Next::Texture => match self.look(&job.texture, self.fetch.texture, memory, counters) {
                Ok(texel) => {
                    (self.fetch.texture, self.next) = (texel, Next::Normal);
                    None
                }
                Err(line) => Some(line),
            },
            Next::Normal => match self.look(&job.normals, self.fetch.normal, memory, counters) {
                Ok(texel) => {
                    (self.fetch.normal, self.next) = (texel, Next::Done);
                    None
                }
                Err(line) => Some(line),
            },
        }
    }

    /// Reads a map's word, or begins to wait for its line and gives that.
    #[inline]
    fn look(&mut self, map: &Map, word: u32, memory: &[u32], counters: &mut Counters) -> Result<u32, u32> {
        counters.read_busy += 1;
        if !core::mem::take(&mut self.served) {
            let address = map.words.address(word);
            counters.texture_accesses += 1;
            if !self.cache.lookup(address) {
                counters.texture_misses += 1;
                let line = self.cache.line(address);
                self.waiting = Some(line);
                return Err(line);
            }
            counters.texture_hits += 1;
        }
        Ok(self::word(&map.words, word, memory))
    }
}

/// A word of a buffer.
#[inline]
fn word(buffer: &Buffer, number: u32, memory: &[u32]) -> u32 {
    buffer.read::<1>(memory, number, 0).map_or(0, |words| words[0])
}

//! Texture and normal read (§4.1); in: two addresses, out: two texels; cost: two cycles, and what the memory takes on a miss.
//!
//! One unified cache with one port: the texture's word in one cycle, the normal map's in the next. It blocks: in this
//! semi-pipelined unit nothing could overtake a miss. As in the height cache, the line on its way in is forwarded (P17).

use lucerna_fabric::cache::Tags;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::Job;
use crate::record::{Outcome, Status};

/// A hit on its way to its colour.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Fetch<F> {
    /// The ray's number in the job.
    pub number: u32,
    /// All of its result but the colour.
    pub outcome: Outcome<F>,
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
pub struct Read<F, const LINES: usize> {
    next: Next,
    fetch: Fetch<F>,
    /// The line that is waited for.
    waiting: Option<u32>,
    /// It came in this cycle.
    served: bool,
    /// The texture and normal cache.
    pub cache: Tags<LINES>,
}

impl<F: Format, const LINES: usize> Read<F, LINES> {
    /// An idle unit.
    pub fn new(cache: Tags<LINES>) -> Self {
        let fetch =
            Fetch { number: 0, outcome: Outcome::untraversed(Status::Miss, 0), texture: 0, normal: 0 };
        Self { next: Next::Idle, fetch, waiting: None, served: false, cache }
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
    pub fn take(&mut self) -> Option<Fetch<F>> {
        if !self.is_done() {
            return None;
        }
        self.next = Next::Idle;
        Some(self.fetch)
    }

    /// Takes a hit; its first access is in this cycle.
    #[inline]
    pub fn begin(&mut self, fetch: Fetch<F>) {
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
    pub fn access(&mut self, job: &Job<F>, memory: &[u32], counters: &mut Counters) -> Option<u32> {
        let (map, word) = match self.next {
            Next::Texture => (&job.texture, &mut self.fetch.texture),
            Next::Normal => (&job.normals, &mut self.fetch.normal),
            Next::Idle | Next::Done => return None,
        };
        if self.waiting.is_some() {
            counters.read_stalls += 1;
            return None;
        }
        counters.read_busy += 1;
        if !core::mem::take(&mut self.served) {
            let address = map.words.address(*word);
            counters.texture_accesses += 1;
            if !self.cache.lookup(address) {
                counters.texture_misses += 1;
                let line = self.cache.line(address);
                self.waiting = Some(line);
                return Some(line);
            }
            counters.texture_hits += 1;
        }
        *word = map.words.read::<1>(memory, *word, 0).map_or(0, |words| words[0]);
        self.next = if self.next == Next::Texture { Next::Normal } else { Next::Done };
        None
    }
}

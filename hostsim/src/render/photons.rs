//! Photons as they are traced; in: a scene, out: one chunk after the other, shown to the judges first; cost: the tracing.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;

use super::Prepared;
use super::judge::Judge;
use super::units::{DisplacedError, Units};
use crate::accelerate::PhotonSource;
use crate::trace::{PhotonChunk, chunks};

/// Emitted photons a chunk: some 50,000 surface hits.
pub const CHUNK: u32 = 1 << 14;

/// Traces chunk after chunk, so that memory stays bounded however many photons there are.
pub struct TracedPhotons<'a> {
    prepared: &'a Prepared,
    ranges: Box<dyn Iterator<Item = core::ops::Range<u32>>>,
    chunk: PhotonChunk,
    units: &'a mut Units,
    /// What ended the tracing before its time.
    error: Option<DisplacedError>,
    judge: &'a mut Judge,
    bar: &'a ProgressBar,
    trace_time: Duration,
}

impl<'a> TracedPhotons<'a> {
    /// All photons `0..emitted`.
    pub fn new(
        prepared: &'a Prepared,
        units: &'a mut Units,
        emitted: u32,
        judge: &'a mut Judge,
        bar: &'a ProgressBar,
    ) -> Self {
        bar.set_length(emitted.into());
        bar.set_message("photons");
        Self {
            prepared,
            ranges: Box::new(chunks(emitted, CHUNK)),
            chunk: PhotonChunk::default(),
            units,
            error: None,
            judge,
            bar,
            trace_time: Duration::ZERO,
        }
    }

    /// Host time spent on tracing, once all photons are traced.
    ///
    /// # Errors
    /// What ended the tracing before.
    pub fn finish(self) -> Result<Duration, DisplacedError> {
        match self.error {
            Some(error) => Err(error),
            None => Ok(self.trace_time),
        }
    }
}

impl PhotonSource for TracedPhotons<'_> {
    fn next_chunk(&mut self) -> Option<&PhotonChunk> {
        let range = self.ranges.next()?;
        self.bar.set_position(range.start.into());
        let started = Instant::now();
        let filled = self.chunk.fill_through(&self.prepared.scene, &self.prepared.grid, range, self.units);
        self.trace_time += started.elapsed();
        if let Err(error) = filled {
            self.error = Some(error);
            return None;
        }
        self.judge.watch(&self.chunk, self.prepared.grid.entries());
        Some(&self.chunk)
    }
}

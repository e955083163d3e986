//! What an instance sees of the world; in: results and line requests, out: memory changed, fills on their way; cost: wires.

use lucerna_fabric::port::Port;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::{Fault, FaultCode, Job, RayFaults};
use crate::read::Fetch;
use crate::record::{self, Outcome, RESULT_WORDS, Status};
use crate::shade::colour::colour;
use crate::sizes::MAX_UNITS;
use crate::slots::STAGES;
use crate::traverse::heights::Depths;

/// Which of an instance's caches.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cache {
    /// Heights, exclusive to the traverse unit.
    Height,
    /// Textures and normals, unified.
    Texture,
}

/// Whom a line is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Fill {
    /// Number of the instance.
    pub unit: usize,
    /// Its cache.
    pub cache: Cache,
    /// Byte address of the line.
    pub line: u32,
}

/// Lines that can be in flight: each slot waits for at most one, and so does each read unit.
pub const IN_FLIGHT: usize = MAX_UNITS as usize * (STAGES + 1);

/// The memory port of all instances.
pub type MemoryPort = Port<Fill, IN_FLIGHT>;

/// All that is not the instance's own, in a cycle.
#[derive(Debug)]
pub struct Outside<'a, F> {
    /// The job.
    pub job: &'a Job<F>,
    /// Height to depth (P14).
    pub depths: &'a Depths<F>,
    /// Device memory.
    pub memory: &'a mut [u32],
    /// The shared port.
    pub port: &'a mut MemoryPort,
    /// Of all instances.
    pub counters: &'a mut Counters,
    /// Results written since the start.
    pub done: &'a mut u32,
    /// Why the job has to end.
    pub fault: Option<Fault>,
    /// The cycle, from the job's start.
    pub now: u64,
    /// Number of the instance at work.
    pub unit: usize,
}

impl<F: Format> Outside<'_, F> {
    /// When the next line comes; at the end of time if none does.
    #[inline]
    pub(crate) fn arrival(&self) -> u64 {
        self.port.next_arrival().unwrap_or(u64::MAX)
    }

    /// Asks for a line.
    pub fn request(&mut self, cache: Cache, line: u32, bytes: u32) {
        let before = *self.port.totals();
        // There is room for all that can wait.
        let _ = self.port.request(self.now, bytes, Fill { unit: self.unit, cache, line });
        self.counters.port_bytes += self.port.totals().bytes - before.bytes;
        self.counters.port_busy += self.port.totals().busy - before.busy;
    }

    /// Writes the result of a hit whose texels are known.
    #[inline]
    pub(crate) fn shaded(&mut self, fetch: &Fetch) {
        let colour = colour(&self.job.light, fetch.texture, fetch.normal);
        self.counters.hits += 1;
        self.write(fetch.number, fetch.steps, record::with_colour(fetch.result, colour));
    }

    /// Writes a result.
    pub fn result(&mut self, number: u32, outcome: &Outcome<F>) {
        let counters = &mut *self.counters;
        let fault = match outcome.status {
            Status::Hit => {
                counters.hits += 1;
                None
            }
            Status::Miss => {
                counters.missed += 1;
                None
            }
            Status::Grazing => {
                counters.grazing += 1;
                Some(FaultCode::GrazingRay)
            }
            Status::Watchdog => {
                counters.watchdogs += 1;
                Some(FaultCode::Watchdog)
            }
        };
        self.write(number, outcome.steps, outcome.words());
        if let Some(code) = fault
            && self.job.ray_faults == RayFaults::Stop
            && self.fault.is_none()
        {
            self.fault = Some(Fault { code, address: self.job.results.address(number) });
        }
    }
    #[inline]
    fn write(&mut self, number: u32, steps: u32, result: [u32; RESULT_WORDS as usize]) {
        self.counters.max_steps = self.counters.max_steps.max(u64::from(steps));
        self.counters.result_bytes += u64::from(RESULT_WORDS) * 4;
        if let Some(words) = self.job.results.write(self.memory, number, 0) {
            *words = result;
        }
        *self.done += 1;
    }
}

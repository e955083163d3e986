//! The traverse unit (§4.2, Fig. 7); in: rays from FIFO #0, out: where they end, to FIFO #1; cost: one step a cycle.
//!
//! Fifteen stages in a loop, and a ray in each: the pipeline is a ring of slots that turns by one a cycle. In stage 1 a slot
//! gives up the ray that has ended and takes the next one; in stage 2 the height cache answers; what follows from the height is
//! known in stage 15, just before the slot is in stage 1 again. The arithmetic is done where the height is known and carried.
//!
//! The first mode is one turn that finds the start level, without the cache. A miss costs the slot its turn; the line is
//! forwarded to every slot that waits for it when it comes (P17), so that it cannot be evicted before it is used.

use lucerna_fabric::cache::Tags;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::Job;
use crate::record::Status;
use crate::slot::{Slot, State};
use crate::traverse::heights::{Depths, Fetched};
use crate::traverse::ray::{Ray, Track};
use crate::traverse::walk::Walk;

/// Stages of the pipeline, so slots of the ring (Fig. 7).
pub const STAGES: usize = 15;

/// A ray on its way into the traverse unit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Entrant<F> {
    /// Its number in the job.
    pub number: u32,
    /// In texture space.
    pub ray: Ray<F>,
}

/// A ray on its way out.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ended<F> {
    /// Its number in the job.
    pub number: u32,
    /// In texture space.
    pub ray: Ray<F>,
    /// Hit, miss or watchdog.
    pub status: Status,
    /// Where it ended.
    pub leaf: [i32; 2],
    /// At which depth.
    pub t: F,
    /// After how many steps.
    pub steps: u32,
    /// Where it began.
    pub start_level: u32,
}

/// Where heights are.
struct Heights<'a, F> {
    /// The pyramid's words.
    words: &'a [[u32; 1]],
    /// Byte address of the first.
    base: u32,
    depths: &'a Depths<F>,
}

/// A traverse unit with its height cache.
#[derive(Clone, Debug)]
pub struct Slots<F: Format, const LINES: usize> {
    slots: [Slot<F>; STAGES],
    /// The slot in stage 1.
    entry: usize,
    occupied: usize,
    /// The height cache.
    pub cache: Tags<LINES>,
}

impl<F: Format, const LINES: usize> Slots<F, LINES> {
    /// An empty ring.
    pub fn new(cache: Tags<LINES>) -> Self {
        let ray = Ray { entry: [F::ZERO; 2], direction: [F::ZERO; 2] };
        let (track, walk) = (Track::nowhere(), Walk::NOWHERE);
        let empty = Slot { state: State::Empty, number: 0, start_level: 0, ray, track, walk };
        Self { slots: [empty; STAGES], entry: 0, occupied: 0, cache }
    }

    /// Drops all rays and empties the cache.
    pub fn clear(&mut self) {
        for slot in &mut self.slots {
            slot.state = State::Empty;
        }
        self.entry = 0;
        self.occupied = 0;
        self.cache.clear();
    }

    /// Whether every slot holds a ray.
    #[inline]
    pub const fn is_full(&self) -> bool {
        self.occupied == STAGES
    }

    /// Whether nothing leaves or enters in stage 1, where no ray enters when it is `idle`.
    #[inline]
    pub fn is_quiet(&self, idle: bool) -> bool {
        self.goes_on() || idle && self.is_free()
    }

    /// Whether stage 1 holds a ray that goes on: nothing leaves or enters then.
    #[inline]
    pub fn goes_on(&self) -> bool {
        !matches!(self.slots[self.entry].state, State::Empty | State::Ended(_))
    }

    /// The ray in stage 1, if it has ended.
    #[inline]
    pub fn ended(&self) -> Option<Ended<F>> {
        let slot = &self.slots[self.entry];
        let State::Ended(status) = slot.state else { return None };
        Some(Ended {
            number: slot.number,
            ray: slot.ray,
            status,
            leaf: slot.walk.leaf,
            t: slot.walk.t,
            steps: slot.walk.steps,
            start_level: slot.start_level,
        })
    }

    /// Stage 1 gives up its ray.
    #[inline]
    pub fn release(&mut self) {
        self.slots[self.entry].state = State::Empty;
        self.occupied -= 1;
    }

    /// Whether stage 1 takes a ray.
    #[inline]
    pub fn is_free(&self) -> bool {
        self.slots[self.entry].state == State::Empty
    }

    /// Stage 1 takes a ray.
    #[inline]
    pub fn load(&mut self, entrant: Entrant<F>, job: &Job<F>) {
        let slot = &mut self.slots[self.entry];
        slot.number = entrant.number;
        slot.ray = entrant.ray;
        slot.track = entrant.ray.track(job.terrain.field.shape().log2());
        slot.start_level = job.terrain.field.shape().root();
        if !slot.track.is_in_reach() {
            slot.walk = Walk::NOWHERE;
            slot.state = State::Ended(Status::Grazing);
        } else if job.terrain.policies.start_level {
            slot.state = State::Start;
        } else {
            slot.walk = Walk::new(&slot.track, &job.terrain);
            slot.state = State::Walk;
        }
        self.occupied += 1;
    }

    /// Turns by up to `cycles` stages, at least one, until something may leave or enter in stage 1, where no ray enters when it
    /// is `idle`. In each the slot in stage 2 has its turn. Gives how often it turned, and the line that is to be asked for if the
    /// last turn was the first miss of it.
    pub fn turns(
        &mut self,
        cycles: u64,
        idle: bool,
        job: &Job<F>,
        depths: &Depths<F>,
        memory: &[u32],
        counters: &mut Counters,
    ) -> (u64, Option<u32>) {
        let map = Heights { words: job.map.words.records(memory), base: job.map.words.address(0), depths };
        let mut turned = 0;
        let mut stage2 = if self.entry == 0 { STAGES - 1 } else { self.entry - 1 };
        let line = loop {
            let line = self.access(stage2, job, &map, counters);
            stage2 = self.entry;
            self.entry = if stage2 == STAGES - 1 { 0 } else { stage2 + 1 };
            turned += 1;
            if line.is_some() || turned >= cycles || !self.is_quiet(idle) {
                break line;
            }
        };
        (turned, line)
    }

    /// A slot's turn; gives the line that is to be asked for, if this is the first miss of it.
    #[inline(always)]
    fn access(
        &mut self,
        stage2: usize,
        job: &Job<F>,
        map: &Heights<'_, F>,
        counters: &mut Counters,
    ) -> Option<u32> {
        let slot = &mut self.slots[stage2];
        let served = slot.state == State::Served;
        if slot.state != State::Walk && !served {
            slot.other_turn(job, counters);
            return None;
        }
        let mut fetched = None;
        if let Some(place) = job.terrain.field.place(slot.walk.leaf, slot.walk.level) {
            if served {
                counters.height_forwards += 1;
            } else {
                counters.height_accesses += 1;
                let address = map.base + place;
                if !self.cache.lookup(address) {
                    return self.miss(stage2, address, counters);
                }
                counters.height_hits += 1;
            }
            let [word] = map.words.get(place as usize / 4).copied().unwrap_or_default();
            fetched = Some(Fetched { place, word, depths: map.depths });
        }
        slot.step(job, fetched, counters);
        None
    }

    /// The slot waits for a line; gives it, if no other slot does.
    #[cold]
    fn miss(&mut self, stage2: usize, address: u32, counters: &mut Counters) -> Option<u32> {
        let line = self.cache.line(address);
        self.slots[stage2].state = State::Wait { line };
        counters.height_misses += 1;
        counters.traverse_waits += 1;
        (self.waiting_for(line) == 1).then_some(line)
    }

    fn waiting_for(&self, line: u32) -> usize {
        self.slots.iter().filter(|slot| slot.state == State::Wait { line }).count()
    }

    /// A line has come: into the cache, and to the slots that wait for it (P17).
    #[cold]
    pub fn fill(&mut self, line: u32, counters: &mut Counters) {
        self.cache.fill(line);
        counters.height_fills += 1;
        for slot in &mut self.slots {
            if slot.state == (State::Wait { line }) {
                slot.state = State::Served;
            }
        }
    }
}

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
use crate::slot::{Heights, Slot, State, Turn};
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
    /// In which cycle it left.
    pub left: u64,
}

/// The bits of all slots.
const ALL: u32 = (1 << STAGES) - 1;

/// The slot behind this one.
#[inline]
const fn next(slot: usize) -> usize {
    if slot == STAGES - 1 { 0 } else { slot + 1 }
}

/// A traverse unit with its height cache.
#[derive(Clone, Debug)]
pub struct Slots<F: Format, const LINES: usize> {
    slots: [Slot<F>; STAGES],
    /// The slot in stage 1.
    entry: usize,
    /// A bit for each slot that is empty or holds a ray that has ended.
    done: u32,
    /// Of these, those with a hit.
    hits: u32,
    occupied: usize,
    /// The height cache.
    pub cache: Tags<LINES>,
}

impl<F: Format, const LINES: usize> Slots<F, LINES> {
    /// An empty ring.
    pub fn new(cache: Tags<LINES>) -> Self {
        let ray = Ray { entry: [F::ZERO; 2], direction: [F::ZERO; 2] };
        let (track, walk) = (Track::NOWHERE, Walk::NOWHERE);
        let empty = Slot { state: State::Empty, number: 0, start_level: 0, ray, track, walk };
        Self { slots: [empty; STAGES], entry: 0, done: ALL, hits: 0, occupied: 0, cache }
    }

    /// Drops all rays and empties the cache.
    pub fn clear(&mut self) {
        for slot in &mut self.slots {
            slot.state = State::Empty;
        }
        self.entry = 0;
        (self.done, self.hits) = (ALL, 0);
        self.occupied = 0;
        self.cache.clear();
    }

    /// How many slots hold a ray.
    #[inline]
    pub const fn occupied(&self) -> usize {
        self.occupied
    }

    /// How the ray in stage 1 ended, if it has.
    #[inline]
    pub fn outcome(&self) -> Option<Status> {
        match self.slots[self.entry].state {
            State::Ended(status) => Some(status),
            _ => None,
        }
    }

    /// Whether stage 1 holds a ray that goes on: nothing leaves or enters then.
    #[inline]
    pub const fn goes_on(&self) -> bool {
        self.done >> self.entry & 1 == 0
    }

    /// The ray in stage 1, if it has ended.
    #[inline]
    pub fn ended(&self, now: u64) -> Option<Ended<F>> {
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
            left: now,
        })
    }

    /// Stage 1 gives up its ray.
    #[inline]
    pub fn release(&mut self) {
        self.slots[self.entry].state = State::Empty;
        self.hits &= !(1 << self.entry);
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
            self.done &= !(1 << self.entry);
        } else {
            slot.walk = Walk::new(&slot.track, &job.terrain);
            slot.state = State::Walk;
            self.done &= !(1 << self.entry);
        }
        self.occupied += 1;
    }

    /// Turns by up to `cycles` stages, at least one, until something may leave or enter in stage 1; a hit does not when hits are
    /// `held`. In each the slot in stage 2 has its turn. Gives how often it turned, and the line that is to be asked for if the last
    /// turn was the first miss of it.
    pub(crate) fn turns(
        &mut self,
        cycles: u64,
        held: bool,
        job: &Job<F>,
        heights: Heights<'_, F>,
        counters: &mut Counters,
    ) -> (u64, Option<u32>) {
        let (mut turned, mut looked) = (0, 0);
        let mut stops = self.stops(held);
        let mut stage2 = if self.entry == 0 { STAGES - 1 } else { self.entry - 1 };
        let field = &job.terrain.field;
        let mut entry = self.entry;
        let mut ahead = self.slots[stage2].ahead(field, &heights);
        let first = loop {
            let (slot, now) = (stage2, ahead);
            stage2 = entry;
            entry = next(entry);
            // The next slot's height is on its way through the host's memory while this slot has its turn.
            if cycles > 1 {
                ahead = self.slots[stage2].ahead(field, &heights);
            }
            turned += 1;
            match self.slots[slot].turn(now, job, &heights, &mut self.cache, &mut looked, counters) {
                Turn::On => {}
                Turn::Ended { hit } => {
                    self.done |= 1 << slot;
                    self.hits |= u32::from(hit) << slot;
                    stops = self.stops(held);
                }
                Turn::Missed { line } => {
                    if self.waiting_for(line) == 1 {
                        break Some(line);
                    }
                }
            }
            if (turned >= cycles) | (stops >> entry & 1 == 1) {
                break None;
            }
        };
        self.entry = entry;
        counters.traverse_busy += looked;
        counters.steps += looked;
        counters.height_accesses += looked;
        counters.height_hits += looked;
        (turned, first)
    }

    /// Slots that stop the ring when they are in stage 1.
    #[inline]
    const fn stops(&self, held: bool) -> u32 {
        if held { self.done & !self.hits } else { self.done }
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

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
use crate::traverse::walk::{Depths, Fetched, Ray, Step, Track, Walk};

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

/// What a slot is about.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum State {
    /// No ray.
    Empty,
    /// The next turn is in the first mode.
    Start,
    /// The next turn is a step.
    Walk,
    /// A step's height comes with this line.
    Wait { line: u32 },
    /// The line has come.
    Served,
    /// The ray has ended.
    Ended(Status),
}

#[derive(Clone, Copy, Debug)]
struct Slot<F> {
    state: State,
    number: u32,
    start_level: u32,
    /// Where it enters, for its hit coordinate.
    entry: [F; 2],
    track: Track<F>,
    walk: Walk<F>,
}

/// A traverse unit with its height cache.
#[derive(Clone, Debug)]
pub struct Slots<F, const LINES: usize> {
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
        let track = Track { texel: [0; 2], offset: [F::ZERO; 2], direction: [F::ZERO; 2] };
        let walk = Walk { t: F::ZERO, leaf: [0; 2], level: 0, crossed: false, stayed: false, steps: 0 };
        let empty = Slot { state: State::Empty, number: 0, start_level: 0, entry: [F::ZERO; 2], track, walk };
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

    /// Whether it holds no ray.
    #[inline]
    pub const fn is_empty(&self) -> bool {
        self.occupied == 0
    }

    /// The ring turns by one stage.
    #[inline]
    pub fn turn(&mut self) {
        self.entry = if self.entry + 1 == STAGES { 0 } else { self.entry + 1 };
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
            ray: Ray { entry: slot.entry, direction: slot.track.direction },
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
        slot.entry = entrant.ray.entry;
        slot.track = entrant.ray.track(job.terrain.field.shape().log2());
        slot.start_level = job.terrain.field.shape().root();
        if job.terrain.policies.start_level {
            slot.state = State::Start;
        } else {
            slot.walk = Walk::new(&slot.track, &job.terrain);
            slot.state = State::Walk;
        }
        self.occupied += 1;
    }

    /// Stage 2, a turn of the slot there; gives the address whose line is to be asked for, if this is its first miss.
    #[inline]
    pub fn access(
        &mut self,
        job: &Job<F>,
        depths: &Depths<F>,
        memory: &[u32],
        counters: &mut Counters,
    ) -> Option<u32> {
        let stage2 = if self.entry == 0 { STAGES - 1 } else { self.entry - 1 };
        let slot = &mut self.slots[stage2];
        let served = slot.state == State::Served;
        if slot.state != State::Walk && !served {
            slot.other_turn(job, counters);
            return None;
        }
        let Some(place) = job.terrain.field.place(slot.walk.leaf, slot.walk.level) else {
            slot.step(job, None, counters);
            return None;
        };
        if served {
            counters.height_forwards += 1;
        } else {
            counters.height_accesses += 1;
            let address = job.map.words.address(0) + place;
            if !self.cache.lookup(address) {
                let line = self.cache.line(address);
                slot.state = State::Wait { line };
                counters.height_misses += 1;
                counters.traverse_waits += 1;
                return (self.waiting_for(line) == 1).then_some(line);
            }
            counters.height_hits += 1;
        }
        let word = job.map.words.value(memory, place / 4).unwrap_or(0);
        slot.step(job, Some(Fetched { place, word, depths }), counters);
        None
    }

    #[cold]
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

impl<F: Format> Slot<F> {
    /// A turn without a height.
    fn other_turn(&mut self, job: &Job<F>, counters: &mut Counters) {
        match self.state {
            State::Empty => counters.traverse_bubbles += 1,
            State::Start => {
                self.walk = Walk::new(&self.track, &job.terrain);
                self.start_level = self.walk.level;
                counters.traverse_busy += 1;
                counters.start_passes += 1;
                counters.levels_saved += u64::from(job.terrain.field.shape().root() - self.walk.level);
                self.state = State::Walk;
            }
            State::Wait { .. } => counters.traverse_waits += 1,
            // Counted where it is held, in stage 1; the others have a height.
            State::Ended(_) | State::Walk | State::Served => {}
        }
    }

    #[inline]
    fn step(&mut self, job: &Job<F>, fetched: Option<Fetched<'_, F>>, counters: &mut Counters) {
        counters.traverse_busy += 1;
        counters.steps += 1;
        self.state = State::Walk;
        match self.walk.step(&self.track, &job.terrain, fetched.as_ref()) {
            Step::Down => counters.level_downs += 1,
            Step::Cross { up } => {
                counters.crossings += 1;
                counters.level_ups += u64::from(up);
            }
            Step::CrossDown => {
                counters.crossings += 1;
                counters.folds += 1;
                counters.level_downs += 1;
            }
            Step::CrossHit => {
                counters.crossings += 1;
                counters.folds += 1;
                self.state = self.hit(job);
                return;
            }
            Step::Hit => {
                self.state = self.hit(job);
                return;
            }
        }
        if self.walk.steps >= job.watchdog {
            self.state = State::Ended(Status::Watchdog);
        }
    }

    #[inline]
    fn hit(&self, job: &Job<F>) -> State {
        State::Ended(if job.terrain.field.lets_hit(self.walk.leaf) { Status::Hit } else { Status::Miss })
    }
}

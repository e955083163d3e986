//! A slot of the ring; in: its ray and a height, out: what becomes of the ray; cost: a turn.

use lucerna_fabric::cache::Tags;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::Job;
use crate::record::Status;
use crate::traverse::heights::{Depths, Fetched, Field, Pyramid};
use crate::traverse::ray::{Ray, Track};
use crate::traverse::walk::{Step, Walk};

/// What a slot is about.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum State {
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

/// A ray in the ring, and what it is about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slot<F: Format> {
    pub state: State,
    /// The ray's number in the job.
    pub number: u32,
    pub start_level: u32,
    /// As it came, for its hit coordinate.
    pub ray: Ray<F>,
    pub track: Track<F>,
    pub walk: Walk<F>,
}

/// Where heights are.
#[derive(Clone, Copy)]
pub(crate) struct Heights<'a, F> {
    pyramid: Pyramid<'a, F>,
    /// Byte address of the pyramid.
    base: u32,
}

impl<'a, F: Format> Heights<'a, F> {
    /// Those of a job.
    #[inline]
    pub fn of(job: &Job<F>, depths: &'a Depths<F>, memory: &'a [u32]) -> Self {
        let map = &job.map.words;
        let words = map.records::<1>(memory).as_flattened();
        Self { pyramid: Pyramid { words, depths }, base: map.address(0) }
    }
}

/// What a slot's next step needs.
#[derive(Clone, Copy)]
pub(crate) struct Ahead<F> {
    /// The byte of the pyramid with the height of the ray's node, or [`NOWHERE`].
    place: u32,
    /// The depth of the node's top.
    depth: F,
}

/// Beyond the border, where no byte of a pyramid is.
const NOWHERE: u32 = u32::MAX;

/// What a turn came to.
#[derive(Clone, Copy)]
pub(crate) enum Turn {
    /// The slot goes on as it is, or the ray in it.
    On,
    /// The ray ended, on a texel or not.
    Ended { hit: bool },
    /// The slot waits for a line.
    Missed { line: u32 },
}

impl<F: Format> Slot<F> {
    /// What its next step needs, if it is one. Beyond the border nothing is higher than the bottom.
    #[inline(always)]
    pub fn ahead(&self, field: &Field, heights: &Heights<'_, F>) -> Ahead<F> {
        match self.walk.node(field) {
            Some(place) => Ahead { place, depth: heights.pyramid.depth(place) },
            None => Ahead { place: NOWHERE, depth: F::ONE },
        }
    }

    /// A turn: a step, if the height for it is there. Steps of which the cache had the height are counted in `looked` only.
    #[inline(always)]
    pub fn turn<const LINES: usize>(
        &mut self,
        Ahead { place, depth }: Ahead<F>,
        job: &Job<F>,
        heights: &Heights<'_, F>,
        cache: &mut Tags<LINES>,
        looked: &mut u64,
        counters: &mut Counters,
    ) -> Turn {
        if (self.state == State::Walk) & (place != NOWHERE) {
            let address = heights.base + place;
            if !cache.lookup(address) {
                return self.miss(cache.line(address), counters);
            }
            *looked += 1;
        } else if !self.other_turn(place, job, counters) {
            return Turn::On;
        }
        self.step(job, &Fetched { place, depth, pyramid: heights.pyramid }, counters)
    }

    /// The slot waits for a line.
    #[cold]
    fn miss(&mut self, line: u32, counters: &mut Counters) -> Turn {
        self.state = State::Wait { line };
        counters.height_accesses += 1;
        counters.height_misses += 1;
        counters.traverse_waits += 1;
        Turn::Missed { line }
    }

    /// A turn that is no step, or one whose height did not come from the cache: says whether it is a step.
    #[inline(never)]
    fn other_turn(&mut self, place: u32, job: &Job<F>, counters: &mut Counters) -> bool {
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
            State::Ended(_) => counters.traverse_stalls += 1,
            // The line has come, or the node is beyond the border.
            State::Walk | State::Served => {
                counters.height_forwards += u64::from(place != NOWHERE);
                counters.traverse_busy += 1;
                counters.steps += 1;
                return true;
            }
        }
        false
    }

    /// A step, with the heights that the cache delivered; its turn and step are counted elsewhere.
    #[inline(always)]
    fn step(&mut self, job: &Job<F>, fetched: &Fetched<'_, F>, counters: &mut Counters) -> Turn {
        self.state = State::Walk;
        match self.walk.step(&self.track, &job.terrain, fetched) {
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
                return self.end(if self.has_hit(job) { Status::Hit } else { Status::Miss });
            }
            Step::Hit => return self.end(if self.has_hit(job) { Status::Hit } else { Status::Miss }),
        }
        if self.walk.steps >= job.watchdog { self.end(Status::Watchdog) } else { Turn::On }
    }

    #[inline]
    fn end(&mut self, status: Status) -> Turn {
        self.state = State::Ended(status);
        Turn::Ended { hit: status == Status::Hit }
    }

    #[inline]
    fn has_hit(&self, job: &Job<F>) -> bool {
        job.terrain.field.lets_hit(self.walk.leaf)
    }
}

//! A slot of the ring; in: its ray and a height, out: what becomes of the ray; cost: a turn.

use lucerna_fabric::cache::Tags;
use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::Job;
use crate::record::Status;
use crate::traverse::heights::{Depths, Fetched};
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
    /// The pyramid's words.
    pub words: &'a [[u32; 1]],
    /// Byte address of the first.
    pub base: u32,
    pub depths: &'a Depths<F>,
}

/// What a turn came to.
pub(crate) enum Turn {
    /// The slot goes on as it is, or the ray in it.
    On,
    /// The ray ended, on a texel or not.
    Ended { hit: bool },
    /// The slot waits for a line.
    Missed { line: u32 },
}

impl<F: Format> Slot<F> {
    /// A turn: a step, if the height for it is there.
    #[inline(always)]
    pub fn turn<const LINES: usize>(
        &mut self,
        job: &Job<F>,
        heights: &Heights<'_, F>,
        cache: &mut Tags<LINES>,
        counters: &mut Counters,
    ) -> Turn {
        let served = self.state == State::Served;
        if self.state != State::Walk && !served {
            self.other_turn(job, counters);
            return Turn::On;
        }
        let mut fetched = None;
        if let Some(place) = self.walk.node(&job.terrain.field) {
            if served {
                counters.height_forwards += 1;
            } else {
                counters.height_accesses += 1;
                let address = heights.base + place;
                if !cache.lookup(address) {
                    return self.miss(cache.line(address), counters);
                }
                counters.height_hits += 1;
            }
            let [word] = heights.words.get(place as usize / 4).copied().unwrap_or_default();
            fetched = Some(Fetched { place, word, depths: heights.depths });
        }
        self.step(job, fetched, counters)
    }

    /// The slot waits for a line.
    #[cold]
    fn miss(&mut self, line: u32, counters: &mut Counters) -> Turn {
        self.state = State::Wait { line };
        counters.height_misses += 1;
        counters.traverse_waits += 1;
        Turn::Missed { line }
    }

    /// A turn that is no step.
    #[inline(never)]
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
            State::Ended(_) => counters.traverse_stalls += 1,
            // These have a height.
            State::Walk | State::Served => {}
        }
    }

    /// A step, with the heights that the cache delivered.
    #[inline(always)]
    fn step(&mut self, job: &Job<F>, fetched: Option<Fetched<'_, F>>, counters: &mut Counters) -> Turn {
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

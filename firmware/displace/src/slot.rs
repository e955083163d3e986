//! A slot of the ring; in: its ray and a height, out: what becomes of the ray; cost: a turn.

use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::job::Job;
use crate::record::Status;
use crate::traverse::heights::Fetched;
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

impl<F: Format> Slot<F> {
    /// A turn that is no step.
    #[inline(never)]
    pub fn other_turn(&mut self, job: &Job<F>, counters: &mut Counters) {
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
    pub fn step(&mut self, job: &Job<F>, fetched: Option<Fetched<'_, F>>, counters: &mut Counters) {
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

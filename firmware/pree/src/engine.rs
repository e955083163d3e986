//! The engine (PREE Fig. 5, solid box); in: jobs and photons, out: memory changed, a state, counters; cost: see the passes.

use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::evaluate::EvaluatePass;
use crate::job::{EvaluateJob, Fault, FaultCode, UpdateJob};
use crate::update::{Progress, UpdatePass};

/// What the engine is doing.
#[derive(Clone, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "there is no heap, and one of the two is nearly always at work"
)]
enum State<F, const N: usize> {
    Idle,
    Update(UpdatePass<F, N>),
    Evaluate(EvaluatePass<F, N>),
    Fault(Fault),
}

/// The state as the status register shows it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Status {
    /// No job.
    Idle,
    /// A job runs.
    Running {
        /// The clock is gated for want of photons.
        starved: bool,
        /// Flush was asked for.
        flushing: bool,
    },
    /// The last job ended in a fault.
    Fault(Fault),
}

/// What happened in a tick, for the interrupt register.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Event {
    /// The job is done and its results are in memory.
    Done,
    /// The job was stopped by a fault.
    Fault(Fault),
}

/// How far the photon ring was read.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Ring {
    /// Records taken from it, a free-running count.
    pub head: u32,
    /// Records still in it.
    pub waiting: u32,
}

impl Ring {
    fn of<F: Format, const N: usize>(pass: &UpdatePass<F, N>) -> Self {
        Self { head: pass.feed.head(), waiting: pass.feed.waiting() }
    }
}

/// An engine with `N` PREUs of format `F`.
#[derive(Clone, Debug)]
pub struct Pree<F, const N: usize> {
    state: State<F, N>,
    counters: Counters,
    starved: bool,
    ring: Ring,
}

impl<F: Format, const N: usize> Default for Pree<F, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<F: Format, const N: usize> Pree<F, N> {
    /// An idle engine.
    pub const fn new() -> Self {
        const {
            assert!(
                N.is_power_of_two() && N >= 4 && N <= 16,
                "the paper's controllers are drawn for 4, 8 and 16 PREUs"
            );
        }
        Self {
            state: State::Idle,
            counters: Counters::ZERO,
            starved: false,
            ring: Ring { head: 0, waiting: 0 },
        }
    }

    /// Starts an update.
    ///
    /// # Errors
    /// [`FaultCode::NotIdle`] while a job runs, which goes on.
    pub fn update(&mut self, job: UpdateJob<F>) -> Result<(), Fault> {
        self.start(|| State::Update(UpdatePass::new(job)))
    }

    /// Starts an evaluation.
    ///
    /// # Errors
    /// [`FaultCode::NotIdle`] while a job runs, which goes on.
    pub fn evaluate(&mut self, job: EvaluateJob<F>) -> Result<(), Fault> {
        self.start(|| State::Evaluate(EvaluatePass::new(job)))
    }

    fn start(&mut self, state: impl FnOnce() -> State<F, N>) -> Result<(), Fault> {
        if self.is_running() {
            return Err(Fault { code: FaultCode::NotIdle, address: 0 });
        }
        self.starved = false;
        self.ring = Ring::default();
        self.state = state();
        Ok(())
    }

    /// Ends whatever runs, at once: results in flight are dropped. A fault is cleared.
    pub fn abort(&mut self) {
        self.state = State::Idle;
        self.starved = false;
    }

    /// A job was refused before it began. A running job goes on.
    pub fn refuse(&mut self, fault: Fault) {
        if !self.is_running() {
            self.ring = Ring::default();
            self.state = State::Fault(fault);
        }
    }

    /// The doorbell: records up to the free-running count `tail` are in the ring. Without an update job it has no effect.
    ///
    /// # Errors
    /// [`FaultCode::RingOverrun`]; the job is over.
    pub fn doorbell(&mut self, tail: u32) -> Result<(), Fault> {
        let State::Update(pass) = &mut self.state else { return Ok(()) };
        let rung = pass.feed().ring(tail);
        self.ring = Ring::of(pass);
        rung.inspect_err(|fault| self.state = State::Fault(*fault))
    }

    /// No photon will come behind those in the ring (D2).
    pub fn flush(&mut self) {
        if let State::Update(pass) = &mut self.state {
            pass.feed().flush();
        }
    }

    /// The photon ring of the update that runs, or ran last.
    pub fn ring(&self) -> Ring {
        match &self.state {
            State::Update(pass) => Ring::of(pass),
            State::Idle | State::Evaluate(_) | State::Fault(_) => self.ring,
        }
    }

    /// Whether a job runs.
    pub const fn is_running(&self) -> bool {
        matches!(self.state, State::Update(_) | State::Evaluate(_))
    }

    /// What the status register shows.
    pub fn status(&self) -> Status {
        match &self.state {
            State::Idle => Status::Idle,
            State::Update(pass) => {
                Status::Running { starved: self.starved, flushing: pass.feed.is_flushing() }
            }
            State::Evaluate(_) => Status::Running { starved: false, flushing: false },
            State::Fault(fault) => Status::Fault(*fault),
        }
    }

    /// What was counted.
    pub const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Sets all counters to zero.
    pub fn clear_counters(&mut self) {
        self.counters = Counters::default();
    }

    /// One clock.
    pub fn tick(&mut self, memory: &mut [u32]) -> Option<Event> {
        let progress = match &mut self.state {
            State::Update(pass) => pass.tick(memory, &mut self.counters),
            State::Evaluate(pass) => pass.tick(memory, &mut self.counters),
            State::Idle | State::Fault(_) => return None,
        };
        self.settle(progress)
    }

    /// The same state after `cycles` ticks, or fewer when a job ends before: says how many, and how it ended.
    pub fn advance(&mut self, memory: &mut [u32], cycles: u64) -> (u64, Option<Event>) {
        let (used, progress) = match &mut self.state {
            State::Update(pass) => pass.advance(memory, &mut self.counters, cycles),
            State::Evaluate(pass) => {
                let mut used = 0;
                let mut progress = Ok(Progress::Running);
                while used < cycles && progress == Ok(Progress::Running) {
                    progress = pass.tick(memory, &mut self.counters);
                    used += 1;
                }
                (used, progress)
            }
            State::Idle | State::Fault(_) => return (cycles, None),
        };
        (used, self.settle(progress))
    }

    fn settle(&mut self, progress: Result<Progress, Fault>) -> Option<Event> {
        self.ring = self.ring();
        self.starved = progress == Ok(Progress::Starved);
        match progress {
            Ok(Progress::Running | Progress::Starved) => None,
            Ok(Progress::Done) => {
                self.state = State::Idle;
                Some(Event::Done)
            }
            Err(fault) => {
                self.state = State::Fault(fault);
                Some(Event::Fault(fault))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::{Rules, Table};
    use lucerna_fabric::window::{Window, Windows};
    use lucerna_softfloat::F32;

    const WINDOWS: Windows<1> = Windows::new([Window { base: 0, limit: 128 }], 128);
    const NOTHING: Table = Table { base: 0, count: 0 };

    fn update() -> UpdateJob<F32> {
        let ring = Table { base: 0, count: 4 };
        UpdateJob::new(&WINDOWS, NOTHING, NOTHING, ring, F32::ONE, Rules::default()).unwrap()
    }

    fn running() -> Pree<F32, 4> {
        let mut engine = Pree::new();
        engine.update(update()).unwrap();
        engine
    }

    #[test]
    fn a_second_start_is_refused_and_changes_nothing() {
        let mut engine = running();
        engine.doorbell(2).unwrap();
        let refused = Fault { code: FaultCode::NotIdle, address: 0 };
        assert_eq!(engine.update(update()), Err(refused));
        engine.refuse(refused);
        assert!(engine.is_running());
        assert_eq!(engine.ring(), Ring { head: 0, waiting: 2 });
    }

    #[test]
    fn an_overrun_ends_the_job() {
        let mut engine = running();
        let fault = engine.doorbell(5).unwrap_err();
        assert_eq!(fault.code, FaultCode::RingOverrun);
        assert_eq!(engine.status(), Status::Fault(fault));
        engine.update(update()).unwrap();
        assert_eq!(engine.ring(), Ring::default(), "a start leaves the fault behind");
    }

    /// Words for the idle: no effect, no panic.
    #[test]
    fn an_idle_engine_has_no_doorbell_and_no_flush() {
        let mut engine: Pree<F32, 4> = Pree::new();
        assert_eq!(engine.doorbell(1000), Ok(()));
        engine.flush();
        engine.abort();
        assert_eq!(engine.tick(&mut []), None);
        assert_eq!(engine.advance(&mut [], 1 << 40), (1 << 40, None));
        assert_eq!((engine.status(), *engine.counters()), (Status::Idle, Counters::ZERO));
    }

    /// Gated for want of photons, a far future is reached at once, and only one counter moves.
    #[test]
    fn starved_cycles_are_skipped_and_counted() {
        let mut engine = running();
        assert_eq!(engine.advance(&mut [0; 32], 1 << 50), (1 << 50, None));
        assert_eq!(engine.status(), Status::Running { starved: true, flushing: false });
        assert_eq!(*engine.counters(), Counters { starved_cycles: 1 << 50, ..Counters::ZERO });
        engine.flush();
        assert_eq!(engine.advance(&mut [0; 32], 100), (5, Some(Event::Done)));
    }
}

//! The unit's top (§4.1): instances, switch and memory port; in: a job, out: results in memory, a state, counters; cost: a
//! step a cycle and instance.

use lucerna_softfloat::Format;

use crate::counters::Counters;
use crate::instance::Instance;
use crate::job::{Fault, FaultCode, Job};
use crate::outside::{MemoryPort, Outside};
use crate::source::Source;
use crate::traverse::heights::Depths;

pub use crate::sizes::{PortSizes, SizeError, Sizes};
pub use lucerna_fabric::cache::Geometry;

/// The state as the status register shows it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Status {
    /// No job.
    Idle,
    /// A job runs.
    Running,
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

/// A job at work.
#[derive(Clone, Debug)]
struct Work<F> {
    job: Job<F>,
    source: Source,
    /// The cycle, from the start.
    now: u64,
    /// The instance that the switch looks at first.
    first: usize,
}

#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there is no heap, and a job is nearly always at work")]
enum State<F> {
    Idle,
    Running(Work<F>),
    Fault(Fault),
}

/// Up to `UNITS` instances with caches of up to `LINES` lines each.
#[derive(Clone, Debug)]
pub struct Displace<F: Format, const UNITS: usize, const LINES: usize> {
    sizes: Sizes,
    depths: Depths<F>,
    state: State<F>,
    instances: [Instance<F, LINES>; UNITS],
    port: MemoryPort,
    counters: Counters,
    done: u32,
}

/// The parts of a unit at work, apart from each other.
pub(crate) struct Parts<'a, F: Format, const LINES: usize> {
    pub(crate) instances: &'a mut [Instance<F, LINES>],
    pub(crate) source: &'a mut Source,
    /// The instance that the switch looks at first.
    first: &'a mut usize,
    pub(crate) outside: Outside<'a, F>,
}

impl<F: Format, const UNITS: usize, const LINES: usize> Displace<F, UNITS, LINES> {
    /// An idle unit.
    ///
    /// # Errors
    /// Sizes beyond the type's capacities, or of which no cache can be.
    pub fn new(sizes: Sizes) -> Result<Self, SizeError> {
        let caches = sizes.caches::<LINES>(UNITS)?;
        Ok(Self {
            depths: Depths::new(),
            state: State::Idle,
            instances: core::array::from_fn(|_| Instance::new(&sizes, caches.clone())),
            port: MemoryPort::new(sizes.port.latency, sizes.port.bytes_per_cycle),
            counters: Counters::ZERO,
            done: 0,
            sizes,
        })
    }

    /// What was synthesised.
    pub const fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    /// Starts a job; caches are empty then.
    ///
    /// # Errors
    /// [`FaultCode::NotIdle`] while a job runs, which goes on.
    pub fn start(&mut self, job: Job<F>) -> Result<(), Fault> {
        if self.is_running() {
            return Err(Fault { code: FaultCode::NotIdle, address: 0 });
        }
        for instance in &mut self.instances {
            instance.reset(&job);
        }
        self.port.clear();
        self.done = 0;
        let source = Source::new(&job);
        self.state = State::Running(Work { job, source, now: 0, first: 0 });
        Ok(())
    }

    /// Ends whatever runs, at once: rays in flight are dropped. A fault is cleared.
    pub fn abort(&mut self) {
        self.state = State::Idle;
    }

    /// A job was refused before it began. A running job goes on.
    pub fn refuse(&mut self, fault: Fault) {
        if !self.is_running() {
            self.done = 0;
            self.state = State::Fault(fault);
        }
    }

    /// Whether a job runs.
    pub const fn is_running(&self) -> bool {
        matches!(self.state, State::Running(_))
    }

    /// The state.
    pub const fn status(&self) -> Status {
        match self.state {
            State::Idle => Status::Idle,
            State::Running(_) => Status::Running,
            State::Fault(fault) => Status::Fault(fault),
        }
    }

    /// Results written since the start.
    pub const fn done(&self) -> u32 {
        self.done
    }

    /// The counters.
    pub const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Sets them to zero.
    pub fn clear_counters(&mut self) {
        self.counters = Counters::ZERO;
    }

    /// One clock.
    pub fn tick(&mut self, memory: &mut [u32]) -> Option<Event> {
        self.run(memory, |parts| ((), parts.tick()))?.1
    }

    /// Up to `cycles` ticks, fewer when the job ends; says how many. Without a job, all pass at once.
    pub fn advance(&mut self, memory: &mut [u32], cycles: u64) -> (u64, Option<Event>) {
        self.run(memory, |parts| parts.advance(cycles)).unwrap_or((cycles, None))
    }

    /// Lets a running job's parts do something, and takes note of the time and of what happened.
    #[inline]
    fn run<R>(
        &mut self,
        memory: &mut [u32],
        task: impl FnOnce(&mut Parts<'_, F, LINES>) -> (R, Option<Event>),
    ) -> Option<(R, Option<Event>)> {
        let State::Running(Work { job, source, now, first }) = &mut self.state else { return None };
        let instances = self.instances.get_mut(..self.sizes.units as usize)?;
        let Self { depths, port, counters, done, .. } = self;
        let outside = Outside { job, depths, memory, port, counters, done, fault: None, now: *now, unit: 0 };
        let mut parts = Parts { instances, source, first, outside };
        let (result, event) = task(&mut parts);
        *now = parts.outside.now;
        match event {
            None => {}
            Some(Event::Done) => self.state = State::Idle,
            Some(Event::Fault(fault)) => self.state = State::Fault(fault),
        }
        Some((result, event))
    }
}

impl<F: Format, const LINES: usize> Parts<'_, F, LINES> {
    /// One clock: the fills, then each instance, then the switch.
    pub(crate) fn tick(&mut self) -> Option<Event> {
        let Self { instances, outside, .. } = self;
        while let Some(fill) = outside.port.arrived(outside.now) {
            if let Some(instance) = instances.get_mut(fill.unit) {
                instance.fill(fill, outside.counters);
            }
        }
        for (unit, instance) in instances.iter_mut().enumerate() {
            outside.unit = unit;
            instance.tick(outside);
        }
        outside.counters.cycles += 1;
        if let Some(fault) = outside.fault {
            return Some(Event::Fault(fault));
        }
        let _ = self.switch();
        let outside = &mut self.outside;
        outside.now += 1;
        (*outside.done == outside.job.results.count()).then_some(Event::Done)
    }

    /// Hands one ray a cycle to the next instance that has room, in turn; says to which.
    pub(crate) fn switch(&mut self) -> Option<usize> {
        if self.source.is_dry() {
            return None;
        }
        let Outside { job, memory, now, counters, .. } = &mut self.outside;
        let units = self.instances.len();
        let mut next = None;
        for turn in 0..units {
            let unit =
                if *self.first + turn < units { *self.first + turn } else { *self.first + turn - units };
            let instance = &self.instances[unit];
            if instance.view.can_issue(*now) {
                if !instance.has_room() {
                    counters.view_stalls += 1;
                } else if next.is_none() {
                    next = Some(unit);
                }
            }
        }
        let unit = next?;
        let (number, view) = self.source.take(job, memory)?;
        counters.rays += 1;
        self.instances[unit].issue(*now, number, view, counters);
        *self.first = if unit + 1 == units { 0 } else { unit + 1 };
        Some(unit)
    }
}

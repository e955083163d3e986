//! The device as a driver sees it. In: a bus and a delay. Out: units' handles, counters, recovery. Cost: a probe
//! of five reads, and one to five a unit; after that what is asked for.
//!
//! One job runs at a time, whatever its unit: units share the memory windows, and what an earlier owner left running
//! is ended or waited for first.

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_regs::{ident, interrupts};

use crate::deadline::Backoff;
use crate::displace::Displace;
use crate::{Capabilities, Cause, Counters, Deadline, Error, Pree, State, Unit};

/// A probed device, and what is known of its state.
#[derive(Debug)]
pub struct Lucerna<B, D> {
    bus: B,
    pub(crate) delay: D,
    capabilities: Capabilities,
    /// [`State::Untouched`] only of a device without a unit to be in a state.
    state: State,
    /// The unit the state is about: all others are idle.
    unit: Unit,
}

/// Whether a job is complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Progress {
    /// Not yet.
    Running,
    /// Its results are in device memory.
    Done,
}

/// What the interrupt status says of the running job.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Events {
    /// It is complete.
    pub(crate) done: bool,
    /// An error was recorded.
    failed: bool,
}

impl<B: Bus, D: DelayNs> Lucerna<B, D> {
    /// Reads what the device is and does; nothing is written. If an earlier owner left a job running or ended
    /// in an error, [`state`](Self::state) says so, and [`recover`](Self::recover) comes first.
    pub fn probe(mut bus: B, delay: D) -> Result<Self, Error<B::Error>> {
        let capabilities = Capabilities::probe(&mut bus)?;
        let mut device = Self { bus, delay, capabilities, state: State::Untouched, unit: Unit::Pree };
        for unit in capabilities.present() {
            let state = unit.state(device.read(unit.status())?);
            match device.state {
                State::Untouched | State::Idle => (device.state, device.unit) = (state, unit),
                // Two jobs are more than a driver of one can wait for.
                _ if state != State::Idle => device.state = State::Unknown,
                _ => {}
            }
        }
        Ok(device)
    }

    /// What the device was built of.
    pub const fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    /// What is known of the device's state, without asking it.
    pub const fn state(&self) -> State {
        self.state
    }

    /// The progressive radiance estimation engine.
    pub fn pree(&mut self) -> Result<Pree<'_, B, D>, Error<B::Error>> {
        if !self.capabilities.has_pree() {
            return Err(Error::untouched(Cause::NoUnit));
        }
        Ok(Pree::new(self))
    }

    /// The pyramidal displacement mapping unit.
    pub fn displace(&mut self) -> Result<Displace<'_, B, D>, Error<B::Error>> {
        if !self.capabilities.has(Unit::Displace) {
            return Err(Error::untouched(Cause::NoUnit));
        }
        Ok(Displace::new(self))
    }

    /// The unit [`state`](Self::state) is about: that of the last job.
    pub const fn unit(&self) -> Unit {
        self.unit
    }

    /// The bus and the delay; the device is left as it is.
    pub fn release(self) -> (B, D) {
        (self.bus, self.delay)
    }

    /// Brings the device back to idle after any failure: checks that it is there, aborts whatever runs on
    /// any unit, disables and clears the interrupts, and sees that all is idle. Results of an aborted job are worthless; buffers,
    /// windows and configuration are written anew by the next job.
    ///
    /// It may itself fail on the bus; then it can be called again.
    pub fn recover(&mut self) -> Result<(), Error<B::Error>> {
        // A dead bus reads all zeros or ones, and zeros would say "idle" below.
        let id = self.read(ident::ID)?;
        if id != ident::ID_RESET {
            self.state = State::Unknown;
            return Err(self.error(Cause::WrongDevice { id }));
        }
        let mut events = 0;
        for unit in self.capabilities.present() {
            let (offset, abort) = unit.abort();
            self.command(offset, abort)?;
            events |= unit.events();
        }
        self.command(interrupts::ENABLE, 0)?;
        self.command(interrupts::STATUS, events)?;
        for unit in self.capabilities.present() {
            if unit.state(self.read(unit.status())?) != State::Idle {
                self.state = State::Unknown;
                return Err(self.error(Cause::Stuck));
            }
        }
        self.state = State::Idle;
        Ok(())
    }

    /// All counters of the progressive radiance estimation engine, from one moment. They accumulate over jobs.
    pub fn counters(&mut self) -> Result<Counters, Error<B::Error>> {
        if !self.capabilities.has_pree() {
            return Err(self.error(Cause::NoUnit));
        }
        Counters::read(self)
    }

    /// Sets all of them to 0.
    pub fn clear_counters(&mut self) -> Result<(), Error<B::Error>> {
        if !self.capabilities.has_pree() {
            return Err(self.error(Cause::NoUnit));
        }
        Counters::clear(self)
    }
}

/// Accesses: which of them leave the state of the device open, and which do not.
impl<B: Bus, D: DelayNs> Lucerna<B, D> {
    /// `cause`, with the state as it is known.
    pub(crate) fn error(&self, cause: Cause<B::Error>) -> Error<B::Error> {
        Error { cause, state: self.state }
    }

    /// Reads a register. No register of the map changes when read, so a failure changes nothing.
    pub(crate) fn read(&mut self, offset: u32) -> Result<u32, Error<B::Error>> {
        self.bus.read(offset).map_err(|error| Error { cause: Cause::Bus(error), state: self.state })
    }

    /// Reads the two halves of a counter, which belong together in a snapshot.
    pub(crate) fn read_pair(&mut self, low: u32, high: u32) -> Result<u64, Error<B::Error>> {
        let low = self.read(low)?;
        Ok(u64::from(self.read(high)?) << 32 | u64::from(low))
    }

    /// Writes a register which no job depends on (counters, interrupt enable): a failure changes nothing.
    pub(crate) fn adjust(&mut self, offset: u32, value: u32) -> Result<(), Error<B::Error>> {
        self.bus.write(offset, value).map_err(|error| Error { cause: Cause::Bus(error), state: self.state })
    }

    /// Writes a register of a job: after a failure, nobody knows whether the device has seen it.
    pub(crate) fn command(&mut self, offset: u32, value: u32) -> Result<(), Error<B::Error>> {
        self.bus.write(offset, value).map_err(|error| {
            self.state = State::Unknown;
            Error { cause: Cause::Bus(error), state: State::Unknown }
        })
    }

    /// Reads device memory.
    pub(crate) fn fetch(&mut self, address: u32, words: &mut [u32]) -> Result<(), Error<B::Error>> {
        self.bus
            .read_block(address, words)
            .map_err(|error| Error { cause: Cause::Bus(error), state: self.state })
    }

    /// Writes device memory which no running job looks at: after a failure, it can be written again.
    pub(crate) fn store(&mut self, address: u32, words: &[u32]) -> Result<(), Error<B::Error>> {
        self.bus
            .write_block(address, words)
            .map_err(|error| Error { cause: Cause::Bus(error), state: self.state })
    }
}

/// Jobs, whatever the unit and mode.
impl<B: Bus, D: DelayNs> Lucerna<B, D> {
    /// Refuses a call which needs another state.
    pub(crate) fn expect(&self, state: State) -> Result<(), Error<B::Error>> {
        if self.state == state { Ok(()) } else { Err(self.error(Cause::NotReady)) }
    }

    /// Refuses a call unless `unit` has a job, running or ended unseen, that can be waited for.
    pub(crate) fn expect_job(&self, unit: Unit) -> Result<(), Error<B::Error>> {
        match self.state {
            State::Untouched | State::Idle => Err(self.error(Cause::NoJob)),
            State::Running if self.unit == unit => Ok(()),
            State::Running | State::Faulted | State::Unknown => Err(self.error(Cause::NotReady)),
        }
    }

    /// The start of a job whose registers are written.
    pub(crate) fn start(&mut self, unit: Unit) -> Result<(), Error<B::Error>> {
        self.unit = unit;
        self.command(interrupts::STATUS, unit.events())?;
        let (offset, start) = unit.start();
        self.command(offset, start)?;
        self.state = State::Running;
        Ok(())
    }

    /// One look at the job: a read while it runs.
    pub(crate) fn poll(&mut self) -> Result<Progress, Error<B::Error>> {
        let events = self.events()?;
        self.settle(events)
    }

    /// Which events have come; nothing is cleared. A job already seen to its end asks no more.
    pub(crate) fn events(&mut self) -> Result<Events, Error<B::Error>> {
        if self.state == State::Idle {
            return Ok(Events { done: true, failed: false });
        }
        self.expect(State::Running)?;
        let bits = self.read(interrupts::STATUS)?;
        Ok(Events { done: bits & self.unit.done() != 0, failed: bits & self.unit.failed() != 0 })
    }

    /// Acts on events: an error, the end, or neither.
    pub(crate) fn settle(&mut self, events: Events) -> Result<Progress, Error<B::Error>> {
        if self.state == State::Idle {
            return Ok(Progress::Done);
        }
        if events.failed {
            return Err(self.fault());
        }
        if !events.done {
            return Ok(Progress::Running);
        }
        self.state = State::Idle;
        // Lowers the interrupt line. Should this fail, the job is complete all the same, as the next look says.
        self.adjust(interrupts::STATUS, self.unit.events())?;
        Ok(Progress::Done)
    }

    /// What error the device has found.
    fn fault(&mut self) -> Error<B::Error> {
        let (error, address) = self.unit.error();
        let (bits, address) = match (self.read(error), self.read(address)) {
            (Ok(bits), Ok(address)) => (bits, address),
            // The job is over, but why must be asked again.
            (Err(error), _) | (_, Err(error)) => return error,
        };
        let nonsense = (Cause::Nonsense { offset: error, bits }, State::Unknown);
        let (cause, state) = self.unit.fault(bits, address).unwrap_or(nonsense);
        self.state = state;
        self.error(cause)
    }

    /// The ring's counts contradict each other: what the device makes of it cannot be told.
    pub(crate) fn overrun(&mut self, head: u32, tail: u32) -> Error<B::Error> {
        self.state = State::Unknown;
        self.error(Cause::RingOverrun { head, tail })
    }

    /// Polls until the job is complete.
    pub(crate) fn wait(&mut self, deadline: Deadline) -> Result<(), Error<B::Error>> {
        let mut backoff = Backoff::new(deadline);
        while self.poll()? == Progress::Running {
            let Some(pause) = backoff.next() else {
                return Err(self.error(Cause::Timeout));
            };
            self.delay.delay_us(pause);
        }
        Ok(())
    }
}

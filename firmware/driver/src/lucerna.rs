//! The device as a driver sees it. In: a bus and a delay. Out: units' handles, counters, recovery. Cost: a probe
//! of five reads; after that what is asked for.

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_regs::{ident, interrupts, pree};

use crate::deadline::Backoff;
use crate::{Capabilities, Cause, Counters, Deadline, DeviceError, Error, Pree, State};

/// Every bit of the interrupt status: what a job may have set.
const EVENTS: interrupts::Status =
    interrupts::Status::RESET.with_done(true).with_error(true).with_ring_space(true);

/// A probed device, and what is known of its state.
#[derive(Debug)]
pub struct Lucerna<B, D> {
    bus: B,
    pub(crate) delay: D,
    capabilities: Capabilities,
    /// [`State::Untouched`] only of a device without a unit to be in a state.
    state: State,
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

impl<B: Bus, D: DelayNs> Lucerna<B, D> {
    /// Reads what the device is and does; nothing is written. If an earlier owner left a job running or ended
    /// in an error, [`state`](Self::state) says so, and [`recover`](Self::recover) comes first.
    pub fn probe(mut bus: B, delay: D) -> Result<Self, Error<B::Error>> {
        let capabilities = Capabilities::probe(&mut bus)?;
        let mut device = Self { bus, delay, capabilities, state: State::Untouched };
        if capabilities.has_pree() {
            device.state = match pree::Status::from_bits(device.read(pree::STATUS)?).state() {
                Ok(pree::State::Idle) => State::Idle,
                Ok(pree::State::Running) => State::Running,
                Ok(pree::State::Fault) => State::Faulted,
                Err(_) => State::Unknown,
            };
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

    /// The bus and the delay; the device is left as it is.
    pub fn release(self) -> (B, D) {
        (self.bus, self.delay)
    }

    /// Brings the device back to idle after any failure: checks that it is there, aborts whatever runs, disables
    /// and clears the interrupts, and sees that it is idle. Results of an aborted job are worthless; buffers,
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
        self.command(pree::CONTROL, pree::Control::RESET.with_abort(true).bits())?;
        self.command(interrupts::ENABLE, 0)?;
        self.command(interrupts::STATUS, EVENTS.bits())?;
        let status = pree::Status::from_bits(self.read(pree::STATUS)?);
        if status.state() == Ok(pree::State::Idle) {
            self.state = State::Idle;
            return Ok(());
        }
        self.state = State::Unknown;
        Err(self.error(Cause::Stuck))
    }

    /// All counters, from one moment. They accumulate over jobs.
    pub fn counters(&mut self) -> Result<Counters, Error<B::Error>> {
        Counters::read(self)
    }

    /// Sets all counters to 0.
    pub fn clear_counters(&mut self) -> Result<(), Error<B::Error>> {
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

    /// The start of a job whose registers are written.
    pub(crate) fn start(&mut self) -> Result<(), Error<B::Error>> {
        self.command(interrupts::STATUS, EVENTS.bits())?;
        self.command(pree::CONTROL, pree::Control::RESET.with_start(true).bits())?;
        self.state = State::Running;
        Ok(())
    }

    /// One look at the job: a read while it runs.
    pub(crate) fn poll(&mut self) -> Result<Progress, Error<B::Error>> {
        let events = self.events()?;
        self.settle(events)
    }

    /// Which events have come; nothing is cleared. A job already seen to its end asks no more.
    pub(crate) fn events(&mut self) -> Result<interrupts::Status, Error<B::Error>> {
        if self.state == State::Idle {
            return Ok(interrupts::Status::RESET.with_done(true));
        }
        self.expect(State::Running)?;
        self.read(interrupts::STATUS).map(interrupts::Status::from_bits)
    }

    /// Acts on events: an error, the end, or neither.
    pub(crate) fn settle(&mut self, events: interrupts::Status) -> Result<Progress, Error<B::Error>> {
        if self.state == State::Idle {
            return Ok(Progress::Done);
        }
        if events.error() {
            return Err(self.fault());
        }
        if !events.done() {
            return Ok(Progress::Running);
        }
        self.state = State::Idle;
        // Lowers the interrupt line. Should this fail, the job is complete all the same, as the next look says.
        self.adjust(interrupts::STATUS, EVENTS.bits())?;
        Ok(Progress::Done)
    }

    /// What error the device has found.
    fn fault(&mut self) -> Error<B::Error> {
        let (bits, address) = match (self.read(pree::ERROR), self.read(pree::FAULT_ADDRESS)) {
            (Ok(bits), Ok(address)) => (bits, address),
            // The job is over, but why must be asked again.
            (Err(error), _) | (_, Err(error)) => return error,
        };
        match pree::Error::from_bits(bits).code() {
            Ok(code) => {
                // A START beside ours (NOT_IDLE) lets the job run, on whose behalf nobody knows.
                let ended = !matches!(code, pree::ErrorCode::None | pree::ErrorCode::NotIdle);
                self.state = if ended { State::Faulted } else { State::Unknown };
                self.error(Cause::Device(DeviceError { code, address }))
            }
            Err(_) => {
                self.state = State::Unknown;
                self.error(Cause::Nonsense { offset: pree::ERROR, bits })
            }
        }
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

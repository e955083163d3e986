//! The fixed-function units of a device, as all their jobs have in common. In: which unit. Out: where its control,
//! status and error are, and what its bits mean. Cost: constants.

use lucerna_regs::{UNIT_DISPLACE, UNIT_PREE, displace, interrupts, pree};

use crate::{Cause, DeviceError, DisplaceError, State};

/// A fixed-function unit: what a job runs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Unit {
    /// The progressive radiance estimation engine.
    Pree,
    /// The pyramidal displacement mapping unit.
    Displace,
}

impl Unit {
    /// All of them, in the order of their bits in `CAPABILITIES.UNITS`.
    pub const ALL: [Self; 2] = [Self::Pree, Self::Displace];

    /// Its bit in `CAPABILITIES.UNITS`.
    pub const fn bit(self) -> u32 {
        match self {
            Self::Pree => UNIT_PREE,
            Self::Displace => UNIT_DISPLACE,
        }
    }

    /// The write that starts a job.
    pub(crate) const fn start(self) -> (u32, u32) {
        match self {
            Self::Pree => (pree::CONTROL, pree::Control::RESET.with_start(true).bits()),
            Self::Displace => (displace::CONTROL, displace::Control::RESET.with_start(true).bits()),
        }
    }

    /// The write that ends one.
    pub(crate) const fn abort(self) -> (u32, u32) {
        match self {
            Self::Pree => (pree::CONTROL, pree::Control::RESET.with_abort(true).bits()),
            Self::Displace => (displace::CONTROL, displace::Control::RESET.with_abort(true).bits()),
        }
    }

    /// Offset of the status register.
    pub(crate) const fn status(self) -> u32 {
        match self {
            Self::Pree => pree::STATUS,
            Self::Displace => displace::STATUS,
        }
    }

    /// What a word of the status register says.
    pub(crate) const fn state(self, bits: u32) -> State {
        match self {
            Self::Pree => match pree::Status::from_bits(bits).state() {
                Ok(pree::State::Idle) => State::Idle,
                Ok(pree::State::Running) => State::Running,
                Ok(pree::State::Fault) => State::Faulted,
                Err(_) => State::Unknown,
            },
            Self::Displace => match displace::Status::from_bits(bits).state() {
                Ok(displace::State::Idle) => State::Idle,
                Ok(displace::State::Running) => State::Running,
                Ok(displace::State::Fault) => State::Faulted,
                Err(_) => State::Unknown,
            },
        }
    }

    /// Offsets of the error register and of the address it is about.
    pub(crate) const fn error(self) -> (u32, u32) {
        match self {
            Self::Pree => (pree::ERROR, pree::FAULT_ADDRESS),
            Self::Displace => (displace::ERROR, displace::FAULT_ADDRESS),
        }
    }

    /// What a word of the error register says, and the state that leaves the unit in; `None` if it means nothing.
    /// A START beside ours (`NOT_IDLE`) lets the job run, on whose behalf nobody knows.
    pub(crate) fn fault<E>(self, bits: u32, address: u32) -> Option<(Cause<E>, State)> {
        let state = |ended| if ended { State::Faulted } else { State::Unknown };
        match self {
            Self::Pree => {
                let code = pree::Error::from_bits(bits).code().ok()?;
                let ended = !matches!(code, pree::ErrorCode::None | pree::ErrorCode::NotIdle);
                Some((Cause::Device(DeviceError { code, address }), state(ended)))
            }
            Self::Displace => {
                let code = displace::Error::from_bits(bits).code().ok()?;
                let ended = !matches!(code, displace::ErrorCode::None | displace::ErrorCode::NotIdle);
                Some((Cause::Displace(DisplaceError { code, address }), state(ended)))
            }
        }
    }

    /// Every bit of the interrupt status that its jobs may set.
    pub(crate) const fn events(self) -> u32 {
        let none = interrupts::Status::RESET;
        match self {
            Self::Pree => none.with_done(true).with_error(true).with_ring_space(true).bits(),
            Self::Displace => none.with_displace_done(true).with_displace_error(true).bits(),
        }
    }

    /// The event of a job's end.
    pub(crate) const fn done(self) -> u32 {
        match self {
            Self::Pree => interrupts::Status::RESET.with_done(true).bits(),
            Self::Displace => interrupts::Status::RESET.with_displace_done(true).bits(),
        }
    }

    /// The event of an error.
    pub(crate) const fn failed(self) -> u32 {
        match self {
            Self::Pree => interrupts::Status::RESET.with_error(true).bits(),
            Self::Displace => interrupts::Status::RESET.with_displace_error(true).bits(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two registers of the interrupt line number the events alike, which enabling them relies on.
    #[test]
    fn status_and_enable_number_the_events_alike() {
        assert_eq!(interrupts::Status::MASK, interrupts::Enable::MASK);
        assert_eq!(interrupts::Enable::RESET.with_done(true).bits(), Unit::Pree.done());
        assert_eq!(interrupts::Enable::RESET.with_displace_done(true).bits(), Unit::Displace.done());
        assert_eq!(interrupts::Enable::RESET.with_displace_error(true).bits(), Unit::Displace.failed());
        assert_eq!(Unit::ALL.map(Unit::events).iter().sum::<u32>(), interrupts::Status::MASK);
        assert_eq!(Unit::ALL.map(Unit::bit), [1, 2]);
    }
}

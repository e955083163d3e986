//! ERROR and FAULT_ADDRESS of a unit; in: faults as they come, out: the first that matters; cost: a code and an address.

/// The codes of a unit's ERROR register.
pub trait ErrorCode: Copy + PartialEq {
    /// No error.
    const NONE: Self;
    /// A start while a job ran, which went on.
    const NOT_IDLE: Self;
}

impl ErrorCode for lucerna_regs::pree::ErrorCode {
    const NONE: Self = Self::None;
    const NOT_IDLE: Self = Self::NotIdle;
}

impl ErrorCode for lucerna_regs::displace::ErrorCode {
    const NONE: Self = Self::None;
    const NOT_IDLE: Self = Self::NotIdle;
}

/// The first error since the last start or abort. NOT_IDLE ends no job, so it does not hide what does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FirstError<E> {
    code: E,
    address: u32,
}

impl<E: ErrorCode> FirstError<E> {
    /// No error.
    pub const NONE: Self = Self { code: E::NONE, address: 0 };

    /// Keeps an error, unless there is one already that ended a job.
    pub fn record(&mut self, code: E, address: u32) {
        if self.code == E::NONE || self.code == E::NOT_IDLE {
            *self = Self { code, address };
        }
    }

    /// Its code.
    pub const fn code(&self) -> E {
        self.code
    }

    /// The byte address it is about, 0 if none.
    pub const fn address(&self) -> u32 {
        self.address
    }
}

#[cfg(test)]
mod tests {
    use super::FirstError;
    use lucerna_regs::displace::ErrorCode::{self, NotIdle, Overlap, Window};

    #[test]
    fn the_first_error_stays_and_not_idle_gives_way() {
        let mut error = FirstError::<ErrorCode>::NONE;
        error.record(NotIdle, 0);
        error.record(Window, 64);
        error.record(Overlap, 128);
        error.record(NotIdle, 0);
        assert_eq!((error.code(), error.address()), (Window, 64));
    }
}

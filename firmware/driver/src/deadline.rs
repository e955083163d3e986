//! How long a call may wait. In: a time. Out: the waits of one call, which add up to it. Cost: two words.

/// The longest a call may wait, in device time as its delay tells it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Deadline {
    micros: u32,
}

impl Deadline {
    /// No wait at all: one look.
    pub const NOW: Self = Self::micros(0);

    /// So many microseconds from the call on.
    pub const fn micros(micros: u32) -> Self {
        Self { micros }
    }

    /// So many milliseconds from the call on; at most 71 minutes.
    pub const fn millis(millis: u32) -> Self {
        Self { micros: millis.saturating_mul(1_000) }
    }

    /// So many seconds from the call on; at most 71 minutes.
    pub const fn seconds(seconds: u32) -> Self {
        Self { micros: seconds.saturating_mul(1_000_000) }
    }

    /// In microseconds.
    pub const fn as_micros(self) -> u32 {
        self.micros
    }
}

/// Pauses between looks: 1 µs, then twice as long each, up to a limit, until the deadline is used up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Backoff {
    left: u32,
    pause: u32,
}

impl Backoff {
    /// The longest pause of a blocking wait, in microseconds.
    pub(crate) const LONGEST: u32 = 1_000;

    pub(crate) const fn new(deadline: Deadline) -> Self {
        Self { left: deadline.micros, pause: 1 }
    }

    /// The next pause in microseconds; `None` once the deadline is used up.
    pub(crate) fn next(&mut self) -> Option<u32> {
        let pause = self.pause.min(self.left);
        self.left -= pause;
        self.pause = (self.pause * 2).min(Self::LONGEST);
        (pause > 0).then_some(pause)
    }

    /// Looks often again: something moved.
    pub(crate) const fn restart(&mut self) {
        self.pause = 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_double_to_a_millisecond_and_add_up_to_the_deadline() {
        let mut backoff = Backoff::new(Deadline::millis(5));
        let pauses: Vec<u32> = core::iter::from_fn(|| backoff.next()).collect();
        assert_eq!(pauses, [1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000, 1000, 1000, 977]);
        assert_eq!(pauses.iter().sum::<u32>(), 5000);
        assert_eq!(Backoff::new(Deadline::NOW).next(), None);
        assert_eq!(Deadline::seconds(5000).as_micros(), u32::MAX);
    }

    #[test]
    fn a_restart_shortens_the_pause_and_not_the_deadline() {
        let mut backoff = Backoff::new(Deadline::micros(10));
        assert_eq!((backoff.next(), backoff.next()), (Some(1), Some(2)));
        backoff.restart();
        let pauses: Vec<u32> = core::iter::from_fn(|| backoff.next()).collect();
        assert_eq!(pauses, [1, 2, 4]);
    }
}

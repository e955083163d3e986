//! The memory read port that all requesters share; in: line requests, out: their fills some cycles later; cost: one queue.
//!
//! The memory behind it has no state: no banks, no rows, no refresh, so a line takes the same time wherever it is, and only the
//! data bus can be in the way. Requests are granted first come first served; within a cycle the order is that of the calls, so
//! a device that calls its units in a fixed order has a fixed-priority arbiter.

use heapless::Deque;

/// What went through a port since the totals were last cleared.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Totals {
    /// Lines granted.
    pub lines: u64,
    /// Bytes of these lines.
    pub bytes: u64,
    /// Cycles in which the data bus is taken by them. All of a line's cycles are counted when it is granted.
    pub busy: u64,
    /// Cycles that requests waited for the data bus, summed.
    pub waits: u64,
}

/// A port with up to `DEPTH` lines in flight, each with a tag that says what it is for.
///
/// A request of cycle `c` is granted in `g = max(c, the cycle in which the data bus is free)`, takes the bus for as many cycles
/// as its bytes need, and its fill arrives in `g + latency`, so never before the fill of an earlier request.
///
/// ```
/// use lucerna_fabric::port::Port;
/// let mut port: Port<char, 16> = Port::new(40, 8);
/// port.request(0, 32, 'a').unwrap();
/// port.request(0, 32, 'b').unwrap();
/// assert_eq!(port.arrived(39), None);
/// assert_eq!(port.arrived(40), Some('a'));
/// // The first line has the bus for 32 / 8 cycles.
/// assert_eq!(port.next_arrival(), Some(44));
/// ```
#[derive(Clone, Debug)]
pub struct Port<T, const DEPTH: usize> {
    latency: u64,
    bytes_per_cycle: u32,
    /// The first cycle in which the data bus is free.
    free: u64,
    /// In the order of arrival.
    flight: Deque<(u64, T), DEPTH>,
    totals: Totals,
}

impl<T: Copy, const DEPTH: usize> Port<T, DEPTH> {
    /// A free port; a latency or width of 0 is taken as 1.
    #[must_use]
    pub const fn new(latency: u32, bytes_per_cycle: u32) -> Self {
        const fn at_least_one(x: u32) -> u32 {
            if x == 0 { 1 } else { x }
        }
        Self {
            latency: at_least_one(latency) as u64,
            bytes_per_cycle: at_least_one(bytes_per_cycle),
            free: 0,
            flight: Deque::new(),
            totals: Totals { lines: 0, bytes: 0, busy: 0, waits: 0 },
        }
    }

    /// Asks for a line in cycle `now`, which is never before that of an earlier call.
    ///
    /// # Errors
    /// The tag, when `DEPTH` lines are in flight: ask again when one has arrived.
    #[inline]
    pub fn request(&mut self, now: u64, bytes: u32, tag: T) -> Result<(), T> {
        let grant = self.free.max(now);
        self.flight.push_back((grant + self.latency, tag)).map_err(|(_, tag)| tag)?;
        let cycles = u64::from(bytes.div_ceil(self.bytes_per_cycle));
        self.free = grant + cycles;
        self.totals.lines += 1;
        self.totals.bytes += u64::from(bytes);
        self.totals.busy += cycles;
        self.totals.waits += grant - now;
        Ok(())
    }

    /// Takes a fill that has arrived by cycle `now`. One call a fill: call until there is none.
    #[inline]
    pub fn arrived(&mut self, now: u64) -> Option<T> {
        let (cycle, _) = self.flight.front()?;
        if *cycle > now {
            return None;
        }
        self.flight.pop_front().map(|(_, tag)| tag)
    }

    /// The cycle in which the next fill arrives.
    #[inline]
    pub fn next_arrival(&self) -> Option<u64> {
        self.flight.front().map(|(cycle, _)| *cycle)
    }

    /// Tags of the lines in flight, in the order of their arrival.
    pub fn in_flight(&self) -> impl Iterator<Item = &T> {
        self.flight.iter().map(|(_, tag)| tag)
    }

    /// Whether a request would be given back.
    #[inline]
    pub fn is_full(&self) -> bool {
        self.flight.is_full()
    }

    /// Whether nothing is in flight.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.flight.is_empty()
    }

    /// Drops what is in flight and frees the bus, as at reset: cycles may then be counted from 0 again. Totals stay.
    pub fn clear(&mut self) {
        self.flight.clear();
        self.free = 0;
    }

    /// What went through.
    #[inline]
    pub const fn totals(&self) -> &Totals {
        &self.totals
    }

    /// Sets the totals to zero.
    pub fn clear_totals(&mut self) {
        self.totals = Totals::default();
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{Port, Totals};
    use proptest::prelude::*;
    use std::vec::Vec;

    #[test]
    fn a_fill_arrives_at_the_latency_and_not_one_cycle_before() {
        let mut port: Port<u8, 4> = Port::new(40, 8);
        port.request(100, 32, 1).unwrap();
        assert_eq!(port.arrived(139), None);
        assert_eq!(port.arrived(140), Some(1));
        assert_eq!(port.arrived(140), None);
    }

    #[test]
    fn the_second_line_of_a_cycle_waits_for_the_bus() {
        let mut port: Port<u8, 4> = Port::new(40, 8);
        port.request(0, 32, 1).unwrap();
        port.request(0, 32, 2).unwrap();
        assert_eq!((port.arrived(43), port.arrived(43)), (Some(1), None));
        assert_eq!(port.arrived(44), Some(2));
        assert_eq!(*port.totals(), Totals { lines: 2, bytes: 64, busy: 8, waits: 4 });
    }

    #[test]
    fn a_bus_that_was_idle_is_not_paid_back() {
        let mut port: Port<u8, 4> = Port::new(10, 8);
        port.request(0, 32, 1).unwrap();
        port.request(4, 32, 2).unwrap();
        port.request(100, 33, 3).unwrap();
        port.request(101, 32, 4).unwrap();
        assert_eq!(port.totals().waits, 4, "33 bytes take five cycles, 100 to 104");
        assert_eq!(port.totals().busy, 4 + 4 + 5 + 4);
    }

    #[test]
    fn a_full_port_gives_the_tag_back_and_counts_nothing() {
        let mut port: Port<u8, 2> = Port::new(40, 8);
        port.request(0, 32, 1).unwrap();
        port.request(0, 32, 2).unwrap();
        assert!(port.is_full());
        assert_eq!(port.request(0, 32, 3), Err(3));
        assert_eq!(port.totals().lines, 2);
        assert_eq!(port.arrived(40), Some(1));
        assert_eq!(port.request(40, 32, 3), Ok(()));
    }

    #[test]
    fn cleared_it_counts_from_zero_again() {
        let mut port: Port<u8, 2> = Port::new(40, 8);
        port.request(1000, 32, 1).unwrap();
        port.clear();
        assert!(port.is_empty());
        port.request(0, 32, 2).unwrap();
        assert_eq!(port.next_arrival(), Some(40));
    }

    proptest! {
        /// Against a bus that moves one beat a cycle.
        #[test]
        fn is_a_bus_that_moves_beat_by_beat(
            requests in prop::collection::vec((0u64..20, 1u32..80), 1..40),
            latency in 1u32..50,
            width in 1u32..20,
        ) {
            let mut port: Port<usize, 64> = Port::new(latency, width);
            let (mut asked, mut cycle) = (Vec::new(), 0);
            for (tag, (gap, bytes)) in requests.iter().enumerate() {
                cycle += gap;
                port.request(cycle, *bytes, tag).unwrap();
                asked.push((cycle, *bytes));
            }
            // The bus: whoever is next in line and has asked gets it when the line before has moved its last byte.
            let (mut expected, mut busy, mut next, mut left) = (Vec::new(), 0, 0, 0);
            for cycle in 0.. {
                if left == 0 {
                    let Some((asked_at, bytes)) = asked.get(next) else { break };
                    if *asked_at > cycle { continue }
                    expected.push((cycle + u64::from(latency), next));
                    left = *bytes;
                    next += 1;
                }
                busy += 1;
                left = left.saturating_sub(width);
            }
            let mut got = Vec::new();
            while let Some(cycle) = port.next_arrival() {
                prop_assert_eq!(port.arrived(cycle - 1), None);
                got.push((cycle, port.arrived(cycle).unwrap()));
            }
            prop_assert_eq!(got, expected);
            prop_assert_eq!(port.totals().busy, busy);
        }
    }
}

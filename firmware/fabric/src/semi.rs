//! A semi-pipelined unit; in: an operation every few cycles, out: its result some cycles later, or when it is taken; cost: a
//! queue of results.
//!
//! All is in absolute cycle numbers, so a caller may skip the cycles in which nothing happens. Downstream goes first within a
//! cycle: take the result, then issue.

use heapless::Deque;

/// How often a unit takes an operation, and how long it works on one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Pace {
    /// Cycles from an issue to the next: the initiation interval.
    pub interval: u32,
    /// Cycles from an issue to its result.
    pub latency: u32,
}

impl Pace {
    /// Most operations that are in it at once.
    pub const fn depth(self) -> usize {
        let interval = if self.interval == 0 { 1 } else { self.interval };
        self.latency.div_ceil(interval) as usize
    }
}

/// A unit that shares its operators between the steps of an operation, so that it takes one every `interval` cycles only.
///
/// An operation issued in cycle `c` is ready in `c + latency`. A result that is not taken then holds the whole unit: it has one
/// clock enable, so all that is behind it stands still, and nothing is issued, until it is taken. `DEPTH` is at least
/// [`Pace::depth`]; with less the unit is never wrong, but waits for room.
///
/// ```
/// use lucerna_fabric::semi::{Pace, SemiPipeline};
/// let mut unit: SemiPipeline<char, 3> = SemiPipeline::new(Pace { interval: 4, latency: 9 });
/// unit.issue(10, 'a').unwrap();
/// assert!(!unit.can_issue(13) && unit.can_issue(14));
/// assert_eq!(unit.ready(18), None);
/// assert_eq!(unit.take(19), Some('a'));
/// ```
#[derive(Clone, Debug)]
pub struct SemiPipeline<T, const DEPTH: usize> {
    pace: Pace,
    /// Results and the cycles of the unit's own clock in which they are ready.
    flight: Deque<(u64, T), DEPTH>,
    /// The first cycle of its own clock in which it takes an operation.
    free: u64,
    /// By how many cycles its own clock is behind: how long results were held.
    held: u64,
    /// In which cycle of its own clock it stood still last, and how far behind that was before.
    stop: u64,
    held_before: u64,
}

impl<T, const DEPTH: usize> SemiPipeline<T, DEPTH> {
    /// An empty unit; an interval or latency of 0 is taken as 1.
    #[must_use]
    pub const fn new(pace: Pace) -> Self {
        const { assert!(DEPTH > 0, "a unit holds at least one operation") };
        let interval = if pace.interval == 0 { 1 } else { pace.interval };
        let latency = if pace.latency == 0 { 1 } else { pace.latency };
        let pace = Pace { interval, latency };
        Self { pace, flight: Deque::new(), free: 0, held: 0, stop: 0, held_before: 0 }
    }

    /// Its pace. Its issue is taken for `interval` cycles an operation.
    #[inline]
    pub const fn pace(&self) -> Pace {
        self.pace
    }

    /// Whether it takes an operation in this cycle.
    #[inline]
    pub fn can_issue(&self, now: u64) -> bool {
        now >= self.free + self.held && self.ready(now).is_none() && !self.flight.is_full()
    }

    /// Issues an operation, whose result is known at once and carried along.
    ///
    /// # Errors
    /// The operation, when the unit does not take one in this cycle.
    #[inline]
    pub fn issue(&mut self, now: u64, operation: T) -> Result<(), T> {
        if !self.can_issue(now) {
            return Err(operation);
        }
        self.put(now - self.held, operation)
    }

    #[inline]
    fn put(&mut self, own: u64, operation: T) -> Result<(), T> {
        self.free = own + u64::from(self.pace.interval);
        self.flight
            .push_back((own + u64::from(self.pace.latency), operation))
            .map_err(|(_, operation)| operation)
    }

    /// The result that may be taken in this cycle.
    #[inline]
    pub fn ready(&self, now: u64) -> Option<&T> {
        let (own, result) = self.flight.front()?;
        (own + self.held <= now).then_some(result)
    }

    /// Takes it.
    #[inline]
    pub fn take(&mut self, now: u64) -> Option<T> {
        self.ready(now)?;
        let (own, result) = self.flight.pop_front()?;
        self.hold(own, now);
        Some(result)
    }

    /// The result of the cycle `own` of its own clock is taken now.
    #[inline]
    fn hold(&mut self, own: u64, now: u64) {
        if now > own + self.held {
            (self.stop, self.held_before) = (own, self.held);
            self.held = now - own;
        }
    }

    /// The cycle of its own clock in cycle `now`, which is not before the last issue.
    #[inline]
    fn own(&self, now: u64) -> u64 {
        let before = now.saturating_sub(self.held_before);
        if before <= self.stop { before } else { now.saturating_sub(self.held).max(self.stop) }
    }

    /// The first cycle from `from` on in which it takes an operation, if no result is held but those that were taken.
    ///
    /// A caller that is behind may ask for a cycle before that of the last [`take`](Self::take) or [`pass`](Self::pass), but not
    /// before the last issue, and only of a unit whose results are never held, or whose latency is at most two intervals: it
    /// remembers one hold.
    #[inline]
    pub fn offered(&self, from: u64) -> u64 {
        let own = self.own(from).max(self.free);
        own + if own < self.stop { self.held_before } else { self.held }
    }

    /// Issues an operation in such a cycle.
    ///
    /// # Errors
    /// The operation, when a result is held in this cycle, or the unit is full.
    #[inline]
    pub fn issue_late(&mut self, now: u64, operation: T) -> Result<(), T> {
        if !self.can_issue_late(now) {
            return Err(operation);
        }
        self.put(self.own(now), operation)
    }

    /// Whether it takes an operation in such a cycle.
    #[inline]
    pub fn can_issue_late(&self, now: u64) -> bool {
        self.own(now) >= self.free && self.ready(now).is_none() && !self.flight.is_full()
    }

    /// When the result of an operation that is issued in cycle `issue`, as [`offered`](Self::offered), is ready.
    #[inline]
    pub fn result_of(&self, issue: u64) -> u64 {
        self.own(issue) + u64::from(self.pace.latency) + self.held
    }

    /// An operation goes through a unit whose queue is empty: it is issued in cycle `issue`, as [`offered`](Self::offered), and its
    /// result taken in cycle `taken`, not before it is ready. Spares the queue.
    #[inline]
    pub fn pass(&mut self, issue: u64, taken: u64) {
        let own = self.own(issue);
        self.free = own + u64::from(self.pace.interval);
        self.hold(own + u64::from(self.pace.latency), taken);
    }

    /// The cycle in which the oldest operation is ready, or was: nothing leaves before.
    #[inline]
    pub fn next_event(&self) -> Option<u64> {
        self.flight.front().map(|(own, _)| own + self.held)
    }

    /// The first cycle in which it takes an operation, if no result is held until then.
    #[inline]
    pub const fn next_issue(&self) -> u64 {
        self.free + self.held
    }

    /// Whether nothing is in it.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.flight.is_empty()
    }

    /// Whether it holds as many operations as it can: it takes none, then.
    #[inline]
    pub fn is_full(&self) -> bool {
        self.flight.is_full()
    }

    /// Drops what is in it, as at reset: cycles may then be counted from 0 again.
    pub fn clear(&mut self) {
        self.flight.clear();
        (self.free, self.held, self.stop, self.held_before) = (0, 0, 0, 0);
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{Pace, SemiPipeline};
    use proptest::prelude::*;
    use std::vec::Vec;

    const PACE: Pace = Pace { interval: 3, latency: 9 };

    #[test]
    fn takes_one_each_interval_and_gives_it_at_the_latency() {
        let mut unit: SemiPipeline<u64, 3> = SemiPipeline::new(PACE);
        let (mut issued, mut taken) = (Vec::new(), Vec::new());
        for now in 0..20 {
            if let Some(cycle) = unit.take(now) {
                taken.push((now, cycle));
            }
            if unit.issue(now, now).is_ok() {
                issued.push(now);
            }
        }
        assert_eq!(issued, [0, 3, 6, 9, 12, 15, 18]);
        assert_eq!(taken, [(9, 0), (12, 3), (15, 6), (18, 9)]);
    }

    #[test]
    fn a_held_result_holds_all_that_is_behind_it() {
        let mut unit: SemiPipeline<char, 3> = SemiPipeline::new(PACE);
        unit.issue(0, 'a').unwrap();
        unit.issue(8, 'b').unwrap();
        assert_eq!(unit.issue(13, 'c'), Err('c'), "a is held since cycle 9");
        assert_eq!(unit.take(19), Some('a'));
        // Of b's interval two cycles were left in cycle 9, of its latency eight.
        assert_eq!(unit.next_issue(), 21);
        assert!(!unit.can_issue(20) && unit.can_issue(21));
        assert_eq!(unit.ready(26), None);
        assert_eq!(unit.next_event(), Some(27));
        assert_eq!(unit.take(27), Some('b'));
        assert!(unit.is_empty());
    }

    /// The same unit as registers that move when the clock is enabled.
    struct Stages {
        stages: Vec<Option<u64>>,
        since_issue: u32,
        interval: u32,
    }

    impl Stages {
        fn tick(&mut self, take: bool, put: Option<u64>) -> (Option<u64>, bool) {
            let last = self.stages.len() - 1;
            let taken = if take { self.stages[last].take() } else { None };
            if self.stages[last].is_some() {
                return (taken, false);
            }
            let issued = put.is_some() && self.since_issue >= self.interval;
            self.stages.rotate_right(1);
            self.stages[0] = put.filter(|_| issued);
            self.since_issue = if issued { 1 } else { self.since_issue.saturating_add(1) };
            (taken, issued)
        }
    }

    proptest! {
        #[test]
        fn is_a_row_of_registers_with_one_clock_enable(
            interval in 1u32..6,
            latency in 1u32..14,
            cycles in prop::collection::vec((any::<bool>(), 0u8..4), 1..200),
        ) {
            let pace = Pace { interval, latency };
            prop_assert!(pace.depth() <= 13);
            let mut unit: SemiPipeline<u64, 13> = SemiPipeline::new(pace);
            let mut model = Stages { stages: std::vec![None; latency as usize], since_issue: u32::MAX, interval };
            for (now, (put, take)) in cycles.into_iter().enumerate() {
                let now = now as u64;
                let take = take > 0;
                let expected = model.tick(take, put.then_some(now));
                let taken = if take { unit.take(now) } else { None };
                let issued = put && unit.issue(now, now).is_ok();
                prop_assert_eq!((taken, issued), expected, "cycle {}", now);
                prop_assert!(unit.flight.len() <= pace.depth());
            }
        }

        /// An operation followed to its end before the next is looked at, against the same row of registers.
        #[test]
        fn one_after_the_other_is_side_by_side(
            interval in 1u32..6,
            less in 0u32..6,
            gaps in prop::collection::vec((0u64..8, 0u64..14), 1..60),
        ) {
            let pace = Pace { interval, latency: (2 * interval).saturating_sub(less).max(1) };
            let mut unit: SemiPipeline<(), 2> = SemiPipeline::new(pace);
            let (mut offer, mut wanted) = (0, 0);
            let mut expected = Vec::new();
            for (gap, busy) in &gaps {
                offer += gap;
                let issue = unit.offered(offer);
                let taken = unit.result_of(issue).max(wanted);
                unit.pass(issue, taken);
                wanted = taken + 1 + busy;
                expected.push((offer, issue, taken));
            }
            let stages = std::vec![None; pace.latency as usize];
            let mut model = Stages { stages, since_issue: u32::MAX, interval };
            let (mut issued, mut taken, mut wanted) = (0, 0, 0);
            for now in 0u64.. {
                let put = expected.get(issued).is_some_and(|(offer, ..)| *offer <= now);
                let (result, is_issued) = model.tick(now >= wanted, put.then_some(now));
                if result.is_some() {
                    prop_assert_eq!(expected[taken].2, now, "result {}", taken);
                    wanted = now + 1 + gaps[taken].1;
                    taken += 1;
                }
                if is_issued {
                    prop_assert_eq!(expected[issued].1, now, "issue {}", issued);
                    issued += 1;
                }
                if taken == gaps.len() {
                    break;
                }
                prop_assert!(now < 10_000, "stuck");
            }
        }
    }
}

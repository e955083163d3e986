//! Hits on their way from FIFO #1 to their results, one after the other instead of cycle by cycle; in: the cycles to do, out: the
//! state after them; cost: a hit's arithmetic.
//!
//! The cycles in which a hit is issued, read and coloured follow from those of the hit before it: each is the later of when the hit
//! is ready and when the next unit is free. So a hit can be followed to its result before the next is looked at, until a texel is
//! not in the cache. [`Instance::shade`] does the same cycle by cycle.

use lucerna_softfloat::Format;

use crate::instance::{Instance, fetch};
use crate::operators::ADDRESS;
use crate::outside::{Cache, Outside};
use crate::read::Fetch;

// So a hit can be issued after the one before it was read, though that was later: the unit remembers one hold. The results of view
// and colour calculation are never held.
const _: () = assert!(ADDRESS.latency() <= 2 * ADDRESS.interval());

/// How far a hit came.
enum Passed {
    /// The read unit gave it to the colour unit in this cycle.
    Read(u64),
    /// It is still in the read unit, in which nothing is left to do before this cycle.
    Held(u64),
}

impl<F: Format, const LINES: usize> Instance<F, LINES> {
    /// What address, read and colour units do from cycle `from` on and before cycle `end`, in which no line comes. Says up to which
    /// cycle they came: they stop after they have asked for a line.
    pub(crate) fn pass_hits(&mut self, from: u64, end: u64, outside: &mut Outside<'_, F>) -> u64 {
        let mut passed =
            if self.read.is_idle() { Passed::Read(from) } else { self.read_on(from, end, outside) };
        while let Passed::Read(idle) = passed
            && let Some((cycle, mut fetch)) = self.next_fetch(from, idle, end, outside)
        {
            passed = if cycle + 2 <= end
                && self.read.read_both(&mut fetch, outside.job, outside.memory, outside.counters)
            {
                self.hand_on(cycle + 2, end, fetch, outside)
            } else {
                self.read.begin(fetch);
                self.read_on(cycle, end, outside)
            };
        }
        let reached = match passed {
            Passed::Read(_) => end,
            Passed::Held(cycle) => cycle,
        };
        self.fill_address(from, reached, outside);
        self.colour_results(reached, outside);
        reached
    }

    /// The next hit that the read unit, idle from cycle `idle` on, takes before `end`, and when.
    #[inline]
    fn next_fetch(
        &mut self,
        from: u64,
        idle: u64,
        end: u64,
        outside: &mut Outside<'_, F>,
    ) -> Option<(u64, Fetch)> {
        if let Some(ready) = self.address.next_event() {
            let cycle = idle.max(ready);
            outside.counters.address_stalls += cycle.min(end).saturating_sub(ready.max(from));
            return if cycle < end { Some((cycle, self.address.take(cycle)?)) } else { None };
        }
        let issue = self.next_issue(from, end)?;
        let fetch = self.next_hit(outside)?;
        let ready = self.address.result_of(issue);
        let cycle = idle.max(ready);
        if cycle >= end {
            let _ = self.address.issue_late(issue, fetch);
            return None;
        }
        self.address.pass(issue, cycle);
        outside.counters.address_stalls += cycle - ready;
        Some((cycle, fetch))
    }

    /// The cycle in which the address unit takes the next hit, if that is before `end`.
    #[inline]
    fn next_issue(&self, from: u64, end: u64) -> Option<u64> {
        let issue = self.address.offered(from.max(self.fifo1.front()?.left + 1));
        (issue < end).then_some(issue)
    }

    /// The next hit leaves FIFO #1.
    #[inline]
    fn next_hit(&mut self, outside: &mut Outside<'_, F>) -> Option<Fetch> {
        let ended = self.fifo1.pop_front()?;
        outside.counters.address_busy += u64::from(self.address.pace().interval);
        Some(fetch(&ended, outside.job))
    }

    /// The hit in the read unit, from cycle `cycle` on.
    #[inline]
    fn read_on(&mut self, mut cycle: u64, end: u64, outside: &mut Outside<'_, F>) -> Passed {
        while !self.read.is_done() {
            if cycle >= end {
                return Passed::Held(end);
            }
            if self.read.is_waiting() {
                outside.counters.read_stalls += end - cycle;
                return Passed::Held(end);
            }
            if let Some(line) = self.read.access(outside.job, outside.memory, outside.counters) {
                outside.now = cycle;
                outside.request(Cache::Texture, line, self.read.cache.geometry().line_bytes);
                return Passed::Held(cycle + 1);
            }
            cycle += 1;
        }
        match self.read.take() {
            Some(fetch) => self.hand_on(cycle, end, fetch, outside),
            None => Passed::Read(cycle),
        }
    }

    /// A hit whose texels are there from cycle `done` on goes to the colour unit.
    #[inline]
    fn hand_on(&mut self, done: u64, end: u64, fetch: Fetch, outside: &mut Outside<'_, F>) -> Passed {
        let cycle = done.max(self.colour.next_issue());
        outside.counters.read_stalls += cycle.min(end).saturating_sub(done);
        if cycle >= end {
            self.read.hold(fetch);
            return Passed::Held(end);
        }
        self.colour_results(cycle + 1, outside);
        outside.counters.colour_busy += u64::from(self.colour.pace().interval);
        let result = self.colour.result_of(cycle);
        if self.colour.is_empty() && result < end {
            self.colour.pass(cycle, result);
            outside.shaded(&fetch);
        } else {
            let _ = self.colour.issue(cycle, fetch);
        }
        Passed::Read(cycle)
    }

    /// Results of the colour unit before cycle `end`.
    #[inline]
    fn colour_results(&mut self, end: u64, outside: &mut Outside<'_, F>) {
        while let Some(cycle) = self.colour.next_event().filter(|cycle| *cycle < end)
            && let Some(fetch) = self.colour.take(cycle)
        {
            outside.shaded(&fetch);
        }
    }

    /// Hits behind one that is still in the read unit.
    #[inline]
    fn fill_address(&mut self, from: u64, end: u64, outside: &mut Outside<'_, F>) {
        while let Some(issue) = self.next_issue(from, end).filter(|issue| self.address.can_issue_late(*issue))
            && let Some(fetch) = self.next_hit(outside)
        {
            let _ = self.address.issue_late(issue, fetch);
        }
        if !self.read.is_idle()
            && let Some(ready) = self.address.next_event()
        {
            outside.counters.address_stalls += end.saturating_sub(ready.max(from));
        }
    }
}

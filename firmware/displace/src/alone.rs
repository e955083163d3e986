//! An only instance's cycles, sooner; in: cycles in which its ring is not empty, out: the state after them; cost: mostly the
//! steps'.
//!
//! The ring turns in every cycle. What comes before and after it may be late: the switch and the view calculation catch up when
//! FIFO #0 has run out of the rays that they handed over so far, the address, read and colour units when FIFO #1 is full of
//! hits that they may have taken meanwhile, and both when something else depends on them. What they are told then carries
//! the cycle in which it happened.

use lucerna_softfloat::Format;

use crate::engine::Parts;
use crate::fast::{Agenda, fills};
use crate::job::RayFaults;
use crate::outlook::{Shading, Switching};
use crate::record::Status;
use crate::slot::Heights;
use crate::slots::Entrant;
use crate::traverse::ray::Ray;
use crate::view::View;

impl<F: Format, const LINES: usize> Parts<'_, F, LINES> {
    /// Cycles before `end`, as long as the ring of an only instance has rays, and not its last is about to leave.
    pub(crate) fn alone(&mut self, agenda: &mut Agenda, end: u64) {
        // A fault of a ray that is not traversed ends the job in its cycle.
        if self.instances.len() != 1 || self.outside.job.ray_faults == RayFaults::Stop {
            return;
        }
        if self.instances.iter().all(|instance| instance.slots.occupied() == 0) {
            return;
        }
        let start = self.outside.now;
        agenda.switching.catch_up(start, self.outside.counters);
        self.outside.unit = 0;
        while self.outside.now < end {
            if self.outside.now >= agenda.arrival {
                self.shade_before(agenda, self.outside.now);
                fills(self.instances, &mut self.outside, agenda);
            }
            let [instance] = &mut *self.instances else { break };
            if !instance.slots.goes_on() {
                // The last ray may end the job.
                if instance.slots.occupied() < 2 && !instance.slots.is_free() {
                    break;
                }
                self.leave(agenda);
                self.enter(agenda);
            }
            self.turn(agenda, end.min(agenda.arrival));
        }
        let now = self.outside.now;
        self.outside.counters.cycles += now - start;
        self.shade_before(agenda, now);
        self.supply_before(agenda, now);
        let Self { instances, source, .. } = self;
        if let [instance] = &mut **instances {
            instance.taken.clear();
            agenda.viewed[0] = instance.viewed();
        }
        agenda.switching = Switching::of(instances, source.is_dry(), now);
    }

    /// The ray in stage 1 leaves if it has ended and there is room for it.
    #[inline]
    fn leave(&mut self, agenda: &mut Agenda) {
        let now = self.outside.now;
        let [instance] = &mut *self.instances else { return };
        let Some(status) = instance.slots.outcome() else { return };
        if status == Status::Hit && instance.fifo1.len() >= instance.depth1 {
            self.shade_before(agenda, now + 1);
        }
        let [instance] = &mut *self.instances else { return };
        if status == Status::Hit && instance.fifo1.is_empty() {
            agenda.shading[0].event = agenda.shading[0].event.min(now + 1);
        }
        instance.leave(&mut self.outside);
    }

    /// The next ray enters stage 1 if it is free.
    #[inline]
    fn enter(&mut self, agenda: &mut Agenda) {
        let now = self.outside.now;
        let [instance] = &mut *self.instances else { return };
        if !instance.slots.is_free() {
            return;
        }
        if instance.fifo0.is_empty() {
            self.supply_before(agenda, now);
        }
        let [instance] = &mut *self.instances else { return };
        if instance.enter(&self.outside) && !self.source.is_dry() {
            let _ = instance.taken.push_back(now);
        }
    }

    /// The ring turns, until something may leave or enter it, or until cycle `until`.
    #[inline]
    fn turn(&mut self, agenda: &mut Agenda, mut until: u64) {
        let Self { instances, outside, .. } = self;
        let [instance] = &mut **instances else { return };
        // When FIFO #1 is full now, it is so until its next unit does something.
        let event = agenda.shading[0].event;
        let held = event > outside.now && instance.fifo1.len() >= instance.depth1;
        if held {
            until = until.min(event);
        }
        let cycles = until - outside.now;
        let heights = Heights::of(outside.job, outside.depths, outside.memory);
        let (turned, line) = instance.slots.turns(cycles, held, outside.job, heights, outside.counters);
        outside.now += turned;
        let Some(line) = line else { return };
        // In the last of these cycles, after the other units.
        self.shade_before(agenda, self.outside.now);
        let [instance] = &mut *self.instances else { return };
        self.outside.now -= 1;
        instance.ask(line, &mut self.outside);
        agenda.arrival = self.outside.arrival();
        self.outside.now += 1;
    }

    /// What the address, read and colour units do before cycle `end`, and the fills that they get.
    fn shade_before(&mut self, agenda: &mut Agenda, end: u64) {
        let present = self.outside.now;
        while agenda.shading[0].event.min(agenda.arrival) < end {
            let Self { instances, outside, .. } = self;
            let [instance] = &mut **instances else { break };
            let until = end.min(agenda.arrival);
            let reached = instance.pass_hits(agenda.shading[0].seen, until, outside);
            agenda.shading[0] = Shading::of(instance, reached);
            agenda.arrival = outside.arrival();
            if reached == agenda.arrival && reached < end {
                outside.now = reached;
                fills(instances, outside, agenda);
            }
        }
        self.outside.now = present;
    }

    /// What the switch and the view calculation do before cycle `end`.
    fn supply_before(&mut self, agenda: &mut Agenda, end: u64) {
        let Self { instances, source, outside, .. } = self;
        let [instance] = &mut **instances else { return };
        let present = outside.now;
        let seen = &mut agenda.switching.seen;
        loop {
            let offered = instance.view.next_issue().max(*seen);
            let held = instance.coming + instance.fifo0.len() + instance.taken.len();
            let room = if held < instance.depth0 { Some(0) } else { instance.taken.front().copied() };
            let issue = match room {
                Some(cycle) if !source.is_dry() => cycle.max(offered),
                _ => u64::MAX,
            };
            let viewed = instance.viewed();
            let next = issue.min(viewed).min(end);
            if !source.is_dry() {
                outside.counters.view_stalls += next.saturating_sub(offered);
            }
            *seen = next;
            if next == end {
                break;
            }
            if next == viewed {
                outside.now = viewed;
                instance.settle_view(outside);
                continue;
            }
            if held >= instance.depth0 {
                let _ = instance.taken.pop_front();
            }
            let Some((number, view)) = source.take(outside.job, outside.memory) else { break };
            outside.counters.rays += 1;
            let result = instance.view.result_of(issue);
            match view {
                // Nothing in the unit comes before it, and the room it takes in FIFO #0 is the room that was kept for it.
                View::Ray { entry, direction } if instance.view.is_empty() && result < end => {
                    outside.counters.view_busy += u64::from(instance.view.pace().interval);
                    instance.view.pass(issue, result);
                    let _ = instance.fifo0.push_back(Entrant { number, ray: Ray { entry, direction } });
                }
                _ => instance.issue(issue, number, view, outside.counters),
            }
        }
        outside.now = present;
    }
}

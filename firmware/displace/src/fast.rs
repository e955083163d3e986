//! The same as `tick`, sooner; in: a number of cycles, out: the state after that many ticks; cost: mostly the steps'.
//!
//! All parts keep absolute cycle numbers, so each can tell the next cycle in which it may do anything but wait. Here every part
//! is called in those cycles only, in the order in which a tick calls them; the cycles that it waited for are added to its
//! stalls when it is called again. The ring turns in every cycle; of an only instance it turns many times in one call, and with
//! a ray in each slot the other parts are called late, when the ring has to do with them, for all cycles that they missed.

use core::array;

use lucerna_softfloat::Format;

use crate::engine::{Event, Parts};
use crate::instance::Instance;
use crate::job::RayFaults;
use crate::outlook::{Shading, Switching};
use crate::outside::{Cache, Outside};
use crate::sizes::MAX_UNITS;

/// When the parts of all instances are to be called.
struct Agenda {
    shading: [Shading; MAX_UNITS as usize],
    switching: Switching,
    /// When the next view calculation has a result, of each instance.
    viewed: [u64; MAX_UNITS as usize],
    /// The next fill.
    arrival: u64,
}

impl<F: Format, const LINES: usize> Parts<'_, F, LINES> {
    /// Up to `cycles` ticks, fewer when the job ends; says how many.
    pub(crate) fn advance(&mut self, cycles: u64) -> (u64, Option<Event>) {
        let start = self.outside.now;
        let end = start.saturating_add(cycles);
        let mut agenda = self.agenda();
        let mut event = None;
        while event.is_none() {
            self.quiet(&mut agenda, end);
            if self.outside.now == end {
                break;
            }
            event = self.cycle(&mut agenda);
        }
        // The cycle of a fault is not over, but the instances have had it.
        let broken = u64::from(matches!(event, Some(Event::Fault(_))));
        let Outside { now, counters, .. } = &mut self.outside;
        for shading in agenda.shading.iter_mut().take(self.instances.len()) {
            shading.catch_up(*now + broken, counters);
        }
        agenda.switching.catch_up(*now, counters);
        (*now - start + broken, event)
    }

    fn agenda(&self) -> Agenda {
        let now = self.outside.now;
        let idle = Shading { event: u64::MAX, seen: now, address_stalls: false, read_stalls: false };
        let instance = |unit: usize| self.instances.get(unit);
        Agenda {
            shading: array::from_fn(|unit| {
                instance(unit).map_or(idle, |instance| Shading::of(instance, now))
            }),
            switching: Switching::of(self.instances, self.source.is_dry(), now),
            viewed: array::from_fn(|unit| instance(unit).map_or(u64::MAX, Instance::viewed)),
            arrival: self.outside.arrival(),
        }
    }

    /// Cycles before `end` in which the ring of an only instance turns and nothing else happens; when the ring is full, nothing
    /// else that it could take notice of.
    #[inline]
    fn quiet(&mut self, agenda: &mut Agenda, end: u64) {
        let [instance] = &mut *self.instances else { return };
        // A fault of a ray that is not traversed ends the job in its cycle.
        if instance.slots.is_full() && self.outside.job.ray_faults == RayFaults::Record {
            self.closed(agenda, end);
            return;
        }
        let outside = &mut self.outside;
        if *outside.done == outside.job.results.count() {
            // A job of no ray, which ends with its first cycle.
            return;
        }
        let event = agenda.shading[0].event.min(agenda.switching.event).min(agenda.viewed[0]);
        let (start, mut until) = (outside.now, end.min(event).min(agenda.arrival));
        while outside.now < until && instance.is_quiet() {
            if let Some(line) = instance.turns(until, outside) {
                instance.ask(line, outside);
                outside.now += 1;
                agenda.arrival = outside.arrival();
                until = until.min(agenda.arrival);
            }
        }
        outside.counters.cycles += outside.now - start;
    }

    /// The same with a full ring, and the cycles in which a ray leaves it and another enters. Until a ray has ended the ring takes
    /// none, so what comes before it and what comes after it may be late: they catch up when the ring has to do with them,
    /// and before it asks for a line, so that the port's requests are in their order.
    fn closed(&mut self, agenda: &mut Agenda, end: u64) {
        let start = self.outside.now;
        let mut full = true;
        while full && self.outside.now < end.min(agenda.arrival) {
            let now = self.outside.now;
            if self.instances.first().is_some_and(|instance| !instance.slots.goes_on()) {
                self.shade_before(agenda, now + 1);
                self.supply_before(agenda, now);
                if let [instance] = &mut *self.instances {
                    leave_and_enter(instance, &mut self.outside, agenda);
                    full = instance.slots.is_full();
                }
            }
            let until = if full { end.min(agenda.arrival) } else { now + 1 };
            let [instance] = &mut *self.instances else { break };
            if let Some(line) = instance.turns(until, &mut self.outside) {
                let now = self.outside.now;
                self.shade_before(agenda, now + 1);
                let [instance] = &mut *self.instances else { break };
                instance.ask(line, &mut self.outside);
                agenda.arrival = self.outside.arrival();
                self.outside.now = now + 1;
            }
        }
        self.shade_before(agenda, self.outside.now);
        self.supply_before(agenda, self.outside.now);
        self.outside.counters.cycles += self.outside.now - start;
    }

    /// What an only instance's address, read and colour units do before cycle `now`, and the fills that they get.
    fn shade_before(&mut self, agenda: &mut Agenda, now: u64) {
        let Self { instances, outside, .. } = self;
        let present = outside.now;
        loop {
            outside.now = agenda.shading[0].event.min(agenda.arrival);
            if outside.now >= now {
                break;
            }
            if outside.now == agenda.arrival {
                fills(instances, outside, agenda);
            }
            let [instance] = &mut **instances else { break };
            shade(instance, outside, agenda);
        }
        outside.now = present;
    }

    /// What the switch and an only instance's view calculation do before cycle `now`.
    fn supply_before(&mut self, agenda: &mut Agenda, now: u64) {
        let present = self.outside.now;
        loop {
            self.outside.now = agenda.switching.event.min(agenda.viewed[0]);
            if self.outside.now >= now {
                break;
            }
            if let [instance] = &mut *self.instances
                && self.outside.now == agenda.viewed[0]
            {
                settle_view(instance, &mut self.outside, agenda);
            }
            self.hand_over(agenda);
        }
        self.outside.now = present;
    }

    /// One clock, as [`tick`](Self::tick).
    fn cycle(&mut self, agenda: &mut Agenda) -> Option<Event> {
        let Self { instances, outside, .. } = self;
        let now = outside.now;
        if now >= agenda.arrival {
            fills(instances, outside, agenda);
        }
        for (unit, instance) in instances.iter_mut().enumerate() {
            outside.unit = unit;
            if now >= agenda.shading[unit].event {
                shade(instance, outside, agenda);
            }
            if !instance.is_quiet() {
                leave_and_enter(instance, outside, agenda);
            }
            if instance.turn(outside) {
                agenda.arrival = outside.arrival();
            }
            if now >= agenda.viewed[unit] {
                settle_view(instance, outside, agenda);
            }
        }
        outside.counters.cycles += 1;
        if let Some(fault) = outside.fault {
            return Some(Event::Fault(fault));
        }
        if now >= agenda.switching.event {
            self.hand_over(agenda);
        }
        self.outside.now += 1;
        (*self.outside.done == self.outside.job.results.count()).then_some(Event::Done)
    }

    /// The switch's turn in a cycle.
    #[inline]
    fn hand_over(&mut self, agenda: &mut Agenda) {
        let now = self.outside.now;
        agenda.switching.catch_up(now, self.outside.counters);
        if let Some(unit) = self.switch() {
            agenda.viewed[unit] = self.instances[unit].viewed();
        }
        agenda.switching = Switching::of(self.instances, self.source.is_dry(), now + 1);
    }
}

/// An instance's address, read and colour units in a cycle.
#[inline]
fn shade<F: Format, const LINES: usize>(
    instance: &mut Instance<F, LINES>,
    outside: &mut Outside<'_, F>,
    agenda: &mut Agenda,
) {
    let shading = &mut agenda.shading[outside.unit];
    shading.catch_up(outside.now, outside.counters);
    if instance.shade(outside) {
        agenda.arrival = outside.arrival();
    }
    *shading = Shading::of(instance, outside.now + 1);
}

/// Stage 1 of an instance's ring in a cycle in which a ray has ended or may enter.
#[inline]
fn leave_and_enter<F: Format, const LINES: usize>(
    instance: &mut Instance<F, LINES>,
    outside: &mut Outside<'_, F>,
    agenda: &mut Agenda,
) {
    let ended = instance.fifo1.len();
    instance.leave_and_enter(outside);
    agenda.switching.event = outside.now;
    if instance.fifo1.len() > ended {
        let shading = &mut agenda.shading[outside.unit];
        shading.catch_up(outside.now + 1, outside.counters);
        *shading = Shading::of(instance, outside.now + 1);
    }
}

/// The end of an instance's view calculation in a cycle.
#[inline]
fn settle_view<F: Format, const LINES: usize>(
    instance: &mut Instance<F, LINES>,
    outside: &mut Outside<'_, F>,
    agenda: &mut Agenda,
) {
    let before = (instance.has_room(), instance.view.is_full());
    instance.settle_view(outside);
    agenda.viewed[outside.unit] = instance.viewed();
    if before != (instance.has_room(), instance.view.is_full()) {
        agenda.switching.event = outside.now;
    }
}

/// The lines that have come.
#[cold]
fn fills<F: Format, const LINES: usize>(
    instances: &mut [Instance<F, LINES>],
    outside: &mut Outside<'_, F>,
    agenda: &mut Agenda,
) {
    while let Some(fill) = outside.port.arrived(outside.now) {
        let Some(instance) = instances.get_mut(fill.unit) else { continue };
        instance.fill(fill, outside.counters);
        if fill.cache == Cache::Texture {
            agenda.shading[fill.unit].event = outside.now;
        }
    }
    agenda.arrival = outside.arrival();
}

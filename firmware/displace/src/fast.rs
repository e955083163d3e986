//! The same as `tick`, sooner; in: a number of cycles, out: the state after that many ticks; cost: mostly the steps'.
//!
//! All parts keep absolute cycle numbers, so each can tell the next cycle in which it may do anything but wait. Here every part
//! is called in those cycles only, in the order in which a tick calls them; the cycles that it waited for are added to its
//! stalls when it is called again. An only instance has a quicker way while rays are in its ring: `alone`.

use core::array;

use lucerna_softfloat::Format;

use crate::engine::{Event, Parts};
use crate::instance::Instance;
use crate::outlook::{Shading, Switching};
use crate::outside::{Cache, Outside};
use crate::sizes::MAX_UNITS;

/// When the parts of all instances are to be called.
pub(crate) struct Agenda {
    pub shading: [Shading; MAX_UNITS as usize],
    pub switching: Switching,
    /// When the next view calculation has a result, of each instance.
    pub viewed: [u64; MAX_UNITS as usize],
    /// The next fill.
    pub arrival: u64,
}

impl<F: Format, const LINES: usize> Parts<'_, F, LINES> {
    /// Up to `cycles` ticks, fewer when the job ends; says how many.
    pub(crate) fn advance(&mut self, cycles: u64) -> (u64, Option<Event>) {
        let start = self.outside.now;
        let end = start.saturating_add(cycles);
        let mut agenda = self.agenda();
        let mut event = None;
        while event.is_none() {
            #[cfg(feature = "shortcut")]
            self.alone(&mut agenda, end);
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
            leave_and_enter(instance, outside, agenda);
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
    if instance.slots.goes_on() {
        return;
    }
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
pub(crate) fn fills<F: Format, const LINES: usize>(
    instances: &mut [Instance<F, LINES>],
    outside: &mut Outside<'_, F>,
    agenda: &mut Agenda,
) {
    while let Some(fill) = outside.port.arrived(outside.now) {
        let Some(instance) = instances.get_mut(fill.unit) else { continue };
        if fill.cache == Cache::Texture {
            // What waited for it did so until now.
            let shading = &mut agenda.shading[fill.unit];
            shading.catch_up(outside.now, outside.counters);
            shading.event = outside.now;
        }
        instance.fill(fill, outside.counters);
    }
    agenda.arrival = outside.arrival();
}

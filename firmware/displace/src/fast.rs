//! The same as `tick`, sooner; in: a number of cycles, out: the state after that many ticks; cost: mostly the steps'.
//!
//! All parts keep absolute cycle numbers, so each can tell the next cycle in which it may do anything but wait. Here every part
//! is called in those cycles only, in the order in which a tick calls them; the cycles that it waited for are added to its
//! stalls when it is called again. The ring turns in every cycle.

use lucerna_softfloat::Format;

use crate::engine::{Event, Parts};
use crate::instance::Instance;
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
        let never = Shading { event: u64::MAX, seen: now, address_stalls: false, read_stalls: false };
        let mut agenda = Agenda {
            shading: [never; MAX_UNITS as usize],
            switching: Switching::of(self.instances, self.source.is_dry(), now),
            viewed: [u64::MAX; MAX_UNITS as usize],
            arrival: self.outside.port.next_arrival().unwrap_or(u64::MAX),
        };
        for (unit, instance) in self.instances.iter().enumerate() {
            agenda.shading[unit] = Shading::of(instance, now);
            agenda.viewed[unit] = instance.viewed();
        }
        agenda
    }

    /// Cycles before `end` in which the ring of an only instance turns and nothing else happens.
    #[inline]
    fn quiet(&mut self, agenda: &mut Agenda, end: u64) {
        let [instance] = &mut *self.instances else { return };
        let outside = &mut self.outside;
        if *outside.done == outside.job.results.count() {
            // A job of no ray, which ends with its first cycle.
            return;
        }
        let event = agenda.shading[0].event.min(agenda.switching.event).min(agenda.viewed[0]);
        let mut quiet = end.min(event).min(agenda.arrival);
        let start = outside.now;
        while outside.now < quiet && instance.is_quiet() {
            if instance.turn(outside) {
                agenda.arrival = outside.port.next_arrival().unwrap_or(u64::MAX);
                quiet = quiet.min(agenda.arrival);
            }
            outside.now += 1;
        }
        outside.counters.cycles += outside.now - start;
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
            let shading = &mut agenda.shading[unit];
            if now >= shading.event {
                shading.catch_up(now, outside.counters);
                if instance.shade(outside) {
                    agenda.arrival = outside.port.next_arrival().unwrap_or(u64::MAX);
                }
                *shading = Shading::of(instance, now + 1);
            }
            if !instance.is_quiet() {
                let ended = instance.fifo1.len();
                instance.leave_and_enter(outside);
                agenda.switching.event = now;
                if instance.fifo1.len() > ended {
                    shading.catch_up(now + 1, outside.counters);
                    *shading = Shading::of(instance, now + 1);
                }
            }
            if instance.turn(outside) {
                agenda.arrival = outside.port.next_arrival().unwrap_or(u64::MAX);
            }
            if now >= agenda.viewed[unit] {
                instance.settle_view(outside);
                agenda.viewed[unit] = instance.viewed();
                agenda.switching.event = now;
            }
        }
        if let Some(fault) = outside.fault {
            return Some(Event::Fault(fault));
        }
        if now >= agenda.switching.event {
            agenda.switching.catch_up(now, self.outside.counters);
            if let Some(unit) = self.switch() {
                agenda.viewed[unit] = self.instances[unit].viewed();
            }
            agenda.switching = Switching::of(self.instances, self.source.is_dry(), now + 1);
        }
        self.outside.counters.cycles += 1;
        self.outside.now += 1;
        (*self.outside.done == self.outside.job.results.count()).then_some(Event::Done)
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
    agenda.arrival = outside.port.next_arrival().unwrap_or(u64::MAX);
}

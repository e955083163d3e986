//! The displacement units' part of a report; in: their counters, out: sums and rates; cost: none.

use std::collections::BTreeMap;

use lucerna_driver::displace::{Counter, Counters};
use serde::Serialize;

use super::report::ratio;

/// Rays of one kind. Eye rays are alike, photons are not: the caches tell them apart.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Part {
    pub rays: u64,
    pub steps_per_ray: f64,
    pub cycles_per_ray: f64,
    pub height_hit_rate: f64,
    pub texture_hit_rate: f64,
}

impl Part {
    fn of(total: impl Fn(Counter) -> u64) -> Self {
        let share = |part: Counter, whole: Counter| ratio(total(part) as f64, total(whole) as f64);
        Self {
            rays: total(Counter::Rays),
            steps_per_ray: share(Counter::Steps, Counter::Rays),
            cycles_per_ray: share(Counter::Cycles, Counter::Rays),
            height_hit_rate: share(Counter::HeightHits, Counter::HeightAccesses),
            texture_hit_rate: share(Counter::TextureHits, Counter::TextureAccesses),
        }
    }
}

/// What the displaced surfaces of a render came to, all together.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[expect(missing_docs, reason = "the names are those of `hostsim displace`'s report, or say it themselves")]
pub struct Displacement {
    pub surfaces: u64,
    /// Jobs: a surface's part of a wave is one or more.
    pub jobs: u64,
    #[serde(flatten)]
    pub all: Part,
    pub eye_rays: Part,
    pub photons: Part,
    pub hits: u64,
    /// Rays that count as hits of the lid: too flat for the device's format, or stopped by the watchdog.
    pub lid_hits: u64,
    pub max_steps: u64,
    /// Steps that cross into a neighbour ÷ steps.
    pub crossing_probability: f64,
    pub cycles: u64,
    pub host_seconds: f64,
    /// All counters by their registers' names.
    pub counters: BTreeMap<&'static str, u64>,
}

impl Displacement {
    /// From each surface's counters and jobs, after the eye rays and at the end; `None` when there is no surface.
    pub fn new(eye: &[(Counters, u64)], end: &[(Counters, u64)], host_seconds: f64) -> Option<Self> {
        if end.is_empty() {
            return None;
        }
        let sum = |surfaces: &[(Counters, u64)], counter: Counter| -> u64 {
            let each = surfaces.iter().map(|(counters, _)| counters.get(counter));
            if counter == Counter::MaxSteps { each.max().unwrap_or(0) } else { each.sum() }
        };
        let total = |counter: Counter| sum(end, counter);
        Some(Self {
            surfaces: end.len() as u64,
            jobs: end.iter().map(|(_, jobs)| jobs).sum(),
            all: Part::of(total),
            eye_rays: Part::of(|counter| sum(eye, counter)),
            photons: Part::of(|counter| total(counter).saturating_sub(sum(eye, counter))),
            hits: total(Counter::Hits),
            lid_hits: total(Counter::Grazing) + total(Counter::Watchdogs) + total(Counter::Missed),
            max_steps: total(Counter::MaxSteps),
            crossing_probability: ratio(total(Counter::Crossings) as f64, total(Counter::Steps) as f64),
            cycles: total(Counter::Cycles),
            host_seconds,
            counters: Counter::ALL.into_iter().map(|counter| (counter.name(), total(counter))).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_add_up_and_maxima_do_not() {
        assert_eq!(Displacement::new(&[], &[], 0.0), None);
        let eye = Counters { rays: 4, steps: 8, max_steps: 3, ..Counters::default() };
        let one = Counters { rays: 10, steps: 40, max_steps: 9, grazing: 1, ..Counters::default() };
        let other = Counters { rays: 30, steps: 120, max_steps: 7, watchdogs: 2, ..Counters::default() };
        let sum = Displacement::new(&[(eye, 1), (eye, 1)], &[(one, 2), (other, 1)], 0.5).unwrap();
        assert_eq!((sum.surfaces, sum.jobs, sum.max_steps, sum.lid_hits), (2, 3, 9, 3));
        assert_eq!([sum.all, sum.eye_rays, sum.photons].map(|part| part.rays), [40, 8, 32]);
        assert_eq!([sum.all, sum.eye_rays, sum.photons].map(|part| part.steps_per_ray), [4.0, 2.0, 4.5]);
        assert_eq!((sum.counters["steps"], sum.counters["max_steps"]), (160, 9));
    }
}

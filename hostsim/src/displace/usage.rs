//! How busy the units were; in: counters, out: shares of the cycles, and which unit limits; cost: none.

use lucerna_driver::displace::Counters;
use serde::Serialize;

/// A cache's traffic, of all instances.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[expect(missing_docs, reason = "the names are the counters', documented there, or say it themselves")]
pub struct CacheReport {
    pub size_bytes: u32,
    pub ways: u32,
    pub line_bytes: u32,
    pub accesses: u64,
    pub hits: u64,
    pub misses: u64,
    /// Hits at the first try ÷ accesses.
    pub hit_rate: f64,
    pub fills: u64,
    /// Bytes filled from memory.
    pub bytes: u64,
}

/// Shares of an instance's cycles in which the unit's issue was taken.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Occupancy {
    /// View calculation.
    pub view: f64,
    /// Traverse unit: turns that did a step or a start pass.
    pub traverse: f64,
    /// Texture and normal address calculation.
    pub address: f64,
    /// Texture and normal read.
    pub read: f64,
    /// Colour calculation.
    pub colour: f64,
    /// The memory port that the instances share.
    pub port: f64,
}

/// The unit that a job waits for.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Limit {
    /// Which.
    pub unit: &'static str,
    /// Share of the cycles in which it worked.
    pub busy: f64,
    /// Share in which it waited for memory.
    pub waiting: f64,
}

impl Occupancy {
    /// Of counters over some instances.
    pub fn new(counters: &Counters, units: u32) -> Self {
        let share = |busy: u64| ratio(busy as f64, counters.cycles as f64 * f64::from(units));
        Self {
            view: share(counters.view_busy),
            traverse: share(counters.traverse_busy),
            address: share(counters.address_busy),
            read: share(counters.read_busy),
            colour: share(counters.colour_busy),
            port: ratio(counters.port_busy as f64, counters.cycles as f64),
        }
    }

    /// The unit that limits, and for what share of the cycles it worked or waited for memory itself.
    pub fn limit(&self, counters: &Counters, units: u32) -> Limit {
        let share = |cycles: u64| ratio(cycles as f64, counters.cycles as f64 * f64::from(units));
        let engaged = [
            ("view", self.view, 0.0),
            ("traverse", self.traverse, share(counters.traverse_waits)),
            ("address", self.address, 0.0),
            ("read", self.read, share(counters.read_stalls)),
            ("colour", self.colour, 0.0),
            ("port", self.port, 0.0),
        ];
        let none = Limit { unit: "none", busy: 0.0, waiting: 0.0 };
        engaged.into_iter().fold(none, |most, (unit, busy, waiting)| {
            if busy + waiting > most.busy + most.waiting { Limit { unit, busy, waiting } } else { most }
        })
    }
}

/// 0 where there is nothing to divide by.
pub(crate) fn ratio(numerator: f64, denominator: f64) -> f64 {
    if denominator > 0.0 { numerator / denominator } else { 0.0 }
}

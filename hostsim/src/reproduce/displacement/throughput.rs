//! Tables 1, 6 and 7: how fast, and what limits it; in: maps, out: figures; cost: four runs a map.

use indicatif::ProgressBar;
use lucerna_displace::operators::{ADDRESS, COLOUR, Operator, Schedule, Unit, VIEW_LIST};
use lucerna_displace::slots::STAGES;
use lucerna_driver::displace::{Counters, Policies};
use serde::Serialize;

use super::counts::workload;
use super::published::{Scene, TABLE_6, TABLE_7};
use crate::displace::map::HeightMap;
use crate::displace::report::{ASIC_MHZ, FPGA_MHZ};
use crate::displace::session::{self, RunError};
use crate::displace::setup::Setup;
use crate::displace::usage::{Limit, Occupancy, ratio};

/// The paper's screen (§4.3).
const SCREEN: (u32, u32) = (800, 480);

/// One of Table 1's units.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Resources {
    /// Its name.
    pub unit: &'static str,
    /// Table 1: adders, 3-input adders, comparators, multipliers, dividers, square roots.
    pub published: [u32; 6],
    /// How often a ray uses each (of the traverse unit: a step).
    pub uses: [u32; 6],
    /// Cycles from a ray to the next, by our schedule; of the traverse unit, a step a cycle.
    pub interval: u32,
    /// Cycles of a ray in it.
    pub latency: u32,
    /// Mpixels/s of one unit at 84 MHz if nothing else limited it.
    pub mpixels_per_s_at_84mhz: Option<f64>,
}

/// A scene of Table 6 on some units.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Throughput {
    /// The map.
    pub map: String,
    /// How often it lies along a side.
    pub repeat: f64,
    /// Instances.
    pub units: u32,
    /// Rays on the surface.
    pub rays: u64,
    /// Cycles a ray.
    pub cycles_per_pixel: f64,
    /// Of the height cache, at the first try, per cent.
    pub hit_rate_percent: f64,
    /// Printed there.
    pub published_hit_rate_percent: f64,
    /// Maps, at 84 MHz.
    pub port_mb_per_s_at_84mhz: f64,
    /// Bytes of the memory port a frame, MB.
    pub port_mb_per_frame: f64,
    /// Printed MB/s over printed frames a second, MB.
    pub published_mb_per_frame: f64,
    /// Frames a second at 84 MHz.
    pub frames_per_s_at_84mhz: f64,
    /// Printed there.
    pub published_frames_per_s: f64,
    /// At 84 MHz.
    pub mpixels_per_s_at_84mhz: f64,
    /// Printed there, of four units.
    pub published_mpixels_per_s: f64,
    /// At 500 MHz.
    pub mpixels_per_s_at_500mhz: f64,
    /// Printed in Table 7, of rocks on four units.
    pub published_mpixels_per_s_at_500mhz: Option<f64>,
    /// Shares of the cycles.
    pub occupancy: Occupancy,
    /// What they wait for.
    pub limited_by: Limit,
}

/// Table 1 and what we make of it.
pub fn resources() -> Vec<Resources> {
    let published = |unit: Unit| Operator::ALL.map(|operator| unit.count(operator));
    let scheduled = |unit, name, schedule: &Schedule| {
        let interval = schedule.interval();
        Resources {
            unit: name,
            published: published(unit),
            uses: Operator::ALL.map(|operator| schedule.uses(operator)),
            interval,
            latency: schedule.latency(),
            mpixels_per_s_at_84mhz: Some(FPGA_MHZ / f64::from(interval)),
        }
    };
    vec![
        scheduled(Unit::View, "view", &VIEW_LIST),
        Resources {
            unit: "traverse",
            published: published(Unit::Traverse),
            // P16: hit position, exit parameters, crossing position; comparisons are not told apart there.
            uses: [6, 0, 7, 4, 2, 0],
            interval: 1,
            latency: STAGES as u32,
            mpixels_per_s_at_84mhz: None,
        },
        scheduled(Unit::Address, "address", &ADDRESS),
        scheduled(Unit::Colour, "colour", &COLOUR),
    ]
}

/// Runs the scenes of Table 6 whose maps are there, with 1 and with 4 units, at repeat 1 and at the preset's.
pub fn run(maps: &[HeightMap], setup: &Setup, bar: &ProgressBar) -> Result<Vec<Throughput>, RunError> {
    let mut rows = Vec::new();
    for scene in &TABLE_6 {
        let Some(map) = maps.iter().find(|map| map.name() == scene.map) else { continue };
        let mut workload = workload(map, 1, SCREEN);
        let preset = workload.surface.repeat;
        for repeat in if preset == 1.0 { vec![1.0] } else { vec![1.0, preset] } {
            workload.surface.repeat = repeat;
            workload.rays = workload.surface.rays(&workload.view, &workload.raster);
            for units in [1, 4] {
                let mut setup = Setup { policies: Policies::MIX, ..*setup };
                setup.sizes.units = units;
                let outcome = session::run(&setup, &workload, &ProgressBar::hidden())?;
                rows.push(row(scene, repeat, units, outcome.traversed(), &outcome.counters));
                bar.inc(1);
            }
        }
    }
    Ok(rows)
}

fn row(scene: &Scene, repeat: f64, units: u32, rays: u64, counters: &Counters) -> Throughput {
    let cycles = counters.cycles as f64;
    let occupancy = Occupancy::new(counters, units);
    let megabytes = counters.port_bytes as f64 / 1e6;
    let frames = ratio(FPGA_MHZ * 1e6, cycles);
    Throughput {
        map: scene.map.to_owned(),
        repeat,
        units,
        rays,
        cycles_per_pixel: ratio(cycles, rays as f64),
        hit_rate_percent: 100.0 * ratio(counters.height_hits as f64, counters.height_accesses as f64),
        published_hit_rate_percent: scene.hit_rate,
        port_mb_per_s_at_84mhz: megabytes * frames,
        port_mb_per_frame: megabytes,
        published_mb_per_frame: scene.traffic / scene.frames,
        frames_per_s_at_84mhz: frames,
        published_frames_per_s: scene.frames,
        mpixels_per_s_at_84mhz: ratio(rays as f64 * FPGA_MHZ, cycles),
        published_mpixels_per_s: scene.speed,
        mpixels_per_s_at_500mhz: ratio(rays as f64 * ASIC_MHZ, cycles),
        published_mpixels_per_s_at_500mhz: (scene.map == "rocks" && units == 4).then_some(TABLE_7),
        occupancy,
        limited_by: occupancy.limit(counters, units),
    }
}

impl Throughput {
    /// What limits, in words.
    pub fn limit(&self) -> String {
        let Limit { unit, busy, waiting } = self.limited_by;
        if waiting > busy {
            format!("{unit}, {:.0} % waiting for memory", 100.0 * waiting)
        } else {
            format!("{unit}, {:.0} % busy", 100.0 * busy)
        }
    }
}

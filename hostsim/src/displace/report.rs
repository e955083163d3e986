//! What a displaced picture came to; in: outcome and verdict, out: JSON and a table; cost: none.

use std::collections::BTreeMap;

use lucerna_driver::displace::Counter;
use serde::Serialize;

use super::judge::Verdict;
use super::session::Outcome;
use super::setup::Setup;
use super::usage::{CacheReport, Limit, Occupancy, ratio};
use super::workload::Workload;
use crate::picture::fnv1a64;

/// Clock of the paper's FPGA, in MHz.
pub const FPGA_MHZ: f64 = 84.0;
/// Clock of the paper's chip, in MHz.
pub const ASIC_MHZ: f64 = 500.0;

/// Host seconds.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct HostSeconds {
    /// The device's jobs, from start to done (one core).
    pub device: f64,
    /// The same with maps, rays and results on the bus.
    pub device_and_bus: f64,
    /// The oracle's f64 traversal of the same rays (one core).
    pub oracle: f64,
}

/// The report; its fields are the counters' names where they are counters.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[expect(missing_docs, reason = "the names are the registers', documented there, or say it themselves")]
pub struct Report {
    pub map: String,
    pub map_width: u32,
    pub map_height: u32,
    pub scale: f64,
    pub repeat: f64,
    pub view: String,
    pub algorithm: String,
    pub policies: PolicyNames,
    pub width: u32,
    pub height: u32,
    pub source: &'static str,
    pub format: &'static str,
    pub arith: &'static str,
    pub timing: &'static str,
    pub units: u32,
    pub notes: Vec<String>,
    pub pixels: u64,
    /// Pixels that meet the surface: rays traversed.
    pub rays: u64,
    pub hits: u64,
    pub missed: u64,
    pub grazing: u64,
    pub steps: u64,
    pub steps_per_pixel: f64,
    /// Crossings ÷ steps.
    pub crossing_probability: f64,
    pub level_ups: u64,
    pub level_downs: u64,
    pub start_passes: u64,
    pub levels_saved: u64,
    pub max_steps: u64,
    pub watchdog_hits: u64,
    /// Share of the rays that hit another texel than the exact march of the same rounded ray.
    pub texel_mismatch_exact: f64,
    pub texel_mismatch_exact_rays: u64,
    /// Of these, rays through a corner or an edge, where rounding decides.
    pub texel_mismatch_exact_corners: u64,
    /// Share of the rays that hit another texel than the exact march of the ray in f64.
    pub texel_mismatch_f64: f64,
    pub texel_mismatch_f64_rays: u64,
    /// Of the f64 traversal of the same rounded rays.
    pub oracle_steps_per_pixel: f64,
    /// Rays whose number of steps differs from it.
    pub oracle_step_differences: u64,
    pub cache: CacheReport,
    pub texture_cache: CacheReport,
    pub cycles: u64,
    pub cycles_per_pixel: f64,
    pub occupancy: Occupancy,
    /// The unit that worked, or itself waited for memory, in most cycles.
    pub limited_by: Limit,
    pub mpixels_per_s_at_84mhz: f64,
    pub mpixels_per_s_at_500mhz: f64,
    pub port_bytes: u64,
    pub view_stalls: u64,
    pub traverse_waits: u64,
    pub traverse_stalls: u64,
    pub traverse_bubbles: u64,
    pub address_stalls: u64,
    pub read_stalls: u64,
    pub height_forwards: u64,
    /// Every counter of the device by its register's name.
    pub counters: BTreeMap<&'static str, u64>,
    pub results_fnv1a64: String,
    pub host_seconds: HostSeconds,
    pub steps_per_second: f64,
    pub oracle_steps_per_second: f64,
    /// The device's traversal steps a second ÷ the f64 oracle's, in this run.
    pub steps_per_second_over_oracle: f64,
}

/// The policies by name.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[expect(missing_docs, reason = "the names are the registers'")]
pub struct PolicyNames {
    pub wrap: &'static str,
    pub start_level: bool,
    pub start_grid: u32,
    pub levels_down: u32,
    pub ascend: &'static str,
    pub coherent: &'static str,
    pub reach: u32,
    pub siblings: bool,
    pub watchdog: u32,
}

/// What the report cannot see from the numbers.
#[derive(Clone, Debug)]
pub struct Names {
    /// The view as asked for.
    pub view: String,
    /// The algorithm as asked for.
    pub algorithm: String,
    /// What the user should know.
    pub notes: Vec<String>,
}

impl Report {
    /// Puts it together.
    pub fn new(
        names: &Names,
        setup: &Setup,
        workload: &Workload,
        outcome: &Outcome,
        verdict: &Verdict,
    ) -> Self {
        let (counters, sizes) = (&outcome.counters, &setup.sizes);
        let units = sizes.units;
        let rays = verdict.rays as f64;
        let share = |count: u64| ratio(count as f64, rays);
        let occupancy = Occupancy::new(counters, units);
        let (seconds, oracle) = (outcome.run_time.as_secs_f64(), verdict.oracle_time.as_secs_f64());
        let speed = ratio(counters.steps as f64, seconds);
        let oracle_speed = ratio(verdict.oracle_steps as f64, oracle);
        let policies = &setup.policies;
        let cache = |geometry: lucerna_displace::engine::Geometry,
                     [accesses, hits, misses, fills]: [u64; 4]| {
            CacheReport {
                size_bytes: geometry.bytes,
                ways: geometry.ways,
                line_bytes: geometry.line_bytes,
                accesses,
                hits,
                misses,
                hit_rate: ratio(hits as f64, accesses as f64),
                fills,
                bytes: fills * u64::from(geometry.line_bytes),
            }
        };
        Self {
            map: workload.map.name().to_owned(),
            map_width: workload.map.width(),
            map_height: workload.map.height(),
            scale: workload.surface.scale,
            repeat: workload.surface.repeat,
            view: names.view.clone(),
            algorithm: names.algorithm.clone(),
            policies: PolicyNames {
                wrap: policies.wrap.name(),
                start_level: policies.start_level,
                start_grid: policies.start_grid,
                levels_down: policies.levels_down as u32,
                ascend: policies.ascend.name(),
                coherent: policies.coherent.name(),
                reach: policies.reach as u32,
                siblings: policies.siblings,
                watchdog: setup.watchdog,
            },
            width: workload.raster.width,
            height: workload.raster.height,
            source: workload.source.name(),
            format: outcome.capabilities.format.name(),
            arith: setup.arith.name(),
            timing: setup.timing_name(),
            units,
            notes: names.notes.clone(),
            pixels: workload.pixels() as u64,
            rays: verdict.rays,
            hits: counters.hits,
            missed: counters.missed,
            grazing: counters.grazing,
            steps: counters.steps,
            steps_per_pixel: share(counters.steps),
            crossing_probability: ratio(counters.crossings as f64, counters.steps as f64),
            level_ups: counters.level_ups,
            level_downs: counters.level_downs,
            start_passes: counters.start_passes,
            levels_saved: counters.levels_saved,
            max_steps: counters.max_steps,
            watchdog_hits: counters.watchdogs,
            texel_mismatch_exact: share(verdict.mismatch_exact),
            texel_mismatch_exact_rays: verdict.mismatch_exact,
            texel_mismatch_exact_corners: verdict.mismatch_corners,
            texel_mismatch_f64: share(verdict.mismatch_f64),
            texel_mismatch_f64_rays: verdict.mismatch_f64,
            oracle_steps_per_pixel: share(verdict.oracle_steps),
            oracle_step_differences: verdict.step_differences,
            cache: cache(
                sizes.height_cache,
                [
                    counters.height_accesses,
                    counters.height_hits,
                    counters.height_misses,
                    counters.height_fills,
                ],
            ),
            texture_cache: cache(
                sizes.texture_cache,
                [
                    counters.texture_accesses,
                    counters.texture_hits,
                    counters.texture_misses,
                    counters.texture_fills,
                ],
            ),
            cycles: counters.cycles,
            cycles_per_pixel: share(counters.cycles),
            occupancy,
            limited_by: occupancy.limit(counters, units),
            mpixels_per_s_at_84mhz: ratio(rays * FPGA_MHZ, counters.cycles as f64),
            mpixels_per_s_at_500mhz: ratio(rays * ASIC_MHZ, counters.cycles as f64),
            port_bytes: counters.port_bytes,
            view_stalls: counters.view_stalls,
            traverse_waits: counters.traverse_waits,
            traverse_stalls: counters.traverse_stalls,
            traverse_bubbles: counters.traverse_bubbles,
            address_stalls: counters.address_stalls,
            read_stalls: counters.read_stalls,
            height_forwards: counters.height_forwards,
            counters: Counter::ALL.map(|counter| (counter.name(), counters.get(counter))).into(),
            results_fnv1a64: format!("{:016x}", fnv1a64(outcome.words())),
            host_seconds: HostSeconds {
                device: seconds,
                device_and_bus: outcome.host_time.as_secs_f64(),
                oracle,
            },
            steps_per_second: speed,
            oracle_steps_per_second: oracle_speed,
            steps_per_second_over_oracle: ratio(speed, oracle_speed),
        }
    }

    /// As `report.json` has it.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("a plain struct of numbers and strings");
        text.push('\n');
        text
    }
}

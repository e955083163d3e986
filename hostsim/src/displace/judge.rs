//! Were the right texels hit? In: rays and results, out: how many differ from the exact march, and how fast the f64 traversal is;
//! cost: a march and a traversal a ray.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use lucerna_driver::NumberFormat;
use lucerna_driver::displace::{Policies, RayResult, RayStatus, Wrap};
use rayon::prelude::*;

use super::rules::rules;
use super::workload::Workload;
use crate::oracle::{Columns, Pyramid, RoundedRay};

/// How one result stands to the exact march of the ray that the device rounded.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Finding {
    /// The device did not traverse it.
    Untraced,
    /// The same texel.
    Same,
    /// Another texel, but the ray goes through a corner or meets a top at an edge, where rounding decides.
    Corner,
    /// Another texel.
    Other,
}

/// Rays between two looks at the progress, so that it costs the timed traversal nothing.
const LOOK: usize = 4096;

/// What the oracles say of a picture.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Of each result.
    pub findings: Vec<Finding>,
    /// Rays that the device traversed.
    pub rays: u64,
    /// Of these, those that hit another texel than the exact march of the same rounded ray.
    pub mismatch_exact: u64,
    /// Of these, those that go through a corner.
    pub mismatch_corners: u64,
    /// Those that hit another texel than the exact march of the ray in f64.
    pub mismatch_f64: u64,
    /// Steps of the f64 traversal of the same rounded rays.
    pub oracle_steps: u64,
    /// Rays whose steps differ from it.
    pub step_differences: u64,
    /// What it took, on one core.
    pub oracle_time: Duration,
}

impl Verdict {
    /// Judges the results of a workload.
    pub fn new(
        workload: &Workload,
        format: NumberFormat,
        policies: &Policies,
        results: &[RayResult],
    ) -> Self {
        Self::shown(workload, format, policies, results, &ProgressBar::hidden())
    }

    /// The same; `bar` shows how far it is.
    pub fn shown(
        workload: &Workload,
        format: NumberFormat,
        policies: &Policies,
        results: &[RayResult],
        bar: &ProgressBar,
    ) -> Self {
        let phase = |name: &'static str| {
            bar.set_position(0);
            bar.set_message(name);
        };
        phase("exact march");
        let repeat = policies.wrap == Wrap::Repeat;
        let (log2, heights) = (workload.map.log2(), workload.map.heights());
        let columns = Columns::new(log2, heights, repeat);
        let rounded = workload.rounded(format);
        let traced: Vec<Option<RoundedRay>> = results
            .iter()
            .zip(&rounded)
            .map(|(result, ray)| if result.steps > 0 { *ray } else { None })
            .collect();
        let findings: Vec<Finding> = results
            .par_iter()
            .zip(&traced)
            .map(|(result, ray)| ray.map_or(Finding::Untraced, |ray| finding(&columns, result, ray)))
            .inspect(|_| bar.inc(1))
            .collect();
        let mismatch_f64 = exact_texels(workload, &columns)
            .into_par_iter()
            .filter(|(at, texel, missed)| {
                let result = &results[*at];
                result.steps > 0 && !agrees(result, *texel, *missed)
            })
            .count();

        let pyramid = Pyramid::new(log2, heights, repeat);
        let rules = rules(policies);
        let (mut oracle_steps, mut step_differences) = (0, 0);
        phase("f64 steps");
        let started = Instant::now();
        for (results, rays) in results.chunks(LOOK).zip(traced.chunks(LOOK)) {
            for (result, ray) in results.iter().zip(rays) {
                if let Some((entry, direction)) = ray {
                    let steps = pyramid.walk(&rules, *entry, *direction).steps;
                    oracle_steps += u64::from(steps);
                    step_differences += u64::from(steps != u32::from(result.steps));
                }
            }
            bar.inc(results.len() as u64);
        }
        let oracle_time = started.elapsed();
        let count = |finding: Finding| findings.iter().filter(|found| **found == finding).count() as u64;
        let (rays, corners) = (findings.len() as u64 - count(Finding::Untraced), count(Finding::Corner));
        Self {
            rays,
            mismatch_exact: count(Finding::Other) + corners,
            mismatch_corners: corners,
            mismatch_f64: mismatch_f64 as u64,
            oracle_steps,
            step_differences,
            oracle_time,
            findings,
        }
    }
}

fn agrees(result: &RayResult, texel: [i64; 2], missed: bool) -> bool {
    match result.status {
        RayStatus::Hit => !missed && result.texel.map(i64::from) == texel,
        RayStatus::Miss => missed,
        _ => false,
    }
}

fn finding(columns: &Columns<'_>, result: &RayResult, (entry, direction): RoundedRay) -> Finding {
    let column = columns.march(entry, direction);
    if agrees(result, column.texel, column.missed) {
        Finding::Same
    } else if column.corner {
        Finding::Corner
    } else {
        Finding::Other
    }
}

/// For each ray in f64: its result's number, and what it hits.
fn exact_texels(workload: &Workload, columns: &Columns<'_>) -> Vec<(usize, [i64; 2], bool)> {
    let number = |ray: usize| match workload.source {
        super::workload::Source::List => ray,
        super::workload::Source::Raster => workload.rays[ray].pixel as usize,
    };
    let march = |(i, ray): (usize, &super::ray::Ray)| {
        let column = columns.march(ray.entry, ray.direction);
        (number(i), column.texel, column.missed)
    };
    workload.rays.par_iter().enumerate().map(march).collect()
}

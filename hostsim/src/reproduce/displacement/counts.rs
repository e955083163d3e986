//! Steps and crossings of every algorithm on a map from a view; in: a workload, out: cells; cost: a run of the device and of the
//! oracles each.

use indicatif::ProgressBar;
use lucerna_driver::displace::{Coherent, Policies, Wrap};
use serde::Serialize;

use super::cell::Cell;
use super::published::{PAPER, Paper, ROWS, TABLE_3, VIEWS, down};
use crate::displace::judge::Verdict;
use crate::displace::map::HeightMap;
use crate::displace::presets::Preset;
use crate::displace::ray::Surface;
use crate::displace::session::{self, RunError};
use crate::displace::setup::Setup;
use crate::displace::usage::ratio;
use crate::displace::view::View;
use crate::displace::workload::{Source, Workload};

/// What one algorithm came to from one view.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Count {
    /// Map's name.
    pub map: String,
    /// The view.
    pub view: &'static str,
    /// The algorithm.
    pub row: String,
    /// Rays on the surface.
    pub rays: u64,
    /// Steps a ray.
    pub steps_per_pixel: f64,
    /// The oracle's f64 traversal of the same rays.
    pub f64_traversal: f64,
    /// Per cent of the steps.
    pub crossing_percent: f64,
    /// Most steps of a ray.
    pub max_steps: u64,
    /// Rays stopped by the watchdog.
    pub watchdog_hits: u64,
    /// Rays that hit another texel than the exact march of the same rounded ray.
    pub texel_mismatch_exact_rays: u64,
    /// Per cent of the rays.
    pub texel_mismatch_exact_percent: f64,
    /// Rays that hit another texel than the exact march in f64.
    pub texel_mismatch_f64_rays: u64,
}

/// A map from a view: the rows to run and what they are compared with.
pub struct Task<'a> {
    /// The map, at its preset's size.
    pub map: &'a HeightMap,
    /// Which of [`VIEWS`].
    pub view: usize,
}

/// What a task came to.
#[derive(Default)]
pub struct Done {
    /// Cells of Tables 2, 3 and 4.
    pub cells: Vec<Cell>,
    /// Everything counted.
    pub counts: Vec<Count>,
}

/// The workload of a map from a view, by its preset.
pub fn workload(map: &HeightMap, view: usize, size: (u32, u32)) -> Workload {
    let preset = Preset::of(map.name());
    let surface = Surface { scale: preset.scale, repeat: preset.repeat };
    let view = match view {
        0 => View::FRONT,
        1 => View::oblique(),
        _ => View::grazing(),
    };
    Workload::new(map.clone(), surface, view, size, Source::List)
}

impl Task<'_> {
    /// How many runs it is, Table 3 apart.
    pub fn runs(&self) -> u64 {
        let paper = PAPER.iter().find(|paper| paper.map == self.map.name());
        paper.map_or(0, |paper| (ROWS.len() + self.others(paper).len()) as u64)
    }

    /// Runs every row.
    pub fn run(&self, setup: &Setup, size: (u32, u32), bar: &ProgressBar) -> Result<Done, RunError> {
        let Some(paper) = PAPER.iter().find(|paper| paper.map == self.map.name()) else {
            return Ok(Done::default());
        };
        let mut done = Done::default();
        let whole = workload(self.map, self.view, size);
        for (number, (row, algorithm)) in ROWS.into_iter().enumerate() {
            let count = self.count(&whole, setup, algorithm.policies(), row)?;
            done.row(paper, number, self.view, &count);
            done.counts.push(count);
            bar.inc(1);
        }
        for (row, policies, published) in self.others(paper) {
            let count = self.count(&whole, setup, policies, row)?;
            let mut cell = self.cell("Table 4", row, published, None, &count);
            cell.another();
            done.cells.push(cell);
            done.counts.push(count);
            bar.inc(1);
        }
        if paper.map == "rocks" {
            self.table_3(setup, &whole, size, &mut done)?;
        }
        Ok(done)
    }

    /// The other readings of (c2), and P19's oddities.
    fn others(&self, paper: &Paper) -> Vec<(&'static str, Policies, f64)> {
        let preset = Preset::of(paper.map);
        let published = |row: usize| paper.steps[row][self.view];
        let mut others = vec![
            (
                "(c2), flag cleared going down",
                Policies::C2.with_coherent(Coherent::Consecutive),
                published(5),
            ),
            (
                "(c2), up on a parent's boundary only",
                Policies::C2.with_coherent(Coherent::Parity),
                published(5),
            ),
        ];
        if preset.levels_down != 2 {
            others.push(("(b), n = 4 (P19)", down(preset.levels_down), published(3)));
        }
        if preset.start_grid != 0 {
            others.push((
                "(a), start level on a grid 8 times finer (P19)",
                Policies::A.with_start_grid(preset.start_grid),
                published(2),
            ));
        }
        others
    }

    /// n = 1 to 4, at full size, and at the half of the study's own.
    fn table_3(
        &self,
        setup: &Setup,
        whole: &Workload,
        size: (u32, u32),
        done: &mut Done,
    ) -> Result<(), RunError> {
        let (published, study) = TABLE_3[self.view];
        let half = workload(self.map, self.view, ((size.0 / 2).max(1), (size.1 / 2).max(1)));
        for (levels, row) in (1..).zip(["n = 1", "n = 2", "n = 3", "n = 4"]) {
            let at = levels as usize - 1;
            let count = self.count(whole, setup, down(levels), row)?;
            done.cells.push(self.cell("Table 3", row, published[at], None, &count));
            if !half.rays.is_empty() {
                let count = self.count(&half, setup, down(levels), row)?;
                let mut cell = self.cell("Table 3", row, published[at], Some(study[at]), &count);
                cell.row = format!("{row}, at half the size as the study's");
                cell.another();
                done.cells.push(cell);
            }
        }
        Ok(())
    }

    fn cell(
        &self,
        table: &'static str,
        row: &str,
        published: f64,
        study: Option<f64>,
        count: &Count,
    ) -> Cell {
        let ours = (count.steps_per_pixel, Some(count.f64_traversal));
        Cell::new(table, (self.map.name(), row, VIEWS[self.view]), published, study, ours)
    }

    fn count(
        &self,
        workload: &Workload,
        setup: &Setup,
        policies: Policies,
        row: &str,
    ) -> Result<Count, RunError> {
        let setup = Setup { policies: policies.with_wrap(Wrap::Repeat), ..*setup };
        let outcome = session::run(&setup, workload, &ProgressBar::hidden())?;
        let verdict = Verdict::new(workload, setup.format, &setup.policies, &outcome.results);
        let (counters, rays) = (&outcome.counters, verdict.rays as f64);
        Ok(Count {
            map: self.map.name().to_owned(),
            view: VIEWS[self.view],
            row: row.to_owned(),
            rays: verdict.rays,
            steps_per_pixel: ratio(counters.steps as f64, rays),
            f64_traversal: ratio(verdict.oracle_steps as f64, rays),
            crossing_percent: 100.0 * ratio(counters.crossings as f64, counters.steps as f64),
            max_steps: counters.max_steps,
            watchdog_hits: counters.watchdogs,
            texel_mismatch_exact_rays: verdict.mismatch_exact,
            texel_mismatch_exact_percent: 100.0 * ratio(verdict.mismatch_exact as f64, rays),
            texel_mismatch_f64_rays: verdict.mismatch_f64,
        })
    }
}

impl Done {
    /// The cells of a row of Table 4, and of Table 2 where it has them.
    fn row(&mut self, paper: &Paper, number: usize, view: usize, count: &Count) {
        let (row, at) = (ROWS[number].0, VIEWS[view]);
        let published = paper.steps.get(number).map_or(f64::NAN, |row| row[view]);
        let study = paper.study.and_then(|rows| rows.get(number).map(|row| row[view]));
        let ours = (count.steps_per_pixel, Some(count.f64_traversal));
        self.cells.push(Cell::new("Table 4", (paper.map, row, at), published, study, ours));
        if number < 2 {
            let study = paper.study_crossing.map(|views| views[view][number]);
            let ours = (count.crossing_percent, None);
            self.cells.push(Cell::new(
                "Table 2",
                (paper.map, row, at),
                paper.crossing[view][number],
                study,
                ours,
            ));
        }
    }
}

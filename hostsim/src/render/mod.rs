//! The main job; in: a scene and a device, out: pictures and a report; cost: tracing, the device, and two reference loops.
//!
//! [`photons`] traces a chunk at a time and shows it to the judges of [`judge`] before the device gets it; [`report`] sets what
//! came out beside what the paper says.
//!
//! A scene with displaced surfaces has a displacement unit for each: [`relief`] loads their maps, [`units`] asks the devices, and
//! [`displacement`] is their part of the report.

pub mod displacement;
pub mod judge;
pub mod photons;
pub mod relief;
pub mod report;
pub mod units;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use lucerna_driver::Hazard;

use crate::accelerate::{self, Outcome, RunError, Setup, Workload};
use crate::grid::{GridError, HashGrid};
use crate::picture::{self, Comparison, PictureError};
use crate::scene::{LoadOptions, Scene, SceneError};
use crate::trace::{HitPoint, eye_pass_through};
use displacement::Displacement;
use judge::Judge;
use photons::TracedPhotons;
use report::Report;
use units::{DisplacedError, Units};

/// What to render, on what, to where.
#[derive(Clone, Debug)]
pub struct Options {
    /// Built-in name, TOML file or OBJ file.
    pub scene: String,
    /// The mesh of a scene that leaves it to the user.
    pub mesh: Option<PathBuf>,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Photons emitted.
    pub photons: u32,
    /// The device.
    pub setup: Setup,
    /// Directory of the results, made when it is not there.
    pub out: PathBuf,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The hit points.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The device.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A displaced surface.
    #[error(transparent)]
    Displaced(#[from] DisplacedError),
    /// A picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A file of the results.
    #[error("{path} cannot be written: {source}; choose another directory with --out")]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

impl RenderError {
    /// That a file of the results could not be written.
    pub(crate) fn write(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        |source| Self::Write { path, source }
    }
}

/// Everything but the photons.
#[derive(Debug)]
pub struct Prepared {
    /// The scene.
    pub scene: Scene,
    /// Hit points by number.
    pub points: Vec<HitPoint>,
    /// Their index table.
    pub grid: HashGrid,
    /// Host time of the eye pass.
    pub eye_time: Duration,
}

impl Prepared {
    /// Loads a scene, traces the eye rays and builds the index table.
    ///
    /// # Errors
    /// [`RenderError`] of scene, displaced surfaces or grid.
    pub fn new(scene: &str, mesh: Option<PathBuf>, width: u32, height: u32) -> Result<Self, RenderError> {
        let scene = Scene::load(scene, &LoadOptions { mesh })?;
        let mut units = Units::new(&scene, &Setup::default())?;
        Self::trace(scene, &mut units, width, height)
    }

    /// Traces the eye rays of a scene, with these units for its displaced surfaces, and builds the index table.
    ///
    /// # Errors
    /// [`RenderError`] of displaced surfaces or grid.
    pub fn trace(scene: Scene, units: &mut Units, width: u32, height: u32) -> Result<Self, RenderError> {
        let started = Instant::now();
        let points = eye_pass_through(&scene, width, height, units)?;
        let grid = HashGrid::build(&points, width, height)?;
        Ok(Self { scene, points, grid, eye_time: started.elapsed() })
    }

    /// What the device is given.
    pub fn workload(&self, pixels: u32, emitted: u32) -> Workload<'_> {
        Workload { points: &self.points, grid: &self.grid, pixels, emitted }
    }
}

/// Renders, writes `picture.png`, `reference.png`, `difference.png` and `report.json`, and returns the report.
///
/// # Errors
/// [`RenderError`].
pub fn render(options: &Options, bar: &ProgressBar) -> Result<Report, RenderError> {
    std::fs::create_dir_all(&options.out).map_err(RenderError::write(&options.out))?;
    bar.set_message("eye rays");
    let scene = Scene::load(&options.scene, &LoadOptions { mesh: options.mesh.clone() })?;
    let mut units = Units::new(&scene, &options.setup)?;
    for note in scene.notes().iter().chain(units.notes()) {
        bar.suspend(|| eprintln!("note: {note}"));
    }
    let prepared = Prepared::trace(scene, &mut units, options.width, options.height)?;
    let after_eye_rays = units.counters()?;
    let workload = prepared.workload(options.width * options.height, options.photons);
    let mut judge = Judge::new(&prepared, &options.setup);
    let mut source = TracedPhotons::new(&prepared, &mut units, options.photons, &mut judge, bar);
    let outcome = accelerate::run(&options.setup, &workload, &mut source);
    let trace_time = source.finish()? + prepared.eye_time;
    let outcome = outcome?;
    let displacement =
        Displacement::new(&after_eye_rays, &units.counters()?, units.host_time().as_secs_f64());
    bar.set_message("pictures");
    let verdict = judge.finish(&outcome, &workload, &options.setup);
    let comparison = write_pictures(options, &outcome, &verdict.reference)?;
    let report = Report::new(options, &prepared, &outcome, &verdict, &comparison, trace_time, displacement);
    let path = options.out.join("report.json");
    std::fs::write(&path, report.to_json()).map_err(RenderError::write(&path))?;
    Ok(report)
}

/// How much brighter the difference picture is than the difference.
pub const AMPLIFICATION: u8 = 16;

fn write_pictures(
    options: &Options,
    outcome: &Outcome,
    reference: &[[f64; 3]],
) -> Result<Comparison, RenderError> {
    let (width, height, out) = (options.width, options.height, &options.out);
    let ours = picture::tone_map(&outcome.radiance(), width, height)?;
    let reference = picture::tone_map(reference, width, height)?;
    picture::save(&ours, &out.join("picture.png"))?;
    picture::save(&reference, &out.join("reference.png"))?;
    picture::save(&picture::difference(&ours, &reference, AMPLIFICATION)?, &out.join("difference.png"))?;
    Ok(picture::compare(&ours, &reference)?)
}

/// The normal test when the user does not say: on, but not under the paper's own rules (D8).
pub fn default_normal_test(hazard: Hazard) -> bool {
    hazard != Hazard::Published
}

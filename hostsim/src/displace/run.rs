//! The main job of a displaced surface; in: options, out: pictures and `report.json`; cost: the device's, and the oracles'.

use std::path::{Path, PathBuf};

use indicatif::ProgressBar;

use super::judge::Verdict;
use super::map::{HeightMap, LONGEST, MapError};
use super::picture as pictures;
use super::presets::Preset;
use super::procedural;
use super::ray::Surface;
use super::report::{Names, Report};
use super::session::{self, RunError};
use super::setup::Setup;
use super::view::View;
use super::workload::{Source, Workload};
use crate::cli::announce;
use crate::picture::{self, PictureError};

/// What to draw, on what, to where.
#[derive(Clone, Debug)]
pub struct Options {
    /// Built-in name or PNG file.
    pub map: String,
    /// Depth in texture units; the map's preset when not given.
    pub scale: Option<f64>,
    /// How often the map lies along a side; the map's preset when not given.
    pub repeat: Option<f64>,
    /// The view, and its name.
    pub view: (String, View),
    /// The algorithm's name.
    pub algorithm: String,
    /// Pixels.
    pub size: (u32, u32),
    /// Who makes the rays.
    pub source: Source,
    /// The device.
    pub setup: Setup,
    /// What the user should know of these choices.
    pub notes: Vec<String>,
    /// Directory of the results, made when it is not there.
    pub out: PathBuf,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum DisplaceError {
    /// The map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The device.
    #[error(transparent)]
    Run(#[from] RunError),
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
    /// No folder.
    #[error("the folder of the maps, {folder}, cannot be read: {source}; name one that is there with --maps")]
    NoFolder {
        /// Which.
        folder: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file where a folder should be.
    #[error("{folder} is a file: --maps takes the folder that holds the maps")]
    NotAFolder {
        /// Which.
        folder: PathBuf,
    },
    /// A folder without maps.
    #[error("there is no map in {folder}: it should hold {} (any of them)", .wanted.join(", "))]
    NoMaps {
        /// Which.
        folder: PathBuf,
        /// The files looked for.
        wanted: Vec<String>,
    },
}

impl DisplaceError {
    /// That a file of the results could not be written.
    pub(crate) fn write(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        |source| Self::Write { path, source }
    }
}

/// The map of a name or file, at the size its preset has it.
///
/// # Errors
/// [`MapError`].
pub fn load(map: &str) -> Result<(HeightMap, Preset), MapError> {
    let map = match procedural::map(map) {
        Some(map) => map,
        None if Path::new(map).extension().is_none() && !Path::new(map).exists() => {
            return Err(MapError::Unknown { name: map.to_owned() });
        }
        None => HeightMap::load(Path::new(map))?,
    };
    let preset = Preset::of(map.name());
    Ok((preset.apply(map), preset))
}

/// That a file's name brought settings that the user did not ask for.
fn preset_note(options: &Options, name: &str) -> Option<String> {
    let preset = Preset::named(name).filter(|_| procedural::map(&options.map).is_none())?;
    let mut settings = Vec::new();
    if options.scale.is_none() {
        settings.push(format!("depth {} (--scale)", preset.scale));
    }
    if options.repeat.is_none() {
        settings.push(format!("repeat {} (--repeat)", preset.repeat));
    }
    if preset.longest < LONGEST {
        settings.push(format!("at most {} texels a side", preset.longest));
    }
    let settings = settings.join(", ");
    (!settings.is_empty()).then(|| format!("the file's name is that of the preset {name}: {settings}"))
}

/// Draws, writes `picture.png`, `steps.png`, `difference.png` and `report.json`, and returns the report.
///
/// # Errors
/// [`DisplaceError`].
pub fn displace(options: &Options, bar: &ProgressBar) -> Result<Report, DisplaceError> {
    let (map, preset) = load(&options.map)?;
    let out = &options.out;
    std::fs::create_dir_all(out).map_err(DisplaceError::write(out))?;
    let mut notes = map.notes().to_vec();
    notes.extend(preset_note(options, map.name()));
    notes.extend(options.notes.iter().cloned());
    for note in &notes {
        bar.suspend(|| eprintln!("note: {note}"));
    }
    let surface = Surface {
        scale: options.scale.unwrap_or(preset.scale),
        repeat: options.repeat.unwrap_or(preset.repeat),
    };
    bar.set_message("rays");
    let workload = Workload::new(map, surface, options.view.1, options.size, options.source);
    if workload.results() == 0 {
        return Err(RunError::NoRays.into());
    }
    bar.set_length(workload.results() as u64);
    announce(bar, "device");
    let outcome = session::run(&options.setup, &workload, bar)?;
    announce(bar, "exact march");
    let (setup, results) = (&options.setup, &outcome.results);
    let verdict = Verdict::shown(&workload, setup.format, &setup.policies, results, bar);
    bar.set_message("pictures");
    picture::save(&pictures::shaded(&workload, results), &out.join("picture.png"))?;
    picture::save(&pictures::heat(&workload, results), &out.join("steps.png"))?;
    let difference = pictures::difference(&workload, results, &verdict.findings);
    picture::save(&difference, &out.join("difference.png"))?;
    let names = Names { view: options.view.0.clone(), algorithm: options.algorithm.clone(), notes };
    let report = Report::new(&names, setup, &workload, &outcome, &verdict);
    let path = out.join("report.json");
    std::fs::write(&path, report.to_json()).map_err(DisplaceError::write(&path))?;
    Ok(report)
}

//! The command line; in: words, out: options that mean something, or one paragraph on what is wrong; cost: none.

pub mod choices;
pub mod displace;
mod unused;

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use lucerna_driver::Policies;

use crate::accelerate::Setup;
use crate::render::{self, Options};
use choices::{
    AllocationChoice, ArithChoice, BusyChoice, FormatChoice, HazardChoice, InputWidthChoice, SchedulerChoice,
    Size, Switch, TimingChoice, UnitsChoice,
};

/// Lucerna on a host: render through the accelerator's model, and compare with what was published.
#[derive(Parser, Debug)]
#[command(name = "hostsim", version, max_term_width = 110)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Render a scene through the photon-mapping engine; writes pictures and report.json.
    Render(RenderArgs),
    /// Draw a displaced surface through the displacement unit; writes pictures and report.json.
    Displace(displace::DisplaceArgs),
    /// Print published figures beside ours.
    #[command(subcommand)]
    Reproduce(Reproduce),
    /// Do a bus trace again on a fresh device, and compare every word that is read.
    Replay(ReplayArgs),
    /// Build the firmware and print flash, RAM and deepest stack frame a crate, held to their budgets.
    Size,
    /// For maintainers: write the firmware's job file from the 20x15 workload.
    Fixture {
        /// Where to.
        #[arg(default_value = "fixtures/cornell-balls-20x15.lcn")]
        path: PathBuf,
    },
}

/// Whose figures.
#[derive(Subcommand, Debug)]
pub enum Reproduce {
    /// The progressive radiance estimation engine: Fig. 1, Fig. 4, Table II, Table III, SSIM and SNR.
    Pree {
        /// Also count the operations at 1600x1200 with 19.2 million photons (a minute or two).
        #[arg(long)]
        full: bool,
        /// Directory of Fig. 4's pictures and pree.json.
        #[arg(long, default_value = "out/reproduce-pree")]
        out: PathBuf,
    },
    /// The pyramidal displacement-mapping unit: Tables 1 to 4, 6 and 7, on the paper's height maps.
    Displacement(displace::ReproduceDisplacementArgs),
}

/// A trace and the device it was taken from (its first line says the device, options here come first).
#[derive(Args, Debug)]
pub struct ReplayArgs {
    /// The trace.
    pub trace: PathBuf,
    /// PREUs, when not those of the trace.
    #[arg(long)]
    pub units: Option<UnitsChoice>,
    /// What computes the numbers.
    #[arg(long, default_value = "fast")]
    pub arith: ArithChoice,
    /// Cycle by cycle, or fast-forward.
    #[arg(long, default_value = "fast")]
    pub timing: TimingChoice,
}

/// What to render, and on what device.
#[derive(Args, Debug)]
pub struct RenderArgs {
    /// A built-in scene (cornell-balls, cornell-teapot, relief-room; with --mesh: sibenik, conference, kitchen), a TOML file, or an OBJ file.
    #[arg(default_value = "cornell-balls")]
    pub scene: String,
    /// The OBJ file of a scene that leaves its mesh to you.
    #[arg(long)]
    pub mesh: Option<PathBuf>,
    /// Pixels, WIDTHxHEIGHT.
    #[arg(long, default_value = "320x240")]
    pub size: Size,
    /// Photons emitted; ten a pixel when not given.
    #[arg(long, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=1 << 31))]
    pub photons: Option<u32>,
    /// PREUs.
    #[arg(long, default_value = "4")]
    pub units: UnitsChoice,
    /// Number format of datapath and records.
    #[arg(long, default_value = "f32")]
    pub format: FormatChoice,
    /// What computes the numbers; the bits are the same.
    #[arg(long, default_value = "fast")]
    pub arith: ArithChoice,
    /// Cycle by cycle, or fast-forward; bits and counters are the same.
    #[arg(long, default_value = "fast")]
    pub timing: TimingChoice,
    /// What protects a hit point in the pipeline (D7, D12).
    #[arg(long, default_value = "interlock")]
    pub hazards: HazardChoice,
    /// Whether the two normals are compared (D8); on, but off with --hazards published.
    #[arg(long)]
    pub normal_test: Option<Switch>,
    /// Photons accepted in a cycle (D5).
    #[arg(long, default_value = "1")]
    pub input_width: InputWidthChoice,
    /// When the controller takes no photon (D4).
    #[arg(long, default_value = "registered")]
    pub busy: BusyChoice,
    /// The paper's controller, or the baseline without it.
    #[arg(long, default_value = "aftso")]
    pub scheduler: SchedulerChoice,
    /// The order of evaluation: ADISO-REC's, or the one of Figs. 3 and 4.
    #[arg(long, default_value = "leaping")]
    pub allocation: AllocationChoice,
    /// Write every bus access into this file (270 MB at the default size); `replay` does them again.
    #[arg(long)]
    pub bus_trace: Option<PathBuf>,
    /// Directory of the results; out/SCENE when not given.
    #[arg(long)]
    pub out: Option<PathBuf>,
}

impl RenderArgs {
    /// The options that these words mean.
    ///
    /// # Errors
    /// A picture with more photons than can be counted.
    pub fn options(self) -> Result<Options, String> {
        let Size { width, height } = self.size;
        let photons = match self.photons {
            Some(photons) => photons,
            None => {
                (width * height).checked_mul(10).ok_or("give --photons: ten a pixel are too many to count")?
            }
        };
        let hazard = self.hazards.into();
        let stem =
            std::path::Path::new(&self.scene).file_stem().map_or("scene".into(), |stem| stem.to_owned());
        Ok(Options {
            mesh: self.mesh,
            width,
            height,
            photons,
            setup: Setup {
                units: self.units.into(),
                format: self.format.into(),
                arith: self.arith.into(),
                timing: self.timing.into(),
                policies: Policies {
                    hazard,
                    busy: self.busy.into(),
                    input_width: self.input_width.into(),
                    scheduler: self.scheduler.into(),
                    allocation: self.allocation.into(),
                },
                normal_test: self.normal_test.map_or(render::default_normal_test(hazard), bool::from),
                bus_trace: self.bus_trace,
                ..Setup::default()
            },
            out: self.out.unwrap_or_else(|| PathBuf::from("out").join(stem)),
            scene: self.scene,
        })
    }
}

/// Says what is being done: on the bar, or as a line where there is none to be seen.
pub fn announce(bar: &ProgressBar, what: &'static str) {
    bar.set_message(what);
    if bar.is_hidden() {
        eprintln!("{what} …");
    }
}

/// A bar for `length` steps, with what is being done.
pub fn progress(length: u64) -> ProgressBar {
    let style =
        ProgressStyle::with_template("{msg:12} [{bar:40}] {human_pos}/{human_len}  {elapsed} (left {eta})")
            .expect("a constant template")
            .progress_chars("=> ");
    let bar = ProgressBar::new(length).with_style(style);
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

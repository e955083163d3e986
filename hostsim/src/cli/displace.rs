//! The words of `displace` and of its reproduction; in: words, out: options; cost: none.

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, ValueEnum};
use lucerna_displace::engine::Sizes;
use lucerna_driver::NumberFormat;
use lucerna_driver::displace::{Algorithm, Coherent, LevelsDown, Policies, Reach, Wrap};

use super::choices::{ArithChoice, CacheSize, Size, Switch, TimingChoice, choice};
use super::unused::{self, Asked};
use crate::displace::Options;
use crate::displace::setup::Setup;
use crate::displace::view::View;
use crate::displace::workload::Source;

choice! {
    /// Number format.
    NumberChoice => NumberFormat {
        /// 1-7-16, the paper's.
        F24 = "f24" => NumberFormat::F24,
        /// IEEE 754 single precision.
        F32 = "f32" => NumberFormat::F32,
        /// Binary64 inside, single precision in memory: a study, no hardware.
        F64 = "f64" => NumberFormat::F64,
    }
}
choice! {
    /// The paper's algorithms.
    AlgorithmChoice => Algorithm {
        /// Reference 12 of the paper, Tevs et al.: up on a parent's boundary.
        Tevs = "tevs" => Algorithm::Tevs,
        /// Reference 10, Oh et al.: from the root, a level at a time, never up.
        Oh = "oh" => Algorithm::Oh,
        /// As oh, but from the start level.
        A = "a" => Algorithm::A,
        /// As oh, with two levels down at once.
        B = "b" => Algorithm::B(LevelsDown::Two),
        /// As oh, with selective level-up.
        C1 = "c1" => Algorithm::C1,
        /// As oh, with coherent level-up.
        C2 = "c2" => Algorithm::C2,
        /// a, b and c1: the paper's hardware.
        Mix = "mix" => Algorithm::Mix,
        /// a, b and c2: the paper's GPU program.
        MixGpu = "mix-gpu" => Algorithm::MixGpu,
        /// Beyond the paper: the mix with three levels down, a reach of two and siblings (P22, P23).
        Fold = "fold" => Algorithm::Fold,
    }
}
choice! {
    /// What lies beyond the map's edges.
    WrapChoice => Wrap {
        /// The map again.
        Repeat = "repeat" => Wrap::Repeat,
        /// Nothing: heights of 0.
        Border = "border" => Wrap::Border,
    }
}
choice! {
    /// Readings of (c2), P5.
    CoherentChoice => Coherent {
        /// Set by a crossing that stays, cleared by a level-up.
        Toggle = "toggle" => Coherent::Toggle,
        /// Also cleared by going down.
        Consecutive = "consecutive" => Coherent::Consecutive,
        /// Like toggle, but up on a parent's boundary only.
        Parity = "parity" => Coherent::Parity,
    }
}
choice! {
    /// Who makes the rays.
    SourceChoice => Source {
        /// The host writes one for each pixel on the surface.
        List = "list" => Source::List,
        /// The device makes them from a camera.
        Raster = "raster" => Source::Raster,
    }
}

/// A number within limits.
fn within(low: f64, high: f64) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let number = text.trim().parse().ok().filter(|number| (low..=high).contains(number));
        number.ok_or_else(|| format!("give a number from {low} to {high}"))
    }
}

/// A view, with its name.
#[derive(Clone, PartialEq, Debug)]
pub struct ViewChoice(pub String, pub View);

impl FromStr for ViewChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Ok(Self(text.to_owned(), text.parse()?))
    }
}

/// Which device, and how it is run.
#[derive(Args, Debug)]
pub struct DisplaceDeviceArgs {
    /// Number format of datapath and records.
    #[arg(long, default_value = "f24")]
    pub format: NumberChoice,
    /// What computes the numbers; the bits are the same. There is no soft f64.
    #[arg(long, default_value = "fast")]
    pub arith: ArithChoice,
    /// Cycle by cycle, or fast-forward; bits and counters are the same.
    #[arg(long, default_value = "fast")]
    pub timing: TimingChoice,
    /// Height cache of each unit: SIZE,WAYS,LINE: up to 16 ways, lines of 4 to 64 bytes, up to 8192 lines.
    #[arg(long, default_value = "16K,4,32")]
    pub cache: CacheSize,
    /// Texture and normal cache of each unit: SIZE,WAYS,LINE, within the same limits.
    #[arg(long, default_value = "16K,4,32")]
    pub texture_cache: CacheSize,
    /// Instances of the unit that share the memory port, 1 to 4.
    #[arg(long, default_value = "1", value_parser = clap::value_parser!(u32).range(1..=4))]
    pub units: u32,
}

impl DisplaceDeviceArgs {
    /// The device that these words mean, with the paper's policies.
    ///
    /// # Errors
    /// A format that the chosen arithmetic does not have.
    pub fn setup(&self) -> Result<Setup, String> {
        if (self.format, self.arith) == (NumberChoice::F64, ArithChoice::Soft) {
            return Err("there is no soft-float f64: leave out --arith soft, or choose --format f24 or f32"
                .to_owned());
        }
        Ok(Setup {
            format: self.format.into(),
            arith: self.arith.into(),
            timing: self.timing.into(),
            sizes: Sizes {
                units: self.units,
                height_cache: self.cache.0,
                texture_cache: self.texture_cache.0,
                ..Sizes::default()
            },
            ..Setup::default()
        })
    }
}

/// What to draw, and on what device.
#[derive(Args, Debug)]
pub struct DisplaceArgs {
    /// A PNG file of heights (8 or 16 bits, sides powers of two from 1 to 4096), or a built-in map: flat, pillars, waves,
    /// bricks, maze, craters, pebbles, ridges, noise.
    #[arg(long, default_value = "pebbles")]
    pub map: String,
    /// Depth of the displacement in texture units, 0.0001 to 10. When not given: 0.1, but by a preset for a map or file named
    /// (NAME.png or NAME_height.png) rocks, stones, four, saint, wall, bump, dent, bricks, ridges, noise or maze.
    #[arg(long, allow_negative_numbers = true, value_parser = within(1e-4, 10.0))]
    pub scale: Option<f64>,
    /// How often the map lies along each side of the surface, 0.01 to 1024. When not given: 1, but by a preset for rocks, bump
    /// and dent (4), bricks and waves (2).
    #[arg(long, allow_negative_numbers = true, value_parser = within(0.01, 1024.0))]
    pub repeat: Option<f64>,
    /// front, oblique, grazing, or YAW,PITCH or YAW,PITCH,X,Y,Z: degrees (yaw 0 looks along +z, 90 along +x; negative pitch is downwards)
    /// and the eye, in units of the 200 by 200 grid around the origin, Y over 0, each up to 1000000. Without an eye it looks at
    /// the grid's middle from a distance of 215, and pitch is -90 to below 0.
    #[arg(long, default_value = "oblique", allow_hyphen_values = true)]
    pub view: ViewChoice,
    /// How rays go up and down the pyramid.
    #[arg(long, default_value = "mix")]
    pub algorithm: AlgorithmChoice,
    /// Levels down at once before the first crossing, 1 to 4; by the algorithm when not given.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4))]
    pub levels_down: Option<u32>,
    /// Find the start level on a grid 2^N times finer, 0 to 3 (P19); for a, mix, mix-gpu and fold.
    #[arg(long, default_value = "0", value_parser = clap::value_parser!(u32).range(0..=3))]
    pub start_grid: u32,
    /// Which reading of (c2); for c2 and mix-gpu.
    #[arg(long, default_value = "toggle")]
    pub coherent: CoherentChoice,
    /// Nodes within which a ray must come down for (c1) to stay on its level, 1 to 3; for c1, mix and fold, and by them when
    /// not given (P4, P23).
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=3))]
    pub reach: Option<u32>,
    /// Whether a crossing looks at a sibling's height at once; by the algorithm when not given (P22).
    #[arg(long)]
    pub siblings: Option<Switch>,
    /// What lies beyond the map's edges.
    #[arg(long, default_value = "repeat")]
    pub wrap: WrapChoice,
    /// Most steps of a ray, 1 to 65535.
    #[arg(long, default_value = "4096", value_parser = clap::value_parser!(u32).range(1..=65535))]
    pub watchdog: u32,
    /// Who makes the rays.
    #[arg(long, default_value = "list")]
    pub source: SourceChoice,
    /// The device.
    #[command(flatten)]
    pub device: DisplaceDeviceArgs,
    /// Pixels, WIDTHxHEIGHT, each 1 to 4096.
    #[arg(long, default_value = "1024x768")]
    pub size: Size,
    /// Directory of the results; out/displace-MAP when not given.
    #[arg(long)]
    pub out: Option<PathBuf>,
}

impl DisplaceArgs {
    /// The options that these words mean.
    ///
    /// # Errors
    /// As [`DisplaceDeviceArgs::setup`].
    pub fn options(self) -> Result<Options, String> {
        let algorithm = Algorithm::from(self.algorithm);
        let mut policies: Policies = algorithm.policies();
        if let Some(levels) = self.levels_down.and_then(levels_down) {
            policies.levels_down = levels;
        }
        if let Some(reach) = self.reach.and_then(reach) {
            policies.reach = reach;
        }
        if let Some(siblings) = self.siblings {
            policies.siblings = siblings.into();
        }
        policies.start_grid = self.start_grid;
        policies.coherent = self.coherent.into();
        policies.wrap = self.wrap.into();
        let stem = std::path::Path::new(&self.map).file_stem().map_or("map".into(), |stem| stem.to_owned());
        let mut folder = std::ffi::OsString::from("displace-");
        folder.push(stem);
        let asked = Asked { levels_down: self.levels_down, reach: self.reach };
        Ok(Options {
            notes: unused::notes(algorithm, asked, &policies),
            map: self.map,
            scale: self.scale,
            repeat: self.repeat,
            view: (self.view.0, self.view.1),
            algorithm: algorithm.name().to_owned(),
            size: (self.size.width, self.size.height),
            source: self.source.into(),
            setup: Setup { policies, watchdog: self.watchdog, ..self.device.setup()? },
            out: self.out.unwrap_or_else(|| PathBuf::from("out").join(folder)),
        })
    }
}

/// So many levels as the register has them.
pub fn levels_down(levels: u32) -> Option<LevelsDown> {
    [LevelsDown::One, LevelsDown::Two, LevelsDown::Three, LevelsDown::Four]
        .into_iter()
        .find(|down| *down as u32 == levels)
}

fn reach(nodes: u32) -> Option<Reach> {
    [Reach::One, Reach::Two, Reach::Three].into_iter().find(|reach| *reach as u32 == nodes)
}

/// The paper's tables on real maps.
#[derive(Args, Debug)]
pub struct ReproduceDisplacementArgs {
    /// Folder of NAME_height.png: any of rocks, stones, four, saint, wall, bump, dent.
    #[arg(long)]
    pub maps: PathBuf,
    /// Pixels, WIDTHxHEIGHT, of Tables 2 to 4.
    #[arg(long, default_value = "1024x768")]
    pub size: Size,
    /// The device.
    #[command(flatten)]
    pub device: DisplaceDeviceArgs,
    /// Directory of displacement.json.
    #[arg(long, default_value = "out/reproduce-displacement")]
    pub out: PathBuf,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_the_registers() {
        assert_eq!(levels_down(1), Some(LevelsDown::One));
        assert_eq!(levels_down(4), Some(LevelsDown::Four));
        assert_eq!(levels_down(5), None);
    }
}

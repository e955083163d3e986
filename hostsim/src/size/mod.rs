//! The size table. In: the workspace. Out: flash, RAM and the deepest stack frame of every crate in every Cortex-M program, held
//! to budgets. Cost: a build of the firmware.

pub mod attribute;
pub mod budget;
pub mod build;
pub mod frames;
pub mod image;

use std::fmt;
use std::path::{Path, PathBuf};

use budget::{BudgetError, Verdict};
use build::BuildError;
use image::{Image, ImageError, Share};

/// The programs of the table.
pub const IMAGES: [&str; 5] = ["driver_only", "pree_f32", "pree_f24", "displace_f32", "displace_f24"];

/// Where things are.
#[derive(Clone, Debug)]
pub struct Options {
    /// The workspace.
    pub root: PathBuf,
    /// Where to build: a folder for the firmware alone, as cargo locks it.
    pub target_dir: PathBuf,
    /// The budgets.
    pub budgets: PathBuf,
}

impl Default for Options {
    /// The workspace this program was built from.
    fn default() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        Self {
            target_dir: root.join("target/images"),
            budgets: root.join("fixtures/size-budgets.toml"),
            root,
        }
    }
}

/// Why there is no table.
#[derive(Debug, thiserror::Error)]
pub enum SizeError {
    /// The firmware does not build.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// An image cannot be read.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The budgets are wrong.
    #[error(transparent)]
    Budget(#[from] BudgetError),
}

/// The table and the verdicts.
#[derive(Clone, Debug)]
pub struct Report {
    /// The programs.
    pub images: Vec<Image>,
    /// The budgets.
    pub verdicts: Vec<Verdict>,
}

/// Builds the firmware and measures it.
///
/// # Errors
/// A [`SizeError`]. An exceeded budget is no error here: ask the report.
pub fn run(options: &Options) -> Result<Report, SizeError> {
    let budgets = budget::read(&options.budgets)?;
    let folder = build::images(&options.root, &options.target_dir)?;
    let images = IMAGES.iter().map(|name| Image::read(&folder, name)).collect::<Result<Vec<_>, _>>()?;
    let verdicts = budgets.iter().map(|budget| Verdict::of(budget, &images)).collect::<Result<_, _>>()?;
    Ok(Report { images, verdicts })
}

impl Report {
    /// Whether every budget is kept.
    pub fn is_within_budgets(&self) -> bool {
        self.verdicts.iter().all(Verdict::is_kept)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for image in &self.images {
            writeln!(
                f,
                "{:24}{:>8}{:>8}{:>8}  deepest frame's function",
                image.name, "flash", "RAM", "frame"
            )?;
            let mut crates: Vec<_> = image.crates.iter().collect();
            crates.sort_by_key(|(_, share)| std::cmp::Reverse(share.flash + share.ram));
            for (name, share) in crates {
                line(f, name, share)?;
            }
            line(f, "all", &image.total)?;
            writeln!(f)?;
        }
        self.verdicts.iter().try_for_each(|verdict| verdict.fmt(f))
    }
}

fn line(f: &mut fmt::Formatter<'_>, name: &str, share: &Share) -> fmt::Result {
    let computed = if share.frame.computed { "+" } else { " " };
    let Share { flash, ram, frame, deepest } = share;
    writeln!(f, "  {name:22}{flash:>8}{ram:>8}{:>8}{computed} {deepest}", frame.bytes)
}

//! What an image may take. In: a TOML file. Out: budgets, and what became of them. Cost: reading it.
//!
//! ```toml
//! [[budget]]
//! name = "the driver alone"
//! image = "driver_only"
//! flash = 16384
//! ```

use std::fmt;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::image::{Image, Share};

/// The most that an image, or some crates of it, may take; what is not named is free.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// What it is for.
    pub name: String,
    /// The program.
    pub image: String,
    /// The crates it is for; all of the image if none are named.
    #[serde(default)]
    pub crates: Vec<String>,
    /// What of the whole image is left out: data that is no code's.
    #[serde(default)]
    pub without: Vec<String>,
    /// Bytes of flash.
    pub flash: Option<u64>,
    /// Bytes of RAM, without the stack.
    pub ram: Option<u64>,
    /// Bytes of the deepest stack frame.
    pub frame: Option<u64>,
}

/// The file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Budgets {
    budget: Vec<Budget>,
}

/// Why there are no budgets.
#[derive(Debug, thiserror::Error)]
pub enum BudgetError {
    /// The file is not there.
    #[error("{path}: {error}: name the file of budgets")]
    File {
        /// Where.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// It is not what is expected.
    #[error("{path}: {error}")]
    Toml {
        /// Where.
        path: PathBuf,
        /// Why.
        error: toml::de::Error,
    },
    /// A budget nothing is held to.
    #[error("the budget \"{budget}\" is for {what}, which the images do not have: correct the name")]
    Unknown {
        /// The budget.
        budget: String,
        /// The image or crate.
        what: String,
    },
}

/// Reads a file of budgets.
///
/// # Errors
/// A [`BudgetError`].
pub fn read(path: &Path) -> Result<Vec<Budget>, BudgetError> {
    let text = std::fs::read_to_string(path);
    let text = text.map_err(|error| BudgetError::File { path: path.to_owned(), error })?;
    let file: Result<Budgets, _> = toml::from_str(&text);
    file.map(|file| file.budget).map_err(|error| BudgetError::Toml { path: path.to_owned(), error })
}

/// A budget beside what is taken.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The budget.
    pub budget: Budget,
    /// What the image, or those crates, take.
    pub taken: Share,
}

impl Verdict {
    /// Holds an image to its budget.
    ///
    /// # Errors
    /// [`BudgetError::Unknown`].
    pub fn of(budget: &Budget, images: &[Image]) -> Result<Self, BudgetError> {
        let unknown =
            |what: &str| BudgetError::Unknown { budget: budget.name.clone(), what: what.to_owned() };
        let image = images.iter().find(|image| image.name == budget.image);
        let image = image.ok_or_else(|| unknown(&budget.image))?;
        let share = |name: &String| image.crates.get(name).ok_or_else(|| unknown(name));
        let mut taken = if budget.crates.is_empty() { image.total.clone() } else { Share::default() };
        for name in &budget.crates {
            taken.add(share(name)?);
        }
        for name in &budget.without {
            taken.flash -= share(name)?.flash.min(taken.flash);
            taken.ram -= share(name)?.ram.min(taken.ram);
        }
        Ok(Self { budget: budget.clone(), taken })
    }

    /// Whether nothing is over. A frame of computed size is over any budget.
    pub fn is_kept(&self) -> bool {
        self.lines().iter().all(|(_, taken, most)| taken <= most)
    }

    fn lines(&self) -> Vec<(&'static str, u64, u64)> {
        let frame = if self.taken.frame.computed { u64::MAX } else { self.taken.frame.bytes.into() };
        [
            ("flash", self.taken.flash, self.budget.flash),
            ("RAM", self.taken.ram, self.budget.ram),
            ("deepest frame", frame, self.budget.frame),
        ]
        .into_iter()
        .filter_map(|(what, taken, most)| Some((what, taken, most?)))
        .collect()
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (what, taken, most) in self.lines() {
            let word = if taken <= most { "kept" } else { "EXCEEDED" };
            let taken = if taken == u64::MAX { "computed".to_owned() } else { taken.to_string() };
            writeln!(f, "{:46} {what:14} {taken:>8} of {most:>8}  {word}", self.budget.name)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::frames::Frame;
    use super::*;

    fn image() -> Image {
        let share = |flash, bytes| Share {
            flash,
            ram: 8,
            frame: Frame { bytes, computed: false },
            deepest: String::new(),
        };
        let crates = [("a".to_owned(), share(100, 40)), ("b".to_owned(), share(50, 60))].into();
        Image { name: "program".to_owned(), crates, total: share(160, 60) }
    }

    fn verdict(text: &str) -> Result<Verdict, BudgetError> {
        let budget = toml::from_str(&format!("name = \"x\"\nimage = \"program\"\n{text}")).unwrap();
        Verdict::of(&budget, &[image()])
    }

    #[test]
    fn a_budget_is_kept_up_to_its_last_byte() {
        assert!(verdict("flash = 160").unwrap().is_kept());
        assert!(!verdict("flash = 159").unwrap().is_kept());
        assert!(verdict("crates = [\"a\", \"b\"]\nflash = 150\nram = 16\nframe = 60").unwrap().is_kept());
        assert!(!verdict("crates = [\"a\", \"b\"]\nflash = 149").unwrap().is_kept());
        assert!(verdict("without = [\"a\"]\nflash = 60").unwrap().is_kept());
        assert!(!verdict("without = [\"a\"]\nflash = 59").unwrap().is_kept());
        assert!(!verdict("ram = 7").unwrap().is_kept());
        assert!(!verdict("crates = [\"b\"]\nframe = 59").unwrap().is_kept());
        assert!(verdict("crates = [\"a\"]\nframe = 59").unwrap().is_kept());
        assert!(verdict("frame = 1").unwrap().to_string().contains("EXCEEDED"));
    }

    #[test]
    fn a_computed_frame_is_over_any_budget() {
        let mut verdict = verdict("frame = 1000").unwrap();
        verdict.taken.frame.computed = true;
        assert!(!verdict.is_kept());
    }

    #[test]
    fn a_budget_for_nothing_is_an_error() {
        assert!(matches!(verdict("crates = [\"c\"]"), Err(BudgetError::Unknown { what, .. }) if what == "c"));
        let none: Result<Budget, _> = toml::from_str("name = \"x\"\nimage = \"p\"\nflush = 1");
        assert!(none.is_err(), "a misspelt limit would be no limit");
    }
}

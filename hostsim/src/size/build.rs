//! The firmware's images. In: the workspace. Out: ELF files. Cost: a build of the Cortex-M programs, once.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Of every Cortex-M program.
pub const TARGET: &str = "thumbv7em-none-eabihf";
/// Their profile in the workspace.
pub const PROFILE: &str = "firmware";

/// Why there are no images.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// Cargo could not be started.
    #[error("{cargo}: {error}: install Rust, or set CARGO to a cargo")]
    Start {
        /// What was started.
        cargo: String,
        /// Why it was not.
        error: std::io::Error,
    },
    /// Cargo gave up.
    #[error(
        "the firmware does not build ({status}): if the target is missing, `rustup target add {TARGET}`\n{text}"
    )]
    Failed {
        /// How cargo ended.
        status: std::process::ExitStatus,
        /// What it said.
        text: String,
    },
}

/// Builds all programs of `lucerna-app` and gives the folder they are in.
///
/// `target_dir` should be one of its own: a build inside another one's folder would wait for its lock.
///
/// # Errors
/// A [`BuildError`].
pub fn images(root: &Path, target_dir: &Path) -> Result<PathBuf, BuildError> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(&cargo)
        .current_dir(root)
        .args(["build", "--package", "lucerna-app", "--bins", "--target", TARGET, "--profile", PROFILE])
        .arg("--target-dir")
        .arg(target_dir)
        // A host's flags are not the board's.
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .output()
        .map_err(|error| BuildError::Start { cargo, error })?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(BuildError::Failed { status: output.status, text });
    }
    Ok(target_dir.join(TARGET).join(PROFILE))
}

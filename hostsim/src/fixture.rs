//! The job file of the Cortex-M programs. In: a built-in scene. Out: words as `lucerna_app::fixture` reads them. Cost: two
//! ray-tracing passes of a small picture.
//!
//! ```
//! use lucerna_app::fixture::Fixture;
//!
//! let file = hostsim::fixture::bytes()?;
//! let fixture = Fixture::new(&file)?;
//! assert_eq!((fixture.header().hit_points, fixture.header().index_entries), (606, 4848));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::path::{Path, PathBuf};

use lucerna_app::fixture::{Header, seal};

use crate::accelerate::session::ALPHA;
use crate::grid::{GridError, HashGrid};
use crate::scene::{LoadOptions, Scene, SceneError};
use crate::trace::{PhotonChunk, eye_pass};

/// The scene.
pub const SCENE: &str = "cornell-balls";
/// The picture's width.
pub const WIDTH: u32 = 20;
/// The picture's height.
pub const HEIGHT: u32 = 15;
/// Photons emitted.
pub const EMITTED: u32 = 1_000;

/// Why no file was made.
#[derive(Debug, thiserror::Error)]
pub enum FixtureError {
    /// The scene could not be loaded.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// It has no hit points to speak of.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A count does not fit 32 bits.
    #[error("more photons than 32 bits count: emit fewer")]
    TooLarge,
    /// The file could not be written.
    #[error("{path}: {error}: check that the folder exists and can be written to")]
    Write {
        /// Where.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
}

/// The file's words for the job of 20×15 pixels and 1,000 photons.
///
/// # Errors
/// A [`FixtureError`]; none for the built-in scene.
pub fn words() -> Result<Vec<u32>, FixtureError> {
    let scene = Scene::load(SCENE, &LoadOptions::default())?;
    let points = eye_pass(&scene, WIDTH, HEIGHT);
    let grid = HashGrid::build(&points, WIDTH, HEIGHT)?;
    let mut photons = PhotonChunk::default();
    photons.fill(&scene, &grid, 0..EMITTED);

    let count = |length: usize| u32::try_from(length).map_err(|_| FixtureError::TooLarge);
    let header = Header {
        width: WIDTH,
        height: HEIGHT,
        emitted: EMITTED,
        alpha: ALPHA,
        radius_squared: (grid.radius() * grid.radius()) as f32,
        hit_points: count(points.len())?,
        index_entries: count(grid.entries().len())?,
        photons: count(photons.hits.len())?,
    };
    let mut file = header.words().to_vec();
    for point in &points {
        file.extend([point.position, point.normal, point.colour].into_iter().flat_map(bits));
        file.push(point.pixel);
    }
    file.extend(grid.entries());
    for (hit, list) in photons.hits.iter().zip(&photons.lists) {
        file.extend([hit.position, hit.normal, hit.flux].into_iter().flat_map(bits));
        file.extend([list.p_addr, list.n]);
    }
    seal(&mut file);
    Ok(file)
}

fn bits(vector: crate::scene::Vec3) -> [u32; 3] {
    vector.to_f32().map(f32::to_bits)
}

/// The file's bytes.
///
/// # Errors
/// As [`words`].
pub fn bytes() -> Result<Vec<u8>, FixtureError> {
    Ok(words()?.into_iter().flat_map(u32::to_le_bytes).collect())
}

/// Writes the file.
///
/// # Errors
/// A [`FixtureError`].
pub fn write(path: &Path) -> Result<(), FixtureError> {
    std::fs::write(path, bytes()?).map_err(|error| FixtureError::Write { path: path.to_owned(), error })
}

//! Around the device, on a host: scenes in, photons and hit points for the accelerator out, and what judges its results.
//!
//! The data flow: [`scene`] reads a scene; [`trace`] follows eye rays to hit points and photons to surface hits, in f64;
//! [`grid`] turns the hit points into the index table the engine walks; [`oracle`] computes the same radiance without
//! the engine (an f64 estimator, and a scalar loop in the engine's own format for a comparison bit by bit);
//! [`picture`] makes and compares pictures. [`displace`] does the same for displaced surfaces: maps and views in, rays for the
//! displacement unit out, an exact march to judge what it found.
//!
//! ```
//! use hostsim::grid::HashGrid;
//! use hostsim::oracle::Reference;
//! use hostsim::scene::{LoadOptions, Scene};
//! use hostsim::trace::{PhotonChunk, chunks, eye_pass};
//!
//! let scene = Scene::load("cornell-balls", &LoadOptions::default())?;
//! let (width, height, emitted) = (20, 15, 1_000);
//! let points = eye_pass(&scene, width, height);
//! let grid = HashGrid::build(&points, width, height)?;
//! let mut reference = Reference::new(&points, grid.radius(), true);
//! let mut chunk = PhotonChunk::default();
//! for range in chunks(emitted, 256) {
//!     chunk.fill(&scene, &grid, range);
//!     reference.feed(&chunk, grid.entries());
//! }
//! let radiance = reference.radiance(width * height, emitted);
//! assert_eq!((points.len(), reference.counts().operations), (606, 123_682));
//! assert_eq!(radiance.len(), 300);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod accelerate;
pub mod cli;
pub mod displace;
pub mod fixture;
pub mod format;
pub mod grid;
pub mod oracle;
pub mod picture;
pub mod render;
pub mod replay;
pub mod reproduce;
pub mod scene;
pub mod size;
pub mod trace;

//! In: a scene. Out: hit points in the order they are made, surface hits of photons in the order they happen.
//! Cost: about one scene query per hit; photons come in chunks, so memory stays bounded for any number of them.
//!
//! Everything is f64, as the data controller outside the engine (PREE §IV): rows and photons are spread over threads, yet
//! the results are in the order of one thread.

mod eye;
mod halton;
mod photon;
mod surface;

pub use eye::{HitPoint, eye_pass};
pub use halton::halton;
pub use photon::{PhotonChunk, SurfaceHit, chunks, emit, trace_photons};

//! In: a scene. Out: hit points in the order they are made, surface hits of photons in the order they happen.
//! Cost: about one scene query per hit; photons come in chunks, so memory stays bounded for any number of them.
//!
//! Everything is f64, as the data controller outside the engine (PREE §IV): rows and photons are spread over threads, yet
//! the results are in the order of one thread.
//!
//! The displacement unit works on lists of rays, so tracing goes in waves: paths run until they end or meet a displaced surface,
//! a [`Displacer`] answers all that wait at once, and they go on.

mod displaced;
mod eye;
mod halton;
mod photon;
mod surface;

pub use displaced::{Answer, Displacer, Flat, Request};
pub use eye::{HitPoint, eye_pass, eye_pass_through};
pub use halton::halton;
pub use photon::{PhotonChunk, SurfaceHit, chunks, emit, trace_photons, trace_photons_through};

//! A displaced surface, through the unit; in: a height map and a view, out: pictures and a report; cost: the device's steps, and
//! an exact march a ray to judge them.
//!
//! [`map`], [`procedural`] and [`presets`] say what the surface is, [`view`] and [`mod@ray`] what looks at it; [`workload`] is
//! both. The device does the work, [`judge`] asks the oracles whether it was right, [`picture`] shows it.

pub mod judge;
pub mod map;
pub mod noise;
pub mod picture;
pub mod presets;
pub mod procedural;
pub mod ray;
pub mod report;
pub mod rules;
mod run;
pub mod session;
pub mod setup;
mod summary;
pub mod usage;
pub mod view;
pub mod workload;

pub use run::{DisplaceError, Options, displace, load};

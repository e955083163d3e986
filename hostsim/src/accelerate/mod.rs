//! The device at work; in: a workload and what device to build, out: pixels, hit points and counters; cost: the engine's cycles.
//!
//! [`setup`] says which device, [`memory`] is what it works in, [`session`] drives it through the `no_std` driver, bus and
//! registers like any other program would. Nothing here looks into the device.

pub mod bus;
pub mod memory;
pub mod session;
pub mod setup;

pub use session::{Outcome, PhotonSource, RunError, Workload, run};
pub use setup::{Arith, Setup, Units};

//! The progressive radiance estimation engine (PREE); in: hit points, an index table and a stream of photons, out: refined hit
//! points, then pixels; cost: N operations a cycle.
//!
//! The data's way: [`feed`] takes photons from the ring, [`schedule`] fills the PREUs from up to four of them, [`update`]
//! fetches, judges hazards, issues and writes back; [`allocation`] says in which order [`evaluate`] adds hit points to pixels.
//! [`preu`] is the arithmetic, [`hazard`] the policy, [`job`] what may be asked for, [`engine`] the unit's top, and
//! [`fast`] does what `tick` does, with the same bits and counters, sooner.
//!
//! Numbers such as D7 are decisions on what the paper leaves open; the project's documentation lists them.
//!
//! ```
//! use lucerna_fabric::window::{Window, Windows};
//! use lucerna_pree::engine::{Event, Pree};
//! use lucerna_pree::job::{Rules, Table, UpdateJob};
//! use lucerna_softfloat::{F32, Format};
//!
//! // One hit point at the origin (R² = 1), one index entry, a ring of one photon.
//! let mut memory = [0u32; 32];
//! memory[12] = F32::ONE.to_bits();
//! memory[16] = 0;
//! memory[17 + 7] = 1; // n
//! let windows = Windows::new([Window { base: 0, limit: 128 }], 128);
//! let job = UpdateJob::new(
//!     &windows,
//!     Table { base: 0, count: 1 },
//!     Table { base: 64, count: 1 },
//!     Table { base: 68, count: 1 },
//!     F32::from_f32(0.75),
//!     Rules::default(),
//! )
//! .unwrap();
//! let mut engine: Pree<F32, 4> = Pree::new();
//! engine.update(job).unwrap();
//! engine.doorbell(1).unwrap();
//! engine.flush();
//! while engine.tick(&mut memory) != Some(Event::Done) {}
//! assert_eq!(f32::from_bits(memory[13]), 0.75, "N = 0 + α");
//! assert_eq!(engine.counters().update_cycles, 2, "one to load, one to dispatch");
//! ```
#![no_std]

pub mod allocation;
pub mod counters;
pub mod engine;
pub mod evaluate;
pub mod fast;
pub mod feed;
pub mod hazard;
pub mod job;
pub mod preu;
pub mod record;
pub mod schedule;
pub mod update;

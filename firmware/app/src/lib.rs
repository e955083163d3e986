//! The Cortex-M programs' common part. In: a job in a file, and a device behind any bus. Out: a report as text. Cost: the
//! job's; no allocation.
//!
//! | program | is |
//! |---|---|
//! | `pree_f32`, `pree_f24` | the device model in the image, and the driver in front of it, at a job of 20×15 pixels |
//! | `driver_only` | the driver alone, over memory-mapped registers |
//!
//! [`fixture`] reads the job, [`session`] drives it and reports, [`picture`] draws with letters. All of it is the same on
//! a host, so a host can say what a board must print, to the bit and the cycle. What only a board has is in `board`.
//!
//! ```
//! use lucerna_app::{fixture::Fixture, session};
//! use lucerna_bus::Model;
//! use lucerna_device::Device;
//! use lucerna_softfloat::F24;
//!
//! let file = include_bytes!("../../../fixtures/cornell-balls-20x15.lcn");
//! let mut memory = [0; session::MEMORY_WORDS];
//! let model = Model::new(Device::<F24, 4, _>::new(&mut memory[..]));
//! let mut report = String::new();
//! session::run(model.bus(), model.delay(), &Fixture::new(file)?, &mut report)?;
//! assert!(report.contains("interlock.operations 123682\n"), "{report}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![no_std]

#[cfg(target_os = "none")]
pub mod board;
pub mod fixture;
pub mod picture;
pub mod session;

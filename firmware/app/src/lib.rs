//! The Cortex-M programs' common part. In: a job, and a device behind any bus. Out: a report as text. Cost: the job's; no
//! allocation.
//!
//! | program | is |
//! |---|---|
//! | `pree_f32`, `pree_f24` | the device model in the image, and the driver in front of it, at a job of 20×15 pixels |
//! | `displace_f32`, `displace_f24` | the same for the displacement unit, at two pictures of 32×24 pixels of a map of 64×64 texels |
//! | `driver_only` | the driver alone, over memory-mapped registers |
//!
//! [`fixture`] reads the PREE's job, [`session`] drives it and reports; [`displace`] makes its own and does the same;
//! [`picture`] draws with letters. All of it is the same on a host, so a host can say what a board must print, to the bit and
//! the cycle. What only a board has is in `board`.
//!
//! ```
//! use lucerna_app::{fixture::Fixture, session};
//! use lucerna_bus::Model;
//! use lucerna_device::PreeDevice;
//! use lucerna_softfloat::F24;
//!
//! let file = include_bytes!("../../../fixtures/cornell-balls-20x15.lcn");
//! let mut memory = [0; session::MEMORY_WORDS];
//! let model = Model::new(PreeDevice::<F24, 4, _>::new(&mut memory[..]));
//! let mut report = String::new();
//! session::run(model.bus(), model.delay(), &Fixture::new(file)?, &mut report)?;
//! assert!(report.contains("interlock.operations 123682\n"), "{report}");
//!
//! use lucerna_app::displace;
//! use lucerna_device::DisplaceDevice;
//! use lucerna_displace::engine::Sizes;
//!
//! let mut memory = [0; displace::MEMORY_WORDS];
//! let model = Model::new(DisplaceDevice::<F24, 1, 512, _>::new(Sizes::default(), &mut memory[..])?);
//! let mut report = String::new();
//! displace::run(model.bus(), model.delay(), &mut [0; displace::scene::TEXELS], &mut report)?;
//! assert!(report.contains("fold.rays 768\n"), "{report}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![no_std]

#[cfg(target_os = "none")]
pub mod board;
pub mod displace;
pub mod fixture;
pub mod picture;
pub mod session;

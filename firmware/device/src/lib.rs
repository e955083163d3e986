//! The device: register files, memory and units, wired; in: register and memory accesses, clocks, out: words, the interrupt
//! line; cost: one tick a clock.
//!
//! ```text
//!            accesses
//! bus --+--> ident, interrupts, windows <------ events ------+
//!       |                          |                         |
//!       +--> pree:     registers --+-- job --> N PREUs ------+
//!       |                          |               |         |
//!       +--> displace: registers --+-- job --> U units ------+
//!       |                                          |
//!       +--> memory <-------- buffers in windows --+
//! ```
//!
//! [`Device`] knows no driver and no bus: it is what a [`Target`](lucerna_bus::Target) is. A unit is a [`Block`](block::Block)
//! beside others, in a folder of its own: its registers keep what was written, bits and all; its job turns that into what the
//! unit can do, or the fault to report. Where there is no unit there is [`Absent`].
//!
//! | device | units |
//! |---|---|
//! | [`PreeDevice`] | the progressive radiance estimation engine |
//! | [`DisplaceDevice`] | the pyramidal displacement mapping unit |
//! | [`FullDevice`] | both |
//!
//! ```
//! use lucerna_bus::{Target, TargetError};
//! use lucerna_device::{DisplaceDevice, PreeDevice};
//! use lucerna_displace::engine::Sizes;
//! use lucerna_regs::{Register, UNIT_DISPLACE, displace, ident};
//! use lucerna_softfloat::F24;
//!
//! let mut device = PreeDevice::<F24, 8, _>::new([0; 64]);
//! let capabilities = ident::Capabilities::from_bits(device.read(ident::CAPABILITIES).unwrap());
//! assert_eq!(capabilities.preus(), 8);
//! assert_eq!(capabilities.format(), Ok(ident::NumberFormat::F24));
//! assert_eq!(device.read(ident::MEMORY_BYTES), Ok(256));
//! assert_eq!(device.read(displace::STATUS), Err(TargetError::Unmapped));
//!
//! let mut device = DisplaceDevice::<F24, 1, 512, _>::new(Sizes::default(), [0; 64])?;
//! let capabilities = ident::Capabilities::from_bits(device.read(ident::CAPABILITIES).unwrap());
//! assert_eq!((capabilities.preus(), capabilities.units()), (0, UNIT_DISPLACE));
//! assert_eq!(device.read(displace::STATUS), Ok(0));
//! # Ok::<(), lucerna_displace::engine::SizeError>(())
//! ```
#![no_std]

pub mod block;
mod device;
pub mod displace;
pub mod first_error;
pub mod pree;
mod shared;

pub use block::Absent;
pub use device::{Device, DisplaceDevice, FullDevice, PreeDevice};

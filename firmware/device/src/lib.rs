//! The device: register file, memory and units, wired; in: register and memory accesses, clocks, out: words, the interrupt
//! line; cost: one tick a clock.
//!
//! ```text
//!            accesses                     jobs, photons
//! bus ------> registers ---- job ------> pree (N PREUs)
//!   \            ^   ^---- events, counters ----'  |
//!    `-> memory <--------- windows ----------------'
//! ```
//!
//! [`Device`] knows no driver and no bus: it is what a [`Target`](lucerna_bus::Target) is. [`registers`] keeps what was
//! written, bits and all; [`job`] turns it into what the engine can do, or the fault to report.
//!
//! ```
//! use lucerna_bus::Target;
//! use lucerna_device::Device;
//! use lucerna_regs::{Register, ident};
//! use lucerna_softfloat::F24;
//!
//! let mut device: Device<F24, 8, [u32; 64]> = Device::new([0; 64]);
//! let capabilities = ident::Capabilities::from_bits(device.read(ident::CAPABILITIES).unwrap());
//! assert_eq!(capabilities.preus(), 8);
//! assert_eq!(capabilities.format(), Ok(ident::NumberFormat::F24));
//! assert_eq!(device.read(ident::MEMORY_BYTES), Ok(256));
//! ```
#![no_std]

mod device;
pub mod job;
pub mod registers;

pub use device::Device;

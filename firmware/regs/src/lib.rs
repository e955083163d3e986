#![cfg_attr(not(test), no_std)]
//! The register map: all that a driver and a device share. In: nothing. Out: offsets, and registers as bits with named fields.
//!
//! Written once in SystemRDL (`rdl/`, one file a block); `regenerate` makes the modules below, the CMSIS-SVD file, the C header
//! and the documents in `docs/registers` from it. No `unsafe`, no bus, no allocation; every function is a shift and a mask.
//!
//! | block | offset | what for |
//! |---|---|---|
//! | [`ident`] | `0x000` | identification, version, capabilities: read first |
//! | [`interrupts`] | `0x040` | status (write 1 to clear) and enable of the one interrupt line |
//! | [`window`] | `0x080` | four windows; the device touches no memory outside |
//! | [`pree`] | `0x100` | the progressive radiance estimation engine: configuration, buffers, ring, state, error |
//! | [`counters`] | `0x200` | its 64-bit counters, read from a snapshot |
//! | [`displace`] | `0x300` | the pyramidal displacement mapping unit: policies, maps, rays, shading, state, error |
//! | [`displace_counters`] | `0x400` | its 64-bit counters, read from a snapshot |
//!
//! An offset is a constant, `pree::CONFIG`; a register with fields has a type, `pree::Config`; a register which is one number
//! (`pree::HIT_BASE`) is a plain `u32`. A type holds any word: an illegal encoding gives [`Illegal`] when its field is read.
//!
//! ```
//! use lucerna_regs::pree::{self, Config, Hazard, InputWidth, Mode};
//! use lucerna_regs::{Illegal, counters::Counter, interrupts, window};
//!
//! // A driver builds a word and sends it to an offset.
//! let config = Config::default().with_mode(Mode::Evaluate).with_hazard(Hazard::Forward);
//! assert_eq!((pree::CONFIG, config.bits()), (0x104, 0b001_0_01_0_1));
//! assert_eq!(window::limit(1), 0x08C);
//!
//! // A device takes any word and finds out whether it means something.
//! let nonsense = Config::from_bits(0xFFFF_FFFF);
//! assert_eq!(nonsense.mode(), Mode::Evaluate);
//! assert_eq!(nonsense.hazard(), Err(Illegal { bits: 3 }));
//! assert_eq!(Config::default().input_width(), Ok(InputWidth::One));
//!
//! // Both walk the counters in the same order.
//! assert_eq!(Counter::ALL[0].low(), 0x208);
//! assert!(interrupts::Status::from_bits(1).done());
//! ```

mod generated;
pub mod register;

pub use generated::{
    BLOCKS, REGISTERS, counters, displace, displace_counters, ident, interrupts, pree, window,
};
pub use register::{Block, Description, Field, Half, Illegal, Register};

/// The unit bit of the PREE in `CAPABILITIES.UNITS`.
pub const UNIT_PREE: u32 = 1 << 0;
/// The unit bit of the displacement unit in `CAPABILITIES.UNITS`.
pub const UNIT_DISPLACE: u32 = 1 << 1;

/// The table entry of the register at a byte offset, if there is one.
pub fn describe(offset: u32) -> Option<&'static Description> {
    let place = REGISTERS.binary_search_by_key(&offset, |register| register.offset).ok()?;
    REGISTERS.get(place)
}

//! IEEE 754 arithmetic in any small binary format: bits in, correctly rounded bits (and flags) out, in some 3 to 5 ns an
//! operation on a host (`cargo bench -p lucerna-softfloat`).
//!
//! [`Float<EXP, FRAC>`](Float) is a sign, `EXP` exponent bits and `FRAC` fraction bits in a `u32`. [`F32`] is the usual
//! single precision (1-8-23), [`F24`] the 24-bit format of the accelerator (1-7-16). Everything rounds to nearest,
//! ties to even, and gives the same bits on every machine: a model, its firmware and an RTL test bench can compare
//! for equality.
//!
//! ```
//! use lucerna_softfloat::{F24, Flags, Policy};
//!
//! let third = F24::ONE / F24::from_f32(3.0);
//! assert_eq!(third.to_bits(), 0x3D_5555);
//!
//! // The same with IEEE flags, and with the treatment of subnormals said.
//! let least = F24::MIN_POSITIVE;
//! let half = F24::from_f32(0.5);
//! let gradual = least.mul_with(half, Policy::GRADUAL);
//! assert_eq!((gradual.value.to_bits(), gradual.flags), (0x00_8000, Flags::NONE));
//! let flushed = least.mul_with(half, Policy::FLUSH);
//! assert_eq!((flushed.value, flushed.flags), (F24::ZERO, Flags::UNDERFLOW | Flags::INEXACT));
//!
//! // Constants are computed by the compiler.
//! const ROOT_2: F24 = F24::from_f32(2.0).sqrt();
//! assert_eq!(ROOT_2.to_f32(), 1.4142151);
//! ```
//!
//! # Rules
//! - **Plain methods** (`a.add(b)`, `a + b`) follow IEEE 754 with gradual subnormals and give no flags.
//! - **`_with` methods** take a [`Policy`] and return [`Flagged`] values.
//! - **NaN**: every NaN result is the one canonical quiet NaN ([`Float::NAN`]), as RISC-V has it. Invalid is raised only
//!   by signalling operands and invalid operations.
//! - **Integers**: conversions saturate, and a NaN gives the largest value, as RISC-V has it.
//! - **`==` on [`Float`] is equality of bits** (so that results can be asserted); the IEEE comparisons are
//!   [`lt`](Float::lt), [`le`](Float::le) and [`eq`](Float::eq).
//! - What DesignWare's components do with `ieee_compliance = 0` is not public in detail (no subnormals, NaN read as
//!   infinity), so no policy here claims to be that.
#![cfg_attr(not(test), no_std)]

mod add;
mod compare;
mod convert;
mod div;
mod flags;
mod float;
mod format;
mod host;
mod integer;
mod line;
mod min_max;
mod mul;
mod ops;
mod policy;
mod round;
mod sqrt;

pub use flags::{Flagged, Flags};
pub use float::{F24, F32, Float};
pub use format::{Format, FormatCode};
pub use line::{Line, PlainLine};
pub use policy::{Policy, Rounding, Subnormals};

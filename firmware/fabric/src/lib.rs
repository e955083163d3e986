//! What every unit is built of; in: nothing but numbers, out: exact cycles; cost: no allocation, capacities in the types.
//!
//! | module | holds |
//! |---|---|
//! | [`delay`] | a fixed number of clocked stages between two parts |
//! | [`inflight`] | a pipeline's contents as a scoreboard: which address was issued how many cycles ago |
//! | [`window`] | memory windows and the buffers that were checked against them |
//!
//! ```
//! use lucerna_fabric::delay::Delay;
//!
//! // A value put in this cycle is seen three cycles later, never sooner.
//! let mut memory: Delay<u32, 3> = Delay::new();
//! assert_eq!(memory.shift(Some(7)), None);
//! assert_eq!(memory.shift(None), None);
//! assert_eq!(memory.shift(None), None);
//! assert_eq!(memory.shift(None), Some(7));
//! ```
#![no_std]

pub mod delay;
pub mod inflight;
pub mod window;

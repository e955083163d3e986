//! What every unit is built of; in: nothing but numbers, out: exact cycles; cost: no allocation, capacities in the types.
//!
//! | module | holds |
//! |---|---|
//! | [`cache`] | tags of a set-associative cache whose size is chosen at run time |
//! | [`delay`] | a fixed number of clocked stages between two parts |
//! | [`inflight`] | a pipeline's contents as a scoreboard: which address was issued how many cycles ago |
//! | [`port`] | the memory read port that requesters share |
//! | [`semi`] | a semi-pipelined unit: initiation interval, latency, back pressure |
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

pub mod cache;
pub mod delay;
pub mod inflight;
pub mod port;
pub mod semi;
pub mod window;

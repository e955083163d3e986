//! What the tests share: operands worth trying, and plain oracles to compare with.
#![allow(dead_code, reason = "each test file uses some of it")]

pub mod exact;
pub mod operands;

use lucerna_softfloat::{Flagged, Float};

/// A result and its flags as bits, however they were come by.
pub type Outcome = (u32, u8);

pub fn outcome<const EXP: u32, const FRAC: u32>(ours: Flagged<Float<EXP, FRAC>>) -> Outcome {
    (ours.value.to_bits(), ours.flags.bits())
}

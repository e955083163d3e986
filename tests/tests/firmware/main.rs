//! Does a Cortex-M print what a host computes, to the bit and the cycle?
//!
//! The images are built once, into a folder of their own, and run by the very runner that `cargo run` uses.

mod board;
mod displace;
mod ends;
mod pree;

//! The pyramidal displacement-mapping unit; in: rays and a pyramid of heights, out: hit texels and colours; cost: one
//! traversal step a cycle and instance.
#![cfg_attr(not(test), no_std)]

pub mod counters;
pub mod engine;
mod fast;
pub mod instance;
pub mod job;
pub mod operators;
mod outlook;
pub mod outside;
pub mod pyramid;
pub mod read;
pub mod record;
pub mod shade;
pub mod sizes;
pub mod slots;
pub mod source;
pub mod traverse;
pub mod view;

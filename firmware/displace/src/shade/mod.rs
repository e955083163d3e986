//! What happens to a hit (§4.1); in: its ray and leaf texel, out: a result's position and colour; cost: see the two units.

pub mod address;
pub mod colour;

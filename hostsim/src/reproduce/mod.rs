//! Published figures beside ours; in: nothing but the reference workloads, out: a table and JSON; cost: minutes.

pub mod pree;
pub mod table;

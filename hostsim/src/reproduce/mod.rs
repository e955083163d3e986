//! Published figures beside ours; in: the reference workloads, or the paper's maps, out: a table and JSON; cost: minutes.

pub mod displacement;
pub mod pree;
pub mod table;

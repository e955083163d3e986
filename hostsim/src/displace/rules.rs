//! The device's policies as the oracle has them; in: what the driver calls them, out: what the f64 traversal calls them; cost: none.

use lucerna_driver::displace::{Ascend, Coherent, Policies};

use crate::oracle::{LevelUp, Rules};

/// The rules that a device of these policies follows.
pub fn rules(policies: &Policies) -> Rules {
    let up = match (policies.ascend, policies.coherent) {
        (Ascend::Never, _) => LevelUp::Never,
        (Ascend::Parity, _) => LevelUp::Parity,
        (Ascend::Selective, _) => LevelUp::Selective(i64::from(policies.reach as u32)),
        (Ascend::Coherent, reading) => LevelUp::Coherent {
            consecutive: reading == Coherent::Consecutive,
            parity: reading == Coherent::Parity,
        },
    };
    Rules {
        start: policies.start_level.then_some(policies.start_grid),
        down: policies.levels_down as u32,
        up,
        siblings: policies.siblings,
    }
}

//! The traversal of the pyramid (§3); in: a ray and the heights it asks for, out: the leaf texel it hits; cost: one step a height.
//!
//! [`walk`] is the mechanics that every algorithm shares: where a ray is, and whether it crosses into the neighbour node or
//! comes down on the node's top; [`ray`] and [`heights`] are what it asks. Which level it goes on at is policy, one a file:
//! [`start`], [`descend`], [`ascend`]. No policy can change the texel that is hit, only the number of steps.

pub mod ascend;
pub mod descend;
pub mod heights;
pub mod ray;
pub mod start;
pub mod walk;

pub use ascend::{Ascend, Coherent};

/// What lies beyond the map's edges.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Wrap {
    /// The map again.
    #[default]
    Repeat,
    /// Nothing: heights of 0, and a ray that ends there is a miss.
    Border,
}

/// How a ray goes up and down, and what is beyond the map.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Policies {
    /// Beyond the edges.
    pub wrap: Wrap,
    /// Begin at the start level (§3.1), not at the root.
    pub start_level: bool,
    /// The start level is found on a grid `1 << start_grid` times finer (P19), 0 to 3.
    pub start_grid: u32,
    /// Levels down at once before the first crossing (§3.2, P6), 1 to 4.
    pub levels_down: u32,
    /// When to go up.
    pub ascend: Ascend,
    /// What "coherent" means.
    pub coherent: Coherent,
    /// (c1) stays on its level when the ray comes down at most this many nodes further, 1 to 3; the paper's is 1 (P4, P23).
    pub reach: u32,
    /// Look at siblings: they come in the word that the height cache delivers anyhow, and a ray that crosses into one and is
    /// below its top goes down in the same step (P22). Not in the paper.
    pub siblings: bool,
}

impl Default for Policies {
    /// The paper's hardware: a + b + c1.
    fn default() -> Self {
        Self {
            wrap: Wrap::default(),
            start_level: true,
            start_grid: 0,
            levels_down: 2,
            ascend: Ascend::default(),
            coherent: Coherent::default(),
            reach: 1,
            siblings: false,
        }
    }
}

impl Policies {
    /// Whether every number is in its range.
    pub const fn is_legal(&self) -> bool {
        let reach = self.reach >= 1 && self.reach <= 3;
        self.start_grid <= 3 && self.levels_down >= 1 && self.levels_down <= 4 && reach
    }
}

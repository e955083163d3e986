//! What the engine counts; in: events, out: 64-bit registers (block `counters`); cost: one incrementer each.

/// One field a counter; the same names in register, driver and report.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Counters {
    /// Photons taken from the ring, those with an empty list included.
    pub photons: u64,
    /// Photons whose list is empty: they never enter the buffer (D9).
    pub empty_cells: u64,
    /// Hit-point update operations issued: every list entry examined.
    pub operations: u64,
    /// Operations that changed their hit point.
    pub updates: u64,
    /// Cycles from the first load of the buffer to the last dispatch, and every stall.
    pub update_cycles: u64,
    /// Hit points evaluated.
    pub evaluations: u64,
    /// Cycles from the first address generated for evaluation to the last, and every stall.
    pub evaluate_cycles: u64,
    /// Cycles of running jobs, fill, drain and stalls included, starved ones not.
    pub total_cycles: u64,
    /// Cycles in which a hazard held the issue stage.
    pub stall_cycles: u64,
    /// Cycles in which the engine's clock was gated for want of photons. The only counter that depends on the host's pace.
    pub starved_cycles: u64,
    /// Dispatches of a full buffer that did not fill the PREUs (D1).
    pub partial_dispatches: u64,
    /// Operations that found their hit point in flight (D7).
    pub update_conflicts: u64,
    /// Updates computed from a stale hit point (`Published` only).
    pub stale_updates: u64,
    /// Hit points evaluated, or held, while their pixel was in flight (D12).
    pub pixel_conflicts: u64,
    /// Operands taken from a result in flight (`Forward` only).
    pub forwards: u64,
}

impl Counters {
    /// All at zero.
    pub const ZERO: Self = Self {
        photons: 0,
        empty_cells: 0,
        operations: 0,
        updates: 0,
        update_cycles: 0,
        evaluations: 0,
        evaluate_cycles: 0,
        total_cycles: 0,
        stall_cycles: 0,
        starved_cycles: 0,
        partial_dispatches: 0,
        update_conflicts: 0,
        stale_updates: 0,
        pixel_conflicts: 0,
        forwards: 0,
    };
}

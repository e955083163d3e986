//! Counters; in: events, out: totals since they were last cleared; cost: an adder each.

macro_rules! counters {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// What the unit counts. Busy, stall and turn counters are summed over the unit's instances.
        #[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
        pub struct Counters {
            $($(#[$doc])* pub $name: u64,)*
        }

        impl Counters {
            /// All zero.
            pub const ZERO: Self = Self { $($name: 0,)* };
        }
    };
}

counters! {
    /// Rays taken in.
    rays,
    /// Rays that hit a texel.
    hits,
    /// Pixels beside the surface, and rays that left a map without wrap.
    missed,
    /// Rays that do not come down on the surface (P18).
    grazing,
    /// Rays that the watchdog stopped.
    watchdogs,
    /// Steps of all rays (P1).
    steps,
    /// Most steps of a ray.
    max_steps,
    /// Passes in the first mode, which find a start level.
    start_passes,
    /// Levels between the root and where rays began, summed.
    levels_saved,
    /// Steps that crossed into a neighbour node.
    crossings,
    /// Crossings that went up a level.
    level_ups,
    /// Steps that went down.
    level_downs,
    /// Cycles of the job.
    cycles,
    /// Cycles in which the view calculation's issue was taken.
    view_busy,
    /// Cycles in which it had a ray and FIFO #0 no room.
    view_stalls,
    /// Turns of a slot that did a step or a start pass.
    traverse_busy,
    /// Turns lost waiting for a line fill.
    traverse_waits,
    /// Turns of a ray that has ended, held by a full FIFO #1 or refused (out of reach).
    traverse_stalls,
    /// Turns of an empty slot.
    traverse_bubbles,
    /// Cycles in which the address calculation's issue was taken.
    address_busy,
    /// Cycles in which it had a ray and the read unit did not take what it had.
    address_stalls,
    /// Cycles in which the read unit's port, or a line on its way in, was used.
    read_busy,
    /// Cycles in which it waited, for a line fill or for the colour calculation.
    read_stalls,
    /// Cycles in which the colour calculation's issue was taken.
    colour_busy,
    /// First tries of the height cache, one a step but for nodes beyond the border.
    height_accesses,
    /// Of these, those that found their line.
    height_hits,
    /// Those that did not.
    height_misses,
    /// Lines filled into the height cache.
    height_fills,
    /// Slots served by a fill on its way in (P17).
    height_forwards,
    /// Accesses of the unified texture and normal cache.
    texture_accesses,
    /// Of these, those that found their line.
    texture_hits,
    /// Those that did not.
    texture_misses,
    /// Lines filled into it.
    texture_fills,
    /// Bytes asked for at the memory port.
    port_bytes,
    /// Cycles in which the memory port transfers them.
    port_busy,
    /// Bytes of results.
    result_bytes,
    /// Steps that crossed and went down at once (P22).
    folds,
}

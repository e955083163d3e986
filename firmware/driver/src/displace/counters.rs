//! What the displacement unit has counted. In: its snapshot. Out: a struct. Cost: a write and 74 reads.

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_regs::displace_counters::{self, Counter};

use crate::{Error, Lucerna};

/// A struct of counters with the field of each by its register's name.
macro_rules! counters {
    ($($(#[$doc:meta])* $field:ident: $counter:ident,)*) => {
        /// All counters at one moment, accumulated since they were last cleared; but `max_steps` is a maximum. Busy, stall
        /// and turn counters are summed over the unit's instances.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        pub struct Counters {
            $($(#[$doc])* pub $field: u64,)*
        }

        impl Counters {
            /// The value of a counter by its register's name, for tables.
            pub const fn get(&self, counter: Counter) -> u64 {
                match counter {
                    $(Counter::$counter => self.$field,)*
                }
            }

            fn field(&mut self, counter: Counter) -> &mut u64 {
                match counter {
                    $(Counter::$counter => &mut self.$field,)*
                }
            }
        }
    };
}

counters! {
    /// Rays taken in.
    rays: Rays,
    /// Rays that hit a texel.
    hits: Hits,
    /// Pixels beside the surface, and rays that left a map without wrap.
    missed: Missed,
    /// Rays that do not come down on the surface (P18).
    grazing: Grazing,
    /// Rays that the watchdog stopped.
    watchdogs: Watchdogs,
    /// Steps of all rays (P1).
    steps: Steps,
    /// Most steps of a ray.
    max_steps: MaxSteps,
    /// Passes in the first mode, which find a start level.
    start_passes: StartPasses,
    /// Levels between the root and where rays began, summed.
    levels_saved: LevelsSaved,
    /// Steps that crossed into a neighbour node.
    crossings: Crossings,
    /// Crossings that went up a level.
    level_ups: LevelUps,
    /// Steps that went down.
    level_downs: LevelDowns,
    /// Cycles of the job.
    cycles: Cycles,
    /// Cycles in which the view calculation's issue was taken.
    view_busy: ViewBusy,
    /// Cycles in which it had a ray and FIFO #0 no room.
    view_stalls: ViewStalls,
    /// Turns of a slot that did a step or a start pass.
    traverse_busy: TraverseBusy,
    /// Turns lost waiting for a line fill.
    traverse_waits: TraverseWaits,
    /// Turns in which a finished ray was held by a full FIFO #1.
    traverse_stalls: TraverseStalls,
    /// Turns of an empty slot.
    traverse_bubbles: TraverseBubbles,
    /// Cycles in which the address calculation's issue was taken.
    address_busy: AddressBusy,
    /// Cycles in which it had a ray and the read unit did not take what it had.
    address_stalls: AddressStalls,
    /// Cycles in which the read unit's port was used.
    read_busy: ReadBusy,
    /// Cycles in which it waited for a line fill.
    read_stalls: ReadStalls,
    /// Cycles in which the colour calculation's issue was taken.
    colour_busy: ColourBusy,
    /// First tries of the height cache, one a step.
    height_accesses: HeightAccesses,
    /// Of these, those that found their line.
    height_hits: HeightHits,
    /// Those that did not.
    height_misses: HeightMisses,
    /// Lines filled into the height cache.
    height_fills: HeightFills,
    /// Slots served by a fill on its way in (P17).
    height_forwards: HeightForwards,
    /// Accesses of the unified texture and normal cache.
    texture_accesses: TextureAccesses,
    /// Of these, those that found their line.
    texture_hits: TextureHits,
    /// Those that did not.
    texture_misses: TextureMisses,
    /// Lines filled into it.
    texture_fills: TextureFills,
    /// Bytes that came through the memory port.
    port_bytes: PortBytes,
    /// Cycles in which the memory port transferred.
    port_busy: PortBusy,
    /// Bytes of results.
    result_bytes: ResultBytes,
    /// Steps that crossed and went down at once (P22).
    folds: Folds,
}

impl Counters {
    pub(crate) fn read<B: Bus, D: DelayNs>(device: &mut Lucerna<B, D>) -> Result<Self, Error<B::Error>> {
        let snapshot = displace_counters::Control::RESET.with_snapshot(true);
        device.adjust(displace_counters::CONTROL, snapshot.bits())?;
        let mut values = Self::default();
        for counter in Counter::ALL {
            *values.field(counter) = device.read_pair(counter.low(), counter.high())?;
        }
        Ok(values)
    }

    pub(crate) fn clear<B: Bus, D: DelayNs>(device: &mut Lucerna<B, D>) -> Result<(), Error<B::Error>> {
        let clear = displace_counters::Control::RESET.with_clear(true);
        device.adjust(displace_counters::CONTROL, clear.bits())
    }
}

//! Block `displace_counters` at 0x400: Displacement counters. Generated from rdl/displace_counters.rdl by
//! `regenerate`; do not edit.
//!
//! Counts run on in the device; what is read here is the snapshot, taken of all of them in one cycle, so that
//! LO and HI of all counters belong together. Counts accumulate over jobs until cleared. Those of busy,
//! stalled and lost cycles or turns are summed over the instances of the unit; CYCLES is not. A device
//! without the unit refuses these offsets (unmapped).

pub use crate::register::Half;
use crate::register::{Field, Register};

/// Byte offset of CONTROL: Counter control. Write-only pulses; reads as 0. Both at once take the snapshot
/// first, and then clear: no count is lost.
///
/// Fields: [`Control`].
pub const CONTROL: u32 = 0x400;

/// Counter control (CONTROL). Write-only pulses; reads as 0. Both at once take the snapshot first, and then
/// clear: no count is lost.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Control(u32);

impl Control {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::SNAPSHOT, Self::CLEAR];
    /// Place of SNAPSHOT.
    pub const SNAPSHOT: Field = Field { name: "SNAPSHOT", shift: 0, width: 1 };
    /// Place of CLEAR.
    pub const CLEAR: Field = Field { name: "CLEAR", shift: 1, width: 1 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::SNAPSHOT.mask() | Self::CLEAR.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Snapshot, write-only pulse. Copies all running counts to the registers below.
    pub const fn snapshot(self) -> bool {
        Self::SNAPSHOT.get(self.0) != 0
    }

    /// The word with SNAPSHOT replaced.
    #[must_use]
    pub const fn with_snapshot(self, value: bool) -> Self {
        Self(Self::SNAPSHOT.put(self.0, value as u32))
    }

    /// Clear, write-only pulse. Sets all running counts to 0 and leaves the snapshot as it is.
    pub const fn clear(self) -> bool {
        Self::CLEAR.get(self.0) != 0
    }

    /// The word with CLEAR replaced.
    #[must_use]
    pub const fn with_clear(self, value: bool) -> Self {
        Self(Self::CLEAR.put(self.0, value as u32))
    }
}

impl Default for Control {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Control {
    const NAME: &'static str = "displace_counters.CONTROL";
    const OFFSET: u32 = CONTROL;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0x0;
    const WRITABLE: u32 = 0x3;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Control {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Control").field("snapshot", &self.snapshot()).field("clear", &self.clear()).finish()
    }
}

/// A counter, in the order of the map; its discriminant is its place there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Counter {
    /// Rays taken in, pixels of a raster beside the surface included.
    Rays = 0,
    /// Rays which hit a texel.
    Hits = 1,
    /// Pixels beside the surface, and rays which left a map without wrap.
    Missed = 2,
    /// Rays of a list which do not come down on the surface (P18), and rays which enter it 2^24 texels from
    /// the origin or further.
    Grazing = 3,
    /// Rays which the watchdog stopped (P11).
    Watchdogs = 4,
    /// Steps of all rays (P1): turns of the traversal loop, the leaf's included, the pass for the start level
    /// not.
    Steps = 5,
    /// Steps of the ray with the most. This is a maximum and not a sum.
    MaxSteps = 6,
    /// Passes in the first mode of the traverse unit, which find a start level (§4.2).
    StartPasses = 7,
    /// Levels between the root and where rays began, summed over rays (P7).
    LevelsSaved = 8,
    /// Steps which crossed into a neighbour node (P10).
    Crossings = 9,
    /// Crossings which went up a level (P3 to P5).
    LevelUps = 10,
    /// Steps which went down, by however many levels (P6).
    LevelDowns = 11,
    /// Cycles of running jobs, all instances together: the time a job took.
    Cycles = 12,
    /// Cycles in which the view calculation took a ray in or worked on it.
    ViewBusy = 13,
    /// Cycles in which the view calculation had a ray and FIFO #0 had no room.
    ViewStalls = 14,
    /// Turns of a slot of the traverse unit which did a start pass or a step.
    TraverseBusy = 15,
    /// Turns of a slot lost waiting for a fill of the height cache (P17).
    TraverseWaits = 16,
    /// Turns of a slot whose ray has ended: held by a full FIFO #1, or refused.
    TraverseStalls = 17,
    /// Turns of an empty slot.
    TraverseBubbles = 18,
    /// Cycles in which the address calculation took a ray in or worked on it.
    AddressBusy = 19,
    /// Cycles in which the address calculation had a ray and the read unit did not take it.
    AddressStalls = 20,
    /// Cycles in which the read unit used the texture cache, or a line on its way in.
    ReadBusy = 21,
    /// Cycles in which the read unit waited, for a fill of the texture cache or for the colour calculation.
    ReadStalls = 22,
    /// Cycles in which the colour calculation took a ray in or worked on it.
    ColourBusy = 23,
    /// First tries of the height cache, one a step but for nodes beyond the border; tries again after a miss
    /// are not counted.
    HeightAccesses = 24,
    /// First tries which found their line.
    HeightHits = 25,
    /// First tries which did not.
    HeightMisses = 26,
    /// Lines filled into the height cache; fewer than misses, where a miss finds its line on its way.
    HeightFills = 27,
    /// Slots served by a fill as it came in (P17).
    HeightForwards = 28,
    /// Accesses of the unified cache of texture and normals: two a hit.
    TextureAccesses = 29,
    /// Accesses which found their line.
    TextureHits = 30,
    /// Accesses which did not.
    TextureMisses = 31,
    /// Lines filled into the unified cache.
    TextureFills = 32,
    /// Bytes asked for at the memory port: line fills of both caches.
    PortBytes = 33,
    /// Cycles in which the memory port transfers them.
    PortBusy = 34,
    /// Bytes of result records written.
    ResultBytes = 35,
    /// Steps which crossed and went down at once (P22); 0 without SIBLINGS.
    Folds = 36,
}

impl Counter {
    /// How many there are.
    pub const COUNT: usize = 37;
    /// All, in the order of the map.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Rays,
        Self::Hits,
        Self::Missed,
        Self::Grazing,
        Self::Watchdogs,
        Self::Steps,
        Self::MaxSteps,
        Self::StartPasses,
        Self::LevelsSaved,
        Self::Crossings,
        Self::LevelUps,
        Self::LevelDowns,
        Self::Cycles,
        Self::ViewBusy,
        Self::ViewStalls,
        Self::TraverseBusy,
        Self::TraverseWaits,
        Self::TraverseStalls,
        Self::TraverseBubbles,
        Self::AddressBusy,
        Self::AddressStalls,
        Self::ReadBusy,
        Self::ReadStalls,
        Self::ColourBusy,
        Self::HeightAccesses,
        Self::HeightHits,
        Self::HeightMisses,
        Self::HeightFills,
        Self::HeightForwards,
        Self::TextureAccesses,
        Self::TextureHits,
        Self::TextureMisses,
        Self::TextureFills,
        Self::PortBytes,
        Self::PortBusy,
        Self::ResultBytes,
        Self::Folds,
    ];

    /// Place in the map, below [`Self::COUNT`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Name in small letters: `update_cycles`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rays => "rays",
            Self::Hits => "hits",
            Self::Missed => "missed",
            Self::Grazing => "grazing",
            Self::Watchdogs => "watchdogs",
            Self::Steps => "steps",
            Self::MaxSteps => "max_steps",
            Self::StartPasses => "start_passes",
            Self::LevelsSaved => "levels_saved",
            Self::Crossings => "crossings",
            Self::LevelUps => "level_ups",
            Self::LevelDowns => "level_downs",
            Self::Cycles => "cycles",
            Self::ViewBusy => "view_busy",
            Self::ViewStalls => "view_stalls",
            Self::TraverseBusy => "traverse_busy",
            Self::TraverseWaits => "traverse_waits",
            Self::TraverseStalls => "traverse_stalls",
            Self::TraverseBubbles => "traverse_bubbles",
            Self::AddressBusy => "address_busy",
            Self::AddressStalls => "address_stalls",
            Self::ReadBusy => "read_busy",
            Self::ReadStalls => "read_stalls",
            Self::ColourBusy => "colour_busy",
            Self::HeightAccesses => "height_accesses",
            Self::HeightHits => "height_hits",
            Self::HeightMisses => "height_misses",
            Self::HeightFills => "height_fills",
            Self::HeightForwards => "height_forwards",
            Self::TextureAccesses => "texture_accesses",
            Self::TextureHits => "texture_hits",
            Self::TextureMisses => "texture_misses",
            Self::TextureFills => "texture_fills",
            Self::PortBytes => "port_bytes",
            Self::PortBusy => "port_busy",
            Self::ResultBytes => "result_bytes",
            Self::Folds => "folds",
        }
    }

    /// Byte offset of the low half; the high half is the next register.
    pub const fn low(self) -> u32 {
        0x408 + 8 * self as u32
    }

    /// Byte offset of the high half.
    pub const fn high(self) -> u32 {
        self.low() + 4
    }

    /// Which half of which counter is at a byte offset.
    pub const fn at(offset: u32) -> Option<(Self, Half)> {
        let Some(from_first) = offset.checked_sub(0x408) else { return None };
        let index = (from_first / 8) as usize;
        if index >= Self::COUNT {
            return None;
        }
        match from_first % 8 {
            0 => Some((Self::ALL[index], Half::Low)),
            4 => Some((Self::ALL[index], Half::High)),
            _ => None,
        }
    }
}

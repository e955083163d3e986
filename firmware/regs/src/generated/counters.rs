//! Block `counters` at 0x200: Counters. Generated from rdl/counters.rdl by `regenerate`; do not edit.
//!
//! Counts run on in the device; what is read here is the snapshot, taken of all of them in one cycle, so that
//! LO and HI of all counters belong together. Counts accumulate over jobs until cleared.

pub use crate::register::Half;
use crate::register::{Field, Register};

/// Byte offset of CONTROL: Counter control. Write-only pulses; reads as 0. Both at once take the snapshot
/// first, and then clear: no count is lost.
///
/// Fields: [`Control`].
pub const CONTROL: u32 = 0x200;

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
    const NAME: &'static str = "counters.CONTROL";
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
    /// Photon records taken from the ring, those of empty cells included.
    Photons = 0,
    /// Photon records with an empty hit-point list, passed over at no cost (D9).
    EmptyCells = 1,
    /// Hit-point update operations issued: pairs of a photon and a hit point of its list.
    Operations = 2,
    /// Operations which changed their hit point, the photon being within its radius.
    Updates = 3,
    /// Cycles of update scheduling, from the first load to the last dispatch, stalls included; fill and drain
    /// come on top.
    UpdateCycles = 4,
    /// Hit points evaluated and added to their pixel.
    Evaluations = 5,
    /// Cycles of address generation, from the first to the last, stalls included; fill and drain come on top.
    EvaluateCycles = 6,
    /// Cycles of running jobs in both modes, fill, drain and stalls included; starved cycles are not.
    TotalCycles = 7,
    /// Cycles in which a hazard held back the issue (D7, D12); 0 if the policy is PUBLISHED.
    StallCycles = 8,
    /// Cycles in which the clock of the engine was gated, because it would load photons that were not there
    /// and FLUSH had not come. It alone depends on the pace of the host.
    StarvedCycles = 9,
    /// Cycles in which a full buffer dispatched fewer hit points than there are units (D1).
    PartialDispatches = 10,
    /// Operations which found their hit point in flight: issued fewer than ten cycles before, the same cycle
    /// included (D7). One that is held counts once.
    UpdateConflicts = 11,
    /// Updates computed from a hit point whose newer value was still in the datapath; 0 unless the policy is
    /// PUBLISHED (D7).
    StaleUpdates = 12,
    /// Evaluations which found their pixel in flight: issued fewer than twelve cycles before by any unit
    /// (D12). One that is held counts once.
    PixelConflicts = 13,
    /// Operands taken from the datapath instead of memory; 0 unless the policy is FORWARD (D7).
    Forwards = 14,
}

impl Counter {
    /// How many there are.
    pub const COUNT: usize = 15;
    /// All, in the order of the map.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Photons,
        Self::EmptyCells,
        Self::Operations,
        Self::Updates,
        Self::UpdateCycles,
        Self::Evaluations,
        Self::EvaluateCycles,
        Self::TotalCycles,
        Self::StallCycles,
        Self::StarvedCycles,
        Self::PartialDispatches,
        Self::UpdateConflicts,
        Self::StaleUpdates,
        Self::PixelConflicts,
        Self::Forwards,
    ];

    /// Place in the map, below [`Self::COUNT`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Name in small letters: `update_cycles`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Photons => "photons",
            Self::EmptyCells => "empty_cells",
            Self::Operations => "operations",
            Self::Updates => "updates",
            Self::UpdateCycles => "update_cycles",
            Self::Evaluations => "evaluations",
            Self::EvaluateCycles => "evaluate_cycles",
            Self::TotalCycles => "total_cycles",
            Self::StallCycles => "stall_cycles",
            Self::StarvedCycles => "starved_cycles",
            Self::PartialDispatches => "partial_dispatches",
            Self::UpdateConflicts => "update_conflicts",
            Self::StaleUpdates => "stale_updates",
            Self::PixelConflicts => "pixel_conflicts",
            Self::Forwards => "forwards",
        }
    }

    /// Byte offset of the low half; the high half is the next register.
    pub const fn low(self) -> u32 {
        0x208 + 8 * self as u32
    }

    /// Byte offset of the high half.
    pub const fn high(self) -> u32 {
        self.low() + 4
    }

    /// Which half of which counter is at a byte offset.
    pub const fn at(offset: u32) -> Option<(Self, Half)> {
        let Some(from_first) = offset.checked_sub(0x208) else { return None };
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

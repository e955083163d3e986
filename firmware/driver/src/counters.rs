//! What the progressive radiance estimation engine has counted. In: its snapshot. Out: a struct. Cost: a write and 30 reads.

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_regs::counters::{self, Counter};

use crate::{Error, Lucerna};

/// All counters at one moment, accumulated since they were last cleared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Counters {
    /// Photon records taken from the ring, those of empty cells included.
    pub photons: u64,
    /// Photon records with an empty list (D9).
    pub empty_cells: u64,
    /// Update operations issued: pairs of a photon and a hit point of its list.
    pub operations: u64,
    /// Operations which changed their hit point.
    pub updates: u64,
    /// Cycles of update scheduling, from the first load to the last dispatch, and every stall.
    pub update_cycles: u64,
    /// Hit points evaluated.
    pub evaluations: u64,
    /// Cycles of address generation for evaluation, from the first to the last, and every stall.
    pub evaluate_cycles: u64,
    /// Cycles of running jobs: fill, drain and stalls included, starved ones not.
    pub total_cycles: u64,
    /// Cycles in which a hazard held back the issue (D7, D12).
    pub stall_cycles: u64,
    /// Cycles in which the engine's clock was gated for want of photons; it alone depends on the host's pace.
    pub starved_cycles: u64,
    /// Cycles in which a full buffer dispatched fewer hit points than there are units (D1).
    pub partial_dispatches: u64,
    /// Operations whose hit point was in flight (D7).
    pub update_conflicts: u64,
    /// Updates computed from a value no longer the newest (D7).
    pub stale_updates: u64,
    /// Evaluations whose pixel was in flight (D12).
    pub pixel_conflicts: u64,
    /// Operands taken from the datapath (D7).
    pub forwards: u64,
}

impl Counters {
    pub(crate) fn read<B: Bus, D: DelayNs>(device: &mut Lucerna<B, D>) -> Result<Self, Error<B::Error>> {
        device.adjust(counters::CONTROL, counters::Control::RESET.with_snapshot(true).bits())?;
        let mut values = Self::default();
        for counter in Counter::ALL {
            *values.field(counter) = device.read_pair(counter.low(), counter.high())?;
        }
        Ok(values)
    }

    pub(crate) fn clear<B: Bus, D: DelayNs>(device: &mut Lucerna<B, D>) -> Result<(), Error<B::Error>> {
        device.adjust(counters::CONTROL, counters::Control::RESET.with_clear(true).bits())
    }

    /// The value of a counter by its register's name, for tables.
    pub fn get(&self, counter: Counter) -> u64 {
        let mut copy = *self;
        *copy.field(counter)
    }

    fn field(&mut self, counter: Counter) -> &mut u64 {
        match counter {
            Counter::Photons => &mut self.photons,
            Counter::EmptyCells => &mut self.empty_cells,
            Counter::Operations => &mut self.operations,
            Counter::Updates => &mut self.updates,
            Counter::UpdateCycles => &mut self.update_cycles,
            Counter::Evaluations => &mut self.evaluations,
            Counter::EvaluateCycles => &mut self.evaluate_cycles,
            Counter::TotalCycles => &mut self.total_cycles,
            Counter::StallCycles => &mut self.stall_cycles,
            Counter::StarvedCycles => &mut self.starved_cycles,
            Counter::PartialDispatches => &mut self.partial_dispatches,
            Counter::UpdateConflicts => &mut self.update_conflicts,
            Counter::StaleUpdates => &mut self.stale_updates,
            Counter::PixelConflicts => &mut self.pixel_conflicts,
            Counter::Forwards => &mut self.forwards,
        }
    }
}

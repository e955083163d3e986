//! What software has written; in: words, out: the same words; cost: one flip-flop a bit. Bits only: meaning is in [`job`](super::job).

use lucerna_pree::counters::Counters;
use lucerna_pree::job::{Fault, FaultCode, Table};
use lucerna_regs::counters::Counter;
use lucerna_regs::pree::ErrorCode;
use lucerna_regs::{interrupts, pree};

use crate::first_error::FirstError;

/// The register file.
#[derive(Clone, Debug)]
pub struct Registers {
    /// Mode and policies.
    pub config: pree::Config,
    /// α, in the device's format.
    pub alpha: u32,
    /// N_emitted, in the device's format.
    pub emitted: u32,
    /// Hit points.
    pub hits: Table,
    /// Index table.
    pub index: Table,
    /// Pixels.
    pub pixels: Table,
    /// Photon ring.
    pub ring: Table,
    /// Records put into the ring.
    pub tail: u32,
    /// The ring's low mark.
    pub low: u32,
    /// The first error since the last start or abort, and where it was.
    pub error: FirstError<ErrorCode>,
    /// The counters at the last snapshot.
    pub snapshot: Counters,
}

impl Default for Registers {
    fn default() -> Self {
        Self {
            config: pree::Config::RESET,
            alpha: 0,
            emitted: 0,
            hits: Table::default(),
            index: Table::default(),
            pixels: Table::default(),
            ring: Table::default(),
            tail: 0,
            low: 0,
            error: FirstError::NONE,
            snapshot: Counters::ZERO,
        }
    }
}

impl Registers {
    /// Keeps the first error, and raises the interrupt for every one.
    pub fn record(&mut self, fault: Fault) -> interrupts::Status {
        self.error.record(code(fault.code), fault.address);
        interrupts::Status::RESET.with_error(true)
    }

    /// A new beginning.
    pub fn clear_error(&mut self) {
        self.error = FirstError::NONE;
    }

    /// The plain 32-bit register at this offset.
    pub const fn plain(&self, offset: u32) -> Option<u32> {
        Some(match offset {
            pree::ALPHA => self.alpha,
            pree::EMITTED => self.emitted,
            pree::HIT_BASE => self.hits.base,
            pree::HIT_COUNT => self.hits.count,
            pree::INDEX_BASE => self.index.base,
            pree::INDEX_COUNT => self.index.count,
            pree::PIXEL_BASE => self.pixels.base,
            pree::PIXEL_COUNT => self.pixels.count,
            pree::RING_BASE => self.ring.base,
            pree::RING_ENTRIES => self.ring.count,
            pree::RING_LOW => self.low,
            _ => return None,
        })
    }

    /// The same, to be written: these read back what was written.
    pub const fn plain_mut(&mut self, offset: u32) -> Option<&mut u32> {
        Some(match offset {
            pree::ALPHA => &mut self.alpha,
            pree::EMITTED => &mut self.emitted,
            pree::HIT_BASE => &mut self.hits.base,
            pree::HIT_COUNT => &mut self.hits.count,
            pree::INDEX_BASE => &mut self.index.base,
            pree::INDEX_COUNT => &mut self.index.count,
            pree::PIXEL_BASE => &mut self.pixels.base,
            pree::PIXEL_COUNT => &mut self.pixels.count,
            pree::RING_BASE => &mut self.ring.base,
            pree::RING_ENTRIES => &mut self.ring.count,
            pree::RING_LOW => &mut self.low,
            _ => return None,
        })
    }

    /// One counter of the snapshot.
    pub const fn counter(&self, counter: Counter) -> u64 {
        let counters = &self.snapshot;
        match counter {
            Counter::Photons => counters.photons,
            Counter::EmptyCells => counters.empty_cells,
            Counter::Operations => counters.operations,
            Counter::Updates => counters.updates,
            Counter::UpdateCycles => counters.update_cycles,
            Counter::Evaluations => counters.evaluations,
            Counter::EvaluateCycles => counters.evaluate_cycles,
            Counter::TotalCycles => counters.total_cycles,
            Counter::StallCycles => counters.stall_cycles,
            Counter::StarvedCycles => counters.starved_cycles,
            Counter::PartialDispatches => counters.partial_dispatches,
            Counter::UpdateConflicts => counters.update_conflicts,
            Counter::StaleUpdates => counters.stale_updates,
            Counter::PixelConflicts => counters.pixel_conflicts,
            Counter::Forwards => counters.forwards,
        }
    }
}

/// The register's code of a fault.
const fn code(fault: FaultCode) -> ErrorCode {
    match fault {
        FaultCode::BadConfig => ErrorCode::BadConfig,
        FaultCode::BadRing => ErrorCode::BadRing,
        FaultCode::Window => ErrorCode::Window,
        FaultCode::RingOverrun => ErrorCode::RingOverrun,
        FaultCode::IndexRange => ErrorCode::IndexRange,
        FaultCode::HitRange => ErrorCode::HitRange,
        FaultCode::PixelRange => ErrorCode::PixelRange,
        FaultCode::NotIdle => ErrorCode::NotIdle,
        FaultCode::TooLarge => ErrorCode::TooLarge,
    }
}

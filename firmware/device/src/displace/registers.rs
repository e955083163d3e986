//! What software has written; in: words, out: the same words; cost: one flip-flop a bit. Bits only: meaning is in [`job`](super::job).

use lucerna_displace::counters::Counters;
use lucerna_displace::job::{Fault, FaultCode};
use lucerna_regs::displace::{self as regs, ErrorCode};
use lucerna_regs::displace_counters::Counter;
use lucerna_regs::interrupts;

use crate::first_error::FirstError;

/// The words from CONTROL up to the first that says what was synthesised.
const WORDS: usize = ((regs::PIPELINE - regs::CONTROL) / 4) as usize;

/// The register file.
#[derive(Clone, Debug)]
pub struct Registers {
    /// What can be written and read back, by place; the words of other registers stay 0.
    words: [u32; WORDS],
    /// The first error since the last start or abort, and where it was.
    pub error: FirstError<ErrorCode>,
    /// The counters at the last snapshot.
    pub snapshot: Counters,
}

impl Default for Registers {
    fn default() -> Self {
        let mut registers = Self { words: [0; WORDS], error: FirstError::NONE, snapshot: Counters::ZERO };
        for (offset, reset) in
            [(regs::CONFIG, regs::Config::RESET.bits()), (regs::WATCHDOG, regs::WATCHDOG_RESET)]
        {
            let _ = registers.write(offset, reset);
        }
        registers
    }
}

impl Registers {
    /// The register at an offset, if it reads back what is written.
    pub fn read(&self, offset: u32) -> Option<u32> {
        mask(offset)?;
        self.words.get(place(offset)).copied()
    }

    /// Takes a word, if the register at an offset reads back what is written.
    pub fn write(&mut self, offset: u32, value: u32) -> Option<()> {
        let mask = mask(offset)?;
        *self.words.get_mut(place(offset))? = value & mask;
        Some(())
    }

    /// A register of those that read back what is written; 0 for any other.
    pub fn word(&self, offset: u32) -> u32 {
        self.read(offset).unwrap_or(0)
    }

    /// Keeps the first error, and raises the interrupt for every one.
    pub fn record(&mut self, fault: Fault) -> interrupts::Status {
        self.error.record(code(fault.code), fault.address);
        interrupts::Status::RESET.with_displace_error(true)
    }

    /// A new beginning.
    pub fn clear_error(&mut self) {
        self.error = FirstError::NONE;
    }

    /// One counter of the snapshot.
    pub const fn counter(&self, counter: Counter) -> u64 {
        let counters = &self.snapshot;
        match counter {
            Counter::Rays => counters.rays,
            Counter::Hits => counters.hits,
            Counter::Missed => counters.missed,
            Counter::Grazing => counters.grazing,
            Counter::Watchdogs => counters.watchdogs,
            Counter::Steps => counters.steps,
            Counter::MaxSteps => counters.max_steps,
            Counter::StartPasses => counters.start_passes,
            Counter::LevelsSaved => counters.levels_saved,
            Counter::Crossings => counters.crossings,
            Counter::LevelUps => counters.level_ups,
            Counter::LevelDowns => counters.level_downs,
            Counter::Cycles => counters.cycles,
            Counter::ViewBusy => counters.view_busy,
            Counter::ViewStalls => counters.view_stalls,
            Counter::TraverseBusy => counters.traverse_busy,
            Counter::TraverseWaits => counters.traverse_waits,
            Counter::TraverseStalls => counters.traverse_stalls,
            Counter::TraverseBubbles => counters.traverse_bubbles,
            Counter::AddressBusy => counters.address_busy,
            Counter::AddressStalls => counters.address_stalls,
            Counter::ReadBusy => counters.read_busy,
            Counter::ReadStalls => counters.read_stalls,
            Counter::ColourBusy => counters.colour_busy,
            Counter::HeightAccesses => counters.height_accesses,
            Counter::HeightHits => counters.height_hits,
            Counter::HeightMisses => counters.height_misses,
            Counter::HeightFills => counters.height_fills,
            Counter::HeightForwards => counters.height_forwards,
            Counter::TextureAccesses => counters.texture_accesses,
            Counter::TextureHits => counters.texture_hits,
            Counter::TextureMisses => counters.texture_misses,
            Counter::TextureFills => counters.texture_fills,
            Counter::PortBytes => counters.port_bytes,
            Counter::PortBusy => counters.port_busy,
            Counter::ResultBytes => counters.result_bytes,
            Counter::Folds => counters.folds,
        }
    }
}

/// Place of a register in the file.
const fn place(offset: u32) -> usize {
    (offset.wrapping_sub(regs::CONTROL) / 4) as usize
}

/// The bits that a register keeps, if it reads back what is written.
const fn mask(offset: u32) -> Option<u32> {
    Some(match offset {
        regs::CONFIG => regs::Config::MASK,
        regs::MAP_SIZE => regs::MapSize::MASK,
        regs::TEXTURE_SIZE => regs::TextureSize::MASK,
        regs::NORMAL_SIZE => regs::NormalSize::MASK,
        regs::RASTER_SIZE => regs::RasterSize::MASK,
        regs::BACKGROUND => regs::Background::MASK,
        regs::WATCHDOG
        | regs::MAP_BASE
        | regs::TEXTURE_BASE
        | regs::NORMAL_BASE
        | regs::RAY_BASE
        | regs::RAY_COUNT
        | regs::RESULT_BASE => u32::MAX,
        // Numbers, one beside the other.
        regs::HEIGHT_SCALE..=regs::DIFFUSE if offset.is_multiple_of(4) => u32::MAX,
        _ => return None,
    })
}

/// The register's code of a fault.
const fn code(fault: FaultCode) -> ErrorCode {
    match fault {
        FaultCode::BadConfig => ErrorCode::BadConfig,
        FaultCode::Window => ErrorCode::Window,
        FaultCode::TooLarge => ErrorCode::TooLarge,
        FaultCode::BadMap => ErrorCode::BadMap,
        FaultCode::BadRaster => ErrorCode::BadRaster,
        FaultCode::GrazingRay => ErrorCode::GrazingRay,
        FaultCode::Watchdog => ErrorCode::Watchdog,
        FaultCode::Overlap => ErrorCode::Overlap,
        FaultCode::NotIdle => ErrorCode::NotIdle,
    }
}

//! What the units look like to the device; in: accesses and clocks, out: words, interrupts raised; cost: wires.

use lucerna_fabric::window::Windows;
use lucerna_regs::ident::{Capabilities, NumberFormat, Pipeline};
use lucerna_regs::interrupts::Status;
use lucerna_regs::window;
use lucerna_softfloat::FormatCode;

/// A unit with its registers, one box of the drawing. What it raises are bits of `interrupts.STATUS`.
pub trait Block {
    /// Adds what the identification registers say of it.
    fn identify(&self, identity: &mut Identity);

    /// Reads one of its registers; `None` when none of them is at this offset.
    fn read(&self, offset: u32) -> Option<u32>;

    /// Writes one of its registers, and gives what that raised; `None` when none of them is at this offset. The windows
    /// are those of now: a job that starts takes them along.
    fn write(&mut self, offset: u32, value: u32, windows: &Windows<{ window::COUNT }>) -> Option<Status>;

    /// Whether a job runs. If none does, a clock changes nothing.
    fn is_running(&self) -> bool;

    /// One clock.
    fn tick(&mut self, memory: &mut [u32]) -> Status;

    /// The state after `cycles` ticks, or fewer when a job ends before; says how many, and what they raised.
    fn advance(&mut self, memory: &mut [u32], cycles: u64) -> (u64, Status);
}

/// The identification registers while units add to them; zeros are a device of no unit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Identity {
    /// Units, their number and format.
    pub capabilities: Capabilities,
    /// Depths of the PREE.
    pub pipeline: Pipeline,
}

impl Identity {
    /// A device of no unit.
    pub const NOBODY: Self =
        Self { capabilities: Capabilities::from_bits(0), pipeline: Pipeline::from_bits(0) };

    /// Adds a unit's bit and its number format.
    pub const fn add(&mut self, unit: u32, format: FormatCode) {
        let format = match format {
            FormatCode::F32 => NumberFormat::F32,
            FormatCode::F24 => NumberFormat::F24,
            FormatCode::F64 => NumberFormat::F64,
        };
        let units = self.capabilities.units() | unit;
        self.capabilities = self.capabilities.with_units(units).with_format(format);
    }
}

/// Where a unit could be, and is not: none of its registers is mapped.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Absent;

impl Block for Absent {
    fn identify(&self, _: &mut Identity) {}

    fn read(&self, _: u32) -> Option<u32> {
        None
    }

    fn write(&mut self, _: u32, _: u32, _: &Windows<{ window::COUNT }>) -> Option<Status> {
        None
    }

    fn is_running(&self) -> bool {
        false
    }

    fn tick(&mut self, _: &mut [u32]) -> Status {
        Status::RESET
    }

    fn advance(&mut self, _: &mut [u32], cycles: u64) -> (u64, Status) {
        (cycles, Status::RESET)
    }
}

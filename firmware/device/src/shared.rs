//! Registers that are no unit's; in: words, events, out: the same words, the interrupt line; cost: one flip-flop a bit.

use lucerna_fabric::window::{Window, Windows};
use lucerna_regs::interrupts::{self, Enable, Status};
use lucerna_regs::window;

/// Interrupts and windows.
#[derive(Clone, Debug, Default)]
pub struct Shared {
    status: Status,
    enable: Enable,
    windows: [Window; window::COUNT],
}

impl Shared {
    /// The windows as the fabric checks them.
    pub const fn windows(&self, memory_bytes: u32) -> Windows<{ window::COUNT }> {
        Windows::new(self.windows, memory_bytes)
    }

    /// Something happened.
    pub const fn raise(&mut self, events: Status) {
        self.status = Status::from_bits(self.status.bits() | events.bits());
    }

    /// What happened since it was last cleared.
    pub const fn status(&self) -> Status {
        self.status
    }

    /// The interrupt line.
    pub const fn interrupt(&self) -> bool {
        self.status.bits() & self.enable.bits() != 0
    }

    /// The word at an offset, if one of these registers is there.
    pub fn read(&self, offset: u32) -> Option<u32> {
        Some(match offset {
            interrupts::STATUS => self.status().bits(),
            interrupts::ENABLE => self.enable.bits(),
            _ => {
                let (number, part) = window::at(offset)?;
                let window = self.windows.get(number)?;
                match part {
                    window::Part::Base => window.base,
                    window::Part::Limit => window.limit,
                }
            }
        })
    }

    /// Takes a word, if one of these registers is there.
    pub fn write(&mut self, offset: u32, value: u32) -> Option<()> {
        match offset {
            interrupts::STATUS => self.status = Status::from_bits(self.status.bits() & !value),
            interrupts::ENABLE => self.enable = Enable::from_bits(value & Enable::MASK),
            _ => {
                let (number, part) = window::at(offset)?;
                let window = self.windows.get_mut(number)?;
                match part {
                    window::Part::Base => window.base = value,
                    window::Part::Limit => window.limit = value,
                }
            }
        }
        Some(())
    }
}

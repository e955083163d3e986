//! Block `interrupts` at 0x040: Interrupts. Generated from rdl/interrupts.rdl by `regenerate`; do not edit.
//!
//! The device has one interrupt line, a level: high while any bit is set in both STATUS and ENABLE. Events
//! set their STATUS bit whether or not it is enabled, so STATUS can be polled as well.

use crate::register::{Field, Register};

/// Byte offset of STATUS: Interrupt status. Which events have happened since their bit was last cleared.
/// Writing 1 to a bit clears it, writing 0 leaves it; an event in the same cycle as the clearing write is not
/// lost.
///
/// Fields: [`Status`].
pub const STATUS: u32 = 0x040;
/// Byte offset of ENABLE: Interrupt enable. Which STATUS bits raise the interrupt line.
///
/// Fields: [`Enable`].
pub const ENABLE: u32 = 0x044;

/// Interrupt status (STATUS). Which events have happened since their bit was last cleared. Writing 1 to a bit
/// clears it, writing 0 leaves it; an event in the same cycle as the clearing write is not lost.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Status(u32);

impl Status {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] =
        &[Self::DONE, Self::ERROR, Self::RING_SPACE, Self::DISPLACE_DONE, Self::DISPLACE_ERROR];
    /// Place of DONE.
    pub const DONE: Field = Field { name: "DONE", shift: 0, width: 1 };
    /// Place of ERROR.
    pub const ERROR: Field = Field { name: "ERROR", shift: 1, width: 1 };
    /// Place of RING_SPACE.
    pub const RING_SPACE: Field = Field { name: "RING_SPACE", shift: 2, width: 1 };
    /// Place of DISPLACE_DONE.
    pub const DISPLACE_DONE: Field = Field { name: "DISPLACE_DONE", shift: 3, width: 1 };
    /// Place of DISPLACE_ERROR.
    pub const DISPLACE_ERROR: Field = Field { name: "DISPLACE_ERROR", shift: 4, width: 1 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::DONE.mask()
        | Self::ERROR.mask()
        | Self::RING_SPACE.mask()
        | Self::DISPLACE_DONE.mask()
        | Self::DISPLACE_ERROR.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Done, write 1 to clear. The job of the PREE is complete and all its results are in memory.
    pub const fn done(self) -> bool {
        Self::DONE.get(self.0) != 0
    }

    /// The word with DONE replaced.
    #[must_use]
    pub const fn with_done(self, value: bool) -> Self {
        Self(Self::DONE.put(self.0, value as u32))
    }

    /// Error, write 1 to clear. An error of the PREE was recorded: `pree.ERROR` says which, its FAULT_ADDRESS
    /// where.
    pub const fn error(self) -> bool {
        Self::ERROR.get(self.0) != 0
    }

    /// The word with ERROR replaced.
    #[must_use]
    pub const fn with_error(self, value: bool) -> Self {
        Self(Self::ERROR.put(self.0, value as u32))
    }

    /// Ring space, write 1 to clear. The number of photon records waiting in the ring fell to RING_LOW or
    /// below while the job was running.
    pub const fn ring_space(self) -> bool {
        Self::RING_SPACE.get(self.0) != 0
    }

    /// The word with RING_SPACE replaced.
    #[must_use]
    pub const fn with_ring_space(self, value: bool) -> Self {
        Self(Self::RING_SPACE.put(self.0, value as u32))
    }

    /// Displacement done, write 1 to clear. The job of the displacement unit is complete and all its results
    /// are in memory.
    pub const fn displace_done(self) -> bool {
        Self::DISPLACE_DONE.get(self.0) != 0
    }

    /// The word with DISPLACE_DONE replaced.
    #[must_use]
    pub const fn with_displace_done(self, value: bool) -> Self {
        Self(Self::DISPLACE_DONE.put(self.0, value as u32))
    }

    /// Displacement error, write 1 to clear. An error of the displacement unit was recorded: `displace.ERROR`
    /// says which, its FAULT_ADDRESS where.
    pub const fn displace_error(self) -> bool {
        Self::DISPLACE_ERROR.get(self.0) != 0
    }

    /// The word with DISPLACE_ERROR replaced.
    #[must_use]
    pub const fn with_displace_error(self, value: bool) -> Self {
        Self(Self::DISPLACE_ERROR.put(self.0, value as u32))
    }
}

impl Default for Status {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Status {
    const NAME: &'static str = "interrupts.STATUS";
    const OFFSET: u32 = STATUS;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0x1F;
    const WRITABLE: u32 = 0x1F;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Status {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Status")
            .field("done", &self.done())
            .field("error", &self.error())
            .field("ring_space", &self.ring_space())
            .field("displace_done", &self.displace_done())
            .field("displace_error", &self.displace_error())
            .finish()
    }
}

/// Interrupt enable (ENABLE). Which STATUS bits raise the interrupt line.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Enable(u32);

impl Enable {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] =
        &[Self::DONE, Self::ERROR, Self::RING_SPACE, Self::DISPLACE_DONE, Self::DISPLACE_ERROR];
    /// Place of DONE.
    pub const DONE: Field = Field { name: "DONE", shift: 0, width: 1 };
    /// Place of ERROR.
    pub const ERROR: Field = Field { name: "ERROR", shift: 1, width: 1 };
    /// Place of RING_SPACE.
    pub const RING_SPACE: Field = Field { name: "RING_SPACE", shift: 2, width: 1 };
    /// Place of DISPLACE_DONE.
    pub const DISPLACE_DONE: Field = Field { name: "DISPLACE_DONE", shift: 3, width: 1 };
    /// Place of DISPLACE_ERROR.
    pub const DISPLACE_ERROR: Field = Field { name: "DISPLACE_ERROR", shift: 4, width: 1 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::DONE.mask()
        | Self::ERROR.mask()
        | Self::RING_SPACE.mask()
        | Self::DISPLACE_DONE.mask()
        | Self::DISPLACE_ERROR.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Done, read-write. Lets STATUS.DONE raise the line.
    pub const fn done(self) -> bool {
        Self::DONE.get(self.0) != 0
    }

    /// The word with DONE replaced.
    #[must_use]
    pub const fn with_done(self, value: bool) -> Self {
        Self(Self::DONE.put(self.0, value as u32))
    }

    /// Error, read-write. Lets STATUS.ERROR raise the line.
    pub const fn error(self) -> bool {
        Self::ERROR.get(self.0) != 0
    }

    /// The word with ERROR replaced.
    #[must_use]
    pub const fn with_error(self, value: bool) -> Self {
        Self(Self::ERROR.put(self.0, value as u32))
    }

    /// Ring space, read-write. Lets STATUS.RING_SPACE raise the line.
    pub const fn ring_space(self) -> bool {
        Self::RING_SPACE.get(self.0) != 0
    }

    /// The word with RING_SPACE replaced.
    #[must_use]
    pub const fn with_ring_space(self, value: bool) -> Self {
        Self(Self::RING_SPACE.put(self.0, value as u32))
    }

    /// Displacement done, read-write. Lets STATUS.DISPLACE_DONE raise the line.
    pub const fn displace_done(self) -> bool {
        Self::DISPLACE_DONE.get(self.0) != 0
    }

    /// The word with DISPLACE_DONE replaced.
    #[must_use]
    pub const fn with_displace_done(self, value: bool) -> Self {
        Self(Self::DISPLACE_DONE.put(self.0, value as u32))
    }

    /// Displacement error, read-write. Lets STATUS.DISPLACE_ERROR raise the line.
    pub const fn displace_error(self) -> bool {
        Self::DISPLACE_ERROR.get(self.0) != 0
    }

    /// The word with DISPLACE_ERROR replaced.
    #[must_use]
    pub const fn with_displace_error(self, value: bool) -> Self {
        Self(Self::DISPLACE_ERROR.put(self.0, value as u32))
    }
}

impl Default for Enable {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Enable {
    const NAME: &'static str = "interrupts.ENABLE";
    const OFFSET: u32 = ENABLE;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0x1F;
    const WRITABLE: u32 = 0x1F;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Enable {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Enable")
            .field("done", &self.done())
            .field("error", &self.error())
            .field("ring_space", &self.ring_space())
            .field("displace_done", &self.displace_done())
            .field("displace_error", &self.displace_error())
            .finish()
    }
}

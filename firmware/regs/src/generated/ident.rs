//! Block `ident` at 0x000: Identification. Generated from rdl/ident.rdl by `regenerate`; do not edit.
//!
//! What the device is: read-only and constant for a build. A driver checks ID and VERSION before it touches
//! anything else, and takes every size from here rather than assuming it.

use crate::register::{Field, Illegal, Register};

/// Byte offset of ID: Identification number. Tells a Lucerna from an empty bus (all zeros or all ones) and
/// from another device.
///
/// Plain number, read-only; reset 0x4C55_4352.
pub const ID: u32 = 0x000;
/// Value of ID after reset.
pub const ID_RESET: u32 = 0x4C55_4352;
/// Byte offset of VERSION: Version of the register map. A driver accepts its own MAJOR with any MINOR not
/// older than the one it was written for.
///
/// Fields: [`Version`].
pub const VERSION: u32 = 0x004;
/// Byte offset of CAPABILITIES: Capabilities. Sizes and formats the device was built with.
///
/// Fields: [`Capabilities`].
pub const CAPABILITIES: u32 = 0x008;
/// Byte offset of PIPELINE: Pipeline depths. Latencies of the PREE in cycles, 0 without one, so that a driver
/// can bound its waits and a report can name fill and drain.
///
/// Fields: [`Pipeline`].
pub const PIPELINE: u32 = 0x00C;
/// Byte offset of MEMORY_BYTES: Size of device memory. Byte addresses of device memory run from 0 to one
/// below this. Set by the build.
///
/// Plain number, read-only; reset 0x0.
pub const MEMORY_BYTES: u32 = 0x010;

/// Number format: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum NumberFormat {
    /// 1 sign, 8 exponent, 23 fraction bits: IEEE 754 binary32, as in PREE Table I.
    F32 = 0,
    /// 1 sign, 7 exponent, 16 fraction bits, in the low 24 bits of a word.
    F24 = 1,
    /// A study format, which models on a host have and no hardware: numbers of registers and records are f32,
    /// those inside the datapath binary64.
    F64 = 2,
}

impl NumberFormat {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 3] = [Self::F32, Self::F24, Self::F64];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::F32),
            1 => Ok(Self::F24),
            2 => Ok(Self::F64),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F24 => "f24",
            Self::F64 => "f64",
        }
    }
}

impl TryFrom<u32> for NumberFormat {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Version of the register map (VERSION). A driver accepts its own MAJOR with any MINOR not older than the
/// one it was written for.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Version(u32);

impl Version {
    /// Value after reset.
    pub const RESET: Self = Self(0x1_0001);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::MINOR, Self::MAJOR];
    /// Place of MINOR.
    pub const MINOR: Field = Field { name: "MINOR", shift: 0, width: 16 };
    /// Place of MAJOR.
    pub const MAJOR: Field = Field { name: "MAJOR", shift: 16, width: 16 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::MINOR.mask() | Self::MAJOR.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Minor version, read-only. Changes when something is added which an older driver may ignore.
    pub const fn minor(self) -> u32 {
        Self::MINOR.get(self.0)
    }

    /// The word with MINOR replaced. Bits above the low 16 are dropped.
    #[must_use]
    pub const fn with_minor(self, value: u32) -> Self {
        Self(Self::MINOR.put(self.0, value))
    }

    /// Major version, read-only. Changes when a driver written for the older map would misbehave.
    pub const fn major(self) -> u32 {
        Self::MAJOR.get(self.0)
    }

    /// The word with MAJOR replaced. Bits above the low 16 are dropped.
    #[must_use]
    pub const fn with_major(self, value: u32) -> Self {
        Self(Self::MAJOR.put(self.0, value))
    }
}

impl Default for Version {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Version {
    const NAME: &'static str = "ident.VERSION";
    const OFFSET: u32 = VERSION;
    const RESET: u32 = 0x1_0001;
    const READABLE: u32 = 0xFFFF_FFFF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Version {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Version").field("minor", &self.minor()).field("major", &self.major()).finish()
    }
}

/// Capabilities (CAPABILITIES). Sizes and formats the device was built with.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Capabilities(u32);

impl Capabilities {
    /// Value after reset.
    pub const RESET: Self = Self(0x1_4000);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::PREUS, Self::FORMAT, Self::BUFFER_ENTRIES, Self::UNITS];
    /// Place of PREUS.
    pub const PREUS: Field = Field { name: "PREUS", shift: 0, width: 8 };
    /// Place of FORMAT.
    pub const FORMAT: Field = Field { name: "FORMAT", shift: 8, width: 4 };
    /// Place of BUFFER_ENTRIES.
    pub const BUFFER_ENTRIES: Field = Field { name: "BUFFER_ENTRIES", shift: 12, width: 4 };
    /// Place of UNITS.
    pub const UNITS: Field = Field { name: "UNITS", shift: 16, width: 8 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 =
        Self::PREUS.mask() | Self::FORMAT.mask() | Self::BUFFER_ENTRIES.mask() | Self::UNITS.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Radiance estimation units, read-only. N_set, how many hit points are worked on in one cycle: 4, 8 or
    /// 16 (PREE Table II); 0 without a PREE. Set by the build.
    pub const fn preus(self) -> u32 {
        Self::PREUS.get(self.0)
    }

    /// The word with PREUS replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_preus(self, value: u32) -> Self {
        Self(Self::PREUS.put(self.0, value))
    }

    /// Number format, read-only. Format of every number in registers and records, in the low bits of a word.
    /// Set by the build.
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn format(self) -> Result<NumberFormat, Illegal> {
        NumberFormat::from_bits(Self::FORMAT.get(self.0))
    }

    /// The word with FORMAT replaced.
    #[must_use]
    pub const fn with_format(self, value: NumberFormat) -> Self {
        Self(Self::FORMAT.put(self.0, value.bits()))
    }

    /// Entries of the photon buffer, read-only. Photons the update controller schedules at a time: 4, for any
    /// number of units (PREE §IV.B); 0 without a PREE.
    pub const fn buffer_entries(self) -> u32 {
        Self::BUFFER_ENTRIES.get(self.0)
    }

    /// The word with BUFFER_ENTRIES replaced. Bits above the low 4 are dropped.
    #[must_use]
    pub const fn with_buffer_entries(self, value: u32) -> Self {
        Self(Self::BUFFER_ENTRIES.put(self.0, value))
    }

    /// Units present, read-only. A bit for each fixed-function unit present: bit 0 of the field is the
    /// progressive radiance estimation engine (PREE), bit 1 the pyramidal displacement mapping unit. Other
    /// bits are 0. The registers of a unit which is not present are unmapped.
    pub const fn units(self) -> u32 {
        Self::UNITS.get(self.0)
    }

    /// The word with UNITS replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_units(self, value: u32) -> Self {
        Self(Self::UNITS.put(self.0, value))
    }
}

impl Default for Capabilities {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Capabilities {
    const NAME: &'static str = "ident.CAPABILITIES";
    const OFFSET: u32 = CAPABILITIES;
    const RESET: u32 = 0x1_4000;
    const READABLE: u32 = 0xFF_FFFF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Capabilities {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Capabilities")
            .field("preus", &self.preus())
            .field("format", &self.format())
            .field("buffer_entries", &self.buffer_entries())
            .field("units", &self.units())
            .finish()
    }
}

/// Pipeline depths (PIPELINE). Latencies of the PREE in cycles, 0 without one, so that a driver can bound its
/// waits and a report can name fill and drain.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Pipeline(u32);

impl Pipeline {
    /// Value after reset.
    pub const RESET: Self = Self(0xC0A);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::UPDATE_STAGES, Self::EVALUATE_STAGES, Self::OPERAND_LATENCY];
    /// Place of UPDATE_STAGES.
    pub const UPDATE_STAGES: Field = Field { name: "UPDATE_STAGES", shift: 0, width: 8 };
    /// Place of EVALUATE_STAGES.
    pub const EVALUATE_STAGES: Field = Field { name: "EVALUATE_STAGES", shift: 8, width: 8 };
    /// Place of OPERAND_LATENCY.
    pub const OPERAND_LATENCY: Field = Field { name: "OPERAND_LATENCY", shift: 16, width: 8 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 =
        Self::UPDATE_STAGES.mask() | Self::EVALUATE_STAGES.mask() | Self::OPERAND_LATENCY.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Update stages, read-only. Stages of the datapath in update: 10, the divider in stages 5 to 8 (PREE
    /// §IV.A, D13).
    pub const fn update_stages(self) -> u32 {
        Self::UPDATE_STAGES.get(self.0)
    }

    /// The word with UPDATE_STAGES replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_update_stages(self, value: u32) -> Self {
        Self(Self::UPDATE_STAGES.put(self.0, value))
    }

    /// Evaluation stages, read-only. Stages of the datapath in evaluation: 12 (PREE §IV.A, D13).
    pub const fn evaluate_stages(self) -> u32 {
        Self::EVALUATE_STAGES.get(self.0)
    }

    /// The word with EVALUATE_STAGES replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_evaluate_stages(self, value: u32) -> Self {
        Self(Self::EVALUATE_STAGES.put(self.0, value))
    }

    /// Operand latency, read-only. Cycles from the dispatch of an update operation to its issue: two memory
    /// reads, index table and hit point. An evaluation takes one read, half of it, and so does the first
    /// photon record of a job. Set by the build.
    pub const fn operand_latency(self) -> u32 {
        Self::OPERAND_LATENCY.get(self.0)
    }

    /// The word with OPERAND_LATENCY replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_operand_latency(self, value: u32) -> Self {
        Self(Self::OPERAND_LATENCY.put(self.0, value))
    }
}

impl Default for Pipeline {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Pipeline {
    const NAME: &'static str = "ident.PIPELINE";
    const OFFSET: u32 = PIPELINE;
    const RESET: u32 = 0xC0A;
    const READABLE: u32 = 0xFF_FFFF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Pipeline {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Pipeline")
            .field("update_stages", &self.update_stages())
            .field("evaluate_stages", &self.evaluate_stages())
            .field("operand_latency", &self.operand_latency())
            .finish()
    }
}

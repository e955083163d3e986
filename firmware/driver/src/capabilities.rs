//! What the device was built of. In: its identification registers. Out: sizes, never assumed. Cost: five reads,
//! once.

use lucerna_bus::Bus;
use lucerna_regs::{UNIT_PREE, ident};

use crate::{Cause, Error};

pub use lucerna_regs::ident::NumberFormat;

/// The register map this driver was written for: the same major version, and no older minor one.
pub const VERSION: (u32, u32) = (1, 0);

/// Sizes and formats of the device, as its registers tell them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Capabilities {
    /// Version of the register map: major, minor.
    pub version: (u32, u32),
    /// Units that work on hit points at the same time, N_set.
    pub preus: u32,
    /// Format of every number in registers and records.
    pub format: NumberFormat,
    /// Photons the update controller schedules at a time.
    pub buffer_entries: u32,
    /// Bit set of the fixed-function units present.
    pub units: u32,
    /// Stages of the datapath in update.
    pub update_stages: u32,
    /// Stages of the datapath in evaluation.
    pub evaluate_stages: u32,
    /// Cycles from a hit point's address to its operands.
    pub operand_latency: u32,
    /// Bytes of device memory, from address 0.
    pub memory_bytes: u32,
}

impl Capabilities {
    /// Whether the progressive radiance estimation engine is there.
    pub const fn has_pree(&self) -> bool {
        self.units & UNIT_PREE != 0
    }

    /// Asks the device; nothing is written.
    pub(crate) fn probe<B: Bus>(bus: &mut B) -> Result<Self, Error<B::Error>> {
        let mut read = |offset| bus.read(offset).map_err(|error| Error::untouched(Cause::Bus(error)));
        let id = read(ident::ID)?;
        if id != ident::ID_RESET {
            return Err(Error::untouched(Cause::WrongDevice { id }));
        }
        let version = ident::Version::from_bits(read(ident::VERSION)?);
        let (major, minor) = (version.major(), version.minor());
        if major != VERSION.0 || !(VERSION.1..).contains(&minor) {
            return Err(Error::untouched(Cause::WrongVersion { major, minor }));
        }
        let word = ident::Capabilities::from_bits(read(ident::CAPABILITIES)?);
        let nonsense = Error::untouched(Cause::Nonsense { offset: ident::CAPABILITIES, bits: word.bits() });
        let format = word.format().map_err(|_| nonsense)?;
        if word.preus() == 0 || word.buffer_entries() == 0 {
            return Err(nonsense);
        }
        let pipeline = ident::Pipeline::from_bits(read(ident::PIPELINE)?);
        Ok(Self {
            version: (major, minor),
            preus: word.preus(),
            format,
            buffer_entries: word.buffer_entries(),
            units: word.units(),
            update_stages: pipeline.update_stages(),
            evaluate_stages: pipeline.evaluate_stages(),
            operand_latency: pipeline.operand_latency(),
            memory_bytes: read(ident::MEMORY_BYTES)?,
        })
    }
}

//! What the device was built of. In: its identification registers. Out: sizes, never assumed. Cost: five reads,
//! once, and four more if the displacement unit is there.

use lucerna_bus::Bus;
use lucerna_regs::{displace, ident};

use crate::{Cause, Error, Unit};

pub use lucerna_regs::ident::NumberFormat;

/// The register map this driver was written for: the same major version, and no older minor one.
pub const VERSION: (u32, u32) = (1, 1);

/// Sizes and formats of the device, as its registers tell them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Capabilities {
    /// Version of the register map: major, minor.
    pub version: (u32, u32),
    /// Units that work on hit points at the same time, N_set; 0 without the PREE.
    pub preus: u32,
    /// Format of every number in registers and records.
    pub format: NumberFormat,
    /// Photons the update controller schedules at a time; 0 without the PREE.
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
    /// What the displacement unit was built of, if it is there.
    pub displace: Option<DisplaceCapabilities>,
}

/// Sizes of the displacement unit (P18), as its registers tell them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DisplaceCapabilities {
    /// Instances of the unit.
    pub units: u32,
    /// Stages of the traverse pipeline: as many rays are in flight in each instance.
    pub stages: u32,
    /// Cycles from the request of a cache line to its arrival, the memory port being free.
    pub fill_latency: u32,
    /// The height cache of each instance.
    pub height_cache: Cache,
    /// The cache of texture and normals of each instance.
    pub texture_cache: Cache,
    /// Rays FIFO #0 has room for: from view calculation to traversal.
    pub fifo0: u32,
    /// Rays FIFO #1 has room for: from traversal to shading.
    pub fifo1: u32,
    /// Bytes a cycle through the memory port, which all instances share.
    pub port_bytes: u32,
}

/// The size of a cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Cache {
    /// Bytes in all, a power of two.
    pub bytes: u32,
    /// Lines a set.
    pub ways: u32,
    /// Bytes a line.
    pub line_bytes: u32,
}

impl DisplaceCapabilities {
    fn probe<B: Bus>(bus: &mut B) -> Result<Self, Error<B::Error>> {
        let mut read = |offset| bus.read(offset).map_err(|error| Error::untouched(Cause::Bus(error)));
        let nonsense = |offset, bits| Error::untouched(Cause::Nonsense { offset, bits });
        let pipeline = displace::Pipeline::from_bits(read(displace::PIPELINE)?);
        if pipeline.units() == 0 {
            return Err(nonsense(displace::PIPELINE, pipeline.bits()));
        }
        let heights = displace::HeightCache::from_bits(read(displace::HEIGHT_CACHE)?);
        let texture = displace::TextureCache::from_bits(read(displace::TEXTURE_CACHE)?);
        let cache = |offset, bits, log2: u32, ways, line_bytes| match 1u32.checked_shl(log2) {
            Some(bytes) => Ok(Cache { bytes, ways, line_bytes }),
            None => Err(nonsense(offset, bits)),
        };
        let height_cache = cache(
            displace::HEIGHT_CACHE,
            heights.bits(),
            heights.log2_bytes(),
            heights.ways(),
            heights.line_bytes(),
        )?;
        let texture_cache = cache(
            displace::TEXTURE_CACHE,
            texture.bits(),
            texture.log2_bytes(),
            texture.ways(),
            texture.line_bytes(),
        )?;
        let fifos = displace::Fifos::from_bits(read(displace::FIFOS)?);
        Ok(Self {
            units: pipeline.units(),
            stages: pipeline.stages(),
            fill_latency: pipeline.fill_latency(),
            height_cache,
            texture_cache,
            fifo0: fifos.fifo0(),
            fifo1: fifos.fifo1(),
            port_bytes: fifos.port_bytes(),
        })
    }
}

impl Capabilities {
    /// Whether a unit is there.
    pub const fn has(&self, unit: Unit) -> bool {
        self.units & unit.bit() != 0
    }

    /// Whether the progressive radiance estimation engine is there.
    pub const fn has_pree(&self) -> bool {
        self.has(Unit::Pree)
    }

    /// The units which are there.
    pub(crate) fn present(self) -> impl Iterator<Item = Unit> {
        Unit::ALL.into_iter().filter(move |unit| self.has(*unit))
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
        let has = |unit: Unit| word.units() & unit.bit() != 0;
        if has(Unit::Pree) && (word.preus() == 0 || word.buffer_entries() == 0) {
            return Err(nonsense);
        }
        let pipeline = ident::Pipeline::from_bits(read(ident::PIPELINE)?);
        let memory_bytes = read(ident::MEMORY_BYTES)?;
        let displace = match has(Unit::Displace) {
            true => Some(DisplaceCapabilities::probe(bus)?),
            false => None,
        };
        Ok(Self {
            version: (major, minor),
            preus: word.preus(),
            format,
            buffer_entries: word.buffer_entries(),
            units: word.units(),
            update_stages: pipeline.update_stages(),
            evaluate_stages: pipeline.evaluate_stages(),
            operand_latency: pipeline.operand_latency(),
            memory_bytes,
            displace,
        })
    }
}

//! What is synthesised (P18); in: numbers, out: a unit that can be built, or what to change; cost: checked once.

use core::fmt;

use lucerna_fabric::cache::{Geometry, GeometryError, Tags};

use crate::job::MAP_ALIGNMENT;

/// Most instances.
pub const MAX_UNITS: u32 = 4;
/// The deepest FIFO there is room for.
pub const MAX_FIFO: usize = 64;

/// The memory port that all instances share.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PortSizes {
    /// Cycles from a request to its line, 1 to 65535.
    pub latency: u32,
    /// Bytes a cycle, 1 to 255; the paper's bus has 64 bits (§4.3).
    pub bytes_per_cycle: u32,
}

/// What is synthesised; the unpublished sizes of the paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sizes {
    /// Instances of the unit, 1 to 4.
    pub units: u32,
    /// The height cache of each.
    pub height_cache: Geometry,
    /// The texture and normal cache of each.
    pub texture_cache: Geometry,
    /// Entries of FIFO #0, 1 to 64.
    pub fifo0: u32,
    /// Entries of FIFO #1, 1 to 64.
    pub fifo1: u32,
    /// The port.
    pub port: PortSizes,
}

impl Default for Sizes {
    /// P18.
    fn default() -> Self {
        let cache = Geometry { bytes: 16384, ways: 4, line_bytes: 32 };
        Self {
            units: 1,
            height_cache: cache,
            texture_cache: cache,
            fifo0: 16,
            fifo1: 16,
            port: PortSizes { latency: 40, bytes_per_cycle: 8 },
        }
    }
}

/// Why a unit of some sizes cannot be built.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SizeError {
    /// Not 1 to 4 instances, or more than the type has.
    Units,
    /// Not 1 to 64 entries.
    Fifo,
    /// A latency or width of 0, or too large for the register that tells it.
    Port,
    /// Lines longer than maps are aligned to.
    LongLine,
    /// No such cache.
    Cache(GeometryError),
}

impl fmt::Display for SizeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Units => {
                f.write_str("there may be 1 to 4 instances of the unit, and no more than its type has")
            }
            Self::Fifo => f.write_str("a FIFO may have 1 to 64 entries"),
            Self::Port => {
                f.write_str("the port's latency must be 1 to 65535 cycles, its width 1 to 255 bytes")
            }
            Self::LongLine => f.write_str("a cache line may have at most 64 bytes"),
            Self::Cache(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for SizeError {}

/// The empty caches of an instance.
#[derive(Clone, Debug)]
pub struct Caches<const LINES: usize> {
    /// Heights.
    pub height: Tags<LINES>,
    /// Textures and normals.
    pub texture: Tags<LINES>,
}

impl Sizes {
    /// Checks everything against a type of up to `units` instances.
    ///
    /// # Errors
    /// A [`SizeError`].
    pub fn caches<const LINES: usize>(&self, units: usize) -> Result<Caches<LINES>, SizeError> {
        if !(1..=MAX_UNITS).contains(&self.units) || self.units as usize > units {
            return Err(SizeError::Units);
        }
        if [self.fifo0, self.fifo1].iter().any(|fifo| *fifo == 0 || *fifo as usize > MAX_FIFO) {
            return Err(SizeError::Fifo);
        }
        let PortSizes { latency, bytes_per_cycle } = self.port;
        if !(1..=0xFFFF).contains(&latency) || !(1..=0xFF).contains(&bytes_per_cycle) {
            return Err(SizeError::Port);
        }
        let tags = |geometry: Geometry| {
            if geometry.line_bytes > MAP_ALIGNMENT {
                return Err(SizeError::LongLine);
            }
            Tags::new(geometry).map_err(SizeError::Cache)
        };
        Ok(Caches { height: tags(self.height_cache)?, texture: tags(self.texture_cache)? })
    }
}

#[cfg(test)]
mod tests {
    use super::{SizeError, Sizes};
    use lucerna_fabric::cache::{Geometry, GeometryError};

    fn error(change: impl Fn(&mut Sizes)) -> Option<SizeError> {
        let mut sizes = Sizes::default();
        change(&mut sizes);
        sizes.caches::<512>(2).err()
    }

    #[test]
    fn only_what_can_be_built() {
        assert_eq!(error(|_| {}), None);
        assert_eq!(error(|sizes| sizes.units = 0), Some(SizeError::Units));
        assert_eq!(error(|sizes| sizes.units = 3), Some(SizeError::Units));
        assert_eq!(error(|sizes| sizes.fifo0 = 65), Some(SizeError::Fifo));
        assert_eq!(error(|sizes| sizes.fifo1 = 0), Some(SizeError::Fifo));
        assert_eq!(error(|sizes| sizes.port.latency = 0), Some(SizeError::Port));
        let long = Geometry { bytes: 16384, ways: 4, line_bytes: 128 };
        assert_eq!(error(|sizes| sizes.texture_cache = long), Some(SizeError::LongLine));
        let large = Geometry { bytes: 65536, ways: 4, line_bytes: 32 };
        assert_eq!(
            error(|sizes| sizes.height_cache = large),
            Some(SizeError::Cache(GeometryError::TooLarge))
        );
    }
}

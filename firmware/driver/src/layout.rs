//! Where a job's buffers lie in device memory. In: counts, and places if they matter. Out: a layout the device
//! accepts, or why there is none. Cost: a few comparisons; no access.
//!
//! Each of the four buffers gets a memory window of its own, exactly as large, so that a device gone wrong
//! cannot touch anything else.

use core::fmt;

use lucerna_regs::ident::NumberFormat;

use crate::Capabilities;
use crate::records::{HIT_POINT_WORDS, PHOTON_NORMAL_WORDS, PHOTON_WORDS, PIXEL_WORDS};

/// The most entries a ring may have.
pub const RING_ENTRIES_MAX: u32 = 1 << 16;

/// A buffer of a job, numbered as its memory window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Buffer {
    /// The hit points.
    HitPoints,
    /// The index table: hit-point numbers, list after list.
    Index,
    /// The pixels.
    Pixels,
    /// The photon ring.
    Ring,
}

impl Buffer {
    /// All of them, in the order of their windows.
    pub const ALL: [Self; 4] = [Self::HitPoints, Self::Index, Self::Pixels, Self::Ring];
}

/// How many elements each buffer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Sizes {
    /// Hit points.
    pub hit_points: u32,
    /// Entries of the index table.
    pub index_entries: u32,
    /// Pixels.
    pub pixels: u32,
    /// Photon records in the ring: a power of two, at most [`RING_ENTRIES_MAX`].
    pub ring_entries: u32,
    /// Whether photon records carry a normal (D8): 12 words instead of 8.
    pub normal_test: bool,
}

impl Sizes {
    /// Words of a photon record.
    pub const fn photon_words(&self) -> usize {
        if self.normal_test { PHOTON_NORMAL_WORDS } else { PHOTON_WORDS }
    }

    /// Bytes of device memory a packed layout takes; more than 32 bits hold if that is so.
    pub fn bytes(&self) -> u64 {
        Buffer::ALL.iter().map(|buffer| self.bytes_of(*buffer)).sum()
    }

    fn count(&self, buffer: Buffer) -> u32 {
        match buffer {
            Buffer::HitPoints => self.hit_points,
            Buffer::Index => self.index_entries,
            Buffer::Pixels => self.pixels,
            Buffer::Ring => self.ring_entries,
        }
    }

    fn bytes_of(&self, buffer: Buffer) -> u64 {
        let words = match buffer {
            Buffer::HitPoints => HIT_POINT_WORDS,
            Buffer::Index => 1,
            Buffer::Pixels => PIXEL_WORDS,
            Buffer::Ring => self.photon_words(),
        };
        // 2^32 elements of 16 words of 4 bytes stay far below 2^64.
        u64::from(self.count(buffer)) * words as u64 * 4
    }
}

/// Byte addresses of the four buffers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Bases {
    /// Of the hit points.
    pub hit_points: u32,
    /// Of the index table.
    pub index: u32,
    /// Of the pixels.
    pub pixels: u32,
    /// Of the ring.
    pub ring: u32,
}

/// A run of bytes in device memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Region {
    base: u32,
    limit: u32,
}

impl Region {
    /// No bytes.
    pub(crate) const EMPTY: Self = Self { base: 0, limit: 0 };

    /// From `base` up to, but without, `limit`.
    pub(crate) const fn new(base: u32, limit: u32) -> Self {
        Self { base, limit }
    }

    /// The least region that holds two.
    pub(crate) fn joined(&self, other: &Self) -> Self {
        Self { base: self.base.min(other.base), limit: self.limit.max(other.limit) }
    }

    /// Address of its first byte.
    pub const fn base(&self) -> u32 {
        self.base
    }

    /// Address after its last byte.
    pub const fn limit(&self) -> u32 {
        self.limit
    }

    /// Whether they share a byte; one without bytes shares none.
    pub(crate) const fn overlaps(&self, other: &Self) -> bool {
        let empty = self.base == self.limit || other.base == other.limit;
        !empty && self.base < other.limit && other.base < self.limit
    }
}

/// Four buffers, checked: none empty, aligned, inside device memory, apart, and the ring a power of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Layout {
    sizes: Sizes,
    format: NumberFormat,
    memory_bytes: u32,
    regions: [Region; 4],
}

impl Layout {
    /// Buffers one after the other from address 0.
    pub fn packed(device: &Capabilities, sizes: Sizes) -> Result<Self, LayoutError> {
        let mut end = 0;
        let mut next = |buffer| {
            let base = u32::try_from(end).map_err(|_| LayoutError::OutsideMemory(buffer));
            end += sizes.bytes_of(buffer);
            base
        };
        let bases = Bases {
            hit_points: next(Buffer::HitPoints)?,
            index: next(Buffer::Index)?,
            pixels: next(Buffer::Pixels)?,
            ring: next(Buffer::Ring)?,
        };
        Self::new(device, sizes, bases)
    }

    /// Buffers at chosen places.
    pub fn new(device: &Capabilities, sizes: Sizes, bases: Bases) -> Result<Self, LayoutError> {
        if !sizes.ring_entries.is_power_of_two() || sizes.ring_entries > RING_ENTRIES_MAX {
            return Err(LayoutError::RingEntries { entries: sizes.ring_entries });
        }
        let region = |buffer, base: u32| {
            if sizes.count(buffer) == 0 {
                return Err(LayoutError::Empty(buffer));
            }
            if !base.is_multiple_of(4) {
                return Err(LayoutError::Misaligned(buffer));
            }
            match u32::try_from(u64::from(base) + sizes.bytes_of(buffer)) {
                Ok(limit) if limit <= device.memory_bytes => Ok(Region::new(base, limit)),
                _ => Err(LayoutError::OutsideMemory(buffer)),
            }
        };
        let regions = [
            region(Buffer::HitPoints, bases.hit_points)?,
            region(Buffer::Index, bases.index)?,
            region(Buffer::Pixels, bases.pixels)?,
            region(Buffer::Ring, bases.ring)?,
        ];
        let numbered = || Buffer::ALL.iter().zip(&regions);
        for (number, (buffer, region)) in numbered().enumerate() {
            for (other, place) in numbered().skip(number + 1) {
                if region.overlaps(place) {
                    return Err(LayoutError::Overlap(*buffer, *other));
                }
            }
        }
        Ok(Self { sizes, format: device.format, memory_bytes: device.memory_bytes, regions })
    }

    /// The counts.
    pub const fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    /// The number format of the device it was made for.
    pub const fn format(&self) -> NumberFormat {
        self.format
    }

    /// Where a buffer lies.
    pub const fn region(&self, buffer: Buffer) -> Region {
        let [hit_points, index, pixels, ring] = self.regions;
        match buffer {
            Buffer::HitPoints => hit_points,
            Buffer::Index => index,
            Buffer::Pixels => pixels,
            Buffer::Ring => ring,
        }
    }

    /// Whether a device can hold it.
    pub(crate) fn fits(&self, device: &Capabilities) -> bool {
        self.format == device.format && self.memory_bytes <= device.memory_bytes
    }

    /// Address of `count` elements of a buffer from number `first` on, `words` words each, if it has them.
    pub(crate) fn span(&self, buffer: Buffer, first: u32, count: usize, words: usize) -> Option<u32> {
        let end = u32::try_from(count).ok()?.checked_add(first)?;
        (end <= self.sizes.count(buffer)).then(|| self.region(buffer).base + first * words as u32 * 4)
    }
}

/// Why buffers cannot be laid out so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LayoutError {
    /// A buffer without elements.
    Empty(Buffer),
    /// A base that is not a multiple of 4.
    Misaligned(Buffer),
    /// A buffer that ends beyond device memory.
    OutsideMemory(Buffer),
    /// Two buffers which share a byte.
    Overlap(Buffer, Buffer),
    /// A ring that is not a power of two from 1 to [`RING_ENTRIES_MAX`] records.
    RingEntries {
        /// What was asked for.
        entries: u32,
    },
}

impl fmt::Display for Buffer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::HitPoints => "hit-point buffer",
            Self::Index => "index table",
            Self::Pixels => "pixel buffer",
            Self::Ring => "photon ring",
        })
    }
}

impl fmt::Display for LayoutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty(buffer) => write!(f, "the {buffer} is empty: give it at least one element"),
            Self::Misaligned(buffer) => write!(f, "the {buffer} is misaligned: place it at a multiple of 4"),
            Self::OutsideMemory(buffer) => {
                write!(f, "the {buffer} ends beyond device memory: make the job smaller")
            }
            Self::Overlap(one, other) => write!(f, "the {one} and the {other} overlap: move them apart"),
            Self::RingEntries { entries } => {
                write!(f, "a ring of {entries} records: take a power of two up to {RING_ENTRIES_MAX}")
            }
        }
    }
}

impl core::error::Error for LayoutError {}

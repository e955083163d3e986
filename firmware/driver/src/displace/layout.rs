//! Where maps, rays and results lie in device memory. In: shapes and counts, and places if they matter. Out: a layout
//! the device accepts, or why there is none. Cost: a few comparisons; no access.
//!
//! There are five buffers and four memory windows: height map, rays and results each have a window of their own, exactly
//! as large; texture and normal map share one, so nothing else may lie between them.

use core::fmt;

use lucerna_regs::ident::NumberFormat;

use super::Shape;
use super::records::{RAY_WORDS, RESULT_WORDS};
use crate::Capabilities;
use crate::layout::Region;

/// Bytes to which buffers are aligned and maps rounded up: the longest cache line, so that no line fill leaves a map.
pub const ALIGNMENT: u32 = 64;

/// A buffer of a displacement job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Buffer {
    /// The pyramid of heights: a byte a texel, level 0 first.
    Map,
    /// The colours: a word a texel.
    Texture,
    /// The normals: a word a texel.
    Normals,
    /// The ray records: 8 words each.
    Rays,
    /// The result records: 8 words each.
    Results,
}

impl Buffer {
    /// All of them, in packed order.
    pub const ALL: [Self; 5] = [Self::Map, Self::Texture, Self::Normals, Self::Rays, Self::Results];
}

/// What each buffer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Sizes {
    /// Texels of the height map; its pyramid takes a third more.
    pub map: Shape,
    /// Texels of the texture.
    pub texture: Shape,
    /// Texels of the normal map.
    pub normals: Shape,
    /// Ray records; 0 if all jobs are of a camera.
    pub rays: u32,
    /// Result records: as many as the rays of a list, or the pixels of a camera.
    pub results: u32,
}

impl Sizes {
    /// Bytes of device memory a packed layout takes; more than 32 bits hold if that is so.
    pub fn bytes(&self) -> u64 {
        Buffer::ALL.iter().map(|buffer| self.bytes_of(*buffer)).sum()
    }

    /// Bytes of a buffer: of a map, rounded up to [`ALIGNMENT`], as the device wants all of them in a window.
    fn bytes_of(&self, buffer: Buffer) -> u64 {
        let bytes = match buffer {
            Buffer::Map => u64::from(self.map.pyramid_bytes()),
            Buffer::Texture => u64::from(self.texture.texels()) * 4,
            Buffer::Normals => u64::from(self.normals.texels()) * 4,
            Buffer::Rays => u64::from(self.rays) * RAY_WORDS as u64 * 4,
            Buffer::Results => u64::from(self.results) * RESULT_WORDS as u64 * 4,
        };
        bytes.next_multiple_of(u64::from(ALIGNMENT))
    }
}

/// Byte addresses of the five buffers, each a multiple of [`ALIGNMENT`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Bases {
    /// Of the pyramid of heights.
    pub map: u32,
    /// Of the colours.
    pub texture: u32,
    /// Of the normals.
    pub normals: u32,
    /// Of the ray records; means nothing without rays.
    pub rays: u32,
    /// Of the result records.
    pub results: u32,
}

/// Five buffers, checked: aligned, inside device memory, apart, and in four windows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Layout {
    sizes: Sizes,
    format: NumberFormat,
    memory_bytes: u32,
    regions: [Region; 5],
}

impl Layout {
    /// Buffers one after the other from address 0.
    pub fn packed(device: &Capabilities, sizes: Sizes) -> Result<Self, LayoutError> {
        Self::packed_at(device, sizes, 0)
    }

    /// Buffers one after the other from a base on, a multiple of [`ALIGNMENT`].
    pub fn packed_at(device: &Capabilities, sizes: Sizes, base: u32) -> Result<Self, LayoutError> {
        let mut end = u64::from(base);
        let mut next = |buffer| {
            let base = end;
            end += sizes.bytes_of(buffer);
            match u32::try_from(base) {
                Ok(base) if end <= u64::from(device.memory_bytes) => Ok(base),
                _ => Err(LayoutError::OutsideMemory(buffer)),
            }
        };
        let bases = Bases {
            map: next(Buffer::Map)?,
            texture: next(Buffer::Texture)?,
            normals: next(Buffer::Normals)?,
            rays: next(Buffer::Rays)?,
            results: next(Buffer::Results)?,
        };
        Self::new(device, sizes, bases)
    }

    /// Buffers at chosen places.
    pub fn new(device: &Capabilities, sizes: Sizes, bases: Bases) -> Result<Self, LayoutError> {
        if sizes.results == 0 {
            return Err(LayoutError::Empty);
        }
        let region = |buffer, base: u32| {
            let bytes = sizes.bytes_of(buffer);
            if bytes == 0 {
                return Ok(Region::EMPTY);
            }
            if !base.is_multiple_of(ALIGNMENT) {
                return Err(LayoutError::Misaligned(buffer));
            }
            match u32::try_from(u64::from(base) + bytes) {
                Ok(limit) if limit <= device.memory_bytes => Ok(Region::new(base, limit)),
                _ => Err(LayoutError::OutsideMemory(buffer)),
            }
        };
        let regions = [
            region(Buffer::Map, bases.map)?,
            region(Buffer::Texture, bases.texture)?,
            region(Buffer::Normals, bases.normals)?,
            region(Buffer::Rays, bases.rays)?,
            region(Buffer::Results, bases.results)?,
        ];
        let layout = Self { sizes, format: device.format, memory_bytes: device.memory_bytes, regions };
        layout.apart()?;
        Ok(layout)
    }

    /// Whether no two buffers share a byte, and none lies in the window of others.
    fn apart(&self) -> Result<(), LayoutError> {
        for (number, one) in Buffer::ALL.into_iter().enumerate() {
            for other in Buffer::ALL.into_iter().skip(number + 1) {
                if self.region(one).overlaps(&self.region(other)) {
                    return Err(LayoutError::Overlap(one, other));
                }
            }
        }
        let [_, shading, ..] = self.windows();
        let between = [Buffer::Map, Buffer::Rays, Buffer::Results]
            .into_iter()
            .find(|buffer| self.region(*buffer).overlaps(&shading));
        between.map_or(Ok(()), |buffer| Err(LayoutError::Between(buffer)))
    }

    /// The shapes and counts.
    pub const fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    /// The number format of the device it was made for.
    pub const fn format(&self) -> NumberFormat {
        self.format
    }

    /// Where a buffer lies; rays of which there are none, from 0 to 0.
    pub const fn region(&self, buffer: Buffer) -> Region {
        let [map, texture, normals, rays, results] = self.regions;
        match buffer {
            Buffer::Map => map,
            Buffer::Texture => texture,
            Buffer::Normals => normals,
            Buffer::Rays => rays,
            Buffer::Results => results,
        }
    }

    /// The memory windows: map, texture with normals, rays (closed if there are none), results.
    pub fn windows(&self) -> [Region; 4] {
        let [map, texture, normals, rays, results] = self.regions;
        [map, texture.joined(&normals), rays, results]
    }

    /// Whether a device can hold it.
    pub(crate) fn fits(&self, device: &Capabilities) -> bool {
        self.format == device.format && self.memory_bytes <= device.memory_bytes
    }

    /// Address of `count` ray or result records from number `first` on, if there are so many.
    pub(crate) fn span(&self, buffer: Buffer, first: u32, count: usize) -> Option<u32> {
        let (records, words) = match buffer {
            Buffer::Rays => (self.sizes.rays, RAY_WORDS),
            Buffer::Results => (self.sizes.results, RESULT_WORDS),
            Buffer::Map | Buffer::Texture | Buffer::Normals => return None,
        };
        let end = u32::try_from(count).ok()?.checked_add(first)?;
        (end <= records).then(|| self.region(buffer).base() + first * words as u32 * 4)
    }
}

/// Why buffers cannot be laid out so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LayoutError {
    /// No room for a result.
    Empty,
    /// A base that is not a multiple of [`ALIGNMENT`].
    Misaligned(Buffer),
    /// A buffer that ends beyond device memory.
    OutsideMemory(Buffer),
    /// Two buffers which share a byte.
    Overlap(Buffer, Buffer),
    /// A buffer between texture and normal map, in the window these two share.
    Between(Buffer),
}

impl fmt::Display for Buffer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Map => "height map",
            Self::Texture => "texture",
            Self::Normals => "normal map",
            Self::Rays => "ray buffer",
            Self::Results => "result buffer",
        })
    }
}

impl fmt::Display for LayoutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("there is no room for results: give every ray or pixel one"),
            Self::Misaligned(buffer) => {
                write!(f, "the {buffer} is misaligned: place it at a multiple of {ALIGNMENT}")
            }
            Self::OutsideMemory(buffer) => {
                write!(f, "the {buffer} ends beyond device memory: make the job smaller")
            }
            Self::Overlap(one, other) => write!(f, "the {one} and the {other} overlap: move them apart"),
            Self::Between(buffer) => write!(
                f,
                "the {buffer} lies between texture and normal map, which share a window: place it elsewhere"
            ),
        }
    }
}

impl core::error::Error for LayoutError {}

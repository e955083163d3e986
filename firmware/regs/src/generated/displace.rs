//! Block `displace` at 0x300: Pyramidal displacement mapping unit. Generated from rdl/displace.rdl by
//! `regenerate`; do not edit.
//!
//! Job registers: rays against a height map, each given the texel it hits and a colour. Everything but
//! CONTROL is latched at START, the windows too. A device without the unit refuses these offsets (unmapped).
//!
//! A texture coordinate runs from 0 to 1 over the map; a depth of the displacement runs from 0 at the top
//! plane to 1 at the bottom one, a height h of 0 to 255 being at depth (255 - h) / 255 (P14). Map, texture
//! and normal map each have their own size, in texels, a power of two from 1 to 4096 along either axis.
//! Texels are in Morton order: the bits that both coordinates have are interleaved, x lowest; the other bits
//! of the longer axis are above them. A map's base is a multiple of 64, and its size rounded up to 64 bytes
//! lies in one window, so that no fill of a cache line leaves it.

use crate::register::{Field, Illegal, Register};

/// Byte offset of CONTROL: Job control. Write-only pulses; reads as 0. With both at once, ABORT comes first.
///
/// Fields: [`Control`].
pub const CONTROL: u32 = 0x300;
/// Byte offset of CONFIG: Job configuration. Where rays come from, and how they go up and down the pyramid.
/// The reset value is the paper's hardware: a start level (a), two levels down (b), selective level-up (c1).
/// SIBLINGS, and a REACH of more than one, go beyond the paper. Bit 17 is reserved.
///
/// Fields: [`Config`].
pub const CONFIG: u32 = 0x304;
/// Byte offset of STATUS: Job status. Where the job is.
///
/// Fields: [`Status`].
pub const STATUS: u32 = 0x308;
/// Byte offset of ERROR: Error. The first error since START or ABORT; NOT_IDLE, which ends no job, gives way
/// to one that does.
///
/// Fields: [`Error`].
pub const ERROR: u32 = 0x30C;
/// Byte offset of FAULT_ADDRESS: Faulting address. The byte address which ERROR is about, where its
/// description names one; otherwise 0.
///
/// Plain number, read-only; reset 0x0.
pub const FAULT_ADDRESS: u32 = 0x310;
/// Byte offset of RAYS_DONE: Rays done. Result records written since START.
///
/// Plain number, read-only; reset 0x0.
pub const RAYS_DONE: u32 = 0x314;
/// Byte offset of WATCHDOG: Watchdog. Steps (P1) after which a ray is given up: 1 to 65535, otherwise START
/// ends in error BAD_CONFIG.
///
/// Plain number, read-write; reset 0x1000.
pub const WATCHDOG: u32 = 0x318;
/// Value of WATCHDOG after reset.
pub const WATCHDOG_RESET: u32 = 0x1000;
/// Byte offset of MAP_BASE: Height map base. Where the pyramid of heights is: bytes, four to a word from its
/// lowest on; level 0, the map itself, first, then each coarser level to a single texel. A texel of a level
/// is the largest of the up to four below it.
///
/// Plain number, read-write; reset 0x0.
pub const MAP_BASE: u32 = 0x31C;
/// Byte offset of MAP_SIZE: Height map size. Texels of level 0. More than 12 in a field: START ends in error
/// BAD_MAP.
///
/// Fields: [`MapSize`].
pub const MAP_SIZE: u32 = 0x320;
/// Byte offset of TEXTURE_BASE: Texture base. Where the colours are: one word a texel, 0x00RRGGBB.
///
/// Plain number, read-write; reset 0x0.
pub const TEXTURE_BASE: u32 = 0x324;
/// Byte offset of TEXTURE_SIZE: Texture size. Texels of the texture. More than 12 in a field: START ends in
/// error BAD_MAP.
///
/// Fields: [`TextureSize`].
pub const TEXTURE_SIZE: u32 = 0x328;
/// Byte offset of NORMAL_BASE: Normal map base. Where the normals are, in tangent space: one word a texel,
/// 0x00ZZYYXX, a byte c being (c - 128) / 127.
///
/// Plain number, read-write; reset 0x0.
pub const NORMAL_BASE: u32 = 0x32C;
/// Byte offset of NORMAL_SIZE: Normal map size. Texels of the normal map. More than 12 in a field: START ends
/// in error BAD_MAP.
///
/// Fields: [`NormalSize`].
pub const NORMAL_SIZE: u32 = 0x330;
/// Byte offset of RAY_BASE: Ray base. Where the ray records are; used if SOURCE is LIST. A record is 8 words:
/// u and v of the texture coordinate at the top plane, x, y and z of the view vector (world coordinates, away
/// from the eye, of any length), three reserved.
///
/// Plain number, read-write; reset 0x0.
pub const RAY_BASE: u32 = 0x334;
/// Byte offset of RAY_COUNT: Ray count. How many ray records there are; used if SOURCE is LIST.
///
/// Plain number, read-write; reset 0x0.
pub const RAY_COUNT: u32 = 0x338;
/// Byte offset of RASTER_SIZE: Raster size. Pixels of the camera; used if SOURCE is RASTER. A 0 in either
/// field: START ends in error BAD_RASTER.
///
/// Fields: [`RasterSize`].
pub const RASTER_SIZE: u32 = 0x33C;
/// Byte offset of RESULT_BASE: Result base. Where the results go, one record a ray at the place of its
/// number. A record is 8 words: texel x and y (signed: beyond the map they run on), ray parameter t (0 at the
/// top plane, 1 at the bottom one), steps in bits 15 to 0 with the start level in bits 23 to 16 and the
/// outcome in bits 31 to 24 (0 hit, 1 miss, 2 grazing, 3 watchdog), colour 0x00RRGGBB, u and v of the hit, 0.
///
/// Plain number, read-write; reset 0x0.
pub const RESULT_BASE: u32 = 0x340;
/// Byte offset of HEIGHT_SCALE: Height scale. Depth of the displacement in texture units: START multiplies
/// tangent and bitangent by it.
///
/// Plain number, read-write; reset 0x0.
pub const HEIGHT_SCALE: u32 = 0x344;
/// Byte offset of TANGENT_X: Tangent, x. Component x of the tangent in world coordinates: the first row of
/// the matrix to tangent space, along u.
///
/// Plain number, read-write; reset 0x0.
pub const TANGENT_X: u32 = 0x348;
/// Byte offset of TANGENT_Y: Tangent, y. Component y of the tangent in world coordinates: the first row of
/// the matrix to tangent space, along u.
///
/// Plain number, read-write; reset 0x0.
pub const TANGENT_Y: u32 = 0x34C;
/// Byte offset of TANGENT_Z: Tangent, z. Component z of the tangent in world coordinates: the first row of
/// the matrix to tangent space, along u.
///
/// Plain number, read-write; reset 0x0.
pub const TANGENT_Z: u32 = 0x350;
/// Byte offset of BITANGENT_X: Bitangent, x. Component x of the bitangent in world coordinates: the second
/// row, along v.
///
/// Plain number, read-write; reset 0x0.
pub const BITANGENT_X: u32 = 0x354;
/// Byte offset of BITANGENT_Y: Bitangent, y. Component y of the bitangent in world coordinates: the second
/// row, along v.
///
/// Plain number, read-write; reset 0x0.
pub const BITANGENT_Y: u32 = 0x358;
/// Byte offset of BITANGENT_Z: Bitangent, z. Component z of the bitangent in world coordinates: the second
/// row, along v.
///
/// Plain number, read-write; reset 0x0.
pub const BITANGENT_Z: u32 = 0x35C;
/// Byte offset of NORMAL_X: Normal, x. Component x of the normal of the plane in world coordinates: the third
/// row. Rays come down on the surface if they go against it.
///
/// Plain number, read-write; reset 0x0.
pub const NORMAL_X: u32 = 0x360;
/// Byte offset of NORMAL_Y: Normal, y. Component y of the normal of the plane in world coordinates: the third
/// row. Rays come down on the surface if they go against it.
///
/// Plain number, read-write; reset 0x0.
pub const NORMAL_Y: u32 = 0x364;
/// Byte offset of NORMAL_Z: Normal, z. Component z of the normal of the plane in world coordinates: the third
/// row. Rays come down on the surface if they go against it.
///
/// Plain number, read-write; reset 0x0.
pub const NORMAL_Z: u32 = 0x368;
/// Byte offset of EYE_U: Eye, u. Texture coordinate u under the eye of the raster.
///
/// Plain number, read-write; reset 0x0.
pub const EYE_U: u32 = 0x36C;
/// Byte offset of EYE_V: Eye, v. Texture coordinate v under the eye of the raster.
///
/// Plain number, read-write; reset 0x0.
pub const EYE_V: u32 = 0x370;
/// Byte offset of EYE_HEIGHT: Eye height. Height of the eye of the raster over the top plane, in units of the
/// depth of the displacement: texture units divided by HEIGHT_SCALE.
///
/// Plain number, read-write; reset 0x0.
pub const EYE_HEIGHT: u32 = 0x374;
/// Byte offset of EXTENT_U: Extent, u. The surface of a raster is u from 0 up to but without this, at the top
/// plane; pixels beside it are misses. 0: it has no end.
///
/// Plain number, read-write; reset 0x0.
pub const EXTENT_U: u32 = 0x378;
/// Byte offset of EXTENT_V: Extent, v. The same for v.
///
/// Plain number, read-write; reset 0x0.
pub const EXTENT_V: u32 = 0x37C;
/// Byte offset of ORIGIN_X: Origin of the raster, x. Component x of the view vector of the pixel in row 0,
/// column 0, in world coordinates. That of any pixel is (ORIGIN + row · DOWN) + column · RIGHT.
///
/// Plain number, read-write; reset 0x0.
pub const ORIGIN_X: u32 = 0x380;
/// Byte offset of ORIGIN_Y: Origin of the raster, y. Component y of the view vector of the pixel in row 0,
/// column 0, in world coordinates. That of any pixel is (ORIGIN + row · DOWN) + column · RIGHT.
///
/// Plain number, read-write; reset 0x0.
pub const ORIGIN_Y: u32 = 0x384;
/// Byte offset of ORIGIN_Z: Origin of the raster, z. Component z of the view vector of the pixel in row 0,
/// column 0, in world coordinates. That of any pixel is (ORIGIN + row · DOWN) + column · RIGHT.
///
/// Plain number, read-write; reset 0x0.
pub const ORIGIN_Z: u32 = 0x388;
/// Byte offset of RIGHT_X: Step to the right, x. Component x of what a pixel further to the right adds to the
/// view vector.
///
/// Plain number, read-write; reset 0x0.
pub const RIGHT_X: u32 = 0x38C;
/// Byte offset of RIGHT_Y: Step to the right, y. Component y of what a pixel further to the right adds to the
/// view vector.
///
/// Plain number, read-write; reset 0x0.
pub const RIGHT_Y: u32 = 0x390;
/// Byte offset of RIGHT_Z: Step to the right, z. Component z of what a pixel further to the right adds to the
/// view vector.
///
/// Plain number, read-write; reset 0x0.
pub const RIGHT_Z: u32 = 0x394;
/// Byte offset of DOWN_X: Step down, x. Component x of what a row further down adds to the view vector.
///
/// Plain number, read-write; reset 0x0.
pub const DOWN_X: u32 = 0x398;
/// Byte offset of DOWN_Y: Step down, y. Component y of what a row further down adds to the view vector.
///
/// Plain number, read-write; reset 0x0.
pub const DOWN_Y: u32 = 0x39C;
/// Byte offset of DOWN_Z: Step down, z. Component z of what a row further down adds to the view vector.
///
/// Plain number, read-write; reset 0x0.
pub const DOWN_Z: u32 = 0x3A0;
/// Byte offset of LIGHT_X: Light direction, x. Component x of the direction towards the light, in tangent
/// space, of length one.
///
/// Plain number, read-write; reset 0x0.
pub const LIGHT_X: u32 = 0x3A4;
/// Byte offset of LIGHT_Y: Light direction, y. Component y of the direction towards the light, in tangent
/// space, of length one.
///
/// Plain number, read-write; reset 0x0.
pub const LIGHT_Y: u32 = 0x3A8;
/// Byte offset of LIGHT_Z: Light direction, z. Component z of the direction towards the light, in tangent
/// space, of length one.
///
/// Plain number, read-write; reset 0x0.
pub const LIGHT_Z: u32 = 0x3AC;
/// Byte offset of AMBIENT: Ambient light. How much light there is everywhere: the factor of a texel's colour
/// which faces away from the light.
///
/// Plain number, read-write; reset 0x0.
pub const AMBIENT: u32 = 0x3B0;
/// Byte offset of DIFFUSE: Diffuse light. How much light comes from LIGHT: its factor is the cosine between
/// normal and light, or 0 if that is negative.
///
/// Plain number, read-write; reset 0x0.
pub const DIFFUSE: u32 = 0x3B4;
/// Byte offset of BACKGROUND: Background colour. Colour of results which are no hit, 0x00RRGGBB.
///
/// Fields: [`Background`].
pub const BACKGROUND: u32 = 0x3B8;
/// Byte offset of PIPELINE: Pipeline. Instances and latencies, so that a driver can bound its waits.
///
/// Fields: [`Pipeline`].
pub const PIPELINE: u32 = 0x3C0;
/// Byte offset of HEIGHT_CACHE: Height cache. The cache of each traverse unit (P18).
///
/// Fields: [`HeightCache`].
pub const HEIGHT_CACHE: u32 = 0x3C4;
/// Byte offset of TEXTURE_CACHE: Texture cache. The unified cache of texture and normals in each instance
/// (§4.1, P18).
///
/// Fields: [`TextureCache`].
pub const TEXTURE_CACHE: u32 = 0x3C8;
/// Byte offset of FIFOS: FIFOs and memory port. The buffers between the units of an instance, and the port
/// all instances share (P18).
///
/// Fields: [`Fifos`].
pub const FIFOS: u32 = 0x3CC;

/// Source: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Source {
    /// RAY_COUNT ray records from RAY_BASE on.
    List = 0,
    /// The pixels of a camera over the plane, RASTER_SIZE of them, row by row from the top.
    Raster = 1,
}

impl Source {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 2] = [Self::List, Self::Raster];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::List),
            1 => Ok(Self::Raster),
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
            Self::List => "list",
            Self::Raster => "raster",
        }
    }
}

impl TryFrom<u32> for Source {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Wrap: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Wrap {
    /// The map again, in both directions.
    Repeat = 0,
    /// Nothing: heights of 0, and a ray which ends there is a miss.
    Border = 1,
}

impl Wrap {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 2] = [Self::Repeat, Self::Border];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Repeat),
            1 => Ok(Self::Border),
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
            Self::Repeat => "repeat",
            Self::Border => "border",
        }
    }
}

impl TryFrom<u32> for Wrap {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Levels down: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum LevelsDown {
    /// A level at a time, as in reference \[10\] of the paper.
    One = 1,
    /// Two levels, the best of Table 3.
    Two = 2,
    /// Three levels.
    Three = 3,
    /// Four levels.
    Four = 4,
}

impl LevelsDown {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 4] = [Self::One, Self::Two, Self::Three, Self::Four];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            1 => Ok(Self::One),
            2 => Ok(Self::Two),
            3 => Ok(Self::Three),
            4 => Ok(Self::Four),
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
            Self::One => "one",
            Self::Two => "two",
            Self::Three => "three",
            Self::Four => "four",
        }
    }
}

impl TryFrom<u32> for LevelsDown {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Level-up: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Ascend {
    /// A crossing stays on its level, as in reference \[10\] of the paper.
    Never = 0,
    /// Up when the boundary crossed is the parent's too, as in reference \[12\] of the paper (P3).
    Parity = 1,
    /// Like PARITY, unless the ray surely pierces the neighbour node: algorithm (c1) of §3.3 (P4).
    Selective = 2,
    /// Up when the crossing before stayed on its level: algorithm (c2) of §3.3 (P5).
    Coherent = 3,
}

impl Ascend {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 4] = [Self::Never, Self::Parity, Self::Selective, Self::Coherent];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Never),
            1 => Ok(Self::Parity),
            2 => Ok(Self::Selective),
            3 => Ok(Self::Coherent),
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
            Self::Never => "never",
            Self::Parity => "parity",
            Self::Selective => "selective",
            Self::Coherent => "coherent",
        }
    }
}

impl TryFrom<u32> for Ascend {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Coherent level-up: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Coherent {
    /// A crossing which stays sets the flag, a level-up clears it, going down leaves it.
    Toggle = 0,
    /// The same, but going down clears the flag.
    Consecutive = 1,
    /// As TOGGLE, but going up also needs a parent's boundary (P3).
    Parity = 2,
}

impl Coherent {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 3] = [Self::Toggle, Self::Consecutive, Self::Parity];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Toggle),
            1 => Ok(Self::Consecutive),
            2 => Ok(Self::Parity),
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
            Self::Toggle => "toggle",
            Self::Consecutive => "consecutive",
            Self::Parity => "parity",
        }
    }
}

impl TryFrom<u32> for Coherent {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Ray faults: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum RayFaults {
    /// Its result record says so, it is counted, and the job goes on.
    Record = 0,
    /// The job ends in error GRAZING_RAY or WATCHDOG.
    Stop = 1,
}

impl RayFaults {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 2] = [Self::Record, Self::Stop];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Record),
            1 => Ok(Self::Stop),
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
            Self::Record => "record",
            Self::Stop => "stop",
        }
    }
}

impl TryFrom<u32> for RayFaults {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Reach: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Reach {
    /// The neighbour node, as in the paper (P4).
    One = 1,
    /// Two nodes further.
    Two = 2,
    /// Three nodes further.
    Three = 3,
}

impl Reach {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 3] = [Self::One, Self::Two, Self::Three];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            1 => Ok(Self::One),
            2 => Ok(Self::Two),
            3 => Ok(Self::Three),
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
            Self::One => "one",
            Self::Two => "two",
            Self::Three => "three",
        }
    }
}

impl TryFrom<u32> for Reach {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// State: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum State {
    /// No job; START is taken.
    Idle = 0,
    /// A job is being worked on.
    Running = 1,
    /// A job ended in the error of ERROR; START or ABORT leaves this state.
    Fault = 2,
}

impl State {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 3] = [Self::Idle, Self::Running, Self::Fault];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Idle),
            1 => Ok(Self::Running),
            2 => Ok(Self::Fault),
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
            Self::Idle => "idle",
            Self::Running => "running",
            Self::Fault => "fault",
        }
    }
}

impl TryFrom<u32> for State {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Error code: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum ErrorCode {
    /// No error since START.
    None = 0,
    /// CONFIG holds an illegal LEVELS_DOWN, ASCEND, COHERENT or REACH, or WATCHDOG is not from 1 to 65535.
    BadConfig = 1,
    /// A buffer is misaligned (maps: to 64 bytes, others: to 4) or not wholly in one window; FAULT_ADDRESS is
    /// its base.
    Window = 2,
    /// The byte size or the end of a buffer does not fit 32 bits; FAULT_ADDRESS is its base.
    TooLarge = 3,
    /// A map is larger than 4096 texels along an axis; FAULT_ADDRESS is its base.
    BadMap = 4,
    /// A raster has no pixel.
    BadRaster = 5,
    /// A listed ray does not come down on the surface (P18), or enters it 2^24 texels from the origin or
    /// further, and RAY_FAULTS is STOP; FAULT_ADDRESS is its result record.
    GrazingRay = 6,
    /// A ray took WATCHDOG steps (P11), and RAY_FAULTS is STOP; FAULT_ADDRESS is its result record.
    Watchdog = 7,
    /// The results would overwrite a map or the rays; FAULT_ADDRESS is RESULT_BASE.
    Overlap = 8,
    /// START while running; the running job goes on.
    NotIdle = 9,
}

impl ErrorCode {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 10] = [
        Self::None,
        Self::BadConfig,
        Self::Window,
        Self::TooLarge,
        Self::BadMap,
        Self::BadRaster,
        Self::GrazingRay,
        Self::Watchdog,
        Self::Overlap,
        Self::NotIdle,
    ];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::None),
            1 => Ok(Self::BadConfig),
            2 => Ok(Self::Window),
            3 => Ok(Self::TooLarge),
            4 => Ok(Self::BadMap),
            5 => Ok(Self::BadRaster),
            6 => Ok(Self::GrazingRay),
            7 => Ok(Self::Watchdog),
            8 => Ok(Self::Overlap),
            9 => Ok(Self::NotIdle),
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
            Self::None => "none",
            Self::BadConfig => "bad config",
            Self::Window => "window",
            Self::TooLarge => "too large",
            Self::BadMap => "bad map",
            Self::BadRaster => "bad raster",
            Self::GrazingRay => "grazing ray",
            Self::Watchdog => "watchdog",
            Self::Overlap => "overlap",
            Self::NotIdle => "not idle",
        }
    }
}

impl TryFrom<u32> for ErrorCode {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Job control (CONTROL). Write-only pulses; reads as 0. With both at once, ABORT comes first.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Control(u32);

impl Control {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::START, Self::ABORT];
    /// Place of START.
    pub const START: Field = Field { name: "START", shift: 0, width: 1 };
    /// Place of ABORT.
    pub const ABORT: Field = Field { name: "ABORT", shift: 1, width: 1 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::START.mask() | Self::ABORT.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Start, write-only pulse. Latches the registers, clears ERROR and FAULT_ADDRESS, sets RAYS_DONE to 0,
    /// checks every buffer, and runs; the interrupt status is left alone. While RUNNING, refused with error
    /// NOT_IDLE. A list of no ray is done in the next cycle.
    pub const fn start(self) -> bool {
        Self::START.get(self.0) != 0
    }

    /// The word with START replaced.
    #[must_use]
    pub const fn with_start(self, value: bool) -> Self {
        Self(Self::START.put(self.0, value as u32))
    }

    /// Abort, write-only pulse. To IDLE at once; rays in flight are dropped, ERROR and FAULT_ADDRESS are
    /// cleared, the interrupt status is not. Results already written stay.
    pub const fn abort(self) -> bool {
        Self::ABORT.get(self.0) != 0
    }

    /// The word with ABORT replaced.
    #[must_use]
    pub const fn with_abort(self, value: bool) -> Self {
        Self(Self::ABORT.put(self.0, value as u32))
    }
}

impl Default for Control {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Control {
    const NAME: &'static str = "displace.CONTROL";
    const OFFSET: u32 = CONTROL;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0x0;
    const WRITABLE: u32 = 0x3;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Control {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Control").field("start", &self.start()).field("abort", &self.abort()).finish()
    }
}

/// Job configuration (CONFIG). Where rays come from, and how they go up and down the pyramid. The reset value
/// is the paper's hardware: a start level (a), two levels down (b), selective level-up (c1). SIBLINGS, and a
/// REACH of more than one, go beyond the paper. Bit 17 is reserved.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Config(u32);

impl Config {
    /// Value after reset.
    pub const RESET: Self = Self(0x8244);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[
        Self::SOURCE,
        Self::WRAP,
        Self::START_LEVEL,
        Self::START_GRID,
        Self::LEVELS_DOWN,
        Self::ASCEND,
        Self::COHERENT,
        Self::RAY_FAULTS,
        Self::SIBLINGS,
        Self::REACH,
    ];
    /// Place of SOURCE.
    pub const SOURCE: Field = Field { name: "SOURCE", shift: 0, width: 1 };
    /// Place of WRAP.
    pub const WRAP: Field = Field { name: "WRAP", shift: 1, width: 1 };
    /// Place of START_LEVEL.
    pub const START_LEVEL: Field = Field { name: "START_LEVEL", shift: 2, width: 1 };
    /// Place of START_GRID.
    pub const START_GRID: Field = Field { name: "START_GRID", shift: 3, width: 2 };
    /// Place of LEVELS_DOWN.
    pub const LEVELS_DOWN: Field = Field { name: "LEVELS_DOWN", shift: 5, width: 3 };
    /// Place of ASCEND.
    pub const ASCEND: Field = Field { name: "ASCEND", shift: 8, width: 3 };
    /// Place of COHERENT.
    pub const COHERENT: Field = Field { name: "COHERENT", shift: 11, width: 2 };
    /// Place of RAY_FAULTS.
    pub const RAY_FAULTS: Field = Field { name: "RAY_FAULTS", shift: 13, width: 1 };
    /// Place of SIBLINGS.
    pub const SIBLINGS: Field = Field { name: "SIBLINGS", shift: 14, width: 1 };
    /// Place of REACH.
    pub const REACH: Field = Field { name: "REACH", shift: 15, width: 2 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::SOURCE.mask()
        | Self::WRAP.mask()
        | Self::START_LEVEL.mask()
        | Self::START_GRID.mask()
        | Self::LEVELS_DOWN.mask()
        | Self::ASCEND.mask()
        | Self::COHERENT.mask()
        | Self::RAY_FAULTS.mask()
        | Self::SIBLINGS.mask()
        | Self::REACH.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Source, read-write. Where the rays come from.
    pub const fn source(self) -> Source {
        match Self::SOURCE.get(self.0) {
            0 => Source::List,
            _ => Source::Raster,
        }
    }

    /// The word with SOURCE replaced.
    #[must_use]
    pub const fn with_source(self, value: Source) -> Self {
        Self(Self::SOURCE.put(self.0, value.bits()))
    }

    /// Wrap, read-write. What lies beyond the map's edges; texture and normal map always repeat.
    pub const fn wrap(self) -> Wrap {
        match Self::WRAP.get(self.0) {
            0 => Wrap::Repeat,
            _ => Wrap::Border,
        }
    }

    /// The word with WRAP replaced.
    #[must_use]
    pub const fn with_wrap(self, value: Wrap) -> Self {
        Self(Self::WRAP.put(self.0, value.bits()))
    }

    /// Start level, read-write. Rays begin at the start level of §3.1 (P7), which costs them one pass, and
    /// not at the root.
    pub const fn start_level(self) -> bool {
        Self::START_LEVEL.get(self.0) != 0
    }

    /// The word with START_LEVEL replaced.
    #[must_use]
    pub const fn with_start_level(self, value: bool) -> Self {
        Self(Self::START_LEVEL.put(self.0, value as u32))
    }

    /// Start level grid, read-write. The start level is found on a grid 2^n times finer than the map (P19); 0
    /// is the map's own.
    pub const fn start_grid(self) -> u32 {
        Self::START_GRID.get(self.0)
    }

    /// The word with START_GRID replaced. Bits above the low 2 are dropped.
    #[must_use]
    pub const fn with_start_grid(self, value: u32) -> Self {
        Self(Self::START_GRID.put(self.0, value))
    }

    /// Levels down, read-write. Levels gone down at once before the first node crossing of a ray: n of §3.2
    /// (P6).
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn levels_down(self) -> Result<LevelsDown, Illegal> {
        LevelsDown::from_bits(Self::LEVELS_DOWN.get(self.0))
    }

    /// The word with LEVELS_DOWN replaced.
    #[must_use]
    pub const fn with_levels_down(self, value: LevelsDown) -> Self {
        Self(Self::LEVELS_DOWN.put(self.0, value.bits()))
    }

    /// Level-up, read-write. When a node crossing goes up a level (§3.3).
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn ascend(self) -> Result<Ascend, Illegal> {
        Ascend::from_bits(Self::ASCEND.get(self.0))
    }

    /// The word with ASCEND replaced.
    #[must_use]
    pub const fn with_ascend(self, value: Ascend) -> Self {
        Self(Self::ASCEND.put(self.0, value.bits()))
    }

    /// Coherent level-up, read-write. Which reading of (c2) is meant (P5); has no effect unless ASCEND is
    /// COHERENT.
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn coherent(self) -> Result<Coherent, Illegal> {
        Coherent::from_bits(Self::COHERENT.get(self.0))
    }

    /// The word with COHERENT replaced.
    #[must_use]
    pub const fn with_coherent(self, value: Coherent) -> Self {
        Self(Self::COHERENT.put(self.0, value.bits()))
    }

    /// Ray faults, read-write. What becomes of a ray which cannot be traversed to its end.
    pub const fn ray_faults(self) -> RayFaults {
        match Self::RAY_FAULTS.get(self.0) {
            0 => RayFaults::Record,
            _ => RayFaults::Stop,
        }
    }

    /// The word with RAY_FAULTS replaced.
    #[must_use]
    pub const fn with_ray_faults(self, value: RayFaults) -> Self {
        Self(Self::RAY_FAULTS.put(self.0, value.bits()))
    }

    /// Siblings, read-write. A crossing into a node whose height is in the word which the height cache
    /// delivered goes down in the same step, if the ray is below that node's top (P22). Not in the paper.
    pub const fn siblings(self) -> bool {
        Self::SIBLINGS.get(self.0) != 0
    }

    /// The word with SIBLINGS replaced.
    #[must_use]
    pub const fn with_siblings(self, value: bool) -> Self {
        Self(Self::SIBLINGS.put(self.0, value as u32))
    }

    /// Reach, read-write. The most nodes further at which a ray may come down for (c1) to stay on its level
    /// (P23); has no effect unless ASCEND is SELECTIVE.
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn reach(self) -> Result<Reach, Illegal> {
        Reach::from_bits(Self::REACH.get(self.0))
    }

    /// The word with REACH replaced.
    #[must_use]
    pub const fn with_reach(self, value: Reach) -> Self {
        Self(Self::REACH.put(self.0, value.bits()))
    }
}

impl Default for Config {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Config {
    const NAME: &'static str = "displace.CONFIG";
    const OFFSET: u32 = CONFIG;
    const RESET: u32 = 0x8244;
    const READABLE: u32 = 0x1_FFFF;
    const WRITABLE: u32 = 0x1_FFFF;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Config {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Config")
            .field("source", &self.source())
            .field("wrap", &self.wrap())
            .field("start_level", &self.start_level())
            .field("start_grid", &self.start_grid())
            .field("levels_down", &self.levels_down())
            .field("ascend", &self.ascend())
            .field("coherent", &self.coherent())
            .field("ray_faults", &self.ray_faults())
            .field("siblings", &self.siblings())
            .field("reach", &self.reach())
            .finish()
    }
}

/// Job status (STATUS). Where the job is.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Status(u32);

impl Status {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::STATE];
    /// Place of STATE.
    pub const STATE: Field = Field { name: "STATE", shift: 0, width: 2 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::STATE.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// State, read-only. State of the unit.
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn state(self) -> Result<State, Illegal> {
        State::from_bits(Self::STATE.get(self.0))
    }

    /// The word with STATE replaced.
    #[must_use]
    pub const fn with_state(self, value: State) -> Self {
        Self(Self::STATE.put(self.0, value.bits()))
    }
}

impl Default for Status {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Status {
    const NAME: &'static str = "displace.STATUS";
    const OFFSET: u32 = STATUS;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0x3;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Status {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Status").field("state", &self.state()).finish()
    }
}

/// Error (ERROR). The first error since START or ABORT; NOT_IDLE, which ends no job, gives way to one that
/// does.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Error(u32);

impl Error {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::CODE];
    /// Place of CODE.
    pub const CODE: Field = Field { name: "CODE", shift: 0, width: 8 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::CODE.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Error code, read-only. What went wrong.
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn code(self) -> Result<ErrorCode, Illegal> {
        ErrorCode::from_bits(Self::CODE.get(self.0))
    }

    /// The word with CODE replaced.
    #[must_use]
    pub const fn with_code(self, value: ErrorCode) -> Self {
        Self(Self::CODE.put(self.0, value.bits()))
    }
}

impl Default for Error {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Error {
    const NAME: &'static str = "displace.ERROR";
    const OFFSET: u32 = ERROR;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xFF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Error {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Error").field("code", &self.code()).finish()
    }
}

/// Height map size (MAP_SIZE). Texels of level 0. More than 12 in a field: START ends in error BAD_MAP.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct MapSize(u32);

impl MapSize {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::LOG2_WIDTH, Self::LOG2_HEIGHT];
    /// Place of LOG2_WIDTH.
    pub const LOG2_WIDTH: Field = Field { name: "LOG2_WIDTH", shift: 0, width: 4 };
    /// Place of LOG2_HEIGHT.
    pub const LOG2_HEIGHT: Field = Field { name: "LOG2_HEIGHT", shift: 8, width: 4 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::LOG2_WIDTH.mask() | Self::LOG2_HEIGHT.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Width, read-write. Binary logarithm of the texels along u: 0 to 12.
    pub const fn log2_width(self) -> u32 {
        Self::LOG2_WIDTH.get(self.0)
    }

    /// The word with LOG2_WIDTH replaced. Bits above the low 4 are dropped.
    #[must_use]
    pub const fn with_log2_width(self, value: u32) -> Self {
        Self(Self::LOG2_WIDTH.put(self.0, value))
    }

    /// Height, read-write. Binary logarithm of the texels along v: 0 to 12.
    pub const fn log2_height(self) -> u32 {
        Self::LOG2_HEIGHT.get(self.0)
    }

    /// The word with LOG2_HEIGHT replaced. Bits above the low 4 are dropped.
    #[must_use]
    pub const fn with_log2_height(self, value: u32) -> Self {
        Self(Self::LOG2_HEIGHT.put(self.0, value))
    }
}

impl Default for MapSize {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for MapSize {
    const NAME: &'static str = "displace.MAP_SIZE";
    const OFFSET: u32 = MAP_SIZE;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xF0F;
    const WRITABLE: u32 = 0xF0F;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for MapSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("MapSize")
            .field("log2_width", &self.log2_width())
            .field("log2_height", &self.log2_height())
            .finish()
    }
}

/// Texture size (TEXTURE_SIZE). Texels of the texture. More than 12 in a field: START ends in error BAD_MAP.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct TextureSize(u32);

impl TextureSize {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::LOG2_WIDTH, Self::LOG2_HEIGHT];
    /// Place of LOG2_WIDTH.
    pub const LOG2_WIDTH: Field = Field { name: "LOG2_WIDTH", shift: 0, width: 4 };
    /// Place of LOG2_HEIGHT.
    pub const LOG2_HEIGHT: Field = Field { name: "LOG2_HEIGHT", shift: 8, width: 4 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::LOG2_WIDTH.mask() | Self::LOG2_HEIGHT.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Width, read-write. Binary logarithm of the texels along u: 0 to 12.
    pub const fn log2_width(self) -> u32 {
        Self::LOG2_WIDTH.get(self.0)
    }

    /// The word with LOG2_WIDTH replaced. Bits above the low 4 are dropped.
    #[must_use]
    pub const fn with_log2_width(self, value: u32) -> Self {
        Self(Self::LOG2_WIDTH.put(self.0, value))
    }

    /// Height, read-write. Binary logarithm of the texels along v: 0 to 12.
    pub const fn log2_height(self) -> u32 {
        Self::LOG2_HEIGHT.get(self.0)
    }

    /// The word with LOG2_HEIGHT replaced. Bits above the low 4 are dropped.
    #[must_use]
    pub const fn with_log2_height(self, value: u32) -> Self {
        Self(Self::LOG2_HEIGHT.put(self.0, value))
    }
}

impl Default for TextureSize {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for TextureSize {
    const NAME: &'static str = "displace.TEXTURE_SIZE";
    const OFFSET: u32 = TEXTURE_SIZE;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xF0F;
    const WRITABLE: u32 = 0xF0F;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for TextureSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("TextureSize")
            .field("log2_width", &self.log2_width())
            .field("log2_height", &self.log2_height())
            .finish()
    }
}

/// Normal map size (NORMAL_SIZE). Texels of the normal map. More than 12 in a field: START ends in error
/// BAD_MAP.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct NormalSize(u32);

impl NormalSize {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::LOG2_WIDTH, Self::LOG2_HEIGHT];
    /// Place of LOG2_WIDTH.
    pub const LOG2_WIDTH: Field = Field { name: "LOG2_WIDTH", shift: 0, width: 4 };
    /// Place of LOG2_HEIGHT.
    pub const LOG2_HEIGHT: Field = Field { name: "LOG2_HEIGHT", shift: 8, width: 4 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::LOG2_WIDTH.mask() | Self::LOG2_HEIGHT.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Width, read-write. Binary logarithm of the texels along u: 0 to 12.
    pub const fn log2_width(self) -> u32 {
        Self::LOG2_WIDTH.get(self.0)
    }

    /// The word with LOG2_WIDTH replaced. Bits above the low 4 are dropped.
    #[must_use]
    pub const fn with_log2_width(self, value: u32) -> Self {
        Self(Self::LOG2_WIDTH.put(self.0, value))
    }

    /// Height, read-write. Binary logarithm of the texels along v: 0 to 12.
    pub const fn log2_height(self) -> u32 {
        Self::LOG2_HEIGHT.get(self.0)
    }

    /// The word with LOG2_HEIGHT replaced. Bits above the low 4 are dropped.
    #[must_use]
    pub const fn with_log2_height(self, value: u32) -> Self {
        Self(Self::LOG2_HEIGHT.put(self.0, value))
    }
}

impl Default for NormalSize {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for NormalSize {
    const NAME: &'static str = "displace.NORMAL_SIZE";
    const OFFSET: u32 = NORMAL_SIZE;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xF0F;
    const WRITABLE: u32 = 0xF0F;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for NormalSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("NormalSize")
            .field("log2_width", &self.log2_width())
            .field("log2_height", &self.log2_height())
            .finish()
    }
}

/// Raster size (RASTER_SIZE). Pixels of the camera; used if SOURCE is RASTER. A 0 in either field: START ends
/// in error BAD_RASTER.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct RasterSize(u32);

impl RasterSize {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::WIDTH, Self::HEIGHT];
    /// Place of WIDTH.
    pub const WIDTH: Field = Field { name: "WIDTH", shift: 0, width: 16 };
    /// Place of HEIGHT.
    pub const HEIGHT: Field = Field { name: "HEIGHT", shift: 16, width: 16 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::WIDTH.mask() | Self::HEIGHT.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Width, read-write. Pixels a row.
    pub const fn width(self) -> u32 {
        Self::WIDTH.get(self.0)
    }

    /// The word with WIDTH replaced. Bits above the low 16 are dropped.
    #[must_use]
    pub const fn with_width(self, value: u32) -> Self {
        Self(Self::WIDTH.put(self.0, value))
    }

    /// Height, read-write. Rows.
    pub const fn height(self) -> u32 {
        Self::HEIGHT.get(self.0)
    }

    /// The word with HEIGHT replaced. Bits above the low 16 are dropped.
    #[must_use]
    pub const fn with_height(self, value: u32) -> Self {
        Self(Self::HEIGHT.put(self.0, value))
    }
}

impl Default for RasterSize {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for RasterSize {
    const NAME: &'static str = "displace.RASTER_SIZE";
    const OFFSET: u32 = RASTER_SIZE;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xFFFF_FFFF;
    const WRITABLE: u32 = 0xFFFF_FFFF;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for RasterSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("RasterSize").field("width", &self.width()).field("height", &self.height()).finish()
    }
}

/// Background colour (BACKGROUND). Colour of results which are no hit, 0x00RRGGBB.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Background(u32);

impl Background {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::BLUE, Self::GREEN, Self::RED];
    /// Place of BLUE.
    pub const BLUE: Field = Field { name: "BLUE", shift: 0, width: 8 };
    /// Place of GREEN.
    pub const GREEN: Field = Field { name: "GREEN", shift: 8, width: 8 };
    /// Place of RED.
    pub const RED: Field = Field { name: "RED", shift: 16, width: 8 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::BLUE.mask() | Self::GREEN.mask() | Self::RED.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Blue, read-write. 0 to 255.
    pub const fn blue(self) -> u32 {
        Self::BLUE.get(self.0)
    }

    /// The word with BLUE replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_blue(self, value: u32) -> Self {
        Self(Self::BLUE.put(self.0, value))
    }

    /// Green, read-write. 0 to 255.
    pub const fn green(self) -> u32 {
        Self::GREEN.get(self.0)
    }

    /// The word with GREEN replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_green(self, value: u32) -> Self {
        Self(Self::GREEN.put(self.0, value))
    }

    /// Red, read-write. 0 to 255.
    pub const fn red(self) -> u32 {
        Self::RED.get(self.0)
    }

    /// The word with RED replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_red(self, value: u32) -> Self {
        Self(Self::RED.put(self.0, value))
    }
}

impl Default for Background {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Background {
    const NAME: &'static str = "displace.BACKGROUND";
    const OFFSET: u32 = BACKGROUND;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xFF_FFFF;
    const WRITABLE: u32 = 0xFF_FFFF;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Background {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Background")
            .field("blue", &self.blue())
            .field("green", &self.green())
            .field("red", &self.red())
            .finish()
    }
}

/// Pipeline (PIPELINE). Instances and latencies, so that a driver can bound its waits.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Pipeline(u32);

impl Pipeline {
    /// Value after reset.
    pub const RESET: Self = Self(0xF00);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::UNITS, Self::STAGES, Self::FILL_LATENCY];
    /// Place of UNITS.
    pub const UNITS: Field = Field { name: "UNITS", shift: 0, width: 4 };
    /// Place of STAGES.
    pub const STAGES: Field = Field { name: "STAGES", shift: 8, width: 8 };
    /// Place of FILL_LATENCY.
    pub const FILL_LATENCY: Field = Field { name: "FILL_LATENCY", shift: 16, width: 16 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::UNITS.mask() | Self::STAGES.mask() | Self::FILL_LATENCY.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Units, read-only. Instances of the unit, 1 to 4; they share the memory port. Set by the build.
    pub const fn units(self) -> u32 {
        Self::UNITS.get(self.0)
    }

    /// The word with UNITS replaced. Bits above the low 4 are dropped.
    #[must_use]
    pub const fn with_units(self, value: u32) -> Self {
        Self(Self::UNITS.put(self.0, value))
    }

    /// Stages, read-only. Stages of the traverse pipeline, which is as many rays in flight in each instance:
    /// 15 (Fig. 7).
    pub const fn stages(self) -> u32 {
        Self::STAGES.get(self.0)
    }

    /// The word with STAGES replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_stages(self, value: u32) -> Self {
        Self(Self::STAGES.put(self.0, value))
    }

    /// Fill latency, read-only. Cycles from the request of a cache line to its arrival, the memory port being
    /// free (P18). Set by the build.
    pub const fn fill_latency(self) -> u32 {
        Self::FILL_LATENCY.get(self.0)
    }

    /// The word with FILL_LATENCY replaced. Bits above the low 16 are dropped.
    #[must_use]
    pub const fn with_fill_latency(self, value: u32) -> Self {
        Self(Self::FILL_LATENCY.put(self.0, value))
    }
}

impl Default for Pipeline {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Pipeline {
    const NAME: &'static str = "displace.PIPELINE";
    const OFFSET: u32 = PIPELINE;
    const RESET: u32 = 0xF00;
    const READABLE: u32 = 0xFFFF_FF0F;
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
            .field("units", &self.units())
            .field("stages", &self.stages())
            .field("fill_latency", &self.fill_latency())
            .finish()
    }
}

/// Height cache (HEIGHT_CACHE). The cache of each traverse unit (P18).
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct HeightCache(u32);

impl HeightCache {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::LOG2_BYTES, Self::WAYS, Self::LINE_BYTES];
    /// Place of LOG2_BYTES.
    pub const LOG2_BYTES: Field = Field { name: "LOG2_BYTES", shift: 0, width: 8 };
    /// Place of WAYS.
    pub const WAYS: Field = Field { name: "WAYS", shift: 8, width: 8 };
    /// Place of LINE_BYTES.
    pub const LINE_BYTES: Field = Field { name: "LINE_BYTES", shift: 16, width: 16 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::LOG2_BYTES.mask() | Self::WAYS.mask() | Self::LINE_BYTES.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Size, read-only. Binary logarithm of the bytes in all. Set by the build.
    pub const fn log2_bytes(self) -> u32 {
        Self::LOG2_BYTES.get(self.0)
    }

    /// The word with LOG2_BYTES replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_log2_bytes(self, value: u32) -> Self {
        Self(Self::LOG2_BYTES.put(self.0, value))
    }

    /// Ways, read-only. Lines a set. Set by the build.
    pub const fn ways(self) -> u32 {
        Self::WAYS.get(self.0)
    }

    /// The word with WAYS replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_ways(self, value: u32) -> Self {
        Self(Self::WAYS.put(self.0, value))
    }

    /// Line, read-only. Bytes a line, a power of two from 4 to 64. Set by the build.
    pub const fn line_bytes(self) -> u32 {
        Self::LINE_BYTES.get(self.0)
    }

    /// The word with LINE_BYTES replaced. Bits above the low 16 are dropped.
    #[must_use]
    pub const fn with_line_bytes(self, value: u32) -> Self {
        Self(Self::LINE_BYTES.put(self.0, value))
    }
}

impl Default for HeightCache {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for HeightCache {
    const NAME: &'static str = "displace.HEIGHT_CACHE";
    const OFFSET: u32 = HEIGHT_CACHE;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xFFFF_FFFF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for HeightCache {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("HeightCache")
            .field("log2_bytes", &self.log2_bytes())
            .field("ways", &self.ways())
            .field("line_bytes", &self.line_bytes())
            .finish()
    }
}

/// Texture cache (TEXTURE_CACHE). The unified cache of texture and normals in each instance (§4.1, P18).
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct TextureCache(u32);

impl TextureCache {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::LOG2_BYTES, Self::WAYS, Self::LINE_BYTES];
    /// Place of LOG2_BYTES.
    pub const LOG2_BYTES: Field = Field { name: "LOG2_BYTES", shift: 0, width: 8 };
    /// Place of WAYS.
    pub const WAYS: Field = Field { name: "WAYS", shift: 8, width: 8 };
    /// Place of LINE_BYTES.
    pub const LINE_BYTES: Field = Field { name: "LINE_BYTES", shift: 16, width: 16 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::LOG2_BYTES.mask() | Self::WAYS.mask() | Self::LINE_BYTES.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Size, read-only. Binary logarithm of the bytes in all. Set by the build.
    pub const fn log2_bytes(self) -> u32 {
        Self::LOG2_BYTES.get(self.0)
    }

    /// The word with LOG2_BYTES replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_log2_bytes(self, value: u32) -> Self {
        Self(Self::LOG2_BYTES.put(self.0, value))
    }

    /// Ways, read-only. Lines a set. Set by the build.
    pub const fn ways(self) -> u32 {
        Self::WAYS.get(self.0)
    }

    /// The word with WAYS replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_ways(self, value: u32) -> Self {
        Self(Self::WAYS.put(self.0, value))
    }

    /// Line, read-only. Bytes a line, a power of two from 4 to 64. Set by the build.
    pub const fn line_bytes(self) -> u32 {
        Self::LINE_BYTES.get(self.0)
    }

    /// The word with LINE_BYTES replaced. Bits above the low 16 are dropped.
    #[must_use]
    pub const fn with_line_bytes(self, value: u32) -> Self {
        Self(Self::LINE_BYTES.put(self.0, value))
    }
}

impl Default for TextureCache {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for TextureCache {
    const NAME: &'static str = "displace.TEXTURE_CACHE";
    const OFFSET: u32 = TEXTURE_CACHE;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xFFFF_FFFF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for TextureCache {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("TextureCache")
            .field("log2_bytes", &self.log2_bytes())
            .field("ways", &self.ways())
            .field("line_bytes", &self.line_bytes())
            .finish()
    }
}

/// FIFOs and memory port (FIFOS). The buffers between the units of an instance, and the port all instances
/// share (P18).
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Fifos(u32);

impl Fifos {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::FIFO0, Self::FIFO1, Self::PORT_BYTES];
    /// Place of FIFO0.
    pub const FIFO0: Field = Field { name: "FIFO0", shift: 0, width: 8 };
    /// Place of FIFO1.
    pub const FIFO1: Field = Field { name: "FIFO1", shift: 8, width: 8 };
    /// Place of PORT_BYTES.
    pub const PORT_BYTES: Field = Field { name: "PORT_BYTES", shift: 16, width: 8 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::FIFO0.mask() | Self::FIFO1.mask() | Self::PORT_BYTES.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// FIFO #0, read-only. Rays it has room for, from view calculation to traversal (Fig. 6). Set by the
    /// build.
    pub const fn fifo0(self) -> u32 {
        Self::FIFO0.get(self.0)
    }

    /// The word with FIFO0 replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_fifo0(self, value: u32) -> Self {
        Self(Self::FIFO0.put(self.0, value))
    }

    /// FIFO #1, read-only. Rays it has room for, from traversal to shading (Fig. 6). Set by the build.
    pub const fn fifo1(self) -> u32 {
        Self::FIFO1.get(self.0)
    }

    /// The word with FIFO1 replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_fifo1(self, value: u32) -> Self {
        Self(Self::FIFO1.put(self.0, value))
    }

    /// Port width, read-only. Bytes a cycle through the memory port. Set by the build.
    pub const fn port_bytes(self) -> u32 {
        Self::PORT_BYTES.get(self.0)
    }

    /// The word with PORT_BYTES replaced. Bits above the low 8 are dropped.
    #[must_use]
    pub const fn with_port_bytes(self, value: u32) -> Self {
        Self(Self::PORT_BYTES.put(self.0, value))
    }
}

impl Default for Fifos {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Fifos {
    const NAME: &'static str = "displace.FIFOS";
    const OFFSET: u32 = FIFOS;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xFF_FFFF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Fifos {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Fifos")
            .field("fifo0", &self.fifo0())
            .field("fifo1", &self.fifo1())
            .field("port_bytes", &self.port_bytes())
            .finish()
    }
}

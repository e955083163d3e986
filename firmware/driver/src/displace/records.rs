//! Records of rays and results. In: host numbers (`f32`). Out: words in the device's format, and back. Cost: a
//! conversion a number; for an `f32` device that is a copy.
//!
//! | record | words |
//! |---|---|
//! | ray | u, v, view x, y, z, three reserved |
//! | result | texel x, y (signed), t, steps 15–0 with start level 23–16 and status 31–24, colour, hit u, hit v, 0 |

use lucerna_regs::ident::NumberFormat;

use super::image::channels;
use crate::records::{decode, encode};

/// Words of a ray record.
pub const RAY_WORDS: usize = 8;
/// Words of a result record.
pub const RESULT_WORDS: usize = 8;

/// A ray as it goes into a list.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Ray {
    /// Texture coordinate at which it meets the top plane; the map is 0 to 1, and repeats or ends beyond.
    pub entry: [f32; 2],
    /// View vector: world coordinates, away from the eye, of any length.
    pub view: [f32; 3],
}

impl Ray {
    /// The record.
    pub fn pack(&self, format: NumberFormat) -> [u32; RAY_WORDS] {
        let [u, v] = self.entry.map(|number| encode(format, number));
        let [x, y, z] = self.view.map(|number| encode(format, number));
        [u, v, x, y, z, 0, 0, 0]
    }

    /// The ray of a record.
    pub fn unpack(format: NumberFormat, words: &[u32; RAY_WORDS]) -> Self {
        let [u, v, x, y, z, ..] = words.map(|bits| decode(format, bits));
        Self { entry: [u, v], view: [x, y, z] }
    }
}

/// How a ray ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum RayStatus {
    /// It hit the texel.
    Hit,
    /// A pixel beside the surface, or a ray that left a map without wrap.
    #[default]
    Miss,
    /// It does not come down on the surface (P18).
    Grazing,
    /// The watchdog stopped it.
    Watchdog,
    /// What no device writes: no job has written this record.
    Unknown(u8),
}

impl RayStatus {
    /// The status in bits 31 to 24 of a record's fourth word.
    const fn of(bits: u8) -> Self {
        match bits {
            0 => Self::Hit,
            1 => Self::Miss,
            2 => Self::Grazing,
            3 => Self::Watchdog,
            other => Self::Unknown(other),
        }
    }

    const fn bits(self) -> u8 {
        match self {
            Self::Hit => 0,
            Self::Miss => 1,
            Self::Grazing => 2,
            Self::Watchdog => 3,
            Self::Unknown(bits) => bits,
        }
    }
}

/// What became of a ray.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RayResult {
    /// How it ended.
    pub status: RayStatus,
    /// The leaf texel, not wrapped: beyond the map it runs on in both directions (P8).
    pub texel: [i32; 2],
    /// Ray parameter of the hit: 0 at the top plane, 1 at the bottom one.
    pub t: f32,
    /// Steps taken (P1).
    pub steps: u16,
    /// The level at which it began.
    pub level: u8,
    /// Red, green and blue.
    pub colour: [u8; 3],
    /// Texture coordinate of the hit, in its leaf texel (P15).
    pub position: [f32; 2],
}

impl RayResult {
    /// The result of a record.
    pub fn unpack(format: NumberFormat, words: &[u32; RESULT_WORDS]) -> Self {
        let [x, y, t, info, colour, u, v, _] = *words;
        let [status, level, ..] = info.to_be_bytes();
        Self {
            status: RayStatus::of(status),
            texel: [x as i32, y as i32],
            t: decode(format, t),
            steps: info as u16,
            level,
            colour: channels(colour),
            position: [decode(format, u), decode(format, v)],
        }
    }

    /// The record.
    pub fn pack(&self, format: NumberFormat) -> [u32; RESULT_WORDS] {
        let [x, y] = self.texel.map(|texel| texel as u32);
        let [high, low] = self.steps.to_be_bytes();
        let info = u32::from_be_bytes([self.status.bits(), self.level, high, low]);
        let [u, v] = self.position.map(|number| encode(format, number));
        [x, y, encode(format, self.t), info, super::image::colour(self.colour), u, v, 0]
    }
}

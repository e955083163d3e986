//! Records in memory; in: words, out: rays, and results as words; cost: wires.

use lucerna_softfloat::Format;

/// Words of a ray record: texture coordinate 2, view vector 3 (world coordinates, pointing away from the eye), 3 reserved.
pub const RAY_WORDS: u32 = 8;
/// Words of a result record, see [`Outcome`].
pub const RESULT_WORDS: u32 = 8;

/// A ray as it is in memory.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RayRecord<F> {
    /// Where it meets the top plane, texture coordinate.
    pub entry: [F; 2],
    /// View vector.
    pub view: [F; 3],
}

impl<F: Format> RayRecord<F> {
    /// The record's words.
    #[inline]
    pub fn of(words: &[u32; RAY_WORDS as usize]) -> Self {
        let [u, v, x, y, z, ..] = *words;
        Self { entry: [u, v].map(F::from_bits), view: [x, y, z].map(F::from_bits) }
    }
}

/// How a ray ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u32)]
pub enum Status {
    /// It hit the texel.
    Hit = 0,
    /// A pixel beside the surface, or a ray that left a map without wrap.
    Miss = 1,
    /// It does not come down on the surface (P18), or enters it 2^24 texels from the origin or further.
    Grazing = 2,
    /// The watchdog stopped it.
    Watchdog = 3,
}

/// What becomes of a ray.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Outcome<F> {
    /// How it ended.
    pub status: Status,
    /// Leaf texel, not wrapped: tiles run on in both directions.
    pub texel: [i32; 2],
    /// Ray parameter, 0 at the top plane, 1 at the bottom.
    pub t: F,
    /// Steps taken (P1).
    pub steps: u32,
    /// Level at which it began.
    pub level: u32,
    /// Texture coordinate of the hit, in its leaf texel (P15).
    pub position: [F; 2],
    /// `0x00RRGGBB`.
    pub colour: u32,
}

impl<F: Format> Outcome<F> {
    /// That of a ray which is not traversed.
    pub const fn untraversed(status: Status, colour: u32) -> Self {
        Self { status, texel: [0; 2], t: F::ZERO, steps: 0, level: 0, position: [F::ZERO; 2], colour }
    }

    /// The record: texel x, texel y, t, `steps | level << 16 | status << 24`, colour, hit u, hit v, 0.
    #[inline]
    pub fn words(&self) -> [u32; RESULT_WORDS as usize] {
        let info = self.steps & 0xFFFF | self.level << 16 | (self.status as u32) << 24;
        let [u, v] = self.position.map(F::to_bits);
        [self.texel[0] as u32, self.texel[1] as u32, self.t.to_bits(), info, self.colour, u, v, 0]
    }
}

/// The result record of a hit, with its colour.
#[inline]
pub(crate) const fn with_colour(
    mut result: [u32; RESULT_WORDS as usize],
    colour: u32,
) -> [u32; RESULT_WORDS as usize] {
    result[4] = colour;
    result
}

//! Records in device memory; in: 32-bit words, out: numbers of the device's format; cost: one wide read each.
//!
//! | record | words |
//! |---|---|
//! | photon | position 0–2, flux 3–5, p_addr 6, n 7; with the normal test also normal 8–10, reserved 11 |
//! | hit point | position 0–2, normal 3–5, colour 6–8, flux 9–11, R² 12, N 13, pixel 14, reserved 15 |
//! | index entry | hit-point number |
//! | pixel | red, green, blue |

use lucerna_fabric::window::Buffer;
use lucerna_softfloat::Format;

/// Words of a hit point.
pub const HIT_WORDS: u32 = 16;
/// Words of a photon without the normal test (Fig. 8: 6 + 1 + 1).
pub const PHOTON_WORDS: u32 = 8;
/// Words of a photon with its normal (D8).
pub const PHOTON_WORDS_WITH_NORMAL: u32 = 12;
/// Words of an index-table entry.
pub const INDEX_WORDS: u32 = 1;
/// Words of a pixel.
pub const PIXEL_WORDS: u32 = 3;

/// A hit point's words.
pub type HitRecord = [u32; HIT_WORDS as usize];

/// Where things are in a hit point.
mod hit_word {
    pub const POSITION: usize = 0;
    pub const NORMAL: usize = 3;
    pub const COLOUR: usize = 6;
    pub const FLUX: usize = 9;
    pub const RADIUS2: usize = 12;
    pub const COUNT: usize = 13;
    pub const PIXEL: usize = 14;
}
use hit_word::{COLOUR, COUNT, FLUX, NORMAL, PIXEL, POSITION, RADIUS2};

/// What the datapath takes of a photon.
#[derive(Clone, Copy, Debug)]
pub struct Photon<F> {
    /// Where it hit.
    pub position: [F; 3],
    /// φ.
    pub flux: [F; 3],
    /// The surface's normal; zero without the normal test.
    pub normal: [F; 3],
}

/// A photon as it comes through the port (Fig. 8): with its list in the index table.
#[derive(Clone, Copy, Debug)]
pub struct Arrival<F> {
    /// The photon.
    pub photon: Photon<F>,
    /// The first entry of its list.
    pub p_addr: u32,
    /// The length of its list.
    pub n: u32,
}

/// What no update changes in a hit point.
#[derive(Clone, Copy, Debug)]
pub struct Surface<F> {
    /// x.
    pub position: [F; 3],
    /// The surface's normal.
    pub normal: [F; 3],
    /// The surface's colour times what was lost on the way to the eye.
    pub colour: [F; 3],
}

/// What an update changes in a hit point: words 9 to 13.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Accumulated<F> {
    /// τ.
    pub flux: [F; 3],
    /// R².
    pub radius2: F,
    /// N, accumulated as N + αM (D14).
    pub count: F,
}

#[inline]
fn numbers<F: Format, const W: usize>(words: &[u32], first: usize) -> [F; W] {
    core::array::from_fn(|word| F::from_bits(words[first + word]))
}

impl<F: Format> Arrival<F> {
    /// Reads a record of the photon ring.
    #[inline]
    pub fn read(memory: &[u32], ring: &Buffer, record: u32, normal_test: bool) -> Option<Self> {
        let words: &[u32; PHOTON_WORDS as usize] = ring.read(memory, record, 0)?;
        let normal = match normal_test {
            true => numbers(ring.read::<3>(memory, record, PHOTON_WORDS)?, 0),
            false => [F::ZERO; 3],
        };
        let photon = Photon { position: numbers(words, 0), flux: numbers(words, 3), normal };
        Some(Self { photon, p_addr: words[6], n: words[7] })
    }
}

impl<F: Format> Surface<F> {
    /// Of a hit point.
    #[inline]
    pub fn of(words: &HitRecord) -> Self {
        Self {
            position: numbers(words, POSITION),
            normal: numbers(words, NORMAL),
            colour: numbers(words, COLOUR),
        }
    }
}

impl<F: Format> Accumulated<F> {
    /// Of a hit point.
    #[inline]
    pub fn of(words: &HitRecord) -> Self {
        let [radius2, count] = [RADIUS2, COUNT].map(|word| F::from_bits(words[word]));
        Self { flux: numbers(words, FLUX), radius2, count }
    }

    /// Writes it back.
    #[inline]
    pub fn write(&self, memory: &mut [u32], hits: &Buffer, hit: u32) {
        // Issued only for hit points that were read, so the record is there.
        if let Some(words) = hits.write::<{ HIT_WORDS as usize }>(memory, hit, 0) {
            words[FLUX..][..3].copy_from_slice(&self.flux.map(F::to_bits));
            words[RADIUS2] = self.radius2.to_bits();
            words[COUNT] = self.count.to_bits();
        }
    }
}

/// Reads a hit point.
#[inline]
pub fn read_hit<'m>(memory: &'m [u32], hits: &Buffer, hit: u32) -> Option<&'m HitRecord> {
    hits.read(memory, hit, 0)
}

/// What the distance test needs of a hit point.
#[inline]
pub fn position_and_radius2<F: Format>(words: &HitRecord) -> ([F; 3], F) {
    (numbers(words, POSITION), F::from_bits(words[RADIUS2]))
}

/// The pixel number of a hit point.
#[inline]
pub const fn pixel_of(words: &HitRecord) -> u32 {
    words[PIXEL]
}

/// Reads a pixel.
#[inline]
pub fn read_pixel<F: Format>(memory: &[u32], pixels: &Buffer, pixel: u32) -> Option<[F; 3]> {
    pixels.read::<3>(memory, pixel, 0).map(|words| numbers(words, 0))
}

/// Writes a pixel back.
#[inline]
pub fn write_pixel<F: Format>(memory: &mut [u32], pixels: &Buffer, pixel: u32, value: [F; 3]) {
    if let Some(words) = pixels.write::<3>(memory, pixel, 0) {
        *words = value.map(F::to_bits);
    }
}

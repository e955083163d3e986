//! Records of device memory. In: host numbers (`f32`). Out: words in the device's format, and back. Cost: a
//! conversion a number; for an `f32` device that is a copy.
//!
//! | record | words |
//! |---|---|
//! | photon | position 0–2, flux 3–5, p_addr 6, n 7; with the normal test (D8) normal 8–10, 11 reserved |
//! | hit point | position 0–2, normal 3–5, colour 6–8, flux 9–11, R² 12, N 13, pixel 14, 15 reserved |
//! | pixel | red, green, blue |
//! | index entry | number of a hit point |

use lucerna_regs::ident::NumberFormat;
use lucerna_softfloat::{F24, F32};

/// Words of a photon record without the normal test.
pub const PHOTON_WORDS: usize = 8;
/// Words of a photon record with the normal test.
pub const PHOTON_NORMAL_WORDS: usize = 12;
/// Words of a hit point.
pub const HIT_POINT_WORDS: usize = 16;
/// Words of a pixel.
pub const PIXEL_WORDS: usize = 3;

/// The device's bits for a host number: rounded to nearest even, a NaN becomes the canonical one. A device of the study
/// format `F64` takes the bits of an f32.
#[inline]
pub fn encode(format: NumberFormat, number: f32) -> u32 {
    match format {
        NumberFormat::F32 | NumberFormat::F64 => F32::from_f32(number).to_bits(),
        NumberFormat::F24 => F24::from_f32(number).to_bits(),
    }
}

/// The host number of the device's bits: exact in every format.
#[inline]
pub fn decode(format: NumberFormat, bits: u32) -> f32 {
    match format {
        NumberFormat::F32 | NumberFormat::F64 => F32::from_bits(bits).to_f32(),
        NumberFormat::F24 => F24::from_bits(bits).to_f32(),
    }
}

/// A photon, as it goes into the ring.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Photon {
    /// Where it hit.
    pub position: [f32; 3],
    /// The surface's normal there; only sent with the normal test (D8).
    pub normal: [f32; 3],
    /// Its flux.
    pub flux: [f32; 3],
    /// Where its list begins in the index table: entries `p_addr..p_addr + n` name the hit points to test.
    pub p_addr: u32,
    /// Entries in its list; 0 for an empty cell (D9), where `p_addr` means nothing.
    pub n: u32,
}

impl Photon {
    /// The record without a normal.
    #[inline]
    pub fn pack(&self, format: NumberFormat) -> [u32; PHOTON_WORDS] {
        let [x, y, z] = self.position.map(|number| encode(format, number));
        let [r, g, b] = self.flux.map(|number| encode(format, number));
        [x, y, z, r, g, b, self.p_addr, self.n]
    }

    /// The record with a normal.
    #[inline]
    pub fn pack_normal(&self, format: NumberFormat) -> [u32; PHOTON_NORMAL_WORDS] {
        let [x, y, z, r, g, b, p_addr, n] = self.pack(format);
        let [nx, ny, nz] = self.normal.map(|number| encode(format, number));
        [x, y, z, r, g, b, p_addr, n, nx, ny, nz, 0]
    }

    /// The photon of a record without a normal.
    pub fn unpack(format: NumberFormat, words: &[u32; PHOTON_WORDS]) -> Self {
        let [x, y, z, r, g, b, p_addr, n] = *words;
        let numbers = |bits: [u32; 3]| bits.map(|bits| decode(format, bits));
        Self { position: numbers([x, y, z]), normal: [0.0; 3], flux: numbers([r, g, b]), p_addr, n }
    }

    /// The photon of a record with a normal.
    pub fn unpack_normal(format: NumberFormat, words: &[u32; PHOTON_NORMAL_WORDS]) -> Self {
        let [x, y, z, r, g, b, p_addr, n, nx, ny, nz, _] = *words;
        let normal = [nx, ny, nz].map(|bits| decode(format, bits));
        Self { normal, ..Self::unpack(format, &[x, y, z, r, g, b, p_addr, n]) }
    }
}

/// A hit point: where a path from the eye met a diffuse surface, and what photons have added there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HitPoint {
    /// Where the path met the surface.
    pub position: [f32; 3],
    /// The surface's normal.
    pub normal: [f32; 3],
    /// The surface's colour, weighted by the path.
    pub colour: [f32; 3],
    /// Accumulated flux, τ.
    pub flux: [f32; 3],
    /// The radius squared, R²: above 0 at first; every photon taken shrinks it.
    pub radius_squared: f32,
    /// Accumulated photons, N + αM (D14).
    pub photons: f32,
    /// The pixel it adds to.
    pub pixel: u32,
}

impl HitPoint {
    /// The record.
    pub fn pack(&self, format: NumberFormat) -> [u32; HIT_POINT_WORDS] {
        let [x, y, z] = self.position.map(|number| encode(format, number));
        let [nx, ny, nz] = self.normal.map(|number| encode(format, number));
        let [r, g, b] = self.colour.map(|number| encode(format, number));
        let [fr, fg, fb] = self.flux.map(|number| encode(format, number));
        let radius_squared = encode(format, self.radius_squared);
        let photons = encode(format, self.photons);
        [x, y, z, nx, ny, nz, r, g, b, fr, fg, fb, radius_squared, photons, self.pixel, 0]
    }

    /// The hit point of a record.
    pub fn unpack(format: NumberFormat, words: &[u32; HIT_POINT_WORDS]) -> Self {
        let [x, y, z, nx, ny, nz, r, g, b, fr, fg, fb, radius_squared, photons, pixel, _] = *words;
        let numbers = |bits: [u32; 3]| bits.map(|bits| decode(format, bits));
        Self {
            position: numbers([x, y, z]),
            normal: numbers([nx, ny, nz]),
            colour: numbers([r, g, b]),
            flux: numbers([fr, fg, fb]),
            radius_squared: decode(format, radius_squared),
            photons: decode(format, photons),
            pixel,
        }
    }
}

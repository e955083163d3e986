//! In: radiance. Out: 8-bit pictures, their files, and how far two of them differ. Cost: linear in the pixels.

mod compare;
mod ssim;

use std::path::{Path, PathBuf};

use image::RgbImage;

pub use compare::{Comparison, compare, difference};

/// Why a picture could not be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// The pixels do not fill the picture.
    #[error("{pixels} pixels do not make a picture of {width} by {height}")]
    WrongSize {
        /// How many there are.
        pixels: usize,
        /// Picture's width.
        width: u32,
        /// Picture's height.
        height: u32,
    },
    /// Two pictures differ in size.
    #[error("a picture of {} by {} cannot be compared with one of {} by {}", a.0, a.1, b.0, b.1)]
    SizesDiffer {
        /// One size.
        a: (u32, u32),
        /// The other.
        b: (u32, u32),
    },
    /// The file could not be written.
    #[error("cannot write {}: {why}; name a folder you may write to with --out", path.display())]
    Unwritable {
        /// Which.
        path: PathBuf,
        /// The system's words.
        why: String,
    },
}

/// From radiance to an 8-bit sample: round-half-up of 255·(1 - exp(-L))^(1/2.2). Negative and not-a-number give black.
pub fn tone(radiance: f64) -> u8 {
    // The conversion saturates, so infinity is 255.
    ((1.0 - (-radiance.max(0.0)).exp()).powf(1.0 / 2.2) * 255.0 + 0.5) as u8
}

/// A picture from its pixels, row by row from the top.
///
/// # Errors
/// When the pixels are not `width * height`.
pub fn tone_map(radiance: &[[f64; 3]], width: u32, height: u32) -> Result<RgbImage, PictureError> {
    let wrong = PictureError::WrongSize { pixels: radiance.len(), width, height };
    if radiance.len() as u64 != u64::from(width) * u64::from(height) {
        return Err(wrong);
    }
    let samples: Vec<u8> = radiance.as_flattened().iter().copied().map(tone).collect();
    RgbImage::from_raw(width, height, samples).ok_or(wrong)
}

/// Writes a PNG file; the folder must be there.
///
/// # Errors
/// When the file cannot be written.
pub fn save(picture: &RgbImage, path: &Path) -> Result<(), PictureError> {
    picture
        .save_with_format(path, image::ImageFormat::Png)
        .map_err(|e| PictureError::Unwritable { path: path.to_owned(), why: e.to_string() })
}

/// FNV-1a over 64 bits of words, each as four bytes, least significant first.
pub fn fnv1a64(words: impl IntoIterator<Item = u32>) -> u64 {
    words.into_iter().flat_map(u32::to_le_bytes).fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tones() {
        assert_eq!(
            [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9, f64::NEG_INFINITY].map(tone),
            [0, 0, 0, 255, 255, 0]
        );
        // (1 - e^-1)^(1/2.2) = 0.81170…
        assert_eq!(tone(1.0), 207);
    }

    #[test]
    fn fnv_of_known_bytes() {
        assert_eq!(fnv1a64([]), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a64([u32::from_le_bytes(*b"foob")]), 0xdd12_0e79_0c25_12af);
    }

    #[test]
    fn pixels_must_fill_the_picture() {
        let error = tone_map(&[[0.0; 3]; 5], 2, 2).unwrap_err();
        assert_eq!(error, PictureError::WrongSize { pixels: 5, width: 2, height: 2 });
        assert_eq!(tone_map(&[[0.0; 3]; 4], 2, 2).unwrap().dimensions(), (2, 2));
    }
}

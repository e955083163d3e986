//! In: two pictures of one size. Out: SSIM, PSNR, how many samples differ, and where.

use image::RgbImage;

use super::PictureError;

/// How far two 8-bit pictures differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Mean structural similarity as first defined (Wang and others, 2004: a Gaussian window of 11×11, σ = 1.5), the mean of the
    /// three channels; 1 when equal.
    pub ssim: f64,
    /// Peak signal-to-noise ratio in decibels over all samples; infinite when equal.
    pub psnr_db: f64,
    /// Samples (three a pixel) that are not the same.
    pub differing_samples: u64,
    /// Samples in all.
    pub samples: u64,
}

/// Compares two pictures.
///
/// # Errors
/// When their sizes differ.
pub fn compare(a: &RgbImage, b: &RgbImage) -> Result<Comparison, PictureError> {
    same_size(a, b)?;
    let (mut differing, mut squares) = (0, 0u64);
    for (&x, &y) in a.iter().zip(b.iter()) {
        let d = u64::from(x.abs_diff(y));
        differing += u64::from(d != 0);
        squares += d * d;
    }
    let samples = a.len() as u64;
    let mean = squares as f64 / samples as f64;
    Ok(Comparison {
        ssim: super::ssim::ssim(a, b),
        psnr_db: 10.0 * (255.0 * 255.0 / mean).log10(),
        differing_samples: differing,
        samples,
    })
}

/// The difference of each sample, `amplification` times as large: black where the pictures agree.
///
/// # Errors
/// When their sizes differ.
pub fn difference(a: &RgbImage, b: &RgbImage, amplification: u8) -> Result<RgbImage, PictureError> {
    same_size(a, b)?;
    let mut out = a.clone();
    for (o, &y) in out.iter_mut().zip(b.iter()) {
        *o = o.abs_diff(y).saturating_mul(amplification);
    }
    Ok(out)
}

fn same_size(a: &RgbImage, b: &RgbImage) -> Result<(), PictureError> {
    if a.dimensions() == b.dimensions() {
        Ok(())
    } else {
        Err(PictureError::SizesDiffer { a: a.dimensions(), b: b.dimensions() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn equal_pictures() {
        let a = RgbImage::from_pixel(16, 16, Rgb([10, 20, 30]));
        let c = compare(&a, &a).unwrap();
        assert_eq!((c.ssim, c.psnr_db, c.differing_samples, c.samples), (1.0, f64::INFINITY, 0, 768));
        assert!(difference(&a, &a, 8).unwrap().iter().all(|&s| s == 0));
    }

    #[test]
    fn one_sample_off() {
        let a = RgbImage::from_pixel(16, 16, Rgb([10, 20, 30]));
        let mut b = a.clone();
        b.get_pixel_mut(3, 4)[1] = 24;
        let c = compare(&a, &b).unwrap();
        assert_eq!(c.differing_samples, 1);
        assert!((c.psnr_db - 10.0 * (255.0f64 * 255.0 * 768.0 / 16.0).log10()).abs() < 1e-12);
        assert!(c.ssim < 1.0);
        assert_eq!(difference(&a, &b, 8).unwrap().get_pixel(3, 4), &Rgb([0, 32, 0]));
        assert_eq!(difference(&a, &b, 100).unwrap().get_pixel(3, 4), &Rgb([0, 255, 0]));
    }

    #[test]
    fn sizes_must_agree() {
        let error = compare(&RgbImage::new(2, 3), &RgbImage::new(3, 2)).unwrap_err();
        assert_eq!(error, PictureError::SizesDiffer { a: (2, 3), b: (3, 2) });
    }
}

//! In: two pictures of one size. Out: their mean structural similarity. Cost: about 1 µs a pixel.

use image::RgbImage;

/// Width of the window, and its standard deviation.
const WINDOW: usize = 11;
const SIGMA: f64 = 1.5;
/// (0.01 · 255)² and (0.03 · 255)²: they keep flat windows from dividing zero by zero.
const C1: f64 = 6.5025;
const C2: f64 = 58.5225;

/// The mean over the channels and over every window that lies wholly in the picture.
pub(super) fn ssim(a: &RgbImage, b: &RgbImage) -> f64 {
    let (width, height) = (a.width() as usize, a.height() as usize);
    if width == 0 || height == 0 {
        return 1.0;
    }
    let blur = Blur { width, height, weights: gaussian(WINDOW.min(width).min(height)) };
    (0..3).map(|channel| channel_ssim(&plane(a, channel), &plane(b, channel), &blur)).sum::<f64>() / 3.0
}

fn plane(picture: &RgbImage, channel: usize) -> Vec<f64> {
    picture.pixels().map(|p| p[channel].into()).collect()
}

fn gaussian(size: usize) -> Vec<f64> {
    let middle = (size as f64 - 1.0) / 2.0;
    let weight = |i: usize| (-(i as f64 - middle).powi(2) / (2.0 * SIGMA * SIGMA)).exp();
    let sum: f64 = (0..size).map(weight).sum();
    (0..size).map(|i| weight(i) / sum).collect()
}

fn channel_ssim(a: &[f64], b: &[f64], blur: &Blur) -> f64 {
    let products = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).collect::<Vec<_>>();
    let (mean_a, mean_b) = (blur.apply(a), blur.apply(b));
    let (aa, bb, ab) =
        (blur.apply(&products(a, a)), blur.apply(&products(b, b)), blur.apply(&products(a, b)));
    let similarity = |i: usize| {
        let (ma, mb) = (mean_a[i], mean_b[i]);
        let (va, vb, covariance) = (aa[i] - ma * ma, bb[i] - mb * mb, ab[i] - ma * mb);
        (2.0 * ma * mb + C1) * (2.0 * covariance + C2) / ((ma * ma + mb * mb + C1) * (va + vb + C2))
    };
    (0..mean_a.len()).map(similarity).sum::<f64>() / mean_a.len() as f64
}

/// A weighted mean over square windows, across and then down.
struct Blur {
    width: usize,
    height: usize,
    weights: Vec<f64>,
}

impl Blur {
    fn apply(&self, plane: &[f64]) -> Vec<f64> {
        let size = self.weights.len();
        let (across, down) = (self.width - size + 1, self.height - size + 1);
        let dot = |values: &mut dyn Iterator<Item = f64>| {
            values.zip(&self.weights).map(|(v, w)| v * w).sum::<f64>()
        };
        let mut rows = Vec::with_capacity(across * self.height);
        for row in plane.chunks_exact(self.width) {
            rows.extend(row.windows(size).map(|window| dot(&mut window.iter().copied())));
        }
        let column = |y: usize, x: usize| dot(&mut (0..size).map(|i| rows[(y + i) * across + x]));
        (0..down).flat_map(|y| (0..across).map(move |x| (y, x))).map(|(y, x)| column(y, x)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn flat_pictures_by_hand() {
        let flat = |v: u8| RgbImage::from_pixel(13, 12, Rgb([v; 3]));
        let expected = (2.0 * 100.0 * 110.0 + C1) / (100.0 * 100.0 + 110.0 * 110.0 + C1);
        assert!((ssim(&flat(100), &flat(110)) - expected).abs() < 1e-9);
        assert_eq!(ssim(&flat(7), &flat(7)), 1.0);
    }

    #[test]
    fn opposite_patterns_are_below_zero() {
        let board =
            |odd: u32| RgbImage::from_fn(16, 16, |x, y| Rgb([if (x + y) % 2 == odd { 255 } else { 0 }; 3]));
        assert!(ssim(&board(0), &board(1)) < -0.9);
    }

    #[test]
    fn a_picture_smaller_than_the_window() {
        let a = RgbImage::from_pixel(1, 4, Rgb([1, 2, 3]));
        assert_eq!(ssim(&a, &a), 1.0);
        assert_eq!(ssim(&RgbImage::new(0, 0), &RgbImage::new(0, 0)), 1.0);
    }
}

//! Pictures of results; in: results and findings, out: RGB; cost: a few operations a pixel.

use image::{Rgb, RgbImage};
use lucerna_driver::displace::RayResult;

use super::judge::Finding;
use super::workload::Workload;

/// Where there is no surface.
pub const BACKGROUND: [u8; 3] = [24, 30, 38];

/// The steps at which the heat map is at its end.
pub const HOTTEST: u16 = 64;

/// Colours of 0 to [`HOTTEST`] steps, evenly apart.
const HEAT: [[u8; 3]; 6] =
    [[0, 0, 24], [60, 16, 110], [150, 36, 110], [226, 84, 56], [250, 170, 30], [252, 255, 190]];

fn each(workload: &Workload, count: usize, mut colour: impl FnMut(usize) -> [u8; 3]) -> RgbImage {
    let (width, height) = (workload.raster.width, workload.raster.height);
    let mut picture = RgbImage::from_pixel(width, height, Rgb(BACKGROUND));
    for result in 0..count.min(workload.results()) {
        let pixel = workload.pixel(result) as u32;
        picture.put_pixel(pixel % width, pixel / width, Rgb(colour(result)));
    }
    picture
}

/// The colours that the device gave.
pub fn shaded(workload: &Workload, results: &[RayResult]) -> RgbImage {
    each(workload, results.len(), |i| results[i].colour)
}

/// Steps as colours: dark for few, bright for [`HOTTEST`] and more.
pub fn heat(workload: &Workload, results: &[RayResult]) -> RgbImage {
    each(workload, results.len(), |i| if results[i].steps == 0 { BACKGROUND } else { hot(results[i].steps) })
}

fn hot(steps: u16) -> [u8; 3] {
    let at = f64::from(steps.min(HOTTEST)) / f64::from(HOTTEST) * (HEAT.len() - 1) as f64;
    let below = (at as usize).min(HEAT.len() - 2);
    let part = at - below as f64;
    std::array::from_fn(|c| {
        let [low, high] = [HEAT[below][c], HEAT[below + 1][c]].map(f64::from);
        (low + (high - low) * part).round() as u8
    })
}

/// The shaded picture, dimmed, with red where another texel was hit than the exact march does, yellow where the ray goes
/// through a corner.
pub fn difference(workload: &Workload, results: &[RayResult], findings: &[Finding]) -> RgbImage {
    each(workload, results.len().min(findings.len()), |i| match findings[i] {
        Finding::Untraced => BACKGROUND,
        Finding::Same => results[i].colour.map(|c| c / 4),
        Finding::Corner => [255, 220, 0],
        Finding::Other => [255, 0, 0],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_grows() {
        assert_eq!((hot(0), hot(HOTTEST), hot(4000)), (HEAT[0], HEAT[5], HEAT[5]));
        let light = |steps| hot(steps).iter().map(|c| u32::from(*c)).sum::<u32>();
        assert!((1..=HOTTEST).all(|steps| light(steps) >= light(steps - 1)));
    }
}

//! A picture for a terminal. In: radiance. Out: a letter a pixel. Cost: three exponentials and three powers a pixel.
//!
//! The approximations of micromath are plain `f32` operations, rounded as IEEE 754 says: a board and a host draw the
//! same letters.

use fixed::types::U4F12;
use glam::Vec3;
use micromath::F32Ext;

/// From dark to bright.
const RAMP: [char; 10] = [' ', '.', ':', '-', '=', '+', '*', '#', '%', '@'];
/// What a screen's red, green and blue add to brightness (Rec. 709).
const LUMA: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);
/// Of a usual screen.
const GAMMA: f32 = 2.2;

/// The letter for a pixel's radiance: exposure 1 - exp(-L) and gamma for each colour, then brightness.
pub fn letter(radiance: [f32; 3]) -> char {
    let screen = Vec3::from(radiance.map(tone));
    let top = U4F12::from_num(RAMP.len() as u32 - 1);
    let level = U4F12::saturating_from_num(screen.dot(LUMA)).saturating_mul(top).round().to_num::<usize>();
    RAMP[level.min(RAMP.len() - 1)]
}

/// Between 0 and 1; what is no radiance (negative, NaN) is dark.
fn tone(radiance: f32) -> f32 {
    if radiance > 0.0 {
        // By path: with `std` in the program, a method call would mean the exact functions.
        F32Ext::powf(1.0 - F32Ext::exp(-radiance), 1.0 / GAMMA).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_go_from_dark_to_bright() {
        assert_eq!(letter([0.0; 3]), ' ');
        assert_eq!(letter([f32::NAN, -1.0, f32::NEG_INFINITY]), ' ');
        assert_eq!(letter([20.0; 3]), '@');
        assert_eq!(letter([f32::INFINITY; 3]), '@');
        let place = |radiance: f32| RAMP.iter().position(|c| *c == letter([radiance; 3])).unwrap();
        // 1 - exp(-0.2) = 0.181; 0.181^(1/2.2) = 0.460, times 9 is 4.1.
        assert_eq!(place(0.2), 4);
        let places = (0..200).map(|step| place(step as f32 * 0.02));
        assert!(places.clone().zip(places.skip(1)).all(|(a, b)| a <= b), "brighter is never darker");
    }
}

//! A picture for a terminal. In: radiance, or a screen's colour. Out: a letter a pixel. Cost: three exponentials and three
//! powers a pixel, or three products.
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

/// The letter for a colour of a screen: its red, green and blue of 0 to 255.
pub fn colour_letter(colour: [u8; 3]) -> char {
    const LUMA: [u32; 3] = [2126, 7152, 722];
    const WHITE: u32 = 255 * (LUMA[0] + LUMA[1] + LUMA[2]);
    let luma: u32 = colour.into_iter().zip(LUMA).map(|(part, weight)| u32::from(part) * weight).sum();
    let top = RAMP.len() as u32 - 1;
    RAMP[((luma * top + WHITE / 2) / WHITE).min(top) as usize]
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
    #[test]
    fn a_colour_is_as_bright_as_a_screen_shows_it() {
        assert_eq!(colour_letter([0; 3]), ' ');
        assert_eq!(colour_letter([255; 3]), '@');
        // 9 · 0.7152 is 6.4, 9 · 0.0722 is 0.6.
        assert_eq!(colour_letter([0, 255, 0]), RAMP[6]);
        assert_eq!(colour_letter([0, 0, 255]), RAMP[1]);
    }
}

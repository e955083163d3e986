//! A surface and an eye. In: nothing. Out: heights, colours, plane, camera and light, always the same. Cost: 14 distances
//! and two lattices of noise a texel, in integers.
//!
//! Round stones on rough ground, which repeat without a seam.

use lucerna_driver::displace::{Camera, Light, Plane, Shape, colour};

/// Binary logarithm of the texels along each side.
const LOG2: u32 = 6;
/// Texels along each side.
const SIDE: u32 = 1 << LOG2;
/// Texels of the map.
pub const TEXELS: usize = 1 << (2 * LOG2);
/// The map's width and height.
pub const SHAPE: Shape = Shape::new(LOG2, LOG2).unwrap();
/// Pixels a row.
pub const WIDTH: usize = 32;
/// Rows of the picture.
pub const HEIGHT: usize = 24;
/// Of pixels beside the surface.
pub const BACKGROUND: [u8; 3] = [24, 30, 38];

/// Stones on the ground.
const STONES: u32 = 14;
/// Their colour, and the ground's, where it is brightest.
const STONE: [u8; 3] = [255, 242, 214];

/// The map twice on each side around the origin, y up, and a quarter of it deep. World and texture units are the same.
pub const PLANE: Plane = Plane {
    origin: [-1.0, 0.0, 1.0],
    tangent: [2.0, 0.0, 0.0],
    bitangent: [0.0, 0.0, -2.0],
    normal: [0.0, 1.0, 0.0],
    repeat: [2.0, 2.0],
    height_scale: 0.25,
    bounded: true,
};

/// Low over the stones, so that rays cross many texels on their way down.
pub const CAMERA: Camera = Camera {
    position: [0.5, 0.2, 0.9],
    direction: [-0.375, -0.2, -0.625],
    up: [0.0, 1.0, 0.0],
    field_of_view: core::f32::consts::FRAC_PI_8,
    width: WIDTH as u32,
    height: HEIGHT as u32,
};

/// From the left, behind the eye.
pub fn light() -> Light {
    Light::towards([-0.5, -0.35, 0.8], 0.25, 0.8)
}

/// Fills a map, row by row.
pub fn heights(map: &mut [u8; TEXELS]) {
    for (place, height) in (0..).zip(map) {
        *height = height_at(place % SIDE, place / SIDE);
    }
}

/// The colour of a texel of the texture: speckled stone.
pub fn texel(x: u32, y: u32) -> u32 {
    let bright = 144 + smooth(x, y, 3, 4) / 4 + hash(x, y, 5) % 48;
    colour(STONE.map(|channel| (u32::from(channel) * bright / 256) as u8))
}

/// The highest of ground and stones.
fn height_at(x: u32, y: u32) -> u8 {
    let ground = 12 + smooth(x, y, 4, 1) / 8 + smooth(x, y, 2, 2) / 16;
    let stones = (0..STONES).filter_map(|number| stone(number, x, y));
    stones.fold(ground, u32::max).min(255) as u8
}

/// Half a ball of 5 to 12 texels, somewhat lifted.
fn stone(number: u32, x: u32, y: u32) -> Option<u32> {
    let place = hash(number, 0, 3);
    let radius = 5 + (place >> 12) % 8;
    let lift = (place >> 20) % 48;
    let apart = |a: u32, b: u32| {
        let d = a.wrapping_sub(b) % SIDE;
        d.min(SIDE - d)
    };
    let (dx, dy) = (apart(x, place % SIDE), apart(y, (place >> 6) % SIDE));
    let left = (radius * radius).checked_sub(dx * dx + dy * dy)?;
    // 16 a texel are a 16th of the depth, and a 64th of the map's side: they are as high as they are wide.
    Some(lift + (left << 8).isqrt())
}

/// Noise of 0 to 255: random at every `1 << log2` texels, linear between.
fn smooth(x: u32, y: u32, log2: u32, seed: u32) -> u32 {
    let size = 1 << log2;
    let node = |dx: u32, dy: u32| {
        let wrapped = |at: u32| (at % SIDE) >> log2;
        hash(wrapped(x + dx), wrapped(y + dy), seed) & 255
    };
    let (u, v) = (x % size, y % size);
    let row = |dy: u32| node(0, dy) * (size - u) + node(size, dy) * u;
    (row(0) * (size - v) + row(size) * v) >> (2 * log2)
}

/// 32 bits by chance, the same for the same three numbers: every bit of them changes about half of the bits.
const fn hash(x: u32, y: u32, seed: u32) -> u32 {
    let mut word = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed.wrapping_mul(0xC2B2_AE3D);
    word = (word ^ word >> 16).wrapping_mul(0x7FEB_352D);
    word = (word ^ word >> 15).wrapping_mul(0x846C_A68B);
    word ^ word >> 16
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> [u8; TEXELS] {
        let mut map = [0; TEXELS];
        heights(&mut map);
        map
    }

    #[test]
    fn the_surface_has_ground_and_stones() {
        let map = map();
        let (low, high) = (map.iter().filter(|h| **h < 64).count(), map.iter().filter(|h| **h > 128).count());
        assert!(low > TEXELS / 8 && high > TEXELS / 8, "{low} low, {high} high of {TEXELS}");
    }

    #[test]
    fn it_repeats_without_a_seam() {
        let map = map();
        let at = |x: u32, y: u32| map[(y % SIDE * SIDE + x % SIDE) as usize];
        let steps = |x: u32| (0..SIDE).map(|y| u32::from(at(x, y).abs_diff(at(x + 1, y)))).sum::<u32>();
        let worst = (0..SIDE - 1).map(steps).max().unwrap();
        assert!(steps(SIDE - 1) <= worst, "{} at the seam, {worst} inside", steps(SIDE - 1));
    }
}

//! Where the eye is and what its pixels look along; in: a name or angles, out: view vectors; cost: a few operations a pixel.
//!
//! The surface is a grid of 200 by 200 in the plane y = 0, with u = x/200 + 1/2 and v = 1/2 - z/200; the field of view is 45°
//! from the bottom of the picture to its top. A picture's rows go down, so v grows downwards under the front view.

use std::f64::consts::FRAC_PI_8;
use std::str::FromStr;

use super::noise::Random;

/// Side of the grid.
pub const GRID: f64 = 200.0;

/// A pinhole camera.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct View {
    /// Where it is; y is the height over the surface.
    pub eye: [f64; 3],
    /// Where it looks, of length one.
    pub forward: [f64; 3],
    /// To the right in the picture.
    pub right: [f64; 3],
    /// Up in the picture.
    pub up: [f64; 3],
}

/// View vectors of a raster: `origin + column * right + row * down`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Raster {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Of the top left pixel's centre.
    pub origin: [f64; 3],
    /// From a pixel to the one on its right.
    pub right: [f64; 3],
    /// From a pixel to the one below.
    pub down: [f64; 3],
}

impl View {
    /// Straight down on the whole grid.
    pub const FRONT: Self = Self {
        eye: [0.0, 215.0, 0.0],
        forward: [0.0, -1.0, 0.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 0.0, 1.0],
    };

    /// The paper's oblique view.
    pub fn oblique() -> Self {
        let eye = [76.099_495, 43.191_154, -110.108_971];
        let at = [75.590_889, 42.676_582, -109.418_678];
        Self::along(eye, std::array::from_fn(|i| at[i] - eye[i]))
    }

    /// A fit of the paper's grazing view.
    pub fn grazing() -> Self {
        Self::turned([-189.1, 9.3, 3.3], 62.6, -17.8)
    }

    /// From `eye`, turned by `yaw` degrees (0: +z, 90: +x) and lifted by `pitch` degrees.
    pub fn turned(eye: [f64; 3], yaw: f64, pitch: f64) -> Self {
        let ((sin, cos), (up, along)) = (yaw.to_radians().sin_cos(), pitch.to_radians().sin_cos());
        // Right from the yaw alone, so that straight down is as good as any other direction.
        let (forward, right) = ([sin * along, up, cos * along], [cos, 0.0, -sin]);
        Self { eye, forward, right, up: cross(forward, right) }
    }

    /// From `eye` along `direction`, upright.
    fn along(eye: [f64; 3], direction: [f64; 3]) -> Self {
        let forward = unit(direction);
        let right = unit(cross([0.0, 1.0, 0.0], forward));
        Self { eye, forward, right, up: cross(forward, right) }
    }

    /// A view of some part of the surface, the same for the same number.
    pub fn random(number: u64) -> Self {
        let mut random = Random::new(number);
        let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
        let eye = [between(-150.0, 150.0), between(2.0, 16.0).powi(2), between(-150.0, 150.0)];
        let at = [between(-95.0, 95.0), 0.0, between(-95.0, 95.0)];
        Self::along(eye, std::array::from_fn(|i| at[i] - eye[i]))
    }

    /// The raster of its pixels' centres.
    pub fn raster(&self, width: u32, height: u32) -> Raster {
        // Half the picture's height at distance 1, over half its pixels.
        let pitch = FRAC_PI_8.tan() * 2.0 / f64::from(height);
        let (x, y) = (f64::from(width - 1) * 0.5 * pitch, f64::from(height - 1) * 0.5 * pitch);
        let Self { forward, right, up, .. } = self;
        Raster {
            width,
            height,
            origin: std::array::from_fn(|i| forward[i] - x * right[i] + y * up[i]),
            right: right.map(|c| c * pitch),
            down: up.map(|c| -c * pitch),
        }
    }
}

impl Raster {
    /// The view vector of a pixel.
    pub fn vector(&self, column: u32, row: u32) -> [f64; 3] {
        let (column, row) = (f64::from(column), f64::from(row));
        std::array::from_fn(|i| self.origin[i] + row * self.down[i] + column * self.right[i])
    }
}

impl FromStr for View {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || {
            "write front, oblique, grazing, or YAW,PITCH[,X,Y,Z]: degrees (yaw 0 looks along +z, 90 along +x; pitch is \
             negative downwards) and the eye, with Y over 0; without an eye it looks at the middle from a distance of 215"
                .to_owned()
        };
        match text {
            "front" => return Ok(Self::FRONT),
            "oblique" => return Ok(Self::oblique()),
            "grazing" => return Ok(Self::grazing()),
            _ => {}
        }
        let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
        let numbers = numbers.map_err(|_| form())?;
        if numbers.iter().any(|number: &f64| !number.is_finite() || number.abs() > 1e6) {
            return Err(form());
        }
        match numbers[..] {
            [yaw, pitch] if (-90.0..0.0).contains(&pitch) => {
                let forward = Self::turned([0.0; 3], yaw, pitch).forward;
                Ok(Self::turned(forward.map(|c| -215.0 * c), yaw, pitch))
            }
            [yaw, pitch, x, y, z] if y > 0.0 => Ok(Self::turned([x, y, z], yaw, pitch)),
            _ => Err(form()),
        }
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = a.iter().map(|c| c * c).sum::<f64>().sqrt();
    a.map(|c| c / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_is_upright_and_right_is_right() {
        for view in [View::FRONT, View::oblique(), View::grazing(), View::random(3)] {
            let View { forward, right, up, .. } = view;
            let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
            for (a, b) in [(forward, right), (forward, up), (right, up)] {
                assert!(dot(a, b).abs() < 1e-12);
                assert!((dot(a, a) - 1.0).abs() < 1e-12);
            }
            assert!(right[1].abs() < 1e-12 && up[1] >= -1e-12);
        }
        // Straight down by angles is the front view.
        let down = View::turned(View::FRONT.eye, 0.0, -90.0);
        for i in 0..3 {
            assert!((down.right[i] - View::FRONT.right[i]).abs() < 1e-12);
            assert!((down.up[i] - View::FRONT.up[i]).abs() < 1e-12);
        }
    }

    #[test]
    fn the_field_of_view_is_45_degrees() {
        let raster = View::FRONT.raster(4, 200);
        let top = raster.vector(0, 0);
        // A pixel's centre is half a pixel inside.
        let edge = top[2] - raster.down[2] * 0.5;
        assert!(((edge / -top[1]).atan().to_degrees() - 22.5).abs() < 1e-9);
        let (left, right) = (raster.vector(0, 7), raster.vector(3, 7));
        assert!((left[0] + right[0]).abs() < 1e-15 && left[0] < 0.0);
    }

    #[test]
    fn words_are_read_or_explained() {
        assert_eq!("front".parse(), Ok(View::FRONT));
        assert!("30,-20".parse::<View>().unwrap().eye[1] > 0.0);
        assert_eq!("0,5,1,2,3".parse::<View>().unwrap().eye, [1.0, 2.0, 3.0]);
        for bad in ["", "side", "1", "1,2", "1,-2,3", "0,-20,0,0,0", "nan,-1", "1,2,3,4,inf", "0,-91"] {
            assert!(bad.parse::<View>().unwrap_err().contains("YAW,PITCH"), "{bad}");
        }
    }
}

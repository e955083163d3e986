//! Rays of a picture; in: a view and a surface, out: where each pixel meets the top plane and along what; cost: a division a pixel.

use super::view::{GRID, Raster, View};

/// How a map lies on the grid.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Surface {
    /// Depth of the displacement in texture units.
    pub scale: f64,
    /// How often the map lies along each side.
    pub repeat: f64,
}

/// A pixel that meets the surface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray {
    /// Its number: row by row from the top.
    pub pixel: u32,
    /// Texture coordinate at the top plane.
    pub entry: [f64; 2],
    /// Texture coordinate from top plane to bottom plane.
    pub direction: [f64; 2],
    /// View vector, in world coordinates.
    pub view: [f64; 3],
}

impl Surface {
    /// Texture coordinates of the plane's whole extent.
    pub const fn extent(&self) -> [f64; 2] {
        [self.repeat, self.repeat]
    }

    /// Texture coordinate under the eye, and its height over the plane in units of the displacement's depth.
    pub fn eye(&self, view: &View) -> [f64; 3] {
        let [x, y, z] = view.eye;
        [(x / GRID + 0.5) * self.repeat, (0.5 - z / GRID) * self.repeat, y / GRID * self.repeat / self.scale]
    }

    /// The ray of a view vector, unless it does not come down on the surface.
    pub fn ray(&self, eye: [f64; 3], pixel: u32, view: [f64; 3]) -> Option<Ray> {
        let [x, y, z] = view;
        if y >= 0.0 {
            return None;
        }
        // Rows tangent (1, 0, 0), bitangent (0, 0, -1), normal (0, 1, 0).
        let direction = [self.scale * x / -y, self.scale * -z / -y];
        let entry = [eye[0] + direction[0] * eye[2], eye[1] + direction[1] * eye[2]];
        let inside = entry.iter().zip(self.extent()).all(|(at, extent)| (0.0..extent).contains(at));
        inside.then_some(Ray { pixel, entry, direction, view })
    }

    /// All pixels of a raster that meet the surface, in order.
    pub fn rays(&self, view: &View, raster: &Raster) -> Vec<Ray> {
        let eye = self.eye(view);
        let pixels = (0..raster.height).flat_map(|row| (0..raster.width).map(move |column| (row, column)));
        let ray = |(row, column)| self.ray(eye, row * raster.width + column, raster.vector(column, row));
        pixels.filter_map(ray).collect()
    }
}

impl Ray {
    /// Texture coordinate and view vector as a record has them before they are rounded to the device's format.
    pub fn record(&self) -> [f32; 5] {
        let [u, v] = self.entry.map(|x| x as f32);
        let [x, y, z] = self.view.map(|x| x as f32);
        [u, v, x, y, z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_of_the_grid_are_corners_of_the_map() {
        let surface = Surface { scale: 0.2, repeat: 4.0 };
        let eye = surface.eye(&View::FRONT);
        for (at, uv) in [([-100.0, -100.0], [0.0, 4.0]), ([50.0, 100.0], [3.0, 0.0])] {
            let view = [at[0] * 0.999_999, -215.0, at[1] * 0.999_999];
            let ray = surface.ray(eye, 0, view).unwrap();
            for (entry, expected) in ray.entry.into_iter().zip(uv) {
                assert!((entry - expected).abs() < 1e-4, "{:?}", ray.entry);
            }
        }
        assert_eq!(surface.ray(eye, 0, [0.0, 0.0, 1.0]), None, "along the plane");
        assert_eq!(surface.ray(eye, 0, [100.1, -215.0, 0.0]), None, "beside it");
        let straight = surface.ray(eye, 0, [0.0, -1.0, 0.0]).unwrap();
        assert_eq!((straight.entry, straight.direction), ([2.0, 2.0], [0.0, -0.0]));
    }
}

//! In: a pixel. Out: its eye ray.

use super::{Ray, Vec3};

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: Vec3,
    /// Where it looks; length one.
    pub direction: Vec3,
    /// The picture's x axis; length one.
    pub right: Vec3,
    /// Height of the picture at distance one: twice the tangent of half the field of view.
    pub height: f64,
    /// Eye rays start this many picture distances in front of the eye.
    pub start: f64,
}

impl Camera {
    /// The field of view is vertical, in degrees.
    pub fn look_at(eye: Vec3, target: Vec3, up: Vec3, field_of_view: f64) -> Self {
        let direction = (target - eye).normalised();
        let right = direction.cross(up).normalised();
        Self { eye, direction, right, height: 2.0 * (field_of_view.to_radians() / 2.0).tan(), start: 0.0 }
    }

    /// The picture plane for a picture of this size.
    pub fn plane(&self, width: u32, height: u32) -> Plane {
        let (width, height) = (f64::from(width), f64::from(height));
        Plane {
            camera: *self,
            across: self.right * (width * self.height / height),
            upward: self.right.cross(self.direction).normalised() * self.height,
            width,
            height,
        }
    }
}

/// A camera with a picture size.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    camera: Camera,
    across: Vec3,
    upward: Vec3,
    width: f64,
    height: f64,
}

impl Plane {
    /// The ray through the middle of a pixel; y = 0 is the top row.
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        let d = self.across * ((f64::from(x) + 0.5) / self.width - 0.5)
            + self.upward * (-(f64::from(y) + 0.5) / self.height + 0.5)
            + self.camera.direction;
        Ray { origin: self.camera.eye + d * self.camera.start, direction: d.normalised() }
    }
}

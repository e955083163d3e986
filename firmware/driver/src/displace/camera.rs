//! Camera and plane. In: where they are in the world. Out: the numbers of a job's registers. Cost: a few dozen
//! operations in `f32`, once a job.
//!
//! The same bits on every host: each operation rounds once, roots are soft, and no library's tangent is used.

use super::JobError;
use super::image::root;

/// A plane which is displaced downwards, in world coordinates of any unit.
///
/// ```
/// use lucerna_driver::displace::Plane;
///
/// // 200 by 200 around the world's origin, the maps four times along either side; y is up.
/// let plane = Plane {
///     origin: [-100.0, 0.0, 100.0],
///     tangent: [200.0, 0.0, 0.0],
///     bitangent: [0.0, 0.0, -200.0],
///     normal: [0.0, 1.0, 0.0],
///     repeat: [4.0, 4.0],
///     height_scale: 0.2,
///     bounded: true,
/// };
/// let frame = plane.frame()?;
/// assert_eq!(frame.apply([50.0, 0.0, 0.0]), [1.0, 0.0, 0.0], "a texture unit is 50 world units");
/// assert_eq!(frame.apply([0.0, 50.0, 0.0]), [0.0, 0.0, 1.0], "upwards too");
/// # Ok::<(), lucerna_driver::displace::JobError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Plane {
    /// The corner at texture coordinate (0, 0), on the top plane: heights of 255 lie in it, all others below.
    pub origin: [f32; 3],
    /// From there along u, to the other corner.
    pub tangent: [f32; 3],
    /// From there along v, to the other corner.
    pub bitangent: [f32; 3],
    /// Upwards, of any length.
    pub normal: [f32; 3],
    /// How often the maps fit along tangent and bitangent: there texture coordinates end.
    pub repeat: [f32; 2],
    /// Depth of the displacement, from heights of 255 to 0, in texture units along u.
    pub height_scale: f32,
    /// Whether the surface ends at the other corners; else it goes on for ever.
    pub bounded: bool,
}

impl Plane {
    /// From the world to tangent space.
    pub fn frame(&self) -> Result<Frame, JobError> {
        let [u, v] = self.repeat;
        let tangent = self.tangent.map(|x| x / u);
        let bitangent = self.bitangent.map(|x| x / v);
        let up = scaled(self.normal, length(tangent) / length(self.normal));
        // Rows of the inverse of these three as columns: right for skew planes too.
        let volume = dot(tangent, cross(bitangent, up));
        let row = |a, b| plain(cross(a, b).map(|x| x / volume));
        let frame = Frame {
            tangent: row(bitangent, up),
            bitangent: row(up, tangent),
            normal: row(tangent, bitangent),
            height_scale: self.height_scale,
        };
        let finite = frame.rows().as_flattened().iter().all(|x| x.is_finite());
        if u > 0.0 && v > 0.0 && finite { Ok(frame) } else { Err(JobError::Plane) }
    }

    /// Where texture coordinates end; 0 where they do not.
    pub const fn extent(&self) -> [f32; 2] {
        if self.bounded { self.repeat } else { [0.0; 2] }
    }
}

/// From world directions to texture units: what rays of a list and cameras have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Frame {
    /// The row whose product with a direction is its part along u, in texture units.
    pub tangent: [f32; 3],
    /// The row for v.
    pub bitangent: [f32; 3],
    /// The row for upwards, in texture units too.
    pub normal: [f32; 3],
    /// Depth of the displacement in texture units; the device multiplies tangent and bitangent by it.
    pub height_scale: f32,
}

impl Frame {
    /// Tangent, bitangent and normal.
    pub const fn rows(&self) -> [[f32; 3]; 3] {
        [self.tangent, self.bitangent, self.normal]
    }

    /// A world direction in texture units: along u, along v, upwards.
    pub fn apply(&self, direction: [f32; 3]) -> [f32; 3] {
        self.rows().map(|row| dot(row, direction))
    }
}

/// A pinhole camera, in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Camera {
    /// The eye.
    pub position: [f32; 3],
    /// Where it looks, of any length.
    pub direction: [f32; 3],
    /// What is up in the picture, of any length, not along `direction`.
    pub up: [f32; 3],
    /// Vertical field of view in radians, between 0 and π.
    pub field_of_view: f32,
    /// Pixels a row, 1 to 65535.
    pub width: u32,
    /// Rows, 1 to 65535.
    pub height: u32,
}

impl Camera {
    /// The same, looking at a point.
    #[must_use]
    pub fn looking_at(self, target: [f32; 3]) -> Self {
        Self { direction: difference(target, self.position), ..self }
    }

    /// Its pixels over a plane, square ones; a ray goes through the middle of each.
    pub fn raster(&self, plane: &Plane) -> Result<Raster, JobError> {
        let (width, height) = (self.width as f32, self.height as f32);
        let half = self.field_of_view / 2.0;
        if !(half > 0.0 && half < core::f32::consts::FRAC_PI_2) {
            return Err(JobError::Camera);
        }
        let forward = unit(self.direction);
        let rightwards = unit(cross(forward, self.up));
        let downwards = cross(forward, rightwards);
        let pixel = 2.0 * tangent(half) / height;
        let right = scaled(rightwards, pixel);
        let down = scaled(downwards, pixel);
        let corner = sum(scaled(right, 0.5 - width / 2.0), scaled(down, 0.5 - height / 2.0));
        let frame = plane.frame()?;
        let [u, v, above] = frame.apply(difference(self.position, plane.origin));
        let raster = Raster {
            width: self.width,
            height: self.height,
            origin: plain(sum(forward, corner)),
            right: plain(right),
            down: plain(down),
            eye: plain([u, v, above / frame.height_scale]),
            extent: plane.extent(),
        };
        // A direction of no length or along `up` has become NaNs.
        if ![raster.origin, right, down].as_flattened().iter().all(|x| x.is_finite()) {
            return Err(JobError::Camera);
        }
        Ok(raster)
    }
}

/// Pixels as the device counts through them: the view vector of one is `(origin + row * down) + column * right`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Raster {
    /// Pixels a row, 1 to 65535.
    pub width: u32,
    /// Rows, 1 to 65535.
    pub height: u32,
    /// View vector of pixel (0, 0), in world coordinates.
    pub origin: [f32; 3],
    /// What a pixel to the right adds to it.
    pub right: [f32; 3],
    /// What a row down adds to it.
    pub down: [f32; 3],
    /// Texture coordinate under the eye, and the eye's height over the top plane in units of the displacement's depth:
    /// texture units divided by the height scale.
    pub eye: [f32; 3],
    /// Texture coordinates at which the surface ends; 0 if it does not.
    pub extent: [f32; 2],
}

impl Raster {
    /// The view vector of a pixel.
    pub fn view(&self, column: u32, row: u32) -> [f32; 3] {
        sum(sum(self.origin, scaled(self.down, row as f32)), scaled(self.right, column as f32))
    }
}

/// The tangent of an angle between 0 and π/2: sine over cosine, as sums in `f64` until nothing changes.
fn tangent(angle: f32) -> f32 {
    let x = f64::from(angle);
    let (mut sine, mut cosine) = (0.0, 0.0);
    // (−1)^k x^n / n!; below (π/2)^24 / 24! = 8e-20 nothing changes.
    let mut term = 1.0;
    for n in 0..24 {
        let signed = if n % 4 < 2 { term } else { -term };
        if n % 2 == 0 {
            cosine += signed;
        } else {
            sine += signed;
        }
        term *= x / f64::from(n + 1);
    }
    (sine / cosine) as f32
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [[ax, ay, az], [bx, by, bz]] = [a, b];
    ax * bx + ay * by + az * bz
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    let [[ax, ay, az], [bx, by, bz]] = [a, b];
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

fn sum(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    let [[ax, ay, az], [bx, by, bz]] = [a, b];
    [ax + bx, ay + by, az + bz]
}

fn difference(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    sum(a, b.map(|x| -x))
}

fn scaled(a: [f32; 3], factor: f32) -> [f32; 3] {
    a.map(|x| x * factor)
}

/// Zeros without a sign: the same registers for the same geometry, however it was reached.
fn plain(a: [f32; 3]) -> [f32; 3] {
    a.map(|x| x + 0.0)
}

/// The length; of a vector whose square leaves the range of `f32`, 0 or infinity.
fn length(a: [f32; 3]) -> f32 {
    root(dot(a, a))
}

/// The same direction, of length one; NaNs if it has none.
pub(crate) fn unit(a: [f32; 3]) -> [f32; 3] {
    let length = length(a);
    a.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::tangent;

    #[test]
    fn the_tangent_is_that_of_the_host() {
        for thousandths in 1..1570 {
            let angle = thousandths as f32 / 1000.0;
            let wanted = f64::from(angle).tan() as f32;
            assert_eq!(tangent(angle).to_bits(), wanted.to_bits(), "{angle}");
        }
    }
}

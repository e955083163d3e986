//! In: a rectangle with a height map, as the scene file has it. Out: where rays meet its top plane, and tangent space to world
//! and back. Cost: a plane test per ray and rectangle.
//!
//! The surface is a pit of the rectangle's outline whose bottom is the relief; the rectangle is its lid, level with the map's
//! highest value. A ray that meets the lid from in front goes to the displacement unit; the pit's walls are vertical.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::check::Check;
use super::{Material, Ray, SceneError, Vec3};

/// Where a map comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MapName {
    /// A procedural map of the project's.
    BuiltIn(String),
    /// A PNG file.
    File(PathBuf),
}

/// Where its colours come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Texture {
    /// The surface has one colour.
    Plain,
    /// From the heights.
    ByHeight,
    /// A PNG file.
    File(PathBuf),
}

/// A displaced rectangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Displaced {
    corner: Vec3,
    /// An edge over its length squared: what turns a place along it into a share.
    shares: [Vec3; 2],
    tbn: [Vec3; 3],
    map: MapName,
    texture: Texture,
    colour: Vec3,
    repeat: [f64; 2],
    height_scale: f64,
    depth: f64,
    near: f64,
}

/// Where a ray leaves the pit through a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// How far along the ray.
    pub distance: f64,
    /// Into the pit.
    pub normal: Vec3,
}

impl Displaced {
    /// The height map.
    pub const fn map(&self) -> &MapName {
        &self.map
    }

    /// The colours, laid over the height map.
    pub const fn texture(&self) -> &Texture {
        &self.texture
    }

    /// Reflectance; where there is a texture, a factor of its colours.
    pub const fn colour(&self) -> Vec3 {
        self.colour
    }

    /// Depth of the relief in texture units, which are the sides of one copy of the map.
    pub const fn height_scale(&self) -> f64 {
        self.height_scale
    }

    /// Depth of the relief in the scene's unit.
    pub const fn depth(&self) -> f64 {
        self.depth
    }

    /// Tangent, bitangent and normal, of length one: the rows of the matrix from world to tangent space.
    pub const fn tbn(&self) -> [Vec3; 3] {
        self.tbn
    }

    /// Out of the relief, towards where rays come from.
    pub const fn normal(&self) -> Vec3 {
        self.tbn[2]
    }

    /// A vector of tangent space, in the world and of length one.
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        let [t, b, n] = self.tbn;
        (t * v.x + b * v.y + n * v.z).normalised()
    }

    /// Texture coordinate of a point over or under the rectangle.
    pub fn entry(&self, point: Vec3) -> [f64; 2] {
        let [a, b] = self.place(point);
        [a * self.repeat[0], b * self.repeat[1]]
    }

    /// The point of the lid over a point in the pit.
    pub fn over(&self, point: Vec3) -> Vec3 {
        point + self.normal() * self.normal().dot(self.corner - point)
    }

    /// Where a ray from a point of the lid meets a wall, however deep.
    pub fn wall(&self, point: Vec3, direction: Vec3) -> Wall {
        let (place, [t, b, _]) = (self.place(point), self.tbn);
        let along = |axis: usize, tangent: Vec3| {
            let rate = direction.dot(self.shares[axis]);
            let room = if rate > 0.0 { 1.0 - place[axis] } else { place[axis] };
            let distance = if rate == 0.0 { f64::INFINITY } else { (room / rate.abs()).max(0.0) };
            Wall { distance, normal: if rate > 0.0 { -tangent } else { tangent } }
        };
        let (first, second) = (along(0, t), along(1, b));
        if second.distance < first.distance { second } else { first }
    }

    /// Shares of the edges.
    fn place(&self, point: Vec3) -> [f64; 2] {
        let from = point - self.corner;
        self.shares.map(|share| from.dot(share))
    }

    /// How far along the ray the lid is, nearer than `limit`; both sides.
    pub(super) fn distance(&self, ray: &Ray, limit: f64) -> Option<f64> {
        let distance = self.normal().dot(self.corner - ray.origin) / self.normal().dot(ray.direction);
        // A ray in the plane gives no number, which fails the test.
        if !(distance > self.near && distance < limit) {
            return None;
        }
        let place = self.place(ray.origin + ray.direction * distance);
        place.iter().all(|share| (0.0..=1.0).contains(share)).then_some(distance)
    }

    /// Triangles no more than this before the lid count as in its plane, and give way to it.
    pub(super) const fn near(&self) -> f64 {
        self.near
    }

    /// What a ray of this direction meets: the relief from in front, a plain sheet from behind.
    pub(super) fn material(&self, number: usize, direction: Vec3) -> Material {
        if self.normal().dot(direction) < 0.0 {
            Material::Displaced { surface: number }
        } else {
            Material::Diffuse { colour: self.colour }
        }
    }
}

/// A displaced rectangle as the scene file has it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DisplacedEntry {
    corner: [f64; 3],
    u: [f64; 3],
    v: [f64; 3],
    map: String,
    height_scale: f64,
    colour: [f64; 3],
    #[serde(default = "once")]
    repeat: f64,
    texture: Option<String>,
}

fn once() -> f64 {
    1.0
}

/// Copies of the map along an edge: more would be smaller than the numbers of the unit tell apart.
const MOST_REPEATS: f64 = 4096.0;
/// Depth in texture units.
const MOST_HEIGHT: f64 = 64.0;

impl DisplacedEntry {
    pub fn build(&self, check: &Check<'_>, number: usize, folder: &Path) -> Result<Displaced, SceneError> {
        let place = &format!("[[displaced]] number {}", number + 1);
        let corner = check.finite(place, "corner", self.corner)?;
        let u = check.finite(place, "u", self.u)?;
        let v = check.finite(place, "v", self.v)?;
        let (length, width) = (u.length(), v.length());
        if !(length > 0.0 && width > 0.0 && u.dot(v).abs() <= 1e-6 * length * width) {
            return check.value(
                place,
                "u and v are two edges of a rectangle: of some length, and perpendicular".to_owned(),
            );
        }
        if !(self.repeat > 0.0 && self.repeat.max(self.repeat * width / length) <= MOST_REPEATS) {
            let why = format!("repeat must be above zero, and at most {MOST_REPEATS} along each edge");
            return check.value(place, why);
        }
        if !(self.height_scale > 0.0 && self.height_scale <= MOST_HEIGHT) {
            return check.value(
                place,
                format!("height_scale must be above 0 and at most {MOST_HEIGHT}, not {}", self.height_scale),
            );
        }
        let tangent = u.normalised();
        let normal = u.cross(v).normalised();
        let texture_unit = length / self.repeat;
        let is_file = Path::new(&self.map).extension().is_some();
        Ok(Displaced {
            corner,
            shares: [u * (1.0 / u.dot(u)), v * (1.0 / v.dot(v))],
            tbn: [tangent, normal.cross(tangent), normal],
            map: if is_file {
                MapName::File(folder.join(&self.map))
            } else {
                MapName::BuiltIn(self.map.clone())
            },
            texture: match self.texture.as_deref() {
                None => Texture::Plain,
                Some("by-height") => Texture::ByHeight,
                Some(file) => Texture::File(folder.join(file)),
            },
            colour: check.colour(place, "colour", self.colour, 1.0)?,
            repeat: [self.repeat, width / texture_unit],
            height_scale: self.height_scale,
            depth: self.height_scale * texture_unit,
            near: 1e-7 * (length + width),
        })
    }
}

//! In: an OBJ file nobody described. Out: a scene with a camera and a light that fit its size.
//!
//! A room is seen from inside, or through its open side; anything else from in front and above, on a floor of its own.

use std::path::Path;

use super::bvh::{Triangle, TriangleSet};
use super::{Camera, Light, Ray, Scene, SceneError, Vec3, mesh};

/// Eye rays below this weight end, unless the scene says otherwise: 1/4 of an 8-bit level.
pub(super) const LEAST_WEIGHT: f64 = 1e-3;

const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);

pub(super) fn from_obj(path: &Path, name: &str) -> Result<Scene, SceneError> {
    let mut mesh = mesh::load(path)?;
    let corners = || mesh.triangles.iter().flat_map(|t| t.corners);
    let low = corners().fold(mesh.triangles[0].corners[0], Vec3::min);
    let high = corners().fold(low, Vec3::max);
    let mut notes = mesh.notes.lines();

    let set = TriangleSet::new(&mesh.triangles, mesh.materials.clone());
    let view = View { set: &set, middle: (low + high) * 0.5, half: (high - low) * 0.5 };
    let (camera, light) = if view.is_room() {
        notes.push("camera and light are guessed, for a room".to_owned());
        inside(&view)
    } else {
        notes.push("camera and light are guessed, for a thing on a floor, which is added".to_owned());
        mesh.triangles.extend(floor(low, high, mesh.materials.len() as u32));
        mesh.materials.push(mesh::GREY);
        outside(low, high)
    };
    let triangles = Some(TriangleSet::new(&mesh.triangles, mesh.materials));
    Ok(Scene {
        name: name.to_owned(),
        notes,
        spheres: Vec::new(),
        triangles,
        camera,
        light,
        least_weight: LEAST_WEIGHT,
    })
}

const X: Vec3 = Vec3::new(1.0, 0.0, 0.0);
const Z: Vec3 = Vec3::new(0.0, 0.0, 1.0);

/// How far from the middle the first surface in a direction is, and how far the box reaches.
struct View<'a> {
    set: &'a TriangleSet,
    middle: Vec3,
    half: Vec3,
}

impl View<'_> {
    fn reach(&self, direction: Vec3) -> f64 {
        self.half.dot(direction.scale(direction))
    }

    fn wall(&self, origin: Vec3, direction: Vec3) -> Option<f64> {
        let hit = self.set.nearest(&Ray { origin, direction }, super::FAR)?;
        Some((hit.position - origin).length())
    }

    /// Of 25 parallel rays from the middle plane, whether most do as `wanted`: furniture stops some.
    fn most(&self, direction: Vec3, wanted: impl Fn(Option<f64>) -> bool) -> bool {
        let (u, v) = (
            Vec3::new(direction.y, direction.z, direction.x),
            Vec3::new(direction.z, direction.x, direction.y),
        );
        let offset = |axis: Vec3, i: i32| axis * (0.3 * f64::from(i) * self.reach(axis));
        let rays = (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j)));
        let doing =
            rays.filter(|&(i, j)| wanted(self.wall(self.middle + offset(u, i) + offset(v, j), direction)));
        doing.count() > 12
    }

    /// Seen from the middle, a room's walls are where its box is; a solid thing's are mostly nearer, or absent.
    fn is_room(&self) -> bool {
        let is_wall =
            |&&d: &&Vec3| self.most(d, |wall| wall.is_some_and(|distance| distance > 0.8 * self.reach(d)));
        [X, -X, UP, -UP, Z, -Z].iter().filter(is_wall).count() >= 4
    }
}

/// A room open to one side, as a Cornell box, is seen through the opening; any other along its longer side.
fn inside(view: &View<'_>) -> (Camera, Light) {
    let (middle, half) = (view.middle, view.half);
    let light = middle + UP * (0.7 * view.wall(middle, UP).unwrap_or(half.y));
    let light = shine(light, 2.0 * half.length());
    if let Some(opening) = [Z, -Z, X, -X].into_iter().find(|&d| view.most(d, |wall| wall.is_none())) {
        let across = half.y.max(half.dot(opening.cross(UP).scale(opening.cross(UP))) / 1.3);
        let away = view.reach(opening) + 1.05 * across / 20f64.to_radians().tan();
        return (Camera::look_at(middle + opening * away, middle, UP, 40.0), light);
    }
    let along = if half.x >= half.z { X } else { Z };
    let eye = middle - along * (0.9 * view.wall(middle, -along).unwrap_or(view.reach(along)));
    (Camera::look_at(eye, middle - UP * (0.2 * half.y), UP, 65.0), light)
}

fn outside(low: Vec3, high: Vec3) -> (Camera, Light) {
    let size = (high - low).length();
    let middle = (low + high) * 0.5;
    // 40 degrees across see a ball of this diameter from 1.46 diameters.
    let eye = middle + Vec3::new(0.35, 0.45, 1.0).normalised() * (1.4 * size);
    let light = middle + Vec3::new(-0.6, 1.2, 0.9).normalised() * size;
    (Camera::look_at(eye, middle, UP, 40.0), shine(light, 5.0 * size))
}

/// Bright enough to light grey walls this far apart to a middle tone.
fn shine(position: Vec3, across: f64) -> Light {
    Light { position, intensity: Vec3::splat(0.08 * across * across) }
}

/// Two triangles under the model, looking up.
fn floor(low: Vec3, high: Vec3, material: u32) -> [Triangle; 2] {
    let middle = (low + high) * 0.5;
    let reach = 2.0 * (high - low).length();
    let at = |x: f64, z: f64| Vec3::new(middle.x + x * reach, low.y, middle.z + z * reach);
    let (a, b, c, d) = (at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0));
    [[a, b, c], [a, c, d]].map(|corners| Triangle { corners, material })
}

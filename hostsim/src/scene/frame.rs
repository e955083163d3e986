//! In: an OBJ file nobody described. Out: a scene with a camera and a light that fit its size.
//!
//! A room is seen from inside, or through its open side; anything else from in front and above, on a ground of its own.

use std::path::Path;

use super::bvh::{Triangle, TriangleSet};
use super::{Camera, Light, Ray, Scene, SceneError, Vec3, materials, mesh};

/// Eye rays below this weight end, unless the scene says otherwise: 1/4 of an 8-bit level.
pub(super) const LEAST_WEIGHT: f64 = 1e-3;

const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);

pub(super) fn from_obj(path: &Path, name: &str) -> Result<Scene, SceneError> {
    let mut mesh = mesh::load(path)?;
    let corners = || mesh.triangles.iter().flat_map(|t| t.corners);
    let low = corners().fold(mesh.triangles[0].corners[0], Vec3::min);
    let high = corners().fold(low, Vec3::max);
    let file = mesh::file_name(path);
    let mut notes = mesh.notes.lines(&file);

    let set = TriangleSet::new(&mesh.triangles, mesh.materials.clone());
    let facing = facing(&mesh.triangles, (low + high) * 0.5);
    let view = View { set: &set, middle: (low + high) * 0.5, half: (high - low) * 0.5, facing };
    let guess = if view.is_room() {
        inside(&view)
    } else {
        let mut guess = outside(low, high);
        if view.has_ground() {
            guess.ground = ", no ground added, for it has its own".to_owned();
        } else {
            // Below, not at, the lowest level: photons between two coincident surfaces would never leave.
            let y = low.y - GAP * (high - low).length();
            mesh.triangles.extend(floor(low, high, y, mesh.materials.len() as u32));
            mesh.materials.push(materials::GREY);
            guess.ground = format!(", a ground added at y = {}", short(y));
        }
        guess
    };
    notes.push(format!("{file}: {guess}"));
    let Guess { camera, light, .. } = guess;
    let triangles = Some(TriangleSet::new(&mesh.triangles, mesh.materials));
    Ok(Scene {
        name: name.to_owned(),
        notes,
        spheres: Vec::new(),
        triangles,
        displaced: Vec::new(),
        camera,
        light,
        least_weight: LEAST_WEIGHT,
    })
}

/// How far below the lowest point the ground is, as a share of the diagonal.
const GAP: f64 = 1e-3;
/// Above this the winding decides for a thing: furnished rooms, and walls with an outer side, stay below.
const OUTWARD: f64 = 0.8;
/// A room without straight walls must be wound inward almost everywhere.
const INWARD: f64 = -0.95;

/// What was chosen, and how to say it.
struct Guess {
    seen: &'static str,
    camera: Camera,
    target: Vec3,
    light: Light,
    ground: String,
}

impl core::fmt::Display for Guess {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let at = |p: Vec3| p.to_array().map(short).join(", ");
        let (eye, target, light) = (at(self.camera.eye), at(self.target), at(self.light.position));
        write!(f, "{}, camera ({eye}) looking at ({target}), light at ({light}){}", self.seen, self.ground)?;
        f.write_str("; a .toml file sets them, see docs/scenes.md")
    }
}

/// Four significant digits or so.
fn short(x: f64) -> String {
    let digits = if x == 0.0 { 0 } else { (3 - x.abs().log10().floor() as i32).clamp(0, 12) };
    let text = format!("{x:.*}", digits as usize);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// From -1, every face turned to the middle, to 1, every face turned away; each counts with the volume below it.
fn facing(triangles: &[Triangle], middle: Vec3) -> f64 {
    let volume = |t: &Triangle| t.area_vector().dot(t.corners[0] - middle);
    let (sum, all) = triangles.iter().map(volume).fold((0.0, 0.0), |(s, a), v| (s + v, a + v.abs()));
    if all > 0.0 { sum / all } else { 0.0 }
}

const X: Vec3 = Vec3::new(1.0, 0.0, 0.0);
const Z: Vec3 = Vec3::new(0.0, 0.0, 1.0);

/// How far from the middle the first surface in a direction is, and how far the box reaches.
struct View<'a> {
    set: &'a TriangleSet,
    middle: Vec3,
    half: Vec3,
    facing: f64,
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

    /// The horizontal direction in which the model is open, as a Cornell box is.
    fn opening(&self) -> Option<Vec3> {
        [Z, -Z, X, -X].into_iter().find(|&d| self.most(d, |wall| wall.is_none()))
    }

    /// The winding decides when it is decisive: a closed thing wound outward is seen from outside. Else, seen from the middle,
    /// a room's walls are where its box is; a solid thing's are mostly nearer, or absent.
    fn is_room(&self) -> bool {
        let sides = [X, -X, UP, -UP, Z, -Z];
        if self.facing > OUTWARD && self.opening().is_none() {
            return false;
        }
        if self.facing < INWARD && sides.iter().all(|&d| self.wall(self.middle, d).is_some()) {
            return true;
        }
        let is_wall =
            |&&d: &&Vec3| self.most(d, |wall| wall.is_some_and(|distance| distance > 0.8 * self.reach(d)));
        sides.iter().filter(is_wall).count() >= 4
    }

    /// Whether a large horizontal face at the lowest level is seen from above, around or instead of what stands on it.
    fn has_ground(&self) -> bool {
        const SIDE: i32 = 9;
        let size = 2.0 * self.half.length();
        let low = self.middle.y - self.half.y;
        let offset = |i: i32| f64::from(2 * i + 1 - SIDE) / f64::from(SIDE);
        let rays = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j)));
        let grounded = rays.filter(|&(i, j)| {
            let shift = Vec3::new(offset(i) * self.half.x, self.half.y + size, offset(j) * self.half.z);
            let ray = Ray { origin: self.middle + shift, direction: -UP };
            let hit = self.set.nearest(&ray, super::FAR);
            hit.is_some_and(|h| h.position.y < low + 0.02 * size && h.normal.y.abs() > 0.99)
        });
        4 * grounded.count() as i32 >= SIDE * SIDE
    }
}

/// A room open to one side, as a Cornell box, is seen through the opening; any other along its longer side.
fn inside(view: &View<'_>) -> Guess {
    let (middle, half) = (view.middle, view.half);
    let light = middle + UP * (0.7 * view.wall(middle, UP).unwrap_or(half.y));
    let light = shine(light, 2.0 * half.length());
    let guess = |seen, eye, target, angle| {
        let camera = Camera::look_at(eye, target, UP, angle);
        Guess { seen, camera, target, light, ground: String::new() }
    };
    if let Some(opening) = view.opening() {
        let across = half.y.max(half.dot(opening.cross(UP).scale(opening.cross(UP))) / 1.3);
        let away = view.reach(opening) + 1.05 * across / 20f64.to_radians().tan();
        return guess("seen as a room through its open side", middle + opening * away, middle, 40.0);
    }
    let along = if half.x >= half.z { X } else { Z };
    let eye = middle - along * (0.9 * view.wall(middle, -along).unwrap_or(view.reach(along)));
    guess("seen as a room from inside", eye, middle - UP * (0.2 * half.y), 65.0)
}

fn outside(low: Vec3, high: Vec3) -> Guess {
    let size = (high - low).length();
    let middle = (low + high) * 0.5;
    // 40 degrees across see a ball of this diameter from 1.46 diameters.
    let eye = middle + Vec3::new(0.35, 0.45, 1.0).normalised() * (1.4 * size);
    let light = middle + Vec3::new(-0.6, 1.2, 0.9).normalised() * size;
    let camera = Camera::look_at(eye, middle, UP, 40.0);
    let light = shine(light, 5.0 * size);
    Guess { seen: "seen from outside", camera, target: middle, light, ground: String::new() }
}

/// Bright enough to light grey walls this far apart to a middle tone.
fn shine(position: Vec3, across: f64) -> Light {
    Light { position, intensity: Vec3::splat(0.08 * across * across) }
}

/// Two triangles under the model, looking up.
fn floor(low: Vec3, high: Vec3, y: f64, material: u32) -> [Triangle; 2] {
    let middle = (low + high) * 0.5;
    let reach = 2.0 * (high - low).length();
    let at = |x: f64, z: f64| Vec3::new(middle.x + x * reach, y, middle.z + z * reach);
    let (a, b, c, d) = (at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0));
    [[a, b, c], [a, c, d]].map(|corners| Triangle { corners, material })
}

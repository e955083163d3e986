//! In: camera and scene. Out: the hit points, row by row. Cost: one path tree a pixel.

use rayon::prelude::*;

use super::surface::{GREATEST_DEPTH, Glass, glass, recorded_normal, reflected};
use crate::scene::{Material, Ray, Scene, Vec3};

/// A visible diffuse surface point whose radiance is to be estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitPoint {
    /// Where.
    pub position: Vec3,
    /// The surface's normal.
    pub normal: Vec3,
    /// The surface's colour times what the path from the eye has left of it.
    pub colour: Vec3,
    /// The pixel it adds to: x + y * width.
    pub pixel: u32,
}

/// Traces one ray through the middle of each pixel. A path through glass can leave many hit points.
///
/// The order is that of creation: hit-point number 0 is the oldest. Pixel numbers are 32-bit, so `width * height` must fit.
pub fn eye_pass(scene: &Scene, width: u32, height: u32) -> Vec<HitPoint> {
    let plane = scene.camera().plane(width, height);
    let row = |y: u32| {
        let mut points = Vec::with_capacity(2 * width as usize);
        for x in 0..width {
            let mut path = EyePath { scene, pixel: x + y * width, points: &mut points };
            path.follow(plane.ray(x, y), 1, Vec3::ONE);
        }
        points
    };
    let rows: Vec<Vec<HitPoint>> = (0..height).into_par_iter().map(row).collect();
    rows.concat()
}

struct EyePath<'a> {
    scene: &'a Scene,
    pixel: u32,
    points: &'a mut Vec<HitPoint>,
}

impl EyePath<'_> {
    /// `weight` is what the path so far leaves of the light.
    fn follow(&mut self, ray: Ray, depth: usize, weight: Vec3) {
        let Some(hit) = self.scene.nearest(&ray).filter(|_| depth < GREATEST_DEPTH) else { return };
        match hit.material {
            Material::Diffuse { colour } => self.points.push(HitPoint {
                position: hit.position,
                normal: recorded_normal(&ray, &hit),
                colour: colour.scale(weight),
                pixel: self.pixel,
            }),
            Material::Mirror { colour } => {
                self.follow(reflected(&ray, &hit), depth + 1, colour.scale(weight));
            }
            Material::Glass { colour, index } => match glass(&ray, &hit, index) {
                Glass::Reflects => self.follow(reflected(&ray, &hit), depth + 1, weight),
                Glass::Splits { refracted, share } => {
                    let weight = colour.scale(weight);
                    self.branch(reflected(&ray, &hit), depth + 1, weight * share);
                    self.branch(refracted, depth + 1, weight * (1.0 - share));
                }
            },
        }
    }

    /// Glass in sight of glass doubles the rays at each bounce; a floor on their weight keeps that in bounds.
    fn branch(&mut self, ray: Ray, depth: usize, weight: Vec3) {
        if weight.largest() >= self.scene.least_weight() {
            self.follow(ray, depth, weight);
        }
    }
}

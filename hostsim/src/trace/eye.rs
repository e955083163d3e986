//! In: camera and scene. Out: the hit points, row by row. Cost: one path tree a pixel.

use rayon::prelude::*;

use super::displaced::{Displacer, Flat, Wait, ask};
use super::surface::{GREATEST_DEPTH, Glass, glass, recorded_normal, reflected};
use crate::scene::{Hit, Material, Ray, Scene, Vec3};

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

/// Traces one ray through the middle of each pixel. A path through glass can leave many hit points. Displaced surfaces are
/// [`Flat`].
///
/// The order is that of creation: hit-point number 0 is the oldest. Pixel numbers are 32-bit, so `width * height` must fit.
pub fn eye_pass(scene: &Scene, width: u32, height: u32) -> Vec<HitPoint> {
    let Ok(points) = eye_pass_through(scene, width, height, &mut Flat);
    points
}

/// Like [`eye_pass`], with displaced surfaces as `displacer` finds them.
///
/// # Errors
/// The displacer's.
pub fn eye_pass_through<D: Displacer>(
    scene: &Scene,
    width: u32,
    height: u32,
    displacer: &mut D,
) -> Result<Vec<HitPoint>, D::Error> {
    /// A displacer gets the rays of about so many pixels at a time.
    const WAVE: u32 = 1 << 16;
    let rows = if scene.displaced().is_empty() { height } else { WAVE / width.max(1) };
    in_waves(scene, width, height, rows.max(1), displacer)
}

fn in_waves<D: Displacer>(
    scene: &Scene,
    width: u32,
    height: u32,
    rows: u32,
    displacer: &mut D,
) -> Result<Vec<HitPoint>, D::Error> {
    let plane = scene.camera().plane(width, height);
    let row = |y: u32| {
        let mut row = Row { points: Vec::with_capacity(2 * width as usize), waits: Vec::new() };
        for x in 0..width {
            let mut path = EyePath { scene, pixel: x + y * width, row: &mut row };
            path.follow(plane.ray(x, y), 1, Vec3::ONE);
        }
        row
    };
    let mut points: Vec<HitPoint> = Vec::new();
    for first in (0..height).step_by(rows as usize) {
        let wave: Vec<Row> =
            (first..height.min(first.saturating_add(rows))).into_par_iter().map(row).collect();
        points.reserve(wave.iter().map(|row| row.points.len()).sum());
        let (mut waits, mut numbers) = (Vec::new(), Vec::new());
        for row in &wave {
            numbers.extend(row.waits.iter().map(|(number, _)| points.len() + number));
            waits.extend(row.waits.iter().map(|(_, wait)| *wait));
            points.extend_from_slice(&row.points);
        }
        // A displaced surface is diffuse: its hit points wait, but no path goes on from them.
        for (number, spot) in numbers.into_iter().zip(ask(scene, displacer, &waits)?) {
            let point = &mut points[number];
            point.position = spot.position;
            point.normal = spot.normal;
            point.colour = spot.colour.scale(point.colour);
        }
    }
    Ok(points)
}

/// A row of pixels.
struct Row {
    points: Vec<HitPoint>,
    /// Hit points by number that wait for a displacer. Their colour is what the path so far leaves of the light.
    waits: Vec<(usize, Wait)>,
}

struct EyePath<'a> {
    scene: &'a Scene,
    pixel: u32,
    row: &'a mut Row,
}

impl EyePath<'_> {
    /// `weight` is what the path so far leaves of the light.
    fn follow(&mut self, ray: Ray, depth: usize, weight: Vec3) {
        let Some(hit) = self.scene.nearest(&ray).filter(|_| depth < GREATEST_DEPTH) else { return };
        match hit.material {
            Material::Diffuse { colour } => self.leave(&ray, &hit, colour.scale(weight)),
            Material::Displaced { surface } => {
                let wait = Wait { surface, point: hit.position, direction: ray.direction };
                self.row.waits.push((self.row.points.len(), wait));
                self.leave(&ray, &hit, weight);
            }
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

    fn leave(&mut self, ray: &Ray, hit: &Hit, colour: Vec3) {
        let (position, normal) = (hit.position, recorded_normal(ray, hit));
        self.row.points.push(HitPoint { position, normal, colour, pixel: self.pixel });
    }

    /// Glass in sight of glass doubles the rays at each bounce; a floor on their weight keeps that in bounds.
    fn branch(&mut self, ray: Ray, depth: usize, weight: Vec3) {
        if weight.largest() >= self.scene.least_weight() {
            self.follow(ray, depth, weight);
        }
    }
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;

    use super::super::{Answer, Request};
    use super::*;
    use crate::scene::LoadOptions;

    /// An answer of the request alone, unlike its neighbours'.
    struct Rough;

    impl Displacer for Rough {
        type Error = Infallible;

        fn answer(
            &mut self,
            _: usize,
            requests: &[Request],
            answers: &mut Vec<Answer>,
        ) -> Result<(), Infallible> {
            answers.extend(requests.iter().map(|r| {
                let [a, b] = r.entry.map(|x| (x * 97.0).fract().abs());
                Answer { t: a, normal: Vec3::new(a, b, 1.0), colour: Vec3::new(b, a, 1.0) }
            }));
            Ok(())
        }
    }

    /// However many rows are a wave; through glass a pixel has many points, some of which wait.
    #[test]
    fn waves_do_not_show() {
        let scene = Scene::load("relief-room", &LoadOptions::default()).unwrap();
        let Ok(whole) = in_waves(&scene, 40, 30, 30, &mut Rough);
        let Ok(flat) = in_waves(&scene, 40, 30, 30, &mut Flat);
        assert!(whole.len() > 40 * 30);
        let moved = whole.iter().zip(&flat).filter(|(a, b)| a.position != b.position).count();
        assert!(moved > 300 && moved < whole.len() - 300, "{moved}");
        assert!(whole.iter().zip(&flat).all(|(a, b)| a.pixel == b.pixel));
        for rows in [1, 4, 7, 29, u32::MAX] {
            let Ok(points) = in_waves(&scene, 40, 30, rows, &mut Rough);
            assert_eq!(points, whole, "{rows}");
        }
    }
}

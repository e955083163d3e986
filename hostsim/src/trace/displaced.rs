//! In: rays that wait at displaced surfaces. Out: where each hits and what is there, by whoever answers. Cost: one call a
//! surface and wave.
//!
//! What a hit does to the path, in the words of [`Displaced`]: the point is on the ray, at the depth that was found; where a wall of
//! the pit is nearer, on the wall. Photons go on from the lid, over the hit point, because the unit's rays begin there: the
//! relief does not shade itself, and a direction that would lead down into it is mirrored at the lid.

use core::convert::Infallible;

use crate::scene::{Displaced, Ray, Scene, Vec3};

/// A ray that meets a displaced surface's lid from in front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// Texture coordinate where it does.
    pub entry: [f64; 2],
    /// Direction in the world, of length one, away from where it comes from.
    pub view: Vec3,
}

/// What such a ray hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Depth of the hit: 0 the lid, 1 the lowest a map can be.
    pub t: f64,
    /// The relief's normal there, in tangent space.
    pub normal: Vec3,
    /// Its colour there, without [`Displaced::colour`].
    pub colour: Vec3,
}

impl Answer {
    /// That the lid is hit, as of a surface without relief.
    pub const fn flat(colour: Vec3) -> Self {
        Self { t: 0.0, normal: Vec3::new(0.0, 0.0, 1.0), colour }
    }
}

/// Who knows what displaced surfaces look like.
pub trait Displacer {
    /// Why there is no answer.
    type Error;

    /// Appends the answers to `requests`, in their order, about [`Scene::displaced`] number `surface`. An answer depends on its
    /// request alone, not on the others.
    ///
    /// # Errors
    /// No answer, and the tracing ends.
    fn answer(
        &mut self,
        surface: usize,
        requests: &[Request],
        answers: &mut Vec<Answer>,
    ) -> Result<(), Self::Error>;
}

/// Takes displaced surfaces as flat and without texture.
#[derive(Clone, Copy, Debug)]
pub struct Flat;

impl Displacer for Flat {
    type Error = Infallible;

    fn answer(
        &mut self,
        _: usize,
        requests: &[Request],
        answers: &mut Vec<Answer>,
    ) -> Result<(), Infallible> {
        answers.extend(requests.iter().map(|_| Answer::flat(Vec3::ONE)));
        Ok(())
    }
}

/// A path that waits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wait {
    pub surface: usize,
    /// On the lid.
    pub point: Vec3,
    pub direction: Vec3,
}

/// Where it has come to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub position: Vec3,
    pub normal: Vec3,
    pub colour: Vec3,
    /// The point of the lid over it.
    over: Vec3,
    lid: Vec3,
}

impl Spot {
    fn new(surface: &Displaced, wait: &Wait, answer: &Answer) -> Self {
        let (point, direction) = (wait.point, wait.direction);
        let descent = -surface.normal().dot(direction);
        let distance = answer.t.clamp(0.0, 1.0) * surface.depth() / descent;
        let wall = surface.wall(point, direction);
        let (distance, normal) = if wall.distance < distance {
            (wall.distance, wall.normal)
        } else {
            (distance, surface.to_world(answer.normal))
        };
        let position = point + direction * distance;
        let colour = answer.colour.scale(surface.colour());
        Self { position, normal, colour, over: surface.over(position), lid: surface.normal() }
    }

    /// The ray that goes on in a direction.
    pub fn leave(&self, direction: Vec3) -> Ray {
        let up = self.lid.dot(direction);
        let direction = if up < 0.0 { direction - self.lid * (2.0 * up) } else { direction };
        Ray { origin: self.over, direction }
    }
}

/// Asks for all that wait, surface by surface; the answers are in the order of `waits`.
pub(super) fn ask<D: Displacer>(
    scene: &Scene,
    displacer: &mut D,
    waits: &[Wait],
) -> Result<Vec<Spot>, D::Error> {
    let mut spots: Vec<Option<Spot>> = vec![None; waits.len()];
    let (mut requests, mut answers) = (Vec::new(), Vec::new());
    for (number, surface) in scene.displaced().iter().enumerate() {
        let here = || waits.iter().enumerate().filter(|(_, wait)| wait.surface == number);
        requests.clear();
        requests.extend(
            here().map(|(_, wait)| Request { entry: surface.entry(wait.point), view: wait.direction }),
        );
        answers.clear();
        if !requests.is_empty() {
            displacer.answer(number, &requests, &mut answers)?;
        }
        assert_eq!(answers.len(), requests.len(), "a displacer answers every request");
        for ((place, wait), answer) in here().zip(&answers) {
            spots[place] = Some(Spot::new(surface, wait, answer));
        }
    }
    Ok(spots.into_iter().map(|spot| spot.expect("every wait is at one of the scene's surfaces")).collect())
}

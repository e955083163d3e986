//! What a ray does at a surface: the part eye rays and photons share.

use super::halton::halton;
use crate::scene::{Hit, PI, Ray, Vec3};

/// A path ends, untreated, at this hit.
pub(super) const GREATEST_DEPTH: usize = 20;

/// A cosine-weighted direction about `axis`, from two samples.
pub(super) fn scatter(axis: Vec3, dimension: usize, index: u32) -> Vec3 {
    let r1 = 2.0 * PI * halton(dimension, index);
    let r2 = halton(dimension + 1, index);
    let r2s = r2.sqrt();
    let aside = if axis.x.abs() > 0.1 { Vec3::new(0.0, 1.0, 0.0) } else { Vec3::new(1.0, 0.0, 0.0) };
    let u = aside.cross(axis).normalised();
    let v = axis.cross(u);
    (u * r1.cos() * r2s + v * r1.sin() * r2s + axis * (1.0 - r2).sqrt()).normalised()
}

/// The mirrored ray.
pub(super) fn reflected(ray: &Ray, hit: &Hit) -> Ray {
    let direction = ray.direction - hit.normal * 2.0 * hit.normal.dot(ray.direction);
    Ray { origin: hit.position, direction }
}

/// The normal turned against the ray.
pub(super) fn facing(ray: &Ray, hit: &Hit) -> Vec3 {
    if hit.normal.dot(ray.direction) < 0.0 { hit.normal } else { -hit.normal }
}

/// The normal that goes into the records.
pub(super) fn recorded_normal(ray: &Ray, hit: &Hit) -> Vec3 {
    if hit.two_sided { facing(ray, hit) } else { hit.normal }
}

/// What glass does to a ray.
pub(super) enum Glass {
    /// Total reflection.
    Reflects,
    /// Both ways.
    Splits {
        /// The refracted ray.
        refracted: Ray,
        /// The share that is reflected (Schlick's approximation).
        share: f64,
    },
}

/// Splits a ray at a glass surface.
pub(super) fn glass(ray: &Ray, hit: &Hit, index: f64) -> Glass {
    let nl = facing(ray, hit);
    let into = hit.normal.dot(nl) > 0.0;
    let (nc, nt) = (1.0, index);
    let ratio = if into { nc / nt } else { nt / nc };
    let ddn = ray.direction.dot(nl);
    let cos2t = 1.0 - ratio * ratio * (1.0 - ddn * ddn);
    if cos2t < 0.0 {
        return Glass::Reflects;
    }
    let side = if into { 1.0 } else { -1.0 };
    let direction = (ray.direction * ratio - hit.normal * (side * (ddn * ratio + cos2t.sqrt()))).normalised();
    let (a, b) = (nt - nc, nt + nc);
    let r0 = a * a / (b * b);
    let c = 1.0 - if into { -ddn } else { direction.dot(hit.normal) };
    let share = r0 + (1.0 - r0) * c * c * c * c * c;
    Glass::Splits { refracted: Ray { origin: hit.position, direction }, share }
}

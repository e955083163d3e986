//! In: a range of photon numbers. Out: their surface hits, in order. Cost: about three scene queries a photon.

use core::ops::Range;

use rayon::prelude::*;

use super::halton::halton;
use super::surface::{GREATEST_DEPTH, Glass, facing, glass, recorded_normal, reflected, scatter};
use crate::grid::{HashGrid, List};
use crate::scene::{Light, Material, PI, Ray, Scene, Vec3};

/// A photon at a diffuse surface: what the engine calls a photon once its cell's list is added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit {
    /// Where.
    pub position: Vec3,
    /// The surface's normal.
    pub normal: Vec3,
    /// What the photon carries.
    pub flux: Vec3,
}

/// Photon number `index` as it leaves the light: its ray and its flux.
pub fn emit(light: &Light, index: u32) -> (Ray, Vec3) {
    let p = 2.0 * PI * halton(0, index);
    let t = 2.0 * (1.0 - halton(1, index)).sqrt().acos();
    let st = t.sin();
    let direction = Vec3::new(p.cos() * st, t.cos(), p.sin() * st);
    (Ray { origin: light.position, direction }, light.intensity * (PI * 4.0))
}

/// Follows the photons of `range` and appends their surface hits, photon by photon, bounce by bounce.
pub fn trace_photons(scene: &Scene, range: Range<u32>, hits: &mut Vec<SurfaceHit>) {
    /// Enough work for a thread to be worth its start.
    const BATCH: u32 = 512;
    let starts: Vec<u32> = range.clone().step_by(BATCH as usize).collect();
    let batches: Vec<Vec<SurfaceHit>> = starts
        .into_par_iter()
        .map(|start| {
            let mut hits = Vec::with_capacity(4 * BATCH as usize);
            for index in start..range.end.min(start.saturating_add(BATCH)) {
                follow(scene, index, &mut hits);
            }
            hits
        })
        .collect();
    for batch in &batches {
        hits.extend_from_slice(batch);
    }
}

/// One photon from the light to its end. Photons never split, so this is a loop.
fn follow(scene: &Scene, index: u32, hits: &mut Vec<SurfaceHit>) {
    let (mut ray, mut flux) = emit(scene.light(), index);
    for depth in 1..GREATEST_DEPTH {
        let Some(hit) = scene.nearest(&ray) else { return };
        let d3 = 3 * depth;
        match hit.material {
            Material::Diffuse { colour } => {
                hits.push(SurfaceHit { position: hit.position, normal: recorded_normal(&ray, &hit), flux });
                let survival = colour.largest();
                if halton(d3 + 1, index) >= survival {
                    return;
                }
                ray = Ray { origin: hit.position, direction: scatter(facing(&ray, &hit), d3 - 1, index) };
                flux = colour.scale(flux) * (1.0 / survival);
            }
            Material::Mirror { colour } => {
                ray = reflected(&ray, &hit);
                flux = colour.scale(flux);
            }
            Material::Glass { index: refraction, .. } => {
                ray = match glass(&ray, &hit, refraction) {
                    Glass::Splits { refracted, share } if halton(d3 - 1, index) >= share => refracted,
                    _ => reflected(&ray, &hit),
                };
            }
        }
    }
}

/// The ranges 0..size, size..2·size, … up to `emitted` photons: what a host holds in memory at a time.
pub fn chunks(emitted: u32, size: u32) -> impl ExactSizeIterator<Item = Range<u32>> {
    let size = size.max(1);
    (0..emitted.div_ceil(size)).map(move |i| i * size..emitted.min((i * size).saturating_add(size)))
}

/// A chunk of photons as the engine is given them: surface hits and, for each, the list of its cell.
#[derive(Clone, Debug, Default)]
pub struct PhotonChunk {
    /// In the order they happened.
    pub hits: Vec<SurfaceHit>,
    /// `lists[i]` belongs to `hits[i]`; it may be empty (D9).
    pub lists: Vec<List>,
}

impl PhotonChunk {
    /// Replaces the content by the hits of the photons in `range`; the allocations are kept.
    pub fn fill(&mut self, scene: &Scene, grid: &HashGrid, range: Range<u32>) {
        self.hits.clear();
        trace_photons(scene, range, &mut self.hits);
        self.lists.clear();
        self.lists.extend(self.hits.iter().map(|h| grid.lookup(h.position)));
    }

    /// Number of surface hits.
    pub fn len(&self) -> usize {
        self.hits.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.hits.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_cover_every_photon_once() {
        for (emitted, size) in [(0, 4), (1, 4), (8, 4), (9, 4), (u32::MAX, u32::MAX), (5, 0)] {
            let mut next = 0;
            for range in chunks(emitted, size) {
                assert_eq!(range.start, next);
                assert!(!range.is_empty());
                next = range.end;
            }
            assert_eq!(next, emitted);
        }
    }
}

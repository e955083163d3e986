//! In: a range of photon numbers. Out: their surface hits, in order. Cost: about three scene queries a photon.

use core::ops::Range;

use rayon::prelude::*;

use super::displaced::{Displacer, Flat, Spot, Wait, ask};
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

/// Follows the photons of `range` and appends their surface hits, photon by photon, bounce by bounce. Displaced surfaces are
/// [`Flat`].
pub fn trace_photons(scene: &Scene, range: Range<u32>, hits: &mut Vec<SurfaceHit>) {
    let Ok(()) = trace_photons_through(scene, range, hits, &mut Flat);
}

/// Like [`trace_photons`], with displaced surfaces as `displacer` finds them.
///
/// Photons run until they end or meet a displaced surface; those that wait are asked for in one wave, go on, and wait again.
/// The hits are the same for any division into ranges.
///
/// # Errors
/// The displacer's; `hits` is as it was.
pub fn trace_photons_through<D: Displacer>(
    scene: &Scene,
    range: Range<u32>,
    hits: &mut Vec<SurfaceHit>,
    displacer: &mut D,
) -> Result<(), D::Error> {
    /// Enough work for a thread to be worth its start.
    const BATCH: u32 = 512;
    let starts: Vec<u32> = range.clone().step_by(BATCH as usize).collect();
    let mut batches: Vec<Batch> = starts
        .into_par_iter()
        .map(|start| Batch::trace(scene, start..range.end.min(start.saturating_add(BATCH))))
        .collect();
    loop {
        let mut waiting: Vec<&mut Late> =
            batches.iter_mut().flat_map(|batch| &mut batch.late).filter(|late| late.wait.is_some()).collect();
        if waiting.is_empty() {
            break;
        }
        let waits: Vec<Wait> = waiting.iter().filter_map(|late| late.wait).collect();
        let spots = ask(scene, displacer, &waits)?;
        waiting.par_iter_mut().zip(spots).with_min_len(BATCH as usize).for_each(|(late, spot)| {
            late.wait = late.photon.resume(scene, &spot, &mut late.hits);
        });
    }
    for batch in &batches {
        batch.append_to(hits);
    }
    Ok(())
}

/// Photons of successive numbers.
struct Batch {
    /// Up to each photon's end or first wait.
    hits: Vec<SurfaceHit>,
    late: Vec<Late>,
}

/// A photon that met a displaced surface.
struct Late {
    /// How many of the batch's hits come before those here.
    after: usize,
    photon: Photon,
    wait: Option<Wait>,
    hits: Vec<SurfaceHit>,
}

impl Batch {
    fn trace(scene: &Scene, range: Range<u32>) -> Self {
        let mut batch = Self { hits: Vec::with_capacity(4 * range.len()), late: Vec::new() };
        for index in range {
            let (ray, flux) = emit(scene.light(), index);
            let mut photon = Photon { index, depth: 1, ray, flux };
            if let wait @ Some(_) = photon.follow(scene, &mut batch.hits) {
                batch.late.push(Late { after: batch.hits.len(), photon, wait, hits: Vec::new() });
            }
        }
        batch
    }

    fn append_to(&self, hits: &mut Vec<SurfaceHit>) {
        let mut done = 0;
        for late in &self.late {
            hits.extend_from_slice(&self.hits[done..late.after]);
            hits.extend_from_slice(&late.hits);
            done = late.after;
        }
        hits.extend_from_slice(&self.hits[done..]);
    }
}

/// A photon on its way.
struct Photon {
    index: u32,
    /// Number of the coming hit, from 1.
    depth: usize,
    ray: Ray,
    flux: Vec3,
}

impl Photon {
    /// To its end, or to where it has to wait. Photons never split, so this is a loop.
    #[inline]
    fn follow(&mut self, scene: &Scene, hits: &mut Vec<SurfaceHit>) -> Option<Wait> {
        while self.depth < GREATEST_DEPTH {
            let ray = self.ray;
            let hit = scene.nearest(&ray)?;
            match hit.material {
                Material::Diffuse { colour } => {
                    let normal = recorded_normal(&ray, &hit);
                    hits.push(SurfaceHit { position: hit.position, normal, flux: self.flux });
                    let direction = self.survive(colour, facing(&ray, &hit))?;
                    self.ray = Ray { origin: hit.position, direction };
                }
                Material::Displaced { surface } => {
                    return Some(Wait { surface, point: hit.position, direction: ray.direction });
                }
                Material::Mirror { colour } => {
                    self.ray = reflected(&ray, &hit);
                    self.flux = colour.scale(self.flux);
                }
                Material::Glass { index: refraction, .. } => {
                    self.ray = match glass(&ray, &hit, refraction) {
                        Glass::Splits { refracted, share }
                            if halton(3 * self.depth - 1, self.index) >= share =>
                        {
                            refracted
                        }
                        _ => reflected(&ray, &hit),
                    };
                }
            }
            self.depth += 1;
        }
        None
    }

    /// Goes on from what a displacer found.
    fn resume(&mut self, scene: &Scene, spot: &Spot, hits: &mut Vec<SurfaceHit>) -> Option<Wait> {
        hits.push(SurfaceHit { position: spot.position, normal: spot.normal, flux: self.flux });
        let direction = self.survive(spot.colour, spot.normal)?;
        self.ray = spot.leave(direction);
        self.depth += 1;
        self.follow(scene, hits)
    }

    /// Where a diffuse surface scatters the photon to, if it does not end there.
    #[inline]
    fn survive(&mut self, colour: Vec3, axis: Vec3) -> Option<Vec3> {
        let d3 = 3 * self.depth;
        let survival = colour.largest();
        if halton(d3 + 1, self.index) >= survival {
            return None;
        }
        self.flux = colour.scale(self.flux) * (1.0 / survival);
        Some(scatter(axis, d3 - 1, self.index))
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
    /// Replaces the content by the hits of the photons in `range`; the allocations are kept. Displaced surfaces are [`Flat`].
    pub fn fill(&mut self, scene: &Scene, grid: &HashGrid, range: Range<u32>) {
        let Ok(()) = self.fill_through(scene, grid, range, &mut Flat);
    }

    /// Like [`Self::fill`], with displaced surfaces as `displacer` finds them.
    ///
    /// # Errors
    /// The displacer's; the content is empty.
    pub fn fill_through<D: Displacer>(
        &mut self,
        scene: &Scene,
        grid: &HashGrid,
        range: Range<u32>,
        displacer: &mut D,
    ) -> Result<(), D::Error> {
        self.hits.clear();
        self.lists.clear();
        trace_photons_through(scene, range, &mut self.hits, displacer)?;
        self.lists.extend(self.hits.iter().map(|h| grid.lookup(h.position)));
        Ok(())
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

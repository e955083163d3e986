//! In: photons with their lists. Out: the radiance in f64. Cost: about 60 ns an operation, most of it cache misses.

use super::Counts;
use crate::scene::{PI, Vec3};
use crate::trace::{HitPoint, PhotonChunk};

/// The share α of new photons a shrinking radius keeps.
const ALPHA: f64 = 0.7;
/// Surfaces turned by less than this cosine do not share light.
const FACING: f64 = 1e-3;

/// What every operation reads: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Probe {
    position: Vec3,
    normal: Vec3,
    r2: f64,
    /// N / α of the paper, which is a whole number.
    n: u32,
    pixel: u32,
}

/// What an updating operation writes beside.
#[derive(Clone, Copy, Debug)]
struct Store {
    colour: Vec3,
    flux: Vec3,
}

/// The f64 estimator.
#[derive(Clone, Debug)]
pub struct Reference {
    probes: Vec<Probe>,
    stores: Vec<Store>,
    normal_test: bool,
    counts: Counts,
}

impl Reference {
    /// All hit points start with this search radius, without light.
    pub fn new(points: &[HitPoint], radius: f64, normal_test: bool) -> Self {
        let r2 = radius * radius;
        let probe = |p: &HitPoint| Probe { position: p.position, normal: p.normal, r2, n: 0, pixel: p.pixel };
        let store = |p: &HitPoint| Store { colour: p.colour, flux: Vec3::ZERO };
        Self {
            probes: points.iter().map(probe).collect(),
            stores: points.iter().map(store).collect(),
            normal_test,
            counts: Counts::default(),
        }
    }

    /// Updates every hit point listed for every photon, in order.
    ///
    /// # Panics
    /// When the lists are not those of `entries`.
    pub fn feed(&mut self, chunk: &PhotonChunk, entries: &[u32]) {
        if self.normal_test { self.run::<true>(chunk, entries) } else { self.run::<false>(chunk, entries) }
    }

    fn run<const NORMAL_TEST: bool>(&mut self, chunk: &PhotonChunk, entries: &[u32]) {
        let mut counts = self.counts;
        for (hit, list) in chunk.hits.iter().zip(&chunk.lists) {
            if list.n == 0 {
                counts.empty_cells += 1;
                continue;
            }
            counts.photons += 1;
            counts.operations += u64::from(list.n);
            for &number in &entries[list.p_addr as usize..][..list.n as usize] {
                let probe = &mut self.probes[number as usize];
                let v = probe.position - hit.position;
                if NORMAL_TEST {
                    let facing = probe.normal.dot(hit.normal) > FACING;
                    if !facing {
                        continue;
                    }
                    counts.facing += 1;
                }
                let near = v.dot(v) <= probe.r2;
                if !near {
                    continue;
                }
                counts.updates += 1;
                let n = f64::from(probe.n);
                let g = (n * ALPHA + ALPHA) / (n * ALPHA + 1.0);
                probe.r2 *= g;
                probe.n += 1;
                let store = &mut self.stores[number as usize];
                store.flux = (store.flux + store.colour.scale(hit.flux) * (1.0 / PI)) * g;
            }
        }
        self.counts = counts;
    }

    /// What has been done so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// The picture: each pixel the sum of its hit points' radiance.
    ///
    /// # Panics
    /// When a hit point's pixel is not below `pixels`.
    pub fn radiance(&self, pixels: u32, emitted: u32) -> Vec<[f64; 3]> {
        let mut picture = vec![[0.0; 3]; pixels as usize];
        // The newest first, as the published program adds them.
        for (probe, store) in self.probes.iter().zip(&self.stores).rev() {
            let radiance = store.flux * (1.0 / (PI * probe.r2 * f64::from(emitted)));
            let sum = &mut picture[probe.pixel as usize];
            *sum = (Vec3::from(*sum) + radiance).to_array();
        }
        picture
    }
}

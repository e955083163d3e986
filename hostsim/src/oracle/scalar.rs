//! In: photons with their lists. Out: the state the engine must reach, bit by bit. Cost: f32 about 20 ns an operation.
//!
//! The order of operations is that of the datapath as drawn (D13, D14), one operation after the other: what a pipeline with
//! its hazards resolved must equal.

use super::{Counts, Number};
use crate::scene::Vec3;
use crate::trace::{HitPoint, PhotonChunk};

/// What every operation reads.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
struct Probe<N> {
    position: [N; 3],
    r2: N,
}

/// What an updating operation reads and writes beside.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Store<N> {
    colour: [N; 3],
    flux: [N; 3],
    /// N + α per photon (D14).
    n: N,
}

/// A hit point's changing words, as bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct State {
    /// Accumulated flux τ.
    pub flux: [u32; 3],
    /// Squared search radius.
    pub r2: u32,
    /// Accumulated photon count.
    pub n: u32,
}

/// The scalar estimator in number format `N`.
#[derive(Clone, Debug)]
pub struct Scalar<N> {
    probes: Vec<Probe<N>>,
    normals: Vec<[N; 3]>,
    stores: Vec<Store<N>>,
    pixels: Vec<u32>,
    alpha: N,
    one_over_pi: N,
    facing: N,
    normal_test: bool,
    counts: Counts,
}

fn round<N: Number>(v: Vec3) -> [N; 3] {
    v.to_f32().map(N::from_f32)
}

impl<N: Number> Scalar<N> {
    /// All hit points start with this search radius, without light. Every input goes from f64 to f32 to the format.
    pub fn new(points: &[HitPoint], radius: f64, alpha: f64, normal_test: bool) -> Self {
        let r2 = N::from_f32((radius * radius) as f32);
        let store = |p: &HitPoint| Store { colour: round(p.colour), flux: [N::ZERO; 3], n: N::ZERO };
        Self {
            probes: points.iter().map(|p| Probe { position: round(p.position), r2 }).collect(),
            normals: points.iter().map(|p| round(p.normal)).collect(),
            stores: points.iter().map(store).collect(),
            pixels: points.iter().map(|p| p.pixel).collect(),
            alpha: N::from_f32(alpha as f32),
            one_over_pi: N::from_f32(core::f32::consts::FRAC_1_PI),
            facing: N::from_f32(1e-3),
            normal_test,
            counts: Counts::default(),
        }
    }

    /// Updates every hit point listed for every photon, in order.
    ///
    /// A list is walked from its start although the engine walks it from its end: the photon is the same all along, and so is the
    /// order in which any one hit point, listed twice or not, sees the photons.
    ///
    /// # Panics
    /// When the lists are not those of `entries`.
    pub fn feed(&mut self, chunk: &PhotonChunk, entries: &[u32]) {
        if self.normal_test { self.run::<true>(chunk, entries) } else { self.run::<false>(chunk, entries) }
    }

    fn run<const NORMAL_TEST: bool>(&mut self, chunk: &PhotonChunk, entries: &[u32]) {
        let mut counts = self.counts;
        let alpha = self.alpha;
        for (hit, list) in chunk.hits.iter().zip(&chunk.lists) {
            if list.n == 0 {
                counts.empty_cells += 1;
                continue;
            }
            counts.photons += 1;
            counts.operations += u64::from(list.n);
            let position: [N; 3] = round(hit.position);
            let normal: [N; 3] = round(hit.normal);
            let flux: [N; 3] = round(hit.flux);
            for &number in &entries[list.p_addr as usize..][..list.n as usize] {
                let number = number as usize;
                let probe = &mut self.probes[number];
                let [dx, dy, dz] = [0, 1, 2].map(|c| probe.position[c].sub(position[c]));
                let d2 = dx.mul(dx).add(dy.mul(dy)).add(dz.mul(dz));
                let near = d2 <= probe.r2;
                if !near {
                    continue;
                }
                if NORMAL_TEST {
                    let [x, y, z] = [0, 1, 2].map(|c| self.normals[number][c].mul(normal[c]));
                    let facing = self.facing < x.add(y).add(z);
                    if !facing {
                        continue;
                    }
                    counts.facing += 1;
                }
                counts.updates += 1;
                let store = &mut self.stores[number];
                let n = store.n.add(alpha);
                let g = n.div(store.n.add(N::ONE));
                probe.r2 = probe.r2.mul(g);
                store.flux = [0, 1, 2].map(|c| {
                    let light = store.colour[c].mul(flux[c]).mul(self.one_over_pi);
                    store.flux[c].add(light).mul(g)
                });
                store.n = n;
            }
        }
        self.counts = counts;
    }

    /// What has been done so far. `facing` counts, unlike in the f64 estimator, only what is near enough.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Number of hit points.
    pub fn len(&self) -> usize {
        self.probes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.probes.is_empty()
    }

    /// A hit point's words.
    ///
    /// # Panics
    /// When there is no hit point of this number.
    pub fn state(&self, number: usize) -> State {
        let (probe, store) = (&self.probes[number], &self.stores[number]);
        State { flux: store.flux.map(N::to_bits), r2: probe.r2.to_bits(), n: store.n.to_bits() }
    }

    /// All hit points' words, in order of their numbers.
    pub fn states(&self) -> impl ExactSizeIterator<Item = State> + '_ {
        (0..self.len()).map(|i| self.state(i))
    }

    /// The picture: each pixel the sum of its hit points' radiance, added in the order of `numbers`.
    ///
    /// # Panics
    /// When a number is not one of a hit point, or a hit point's pixel is not below `pixels`.
    pub fn radiance(&self, pixels: u32, emitted: u32, numbers: impl IntoIterator<Item = u32>) -> Vec<[N; 3]> {
        let emitted = N::from_f32(f64::from(emitted) as f32);
        let mut picture = vec![[N::ZERO; 3]; pixels as usize];
        for number in numbers {
            let (probe, store) = (&self.probes[number as usize], &self.stores[number as usize]);
            let share = N::ONE.div(probe.r2.mul(emitted));
            let pixel = &mut picture[self.pixels[number as usize] as usize];
            *pixel = [0, 1, 2].map(|c| pixel[c].add(store.flux[c].mul(self.one_over_pi).mul(share)));
        }
        picture
    }
}

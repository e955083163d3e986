//! The reference workloads, traced once; in: a size, out: hit points, index table, photons; cost: the tracing.

use std::sync::LazyLock;

use hostsim::accelerate::{PhotonSource, Workload};
use hostsim::render::Prepared;
use hostsim::trace::{PhotonChunk, chunks};
use lucerna_driver::records::encode;
use lucerna_driver::{HitPoint, Photon};
use lucerna_regs::pree::Config;

use crate::devices::Kind;
use crate::job::Job;

/// A picture's hit points and photons.
pub struct Traced {
    /// Scene, hit points, index table.
    pub prepared: Prepared,
    /// All photons, in order.
    pub chunks: Vec<PhotonChunk>,
    /// Pixels.
    pub pixels: u32,
    /// Photons emitted.
    pub emitted: u32,
}

/// 20×15 pixels, 1,000 photons: the chip's run (Table III).
pub static SMALL: LazyLock<Traced> = LazyLock::new(|| Traced::new(20, 15, 1_000));
/// 320×240 pixels, 768,000 photons: Fig. 1(a) and Table II.
pub static LARGE: LazyLock<Traced> = LazyLock::new(|| Traced::new(320, 240, 768_000));

impl Traced {
    /// Cornell box with three balls.
    ///
    /// # Panics
    /// When the scene is not there.
    pub fn new(width: u32, height: u32, emitted: u32) -> Self {
        let prepared = Prepared::new("cornell-balls", None, width, height).expect("a built-in scene");
        let chunks = chunks(emitted, 1 << 14)
            .map(|range| {
                let mut chunk = PhotonChunk::default();
                chunk.fill(&prepared.scene, &prepared.grid, range);
                chunk
            })
            .collect();
        Self { prepared, chunks, pixels: width * height, emitted }
    }

    /// As hostsim's accelerator takes it.
    pub fn workload(&self) -> Workload<'_> {
        self.prepared.workload(self.pixels, self.emitted)
    }

    /// The photons as hostsim's accelerator takes them.
    pub fn source(&self) -> Replay<'_> {
        Replay(self.chunks.iter())
    }

    /// Lengths of all photons' lists.
    pub fn lists(&self) -> Vec<u32> {
        self.chunks.iter().flat_map(|chunk| chunk.lists.iter().map(|list| list.n)).collect()
    }

    /// The same work as a job at register level.
    pub fn job(&self, kind: Kind, config: Config) -> Job {
        let format = kind.format;
        Job {
            kind,
            config,
            alpha: encode(format, 0.7),
            emitted: encode(format, self.emitted as f32),
            hits: self.hit_points().iter().map(|point| point.pack(format)).collect(),
            index: self.prepared.grid.entries().to_vec(),
            photons: self.photons().iter().map(|photon| photon.pack_normal(format)).collect(),
            pixels: vec![[0; 3]; self.pixels as usize],
            ring_entries: 256,
            ring_low: 0,
        }
    }

    /// The hit points as the driver takes them.
    pub fn hit_points(&self) -> Vec<HitPoint> {
        let radius = self.prepared.grid.radius();
        let points = self.prepared.points.iter();
        points
            .map(|point| HitPoint {
                position: point.position.to_f32(),
                normal: point.normal.to_f32(),
                colour: point.colour.to_f32(),
                radius_squared: (radius * radius) as f32,
                pixel: point.pixel,
                ..HitPoint::default()
            })
            .collect()
    }

    /// The photons as the driver takes them.
    pub fn photons(&self) -> Vec<Photon> {
        let pairs = self.chunks.iter().flat_map(|chunk| chunk.hits.iter().zip(&chunk.lists));
        pairs
            .map(|(hit, list)| Photon {
                position: hit.position.to_f32(),
                normal: hit.normal.to_f32(),
                flux: hit.flux.to_f32(),
                p_addr: list.p_addr,
                n: list.n,
            })
            .collect()
    }
}

/// Chunks that were traced before.
pub struct Replay<'a>(core::slice::Iter<'a, PhotonChunk>);

impl PhotonSource for Replay<'_> {
    fn next_chunk(&mut self) -> Option<&PhotonChunk> {
        self.0.next()
    }
}

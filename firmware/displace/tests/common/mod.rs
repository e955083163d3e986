//! A device memory with a map, rays and room for results, and the job that is about them.

pub mod any;

use lucerna_displace::job::{Description, Fault, Job, MAP_ALIGNMENT, MapDescription, RayFaults, Source};
use lucerna_displace::pyramid::Shape;
use lucerna_displace::record::RESULT_WORDS;
use lucerna_displace::traverse::Policies;
use lucerna_fabric::window::{Window, Windows};
use lucerna_softfloat::Format;

/// A height field of `1 << log2` texels, row by row.
#[derive(Clone, Debug)]
pub struct Heights {
    pub log2: [u32; 2],
    pub rows: Vec<u8>,
}

impl Heights {
    pub fn new(log2: [u32; 2], height: impl Fn(u32, u32) -> u8) -> Self {
        let (w, h) = (1 << log2[0], 1 << log2[1]);
        let rows = (0..h).flat_map(|y| (0..w).map(move |x| (x, y))).map(|(x, y)| height(x, y)).collect();
        Self { log2, rows }
    }

    /// The highest texel under a node, by looking at all of them.
    fn highest(&self, level: u32, x: u32, y: u32) -> u8 {
        let (w, h) = (1u32 << self.log2[0], 1u32 << self.log2[1]);
        let span = |at: u32, side: u32| (at << level)..((at + 1) << level).min(side);
        span(y, h)
            .flat_map(|y| span(x, w).map(move |x| (x, y)))
            .map(|(x, y)| self.rows[(y * w + x) as usize])
            .max()
            .unwrap()
    }

    /// The pyramid's bytes.
    pub fn pyramid(&self) -> Vec<u8> {
        let shape = Shape::new(self.log2[0], self.log2[1]);
        let mut bytes = vec![0; shape.pyramid_bytes() as usize];
        for level in 0..=shape.root() {
            let part = shape.level(level);
            for y in 0..1 << part.log2()[1] {
                for x in 0..1 << part.log2()[0] {
                    bytes[(shape.level_offset(level) + part.morton(x, y)) as usize] =
                        self.highest(level, x, y);
                }
            }
        }
        bytes
    }
}

/// Texture coordinate and view vector.
pub type RayOf = ([f32; 2], [f32; 3]);

/// Everything in one memory: map, texture, normals, rays, results.
#[derive(Clone, Debug)]
pub struct Scene<F> {
    pub memory: Vec<u32>,
    pub description: Description<F>,
}

impl<F: Format> Scene<F> {
    /// Textures are as large as the map; the matrix is one, so a view vector `(x, y, -1)` has the direction `(x, y)`.
    pub fn new(heights: &Heights, rays: &[RayOf], policies: Policies) -> Self {
        let mut memory = Vec::new();
        let align = |memory: &mut Vec<u32>| {
            memory.resize(memory.len().next_multiple_of(MAP_ALIGNMENT as usize / 4), 0);
            memory.len() as u32 * 4
        };
        let map = align(&mut memory);
        let mut pyramid = heights.pyramid();
        pyramid.resize(pyramid.len().next_multiple_of(4), 0);
        memory.extend(pyramid.chunks(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap())));
        let texels = 1u32 << (heights.log2[0] + heights.log2[1]);
        let texture = align(&mut memory);
        memory.extend((0..texels).map(|i| i.wrapping_mul(0x9E37_79B9) & 0x00FF_FFFF));
        let normals = align(&mut memory);
        memory.extend((0..texels).map(|i| 0x00FF_8080 ^ (i & 0x1F1F)));
        let list = align(&mut memory);
        for (entry, view) in rays {
            let words = [entry[0], entry[1], view[0], view[1], view[2], 0.0, 0.0, 0.0];
            memory.extend(words.map(|x| F::from_f32(x).to_bits()));
        }
        let results = align(&mut memory);
        memory.resize(memory.len() + rays.len() * RESULT_WORDS as usize, 0xDEAD_BEEF);
        let of = |v: [f32; 3]| v.map(F::from_f32);
        let describe = |base| MapDescription { base, log2: heights.log2 };
        let description = Description {
            policies,
            source: Source::List { base: list, count: rays.len() as u32 },
            ray_faults: RayFaults::Record,
            watchdog: 4096,
            map: describe(map),
            texture: describe(texture),
            normals: describe(normals),
            results,
            height_scale: F::ONE,
            tbn: [of([1.0, 0.0, 0.0]), of([0.0, 1.0, 0.0]), of([0.0, 0.0, 1.0])],
            light: of([0.48, 0.6, 0.64]),
            ambient: F::from_f32(0.25),
            diffuse: F::from_f32(0.75),
            background: 0x0012_3456,
        };
        Self { memory, description }
    }

    pub fn job(&self) -> Result<Job<F>, Fault> {
        let bytes = self.memory.len() as u32 * 4;
        Job::new(&Windows::new([Window { base: 0, limit: bytes }], bytes), &self.description)
    }
}

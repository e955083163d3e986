//! Jobs; in: what the registers say, out: only what the unit can do, or the fault to report; cost: a few compares at start.

use lucerna_fabric::window::{Buffer, BufferError, Windows};
use lucerna_softfloat::Format;

use crate::pyramid::{MAX_LOG2, Shape};
use crate::record::{RAY_WORDS, RESULT_WORDS};
use crate::shade::colour::Light;
use crate::traverse::Policies;
use crate::traverse::heights::Field;
use crate::traverse::walk::Terrain;

/// Why a job was refused or stopped; the codes of register `ERROR`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FaultCode {
    /// A field of `CONFIG` holds no legal value, or the watchdog's limit is 0 or above 65535.
    BadConfig,
    /// A buffer is misaligned (maps: to [`MAP_ALIGNMENT`] bytes) or not wholly inside one window.
    Window,
    /// A buffer's size in bytes, or its end, does not fit 32 bits.
    TooLarge,
    /// A map is larger than 4096 texels along an axis.
    BadMap,
    /// A raster of no pixel.
    BadRaster,
    /// A ray that does not come down on the surface (P18), where such rays stop a job.
    GrazingRay,
    /// A ray that took as many steps as the watchdog allows, where such rays stop a job.
    Watchdog,
    /// The results would overwrite what the job reads.
    Overlap,
    /// Start while a job runs (which goes on).
    NotIdle,
}

/// A fault and the byte address it is about (0 where there is none).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Fault {
    /// What is wrong.
    pub code: FaultCode,
    /// Where: a buffer's base, or a ray's result record.
    pub address: u32,
}

/// Bytes to which the bases of height map, texture and normal map are aligned, and their sizes rounded up: the longest
/// cache line, so that no line fill leaves its map.
pub const MAP_ALIGNMENT: u32 = 64;

/// What happens to a ray that cannot be traversed to its end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum RayFaults {
    /// Its record says so, it is counted, and the job goes on.
    #[default]
    Record,
    /// The job ends in a fault.
    Stop,
}

/// Where the rays come from.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Source<F> {
    /// Ray records in memory.
    List {
        /// Byte address of the first.
        base: u32,
        /// How many.
        count: u32,
    },
    /// A raster of pixels, row by row from the top.
    Raster(Raster<F>),
}

/// A pinhole camera over the surface's plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Raster<F> {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// View vector of pixel (0, 0), in world coordinates.
    pub origin: [F; 3],
    /// What a pixel to the right adds to it.
    pub right: [F; 3],
    /// What a pixel down adds to it.
    pub down: [F; 3],
    /// Texture coordinate under the eye, and its height over the top plane in units of the displacement's depth.
    pub eye: [F; 3],
    /// The surface is texture coordinates `0..extent` at the top plane; 0: it has no end.
    pub extent: [F; 2],
}

/// A map as the registers describe it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct MapDescription {
    /// Byte address.
    pub base: u32,
    /// Binary logarithms of width and height in texels.
    pub log2: [u32; 2],
}

/// A job as the registers describe it: anything may be wrong with it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Description<F> {
    /// Traversal policies.
    pub policies: Policies,
    /// Rays.
    pub source: Source<F>,
    /// What happens to rays that fail.
    pub ray_faults: RayFaults,
    /// Most steps a ray may take.
    pub watchdog: u32,
    /// Pyramid of heights: bytes.
    pub map: MapDescription,
    /// Colours: words `0x00RRGGBB`.
    pub texture: MapDescription,
    /// Normals: words `0x00ZZYYXX`, a component `c` being `(c - 128) / 127`.
    pub normals: MapDescription,
    /// Byte address of the first result record.
    pub results: u32,
    /// Depth of the displacement in texture units.
    pub height_scale: F,
    /// Rows tangent, bitangent, normal: from world to tangent space.
    pub tbn: [[F; 3]; 3],
    /// Towards the light, in tangent space, of length one.
    pub light: [F; 3],
    /// Light that is everywhere.
    pub ambient: F,
    /// Light from the light.
    pub diffuse: F,
    /// Colour of pixels beside the surface.
    pub background: u32,
}

/// A map whose every texel may be read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Map {
    /// Its words.
    pub words: Buffer,
    /// Its extent.
    pub shape: Shape,
}

/// A job that can be done.
#[derive(Clone, Copy, Debug)]
pub struct Job<F> {
    pub(crate) terrain: Terrain,
    pub(crate) source: Source<F>,
    /// Ray records; empty with a raster.
    pub(crate) rays: Buffer,
    pub(crate) ray_faults: RayFaults,
    pub(crate) watchdog: u32,
    pub(crate) map: Map,
    pub(crate) texture: Map,
    pub(crate) normals: Map,
    pub(crate) results: Buffer,
    /// Rows tangent and bitangent times the height scale, then normal.
    pub(crate) tbn: [[F; 3]; 3],
    pub(crate) light: Light<F>,
    pub(crate) background: u32,
}

impl<F: Format> Job<F> {
    /// Checks a description against the windows.
    ///
    /// # Errors
    /// A [`Fault`]; nothing was touched.
    pub fn new<const W: usize>(windows: &Windows<W>, description: &Description<F>) -> Result<Self, Fault> {
        let d = description;
        if !(1..=0xFFFF).contains(&d.watchdog) || !d.policies.is_legal() {
            return Err(Fault { code: FaultCode::BadConfig, address: 0 });
        }
        let pyramid = map(windows, d.map, |shape| shape.pyramid_bytes())?;
        let texture = map(windows, d.texture, |shape| shape.texels() * 4)?;
        let normals = map(windows, d.normals, |shape| shape.texels() * 4)?;
        let (rays, count) = match d.source {
            Source::List { base, count } => (buffer(windows, base, count, RAY_WORDS)?, count),
            Source::Raster(raster) => {
                let count = raster.width.checked_mul(raster.height).unwrap_or(0);
                if count == 0 {
                    return Err(Fault { code: FaultCode::BadRaster, address: 0 });
                }
                (Buffer::EMPTY, count)
            }
        };
        let results = buffer(windows, d.results, count, RESULT_WORDS)?;
        for read in [pyramid.words, texture.words, normals.words, rays] {
            if overlap(&results, &read) {
                return Err(Fault { code: FaultCode::Overlap, address: d.results });
            }
        }
        let scaled = |row: [F; 3]| row.map(|x| x.mul(d.height_scale));
        Ok(Self {
            terrain: Terrain { field: Field::new(pyramid.shape, d.policies.wrap), policies: d.policies },
            source: d.source,
            rays,
            ray_faults: d.ray_faults,
            watchdog: d.watchdog,
            map: pyramid,
            texture,
            normals,
            results,
            tbn: [scaled(d.tbn[0]), scaled(d.tbn[1]), d.tbn[2]],
            light: Light { towards: d.light, ambient: d.ambient, diffuse: d.diffuse },
            background: d.background & 0x00FF_FFFF,
        })
    }

    /// How many rays it has.
    pub const fn rays(&self) -> u32 {
        self.results.count()
    }
}

fn map<const W: usize>(
    windows: &Windows<W>,
    description: MapDescription,
    bytes: impl Fn(Shape) -> u32,
) -> Result<Map, Fault> {
    let MapDescription { base, log2 } = description;
    if log2.iter().any(|log2| *log2 > MAX_LOG2) {
        return Err(Fault { code: FaultCode::BadMap, address: base });
    }
    let shape = Shape::new(log2[0], log2[1]);
    if !base.is_multiple_of(MAP_ALIGNMENT) {
        return Err(Fault { code: FaultCode::Window, address: base });
    }
    let words = buffer(windows, base, bytes(shape).next_multiple_of(MAP_ALIGNMENT) / 4, 1)?;
    Ok(Map { words, shape })
}

fn buffer<const W: usize>(windows: &Windows<W>, base: u32, count: u32, words: u32) -> Result<Buffer, Fault> {
    windows.buffer(base, count, words).map_err(|error| {
        let code = match error {
            BufferError::Outside => FaultCode::Window,
            BufferError::TooLarge => FaultCode::TooLarge,
        };
        Fault { code, address: base }
    })
}

/// Whether two buffers share a byte.
fn overlap(a: &Buffer, b: &Buffer) -> bool {
    let end = |buffer: &Buffer| buffer.address(buffer.count());
    a.count() > 0 && b.count() > 0 && a.address(0) < end(b) && b.address(0) < end(a)
}

//! A small picture of a displaced surface through the driver; in: a camera or a list, out: its result records; cost: 192 rays.

use std::sync::LazyLock;

use embedded_hal::delay::DelayNs;
use hostsim::displace::map::HeightMap;
use hostsim::oracle::{Columns, RoundedRay};
use lucerna_bus::{Bus, Model, Timing};
use lucerna_displace::engine;
use lucerna_driver::displace::{Camera, Image, Job, Layout, Plane, Policies, Ray, Shape, Sizes, Wrap};
use lucerna_driver::{Deadline, Error, Lucerna, NumberFormat};

use crate::devices::{Any, full};
use crate::displaced::{columns, map, shape};

/// No job of it takes as long.
pub const PATIENCE: Deadline = Deadline::millis(100);
/// Rays of a job.
pub const PIXELS: u32 = SIZE.0 * SIZE.1;
/// Columns and rows.
const SIZE: (u32, u32) = (16, 12);

static MAP: LazyLock<HeightMap> = LazyLock::new(|| {
    map(16, &(0..256u32).map(|i| (i.wrapping_mul(0x9e37_79b9) >> 25) as u8).collect::<Vec<_>>())
});

const PLANE: Plane = Plane {
    origin: [-1.0, 0.0, 1.0],
    tangent: [2.0, 0.0, 0.0],
    bitangent: [0.0, 0.0, -2.0],
    normal: [0.0, 1.0, 0.0],
    repeat: [2.0, 2.0],
    height_scale: 0.2,
    bounded: true,
};

/// What is done: a picture by a camera, or the same pixels as a list.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum What {
    /// Rays of the device's own.
    Raster,
    /// Rays from memory.
    List,
}

/// Result records.
pub type Words = Vec<[u32; 8]>;

impl What {
    /// Its buffers.
    pub fn sizes(self) -> Sizes {
        let one = Shape::of(1, 2).expect("two texels");
        let pixels = SIZE.0 * SIZE.1;
        let rays = if self == Self::List { pixels } else { 0 };
        Sizes { map: shape(&MAP), texture: shape(&MAP), normals: one, rays, results: pixels }
    }

    /// A device for it, with both units.
    pub fn model(self, timing: Timing) -> Model<Any> {
        let memory = vec![0; self.sizes().bytes() as usize / 4 + 64];
        Model::new(full(NumberFormat::F24, false, engine::Sizes::default(), memory)).with_timing(timing)
    }

    /// The job.
    ///
    /// # Panics
    /// When the driver does not take it.
    pub fn job(self, layout: &Layout) -> Job {
        let (width, height) = SIZE;
        let camera = Camera {
            position: [0.3, 0.9, 1.5],
            direction: [0.0, -0.8, -0.6],
            up: [0.0, 1.0, 0.0],
            field_of_view: 0.8,
            width,
            height,
        };
        let raster = Job::raster(layout, &camera, &PLANE, Policies::MIX);
        match self {
            Self::Raster => raster.expect("a camera"),
            Self::List => Job::list(layout, width * height, &PLANE, Policies::MIX).expect("a list"),
        }
    }

    /// The list's rays; none of a camera.
    pub fn rays(self) -> Vec<Ray> {
        let ray = |i: u32| {
            let (u, v) = (((i % SIZE.0) as f32 + 0.37) / 8.0, ((i / SIZE.0) as f32 + 0.41) / 6.0);
            Ray { entry: [u, v], view: [u - 1.0, -1.0, 1.0 - v] }
        };
        (0..self.sizes().rays).map(ray).collect()
    }

    /// Writes maps and rays.
    ///
    /// # Errors
    /// The driver's.
    ///
    /// # Panics
    /// When the device's memory is too small.
    pub fn prepare<B: Bus, D: DelayNs>(self, device: &mut Lucerna<B, D>) -> Result<Layout, Error<B::Error>> {
        let layout = Layout::packed(device.capabilities(), self.sizes()).expect("it fits");
        let mut unit = device.displace()?;
        unit.write_map(&layout, &Image::new(shape(&MAP), MAP.heights()).expect("a height a texel"))?;
        unit.write_texture_with(&layout, |x, y| x << 4 | y << 12 | 0x00ff_0000)?;
        unit.write_normals_with(&layout, |_, y| 0x00ff_8080 - y)?;
        unit.write_rays(&layout, 0, &self.rays())?;
        Ok(layout)
    }

    /// Reads the results.
    ///
    /// # Errors
    /// The driver's.
    pub fn read<B: Bus, D: DelayNs>(
        self,
        device: &mut Lucerna<B, D>,
        layout: &Layout,
    ) -> Result<Words, Error<B::Error>> {
        let mut words = vec![[0; 8]; self.sizes().results as usize];
        device.displace()?.read_result_words(layout, 0, &mut words)?;
        Ok(words)
    }

    /// All of it, blocking.
    ///
    /// # Errors
    /// The driver's.
    pub fn run<B: Bus, D: DelayNs>(self, device: &mut Lucerna<B, D>) -> Result<Words, Error<B::Error>> {
        let layout = self.prepare(device)?;
        device.displace()?.start(&self.job(&layout))?.wait(PATIENCE)?;
        self.read(device, &layout)
    }

    /// Each ray in f64, by the geometry alone: texture coordinates are world coordinates, 1 and 1 in the middle.
    pub fn exact(self) -> Vec<RoundedRay> {
        let pitch = 2.0 * 0.4f64.tan() / f64::from(SIZE.1);
        let camera = |i: u32| {
            let right = pitch * (f64::from(i % SIZE.0) + 0.5 - f64::from(SIZE.0) / 2.0);
            let down = pitch * (f64::from(i / SIZE.0) + 0.5 - f64::from(SIZE.1) / 2.0);
            // Right is (1, 0, 0), down is (0, -0.6, 0.8).
            let view = [right, -0.8 - 0.6 * down, -0.6 + 0.8 * down];
            let far = 0.9 / -view[1];
            ([1.0 + 0.3 + far * view[0], 1.0 - (1.5 + far * view[2])], view)
        };
        let listed = |ray: &Ray| (ray.entry.map(f64::from), ray.view.map(f64::from));
        let rays: Vec<_> = match self {
            Self::Raster => (0..PIXELS).map(camera).collect(),
            Self::List => self.rays().iter().map(listed).collect(),
        };
        rays.into_iter().map(|(entry, [x, y, z])| (entry, [0.2 * x / -y, 0.2 * -z / -y])).collect()
    }

    /// The map's columns.
    pub fn columns() -> Columns<'static> {
        columns(&MAP, Wrap::Repeat)
    }

    /// What a clean run comes to.
    ///
    /// # Panics
    /// When it is none.
    pub fn expected(self) -> Words {
        let model = self.model(Timing::Tick);
        self.run(&mut Lucerna::probe(model.bus(), model.delay()).expect("a device")).expect("a clean run")
    }
}

/// Both.
pub const BOTH: [What; 2] = [What::Raster, What::List];

//! Displaced surfaces on a device, through the driver; in: a map, rays, policies, out: results and counters; cost: the device's.

use hostsim::displace::map::HeightMap;
use hostsim::displace::presets::Preset;
use hostsim::displace::procedural;
use hostsim::displace::ray::{Ray as Pixel, Surface};
use hostsim::displace::view::View;
use hostsim::displace::workload::TANGENT_ROWS;
use hostsim::oracle::{Column, Columns, Number, RoundedRay, Tangent};
use lucerna_bus::Model;
use lucerna_device::DisplaceDevice;
use lucerna_displace::engine;
use lucerna_driver::displace::{
    Algorithm, Coherent, Counters, Frame, Image, Job, Layout, LevelsDown, Policies, Ray, RayResult,
    RayStatus, Shape, Sizes, Source, Wrap, colour, normal,
};
use lucerna_driver::{Deadline, Lucerna};
use lucerna_softfloat::Format;

/// No job of these tests takes as long.
pub const PATIENCE: Deadline = Deadline::seconds(60);

/// A device of up to four instances.
pub type Device<F> = DisplaceDevice<F, 4, 512, Vec<u32>>;

/// A device with a map in its memory.
#[derive(Debug)]
pub struct Bench<F: Format> {
    /// The device and its clock.
    pub model: Box<Model<Device<F>>>,
    /// Where its buffers are.
    pub layout: Layout,
}

/// A job's end.
#[derive(Clone, Debug, PartialEq)]
pub struct Ended {
    /// One a ray.
    pub results: Vec<RayResult>,
    /// Of this job alone.
    pub counters: Counters,
}

/// Every algorithm that has a name, with all readings of (c2) and n levels down.
pub fn algorithms() -> Vec<(String, Policies)> {
    let levels = [LevelsDown::One, LevelsDown::Two, LevelsDown::Three, LevelsDown::Four];
    let readings = [Coherent::Toggle, Coherent::Consecutive, Coherent::Parity];
    let mut all = Vec::new();
    for algorithm in Algorithm::ALL {
        let (name, policies) = (algorithm.name(), algorithm.policies());
        match algorithm {
            Algorithm::B(_) => {
                all.extend(levels.map(|n| (format!("b n={}", n.bits()), Policies::b(n))));
            }
            Algorithm::C2 | Algorithm::MixGpu => {
                all.extend(readings.map(|c| (format!("{name} {c:?}"), policies.with_coherent(c))));
            }
            _ => all.push((name.to_owned(), policies)),
        }
    }
    all
}

/// A map as the unit takes it.
///
/// # Panics
/// When a side is not a power of two up to 4096.
pub fn shape(map: &HeightMap) -> Shape {
    let [width, height] = map.log2();
    Shape::new(width, height).expect("a side that a map has")
}

/// A small map from its heights, row by row.
///
/// # Panics
/// When a side is not a power of two, or heights are missing.
pub fn map(width: u32, heights: &[u8]) -> HeightMap {
    let height = heights.len() as u32 / width;
    HeightMap::new("by hand", width, height, heights.to_vec()).expect("a height a texel")
}

/// The built-in maps, as large as they are and on the surface they are meant for.
///
/// # Panics
/// Never.
pub fn fixtures() -> Vec<(HeightMap, Surface)> {
    let names = procedural::names().into_iter();
    names
        .map(|name| {
            let preset = Preset::of(name);
            let map = preset.apply(procedural::map(name).expect("a built-in map"));
            (map, Surface { scale: preset.scale, repeat: preset.repeat })
        })
        .collect()
}

/// The rays of a picture.
pub fn pixels(surface: &Surface, view: &View, size: (u32, u32)) -> Vec<Pixel> {
    surface.rays(view, &view.raster(size.0, size.1))
}

/// Pixels as the driver takes them.
pub fn records(pixels: &[Pixel]) -> Vec<Ray> {
    let ray = |pixel: &Pixel| {
        let [u, v, x, y, z] = pixel.record();
        Ray { entry: [u, v], view: [x, y, z] }
    };
    pixels.iter().map(ray).collect()
}

/// The grid of the paper's pictures.
pub fn frame(surface: &Surface) -> Frame {
    let [tangent, bitangent, normal] = TANGENT_ROWS;
    Frame { tangent, bitangent, normal, height_scale: surface.scale as f32 }
}

/// Tangent space itself: the view vector `(x, y, -1)` goes `(x, y)` from the top plane to the bottom.
pub const FLAT: Frame = Frame {
    tangent: [1.0, 0.0, 0.0],
    bitangent: [0.0, 1.0, 0.0],
    normal: [0.0, 0.0, 1.0],
    height_scale: 1.0,
};

/// A ray of [`FLAT`].
pub const fn ray(entry: [f32; 2], direction: [f32; 2]) -> Ray {
    Ray { entry, view: [direction[0], direction[1], -1.0] }
}

/// The rays as a device with arithmetic `N` makes them.
pub fn rounded<N: Number>(frame: &Frame, rays: &[Ray]) -> Vec<Option<RoundedRay>> {
    let tangent = Tangent::<N>::new(frame.rows(), frame.height_scale);
    let record = |ray: &Ray| [ray.entry[0], ray.entry[1], ray.view[0], ray.view[1], ray.view[2]];
    rays.iter().map(|ray| tangent.of_record(record(ray))).collect()
}

/// Whether a result is what the exact march says.
pub fn agrees(result: &RayResult, column: &Column) -> bool {
    match result.status {
        RayStatus::Hit => !column.missed && result.texel.map(i64::from) == column.texel,
        RayStatus::Miss => column.missed,
        RayStatus::Grazing | RayStatus::Watchdog | RayStatus::Unknown(_) => false,
    }
}

/// The exact march over a map.
pub fn columns(map: &HeightMap, wrap: Wrap) -> Columns<'_> {
    Columns::new(map.log2(), map.heights(), wrap == Wrap::Repeat)
}

impl<F: Format> Bench<F> {
    /// A device of the default sizes; a texture and normals of one texel.
    pub fn new(map: &HeightMap, most: usize) -> Self {
        let one = Shape::of(1, 1).expect("one texel");
        Self::sized(map, [one; 2], most, engine::Sizes::default())
    }

    /// A device with a map, a texture and normals, and room for `most` rays and results.
    ///
    /// # Panics
    /// When there can be no such device, or the driver fails.
    pub fn sized(map: &HeightMap, shapes: [Shape; 2], most: usize, unit: engine::Sizes) -> Self {
        let [texture, normals] = shapes;
        let most = most as u32;
        let sizes = Sizes { map: shape(map), texture, normals, rays: most, results: most };
        let device = Device::new(unit, vec![0; sizes.bytes() as usize / 4 + 64]).expect("sizes of a unit");
        let model = Box::new(Model::new(device));
        let layout = Self::place(&model, map, sizes);
        Self { model, layout }
    }

    fn place(model: &Model<Device<F>>, map: &HeightMap, sizes: Sizes) -> Layout {
        let mut lucerna = Lucerna::probe(model.bus(), model.delay()).expect("a device");
        let layout = Layout::packed(lucerna.capabilities(), sizes).expect("room for it");
        let mut displace = lucerna.displace().expect("a displacement unit");
        let heights = Image::new(sizes.map, map.heights()).expect("a height a texel");
        displace.write_map(&layout, &heights).expect("a map");
        let spread = |x: u32, y: u32| colour([x as u8, y as u8, (x ^ y) as u8]);
        displace.write_texture_with(&layout, spread).expect("a texture");
        let up = |x: u32, y: u32| normal([(x % 3) as f32 - 1.0, (y % 3) as f32 - 1.0, 1.0]);
        displace.write_normals_with(&layout, up).expect("normals");
        layout
    }

    /// A list of rays to its end.
    ///
    /// # Panics
    /// When the driver fails.
    pub fn list(&self, rays: &[Ray], frame: Frame, policies: Policies) -> Ended {
        let job = Job::new(&self.layout, Source::List { count: rays.len() as u32 }, frame, policies);
        self.run(rays, &job.expect("a list"))
    }

    /// A job to its end, its rays written before.
    ///
    /// # Panics
    /// When the driver fails.
    pub fn run(&self, rays: &[Ray], job: &Job) -> Ended {
        let mut lucerna = Lucerna::probe(self.model.bus(), self.model.delay()).expect("a device");
        let mut displace = lucerna.displace().expect("a displacement unit");
        displace.write_rays(&self.layout, 0, rays).expect("rays");
        displace.clear_counters().expect("counters");
        displace.start(job).expect("a start").wait(PATIENCE).expect("an end");
        let mut results = vec![RayResult::default(); job.rays() as usize];
        displace.read_results(&self.layout, 0, &mut results).expect("results");
        Ended { results, counters: displace.counters().expect("counters") }
    }
}

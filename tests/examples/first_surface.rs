//! A first displaced surface, whole: in: a height map made here, a camera, two rays, out: a picture of letters, two hits and
//! counters, printed; cost: some tens of thousands of clocks of a modelled device.
//!
//! `cargo run --release -p lucerna-tests --example first_surface`

use core::error::Error;

use lucerna_bus::Model;
use lucerna_device::DisplaceDevice;
use lucerna_driver::displace::{
    Algorithm, Camera, Image, Job, Layout, Plane, Ray, RayResult, Shape, Sizes, colour, normal,
};
use lucerna_driver::{Deadline, Lucerna};
use lucerna_softfloat::F24;

const PATIENCE: Deadline = Deadline::seconds(1);
const WIDTH: usize = 64;
const HEIGHT: usize = 24;

fn main() -> Result<(), Box<dyn Error>> {
    // A cone on 64 by 64 texels, row by row; 255 is the top plane, 0 the bottom.
    let map = Shape::of(64, 64).ok_or("a power of two")?;
    let heights: Vec<u8> = (0..64 * 64)
        .map(|texel| {
            let (x, y) = ((texel % 64) as f32 - 31.5, (texel / 64) as f32 - 31.5);
            (255.0 - 9.0 * x.hypot(y)).max(0.0) as u8
        })
        .collect();
    let heights = Image::new(map, &heights)?;

    // The device: one unit in 24 bits. 512 lines are what its caches of 16 KiB with lines of 32 bytes have.
    let sizes = Sizes { map, texture: map, normals: map, rays: 2, results: (WIDTH * HEIGHT) as u32 };
    let device =
        DisplaceDevice::<F24, 1, 512, _>::new(Default::default(), vec![0u32; sizes.bytes() as usize / 4])?;
    let model = Model::new(device);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay())?;
    let layout = Layout::packed(lucerna.capabilities(), sizes)?;

    // A square of 2 by 2 metres on the ground; the map lies on it once, its depth is a quarter of a texture: half a metre.
    let plane = Plane {
        origin: [-1.0, 0.0, 1.0],
        tangent: [2.0, 0.0, 0.0],
        bitangent: [0.0, 0.0, -2.0],
        normal: [0.0, 1.0, 0.0],
        repeat: [1.0, 1.0],
        height_scale: 0.25,
        bounded: true,
    };
    let camera = Camera {
        position: [0.0, 1.2, 2.2],
        direction: [0.0, -0.6, -1.0],
        up: [0.0, 1.0, 0.0],
        field_of_view: 0.9,
        width: WIDTH as u32,
        height: HEIGHT as u32,
    };

    let mut unit = lucerna.displace()?;
    unit.write_map(&layout, &heights)?; // makes the pyramid on the way
    unit.write_texture_with(&layout, |_, _| colour([255; 3]))?;
    unit.write_normals_with(&layout, |x, y| normal(heights.normal_at(x, y, plane.height_scale)))?;

    // A picture: the device makes the rays.
    unit.start(&Job::raster(&layout, &camera, &plane, Algorithm::Fold.into())?)?.wait(PATIENCE)?;
    let mut pixels = [RayResult::default(); WIDTH * HEIGHT];
    unit.read_results(&layout, 0, &mut pixels)?;
    for row in pixels.chunks(WIDTH) {
        let letter = |pixel: &RayResult| char::from(b" .:-=+*#%@"[usize::from(pixel.colour[0]) * 9 / 255]);
        println!("{}", row.iter().map(letter).collect::<String>());
    }

    // Two rays of our own: where they meet the top plane, and where they look, in world coordinates.
    let rays = [
        Ray { entry: [0.5, 0.5], view: [0.0, -1.0, 0.0] },
        Ray { entry: [0.25, 0.5], view: [1.0, -0.5, 0.0] },
    ];
    unit.write_rays(&layout, 0, &rays)?;
    unit.start(&Job::list(&layout, rays.len() as u32, &plane, Algorithm::Fold.into())?)?.wait(PATIENCE)?;
    let mut hits = [RayResult::default(); 2];
    unit.read_results(&layout, 0, &mut hits)?;
    for hit in hits {
        println!("{:?} texel {:?} at t = {} after {} steps", hit.status, hit.texel, hit.t, hit.steps);
    }

    let counters = unit.counters()?;
    println!("{} rays, {} steps, {} cycles", counters.rays, counters.steps, counters.cycles);
    Ok(())
}

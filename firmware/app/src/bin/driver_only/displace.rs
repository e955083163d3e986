//! The displacement unit's jobs. In: a map of four pillars. Out: a picture of 2×2 pixels, and what four rays hit, in the log.
//! Cost: a raster and a list.

use lucerna_driver::displace::{
    Camera, Image, Job, Layout, Light, Plane, Policies, Ray, RayResult, Shape, Sizes, colour, normal,
};

use crate::program::{Failure, Lucerna, PATIENCE};

/// Pixels, and rays.
const RAYS: usize = 4;
const SHAPE: Shape = Shape::new(2, 2).unwrap();
const PILLARS: [u8; 16] = [0, 0, 0, 0, 0, 255, 0, 192, 0, 0, 0, 0, 0, 128, 0, 64];

const PLANE: Plane = Plane {
    origin: [-0.5, 0.0, 0.5],
    tangent: [1.0, 0.0, 0.0],
    bitangent: [0.0, 0.0, -1.0],
    normal: [0.0, 1.0, 0.0],
    repeat: [1.0, 1.0],
    height_scale: 0.25,
    bounded: false,
};
const CAMERA: Camera = Camera {
    position: [0.0, 1.0, 1.0],
    direction: [0.0, -1.0, -1.0],
    up: [0.0, 1.0, 0.0],
    field_of_view: 0.75,
    width: 2,
    height: 2,
};

pub fn picture(lucerna: &mut Lucerna) -> Result<(), Failure> {
    let sizes = Sizes { map: SHAPE, texture: SHAPE, normals: SHAPE, rays: RAYS as u32, results: RAYS as u32 };
    let layout = Layout::packed(lucerna.capabilities(), sizes)?;
    let light = Light::towards([1.0, 1.0, 2.0], 0.25, 0.75);
    let raster = Job::raster(&layout, &CAMERA, &PLANE, Policies::MIX)?.with_light(light)?;
    let list = Job::list(&layout, RAYS as u32, &PLANE, Policies::FOLD)?.with_light(light)?;

    let mut unit = lucerna.displace()?;
    unit.clear_counters()?;
    unit.write_map_with(&layout, height)?;
    unit.write_texture_with(&layout, |x, y| colour([height(x, y), 128, 64]))?;
    if let Ok(heights) = Image::new(SHAPE, &PILLARS) {
        unit.write_normals_with(&layout, |x, y| normal(heights.normal_at(x, y, PLANE.height_scale)))?;
    }
    unit.start(&raster)?.wait(PATIENCE)?;
    let mut results = [RayResult::default(); RAYS];
    unit.read_results(&layout, 0, &mut results)?;
    defmt::info!("pixels: {}", results.map(|result| result.colour));

    let rays: [Ray; RAYS] = core::array::from_fn(|number| Ray {
        entry: [number as f32 / RAYS as f32, 0.5],
        view: [0.25, -1.0, 0.125],
    });
    unit.write_rays(&layout, 0, &rays)?;
    unit.start(&list)?.wait(PATIENCE)?;
    unit.read_results(&layout, 0, &mut results)?;
    defmt::info!("hits: {}", results);
    defmt::info!("{}", unit.counters()?);
    Ok(())
}

fn height(x: u32, y: u32) -> u8 {
    let place = y * SHAPE.width() + x;
    PILLARS.get(place as usize).copied().unwrap_or_default()
}

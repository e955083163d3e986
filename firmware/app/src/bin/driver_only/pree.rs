//! The PREE's job. In: four hit points and photons. Out: a picture of 2×2 pixels in the log. Cost: an update and an evaluation.

use lucerna_driver::{EvaluateJob, HitPoint, Layout, Photon, Policies, Sizes, UpdateJob};

use crate::program::{Failure, Lucerna, PATIENCE};

/// Pixels, hit points and photons: one of each for each.
const PIXELS: usize = 4;

pub fn picture(lucerna: &mut Lucerna) -> Result<(), Failure> {
    let sizes = Sizes {
        hit_points: PIXELS as u32,
        index_entries: PIXELS as u32,
        pixels: PIXELS as u32,
        ring_entries: 64,
        normal_test: true,
    };
    let layout = Layout::packed(lucerna.capabilities(), sizes)?;
    let update = UpdateJob::new(&layout, 0.7, Policies::default())?;
    let evaluate = EvaluateJob::new(&layout, PIXELS as f32, Policies::default())?;
    lucerna.clear_counters()?;

    let mut pree = lucerna.pree()?;
    let position = |number: usize| [number as f32, 0.0, 0.0];
    let normal = [0.0, 1.0, 0.0];
    let hit_points: [HitPoint; PIXELS] = core::array::from_fn(|number| HitPoint {
        position: position(number),
        normal,
        colour: [0.75; 3],
        radius_squared: 0.25,
        pixel: number as u32,
        ..HitPoint::default()
    });
    let photons: [Photon; PIXELS] = core::array::from_fn(|number| Photon {
        position: position(number),
        normal,
        flux: [number as f32; 3],
        p_addr: number as u32,
        n: 1,
    });
    pree.write_hit_points(&layout, 0, &hit_points)?;
    pree.write_index(&layout, 0, &core::array::from_fn::<u32, PIXELS, _>(|number| number as u32))?;
    pree.zero_pixels(&layout)?;
    let mut stream = pree.update(&update)?;
    stream.push_all(&photons, PATIENCE)?;
    stream.finish(PATIENCE)?;
    pree.evaluate(&evaluate)?.wait(PATIENCE)?;
    let mut pixels = [[0.0; 3]; PIXELS];
    pree.read_pixels(&layout, 0, &mut pixels)?;
    defmt::info!("pixels: {}", pixels);
    defmt::info!("{}", lucerna.counters()?);
    Ok(())
}

//! Is the fast path the tick, and is what comes out what a plain loop over the steps finds?

mod common;

use common::any::{geometry, heights, policies};
use common::{Heights, RayOf, Scene};
use lucerna_displace::engine::{Displace, Event, Sizes};
use lucerna_displace::job::{FaultCode, RayFaults};
use lucerna_displace::record::{Outcome, RESULT_WORDS, Status};
use lucerna_displace::traverse::Policies;
use lucerna_displace::traverse::heights::{Depths, Fetched, Field, Pyramid};
use lucerna_displace::traverse::ray::Ray;
use lucerna_displace::traverse::walk::{Step, Terrain, Walk};
use lucerna_softfloat::{F24, F32, Format};
use proptest::prelude::*;

type Unit<F> = Displace<F, 4, 512>;

/// Ticks to the end.
fn ticked<F: Format>(scene: &Scene<F>, sizes: Sizes) -> (Unit<F>, Vec<u32>, Event) {
    let (mut unit, mut memory) = (Unit::<F>::new(sizes).unwrap(), scene.memory.clone());
    unit.start(scene.job().unwrap()).unwrap();
    for _ in 0..10_000_000 {
        if let Some(event) = unit.tick(&mut memory) {
            return (unit, memory, event);
        }
    }
    panic!("the job does not end");
}

/// Advances to the end, in pieces.
fn advanced<F: Format>(scene: &Scene<F>, sizes: Sizes, pieces: &[u64]) -> (Unit<F>, Vec<u32>, Event) {
    let (mut unit, mut memory) = (Unit::<F>::new(sizes).unwrap(), scene.memory.clone());
    unit.start(scene.job().unwrap()).unwrap();
    for piece in pieces.iter().cycle() {
        if let (_, Some(event)) = unit.advance(&mut memory, *piece) {
            return (unit, memory, event);
        }
    }
    unreachable!("there are pieces");
}

/// One ray after the other, without a pipeline.
fn plain<F: Format>(
    scene: &Scene<F>,
    heights: &Heights,
    rays: &[RayOf],
) -> Vec<(Status, [i32; 2], u32, u32)> {
    let policies = scene.description.policies;
    let shape = lucerna_displace::pyramid::Shape::new(heights.log2[0], heights.log2[1]);
    let terrain = Terrain { field: Field::new(shape, policies.wrap), policies };
    let (depths, mut pyramid) = (Depths::new(), heights.pyramid());
    pyramid.resize(pyramid.len().next_multiple_of(4), 0);
    let words: Vec<u32> =
        pyramid.chunks(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap())).collect();
    let pyramid = Pyramid { words: &words, depths: &depths };
    let trace = |(entry, view): &RayOf| {
        let [x, y, z] = view.map(F::from_f32);
        if !z.lt(F::ZERO) {
            return (Status::Grazing, [0; 2], F::ZERO.to_bits(), 0);
        }
        let down = F::ZERO.sub(z);
        let ray = Ray { entry: entry.map(F::from_f32), direction: [x.div(down), y.div(down)] };
        let track = ray.track(shape.log2());
        if !track.is_in_reach() {
            return (Status::Grazing, [0; 2], F::ZERO.to_bits(), 0);
        }
        let mut walk = Walk::new(&track, &terrain);
        while walk.steps < scene.description.watchdog {
            let fetch = |place| Fetched { place, depth: pyramid.depth(place), pyramid };
            let beyond = Fetched { place: u32::MAX, depth: F::ONE, pyramid };
            let fetched = walk.node(&terrain.field).map_or(beyond, fetch);
            if let Step::Hit | Step::CrossHit = walk.step(&track, &terrain, &fetched) {
                let status = if terrain.field.lets_hit(walk.leaf) { Status::Hit } else { Status::Miss };
                return (status, walk.leaf, walk.t.to_bits(), walk.steps);
            }
        }
        (Status::Watchdog, walk.leaf, walk.t.to_bits(), walk.steps)
    };
    rays.iter().map(trace).collect()
}

fn check<F: Format>(
    heights: &Heights,
    rays: &[RayOf],
    policies: Policies,
    (ray_faults, watchdog): (RayFaults, u32),
    sizes: Sizes,
    pieces: &[u64],
) -> Result<(), TestCaseError> {
    let mut scene = Scene::<F>::new(heights, rays, policies);
    scene.description.ray_faults = ray_faults;
    scene.description.watchdog = watchdog;
    let (truth, memory, event) = ticked(&scene, sizes);
    let (fast, fast_memory, fast_event) = advanced(&scene, sizes, pieces);
    prop_assert_eq!(event, fast_event);
    prop_assert_eq!(truth.counters(), fast.counters());
    prop_assert!(memory == fast_memory, "bits differ");
    let c = truth.counters();
    let turns = c.traverse_busy + c.traverse_waits + c.traverse_bubbles + c.traverse_stalls;
    prop_assert_eq!(turns, c.cycles * u64::from(sizes.units));
    if let Event::Fault(fault) = event {
        prop_assert_eq!(ray_faults, RayFaults::Stop);
        let status = memory[fault.address as usize / 4 + 3] >> 24;
        let expected = if fault.code == FaultCode::Watchdog { Status::Watchdog } else { Status::Grazing };
        prop_assert_eq!(status, expected as u32);
        return Ok(());
    }
    for (ray, (status, texel, t, steps)) in plain(&scene, heights, rays).into_iter().enumerate() {
        let first = scene.description.results as usize / 4 + ray * RESULT_WORDS as usize;
        let words = &memory[first..first + RESULT_WORDS as usize];
        prop_assert_eq!(words[3] >> 24, status as u32, "ray {}", ray);
        prop_assert_eq!([words[0] as i32, words[1] as i32], texel, "ray {}", ray);
        prop_assert_eq!((words[2], words[3] & 0xFFFF), (t, steps), "ray {}", ray);
    }
    prop_assert_eq!(c.rays, rays.len() as u64);
    prop_assert_eq!(c.hits + c.missed + c.grazing + c.watchdogs, c.rays);
    prop_assert_eq!(c.height_hits + c.height_misses, c.height_accesses);
    prop_assert_eq!(c.traverse_busy, c.steps + c.start_passes);
    prop_assert_eq!(c.height_forwards, c.height_misses);
    prop_assert_eq!(
        c.port_bytes,
        c.height_fills * u64::from(sizes.height_cache.line_bytes)
            + c.texture_fills * u64::from(sizes.texture_cache.line_bytes)
    );
    Ok(())
}

fn sizes() -> impl Strategy<Value = Sizes> {
    // An only instance has a way of its own.
    (prop_oneof![Just(1u32), 2u32..=4], geometry(), geometry(), 1u32..20, 1u32..20, 1u32..60, 1u32..17)
        .prop_map(|(units, height_cache, texture_cache, fifo0, fifo1, latency, bytes_per_cycle)| Sizes {
            units,
            height_cache,
            texture_cache,
            fifo0,
            fifo1,
            port: lucerna_displace::engine::PortSizes { latency, bytes_per_cycle },
        })
}

fn rays() -> impl Strategy<Value = Vec<RayOf>> {
    let special = prop::sample::select(vec![0.0f32, 0.25, 0.5, 1.0, -1.0, -0.375, 3.0, -1e-6, -1e-20]);
    let entry = prop_oneof![special.clone(), -2.0f32..3.0];
    let slope = prop_oneof![special, -1.5f32..1.5];
    let z = prop_oneof![9 => Just(-1.0f32), 1 => -2.0f32..0.2];
    let ray = (entry.clone(), entry, slope.clone(), slope, z).prop_map(|(u, v, x, y, z)| ([u, v], [x, y, z]));
    prop::collection::vec(ray, 0..80)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]
    #[test]
    fn advance_is_tick_and_both_are_the_plain_loop(
        heights in heights(),
        rays in rays(),
        policies in policies(),
        faults in (
            prop::sample::select(vec![RayFaults::Record, RayFaults::Stop]),
            prop_oneof![Just(4096u32), 1u32..12],
        ),
        sizes in sizes(),
        pieces in prop::collection::vec(1u64..400, 1..8),
    ) {
        check::<F24>(&heights, &rays, policies, faults, sizes, &pieces)?;
        check::<F32>(&heights, &rays, policies, faults, sizes, &pieces)?;
    }
}

#[test]
fn a_record_has_a_status_a_level_and_steps() {
    let outcome = Outcome {
        status: Status::Watchdog,
        texel: [-1, 2],
        t: F32::ONE,
        steps: 4096,
        level: 8,
        position: [F32::ZERO; 2],
        colour: 0x0000_FF00,
    };
    assert_eq!(outcome.words(), [u32::MAX, 2, 1.0f32.to_bits(), 0x0308_1000, 0xFF00, 0, 0, 0]);
}

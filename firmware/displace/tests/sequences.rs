//! Is `advance` so many ticks, wherever it stops and whatever is done in between?

mod common;

use common::any::{geometry, heights, policies};
use common::{Heights, RayOf, Scene};
use lucerna_displace::engine::{Displace, PortSizes, Sizes};
use lucerna_displace::job::{Raster, RayFaults, Source};
use lucerna_displace::traverse::Policies;
use lucerna_softfloat::{F24, F32, Format};
use proptest::prelude::*;

type Unit<F> = Displace<F, 4, 512>;

/// What is done to a unit.
#[derive(Clone, Debug)]
enum Operation {
    Advance(u64),
    Tick(u64),
    Finish,
    Abort,
    ClearCounters,
    /// Starts one of the jobs, if none runs.
    Start(usize),
}

/// A unit and its memory.
struct Bench<F: Format> {
    unit: Unit<F>,
    memory: Vec<u32>,
}

impl<F: Format> Bench<F> {
    fn start(&mut self, scene: &Scene<F>) {
        self.memory.clone_from(&scene.memory);
        self.unit.start(scene.job().unwrap()).unwrap();
    }
}

fn check<F: Format>(
    scenes: &[Scene<F>],
    sizes: Sizes,
    operations: &[Operation],
) -> Result<(), TestCaseError> {
    let bench = || Bench { unit: Unit::<F>::new(sizes).unwrap(), memory: Vec::new() };
    let (mut fast, mut truth) = (bench(), bench());
    for bench in [&mut fast, &mut truth] {
        bench.start(&scenes[0]);
    }
    for operation in operations {
        match *operation {
            Operation::Finish => advance(&mut fast, &mut truth, 3_000_000)?,
            Operation::Advance(cycles) => advance(&mut fast, &mut truth, cycles)?,
            Operation::Tick(cycles) => {
                for _ in 0..cycles {
                    let event = truth.unit.tick(&mut truth.memory);
                    prop_assert_eq!(fast.unit.tick(&mut fast.memory), event);
                }
            }
            Operation::Abort => [&mut fast, &mut truth].map(|bench| bench.unit.abort()).into_iter().collect(),
            Operation::ClearCounters => {
                [&mut fast, &mut truth].map(|bench| bench.unit.clear_counters()).into_iter().collect()
            }
            Operation::Start(_) if fast.unit.is_running() => {}
            Operation::Start(which) => {
                for bench in [&mut fast, &mut truth] {
                    bench.start(&scenes[which % scenes.len()]);
                }
            }
        }
        prop_assert_eq!(fast.unit.counters(), truth.unit.counters(), "{:?}", operation);
        prop_assert_eq!(fast.unit.done(), truth.unit.done());
        prop_assert_eq!(fast.unit.status(), truth.unit.status());
        prop_assert!(fast.memory == truth.memory, "bits differ after {:?}", operation);
    }
    Ok(())
}

fn advance<F: Format>(fast: &mut Bench<F>, truth: &mut Bench<F>, cycles: u64) -> Result<(), TestCaseError> {
    let was_running = fast.unit.is_running();
    let advanced = fast.unit.advance(&mut fast.memory, cycles);
    if was_running {
        let event = (1..=cycles)
            .find_map(|cycle| truth.unit.tick(&mut truth.memory).map(|event| (cycle, Some(event))));
        prop_assert_eq!(advanced, event.unwrap_or((cycles, None)));
    }
    Ok(())
}

fn operation() -> impl Strategy<Value = Operation> {
    prop_oneof![
        6 => (1u64..6).prop_map(Operation::Advance),
        6 => (1u64..60).prop_map(Operation::Advance),
        4 => (1u64..800).prop_map(Operation::Advance),
        1 => Just(Operation::Advance(0)),
        4 => (1u64..30).prop_map(Operation::Tick),
        1 => Just(Operation::Finish),
        1 => Just(Operation::Abort),
        1 => Just(Operation::ClearCounters),
        2 => (0usize..3).prop_map(Operation::Start),
    ]
}

fn sizes() -> impl Strategy<Value = Sizes> {
    let units = prop_oneof![5 => Just(1u32), 1 => 2u32..=4];
    let fifo = || prop_oneof![2 => 1u32..4, 1 => 1u32..64];
    let port = (prop_oneof![2 => 1u32..4, 1 => 1u32..200], prop_oneof![1u32..3, 1u32..70])
        .prop_map(|(latency, bytes_per_cycle)| PortSizes { latency, bytes_per_cycle });
    (units, geometry(), geometry(), fifo(), fifo(), port).prop_map(
        |(units, height_cache, texture_cache, fifo0, fifo1, port)| Sizes {
            units,
            height_cache,
            texture_cache,
            fifo0,
            fifo1,
            port,
        },
    )
}

/// Rays of all kinds, the same ray many times, or rays that hit.
fn rays() -> impl Strategy<Value = Vec<RayOf>> {
    let special = prop::sample::select(vec![
        0.0f32,
        0.25,
        0.5,
        1.0,
        -1.0,
        -0.375,
        3.0,
        -1e-6,
        -1e-20,
        3e7,
        f32::NAN,
        f32::INFINITY,
    ]);
    let entry = prop_oneof![special.clone(), -2.0f32..3.0];
    let slope = prop_oneof![special, -1.5f32..1.5];
    let z = prop_oneof![9 => Just(-1.0f32), 1 => -2.0f32..0.2];
    let ray = (entry.clone(), entry, slope.clone(), slope, z).prop_map(|(u, v, x, y, z)| ([u, v], [x, y, z]));
    let bursts = prop::collection::vec((ray.clone(), 1usize..25), 0..6).prop_map(|bursts| {
        bursts.into_iter().flat_map(|(ray, count)| std::iter::repeat_n(ray, count)).collect::<Vec<_>>()
    });
    let down = (0.0f32..1.0, 0.0f32..1.0).prop_map(|(u, v)| ([u, v], [0.0, 0.0, -1.0]));
    prop_oneof![prop::collection::vec(ray, 0..80), bursts, prop::collection::vec(down, 0..80)]
}

/// Columns of a raster, what a column and a row add, the view vector's z at first, and what a row adds to it.
type Camera = (u32, f32, f32, f32);

/// A job of any kind.
#[derive(Clone, Debug)]
struct Any {
    heights: Heights,
    rays: Vec<RayOf>,
    policies: Policies,
    faults: (RayFaults, u32),
    camera: Option<Camera>,
}

fn any_job() -> impl Strategy<Value = Any> {
    let faults = (
        prop_oneof![4 => Just(RayFaults::Record), 1 => Just(RayFaults::Stop)],
        prop_oneof![Just(4096u32), 1u32..12],
    );
    let camera = prop::option::of((1u32..20, 0.0f32..0.3, -1.5f32..0.1, -0.2f32..0.2));
    (heights(), rays(), policies(), faults, camera)
        .prop_map(|(heights, rays, policies, faults, camera)| Any { heights, rays, policies, faults, camera })
}

impl Any {
    fn scene<F: Format>(&self) -> Scene<F> {
        let mut scene = Scene::<F>::new(&self.heights, &self.rays, self.policies);
        (scene.description.ray_faults, scene.description.watchdog) = self.faults;
        if let Some((columns, step, z, rise)) = self.camera.filter(|_| !self.rays.is_empty()) {
            let width = columns.min(self.rays.len() as u32);
            let of = |v: [f32; 3]| v.map(F::from_f32);
            scene.description.source = Source::Raster(Raster {
                width,
                height: self.rays.len() as u32 / width,
                origin: of([-0.7, -0.8, z]),
                right: of([step, 0.0, 0.0]),
                down: of([0.0, step, rise]),
                eye: of([0.5, 0.5, 1.2]),
                extent: [F::ONE, F::ZERO],
            });
        }
        scene
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]
    #[test]
    fn advance_is_so_many_ticks_whatever_comes_between(
        jobs in prop::collection::vec(any_job(), 1..3),
        sizes in sizes(),
        operations in prop::collection::vec(operation(), 1..60),
    ) {
        check(&jobs.iter().map(Any::scene::<F24>).collect::<Vec<_>>(), sizes, &operations)?;
        check(&jobs.iter().map(Any::scene::<F32>).collect::<Vec<_>>(), sizes, &operations)?;
    }
}

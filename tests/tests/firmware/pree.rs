//! The radiance estimation engine's programs.

use hostsim::accelerate::session::ALPHA;
use hostsim::fixture::{EMITTED, HEIGHT, SCENE, WIDTH};
use hostsim::grid::HashGrid;
use hostsim::picture::fnv1a64;
use hostsim::scene::{LoadOptions, Scene};
use hostsim::trace::{PhotonChunk, eye_pass};
use lucerna_app::{fixture::Fixture, session};
use lucerna_bus::{Model, Timing};
use lucerna_device::PreeDevice;
use lucerna_driver::{
    Counter, Counters, Deadline, EvaluateJob, Hazard, HitPoint, Layout, Lucerna, Photon, Policies, Sizes,
    UpdateJob,
};
use lucerna_softfloat::{F24, F32, Format};

use crate::board::prints;

const JOB: &[u8] = include_bytes!("../../../fixtures/cornell-balls-20x15.lcn");

/// The report of the same session on this host, clock by clock.
fn expected<F: Format>() -> String {
    let mut memory = vec![0; session::MEMORY_WORDS];
    let model = Model::new(PreeDevice::<F, 4, _>::new(&mut memory[..])).with_timing(Timing::Tick);
    let mut report = String::new();
    session::run(model.bus(), model.delay(), &Fixture::new(JOB).unwrap(), &mut report).unwrap();
    report + &format!("clocks {}\n", model.elapsed())
}

#[track_caller]
fn compare<F: Format>(image: &str) {
    let ended = prints(image, &expected::<F>());
    assert!(ended.log.contains(&"info 3162 photons to go".to_owned()), "{:?}", ended.log);

    // And by another way: from the scene, not the file, through the driver alone.
    for (name, hazard, normal_test) in
        [("interlock", Hazard::Interlock, true), ("published", Hazard::Published, false)]
    {
        let value = |what: &str| ended.value(&format!("{name}.{what}"));
        let (counters, digest) = host::<F>(hazard, normal_test);
        assert_eq!(value("fnv1a64"), format!("{digest:#018x}"), "{name}");
        for counter in Counter::ALL.into_iter().filter(|counter| *counter != Counter::StarvedCycles) {
            assert_eq!(value(counter.name()), counters.get(counter).to_string(), "{name}.{}", counter.name());
        }
    }
}

/// Counters and pixels' digest of the job on this host, all photons in the ring at once.
fn host<F: Format>(hazard: Hazard, normal_test: bool) -> (Counters, u64) {
    let scene = Scene::load(SCENE, &LoadOptions::default()).unwrap();
    let points = eye_pass(&scene, WIDTH, HEIGHT);
    let grid = HashGrid::build(&points, WIDTH, HEIGHT).unwrap();
    let mut chunk = PhotonChunk::default();
    chunk.fill(&scene, &grid, 0..EMITTED);
    let hit_points: Vec<_> = points
        .iter()
        .map(|point| HitPoint {
            position: point.position.to_f32(),
            normal: point.normal.to_f32(),
            colour: point.colour.to_f32(),
            radius_squared: (grid.radius() * grid.radius()) as f32,
            pixel: point.pixel,
            ..HitPoint::default()
        })
        .collect();
    let photons: Vec<_> = chunk
        .hits
        .iter()
        .zip(&chunk.lists)
        .map(|(hit, list)| Photon {
            position: hit.position.to_f32(),
            normal: hit.normal.to_f32(),
            flux: hit.flux.to_f32(),
            p_addr: list.p_addr,
            n: list.n,
        })
        .collect();

    let sizes = Sizes {
        hit_points: hit_points.len() as u32,
        index_entries: grid.entries().len() as u32,
        pixels: WIDTH * HEIGHT,
        ring_entries: 4096,
        normal_test,
    };
    let mut memory = vec![0; sizes.bytes() as usize / 4];
    let model = Model::new(PreeDevice::<F, 4, _>::new(&mut memory[..])).with_timing(Timing::Tick);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = Layout::packed(lucerna.capabilities(), sizes).unwrap();
    let policies = Policies { hazard, ..Policies::default() };
    let mut pree = lucerna.pree().unwrap();
    pree.write_hit_points(&layout, 0, &hit_points).unwrap();
    pree.write_index(&layout, 0, grid.entries()).unwrap();
    pree.zero_pixels(&layout).unwrap();
    let mut stream = pree.update(&UpdateJob::new(&layout, ALPHA, policies).unwrap()).unwrap();
    stream.push_all(&photons, Deadline::NOW).unwrap();
    stream.finish(Deadline::seconds(1)).unwrap();
    let evaluate = EvaluateJob::new(&layout, EMITTED as f32, policies).unwrap();
    pree.evaluate(&evaluate).unwrap().wait(Deadline::seconds(1)).unwrap();
    let mut pixels = vec![[0; 3]; (WIDTH * HEIGHT) as usize];
    pree.read_pixel_bits(&layout, 0, &mut pixels).unwrap();
    (pree.counters().unwrap(), fnv1a64(pixels.into_iter().flatten()))
}

#[test]
fn the_committed_job_is_the_one_this_scene_makes() {
    assert!(JOB.len() < 220 << 10, "{} bytes", JOB.len());
    assert!(hostsim::fixture::bytes().unwrap() == JOB, "write it again with `hostsim fixture`");
}

#[test]
fn f32_on_the_board_is_f32_on_the_host() {
    compare::<F32>("pree_f32");
}

#[test]
fn f24_on_the_board_is_f24_on_the_host() {
    compare::<F24>("pree_f24");
}

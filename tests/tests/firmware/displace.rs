//! The displacement unit's programs.

use hostsim::accelerate::Arith;
use hostsim::displace::judge::Verdict;
use hostsim::displace::map::HeightMap;
use hostsim::displace::ray::Surface;
use hostsim::displace::session::{self as host, Outcome};
use hostsim::displace::setup::Setup;
use hostsim::displace::view::{GRID, Raster, View};
use hostsim::displace::workload::{Source, TANGENT_ROWS, Workload};
use hostsim::picture::fnv1a64;
use indicatif::ProgressBar;
use lucerna_app::displace::{self, scene};
use lucerna_bus::{Model, Timing};
use lucerna_device::DisplaceDevice;
use lucerna_displace::engine::Sizes;
use lucerna_driver::NumberFormat;
use lucerna_driver::displace::{Algorithm, Counter};
use lucerna_softfloat::{F24, F32, Format};

use crate::board::prints;

/// The report of the same session on this host.
fn expected<F: Format>(timing: Timing) -> String {
    let mut memory = vec![0; displace::MEMORY_WORDS];
    let device = DisplaceDevice::<F, 1, 512, _>::new(Sizes::default(), &mut memory[..]).unwrap();
    let model = Model::new(device).with_timing(timing);
    let mut report = String::new();
    displace::run(model.bus(), model.delay(), &mut [0; scene::TEXELS], &mut report).unwrap();
    report + &format!("clocks {}\n", model.elapsed())
}

#[track_caller]
fn compare<F: Format>(image: &str, format: NumberFormat) {
    let expected = [Timing::Fast, Timing::Tick].map(expected::<F>);
    assert_eq!(expected[0], expected[1], "fast and clock by clock");
    let ended = prints(image, &expected[0]);
    assert!(ended.log.contains(&"info 768 rays to go".to_owned()), "{:?}", ended.log);

    // And by another way: hostsim's session, in the host's own arithmetic.
    let mut steps = Vec::new();
    for algorithm in [Algorithm::Mix, Algorithm::Fold] {
        let value = |what: &str| ended.value(&format!("{}.{what}", algorithm.name()));
        let setup = Setup {
            format,
            arith: Arith::Fast,
            timing: Timing::Tick,
            policies: algorithm.policies(),
            ..Setup::default()
        };
        let workload = workload();
        let outcome = host::run(&setup, &workload, &ProgressBar::hidden()).unwrap();
        assert_eq!(value("fnv1a64"), format!("{:#018x}", digest(&outcome)), "{algorithm:?}");
        for counter in Counter::ALL {
            let counted = outcome.counters.get(counter).to_string();
            assert_eq!(value(counter.name()), counted, "{algorithm:?} {}", counter.name());
        }
        // Both are right: but for corners, where rounding decides, each ray hit the texel that the exact march finds.
        let verdict = Verdict::new(&workload, format, &setup.policies, &outcome.results);
        assert_eq!(verdict.rays, outcome.counters.hits);
        assert_eq!(verdict.mismatch_exact, verdict.mismatch_corners, "{algorithm:?}");
        steps.push(outcome.counters.steps);
    }
    assert!(steps[1] * 10 < steps[0] * 9, "folding saves a tenth of the steps or more: {steps:?}");
}

/// Of the result records, as the device wrote them.
fn digest(outcome: &Outcome) -> u64 {
    let format = outcome.capabilities.format;
    fnv1a64(outcome.results.iter().flat_map(|result| result.pack(format)))
}

/// The same picture in hostsim's terms: its grid is 200 wide and its world coordinates are doubles, but what reaches the
/// registers is equal.
fn workload() -> Workload {
    let mut heights = [0; scene::TEXELS];
    scene::heights(&mut heights);
    let [width, height] = [scene::SHAPE.width(), scene::SHAPE.height()];
    let map = HeightMap::new("stones", width, height, heights.to_vec()).unwrap();

    let frame = scene::PLANE.frame().unwrap();
    assert_eq!(frame.rows(), TANGENT_ROWS);
    let raster = scene::CAMERA.raster(&scene::PLANE).unwrap();
    let surface = Surface { scale: frame.height_scale.into(), repeat: raster.extent[0].into() };
    assert_eq!(surface.extent().map(|end| end as f32), raster.extent);
    let [u, v, depths] = raster.eye.map(f64::from);
    let side = GRID / surface.repeat;
    let eye = [u * side - GRID / 2.0, depths * surface.scale * side, GRID / 2.0 - v * side];
    let wide = |vector: [f32; 3]| vector.map(f64::from);
    let workload = Workload {
        texture: (0..width * height).map(|place| scene::texel(place % width, place / width)).collect(),
        map,
        surface,
        view: View { eye, ..View::FRONT },
        raster: Raster {
            width: raster.width,
            height: raster.height,
            origin: wide(raster.origin),
            right: wide(raster.right),
            down: wide(raster.down),
        },
        source: Source::Raster,
        rays: Vec::new(),
    };
    assert_eq!(workload.eye(), raster.eye);
    workload
}

#[test]
fn f32_on_the_board_is_f32_on_the_host() {
    compare::<F32>("displace_f32", NumberFormat::F32);
}

#[test]
fn f24_on_the_board_is_f24_on_the_host() {
    compare::<F24>("displace_f24", NumberFormat::F24);
}

#[test]
fn both_pictures_show_the_same() {
    let report = expected::<F24>(Timing::Fast);
    let picture = |name: &str| -> Vec<_> {
        let key = format!("{name}.picture ");
        report.lines().filter_map(|line| line.strip_prefix(&key)).map(str::to_owned).collect()
    };
    let (mix, fold) = (picture("mix"), picture("fold"));
    assert_eq!(mix.len(), scene::HEIGHT);
    let pairs = mix.iter().zip(&fold).flat_map(|(mix, fold)| mix.chars().zip(fold.chars()));
    let differ = pairs.filter(|(mix, fold)| mix != fold).count();
    assert!(differ <= 2 * 4, "{differ} letters differ, two a pixel; rounding decides at corners");
}

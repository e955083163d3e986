//! Does a displacement job's bus trace, done again on a fresh device, read the same words; and is a changed one found?

use std::cell::RefCell;

use lucerna_bus::{Model, ReplayErrorKind, SharedSink, Target, Timing, Traced, TracedDelay, replay_timed};
use lucerna_displace::engine::Sizes as UnitSizes;
use lucerna_driver::displace::{
    Camera, Image, Job, Layout, Plane, Policies, Ray, RayResult, RayStatus, Shape, Sizes, Wrap,
};
use lucerna_driver::{Deadline, Lucerna, NumberFormat};
use lucerna_tests::devices::{Any, full};

const PATIENCE: Deadline = Deadline::millis(100);
const WORDS: usize = 1 << 13;

fn model(format: NumberFormat, soft: bool, timing: Timing, units: u32) -> Model<Any> {
    let sizes = UnitSizes { units, ..UnitSizes::default() };
    Model::new(full(format, soft, sizes, vec![0; WORDS])).with_timing(timing)
}

/// A list, a camera's picture, an abort, a resumed job and the counters, as text.
fn trace(model: &Model<Any>) -> String {
    let text = RefCell::new(String::new());
    let sink = SharedSink::new(&text);
    let bus = Traced::new(model.bus(), sink);
    let mut device = Lucerna::probe(bus, TracedDelay::new(model.delay(), sink)).unwrap();
    let side = Shape::of(8, 8).unwrap();
    let sizes =
        Sizes { map: Shape::of(32, 16).unwrap(), texture: side, normals: side, rays: 100, results: 192 };
    let layout = Layout::packed(device.capabilities(), sizes).unwrap();
    let heights: Vec<u8> = (0..512u32).map(|i| (i.wrapping_mul(0x85eb_ca6b) >> 24) as u8).collect();
    let plane = Plane {
        origin: [0.0; 3],
        tangent: [1.0, 0.0, 0.0],
        bitangent: [0.0, 1.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        repeat: [1.0, 1.0],
        height_scale: 0.25,
        bounded: false,
    };
    let camera = Camera {
        position: [0.5, 0.4, 0.6],
        direction: [0.3, 0.2, -0.9],
        up: [0.0, 1.0, 0.0],
        field_of_view: 1.1,
        width: 16,
        height: 12,
    };
    let mut unit = device.displace().unwrap();
    unit.write_map(&layout, &Image::new(sizes.map, &heights).unwrap()).unwrap();
    unit.write_texture_with(&layout, |x, y| x * 0x0020_0010 + y * 0x0000_0810).unwrap();
    unit.write_normals_with(&layout, |x, y| 0x00f0_8080 + x + y).unwrap();
    let rays: Vec<Ray> = (0..100u16)
        .map(|i| Ray { entry: [f32::from(i) / 37.0, 0.3], view: [0.4, f32::from(i) / 50.0 - 1.0, -1.0] })
        .collect();
    unit.write_rays(&layout, 0, &rays).unwrap();
    let mut results = vec![RayResult::default(); 192];
    let list = Job::list(&layout, 100, &plane, Policies::FOLD.with_wrap(Wrap::Border)).unwrap();
    unit.start(&list).unwrap().wait(PATIENCE).unwrap();
    unit.read_results(&layout, 0, &mut results).unwrap();
    let picture = Job::raster(&layout, &camera, &plane, Policies::MIX_GPU).unwrap();
    let mut run = unit.start(&picture).unwrap();
    let _ = run.rays_done().unwrap();
    run.abort().unwrap();
    let _ = unit.start(&picture).unwrap().poll().unwrap();
    unit.resume().unwrap().wait(PATIENCE).unwrap();
    unit.read_results(&layout, 0, &mut results).unwrap();
    assert!(results.iter().any(|result| result.status == RayStatus::Hit));
    assert!(unit.counters().unwrap().steps > 500);
    let _ = device.release();
    text.into_inner()
}

#[test]
fn a_trace_is_the_same_under_every_timing_and_arithmetic() {
    for format in [NumberFormat::F24, NumberFormat::F32] {
        for units in [1, 3] {
            let traced = model(format, false, Timing::Fast, units);
            let text = trace(&traced);
            let accesses = text.lines().filter(|line| !line.starts_with('d')).count() as u64;
            assert!(accesses > 200, "{accesses}");
            for (soft, timing) in [(false, Timing::Tick), (true, Timing::Fast), (true, Timing::Tick)] {
                let again = model(format, soft, timing, units);
                let replayed = replay_timed(&text, &mut again.bus(), &mut again.delay())
                    .unwrap_or_else(|error| panic!("{format:?} {units} {soft} {timing:?}: {error}"));
                assert_eq!(replayed.accesses, accesses);
                assert_eq!(again.elapsed(), traced.elapsed(), "to the clock");
                let memory = |model: &Model<Any>| {
                    let mut words = vec![0; WORDS];
                    model.inspect(|device| device.load(0, &mut words)).unwrap();
                    words
                };
                assert!(memory(&again) == memory(&traced));
            }
            // Another device is told by its words.
            let other = model(format, false, Timing::Fast, units + 1);
            let error = replay_timed(&text, &mut other.bus(), &mut other.delay()).expect_err("another unit");
            assert!(matches!(error.kind, ReplayErrorKind::Differs { .. }), "{error}");
        }
    }
}

fn flip(line: &str) -> String {
    let (rest, last) = line.rsplit_once(' ').unwrap();
    format!("{rest} {:x}", u32::from_str_radix(last, 16).unwrap() ^ 0x10)
}

#[test]
fn a_changed_word_is_found_with_its_line() {
    let text = trace(&model(NumberFormat::F24, false, Timing::Fast, 1));
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let replayed = |number: usize| {
        let mut lines = lines.clone();
        lines[number] = flip(&lines[number]);
        let model = model(NumberFormat::F24, false, Timing::Fast, 1);
        replay_timed(&lines.join("\n"), &mut model.bus(), &mut model.delay()).map_err(|error| error.line)
    };
    let of = |kind: &str| -> Vec<usize> {
        (0..lines.len()).filter(|number| lines[*number].starts_with(kind)).collect()
    };
    let reads = [of("r "), of("R ")].concat();
    assert!(reads.len() > 90, "{}", reads.len());
    for number in reads {
        assert_eq!(replayed(number), Err(number + 1), "an answer that was another: {}", lines[number]);
    }
    // Another height, ray or number is seen in a result, so in a later line.
    let rays = of("W ").into_iter().rev().take(3);
    for number in rays {
        let padding = lines[number].ends_with(" 0");
        assert!(padding || replayed(number).expect_err("another word") > number + 1, "{}", lines[number]);
    }
}

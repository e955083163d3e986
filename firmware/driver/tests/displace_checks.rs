//! Can an illegal displacement job be made? And are policies and records what they should be?

mod common;

use common::displacer::{SIZES, camera, capabilities, layout, plane};
use lucerna_driver::displace::{
    Algorithm, Ascend, Camera, Coherent, Frame, Job, JobError, Layout, LevelsDown, Light, Plane, Policies,
    Ray, RayResult, RayStatus, Reach, Sizes, Source, Wrap,
};
use lucerna_driver::records::{decode, encode};
use lucerna_driver::{Capabilities, NumberFormat};
use proptest::prelude::*;

#[test]
fn named_algorithms_are_the_paper_s() {
    // Start level, levels down, ascend.
    let wanted = [
        ("oh", false, LevelsDown::One, Ascend::Never),
        ("tevs", false, LevelsDown::One, Ascend::Parity),
        ("a", true, LevelsDown::One, Ascend::Never),
        ("b", false, LevelsDown::Two, Ascend::Never),
        ("c1", false, LevelsDown::One, Ascend::Selective),
        ("c2", false, LevelsDown::One, Ascend::Coherent),
        ("mix", true, LevelsDown::Two, Ascend::Selective),
        ("mix-gpu", true, LevelsDown::Two, Ascend::Coherent),
        ("fold", true, LevelsDown::Three, Ascend::Selective),
    ];
    for (algorithm, wanted) in Algorithm::ALL.into_iter().zip(wanted) {
        let policies = Policies::from(algorithm);
        let found = (algorithm.name(), policies.start_level, policies.levels_down, policies.ascend);
        assert_eq!(found, wanted);
        let rest = (policies.wrap, policies.start_grid, policies.coherent);
        assert_eq!(rest, (Wrap::Repeat, 0, Coherent::Toggle));
        let beyond = if algorithm == Algorithm::Fold { (Reach::Two, true) } else { (Reach::One, false) };
        assert_eq!((policies.reach, policies.siblings), beyond);
    }
    assert_eq!(Policies::B, Policies::b(LevelsDown::Two));
    assert_eq!(Algorithm::B(LevelsDown::Four).policies().levels_down, LevelsDown::Four);
}

fn job(source: Source, frame: Frame) -> Result<Job, JobError> {
    Job::new(&layout(SIZES), source, frame, Policies::MIX)
}

#[test]
fn every_illegal_job_has_its_error() {
    let frame = plane().frame().unwrap();
    let list = |count| job(Source::List { count }, frame).map(|_| ());
    assert_eq!([1, 2, 3, 4].map(list), [Ok(()); 4]);
    assert_eq!([0, 5, u32::MAX].map(list), [Err(JobError::RayCount); 3]);
    let few = Layout::packed(&capabilities(), Sizes { results: 3, ..SIZES }).unwrap();
    assert_eq!(Job::list(&few, 4, &plane(), Policies::MIX), Err(JobError::RayCount), "a result each");

    let raster = camera().raster(&plane()).unwrap();
    let pixels = |width, height| {
        job(Source::Raster(lucerna_driver::displace::Raster { width, height, ..raster }), frame).err()
    };
    assert_eq!([pixels(2, 2), pixels(4, 1), pixels(1, 1)], [None; 3]);
    for (width, height) in [(0, 1), (1, 0), (5, 1), (3, 2), (65536, 1), (1 << 16, 1 << 16), (u32::MAX, 2)] {
        assert_eq!(pixels(width, height), Some(JobError::RasterSize), "{width} by {height}");
    }
    let look = |camera: Camera| Job::raster(&layout(SIZES), &camera, &plane(), Policies::MIX).err();
    assert_eq!(look(camera()), None);
    for field_of_view in [0.0, -1.0, core::f32::consts::PI, 4.0, f32::NAN] {
        assert_eq!(look(Camera { field_of_view, ..camera() }), Some(JobError::Camera), "{field_of_view}");
    }
    assert_eq!(look(Camera { direction: [0.0; 3], ..camera() }), Some(JobError::Camera));
    assert_eq!(look(Camera { up: [0.0, 3.0, 0.0], ..camera() }), Some(JobError::Camera));
    assert_eq!(look(camera().looking_at(camera().position)), Some(JobError::Camera));
    for height in [0.0, -2.0, f32::NAN, f32::INFINITY] {
        assert_eq!(
            look(Camera { position: [0.0, height, 0.0], ..camera() }),
            Some(JobError::Eye),
            "{height}"
        );
    }

    let flat = |plane: Plane| Job::list(&layout(SIZES), 1, &plane, Policies::MIX).err();
    assert_eq!(flat(plane()), None);
    for broken in [
        Plane { tangent: [0.0; 3], ..plane() },
        Plane { bitangent: plane().tangent, ..plane() },
        Plane { normal: plane().tangent, ..plane() },
        Plane { normal: [0.0; 3], ..plane() },
        Plane { repeat: [0.0, 1.0], ..plane() },
        Plane { repeat: [1.0, -1.0], ..plane() },
        Plane { tangent: [f32::NAN, 0.0, 0.0], ..plane() },
    ] {
        assert_eq!(flat(broken), Some(JobError::Plane), "{broken:?}");
    }
    for height_scale in [0.0, -0.1, f32::NAN, f32::INFINITY] {
        assert_eq!(flat(Plane { height_scale, ..plane() }), Some(JobError::HeightScale), "{height_scale}");
    }
    let extent = lucerna_driver::displace::Raster { extent: [-1.0, 0.0], ..raster };
    assert_eq!(job(Source::Raster(extent), frame), Err(JobError::Plane));

    let fine = Policies::MIX.with_start_grid(4);
    assert_eq!(Job::list(&layout(SIZES), 1, &plane(), fine), Err(JobError::StartGrid));
    let job = job(Source::List { count: 1 }, frame).unwrap();
    assert_eq!([0, 65536].map(|steps| job.with_watchdog(steps).err()), [Some(JobError::Watchdog); 2]);
    assert_eq!(job.with_watchdog(65535).unwrap().watchdog(), 65535);
    assert_eq!(job.with_light(Light::towards([0.0; 3], 0.0, 1.0)), Err(JobError::Light));
    let dark = Light { ambient: f32::INFINITY, ..Light::default() };
    assert_eq!(job.with_light(dark), Err(JobError::Light));
}

#[test]
fn numbers_are_judged_in_the_device_s_format() {
    let device = Capabilities { format: NumberFormat::F24, ..capabilities() };
    let small = Layout::packed(&device, SIZES).unwrap();
    // Below half of the least F24, 2^-78.
    let shallow = Plane { height_scale: 1e-24, ..plane() };
    Job::list(&layout(SIZES), 1, &shallow, Policies::MIX).unwrap();
    assert_eq!(Job::list(&small, 1, &shallow, Policies::MIX), Err(JobError::HeightScale));
    // Above the greatest, just below 2^64.
    let far = Camera { position: [0.0, 1e21, 0.0], ..camera() };
    Job::raster(&layout(SIZES), &far, &plane(), Policies::MIX).unwrap();
    assert_eq!(Job::raster(&small, &far, &plane(), Policies::MIX), Err(JobError::Eye));
    // The study format holds what an f32 holds.
    assert_eq!(encode(NumberFormat::F64, 0.1), 0.1f32.to_bits());
    assert_eq!(decode(NumberFormat::F64, 0.1f32.to_bits()), 0.1);
}

proptest! {
    #[test]
    fn records_pack_and_unpack(words: [u32; 8]) {
        for format in NumberFormat::ALL {
            let ray = Ray::unpack(format, &words).pack(format);
            prop_assert_eq!(Ray::unpack(format, &ray).pack(format), ray);
            prop_assert_eq!(&ray[5..], &[0; 3]);
            let result = RayResult::unpack(format, &words).pack(format);
            prop_assert_eq!(RayResult::unpack(format, &result).pack(format), result);
            prop_assert_eq!((result[0], result[1], result[3]), (words[0], words[1], words[3]));
            prop_assert_eq!((result[4], result[7]), (words[4] & 0x00FF_FFFF, 0));
        }
    }
}

#[test]
fn a_result_is_read_field_by_field() {
    let words = [u32::MAX, 300, 0x3F00_0000, 0x0309_1000, 0x0012_3456, 0x3E80_0000, 0xBF80_0000, 7];
    let result = RayResult::unpack(NumberFormat::F32, &words);
    let wanted = RayResult {
        status: RayStatus::Watchdog,
        texel: [-1, 300],
        t: 0.5,
        steps: 4096,
        level: 9,
        colour: [0x12, 0x34, 0x56],
        position: [0.25, -1.0],
    };
    assert_eq!(result, wanted);
    let status = |bits: u32| RayResult::unpack(NumberFormat::F32, &[0, 0, 0, bits << 24, 0, 0, 0, 0]).status;
    let wanted =
        [RayStatus::Hit, RayStatus::Miss, RayStatus::Grazing, RayStatus::Watchdog, RayStatus::Unknown(4)];
    assert_eq!([0, 1, 2, 3, 4].map(status), wanted);
}

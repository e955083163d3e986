//! Does the displacement unit, asked through the driver, find what an exact march finds, wave after wave?

mod march;

use std::path::Path;

use hostsim::accelerate::Setup;
use hostsim::displace::procedural;
use hostsim::render::units::Units;
use hostsim::scene::{LoadOptions, Scene};
use hostsim::trace::{chunks, eye_pass_through, trace_photons_through};
use lucerna_driver::NumberFormat;
use march::March;

fn room() -> Scene {
    Scene::load("relief-room", &LoadOptions::default()).expect("it is built in")
}

#[test]
fn the_unit_finds_what_the_march_finds() {
    let scene = room();
    let map = procedural::map("pebbles").unwrap();
    let (log2, heights) = (map.log2(), map.heights().to_vec());
    let mut march = March { scene: &scene, log2, heights, asked: Vec::new() };
    let Ok(exact) = eye_pass_through(&scene, 96, 72, &mut march);
    for (format, tolerance, others) in
        [(NumberFormat::F64, 1e-5, 0.001), (NumberFormat::F32, 1e-5, 0.001), (NumberFormat::F24, 1e-3, 0.01)]
    {
        let mut units = Units::new(&scene, &Setup { format, ..Setup::default() }).unwrap();
        let points = eye_pass_through(&scene, 96, 72, &mut units).unwrap();
        assert_eq!(points.len(), exact.len());
        let far = points.iter().zip(&exact).filter(|(a, b)| (a.position - b.position).length() > tolerance);
        let far = far.count() as f64 / march.asked.len() as f64;
        assert!(far < others, "{format:?}: {far}");

        let (counters, jobs) = units.counters().unwrap()[0];
        assert_eq!((counters.rays, jobs), (march.asked.len() as u64, 1));
        assert!(counters.rays > 2000 && counters.steps > 3 * counters.rays);
        assert!(counters.cycles > counters.steps);
        // A second wave on the same device: the maps are still there, and the counters go on.
        assert_eq!(eye_pass_through(&scene, 96, 72, &mut units).unwrap(), points);
        assert_eq!(units.counters().unwrap()[0].0.rays, 2 * counters.rays);
    }
}

#[test]
fn photons_do_not_depend_on_chunks() {
    let scene = room();
    let mut units = Units::new(&scene, &Setup::default()).unwrap();
    let mut whole = Vec::new();
    trace_photons_through(&scene, 0..2000, &mut whole, &mut units).unwrap();
    let mut parts = Vec::new();
    for range in chunks(2000, 300) {
        trace_photons_through(&scene, range, &mut parts, &mut units).unwrap();
    }
    assert!(whole.len() > 4000 && whole.iter().any(|hit| hit.position.y < -0.02));
    assert_eq!(whole, parts);
}

#[test]
fn a_map_that_is_not_there_is_named() {
    let text = "[camera]\neye = [0, 1, 3]\ntarget = [0, 0, 0]\nfield_of_view = 40\n\
                [light]\nposition = [0, 3, 0]\nintensity = [1, 1, 1]\n\
                [[displaced]]\ncorner = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, -1]\nmap = \"hills\"\n\
                height_scale = 0.1\ncolour = [1, 1, 1]\n";
    let scene = Scene::from_toml(text, "trial", Path::new(""), &LoadOptions::default()).unwrap();
    let error = Units::new(&scene, &Setup::default()).err().expect("no such map").to_string();
    assert!(error.contains("scene `trial`, [[displaced]] number 1: there is no built-in height map `hills`"));
}

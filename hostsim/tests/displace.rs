//! Does a displaced surface come out right, and do its commands say what is wrong when something is?

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use hostsim::displace::judge::Verdict;
use hostsim::displace::ray::Surface;
use hostsim::displace::setup::Setup;
use hostsim::displace::view::View;
use hostsim::displace::workload::{Source, Workload};
use hostsim::displace::{procedural, session};
use indicatif::ProgressBar;
use lucerna_driver::NumberFormat;
use lucerna_driver::displace::{Algorithm, Coherent, LevelsDown, Policies, Wrap};

fn hostsim(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hostsim"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("text")
}

#[track_caller]
fn refused(folder: &Path, arguments: &[&str], what: &str) {
    let output = hostsim(folder, arguments);
    let said = text(&output.stderr);
    assert!(!output.status.success(), "{arguments:?} succeeded");
    assert!(said.trim_start().starts_with("error: ") && said.contains(what), "`{what}` is not in: {said}");
    assert!(!said.contains("panicked") && said.len() < 1500, "{said}");
}

fn report(folder: &Path, more: &[&str]) -> serde_json::Value {
    let arguments = [&["displace", "--size", "64x48", "--out", "out"], more].concat();
    let output = hostsim(folder, &arguments);
    assert!(output.status.success(), "{more:?}: {}", text(&output.stderr));
    serde_json::from_str(&fs::read_to_string(folder.join("out/report.json")).unwrap()).unwrap()
}

fn all_policies() -> Vec<Policies> {
    let named = Algorithm::ALL.into_iter().map(Algorithm::policies);
    let more = [
        Policies::b(LevelsDown::Three),
        Policies::b(LevelsDown::Four),
        Policies::A.with_start_grid(3),
        Policies::C2.with_coherent(Coherent::Consecutive),
        Policies::MIX_GPU.with_coherent(Coherent::Parity),
    ];
    named.chain(more).collect()
}

fn judged(workload: &Workload, setup: &Setup) -> (Verdict, session::Outcome) {
    let outcome = session::run(setup, workload, &ProgressBar::hidden()).unwrap();
    (Verdict::new(workload, setup.format, &setup.policies, &outcome.results), outcome)
}

/// In f64 every algorithm finds the exact march's texel, with the steps of the oracle's traversal.
#[test]
fn every_algorithm_is_the_exact_march_in_f64() {
    for (number, name) in procedural::names().into_iter().enumerate() {
        let surface = Surface { scale: 0.12, repeat: [1.0, 2.5][number % 2] };
        for view in [View::FRONT, View::oblique(), View::grazing(), View::random(number as u64)] {
            let map = procedural::map(name).unwrap();
            let workload = Workload::new(map, surface, view, (40, 30), Source::List);
            for wrap in [Wrap::Repeat, Wrap::Border] {
                for policies in all_policies() {
                    let policies = policies.with_wrap(wrap);
                    let setup = Setup { format: NumberFormat::F64, policies, ..Setup::default() };
                    let (verdict, outcome) = judged(&workload, &setup);
                    assert_eq!(verdict.mismatch_exact, verdict.mismatch_corners, "{name} {policies:?}");
                    assert!(verdict.mismatch_corners <= 1, "{name} {policies:?}");
                    assert_eq!(verdict.step_differences, 0, "{name} {policies:?}");
                    assert_eq!(outcome.counters.watchdogs, 0, "{name} {policies:?}");
                    assert_eq!(outcome.traversed(), verdict.rays);
                }
            }
        }
    }
}

/// 200 views by chance, in the hardware's format: no ray is lost, and 99.85 % of the texels are the exact march's.
#[test]
fn no_view_hangs_the_hardwares_format() {
    let names = procedural::names();
    let (mut rays, mut wrong) = (0, 0);
    for number in 0..200 {
        let map = procedural::map(names[number as usize % names.len()]).unwrap();
        let surface = Surface { scale: 0.15, repeat: [1.0, 4.0, 0.37][number as usize % 3] };
        let source = [Source::List, Source::Raster][number as usize % 2];
        let workload = Workload::new(map, surface, View::random(number), (48, 36), source);
        let policies = all_policies()[number as usize % all_policies().len()];
        let (verdict, outcome) = judged(&workload, &Setup { policies, ..Setup::default() });
        assert_eq!(outcome.counters.watchdogs, 0, "view {number}");
        (rays, wrong) = (rays + verdict.rays, wrong + verdict.mismatch_exact);
    }
    assert!(rays > 100_000);
    assert!(wrong * 10_000 <= rays * 15, "{wrong} of {rays}");
}

#[test]
fn a_picture_has_its_files_and_its_report_every_field() {
    let folder = tempfile::tempdir().unwrap();
    let report = report(folder.path(), &[]);
    for file in ["picture.png", "steps.png", "difference.png"] {
        let picture = image::open(folder.path().join("out").join(file)).unwrap();
        assert_eq!((picture.width(), picture.height()), (64, 48), "{file}");
    }
    for field in [
        "/rays",
        "/steps_per_pixel",
        "/crossing_probability",
        "/max_steps",
        "/watchdog_hits",
        "/texel_mismatch_exact",
        "/texel_mismatch_f64",
        "/cache/accesses",
        "/cache/hit_rate",
        "/cache/bytes",
        "/cycles",
        "/cycles_per_pixel",
        "/occupancy/view",
        "/occupancy/traverse",
        "/occupancy/address",
        "/occupancy/read",
        "/occupancy/colour",
        "/mpixels_per_s_at_84mhz",
        "/mpixels_per_s_at_500mhz",
        "/steps_per_second",
        "/steps_per_second_over_oracle",
        "/hits",
        "/missed",
    ] {
        assert!(report.pointer(field).is_some_and(serde_json::Value::is_number), "{field}");
    }
    assert_eq!(report["counters"].as_object().unwrap().len(), 37);
    assert!(report["rays"].as_u64().unwrap() > 2000);
    assert!(report["steps_per_pixel"].as_f64().unwrap() > 1.0);
}

/// What changes speed changes no result; what changes the device changes its cycles.
#[test]
fn options_do_what_they_say() {
    let folder = tempfile::tempdir().unwrap();
    let report = |more: &[&str]| report(folder.path(), more);
    let plain = report(&[]);
    for same in [
        &["--timing", "tick"][..],
        &["--arith", "soft"],
        &["--units", "4"],
        &["--cache", "2K,1,16"],
        &["--texture-cache", "512K,8,64"],
    ] {
        let other = report(same);
        assert_eq!(other["results_fnv1a64"], plain["results_fnv1a64"], "{same:?}");
        assert_eq!(other["steps"], plain["steps"]);
    }
    let cycles = |more: &[&str]| report(more)["cycles"].as_u64().unwrap();
    assert_eq!(cycles(&["--timing", "tick"]), plain["cycles"].as_u64().unwrap());
    assert_eq!(cycles(&["--arith", "soft"]), plain["cycles"].as_u64().unwrap());
    assert!(cycles(&["--units", "4"]) < plain["cycles"].as_u64().unwrap());
    assert!(cycles(&["--cache", "64,1,16"]) > plain["cycles"].as_u64().unwrap());
    let raster = report(&["--source", "raster"]);
    let difference = raster["rays"].as_i64().unwrap() - plain["rays"].as_i64().unwrap();
    assert!(difference.abs() < 10, "{difference}");
    for algorithm in ["tevs", "oh", "a", "b", "c1", "c2", "mix-gpu", "fold"] {
        let other = report(&["--algorithm", algorithm, "--format", "f64"]);
        assert_ne!(other["steps"], plain["steps"], "{algorithm}");
        assert_eq!(other["texel_mismatch_exact"], 0.0, "{algorithm}");
    }
    assert_eq!(report(&["--levels-down", "4"])["policies"]["levels_down"], 4);
    assert_eq!(report(&["--format", "f32"])["format"], "f32");
    let report = report(&["--view", "30,-40", "--map", "maze", "--scale", "0.3", "--repeat", "2.5"]);
    assert_eq!(
        (&report["map"], &report["scale"], &report["repeat"]),
        (&"maze".into(), &0.3.into(), &2.5.into())
    );
}

#[test]
fn maps_are_read_or_explained() {
    let folder = tempfile::tempdir().unwrap();
    let save = |name: &str, width: u32, height: u32| {
        let picture = image::GrayImage::from_fn(width, height, |x, y| image::Luma([(x * 7 + y * 13) as u8]));
        picture.save(folder.path().join(name)).unwrap();
    };
    for (name, width, height) in [("one.png", 1, 1), ("row.png", 64, 1), ("tall.png", 2, 128)] {
        save(name, width, height);
        let report = report(folder.path(), &["--map", name]);
        assert_eq!((&report["map_width"], &report["map_height"]), (&width.into(), &height.into()));
        assert_eq!(report["watchdog_hits"], 0);
    }
    save("odd.png", 100, 64);
    fs::write(folder.path().join("text.png"), "no picture").unwrap();
    let map = |map: &str, what: &str| refused(folder.path(), &["displace", "--map", map], what);
    map("odd.png", "100x64");
    map("text.png", "text.png");
    map("nowhere.png", "nowhere.png");
    map("pebble", "neither a file nor a built-in height map");
    map(".", "height map");
    map("", "height map");
}

/// Settings nobody asked for, and options without effect, are named.
#[test]
fn what_the_user_should_know_is_noted() {
    let folder = tempfile::tempdir().unwrap();
    let picture = image::GrayImage::from_pixel(256, 256, image::Luma([90]));
    picture.save(folder.path().join("dent_height.png")).unwrap();
    let notes = |more: &[&str]| report(folder.path(), more)["notes"].to_string();
    let preset = notes(&["--map", "dent_height.png"]);
    for word in ["preset dent", "depth 0.2", "repeat 4", "128 texels", "reduced"] {
        assert!(preset.contains(word), "{word}: {preset}");
    }
    assert!(!notes(&["--map", "dent_height.png", "--scale", "0.1"]).contains("depth"));
    assert_eq!(notes(&["--map", "bricks"]), "[]");
    assert!(notes(&["--algorithm", "oh", "--reach", "2"]).contains("--reach has no effect"));
    assert!(notes(&["--coherent", "parity"]).contains("--coherent has no effect"));
    assert!(notes(&["--algorithm", "tevs", "--levels-down", "2"]).contains("--levels-down 2"));
    let arguments = ["displace", "--size", "64x48", "--wrap", "border", "--repeat", "3", "--out", "out"];
    let said = hostsim(folder.path(), &arguments);
    assert!(text(&said.stdout).contains("missed") && text(&said.stderr).contains("one copy of the map"));
    let said = text(&hostsim(folder.path(), &["displace", "--size", "64x48", "--source", "raster"]).stdout);
    assert!(said.contains("take the view unit's time too"), "{said}");
}

#[test]
fn words_that_mean_nothing_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (more, what) in [
        (["--view", "up"], "YAW,PITCH"),
        (["--view", "0,40,0,5,0"], "no pixel meets the surface"),
        (["--scale", "0"], "--scale"),
        (["--scale", "nan"], "--scale"),
        (["--repeat", "-1"], "--repeat"),
        (["--algorithm", "d"], "--algorithm"),
        (["--levels-down", "5"], "--levels-down"),
        (["--format", "f16"], "--format"),
        (["--cache", "16K,3,32"], "SIZE,WAYS,LINE"),
        (["--cache", "64M,4,32"], "SIZE,WAYS,LINE"),
        (["--cache", "1024K,4,32"], "'--cache <CACHE>': the cache would have 32768 lines"),
        (["--texture-cache", "16K,4,128"], "'--texture-cache <TEXTURE_CACHE>': a cache line"),
        (["--units", "5"], "--units"),
        (["--units", "0"], "--units"),
        (["--size", "0x1"], "WIDTHxHEIGHT"),
        (["--watchdog", "0"], "--watchdog"),
    ] {
        refused(folder.path(), &[&["displace"][..], &more].concat(), what);
    }
    fs::write(folder.path().join("file"), "").unwrap();
    refused(folder.path(), &["displace", "--size", "8x8", "--out", "file"], "file");
    refused(folder.path(), &["displace", "--format", "f64", "--arith", "soft"], "no soft-float f64");
}

/// Any of the seven maps will do; what is not there is said.
#[test]
fn the_tables_are_printed_for_the_maps_that_are_there() {
    let folder = tempfile::tempdir().unwrap();
    refused(folder.path(), &["reproduce", "displacement", "--maps", "."], "rocks_height.png");
    refused(folder.path(), &["reproduce", "displacement"], "--maps");
    refused(folder.path(), &["reproduce", "displacement", "--maps", "nowhere"], "cannot be read");
    for (name, built_in) in [("rocks", "pebbles"), ("dent", "craters")] {
        let map = procedural::map(built_in).unwrap();
        let picture = image::GrayImage::from_raw(256, 256, map.heights().to_vec()).unwrap();
        picture.save(folder.path().join(format!("{name}_height.png"))).unwrap();
    }
    refused(folder.path(), &["reproduce", "displacement", "--maps", "dent_height.png"], "is a file");
    let arguments = ["reproduce", "displacement", "--maps", ".", "--size", "64x48", "--out", "out"];
    let output = hostsim(folder.path(), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let said = text(&output.stdout);
    assert!(
        said.contains("nothing is concluded") && !said.contains("ray tracer"),
        "one map has no law: {said}"
    );
    let place = folder.path().canonicalize().unwrap().join("out");
    assert!(said.contains(place.to_str().unwrap()), "the folder is named whole");
    for word in
        ["Table 1", "Table 2", "Table 3", "Table 4", "Table 5", "Tables 6, 7", "stones_height.png", "reduced"]
    {
        assert!(said.contains(word), "{word}");
    }
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("out/displacement.json")).unwrap())
            .unwrap();
    assert_eq!((json["maps"].as_array().unwrap().len(), json["missing"].as_array().unwrap().len()), (2, 5));
    let cells = json["cells"].as_array().unwrap();
    let of = |table: &str, map: &str| {
        cells.iter().filter(|cell| cell["table"] == table && cell["map"] == map).count()
    };
    assert_eq!([of("Table 2", "rocks"), of("Table 3", "rocks")], [6, 24]);
    // Nine rows, two readings of (c2), and for dent the finer grid.
    assert_eq!([of("Table 4", "rocks"), of("Table 4", "dent")], [33, 36]);
    assert!(cells.iter().all(|cell| !cell["reason"].as_str().unwrap().is_empty()));
}

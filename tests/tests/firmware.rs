//! Does a Cortex-M print what a host computes, to the bit and the cycle?
//!
//! The images are built once, into a folder of their own, and run by the very runner that `cargo run` uses.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use hostsim::accelerate::session::ALPHA;
use hostsim::fixture::{EMITTED, HEIGHT, SCENE, WIDTH};
use hostsim::grid::HashGrid;
use hostsim::picture::fnv1a64;
use hostsim::scene::{LoadOptions, Scene};
use hostsim::size::attribute::demangle;
use hostsim::size::{self, build};
use hostsim::trace::{PhotonChunk, eye_pass};
use lucerna_app::{fixture::Fixture, session};
use lucerna_bus::{Model, Timing};
use lucerna_device::Device;
use lucerna_driver::{
    Counter, Counters, Deadline, EvaluateJob, Hazard, HitPoint, Layout, Lucerna, Photon, Policies, Sizes,
    UpdateJob,
};
use lucerna_softfloat::{F24, F32, Format};
use object::{Object, ObjectSection, ObjectSymbol};

const JOB: &[u8] = include_bytes!("../../fixtures/cornell-balls-20x15.lcn");
/// A run takes seconds; a program that hangs shall not hang the tests.
const PATIENCE: Duration = Duration::from_secs(90);

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn options() -> size::Options {
    let target_dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("images");
    size::Options { target_dir, ..size::Options::default() }
}

/// The folder of the programs, built by whoever asks first.
fn images() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let options = options();
        build::images(&options.root, &options.target_dir).unwrap_or_else(|error| panic!("{error}"))
    })
}

/// What a program did.
struct Ended {
    status: i32,
    stdout: String,
    stderr: String,
    log: Vec<String>,
}

/// Runs an image under QEMU; `name` is the test's.
#[track_caller]
fn run(name: &str, elf: &Path) -> Ended {
    let config = fs::read_to_string(root().join(".cargo/config.toml")).unwrap();
    let config: toml::Table = config.parse().unwrap();
    let runner = config["target"][build::TARGET]["runner"].as_str().unwrap();
    let [program, arguments @ ..] = &*runner.split(' ').collect::<Vec<_>>() else { panic!("no runner") };

    let place = |suffix: &str| Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.{suffix}"));
    let log = place("defmt");
    let mut child = Command::new(program)
        .args(arguments)
        .arg(elf)
        .args(["-monitor", "none", "-serial", "null", "-serial"])
        .arg(format!("file:{}", log.display()))
        .stdin(Stdio::null())
        .stdout(File::create(place("stdout")).unwrap())
        .stderr(File::create(place("stderr")).unwrap())
        .spawn()
        .unwrap_or_else(|error| {
            panic!("{program}: {error}. Install QEMU's Arm system emulator (Debian: apt-get install qemu-system-arm)")
        });
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if start.elapsed() > PATIENCE {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("{name}: no end within {PATIENCE:?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    Ended {
        status: status.code().expect("QEMU ended by itself"),
        stdout: fs::read_to_string(place("stdout")).unwrap(),
        stderr: fs::read_to_string(place("stderr")).unwrap(),
        log: decode(elf, &fs::read(log).unwrap()),
    }
}

/// The log's lines, "LEVEL text".
fn decode(elf: &Path, frames: &[u8]) -> Vec<String> {
    let table =
        defmt_decoder::Table::parse(&fs::read(elf).unwrap()).unwrap().expect("the image logs by defmt");
    let mut decoder = table.new_stream_decoder();
    decoder.received(frames);
    let mut lines = Vec::new();
    while let Ok(frame) = decoder.decode() {
        let level = frame.level().map_or("", |level| level.as_str());
        lines.push(format!("{level} {}", frame.display_message()));
    }
    lines
}

/// A copy of an image with other bytes at a symbol.
fn patched(name: &str, image: &str, symbol: &str, bytes: &[u8]) -> PathBuf {
    let mut elf = fs::read(images().join(image)).unwrap();
    let file = object::File::parse(&*elf).unwrap();
    let symbol =
        file.symbols().find(|found| found.name().is_ok_and(|name| demangle(name) == symbol)).unwrap();
    let section = file.section_by_index(symbol.section_index().unwrap()).unwrap();
    let (start, _) = section.file_range().unwrap();
    // The lowest bit of a function's address only says that it is Thumb code.
    let place = (start + (symbol.address() & !1) - section.address()) as usize;
    elf[place..place + bytes.len()].copy_from_slice(bytes);
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.elf"));
    fs::write(&path, elf).unwrap();
    path
}

/// The report of the same session on this host, clock by clock.
fn expected<F: Format>() -> String {
    let mut memory = vec![0; session::MEMORY_WORDS];
    let model = Model::new(Device::<F, 4, _>::new(&mut memory[..])).with_timing(Timing::Tick);
    let mut report = String::new();
    session::run(model.bus(), model.delay(), &Fixture::new(JOB).unwrap(), &mut report).unwrap();
    report + &format!("clocks {}\n", model.elapsed())
}

#[track_caller]
fn compare<F: Format>(image: &str) {
    let ended = run(image, &images().join(image));
    assert_eq!((ended.status, &*ended.stderr), (0, ""), "{}", ended.stdout);
    let expected = expected::<F>();
    for (line, (found, expected)) in ended.stdout.lines().zip(expected.lines()).enumerate() {
        assert_eq!(found, expected, "line {}", line + 1);
    }
    assert_eq!(ended.stdout, expected);
    assert!(ended.log.contains(&"info 3162 photons to go".to_owned()), "{:?}", ended.log);

    // And by another way: from the scene, not the file, through the driver alone.
    for (name, hazard, normal_test) in
        [("interlock", Hazard::Interlock, true), ("published", Hazard::Published, false)]
    {
        let value = |what: &str| {
            let key = format!("{name}.{what} ");
            ended
                .stdout
                .lines()
                .find_map(|line| line.strip_prefix(&key))
                .unwrap_or_else(|| panic!("no {key}"))
        };
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
    let model = Model::new(Device::<F, 4, _>::new(&mut memory[..])).with_timing(Timing::Tick);
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

#[test]
fn the_driver_alone_says_when_there_is_no_device() {
    let ended = run("driver_only", &images().join("driver_only"));
    assert_eq!(
        (ended.status, &*ended.stdout, &*ended.stderr),
        (
            1,
            "",
            "no picture: nothing answers at 0x40028000 (QEMU has no device there), or the job failed; the defmt log on UART1 says which\n"
        )
    );
    let [line] = &*ended.log else { panic!("{:?}", ended.log) };
    assert!(line.starts_with("error Device(Error { cause: WrongDevice { id: 0 }"), "{line}");
}

#[test]
fn a_damaged_job_ends_with_a_reason() {
    let elf = patched("damaged", "pree_f32", "lucerna_app::board::model::JOB", b"LCNK");
    let ended = run("damaged", &elf);
    assert_eq!((ended.status, &*ended.stdout), (1, ""));
    assert_eq!(ended.stderr, "not a Lucerna job: write one with `hostsim fixture`\n");
}

#[test]
fn a_hard_fault_ends_with_a_reason() {
    let undefined = 0xde00u16.to_le_bytes();
    let ended = run("fault", &patched("fault", "pree_f32", "main", &undefined));
    assert_eq!((ended.status, &*ended.stdout), (1, ""));
    assert!(ended.stderr.starts_with("hard fault at 0x"), "{}", ended.stderr);
    assert!(ended.log[0].starts_with("error hard fault at 0x"), "{:?}", ended.log);
}

#[test]
fn sizes_are_within_their_budgets() {
    images();
    let report = size::run(&options()).unwrap_or_else(|error| panic!("{error}"));
    println!("{report}");
    assert!(report.is_within_budgets(), "{report}");
    for image in &report.images {
        let flash: u64 = image.crates.values().map(|share| share.flash).sum();
        assert_eq!(flash, image.total.flash, "every byte of {} is somebody's", image.name);
    }
}

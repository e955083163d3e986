//! A board to run programs on: QEMU's.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use hostsim::size::attribute::demangle;
use hostsim::size::{self, build};
use object::{Object, ObjectSection, ObjectSymbol};

/// A run takes seconds; a program that hangs shall not hang the tests.
const PATIENCE: Duration = Duration::from_secs(90);

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

pub fn options() -> size::Options {
    let target_dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("images");
    size::Options { target_dir, ..size::Options::default() }
}

/// The folder of the programs, built by whoever asks first.
pub fn images() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let options = options();
        build::images(&options.root, &options.target_dir).unwrap_or_else(|error| panic!("{error}"))
    })
}

/// What a program did.
pub struct Ended {
    pub status: i32,
    pub stdout: String,
    pub stderr: String,
    pub log: Vec<String>,
}

/// Runs an image under QEMU; `name` is the test's.
#[track_caller]
pub fn run(name: &str, elf: &Path) -> Ended {
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
pub fn patched(name: &str, image: &str, symbol: &str, bytes: &[u8]) -> PathBuf {
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

/// Runs a program, which must print the report expected, line by line.
#[track_caller]
pub fn prints(image: &str, expected: &str) -> Ended {
    let ended = run(image, &images().join(image));
    assert_eq!((ended.status, &*ended.stderr), (0, ""), "{}", ended.stdout);
    for (line, (found, expected)) in ended.stdout.lines().zip(expected.lines()).enumerate() {
        assert_eq!(found, expected, "line {}", line + 1);
    }
    assert_eq!(ended.stdout, expected);
    ended
}

impl Ended {
    /// What the report says of `name`.
    #[track_caller]
    pub fn value(&self, name: &str) -> &str {
        let mut lines = self.stdout.lines();
        let found = lines.find_map(|line| line.strip_prefix(name)?.strip_prefix(' '));
        found.unwrap_or_else(|| panic!("no {name}"))
    }
}

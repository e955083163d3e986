//! Does the program do what its help says, and say in one paragraph what is wrong when something is?

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

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

/// The 20×15 render into `out`, with `more` options.
fn render(folder: &Path, more: &[&str]) -> Output {
    let arguments = [&["render", "--size", "20x15", "--photons", "1000", "--out", "out"], more].concat();
    hostsim(folder, &arguments)
}

/// It failed, and said why as to a human: one paragraph that names `what`.
#[track_caller]
fn refused(output: &Output, what: &str) {
    let (said, also) = (text(&output.stderr), text(&output.stdout));
    assert!(!output.status.success(), "it succeeded: {also}");
    assert!(output.status.code().is_some_and(|code| code == 1 || code == 2), "{:?}: {said}", output.status);
    for machine in ["panicked", "RUST_BACKTRACE", "thread '", "Error {", "unwrap"] {
        assert!(!said.contains(machine), "{machine}: {said}");
    }
    assert!(said.contains(what), "`{what}` is not in: {said}");
    assert!(said.trim_start().starts_with("error: "), "{said}");
    // The command line's own errors end with a usage in a paragraph of its own.
    let paragraphs =
        said.trim().split("\n\n").filter(|part| !part.contains("Usage:") && !part.contains("--help")).count();
    assert!(paragraphs <= 2 && said.len() < 1200, "{said}");
    assert!(also.is_empty(), "nothing goes to stdout: {also}");
}

#[test]
fn help_lists_every_command_and_option() {
    let folder = tempfile::tempdir().unwrap();
    let help = hostsim(folder.path(), &["--help"]);
    assert!(help.status.success());
    for command in ["render", "reproduce", "replay", "fixture"] {
        assert!(text(&help.stdout).contains(command), "{command}");
    }
    let help = hostsim(folder.path(), &["render", "--help"]);
    for option in [
        "[SCENE]",
        "--size",
        "--photons",
        "--units",
        "--format",
        "--arith",
        "--timing",
        "--hazards",
        "--normal-test",
        "--input-width",
        "--busy",
        "--bus-trace",
        "--out",
        "--mesh",
        "--scheduler",
        "--allocation",
        "relief-room",
        "kitchen",
    ] {
        assert!(text(&help.stdout).contains(option), "{option}");
    }
    assert!(text(&hostsim(folder.path(), &["--version"]).stdout).starts_with("hostsim "));
}

#[test]
fn a_render_writes_its_four_files() {
    let folder = tempfile::tempdir().unwrap();
    let output = render(folder.path(), &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let out = folder.path().join("out");
    for picture in ["picture.png", "reference.png", "difference.png"] {
        let picture = image::open(out.join(picture)).unwrap();
        assert_eq!((picture.width(), picture.height()), (20, 15));
    }
    let report: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(out.join("report.json")).unwrap()).unwrap();
    for (field, value) in
        [("hit_points", 606), ("operations", 123_682), ("surface_hits", 3_162), ("index_entries", 4_848)]
    {
        assert_eq!(report[field], value, "{field}");
    }
    assert_eq!(report["bits_equal_scalar"], true);
    for field in [
        "empty_cells",
        "updates",
        "utilisation",
        "utilisation_without_aftso",
        "partial_dispatches",
        "stall_cycles",
        "update_conflicts",
        "stale_updates",
        "pixel_conflicts",
        "mhpuo_per_s_at_125mhz",
        "ssim",
        "differing_samples",
        "image_fnv1a64",
        "host_operations_per_second",
    ] {
        assert!(!report[field].is_null(), "{field}");
    }
    assert!(
        report["psnr_db"].is_null() == (report["differing_samples"] == 0),
        "infinite for equal pictures, which JSON has not"
    );
    for (field, parts) in
        [("cycles", ["update", "evaluate", "total"]), ("host_seconds", ["trace", "device", "reference"])]
    {
        parts.iter().for_each(|part| assert!(report[field][part].is_number(), "{field}.{part}"));
    }
    let said = text(&output.stdout);
    for figure in ["123682", "606", "496.79", "report.json"] {
        assert!(said.contains(figure), "{figure} is not in: {said}");
    }
}

/// Every option is taken, and none of them but format, normal test and hazards changes the picture.
#[test]
fn options_reach_the_device() {
    let folder = tempfile::tempdir().unwrap();
    let report = |more: &[&str]| -> serde_json::Value {
        let output = render(folder.path(), more);
        assert!(output.status.success(), "{more:?}: {}", text(&output.stderr));
        serde_json::from_str(&fs::read_to_string(folder.path().join("out/report.json")).unwrap()).unwrap()
    };
    let plain = report(&[]);
    for same in [
        &["--arith", "soft"][..],
        &["--timing", "tick"],
        &["--hazards", "forward"],
        &["--input-width", "2"],
        &["--input-width", "4"],
        &["--busy", "combinational"],
        &["--scheduler", "one-photon"],
    ] {
        assert_eq!(report(same)["image_fnv1a64"], plain["image_fnv1a64"], "{same:?}");
    }
    for other in [&["--format", "f24"][..], &["--normal-test", "off"], &["--hazards", "published"]] {
        assert_ne!(report(other)["image_fnv1a64"], plain["image_fnv1a64"], "{other:?}");
    }
    assert_eq!(report(&["--units", "16"])["units"], 16);
    assert_eq!(report(&["--hazards", "published"])["normal_test"], false, "the paper has none");
    assert_eq!(report(&["--hazards", "published", "--normal-test", "on"])["normal_test"], true);
}

#[test]
fn a_trace_is_written_and_replayed() {
    let folder = tempfile::tempdir().unwrap();
    assert!(render(folder.path(), &["--bus-trace", "trace.txt"]).status.success());
    for timing in ["fast", "tick"] {
        let output = hostsim(folder.path(), &["replay", "trace.txt", "--timing", timing]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(text(&output.stdout).contains("all as in the trace"));
    }
    let path = folder.path().join("trace.txt");
    let whole = fs::read_to_string(&path).unwrap();

    // Cut, in the middle of a line or between two: what is left would agree, but it is not the whole.
    for cut in
        [whole.rfind("\nr ").unwrap() + 5, whole.find("\nW ").unwrap() + 1, whole.rfind("# end").unwrap()]
    {
        fs::write(&path, &whole[..cut]).unwrap();
        refused(&hostsim(folder.path(), &["replay", "trace.txt"]), "cut off");
    }

    fs::write(&path, &whole[whole.find('\n').unwrap() + 1..]).unwrap();
    refused(&hostsim(folder.path(), &["replay", "trace.txt"]), "trace.txt");
    fs::write(&path, "").unwrap();
    refused(&hostsim(folder.path(), &["replay", "trace.txt"]), "trace.txt");
    fs::write(&path, [0xff, 0xfe, 0x00]).unwrap();
    refused(&hostsim(folder.path(), &["replay", "trace.txt"]), "trace.txt");
    refused(&hostsim(folder.path(), &["replay", "nowhere.txt"]), "nowhere.txt");
    refused(&hostsim(folder.path(), &["replay", "."]), "cannot be read");
    // A header that asks for more than there is.
    fs::write(&path, whole.replacen("words ", "words 99999999", 1)).unwrap();
    refused(&hostsim(folder.path(), &["replay", "trace.txt"]), "trace.txt");
}

#[test]
fn words_that_mean_nothing_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, what) in [
        (&["render", "--size", "0x15"][..], "WIDTHxHEIGHT"),
        (&["render", "--size", "20"], "WIDTHxHEIGHT"),
        (&["render", "--size", "20x15x3"], "WIDTHxHEIGHT"),
        (&["render", "--size", "99999x99999"], "WIDTHxHEIGHT"),
        (&["render", "--photons", "0"], "--photons"),
        (&["render", "--photons", "-1"], "-1"),
        (&["render", "--photons", "many"], "--photons"),
        (&["render", "--photons", "99999999999"], "--photons"),
        (&["render", "--units", "5"], "--units"),
        (&["render", "--format", "f16"], "--format"),
        (&["render", "--hazards", "none"], "--hazards"),
        (&["render", "--input-width", "3"], "--input-width"),
        (&["render", "--arith", "exact"], "--arith"),
        (&["render", "--timing", "slow"], "--timing"),
        (&["render", "--busy", "idle"], "--busy"),
        (&["render", "--normal-test", "maybe"], "--normal-test"),
        (&["render", "--colour", "red"], "--colour"),
        (&["render", "one", "two"], "two"),
        (&["paint"], "paint"),
        (&["reproduce", "displace"], "displace"),
        (&["replay"], "<TRACE>"),
    ] {
        refused(&hostsim(folder.path(), arguments), what);
    }
    assert!(!folder.path().join("out").exists(), "nothing was begun");
}

#[test]
fn scenes_that_are_not_there_or_not_right_are_explained() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let scene = |name: &str, what: &str| {
        let arguments = ["render", name, "--size", "20x15", "--photons", "100", "--out", "out"];
        refused(&hostsim(folder.path(), &arguments), what);
    };
    scene("sponza", "sponza");
    scene("", "scene");
    scene("nowhere.toml", "nowhere.toml");
    scene("nowhere.obj", "nowhere.obj");
    scene(".", "scene");
    write("broken.toml", "[camera\nposition = 3");
    scene("broken.toml", "broken");
    write("empty.toml", "");
    scene("empty.toml", "empty");
    write("wrong.toml", "[camera]\norigin = \"here\"\n");
    scene("wrong.toml", "wrong");
    write("broken.obj", "v 0 0\nf 1 2 3\n");
    scene("broken.obj", "broken.obj");
    write("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n");
    scene("far.obj", "far.obj");
    write("words.obj", "v a b c\n");
    scene("words.obj", "words.obj");
    write("none.obj", "# nothing\n");
    scene("none.obj", "none");
    fs::write(folder.path().join("bytes.toml"), [0xff, 0xfe, 0x80]).unwrap();
    scene("bytes.toml", "bytes.toml");
    fs::write(folder.path().join("bytes.obj"), [0xff, 0xfe, 0x80, 0x0a]).unwrap();
    scene("bytes.obj", "bytes.obj");

    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/scenes/sibenik.toml");
    fs::copy(fixtures, folder.path().join("sibenik.toml")).unwrap();
    scene("sibenik.toml", "--mesh");
    let arguments =
        ["render", "sibenik.toml", "--mesh", "no.obj", "--size", "20x15", "--photons", "100", "--out", "out"];
    refused(&hostsim(folder.path(), &arguments), "no.obj");
}

#[test]
fn places_that_cannot_be_written_to_are_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let base = ["render", "--size", "20x15", "--photons", "100"];
    for (more, what) in [
        (&["--out", "file"][..], "file"),
        (&["--out", "file/below"], "file/below"),
        (&["--out", "out", "--bus-trace", "nowhere/trace.txt"], "trace"),
        (&["--out", "out", "--bus-trace", "."], "trace"),
    ] {
        refused(&hostsim(folder.path(), &[&base[..], more].concat()), what);
    }
    refused(&hostsim(folder.path(), &["fixture", "nowhere/job.lcn"]), "nowhere/job.lcn");
    refused(&hostsim(folder.path(), &["reproduce", "pree", "--out", "file"]), "file");
    // A result's own name taken by a folder.
    fs::create_dir_all(folder.path().join("out/picture.png")).unwrap();
    refused(&hostsim(folder.path(), &[&base[..], &["--out", "out"]].concat()), "picture.png");
}

/// `hostsim render | head`: a reader that has gone away is no error, a full disk behind a redirection is one.
#[test]
fn standard_output_may_be_closed_or_full() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_hostsim"));
    command
        .args(["render", "--size", "20x15", "--photons", "100", "--out", "out"])
        .current_dir(folder.path());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(!text(&output.stderr).contains("panicked"));
    if let Ok(full) = fs::OpenOptions::new().write(true).open("/dev/full") {
        refused(&command.stdout(full).output().unwrap(), "standard output");
    }
}

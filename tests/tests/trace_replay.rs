//! Does a bus trace, done again on a fresh device, read the same words; and is a changed word found where it is?

use std::path::{Path, PathBuf};

use hostsim::accelerate::{Setup, Units, run};
use hostsim::cli::ReplayArgs;
use hostsim::cli::choices::{ArithChoice, TimingChoice, UnitsChoice};
use hostsim::replay::{self, TraceError};
use lucerna_driver::{Hazard, NumberFormat, Policies};
use lucerna_tests::workload::SMALL;

/// Runs the small picture with its bus traced.
fn trace(folder: &Path, setup: Setup) -> PathBuf {
    let path = folder.join("trace.txt");
    let setup = Setup { bus_trace: Some(path.clone()), ring_entries: 128, ..setup };
    run(&setup, &SMALL.workload(), &mut SMALL.source()).expect("a job the device can do");
    path
}

fn args(trace: &Path, timing: TimingChoice, arith: ArithChoice) -> ReplayArgs {
    ReplayArgs { trace: trace.to_owned(), units: None, arith, timing }
}

#[test]
fn a_trace_is_the_same_under_every_timing_and_arithmetic() {
    let folder = tempfile::tempdir().unwrap();
    for (format, units, hazard) in [
        (NumberFormat::F32, Units::Four, Hazard::Interlock),
        (NumberFormat::F24, Units::Eight, Hazard::Published),
    ] {
        let policies = Policies { hazard, ..Policies::default() };
        let path = trace(folder.path(), Setup { format, units, policies, ..Setup::default() });
        let mut said = Vec::new();
        for timing in [TimingChoice::Tick, TimingChoice::Fast] {
            for arith in [ArithChoice::Soft, ArithChoice::Fast] {
                said.push(replay::run(&args(&path, timing, arith)).unwrap_or_else(|error| panic!("{error}")));
            }
        }
        assert!(said.iter().all(|text| *text == said[0]), "accesses and cycles: {said:?}");
    }
}

/// The result of a replay with one line changed.
fn changed(path: &Path, lines: &[String], number: usize, line: String) -> Result<String, TraceError> {
    let mut lines = lines.to_vec();
    lines[number] = line;
    std::fs::write(path, lines.join("\n")).unwrap();
    replay::run(&args(path, TimingChoice::Fast, ArithChoice::Fast))
}

fn flip(word: &str) -> String {
    format!("{:08x}", u32::from_str_radix(word, 16).unwrap() ^ 1 << 20)
}

#[test]
fn a_changed_word_is_found_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = trace(folder.path(), Setup::default());
    let text = std::fs::read_to_string(&path).unwrap();
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let numbered = |kind: &'static str| {
        lines.iter().enumerate().filter(move |(_, line)| line.starts_with(kind)).map(|(number, _)| number)
    };

    // What the device answered, changed in the trace: that very line, every kind of read.
    let register_reads: Vec<usize> = numbered("r ").collect();
    let block_reads: Vec<usize> = numbered("R ").collect();
    assert!(register_reads.len() > 60 && !block_reads.is_empty());
    let some = register_reads.iter().step_by(9).chain(block_reads.iter().step_by(7));
    for &number in some {
        let (rest, last) = lines[number].rsplit_once(' ').unwrap();
        let error =
            changed(&path, &lines, number, format!("{rest} {}", flip(last))).expect_err("a changed answer");
        assert!(error.to_string().contains(&format!("line {}:", number + 1)), "{error}");
    }

    // What the host wrote, changed: a photon's flux shows in some later read, not before.
    let write = numbered("W ").nth(numbered("W ").count() - 3).unwrap();
    let mut fields: Vec<String> = lines[write].split(' ').map(str::to_owned).collect();
    fields[2] = flip(&fields[2]);
    let error = changed(&path, &lines, write, fields.join(" ")).expect_err("another photon");
    let TraceError::Line { error, .. } = error else { panic!("{error}") };
    assert!(error.line > write, "line {} of {write}", error.line);

    // Lines that are none.
    for nonsense in ["x 0 0", "r", "r 0", "w 0", "r zz 0", "r 0 0 0", "d -1", "r 100000000 0"] {
        let error = changed(&path, &lines, 20, nonsense.to_owned()).expect_err("no line of a trace");
        assert!(error.to_string().contains("line 21:"), "{nonsense}: {error}");
    }
}

#[test]
fn another_device_reads_other_words() {
    let folder = tempfile::tempdir().unwrap();
    let path = trace(folder.path(), Setup::default());
    let mut args = args(&path, TimingChoice::Fast, ArithChoice::Fast);
    args.units = Some(UnitsChoice::Eight);
    let error = replay::run(&args).expect_err("eight PREUs are not four");
    assert!(error.to_string().contains("line "), "{error}");
}

#[test]
fn a_trace_says_first_what_device_it_is_of() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("trace.txt");
    for first in [
        "",
        "r 0 4c554352",
        "# lucerna bus trace: units 5 format f32 words 100",
        "# lucerna bus trace: units 4 format f16 words 9",
    ] {
        std::fs::write(&path, first).unwrap();
        let error = replay::run(&args(&path, TimingChoice::Fast, ArithChoice::Fast)).expect_err("no header");
        assert!(matches!(error, TraceError::Header(_)), "{error}");
    }
}

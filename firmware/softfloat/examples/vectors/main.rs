//! Runs test-vector files: `cargo run --release --example vectors -- FILE…` prints `FILE passed N failed M` for each and
//! exits non-zero if anything failed. In: text, or the same packed as `.xz`; out: counts; some 10 million lines a second.
//!
//! The operation is taken from the file's name up to its first dot: `f32_add`, `f24_mul_ftz`, `f32_to_f24`,
//! `i32_to_f24`, `f24_cmp` … (see [`task`]). A line holds hexadecimal fields: operands, result, flags (inexact 01,
//! underflow 02, overflow 04, divide by zero 08, invalid 10).
//!
//! Two conventions differ between sources of such files. They are read off the file as a whole, said on stderr, and can
//! be forced:
//! - `--exact`, `--not-exact`: whether conversions to integers raise inexact (TestFloat by default does not let them);
//! - `--signalling`, `--quiet`: whether any NaN operand of a `cmp` file raises invalid, or signalling ones only.

mod evaluate;
mod file;
mod task;

use std::process::ExitCode;

/// Failures shown a file.
const SHOWN: usize = 5;

/// What the command line forces.
#[derive(Clone, Copy, Default)]
struct Forced {
    raises_inexact: Option<bool>,
    quiet: Option<bool>,
}

fn main() -> ExitCode {
    let mut forced = Forced::default();
    let mut paths = Vec::new();
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--exact" => forced.raises_inexact = Some(true),
            "--not-exact" => forced.raises_inexact = Some(false),
            "--signalling" => forced.quiet = Some(false),
            "--quiet" => forced.quiet = Some(true),
            option if option.starts_with("--") => {
                eprintln!(
                    "unknown option {option}: only --exact, --not-exact, --signalling, --quiet and files"
                );
                return ExitCode::from(2);
            }
            _ => paths.push(argument),
        }
    }
    if paths.is_empty() {
        eprintln!("usage: vectors [--exact | --not-exact] [--signalling | --quiet] FILE…");
        return ExitCode::from(2);
    }
    let mut good = true;
    for path in &paths {
        match run(path, forced) {
            Ok(tally) => {
                println!("{path} passed {} failed {}", tally.passed, tally.failed);
                good &= tally.failed == 0;
            }
            Err(error) => {
                eprintln!("{path}: {error}");
                good = false;
            }
        }
    }
    if good { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

struct Tally {
    passed: usize,
    failed: usize,
}

fn run(path: &str, forced: Forced) -> Result<Tally, String> {
    let task = task::Task::of_path(path)?;
    let text = file::read(path)?;
    let lines = file::parse(&text, &task)?;
    let convention = evaluate::Convention::of_file(&task, &lines, forced);
    if let Some(said) = convention.describe(&task) {
        eprintln!("{path}: {said}");
    }
    let mut tally = Tally { passed: 0, failed: 0 };
    for line in &lines {
        let ours = evaluate::line(&task, convention, line);
        if ours == line.expected {
            tally.passed += 1;
            continue;
        }
        tally.failed += 1;
        if tally.failed <= SHOWN {
            let text = text.lines().nth(line.number - 1).unwrap_or_default();
            eprintln!("{path}:{}: {text} — ours: {}", line.number, evaluate::show(&ours));
        }
    }
    Ok(tally)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn data(name: &str) -> String {
        format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"))
    }

    /// Made with MPFR at 17 bits of precision, `subnormalize` and exact rationals.
    #[test]
    fn whole_files_pass() {
        for name in [
            "f24_sub.txt",
            "f24_mul_ftz.txt",
            "f24_div_ftz.txt",
            "f24_cmp.txt",
            "f24_cmp.quiet.txt.xz",
            "f24_to_i32.txt",
            "f32_to_f24.txt",
            "i32_to_f24.txt",
        ] {
            let tally = run(&data(name), Forced::default()).unwrap();
            assert_eq!((tally.passed, tally.failed), (64, 0), "{name}");
        }
    }

    #[test]
    fn the_wrong_convention_fails() {
        let quiet = Forced { quiet: Some(true), ..Forced::default() };
        assert!(run(&data("f24_cmp.txt"), quiet).unwrap().failed > 0);
        let not_exact = Forced { raises_inexact: Some(false), ..Forced::default() };
        assert!(run(&data("f24_to_i32.txt"), not_exact).unwrap().failed > 0);
    }

    #[test]
    fn a_missing_file_is_an_error() {
        assert!(run(&data("f24_add.txt"), Forced::default()).is_err());
        assert!(run(&data("f24_add.txt.xz"), Forced::default()).is_err());
    }
}

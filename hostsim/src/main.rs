//! The command line of the host simulator; in: words, out: pictures, tables, JSON, or one paragraph on what went wrong.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;
use hostsim::cli::{Cli, Command, Reproduce, progress};
use hostsim::{displace, fixture, render, replay, reproduce, size};

type AnyError = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    match run(Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(cli: Cli) -> Result<(), AnyError> {
    match cli.command {
        Command::Render(args) => {
            let options = args.options()?;
            let bar = progress(options.photons.into());
            let report = render::render(&options, &bar)?;
            bar.finish_and_clear();
            say(format_args!(
                "{report}\n\nwrote picture.png, reference.png, difference.png (times {}) and report.json to {}",
                render::AMPLIFICATION,
                std::path::absolute(&options.out)?.display()
            ))?;
            if let Some(trace) = &options.setup.bus_trace {
                say(format_args!(
                    "wrote the bus trace to {}; `hostsim replay` does it again",
                    trace.display()
                ))?;
            }
        }
        Command::Displace(args) => {
            let options = args.options()?;
            let bar = progress(0);
            let report = displace::displace(&options, &bar)?;
            bar.finish_and_clear();
            say(format_args!(
                "{report}\n\nwrote picture.png, steps.png (bright at {} steps), difference.png and report.json to {}",
                displace::picture::HOTTEST,
                std::path::absolute(&options.out)?.display()
            ))?;
        }
        Command::Reproduce(Reproduce::Pree { full, out }) => {
            let bar = progress(0);
            let figures = reproduce::pree::run(full, &out, &bar)?;
            bar.finish_and_clear();
            say(format_args!("{figures}\n\nwrote Fig. 4's pictures and pree.json to {}", out.display()))?;
        }
        Command::Reproduce(Reproduce::Displacement(args)) => {
            let bar = progress(0);
            let (size, setup) = ((args.size.width, args.size.height), args.device.setup()?);
            let tables = reproduce::displacement::run(&args.maps, size, &setup, &args.out, &bar)?;
            bar.finish_and_clear();
            let out = std::path::absolute(&args.out)?;
            say(format_args!("{tables}\n\nwrote displacement.json to {}", out.display()))?;
        }
        Command::Replay(args) => say(replay::run(&args)?)?,
        Command::Size => {
            let report = size::run(&size::Options::default())?;
            say(&report)?;
            if !report.is_within_budgets() {
                return Err("a budget is exceeded: see the lines above".into());
            }
        }
        Command::Fixture { path } => {
            fixture::write(&path)?;
            say(format_args!("wrote {}", path.display()))?;
        }
    }
    Ok(())
}

/// A line to standard output. A reader that has seen enough (`| head`) is no error.
fn say(text: impl Display) -> Result<(), AnyError> {
    match writeln!(io::stdout(), "{text}") {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(format!("standard output takes no more text: {error}").into()),
        Ok(()) => Ok(()),
    }
}

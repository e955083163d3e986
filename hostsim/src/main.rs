//! The command line of the host simulator; in: words, out: pictures, tables, JSON, or one paragraph on what went wrong.

use std::process::ExitCode;

use clap::Parser;
use hostsim::cli::{Cli, Command, Reproduce, progress};
use hostsim::{fixture, render, replay, reproduce, size};

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
            println!(
                "{report}\n\nwrote picture.png, reference.png, difference.png and report.json to {}",
                options.out.display()
            );
            if let Some(trace) = &options.setup.bus_trace {
                println!("wrote the bus trace to {}; `hostsim replay` does it again", trace.display());
            }
        }
        Command::Reproduce(Reproduce::Pree { full, out }) => {
            let bar = progress(0);
            let figures = reproduce::pree::run(full, &out, &bar)?;
            bar.finish_and_clear();
            println!("{figures}\n\nwrote Fig. 4's pictures and pree.json to {}", out.display());
        }
        Command::Replay(args) => println!("{}", replay::run(&args)?),
        Command::Size => {
            let report = size::run(&size::Options::default())?;
            println!("{report}");
            if !report.is_within_budgets() {
                return Err("a budget is exceeded: see the lines above".into());
            }
        }
        Command::Fixture { path } => {
            fixture::write(&path)?;
            println!("wrote {}", path.display());
        }
    }
    Ok(())
}

//! ns an operation, ours beside others', in one process: `cargo bench -p lucerna-softfloat --features berkeley`. Takes
//! some ten seconds; without the feature Berkeley SoftFloat (which needs a C compiler) is left out.
//!
//! Each cell is a dependent chain (every operation waits for the one before) and independent throughput. Operands are
//! random normal numbers of moderate size and both signs. The best of many short runs is printed, and the
//! implementations take turns, so that a busy machine disturbs the figures little.

mod candidates;
mod measure;

use candidates::{Candidate, Operation};
use measure::{Best, Operands};

const ROUNDS: usize = 60;

fn main() {
    let mut candidates = candidates::all();
    let operands: Vec<(Operation, Operands)> =
        Operation::ALL.iter().map(|&operation| (operation, Operands::new(operation))).collect();
    for _ in 0..ROUNDS {
        for candidate in &mut candidates {
            let (_, operands) =
                operands.iter().find(|(operation, _)| *operation == candidate.operation).unwrap();
            candidate.run(operands);
        }
    }
    print_table(&candidates);
    print_ratios(&candidates);
}

fn print_table(candidates: &[Candidate]) {
    println!("ns per operation, dependent chain / independent throughput");
    print!("{:44}", "");
    for operation in Operation::ALL {
        print!("{:>14}", operation.name());
    }
    println!();
    let mut names: Vec<&str> = Vec::new();
    for candidate in candidates {
        if !names.contains(&candidate.name) {
            names.push(candidate.name);
        }
    }
    for name in names {
        print!("{name:44}");
        for operation in Operation::ALL {
            match find(candidates, name, operation) {
                Some(best) => print!("{:>14}", format!("{:.2}/{:.2}", best.chain, best.throughput)),
                None => print!("{:>14}", "–"),
            }
        }
        println!();
    }
}

/// Berkeley's throughput over ours: what has to be 1.4 (level in sqrt) without flags, and level with them.
fn print_ratios(candidates: &[Candidate]) {
    let overhead = candidates::rounding_mode_ns();
    let Some(overhead) = overhead else {
        println!("(no Berkeley SoftFloat: build with --features berkeley)");
        return;
    };
    println!();
    println!(
        "Berkeley SoftFloat is C, gcc -O3, called through softfloat-wrapper, which sets the rounding mode by a call of its"
    );
    println!(
        "own before each operation: {overhead:.2} ns, taken off Berkeley's throughput in the ratios below."
    );
    for (ours, name) in [(candidates::OURS, "without flags"), (candidates::OURS_FLAGS, "with flags")] {
        print!("{:44}", format!("Berkeley's throughput time over ours, {name}"));
        for operation in Operation::ALL {
            let berkeley = find(candidates, candidates::BERKELEY, operation);
            match (berkeley, find(candidates, ours, operation)) {
                (Some(berkeley), Some(ours)) => {
                    print!("{:>14.2}", (berkeley.throughput - overhead) / ours.throughput);
                }
                _ => print!("{:>14}", "–"),
            }
        }
        println!();
    }
}

fn find(candidates: &[Candidate], name: &str, operation: Operation) -> Option<Best> {
    candidates.iter().find(|c| c.name == name && c.operation == operation).map(|c| c.best)
}

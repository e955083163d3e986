//! From registers to a job; in: bits, out: what the engine can do, or the fault; cost: decoding at start.

use lucerna_fabric::window::Windows;
use lucerna_pree::allocation::Allocation;
use lucerna_pree::hazard::Hazard;
use lucerna_pree::job::{Busy, EvaluateJob, Fault, FaultCode, InputWidth, Rules, UpdateJob};
use lucerna_pree::schedule::Scheduler;
use lucerna_regs::pree::{self as regs, Config, Mode};
use lucerna_regs::window;
use lucerna_softfloat::Format;

use super::registers::Registers;

/// A job of either mode.
#[derive(Clone, Copy, Debug)]
pub enum Job<F> {
    /// Hit-point updates.
    Update(UpdateJob<F>),
    /// Radiance evaluation.
    Evaluate(EvaluateJob<F>),
}

/// Decodes the registers as START finds them.
///
/// # Errors
/// A fault of the register's codes; nothing was touched.
pub fn decode<F: Format>(
    registers: &Registers,
    windows: &Windows<{ window::COUNT }>,
) -> Result<Job<F>, Fault> {
    let hazard = hazard(registers.config)?;
    let rules = rules(registers.config, hazard)?;
    Ok(match registers.config.mode() {
        Mode::Update => Job::Update(UpdateJob::new(
            windows,
            registers.hits,
            registers.index,
            registers.ring,
            F::from_bits(registers.alpha),
            rules,
        )?),
        Mode::Evaluate => Job::Evaluate(EvaluateJob::new(
            windows,
            registers.hits,
            registers.pixels,
            F::from_bits(registers.emitted),
            hazard,
            allocation(registers.config),
        )?),
    })
}

const BAD_CONFIG: Fault = Fault { code: FaultCode::BadConfig, address: 0 };

fn hazard(config: Config) -> Result<Hazard, Fault> {
    Ok(match config.hazard().map_err(|_| BAD_CONFIG)? {
        regs::Hazard::Interlock => Hazard::Interlock,
        regs::Hazard::Forward => Hazard::Forward,
        regs::Hazard::Published => Hazard::Published,
    })
}

fn rules(config: Config, hazard: Hazard) -> Result<Rules, Fault> {
    Ok(Rules {
        hazard,
        busy: match config.busy() {
            regs::Busy::Registered => Busy::Registered,
            regs::Busy::Combinational => Busy::Combinational,
        },
        input_width: match config.input_width().map_err(|_| BAD_CONFIG)? {
            regs::InputWidth::One => InputWidth::One,
            regs::InputWidth::Two => InputWidth::Two,
            regs::InputWidth::Four => InputWidth::Four,
        },
        scheduler: match config.scheduler() {
            regs::Scheduler::Aftso => Scheduler::Aftso,
            regs::Scheduler::OnePhoton => Scheduler::OnePhoton,
        },
        normal_test: config.normal_test(),
    })
}

fn allocation(config: Config) -> Allocation {
    match config.allocation() {
        regs::Allocation::Leaping => Allocation::Leaping,
        regs::Allocation::Sequential => Allocation::Sequential,
    }
}

//! What is done when an operation meets its own hit point (or pixel) in the pipeline (D7, D12); in: how many cycles ago that
//! one was issued, out: go or hold; cost: one compare a stage and PREU, and for [`Hazard::Forward`] a bypass multiplexer.

use crate::preu::components::{EVALUATE_STAGES, UPDATE_STAGES};

/// The policy (register `CONFIG.HAZARD`).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Hazard {
    /// Hold the operation until the one before has been written back.
    #[default]
    Interlock,
    /// Hold it only until the one before can hand its result to the stage that needs it.
    Forward,
    /// As the paper has it: no protection. Stale operands are used, reproduced to the bit, and counted.
    Published,
}

/// An update's result leaves stage 10; the first stage that needs it is 5 (τ, and through N the divider), so a successor issued
/// 6 cycles later can be served by a bypass: at the beginning of its stage 5 the result is just there.
pub const UPDATE_BYPASS: usize = UPDATE_STAGES - 4;

/// An evaluation's sum leaves stage 12 and is needed in stage 11: 2 cycles (the dotted feedback of Fig. 7).
pub const EVALUATE_BYPASS: usize = EVALUATE_STAGES - 10;

/// What the issue stage does with an operation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Verdict {
    /// Nothing of it is in flight.
    Clear,
    /// Hold it, and what is behind it, this cycle.
    Hold,
    /// Issue it; its operands come from the youngest result in flight, where there is one.
    Bypass,
    /// Issue it on what the memory holds, although something is in flight.
    Collide,
}

impl Hazard {
    /// `age`: how many cycles ago the same key was issued last, if it is in flight; `bypass`: from which age on a result in
    /// flight can be forwarded.
    #[inline]
    pub fn judge(self, age: Option<usize>, bypass: usize) -> Verdict {
        match (self, age) {
            (_, None) => Verdict::Clear,
            (Self::Published, Some(_)) => Verdict::Collide,
            (Self::Forward, Some(age)) if age >= bypass => Verdict::Bypass,
            (Self::Interlock | Self::Forward, Some(_)) => Verdict::Hold,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preu::components::{EVALUATE, Step, UPDATE};

    fn stage(steps: &[Step], name: &str, of: impl Fn(&Step) -> usize) -> usize {
        of(steps.iter().find(|step| step.name == name).expect("a named row"))
    }

    /// The bypass distances follow from the stage tables: a result at the end of stage `done`, of an operation issued `d` cycles
    /// before, is at hand at the beginning of stage `done - d + 1` of its successor.
    #[test]
    fn bypass_distances_follow_from_the_stages() {
        let done = stage(UPDATE, "flux", Step::finish);
        assert_eq!(UPDATE_BYPASS, done + 1 - stage(UPDATE, "flux + arriving", |s| s.start));
        // N is selected by the comparator at the end of stage 8 and first needed in stage 3: as far apart.
        let selected = stage(UPDATE, "inside", |s| s.start) - 1;
        assert_eq!(UPDATE_BYPASS, selected + 1 - stage(UPDATE, "N + alpha", |s| s.start));
        // R² leaves stage 10 and is compared in stage 8: nearer, so it does not decide.
        assert!(stage(UPDATE, "radius", Step::finish) + 1 - selected < UPDATE_BYPASS);
        let done = stage(EVALUATE, "pixel", Step::finish);
        assert_eq!(EVALUATE_BYPASS, done + 1 - stage(EVALUATE, "pixel", |s| s.start));
    }

    #[test]
    fn judged_at_the_edge() {
        assert_eq!(Hazard::Forward.judge(Some(UPDATE_BYPASS - 1), UPDATE_BYPASS), Verdict::Hold);
        assert_eq!(Hazard::Forward.judge(Some(UPDATE_BYPASS), UPDATE_BYPASS), Verdict::Bypass);
        assert_eq!(Hazard::Interlock.judge(Some(9), UPDATE_BYPASS), Verdict::Hold);
        assert_eq!(Hazard::Published.judge(Some(0), UPDATE_BYPASS), Verdict::Collide);
        for hazard in [Hazard::Interlock, Hazard::Forward, Hazard::Published] {
            assert_eq!(hazard.judge(None, UPDATE_BYPASS), Verdict::Clear);
        }
    }
}

//! Which Table I component works in which stage; in: nothing, out: two tables whose depths are 10 and 12; cost: none at run time.
//!
//! Each row is one component of a datapath: its kind, how many work side by side, the stage it starts in, and the rows whose
//! results it needs. The tests hold them against the paper: depth, dependencies, and what sharing saves (§IV.A.2).

/// The arithmetic components of Table I.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Component {
    /// DW_fp_div.
    Divider,
    /// DW_fp_mult.
    Multiplier,
    /// DW_fp_square.
    Squarer,
    /// DW_fp_add.
    Adder,
    /// DW_fp_sub.
    Subtractor,
    /// DW_fp_cmp: combinational, in the last stage of what it compares.
    Comparator,
}

impl Component {
    /// Pipeline stages (Table I).
    pub const fn latency(self) -> usize {
        match self {
            Self::Divider => 4,
            Self::Multiplier | Self::Squarer | Self::Adder | Self::Subtractor => 2,
            Self::Comparator => 0,
        }
    }
}

/// One row of a datapath.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// What it computes, as in Figs. 6 and 7.
    pub name: &'static str,
    /// With which component.
    pub component: Component,
    /// How many of them, side by side.
    pub width: usize,
    /// The first stage it occupies, from 1.
    pub start: usize,
    /// The rows it waits for.
    pub needs: &'static [&'static str],
    /// Whether the evaluation reuses the same component (§IV.A.2); always true in [`EVALUATE`] where it is.
    pub shared: bool,
}

impl Step {
    /// The last stage it occupies; a comparator works within the stage before `start`.
    pub const fn finish(&self) -> usize {
        self.start + self.component.latency() - 1
    }
}

const fn step(
    name: &'static str,
    component: Component,
    width: usize,
    start: usize,
    needs: &'static [&'static str],
    shared: bool,
) -> Step {
    Step { name, component, width, start, needs, shared }
}

use Component::{Adder, Comparator, Divider, Multiplier, Squarer, Subtractor};

/// Fig. 6: the hit-point update operation.
pub const UPDATE: &[Step] = &[
    // Block 1, eq. (6).
    step("difference", Subtractor, 3, 1, &[], false),
    step("squares", Squarer, 3, 3, &["difference"], false),
    step("x + y", Adder, 1, 5, &["squares"], false),
    step("distance", Adder, 1, 7, &["x + y"], false),
    step("inside", Comparator, 1, 9, &["distance"], false),
    // Block 2, eq. (7): the divider in stages 5 to 8 (D13).
    step("N + alpha", Adder, 1, 3, &[], false),
    step("N + 1", Adder, 1, 3, &[], false),
    step("correction", Divider, 1, 5, &["N + alpha", "N + 1"], true),
    step("radius", Multiplier, 1, 9, &["correction"], true),
    // Block 3, eq. (8).
    step("colour * flux", Multiplier, 3, 1, &[], false),
    step("* 1/pi", Multiplier, 3, 3, &["colour * flux"], true),
    step("flux + arriving", Adder, 3, 5, &["* 1/pi"], true),
    step("flux", Multiplier, 3, 9, &["flux + arriving", "correction"], true),
];

/// The optional normal test (D8), beside block 1: not in the paper, so on components of its own.
pub const NORMAL_TEST: &[Step] = &[
    step("products", Multiplier, 3, 1, &[], false),
    step("x + y", Adder, 1, 3, &["products"], false),
    step("cosine", Adder, 1, 5, &["x + y"], false),
    step("facing", Comparator, 1, 7, &["cosine"], false),
];

/// Fig. 7: the radiance evaluation, on the shared components; the sum is fed back to the adders of block 3.
pub const EVALUATE: &[Step] = &[
    step("radius * emitted", Multiplier, 1, 1, &[], true),
    step("* 1/pi", Multiplier, 3, 3, &[], true),
    step("area", Divider, 1, 5, &["radius * emitted"], true),
    step("radiance", Multiplier, 3, 9, &["* 1/pi", "area"], true),
    step("pixel", Adder, 3, 11, &["radiance"], true),
];

/// How many stages a datapath has.
pub const fn depth(steps: &[Step]) -> usize {
    let (mut depth, mut row) = (0, 0);
    while row < steps.len() {
        if steps[row].finish() > depth {
            depth = steps[row].finish();
        }
        row += 1;
    }
    depth
}

/// Stages of an update, from the table: 10.
pub const UPDATE_STAGES: usize = depth(UPDATE);
/// Stages of an evaluation, from the table: 12.
pub const EVALUATE_STAGES: usize = depth(EVALUATE);

#[cfg(test)]
mod tests {
    use super::*;

    fn total(steps: &[Step], component: Component) -> usize {
        steps.iter().filter(|step| step.component == component).map(|step| step.width).sum()
    }

    #[test]
    fn depths_are_the_papers() {
        assert_eq!((UPDATE_STAGES, EVALUATE_STAGES), (10, 12));
    }

    #[test]
    fn nothing_starts_before_what_it_needs_is_done() {
        for steps in [UPDATE, NORMAL_TEST, EVALUATE] {
            for step in steps {
                for need in step.needs {
                    let source = steps.iter().find(|other| other.name == *need).expect("a named row");
                    assert!(source.finish() < step.start, "{} starts before {need} is done", step.name);
                }
            }
        }
    }

    /// The normal test is decided before the distance is, so it adds no stage.
    #[test]
    fn the_normal_test_is_not_the_longest_path() {
        let inside = UPDATE.iter().find(|step| step.name == "inside").expect("a named row");
        assert!(depth(NORMAL_TEST) < inside.start);
    }

    /// "the shared data path of a PREU saves seven multipliers, three adders and one divider" (§IV.A.2).
    #[test]
    fn sharing_saves_what_the_paper_says() {
        let saved = |component| total(EVALUATE, component);
        assert_eq!((saved(Multiplier), saved(Adder), saved(Divider)), (7, 3, 1));
        let reusable = |component| {
            UPDATE.iter().filter(|s| s.shared && s.component == component).map(|s| s.width).sum::<usize>()
        };
        for component in [Multiplier, Adder, Divider] {
            assert!(reusable(component) >= saved(component), "{component:?}");
        }
    }
}

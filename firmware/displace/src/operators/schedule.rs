//! A schedule and its rules; in: operations with their cycles, out: interval and latency, or no compilation; cost: none at run
//! time.

use lucerna_fabric::semi::Pace;

use super::{Operator, Unit};

/// Operations of one kind that start in the same cycle.
#[derive(Clone, Copy, Debug)]
pub struct Operation {
    /// What they compute.
    pub name: &'static str,
    /// With what.
    pub operator: Operator,
    /// How many side by side.
    pub width: u32,
    /// In which cycle of the ray they start, from 0.
    pub start: u32,
    /// The operations whose results they need.
    pub needs: &'static [&'static str],
}

impl Operation {
    /// The first cycle in which the result can be used.
    pub const fn finish(&self) -> u32 {
        self.start + self.operator.latency()
    }
}

/// What a unit does with a ray, cycle by cycle.
#[derive(Clone, Copy, Debug)]
pub struct Schedule {
    /// Whose operators it uses.
    pub unit: Unit,
    /// In any order.
    pub operations: &'static [Operation],
}

impl Schedule {
    /// Cycles from a ray to its result.
    pub const fn latency(&self) -> u32 {
        let (mut latency, mut row) = (0, 0);
        while row < self.operations.len() {
            let finish = self.operations[row].finish();
            if finish > latency {
                latency = finish;
            }
            row += 1;
        }
        latency
    }

    /// The least number of cycles from a ray to the next such that no two operations ever want the same operator.
    pub const fn interval(&self) -> u32 {
        let mut interval = 1;
        while interval < self.latency() && !self.fits(interval) {
            interval += 1;
        }
        interval
    }

    /// What no schedule of these operations can do better: the uses of the busiest operator over how many of it there are.
    pub const fn bound(&self) -> u32 {
        let (mut bound, mut column) = (1, 0);
        while column < Operator::ALL.len() {
            let operator = Operator::ALL[column];
            let uses = self.uses(operator);
            if uses > 0 {
                let cycles = uses.div_ceil(self.unit.count(operator));
                if cycles > bound {
                    bound = cycles;
                }
            }
            column += 1;
        }
        bound
    }

    /// Interval and latency.
    pub const fn pace(&self) -> Pace {
        Pace { interval: self.interval(), latency: self.latency() }
    }

    /// How often a ray uses an operator.
    pub const fn uses(&self, operator: Operator) -> u32 {
        let (mut uses, mut row) = (0, 0);
        while row < self.operations.len() {
            if self.operations[row].operator as usize == operator as usize {
                uses += self.operations[row].width;
            }
            row += 1;
        }
        uses
    }

    /// Whether, with a ray every `interval` cycles, no cycle needs more operators than the unit has.
    pub const fn fits(&self, interval: u32) -> bool {
        let mut row = 0;
        while row < self.operations.len() {
            let Operation { operator, start, .. } = self.operations[row];
            let (mut busy, mut other) = (0, 0);
            while other < self.operations.len() {
                let beside = self.operations[other];
                if beside.operator as usize == operator as usize
                    && beside.start % interval == start % interval
                {
                    busy += beside.width;
                }
                other += 1;
            }
            if busy > self.unit.count(operator) {
                return false;
            }
            row += 1;
        }
        true
    }

    /// Whether every operation starts when all it needs is done; an unknown name is never done.
    pub const fn is_causal(&self) -> bool {
        let mut row = 0;
        while row < self.operations.len() {
            let operation = self.operations[row];
            let mut need = 0;
            while need < operation.needs.len() {
                match self.find(operation.needs[need]) {
                    Some(source) if self.operations[source].finish() <= operation.start => {}
                    _ => return false,
                }
                need += 1;
            }
            row += 1;
        }
        true
    }

    pub(super) const fn find(&self, name: &str) -> Option<usize> {
        let mut row = 0;
        while row < self.operations.len() {
            if same(self.operations[row].name, name) {
                return Some(row);
            }
            row += 1;
        }
        None
    }

    /// Holds for every schedule here, or they do not compile.
    pub(super) const fn checked(self) -> Self {
        assert!(self.is_causal(), "an operation starts before what it needs is done");
        assert!(self.fits(self.interval()), "more operators are wanted than the unit has");
        assert!(self.interval() == self.bound(), "the busiest operator has idle cycles");
        self
    }
}

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut at = 0;
    while at < a.len() && at < b.len() && a[at] == b[at] {
        at += 1;
    }
    at == a.len() && at == b.len()
}

pub(super) const fn operation(
    name: &'static str,
    operator: Operator,
    width: u32,
    start: u32,
    needs: &'static [&'static str],
) -> Operation {
    Operation { name, operator, width, start, needs }
}

#[cfg(test)]
mod tests {
    use super::super::Operator::{Adder, Multiplier, SquareRoot};
    use super::{Operation, Schedule, Unit, operation};

    #[test]
    fn a_schedule_that_breaks_a_rule_is_seen() {
        const EARLY: &[Operation] =
            &[operation("a", Multiplier, 1, 0, &[]), operation("b", Adder, 1, 0, &["a"])];
        assert!(!Schedule { unit: Unit::Address, operations: EARLY }.is_causal());
        const UNKNOWN: &[Operation] = &[operation("a", Multiplier, 1, 0, &["b"])];
        assert!(!Schedule { unit: Unit::Address, operations: UNKNOWN }.is_causal());
        const CROWDED: &[Operation] = &[operation("a", Multiplier, 2, 0, &[])];
        assert!(!Schedule { unit: Unit::Address, operations: CROWDED }.fits(8));
        const ABSENT: &[Operation] = &[operation("a", SquareRoot, 1, 0, &[])];
        assert!(!Schedule { unit: Unit::Address, operations: ABSENT }.fits(8));
    }
}

//! What each semi-pipelined unit does in which cycle of a ray; in: nothing, out: their schedules; cost: none at run time.

use super::Operator::{Adder, Adder3, Divider, Multiplier, SquareRoot};
use super::Unit;
use super::schedule::{Schedule, operation};

/// View calculation of a ray record: `V' = TBN · V`, `D = V'xy / -V'z`. z first: both quotients wait for it.
pub const VIEW_LIST: Schedule = Schedule {
    unit: Unit::View,
    operations: &[
        operation("z products", Multiplier, 3, 0, &[]),
        operation("x products", Multiplier, 3, 1, &[]),
        operation("y products", Multiplier, 3, 2, &[]),
        operation("z", Adder3, 1, 1, &["z products"]),
        operation("x", Adder3, 1, 2, &["x products"]),
        operation("y", Adder3, 1, 3, &["y products"]),
        operation("D u", Divider, 1, 6, &["x", "z"]),
        operation("D v", Divider, 1, 7, &["y", "z"]),
    ],
}
.checked();

/// View calculation of a pixel: also the entry point `P = EYE + D · EYE_HEIGHT`, for which the unit has no operators of its own;
/// the sums are done by the 3-input adder, with −0 as its third input, which changes no sum.
pub const VIEW_RASTER: Schedule = Schedule {
    unit: Unit::View,
    operations: &[
        operation("z products", Multiplier, 3, 0, &[]),
        operation("x products", Multiplier, 3, 1, &[]),
        operation("y products", Multiplier, 3, 2, &[]),
        operation("z", Adder3, 1, 1, &["z products"]),
        operation("x", Adder3, 1, 2, &["x products"]),
        operation("y", Adder3, 1, 3, &["y products"]),
        operation("D u", Divider, 1, 6, &["x", "z"]),
        operation("D v", Divider, 1, 7, &["y", "z"]),
        operation("D u height", Multiplier, 1, 8, &["D u"]),
        operation("D v height", Multiplier, 1, 9, &["D v"]),
        operation("P u", Adder3, 1, 9, &["D u height"]),
        operation("P v", Adder3, 1, 10, &["D v height"]),
    ],
}
.checked();

/// Address calculation: the hit coordinate `P + D · t` (P15); clamp, wrap and Morton order are integer work.
pub const ADDRESS: Schedule = Schedule {
    unit: Unit::Address,
    operations: &[
        operation("D u t", Multiplier, 1, 0, &[]),
        operation("D v t", Multiplier, 1, 1, &[]),
        operation("hit u", Adder, 1, 1, &["D u t"]),
        operation("hit v", Adder, 1, 2, &["D v t"]),
    ],
}
.checked();

/// Colour calculation. `n · l` does not start at once, because its products would meet those of another ray's channels.
pub const COLOUR: Schedule = Schedule {
    unit: Unit::Colour,
    operations: &[
        operation("n n products", Multiplier, 3, 0, &[]),
        operation("n n", Adder3, 1, 1, &["n n products"]),
        operation("|n|", SquareRoot, 1, 5, &["n n"]),
        operation("n l products", Multiplier, 3, 3, &[]),
        operation("n l", Adder3, 1, 4, &["n l products"]),
        operation("cosine", Divider, 1, 8, &["n l", "|n|"]),
        operation("diffuse light", Multiplier, 1, 10, &["cosine"]),
        operation("shade", Adder, 1, 11, &["diffuse light"]),
        operation("channels", Multiplier, 3, 13, &["shade"]),
    ],
}
.checked();

/// Most rays in the view calculation at once, whatever the source.
pub const VIEW_DEPTH: usize = {
    let (list, raster) = (VIEW_LIST.pace().depth(), VIEW_RASTER.pace().depth());
    if list > raster { list } else { raster }
};
/// Most rays in the address calculation at once.
pub const ADDRESS_DEPTH: usize = ADDRESS.pace().depth();
/// Most rays in the colour calculation at once.
pub const COLOUR_DEPTH: usize = COLOUR.pace().depth();

#[cfg(test)]
mod tests {
    use super::super::Operator;
    use super::*;

    const ALL: [Schedule; 4] = [VIEW_LIST, VIEW_RASTER, ADDRESS, COLOUR];

    #[test]
    fn paces() {
        let paces = ALL.map(|schedule| (schedule.interval(), schedule.latency()));
        assert_eq!(paces, [(3, 9), (5, 14), (2, 4), (4, 14)]);
    }

    /// Table 1 holds no operator that the unit does not need, and every need is met.
    #[test]
    fn each_operator_of_a_unit_is_used() {
        for schedule in ALL {
            for operator in Operator::ALL {
                let (has, uses) = (schedule.unit.count(operator), schedule.uses(operator));
                assert_eq!(has > 0, uses > 0, "{:?}: {operator:?}", schedule.unit);
            }
        }
    }

    /// Rays at the interval: no cycle wants more operators than there are. One cycle less: some cycle does.
    #[test]
    fn the_interval_is_the_least() {
        for schedule in ALL {
            let busiest = |interval: u32| {
                let mut most = 0.0f64;
                for operator in Operator::ALL {
                    let mut cycles = [0u32; 400];
                    for ray in 0..20 {
                        for row in schedule.operations.iter().filter(|row| row.operator == operator) {
                            cycles[(ray * interval + row.start) as usize] += row.width;
                        }
                    }
                    let peak = *cycles.iter().max().expect("cycles");
                    if peak > 0 {
                        most = most.max(f64::from(peak) / f64::from(schedule.unit.count(operator)));
                    }
                }
                most
            };
            assert_eq!(schedule.interval(), schedule.bound());
            assert_eq!(busiest(schedule.interval()), 1.0, "{:?}", schedule.unit);
            for less in 1..schedule.interval() {
                assert!(busiest(less) > 1.0, "{:?} every {less}", schedule.unit);
            }
        }
    }

    /// All schedules that start each operation up to some cycles late: none has the same interval and is done earlier.
    #[test]
    fn the_latency_is_the_least_at_that_interval() {
        fn search(schedule: &Schedule, row: usize, starts: &mut Vec<u32>, limit: u32) -> bool {
            let Some(next) = schedule.operations.get(row) else { return true };
            let interval = schedule.interval();
            let ready = next.needs.iter().map(|name| {
                let source = schedule.find(name).expect("a named row");
                assert!(source < row, "rows of a schedule are in the order of their needs");
                starts[source] + schedule.operations[source].operator.latency()
            });
            let earliest = ready.max().unwrap_or(0);
            for start in earliest..=limit.saturating_sub(next.operator.latency()) {
                let beside = schedule.operations[..row].iter().zip(starts.iter()).filter(|(other, at)| {
                    other.operator == next.operator && *at % interval == start % interval
                });
                let busy: u32 = beside.map(|(other, _)| other.width).sum();
                if busy + next.width <= schedule.unit.count(next.operator) {
                    starts.push(start);
                    if search(schedule, row + 1, starts, limit) {
                        return true;
                    }
                    starts.pop();
                }
            }
            false
        }
        for schedule in ALL {
            assert!(search(&schedule, 0, &mut Vec::new(), schedule.latency()), "{:?}", schedule.unit);
            assert!(!search(&schedule, 0, &mut Vec::new(), schedule.latency() - 1), "{:?}", schedule.unit);
        }
    }
}

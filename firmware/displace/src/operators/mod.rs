//! Which operator of Table 1 does what in which cycle; in: nothing, out: how often each semi-pipelined unit takes a ray and how
//! long it works on it; cost: none at run time.
//!
//! "The other units are designed as semi-pipelined structures to share the hardware resources efficiently" (§4.1) is all the
//! paper says of their timing. Table 1 says what they share, so their pace follows: a [`Schedule`] gives each operation a cycle,
//! and its interval and latency are computed from that. The compiler refuses a schedule in which an operation starts before
//! what it needs is done, or whose interval is more than its busiest operator makes necessary.
//!
//! Operators are pipelined: each takes operands every cycle. Sign flips, conversions between integers and numbers, comparing
//! numbers as integers, tables and the Morton order are integer work, done in cycles of the operations beside them (§4.2: "integer
//! arithmetic and cache access are performed during empty sections in the pipeline stages"). Registers between the operators
//! are not counted, and the paper does not either.
//!
//! The raster source is a ray source in the place of the paper's ray tracer. What makes a pixel's view vector has operators of
//! its own, which Table 1 does not count; the entry point under it is computed by the view calculation.

mod schedule;
mod units;

pub use schedule::{Operation, Schedule};
pub use units::{ADDRESS, ADDRESS_DEPTH, COLOUR, COLOUR_DEPTH, VIEW_DEPTH, VIEW_LIST, VIEW_RASTER};

/// The arithmetic elements of Table 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Operator {
    /// `a + b` or `a − b`.
    Adder,
    /// `(a + b) + c`.
    Adder3,
    /// `a < b`.
    Comparator,
    /// `a · b`.
    Multiplier,
    /// `a / b`.
    Divider,
    /// `√a`.
    SquareRoot,
}

impl Operator {
    /// All of them, as the columns of Table 1.
    pub const ALL: [Self; 6] =
        [Self::Adder, Self::Adder3, Self::Comparator, Self::Multiplier, Self::Divider, Self::SquareRoot];

    /// Cycles from operands to result.
    ///
    /// Adder, divider, multiplier and comparator are the paper's (§4.2). It has no 3-input adder or square root in the pipeline
    /// it shows; ours (P21): the sum of three is rounded twice, so it takes as long as two additions in a row, and a square root
    /// is found digit by digit like a quotient of as many digits, so it takes as long as a division. Neither changes an interval.
    pub const fn latency(self) -> u32 {
        match self {
            Self::Adder => 2,
            Self::Adder3 => 2 * Self::Adder.latency(),
            Self::Comparator => 1,
            Self::Multiplier => 1,
            Self::Divider => 2,
            Self::SquareRoot => Self::Divider.latency(),
        }
    }
}

/// The rows of Table 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unit {
    /// View vector to tangent space.
    View,
    /// The traversal loop.
    Traverse,
    /// Hit coordinate, texture and normal address.
    Address,
    /// Shading.
    Colour,
}

impl Unit {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::View, Self::Traverse, Self::Address, Self::Colour];

    /// How many of an operator it has (Table 1).
    pub const fn count(self, operator: Operator) -> u32 {
        let row: [u32; 6] = match self {
            Self::View => [0, 1, 0, 3, 1, 0],
            Self::Traverse => [6, 0, 7, 5, 2, 0],
            Self::Address => [1, 0, 0, 1, 0, 0],
            Self::Colour => [1, 1, 0, 3, 1, 1],
        };
        row[operator as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::{Operator, Unit};

    #[test]
    fn totals_are_those_of_table_1() {
        let total = |operator| Unit::ALL.iter().map(|unit| unit.count(operator)).sum::<u32>();
        assert_eq!(Operator::ALL.map(total), [8, 2, 7, 12, 4, 1]);
    }
}

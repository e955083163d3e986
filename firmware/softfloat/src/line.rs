//! What a datapath asks of a straight line in a plane; in: a point and a direction, out: cells of a grid, and where the line meets
//! edges of it; cost: a multiplication and an addition a cell, a subtraction and a division an edge.

use crate::Format;

/// A line `point + direction · t` on a grid of `1 << log2` cells a unit, as far as a format can follow it: every operation is
/// rounded. What a line is asked for many times an implementation may work out once.
pub trait Line<F>: Copy + core::fmt::Debug + PartialEq {
    /// A line that begins at 0 and goes nowhere.
    const NOWHERE: Self;

    /// The line; `log2` of either axis is at most 31.
    fn new(point: [F; 2], direction: [F; 2], log2: [u32; 2]) -> Self;

    /// The line as seen from an edge of the point's cell on each axis, the one nearer to 0, and the indices of both edges. There
    /// is none if the point is no number, or 2^24 cells or more from the origin.
    #[inline]
    #[must_use]
    fn from_edge(point: [F; 2], direction: [F; 2], log2: [u32; 2]) -> Option<([i32; 2], Self)>
    where
        F: Format,
    {
        // An edge that is not the point's own has the point's sign and no more digits, so the difference is exact.
        let edge = [0, 1].map(|axis| {
            let (at, below) = (point[axis], point[axis].floor_scaled(log2[axis]));
            below + i32::from(at.lt(F::ZERO) && F::from_scaled(below, log2[axis]).lt(at))
        });
        let offset = [0, 1].map(|axis| point[axis].sub(F::from_scaled(edge[axis], log2[axis])));
        let is_near = |axis: usize| edge[axis].abs() < 1 << 24 && Format::eq(offset[axis], offset[axis]);
        (is_near(0) && is_near(1)).then(|| (edge, Self::new(offset, direction, log2)))
    }

    /// The cell at `t`, which is from 0 to 1, of a grid that is `1 << finer` times finer:
    /// `⌊(point + direction · t) · 2^(log2 + finer)⌋`, product and sum each rounded to the format, clipped as
    /// [`floor_scaled`](Format::floor_scaled).
    fn cell(&self, t: F, finer: u32) -> [i32; 2];

    /// The cell of the grid itself at `t = 0`.
    fn first(&self) -> [i32; 2];

    /// Its index on one axis, 0 or 1, of the grid itself.
    fn index(&self, axis: usize, t: F) -> i32;

    /// Which of two edges, one across each axis, it meets first, and at which `t`: the axis, x when it meets both at once, and
    /// `(edge · 2^-log2 − point) / direction`, all three rounded. It never meets an edge across an axis on which its direction is 0.
    fn exit(&self, edge: [i32; 2]) -> Option<(usize, F)>;
}

/// A line that does each operation when it is asked: what any other implementation has to agree with, to the bit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlainLine<F> {
    point: [F; 2],
    direction: [F; 2],
    log2: [u8; 2],
}

impl<F: Format> PlainLine<F> {
    #[inline]
    fn at(&self, axis: usize, t: F) -> F {
        self.point[axis].add(self.direction[axis].mul(t))
    }
}

impl<F: Format> Line<F> for PlainLine<F> {
    const NOWHERE: Self = Self { point: [F::ZERO; 2], direction: [F::ZERO; 2], log2: [0; 2] };

    #[inline]
    fn new(point: [F; 2], direction: [F; 2], log2: [u32; 2]) -> Self {
        Self { point, direction, log2: log2.map(|log2| log2 as u8) }
    }
    #[inline]
    fn cell(&self, t: F, finer: u32) -> [i32; 2] {
        [0, 1].map(|axis| self.at(axis, t).floor_scaled(u32::from(self.log2[axis]) + finer))
    }
    #[inline]
    fn first(&self) -> [i32; 2] {
        self.cell(F::ZERO, 0)
    }
    #[inline]
    fn index(&self, axis: usize, t: F) -> i32 {
        self.at(axis, t).floor_scaled(self.log2[axis].into())
    }
    #[inline]
    fn exit(&self, edge: [i32; 2]) -> Option<(usize, F)> {
        let Self { point, direction, log2 } = self;
        let meets =
            |axis: usize| F::from_scaled(edge[axis], log2[axis].into()).sub(point[axis]).div(direction[axis]);
        match direction.map(|direction| !direction.eq(F::ZERO)) {
            [true, true] => {
                let [x, y] = [meets(0), meets(1)];
                Some(if y.lt(x) { (1, y) } else { (0, x) })
            }
            [true, false] => Some((0, meets(0))),
            [false, true] => Some((1, meets(1))),
            [false, false] => None,
        }
    }
}

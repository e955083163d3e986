//! Lines of [`HostF24`]; in: a point and a direction, out: what the plain operations find, to the bit; cost: the host's operations
//! without most of the roundings.
//!
//! Point and direction are kept in cells of the grid, which changes their exponents only. A cell is the floor of a sum that
//! is not rounded to F24, unless this is so near an edge that rounding could have taken it across. And quotients are products with
//! a reciprocal: the quotient of two 17-bit numbers is never nearer than 2^-35 of itself to the middle between two 17-bit
//! numbers, and the product is off by 2^-52 at most, so both are rounded to the same number.

use lucerna_softfloat::{Line, PlainLine};

use super::f24::{HostF24, split};
use super::{FLOOR_LIMIT, floor, power_of_two};

/// Fraction bits of a sum as an integer, in which the distance to the next cell is judged.
const FRACTION: u32 = 19;
/// Added to a sum, it leaves no other fraction bits, and the sum as an integer in the low bits.
const ANCHOR: f64 = 1.5 * (1u64 << (52 - FRACTION)) as f64;
/// Added to a number below it, it leaves the nearest integer in the low bits.
const WHOLE: f64 = (1u64 << 52) as f64;
/// A [`Line24::doubt`] that leaves no sum certain.
const ALL: u32 = 1 << FRACTION;
/// Cells within which a line is followed this way; its edges are within twice that, and so each is an F24 number.
const REACH: u32 = 1 << 16;
/// Added to a number within reach, it leaves whole multiples of 2^-35.
const COARSE: f64 = 1.5 * (1u64 << (52 - 35)) as f64;
/// 2^120, by which whatever F24 number is out of reach.
const FAR: f64 = f64::from_bits((1023 + 120) << 52);

/// A line whose reciprocals and error bounds are known.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Line24 {
    /// The point, in cells.
    start: [f64; 2],
    /// The direction, in cells.
    way: [f64; 2],
    /// Its reciprocal.
    pace: [f64; 2],
    /// So many units of the last [`FRACTION`] bit the roundings can add up to.
    doubt: [u32; 2],
    /// How far away edges may be.
    reach: u32,
    log2: [u8; 2],
}

/// In cells.
#[inline(always)]
fn scaled(numbers: [HostF24; 2], log2: [u32; 2]) -> [f64; 2] {
    [0, 1].map(|axis| numbers[axis].0 * power_of_two(log2[axis] as i32))
}

impl Line24 {
    /// The line from `start` to `start + way`, in cells.
    #[inline(always)]
    fn of(start: [f64; 2], way: [f64; 2], log2: [u32; 2]) -> Self {
        // Multiples of 2^-35 within reach, and a way across both axes: then no sum of an edge and the point has more than 53 bits,
        // and no difference or quotient is a subnormal F24 number or overflows.
        let off_grid = |x: f64| (x + COARSE - COARSE - x).abs();
        let span = [0, 1].map(|axis| {
            (off_grid(start[axis]) + off_grid(way[axis])) * FAR + (start[axis].abs() + way[axis].abs())
        });
        let reach = f64::from(REACH);
        let tame = (span[0] < reach)
            & (span[1] < reach)
            & (way[0] * way[1] != 0.0)
            & (log2[0] <= 16)
            & (log2[1] <= 16);
        // The product is rounded by up to 2^-17 of it, the sum by as much of it; and some for the bits that are dropped here.
        let doubt = [0, 1].map(|axis| {
            let units = (start[axis].abs() + 2.001 * way[axis].abs()) * power_of_two(FRACTION as i32 - 17);
            (units + (3.0 + WHOLE)).to_bits() as u32
        });
        Self {
            start,
            way,
            pace: way.map(f64::recip),
            doubt: if tame { doubt } else { [ALL; 2] },
            reach: if tame { 2 * REACH } else { 0 },
            log2: log2.map(|log2| log2 as u8),
        }
    }

    /// The line that does every rounding.
    fn plain(&self) -> PlainLine<HostF24> {
        let log2 = self.log2.map(u32::from);
        let unscaled =
            |cells: [f64; 2]| [0, 1].map(|axis| HostF24(cells[axis] * power_of_two(-(log2[axis] as i32))));
        PlainLine::new(unscaled(self.start), unscaled(self.way), log2)
    }

    #[cold]
    #[inline(never)]
    fn plain_cell(&self, t: HostF24, finer: u32) -> [i32; 2] {
        self.plain().cell(t, finer)
    }

    #[cold]
    #[inline(never)]
    fn plain_index(&self, axis: usize, t: HostF24) -> i32 {
        self.plain().index(axis, t)
    }

    #[cold]
    #[inline(never)]
    fn plain_exit(&self, edge: [i32; 2]) -> Option<(usize, HostF24)> {
        self.plain().exit(edge)
    }

    /// An index, and whether it is certain.
    #[inline(always)]
    fn unrounded(&self, axis: usize, t: HostF24) -> (i32, bool) {
        let sum = (self.start[axis] + self.way[axis] * t.0 + ANCHOR).to_bits();
        let doubt = self.doubt[axis];
        let margin = (sum as u32).wrapping_add(doubt) & ((1 << FRACTION) - 1);
        ((sum >> FRACTION) as i32, margin > 2 * doubt)
    }
}

impl Line<HostF24> for Line24 {
    const NOWHERE: Self =
        Self { start: [0.0; 2], way: [0.0; 2], pace: [0.0; 2], doubt: [ALL; 2], reach: 0, log2: [0; 2] };

    #[inline]
    fn new(point: [HostF24; 2], direction: [HostF24; 2], log2: [u32; 2]) -> Self {
        Self::of(scaled(point, log2), scaled(direction, log2), log2)
    }

    #[inline(always)]
    fn from_edge(point: [HostF24; 2], direction: [HostF24; 2], log2: [u32; 2]) -> Option<([i32; 2], Self)> {
        let cells = scaled(point, log2);
        if !(cells[0].abs() < FLOOR_LIMIT && cells[1].abs() < FLOOR_LIMIT) {
            return None;
        }
        // Toward zero.
        let edge = cells.map(|x| x as i32);
        let start = [0, 1].map(|axis| cells[axis] - f64::from(edge[axis]));
        Some((edge, Self::of(start, scaled(direction, log2), log2)))
    }

    #[inline(always)]
    fn cell(&self, t: HostF24, finer: u32) -> [i32; 2] {
        let [(x, x_certain), (y, y_certain)] = [self.unrounded(0, t), self.unrounded(1, t)];
        if x_certain & y_certain & (finer == 0) { [x, y] } else { self.plain_cell(t, finer) }
    }

    #[inline(always)]
    fn first(&self) -> [i32; 2] {
        // Nothing is added to the point, if it is within reach.
        if self.reach == 0 { self.plain_cell(HostF24(0.0), 0) } else { self.start.map(floor) }
    }

    #[inline(always)]
    fn index(&self, axis: usize, t: HostF24) -> i32 {
        let (index, certain) = self.unrounded(axis & 1, t);
        if certain { index } else { self.plain_index(axis & 1, t) }
    }

    #[inline(always)]
    fn exit(&self, edge: [i32; 2]) -> Option<(usize, HostF24)> {
        let near = edge.map(|edge| edge.wrapping_add(self.reach as i32) as u32);
        if (near[0] < 2 * self.reach) & (near[1] < 2 * self.reach) {
            let [x, y] =
                [0, 1].map(|axis| split(split(f64::from(edge[axis]) - self.start[axis]) * self.pace[axis]));
            // The lesser of two numbers, and not a branch: which one it is cannot be predicted.
            return Some((usize::from(y < x), HostF24(if y < x { y } else { x })));
        }
        self.plain_exit(edge)
    }
}

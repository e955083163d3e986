//! In: a ray and heights. Out: the column it hits, by looking at every column on its way. Cost: about 5 ns a column.
//!
//! A texel is a column with a flat top and vertical walls (P15). The hit is the first column whose depth is at most the
//! ray's depth where the ray leaves it: the top was reached inside, or a wall was entered below the top.

/// Columns of heights.
#[derive(Clone, Debug)]
pub struct Columns<'a> {
    log2: [u32; 2],
    heights: &'a [u8],
    depths: [f64; 256],
    repeat: bool,
}

/// Where a ray ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Column {
    /// Which, counted on beyond the map's edges.
    pub texel: [i64; 2],
    /// The ray's depth there.
    pub t: f64,
    /// It hit a wall, not a top.
    pub wall: bool,
    /// On its way, or at the hit, it went through a corner, so that it is rounding that says which column comes next; or it
    /// met a top just where it leaves the column.
    pub corner: bool,
    /// It hit nothing but the bottom beyond the map.
    pub missed: bool,
}

/// How far two numbers may be apart, relative to the larger, to be one: a few times the rounding of the operations that made
/// them.
const TOGETHER: f64 = 8.0 * f64::EPSILON;

impl<'a> Columns<'a> {
    /// A map of `1 << log2` texels, row by row; beyond its edges the map again (`repeat`) or heights of 0.
    ///
    /// # Panics
    /// When the heights are fewer than the texels.
    pub fn new(log2: [u32; 2], heights: &'a [u8], repeat: bool) -> Self {
        assert!(heights.len() >= 1 << (log2[0] + log2[1]), "a height a texel");
        Self { log2, heights, depths: std::array::from_fn(|h| (255 - h) as f64 / 255.0), repeat }
    }

    fn beyond(&self, texel: [i64; 2]) -> bool {
        !self.repeat && (0..2).any(|axis| !(0..1 << self.log2[axis]).contains(&texel[axis]))
    }

    fn depth(&self, texel: [i64; 2]) -> f64 {
        if self.beyond(texel) {
            return self.depths[0];
        }
        let [x, y] = [0, 1].map(|axis| texel[axis] as usize & ((1 << self.log2[axis]) - 1));
        self.depths[usize::from(self.heights[y << self.log2[0] | x])]
    }

    /// Marches from texture coordinate `entry` at depth 0 to `entry + direction` at depth 1.
    pub fn march(&self, entry: [f64; 2], direction: [f64; 2]) -> Column {
        let sides = self.log2.map(|log2| (1u64 << log2) as f64);
        let mut texel = [0, 1].map(|axis| (entry[axis] * sides[axis]).floor() as i64);
        // The depth at which an axis' next boundary is met: from the boundary itself, so that errors do not add up.
        let leaves = |axis: usize, texel: i64| {
            let d = direction[axis];
            if d == 0.0 {
                return f64::INFINITY;
            }
            let boundary = (texel + i64::from(d > 0.0)) as f64 / sides[axis];
            (boundary - entry[axis]) / d
        };
        let mut leave = [leaves(0, texel[0]), leaves(1, texel[1])];
        let (mut entered, mut corner) = (0.0f64, false);
        loop {
            let [x, y] = leave;
            let first = usize::from(y < x);
            // A start on a boundary, looking back, leaves at once; never earlier.
            let out = leave[first].max(entered);
            let depth = self.depth(texel);
            corner |= near(depth, out);
            if depth <= out || out >= 1.0 {
                let wall = depth < entered;
                return Column {
                    texel,
                    t: depth.max(entered),
                    wall,
                    corner,
                    missed: self.beyond(texel) && !wall,
                };
            }
            corner |= near(x, y);
            texel[first] += if direction[first] > 0.0 { 1 } else { -1 };
            leave[first] = leaves(first, texel[first]);
            entered = out;
        }
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= TOGETHER * a.abs().max(b.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Depths by column along x of a 4×1 map.
    fn along(heights: [u8; 4], entry: f64, direction: f64) -> Column {
        Columns::new([2, 0], &heights, true).march([entry, 0.5], [direction, 0.0])
    }

    #[test]
    fn tops_and_walls() {
        // Straight down.
        let hit = along([0, 255, 51, 0], 0.6, 0.0);
        assert_eq!((hit.texel, hit.t, hit.wall), ([2, 0], 0.8, false));
        // The entry column is full.
        assert_eq!(along([0, 255, 0, 0], 0.3, 5.0).t, 0.0);
        // From column 0 at u = 0.125 to column 1's wall at t = 0.25.
        let hit = along([0, 255, 0, 0], 0.125, 0.5);
        assert_eq!((hit.texel, hit.t, hit.wall), ([1, 0], 0.25, true));
        // The other way round, into the tile before.
        let hit = along([0, 0, 0, 255], 0.125, -0.5);
        assert_eq!((hit.texel, hit.t, hit.wall), ([-1, 0], 0.25, true));
    }

    #[test]
    fn far_over_flat_ground() {
        let heights = [0; 4];
        let hit = along(heights, 0.1, 7.25);
        assert_eq!((hit.texel, hit.t, hit.missed), ([29, 0], 1.0, false));
        let hit = Columns::new([2, 0], &heights, false).march([0.1, 0.5], [7.25, 0.0]);
        assert!(hit.missed, "beyond the border there is only the bottom");
    }

    #[test]
    fn corners_are_told() {
        let heights = [0, 0, 0, 255];
        let columns = Columns::new([1, 1], &heights, true);
        assert!(columns.march([0.25, 0.25], [0.5, 0.5]).corner);
        let beside = columns.march([0.25, 0.25 + 1e-9], [0.5, 0.5]);
        assert!(!beside.corner && beside.wall);
        assert_eq!(beside.texel, [1, 1]);
        // Looking back from a boundary.
        assert_eq!(columns.march([0.5, 0.25], [-0.25, 0.1]).texel, [0, 0]);
    }
}

//! A ray in texture space (P12, P24); in: entry and direction, out: the texel at a depth, the parameter of an edge; cost: Table 1's
//! multipliers, adders and dividers of the traverse unit.

use lucerna_softfloat::Format;

/// A ray in texture space: at `entry + direction · t` it is `t` deep.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray<F> {
    /// Texture coordinate at the top plane.
    pub entry: [F; 2],
    /// How far it goes from there to the bottom.
    pub direction: [F; 2],
}

impl<F: Format> Ray<F> {
    /// The ray as seen from an edge of its entry texel (P24), on a grid of `1 << log2` texels a tile.
    #[inline]
    pub fn track(&self, log2: [u32; 2]) -> Track<F> {
        // The edge nearer to 0, if it is not on one: that has the entry's sign and no more digits, so the difference is exact.
        let origin = core::array::from_fn(|axis| {
            let entry = self.entry[axis];
            let below = entry.floor_scaled(log2[axis]);
            below + i32::from(entry.lt(F::ZERO) && F::from_scaled(below, log2[axis]).lt(entry))
        });
        let offset =
            core::array::from_fn(|axis| self.entry[axis].sub(F::from_scaled(origin[axis], log2[axis])));
        Track { origin, offset, direction: self.direction }
    }
}

/// Entries this many texels from the origin or further cannot be told apart, so no ray begins there.
pub const REACH: i32 = 1 << 24;

/// A ray in coordinates that begin at its entry texel, so that what is rounded is the way from the entry and not the place on
/// the map (P24).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Track<F> {
    /// The texel edge from which all is counted; not wrapped.
    pub origin: [i32; 2],
    /// Where it enters, from there.
    pub offset: [F; 2],
    /// How far it goes from there to the bottom.
    pub direction: [F; 2],
}

impl<F: Format> Track<F> {
    /// Whether its entry is a number, and within [`REACH`].
    #[inline]
    pub fn is_in_reach(&self) -> bool {
        let is_number = |x: &F| Format::eq(*x, *x);
        self.origin.iter().all(|index| index.abs() < REACH) && self.offset.iter().all(is_number)
    }

    /// The leaf texel at `t`.
    #[inline(always)]
    pub(super) fn texel_at(&self, log2: [u32; 2], t: F) -> [i32; 2] {
        let [x, y] = F::add_product_floors(self.offset, self.direction, t, log2);
        [self.origin[0] + x, self.origin[1] + y]
    }

    /// Its index on one axis.
    #[inline(always)]
    pub(super) fn index(&self, axis: usize, t: F, log2: [u32; 2]) -> i32 {
        self.origin[axis] + self.offset[axis].add_product_floor(self.direction[axis], t, log2[axis])
    }

    /// The texels in which it begins and ends, on a grid that is `1 << finer` times finer.
    pub(super) fn ends(&self, log2: [u32; 2], finer: u32) -> [[i32; 2]; 2] {
        let grid = log2.map(|log2| log2 + finer);
        let first = self.origin.map(|index| index << finer);
        [F::ZERO, F::ONE].map(|t| {
            core::array::from_fn(|axis| {
                first[axis] + self.offset[axis].add_product_floor(self.direction[axis], t, grid[axis])
            })
        })
    }

    /// The axis on which it leaves a node whose edges ahead are at leaf indices `edge`, and the parameter at which it does
    /// (P12); x goes first (P13). There is none when it goes straight down.
    #[inline(always)]
    pub(super) fn exit(&self, edge: [i32; 2], log2: [u32; 2]) -> Option<(usize, F)> {
        let from_texel = [edge[0] - self.origin[0], edge[1] - self.origin[1]];
        let [x, y] = F::edge_distances(from_texel, log2, self.offset, self.direction);
        let [across_x, across_y] = self.direction.map(|direction| !direction.eq(F::ZERO));
        if !(across_x | across_y) {
            return None;
        }
        let second = !across_x | across_y & y.lt(x);
        Some((usize::from(second), if second { y } else { x }))
    }
}

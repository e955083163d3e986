//! One step (§2, P8–P15); in: where the ray is and the depth of its node's top, out: where it goes on; cost: the operators of
//! Fig. 7, once.
//!
//! A position is a leaf texel, as two integers, and the ray parameter `t`. It is never found from `t` alone: a crossing moves
//! the integer itself, so that no rounding can bring the ray back into the node it left (P11). And numbers only say how far the
//! ray is from the texel in which it entered, since what is between two texels is an integer as well (P24).

use lucerna_softfloat::Format;

use super::ascend::Crossing;
use super::{Coherent, Policies, Wrap, descend, start};
use crate::pyramid::{MAX_LOG2, Order, Shape};

/// A ray in texture space: at `entry + direction · t` it is `t` deep.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray<F> {
    /// Texture coordinate at the top plane.
    pub entry: [F; 2],
    /// How far it goes from there to the bottom.
    pub direction: [F; 2],
}

impl<F: Format> Ray<F> {
    /// The ray as seen from its entry texel (P24), on a grid of `1 << log2` texels a tile.
    #[inline]
    pub fn track(&self, log2: [u32; 2]) -> Track<F> {
        let texel: [i32; 2] = core::array::from_fn(|axis| self.entry[axis].floor_scaled(log2[axis]));
        // Exact: the texel's edge has no more digits than the entry, and what is left has fewer.
        let offset =
            core::array::from_fn(|axis| self.entry[axis].sub(F::from_scaled(texel[axis], log2[axis])));
        Track { texel, offset, direction: self.direction }
    }
}

/// A ray in coordinates that begin at its entry texel, so that what is rounded is the way from the entry and not the place on
/// the map (P24).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Track<F> {
    /// The leaf texel it enters; not wrapped.
    pub texel: [i32; 2],
    /// Where it enters, from the lower corner of that texel.
    pub offset: [F; 2],
    /// How far it goes from there to the bottom.
    pub direction: [F; 2],
}

impl<F: Format> Track<F> {
    /// The leaf texel at `t`.
    #[inline(always)]
    fn texel_at(&self, log2: [u32; 2], t: F) -> [i32; 2] {
        let [x, y] = F::add_product_floors(self.offset, self.direction, t, log2);
        [self.texel[0] + x, self.texel[1] + y]
    }

    /// Its index on one axis.
    #[inline(always)]
    fn index(&self, axis: usize, t: F, log2: [u32; 2]) -> i32 {
        self.texel[axis] + self.offset[axis].add_product_floor(self.direction[axis], t, log2[axis])
    }

    /// The texels in which it begins and ends, on a grid that is `1 << finer` times finer.
    fn ends(&self, log2: [u32; 2], finer: u32) -> [[i32; 2]; 2] {
        let grid = log2.map(|log2| log2 + finer);
        let first = self.texel.map(|index| index << finer);
        [F::ZERO, F::ONE].map(|t| {
            core::array::from_fn(|axis| {
                first[axis] + self.offset[axis].add_product_floor(self.direction[axis], t, grid[axis])
            })
        })
    }

    /// The axis on which it leaves a node whose edges ahead are at leaf indices `edge`, and the parameter at which it does
    /// (P12); x goes first (P13). There is none when it goes straight down.
    #[inline(always)]
    fn exit(&self, edge: [i32; 2], log2: [u32; 2]) -> Option<(usize, F)> {
        let from_texel = [edge[0] - self.texel[0], edge[1] - self.texel[1]];
        let [x, y] = F::edge_distances(from_texel, log2, self.offset, self.direction);
        let [across_x, across_y] = self.direction.map(|direction| !direction.eq(F::ZERO));
        if !(across_x | across_y) {
            return None;
        }
        let second = !across_x | across_y & y.lt(x);
        Some((usize::from(second), if second { y } else { x }))
    }
}

/// A height field as traversal sees it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Field {
    shape: Shape,
    /// Where each level begins, and the order of its texels.
    levels: [(u32, Order); MAX_LOG2 as usize + 1],
    wrap: Wrap,
}

impl Field {
    /// A pyramid of this shape.
    pub fn new(shape: Shape, wrap: Wrap) -> Self {
        let mut levels = [(0, Order::of(shape)); MAX_LOG2 as usize + 1];
        for (level, place) in (0..).zip(&mut levels) {
            *place = (shape.level_offset(level), Order::of(shape.level(level)));
        }
        Self { shape, levels, wrap }
    }

    /// Its extent.
    #[inline]
    pub const fn shape(&self) -> Shape {
        self.shape
    }

    /// The byte of the pyramid with the height of the node in which `leaf` lies; `None` beyond the border.
    #[inline]
    pub fn place(&self, leaf: [i32; 2], level: u32) -> Option<u32> {
        let (offset, order) = self.levels.get(level as usize)?;
        let [x, y] = leaf.map(|index| (index >> level) as u32);
        if self.wrap == Wrap::Border && !order.holds(x, y) {
            return None;
        }
        Some(offset + order.place(x, y))
    }

    /// Whether there is a surface at a leaf texel: everywhere with wrap, else on the map only.
    #[inline]
    pub fn lets_hit(&self, leaf: [i32; 2]) -> bool {
        self.wrap == Wrap::Repeat || Order::of(self.shape).holds(leaf[0] as u32, leaf[1] as u32)
    }
}

/// Where a ray is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Walk<F> {
    /// Ray parameter, which is also its depth.
    pub t: F,
    /// The leaf texel it is in; not wrapped.
    pub leaf: [i32; 2],
    /// The level of its node.
    pub level: u32,
    /// It has crossed a node (P6).
    pub crossed: bool,
    /// The flag of (c2), P5.
    pub stayed: bool,
    /// Steps taken.
    pub steps: u32,
}

/// What a step came to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Step {
    /// The ray was below the node's top, or came down on it: it goes down.
    Down,
    /// It crossed into the neighbour, and went up a level or not.
    Cross {
        /// Up.
        up: bool,
    },
    /// It crossed into a sibling whose top it was below, and goes down there (P22).
    CrossDown,
    /// It crossed into a sibling leaf and hit its side (P22).
    CrossHit,
    /// It hit its leaf texel.
    Hit,
}

/// Heights that the cache delivered: the word with that of the ray's node, which holds its siblings' too.
#[derive(Clone, Copy, Debug)]
pub struct Fetched<'a, F> {
    /// The byte of the pyramid with the node's height.
    pub place: u32,
    /// Four bytes of the pyramid.
    pub word: u32,
    /// The depth of each height (P14).
    pub depths: &'a Depths<F>,
}

impl<F: Format> Fetched<'_, F> {
    #[inline(always)]
    fn depth(&self) -> F {
        self.depths.of((self.word >> (8 * (self.place % 4))) as u8)
    }

    /// The depth of another node, if its height is in the same word.
    #[inline(always)]
    fn depth_at(&self, place: u32) -> Option<F> {
        (place / 4 == self.place / 4).then(|| Fetched { place, ..*self }.depth())
    }
}

/// The depth of each height: `(255 - h) / 255`, rounded to the format (P14).
#[derive(Clone, Debug)]
pub struct Depths<F>([F; 256]);

impl<F: Format> Default for Depths<F> {
    fn default() -> Self {
        Self::new()
    }
}

impl<F: Format> Depths<F> {
    /// The table.
    pub fn new() -> Self {
        let whole = F::from_scaled(255, 0);
        Self(core::array::from_fn(|height| F::from_scaled(255 - height as i32, 0).div(whole)))
    }

    /// The depth of a height.
    #[inline(always)]
    pub fn of(&self, height: u8) -> F {
        self.0[usize::from(height)]
    }
}

/// What all rays of a job have in common.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Terrain {
    /// The map.
    pub field: Field,
    /// How to go through it.
    pub policies: Policies,
}

impl<F: Format> Walk<F> {
    /// A ray at the top plane, at the root or at its start level. The second mode of Fig. 7 begins here; the first, which
    /// finds the start level, is this call.
    #[inline]
    pub fn new(track: &Track<F>, terrain: &Terrain) -> Self {
        let Terrain { field, policies } = terrain;
        let root = field.shape.root();
        let level = if policies.start_level {
            let [first, last] = track.ends(field.shape.log2(), policies.start_grid);
            start::level(first, last, root)
        } else {
            root
        };
        Self { t: F::ZERO, leaf: track.texel, level, crossed: false, stayed: false, steps: 0 }
    }

    /// One step. Without heights the node is beyond the border, where nothing is higher than the bottom.
    #[inline(always)]
    pub fn step(&mut self, track: &Track<F>, terrain: &Terrain, heights: Option<&Fetched<'_, F>>) -> Step {
        self.steps += 1;
        let depth = heights.map_or(F::ONE, Fetched::depth);
        if !self.t.lt(depth) {
            // P9: nothing to test.
            return if self.down(&terrain.policies) { Step::Down } else { Step::Hit };
        }
        let log2 = terrain.field.shape.log2();
        let level = self.level;
        let landing = track.texel_at(log2, depth);
        let node = self.leaf.map(|index| index >> level);
        let target = landing.map(|index| index >> level);
        if node != target
            && let Some(up) = self.cross(track, terrain, depth, node, target)
        {
            return self.look_around(terrain, heights, up);
        }
        self.t = depth;
        for axis in 0..2 {
            self.leaf[axis] = within(landing[axis], node[axis], level);
        }
        if self.down(&terrain.policies) { Step::Down } else { Step::Hit }
    }

    /// Goes down, if this is not a leaf.
    #[inline(always)]
    fn down(&mut self, policies: &Policies) -> bool {
        if self.level == 0 {
            return false;
        }
        self.level = descend::level(self.level, policies.levels_down, self.crossed);
        if policies.coherent == Coherent::Consecutive {
            self.stayed = false;
        }
        true
    }

    /// What comes of a crossing: the end of the step, unless the entered node's height is at hand and the ray below it (P22).
    #[inline(always)]
    fn look_around(&mut self, terrain: &Terrain, heights: Option<&Fetched<'_, F>>, up: bool) -> Step {
        if terrain.policies.siblings
            && !up
            && let Some(heights) = heights
            && let Some(place) = terrain.field.place(self.leaf, self.level)
            && let Some(depth) = heights.depth_at(place)
            && !self.t.lt(depth)
        {
            return if self.down(&terrain.policies) { Step::CrossDown } else { Step::CrossHit };
        }
        Step::Cross { up }
    }

    /// Crosses into the neighbour, if the ray leaves the node above `depth` (P10); says whether it went up.
    #[inline(always)]
    fn cross(
        &mut self,
        track: &Track<F>,
        terrain: &Terrain,
        depth: F,
        node: [i32; 2],
        target: [i32; 2],
    ) -> Option<bool> {
        let Terrain { field, policies } = terrain;
        let log2 = field.shape.log2();
        let level = self.level;
        let ahead = track.direction.map(|direction| F::ZERO.lt(direction));
        let boundary = [node[0] + i32::from(ahead[0]), node[1] + i32::from(ahead[1])];
        let (axis, exit) = track.exit(boundary.map(|index| index << level), log2)?;
        if !exit.lt(depth) {
            return None;
        }
        if self.t.lt(exit) {
            self.t = exit;
        }
        let other = 1 - axis;
        let edge = boundary[axis] << level;
        self.leaf[axis] = if ahead[axis] { edge } else { edge - 1 };
        self.leaf[other] = within(track.index(other, self.t, log2), node[other], level);
        self.crossed = true;
        let crossing = Crossing { node, target, boundary: boundary[axis], stayed: self.stayed };
        let up = policies.ascend.goes_up(policies.coherent, policies.reach, &crossing)
            && level < field.shape.root();
        self.stayed = !up;
        self.level += u32::from(up);
        Some(up)
    }
}

/// `leaf`, moved into the span of the node on its axis.
#[inline(always)]
fn within(leaf: i32, node: i32, level: u32) -> i32 {
    let first = node << level;
    leaf.clamp(first, first + (1 << level) - 1)
}

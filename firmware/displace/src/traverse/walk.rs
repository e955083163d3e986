//! One step (§2, P8–P15); in: where the ray is and the depth of its node's top, out: where it goes on; cost: the operators of
//! Fig. 7, once.
//!
//! A position is a leaf texel, as two integers, and the ray parameter `t`. It is never found from `t` alone: a crossing moves
//! the integer itself, so that no rounding can bring the ray back into the node it left (P11). And numbers only say how far the
//! ray is from the texel in which it entered, since what is between two texels is an integer as well (P24).

use core::hint::select_unpredictable;

use lucerna_softfloat::Format;

use super::ascend::Crossing;
use super::heights::{Fetched, Field};
use super::ray::Track;
use super::{Coherent, Policies, descend, start};

/// Where a ray is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Walk<F> {
    /// Ray parameter, which is also its depth.
    pub t: F,
    /// The leaf texel it is in; not wrapped.
    pub leaf: [i32; 2],
    /// The place of that texel in the map.
    place: u32,
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

/// What all rays of a job have in common.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Terrain {
    /// The map.
    pub field: Field,
    /// How to go through it.
    pub policies: Policies,
}

impl<F: Format> Walk<F> {
    /// That of a ray which is not traversed.
    pub const NOWHERE: Self =
        Self { t: F::ZERO, leaf: [0; 2], place: 0, level: 0, crossed: false, stayed: false, steps: 0 };

    /// A ray at the top plane, at the root or at its start level. The second mode of Fig. 7 begins here; the first, which
    /// finds the start level, is this call.
    #[inline]
    pub fn new(track: &Track<F>, terrain: &Terrain) -> Self {
        let Terrain { field, policies } = terrain;
        let root = field.shape().root();
        let leaf = track.first_texel();
        let level = if policies.start_level {
            let [first, last] = match policies.start_grid {
                0 => [leaf, track.texel_at(F::ONE)],
                finer => track.ends(finer),
            };
            start::level(first, last, root)
        } else {
            root
        };
        Self { t: F::ZERO, leaf, place: field.leaf(leaf), level, crossed: false, stayed: false, steps: 0 }
    }

    /// The byte of the pyramid that the next step needs; `None` beyond the border.
    #[inline(always)]
    pub fn node(&self, field: &Field) -> Option<u32> {
        field.node(self.leaf, self.place, self.level)
    }

    /// One step.
    #[inline(always)]
    pub fn step(&mut self, track: &Track<F>, terrain: &Terrain, fetched: &Fetched<'_, F>) -> Step {
        self.steps += 1;
        let depth = fetched.depth;
        if !self.t.lt(depth) {
            // P9: nothing to test.
            return if self.down(&terrain.policies) { Step::Down } else { Step::Hit };
        }
        let level = self.level;
        let landing = track.texel_at(depth);
        let node = self.leaf.map(|index| index >> level);
        let target = landing.map(|index| index >> level);
        if node != target
            && let Some(up) = self.cross(track, terrain, depth, node, target)
        {
            return self.look_around(terrain, fetched, up);
        }
        self.t = depth;
        self.leaf = if node == target {
            landing
        } else {
            [0, 1].map(|axis| within(landing[axis], node[axis], level))
        };
        self.place = terrain.field.leaf(self.leaf);
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
    fn look_around(&mut self, terrain: &Terrain, fetched: &Fetched<'_, F>, up: bool) -> Step {
        if terrain.policies.siblings
            && !up
            && let Some(place) = self.node(&terrain.field)
            && let Some(depth) = fetched.depth_at(place)
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
        let level = self.level;
        let boundary = [node[0] + track.ahead[0], node[1] + track.ahead[1]];
        let (axis, exit) = track.exit([boundary[0] << level, boundary[1] << level])?;
        if !exit.lt(depth) {
            return None;
        }
        if self.t.lt(exit) {
            self.t = exit;
        }
        let (boundary, node_beside) = (on(axis, boundary), on(1 - axis, node));
        let beyond = (boundary << level) + on(axis, track.ahead) - 1;
        let beside = within(track.index(1 - axis, self.t), node_beside, level);
        self.leaf = [on(axis, [beyond, beside]), on(axis, [beside, beyond])];
        self.place = field.leaf(self.leaf);
        self.crossed = true;
        let crossing = Crossing { node, target, boundary, stayed: self.stayed };
        let up = policies.ascend.goes_up(policies.coherent, policies.reach, &crossing)
            & (level < field.shape().root());
        self.stayed = !up;
        self.level += u32::from(up);
        Some(up)
    }
}

/// One of a pair: which axis it is cannot be predicted. And no index, that would have the pair go through memory.
#[inline(always)]
fn on(axis: usize, pair: [i32; 2]) -> i32 {
    select_unpredictable(axis == 0, pair[0], pair[1])
}

/// `leaf`, moved into the span of the node on its axis.
#[inline(always)]
fn within(leaf: i32, node: i32, level: u32) -> i32 {
    let first = node << level;
    leaf.max(first).min(first + ((1 << level) - 1))
}

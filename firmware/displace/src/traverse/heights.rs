//! Heights as traversal sees them (P8, P14, P22); in: a leaf texel and a level, out: a byte of the pyramid, and the depth that a
//! height is; cost: integer work and a table.

use lucerna_softfloat::Format;

use super::Wrap;
use crate::pyramid::{MAX_LOG2, Order, Shape};

/// A height field as traversal sees it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Field {
    shape: Shape,
    /// The order of the map's texels.
    order: Order,
    /// Where each level begins, and how many bits of a texel's place fewer it takes to tell its nodes apart.
    levels: [(u32, u32); MAX_LOG2 as usize + 1],
    wrap: Wrap,
}

impl Field {
    /// A pyramid of this shape.
    pub fn new(shape: Shape, wrap: Wrap) -> Self {
        let [w, h] = shape.log2();
        // Two bits a level as long as there are bits of both axes, then one.
        let level = |level: u32| (shape.level_offset(level), level + level.min(w.min(h)));
        Self { shape, order: Order::of(shape), levels: core::array::from_fn(|i| level(i as u32)), wrap }
    }

    /// Its extent.
    #[inline]
    pub const fn shape(&self) -> Shape {
        self.shape
    }

    /// The place of a leaf texel in the map; coordinates wrap.
    #[inline(always)]
    pub(super) const fn leaf(&self, leaf: [i32; 2]) -> u32 {
        self.order.place(leaf[0] as u32, leaf[1] as u32)
    }

    /// The byte of the pyramid with the height of the node in which `leaf` lies, whose place in the map is `place`; `None` beyond
    /// the border.
    #[inline(always)]
    pub(super) fn node(&self, leaf: [i32; 2], place: u32, level: u32) -> Option<u32> {
        if self.wrap == Wrap::Border && !self.holds(leaf, level) {
            return None;
        }
        let (offset, bits) = self.levels.get(level as usize)?;
        Some(offset + (place >> bits))
    }

    /// Whether the node in which `leaf` lies is on the map itself, not on a repetition.
    #[inline]
    fn holds(&self, leaf: [i32; 2], level: u32) -> bool {
        let extent = self.shape.level(level).log2();
        (0..2).all(|axis| (leaf[axis] >> level) as u32 >> extent[axis] == 0)
    }

    /// Whether there is a surface at a leaf texel: everywhere with wrap, else on the map only.
    #[inline]
    pub fn lets_hit(&self, leaf: [i32; 2]) -> bool {
        self.wrap == Wrap::Repeat || self.holds(leaf, 0)
    }
}

/// A pyramid in memory.
#[derive(Clone, Copy, Debug)]
pub struct Pyramid<'a, F> {
    /// Its words.
    pub words: &'a [u32],
    /// The depth of each height (P14).
    pub depths: &'a Depths<F>,
}

impl<F: Format> Pyramid<'_, F> {
    /// The depth of the node whose height is in byte `place`.
    #[inline(always)]
    pub fn depth(&self, place: u32) -> F {
        let word = self.words.get(place as usize / 4).copied().unwrap_or_default();
        self.depths.of((word >> (8 * (place % 4))) as u8)
    }
}

/// What the cache delivered: the height of the ray's node, and its siblings', which are in the same word.
#[derive(Clone, Copy, Debug)]
pub struct Fetched<'a, F> {
    /// The byte of the pyramid with the node's height.
    pub place: u32,
    /// The depth of the node's top.
    pub depth: F,
    /// Where its siblings' are.
    pub pyramid: Pyramid<'a, F>,
}

impl<F: Format> Fetched<'_, F> {
    /// The depth of another node, if its height is in the same word.
    #[inline(always)]
    pub(super) fn depth_at(&self, place: u32) -> Option<F> {
        (place / 4 == self.place / 4).then(|| self.pyramid.depth(place))
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

#[cfg(test)]
mod tests {
    use super::Field;
    use crate::pyramid::{Order, Shape};
    use crate::traverse::Wrap;

    /// The bits of a texel's place begin with those of its nodes' places, on both sides of 0.
    #[test]
    fn a_node_is_found_from_its_leaf() {
        for (w, h) in [(0, 0), (3, 3), (1, 4), (5, 2), (0, 3)] {
            let shape = Shape::new(w, h);
            let (repeat, border) = (Field::new(shape, Wrap::Repeat), Field::new(shape, Wrap::Border));
            for level in 0..=shape.root() {
                let (order, offset) = (Order::of(shape.level(level)), shape.level_offset(level));
                for (x, y) in (-40..40).flat_map(|y| (-40..40).map(move |x| (x, y))) {
                    let (node, place) = ([(x >> level) as u32, (y >> level) as u32], repeat.leaf([x, y]));
                    let expected = offset + order.place(node[0], node[1]);
                    assert_eq!(repeat.node([x, y], place, level), Some(expected), "{x} {y} {level}");
                    let [w, h] = shape.level(level).log2();
                    let held = (node[0] < 1 << w && node[1] < 1 << h).then_some(expected);
                    assert_eq!(border.node([x, y], place, level), held, "{x} {y} {level}");
                }
            }
        }
    }
}

//! Heights as traversal sees them (P8, P14, P22); in: a leaf texel and a level, out: a byte of the pyramid, and the depth that a
//! height is; cost: integer work and a table.

use lucerna_softfloat::Format;

use super::Wrap;
use crate::pyramid::{MAX_LOG2, Order, Shape};

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
    pub(super) fn depth(&self) -> F {
        self.depths.of((self.word >> (8 * (self.place % 4))) as u8)
    }

    /// The depth of another node, if its height is in the same word.
    #[inline(always)]
    pub(super) fn depth_at(&self, place: u32) -> Option<F> {
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

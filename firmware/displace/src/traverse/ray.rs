//! A ray in texture space (P12, P24); in: entry and direction, out: the texel at a depth, the parameter of an edge; cost: Table 1's
//! multipliers, adders and dividers of the traverse unit.

use lucerna_softfloat::{Format, Line};

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
        let Self { entry, direction } = *self;
        let Some((origin, line)) = F::Line::from_edge(entry, direction, log2) else {
            return Track::NOWHERE;
        };
        Track {
            origin,
            line,
            ahead: direction.map(|direction| i32::from(F::ZERO.lt(direction))),
            is_in_reach: true,
        }
    }
}

/// A ray in coordinates that begin at its entry texel, so that what is rounded is the way from the entry and not the place on
/// the map (P24).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Track<F: Format> {
    /// The texel edge from which all is counted; not wrapped.
    origin: [i32; 2],
    /// The ray from there.
    line: F::Line,
    /// On which side of a node it leaves it: 1 on the upper, 0 on the lower.
    pub(super) ahead: [i32; 2],
    is_in_reach: bool,
}

impl<F: Format> Track<F> {
    /// No ray.
    pub(crate) const NOWHERE: Self =
        Self { origin: [0; 2], line: F::Line::NOWHERE, ahead: [0; 2], is_in_reach: false };

    /// Whether its entry is a number, and less than 2^24 texels from the origin: further out texels cannot be told apart, so no
    /// ray begins there.
    #[inline]
    pub const fn is_in_reach(&self) -> bool {
        self.is_in_reach
    }

    /// The leaf texel at `t`.
    #[inline(always)]
    pub(super) fn texel_at(&self, t: F) -> [i32; 2] {
        let [x, y] = self.line.cell(t, 0);
        [self.origin[0] + x, self.origin[1] + y]
    }

    /// The leaf texel in which it begins.
    #[inline(always)]
    pub(super) fn first_texel(&self) -> [i32; 2] {
        let [x, y] = self.line.first();
        [self.origin[0] + x, self.origin[1] + y]
    }

    /// The texels in which it begins and ends, on a grid that is `1 << finer` times finer.
    pub(super) fn ends(&self, finer: u32) -> [[i32; 2]; 2] {
        [F::ZERO, F::ONE].map(|t| {
            let [x, y] = self.line.cell(t, finer);
            [(self.origin[0] << finer) + x, (self.origin[1] << finer) + y]
        })
    }

    /// Its index on one axis.
    #[inline(always)]
    pub(super) fn index(&self, axis: usize, t: F) -> i32 {
        self.origin[axis] + self.line.index(axis, t)
    }

    /// The axis on which it leaves a node whose edges ahead are at leaf indices `edge`, and the parameter at which it does
    /// (P12); x goes first (P13). There is none when it goes straight down.
    #[inline(always)]
    pub(super) fn exit(&self, edge: [i32; 2]) -> Option<(usize, F)> {
        self.line.exit([edge[0] - self.origin[0], edge[1] - self.origin[1]])
    }
}

//! Going up (§3.3); in: a crossing, out: whether to go on one level higher; cost: integer tests beside the exit parameters.

/// When a crossing goes up a level.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Ascend {
    /// Never: \[10\].
    Never,
    /// When the boundary is the parent's too (P3): \[12\].
    Parity,
    /// Like that, unless the ray comes down so near that it surely pierces the neighbour node (P4): (c1).
    #[default]
    Selective,
    /// When the crossing before stayed on its level (P5): (c2).
    Coherent,
}

/// Readings of "consecutive node crossing occurs at the same level" (P5).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Coherent {
    /// A flag that a staying crossing sets and a level-up clears.
    #[default]
    Toggle,
    /// The same, but going down clears it.
    Consecutive,
    /// The same as the first, but going up also needs a parent's boundary.
    Parity,
}

/// What the policies look at.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// The node left, at its level.
    pub node: [i32; 2],
    /// The node in which the ray would come down on the top of `node`.
    pub target: [i32; 2],
    /// The index of the boundary crossed: that of the node whose lower edge it is.
    pub boundary: i32,
    /// The flag of (c2).
    pub stayed: bool,
}

impl Crossing {
    /// Whether the boundary is also one of the next level (P3).
    #[inline]
    const fn is_parent_s(&self) -> bool {
        self.boundary & 1 == 0
    }

    /// Whether the ray comes down at most `reach` nodes further (P4: 1).
    #[inline]
    fn comes_down_within(&self, reach: u32) -> bool {
        let x = self.node[0].abs_diff(self.target[0]);
        let y = self.node[1].abs_diff(self.target[1]);
        x.max(y) <= reach
    }
}

impl Ascend {
    /// Whether this crossing goes up.
    #[inline]
    pub fn goes_up(self, coherent: Coherent, reach: u32, crossing: &Crossing) -> bool {
        match self {
            Self::Never => false,
            Self::Parity => crossing.is_parent_s(),
            // Both at once: neither can be predicted.
            Self::Selective => crossing.is_parent_s() & !crossing.comes_down_within(reach),
            Self::Coherent => crossing.stayed && (coherent != Coherent::Parity || crossing.is_parent_s()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Ascend, Coherent, Crossing};

    fn up(ascend: Ascend, reach: u32, crossing: Crossing) -> bool {
        ascend.goes_up(Coherent::Toggle, reach, &crossing)
    }

    const FAR: Crossing = Crossing { node: [3, 1], target: [6, 1], boundary: 4, stayed: false };

    #[test]
    fn only_a_parent_s_boundary_leads_up() {
        assert!(up(Ascend::Parity, 1, FAR));
        assert!(!up(Ascend::Parity, 1, Crossing { boundary: 3, ..FAR }));
        assert!(up(Ascend::Parity, 1, Crossing { boundary: -2, ..FAR }), "also below 0");
        assert!(!up(Ascend::Never, 1, FAR));
    }

    /// Fig. 5, left: the ray comes down next door.
    #[test]
    fn selective_stays_when_the_ray_comes_down_within_reach() {
        assert!(up(Ascend::Selective, 1, FAR));
        assert!(up(Ascend::Selective, 1, Crossing { target: [5, 1], ..FAR }));
        assert!(!up(Ascend::Selective, 1, Crossing { target: [4, 2], ..FAR }));
        assert!(!up(Ascend::Selective, 2, Crossing { target: [5, 1], ..FAR }));
        assert!(up(Ascend::Selective, 2, FAR));
    }

    /// Fig. 5, right: the second crossing of the level goes up.
    #[test]
    fn coherent_goes_up_after_a_crossing_that_stayed() {
        assert!(!up(Ascend::Coherent, 1, FAR));
        assert!(up(Ascend::Coherent, 1, Crossing { stayed: true, boundary: 3, ..FAR }));
        let odd = Crossing { stayed: true, boundary: 3, ..FAR };
        assert!(!Ascend::Coherent.goes_up(Coherent::Parity, 1, &odd));
    }
}

//! Going down (§3.2, P6); in: the level and whether the ray has crossed, out: the next level; cost: wires.

use core::hint::select_unpredictable;

/// The level below `level` at which a ray goes on: `levels_down` lower, if there are so many and it has crossed no node yet.
#[inline]
pub fn level(level: u32, levels_down: u32, crossed: bool) -> u32 {
    let down = select_unpredictable(crossed | (level < levels_down), 1, levels_down);
    level.saturating_sub(down)
}

#[cfg(test)]
mod tests {
    use super::level;

    /// Fig. 4: level 4, 2, 0.
    #[test]
    fn the_paper_s_example() {
        assert_eq!(level(4, 2, false), 2);
        assert_eq!(level(2, 2, false), 0);
    }

    #[test]
    fn one_at_a_time_after_a_crossing_or_near_the_leaves() {
        assert_eq!(level(4, 2, true), 3);
        assert_eq!(level(1, 2, false), 0);
        assert_eq!(level(3, 4, false), 2);
    }
}

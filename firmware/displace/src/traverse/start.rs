//! The start level (§3.1, P7); in: where a ray begins and ends, out: the lowest level at which it crosses no node; cost: one pass.

/// The level at which texels `from` and `to` of the finest grid lie in one node, at most `root`.
///
/// Both are signed and not wrapped: a ray that leaves the map begins at the root.
#[inline]
pub fn level(from: [i32; 2], to: [i32; 2], root: u32) -> u32 {
    let differing = (from[0] ^ to[0]) as u32 | (from[1] ^ to[1]) as u32;
    (u32::BITS - differing.leading_zeros()).min(root)
}

#[cfg(test)]
mod tests {
    use super::level;

    /// Fig. 3: (4, 3) to (6, 2) in a map of 8 by 8.
    #[test]
    fn the_paper_s_example() {
        assert_eq!(level([4, 3], [6, 2], 3), 2);
    }

    #[test]
    fn one_texel_is_level_0_and_leaving_the_map_is_the_root() {
        assert_eq!(level([5, 5], [5, 5], 8), 0);
        assert_eq!(level([0, 0], [-1, 0], 8), 8);
        assert_eq!(level([255, 0], [256, 0], 8), 8);
    }
}

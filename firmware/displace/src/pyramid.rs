//! Where a texel is; in: level and texel, out: its place in memory; cost: a few integer operations.
//!
//! A pyramid holds level 0 (the map itself) first, then each coarser level; a texel of level `l + 1` is the maximum of the up
//! to four texels below it (§2). Within a level texels are in Morton order: the bits that both axes have are interleaved, the
//! longer axis' other bits are above them. Textures and normal maps are in the same order, so a cache line is a square.

/// The longest side of a map is `1 << MAX_LOG2` texels.
pub const MAX_LOG2: u32 = 12;

/// Width and height of a map, powers of two.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Shape {
    log2: [u32; 2],
}

impl Shape {
    /// A map of `1 << width` by `1 << height` texels; more than [`MAX_LOG2`] is taken as that.
    pub const fn new(width: u32, height: u32) -> Self {
        const fn clip(log2: u32) -> u32 {
            if log2 > MAX_LOG2 { MAX_LOG2 } else { log2 }
        }
        Self { log2: [clip(width), clip(height)] }
    }

    /// Binary logarithms of width and height.
    #[inline]
    pub const fn log2(self) -> [u32; 2] {
        self.log2
    }

    /// The level at which the whole map is one texel.
    #[inline]
    pub const fn root(self) -> u32 {
        let [w, h] = self.log2;
        if w > h { w } else { h }
    }

    /// Texels of the map itself.
    #[inline]
    pub const fn texels(self) -> u32 {
        1 << (self.log2[0] + self.log2[1])
    }

    /// The shape of a level of its pyramid.
    #[inline]
    pub const fn level(self, level: u32) -> Self {
        Self { log2: [self.log2[0].saturating_sub(level), self.log2[1].saturating_sub(level)] }
    }

    /// The byte at which a level of its pyramid begins.
    #[inline]
    pub const fn level_offset(self, level: u32) -> u32 {
        let (mut offset, mut below) = (0, 0);
        while below < level {
            offset += self.level(below).texels();
            below += 1;
        }
        offset
    }

    /// Bytes of the whole pyramid.
    pub const fn pyramid_bytes(self) -> u32 {
        self.level_offset(self.root() + 1)
    }

    /// The place of a texel among those of this shape; coordinates wrap.
    #[inline]
    pub const fn morton(self, x: u32, y: u32) -> u32 {
        Order::of(self).place(x, y)
    }
}

/// The order of the texels of a shape, with all that depends on the shape alone worked out.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Order {
    /// The bits of each coordinate that count.
    wrap: [u32; 2],
    /// How many bits both axes have, and these bits.
    shared: u32,
    both: u32,
}

impl Order {
    /// That of a shape.
    #[inline]
    pub const fn of(shape: Shape) -> Self {
        let [w, h] = shape.log2;
        let shared = if w < h { w } else { h };
        Self { wrap: [(1 << w) - 1, (1 << h) - 1], shared, both: (1 << shared) - 1 }
    }

    /// The place of a texel; coordinates wrap.
    #[inline]
    pub const fn place(&self, x: u32, y: u32) -> u32 {
        let (x, y) = (x & self.wrap[0], y & self.wrap[1]);
        // Only the longer axis has bits above the shared ones.
        interleaved(x & self.both, y & self.both) | ((x | y) & !self.both) << self.shared
    }
}

/// The low 16 bits of both, those of `x` in the even places.
#[inline]
const fn interleaved(x: u32, y: u32) -> u32 {
    let bits = x as u64 | (y as u64) << 32;
    let bits = (bits | bits << 8) & 0x00FF_00FF_00FF_00FF;
    let bits = (bits | bits << 4) & 0x0F0F_0F0F_0F0F_0F0F;
    let bits = (bits | bits << 2) & 0x3333_3333_3333_3333;
    let bits = (bits | bits << 1) & 0x5555_5555_5555_5555;
    (bits | bits >> 31) as u32
}

#[cfg(test)]
mod tests {
    use super::Shape;

    /// Every texel of every level has a byte of its own, and no byte is left over.
    #[test]
    fn places_are_a_permutation() {
        for (w, h) in [(0, 0), (3, 3), (1, 4), (5, 2), (0, 3)] {
            let shape = Shape::new(w, h);
            let mut seen = vec![false; shape.pyramid_bytes() as usize];
            for level in 0..=shape.root() {
                let part = shape.level(level);
                for y in 0..1 << part.log2()[1] {
                    for x in 0..1 << part.log2()[0] {
                        let place = (shape.level_offset(level) + part.morton(x, y)) as usize;
                        assert!(!std::mem::replace(&mut seen[place], true));
                    }
                }
            }
            assert!(seen.iter().all(|seen| *seen));
        }
    }

    #[test]
    fn siblings_are_neighbours() {
        let shape = Shape::new(4, 4);
        assert_eq!([(2, 4), (3, 4), (2, 5), (3, 5)].map(|(x, y)| shape.morton(x, y)), [36, 37, 38, 39]);
        assert_eq!(shape.morton(18, 4), 36, "coordinates wrap");
    }
}

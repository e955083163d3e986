//! Where a texel is. In: binary logarithms of a map's width and height, and a texel. Out: its place in memory. Cost: a
//! few shifts and masks.
//!
//! Texels are in Morton order: the bits which both coordinates have are interleaved, x lowest; the longer axis' other
//! bits are above them. So a cache line is a square, and the texels below one of the next coarser level are neighbours.

/// The longest side of a map is `1 << MAX_LOG2` texels: 4096.
pub const MAX_LOG2: u32 = 12;

/// Width and height of a map in texels: powers of two from 1 to 4096, in any combination.
///
/// ```
/// use lucerna_driver::displace::Shape;
///
/// let shape = Shape::new(4, 3).unwrap();
/// assert_eq!(Shape::of(16, 8), Some(shape));
/// assert_eq!((shape.width(), shape.height(), shape.texels(), shape.root()), (16, 8, 128, 4));
/// assert_eq!(shape.morton(3, 2), 0b1101);
/// assert_eq!(shape.texel(0b1101), (3, 2));
/// assert_eq!(Shape::of(16, 9), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Shape {
    log2: [u32; 2],
}

impl Shape {
    /// A map of `1 << width` by `1 << height` texels; `None` above [`MAX_LOG2`].
    pub const fn new(width: u32, height: u32) -> Option<Self> {
        if width > MAX_LOG2 || height > MAX_LOG2 { None } else { Some(Self { log2: [width, height] }) }
    }

    /// A map of so many texels along either axis; `None` unless both are powers of two up to 4096.
    pub const fn of(width: u32, height: u32) -> Option<Self> {
        if !width.is_power_of_two() || !height.is_power_of_two() {
            return None;
        }
        Self::new(width.trailing_zeros(), height.trailing_zeros())
    }

    /// Binary logarithms of width and height.
    pub const fn log2(self) -> [u32; 2] {
        self.log2
    }

    /// Texels along u.
    pub const fn width(self) -> u32 {
        1 << self.log2[0]
    }

    /// Texels along v.
    pub const fn height(self) -> u32 {
        1 << self.log2[1]
    }

    /// Texels in all: at most 2^24.
    pub const fn texels(self) -> u32 {
        1 << (self.log2[0] + self.log2[1])
    }

    /// The level of its pyramid at which the whole map is one texel.
    pub const fn root(self) -> u32 {
        let [w, h] = self.log2;
        if w > h { w } else { h }
    }

    /// The shape of a level of its pyramid; level 0 is the map itself. An axis that is one texel long stays so.
    pub const fn level(self, level: u32) -> Self {
        Self { log2: [self.log2[0].saturating_sub(level), self.log2[1].saturating_sub(level)] }
    }

    /// The byte at which a level of its pyramid begins, from 0 at level 0; a texel is a byte.
    pub const fn level_offset(self, level: u32) -> u32 {
        let (mut offset, mut below) = (0, 0);
        while below < level && below <= self.root() {
            offset += self.level(below).texels();
            below += 1;
        }
        offset
    }

    /// Bytes of the whole pyramid: below 2^25.
    pub const fn pyramid_bytes(self) -> u32 {
        self.level_offset(self.root() + 1)
    }

    /// How many texels of a level lie below one of the next: 4, or 2 once an axis is one texel long.
    pub(crate) const fn arity(self, level: u32) -> u32 {
        let [w, h] = self.level(level).log2;
        if w > 0 && h > 0 { 4 } else { 2 }
    }

    /// The place of a texel among those of this shape; coordinates wrap.
    pub const fn morton(self, x: u32, y: u32) -> u32 {
        let [w, h] = self.log2;
        let shared = self.shared();
        let (x, y) = (x & (self.width() - 1), y & (self.height() - 1));
        let mask = (1 << shared) - 1;
        let rest = if w > h { x >> shared } else { y >> shared };
        spread(x & mask) | spread(y & mask) << 1 | rest << (2 * shared)
    }

    /// The texel at a place: x and y. Places wrap.
    pub const fn texel(self, place: u32) -> (u32, u32) {
        let [w, h] = self.log2;
        let shared = self.shared();
        let place = place & (self.texels() - 1);
        let mask = (1 << shared) - 1;
        let rest = (place >> (2 * shared)) << shared;
        let (x, y) = (gather(place) & mask, gather(place >> 1) & mask);
        if w > h { (x | rest, y) } else { (x, y | rest) }
    }

    /// The bits which both coordinates have.
    const fn shared(self) -> u32 {
        let [w, h] = self.log2;
        if w < h { w } else { h }
    }
}

/// Puts a zero above each of the low 16 bits.
const fn spread(x: u32) -> u32 {
    let x = (x | x << 8) & 0x00FF_00FF;
    let x = (x | x << 4) & 0x0F0F_0F0F;
    let x = (x | x << 2) & 0x3333_3333;
    (x | x << 1) & 0x5555_5555
}

/// Takes the even bits, and closes the gaps.
const fn gather(x: u32) -> u32 {
    let x = x & 0x5555_5555;
    let x = (x | x >> 1) & 0x3333_3333;
    let x = (x | x >> 2) & 0x0F0F_0F0F;
    let x = (x | x >> 4) & 0x00FF_00FF;
    (x | x >> 8) & 0x0000_FFFF
}

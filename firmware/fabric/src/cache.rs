//! The tags of a cache; in: byte addresses, out: whether their lines are there; cost: a compare for the line used last in its
//! set, else one a way.
//!
//! Only tags are held. A unit reads the memory itself in the cycle in which its address hits; that gives the very bits that a
//! data array would, because nothing a job reads may overlap what it writes, so a line cannot change while it is cached.
//! A set's ways are compared in one cycle, and every requester has a port of its own to a cache of its own: there are no bank
//! conflicts to model.

use core::fmt;
use core::num::NonZeroU32;

/// The size of a cache: all powers of two.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Geometry {
    /// Bytes in all.
    pub bytes: u32,
    /// Lines a set, 1 to [`MAX_WAYS`].
    pub ways: u32,
    /// Bytes a line, at least a word.
    pub line_bytes: u32,
}

/// Most lines a set.
pub const MAX_WAYS: u32 = 16;

/// Why there is no cache of a geometry.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum GeometryError {
    /// A size is not a power of two.
    NotPowerOfTwo,
    /// A line is shorter than a word.
    ShortLine,
    /// More than [`MAX_WAYS`] ways.
    ManyWays,
    /// Fewer bytes than one set has.
    NoSet,
    /// More lines than the type has room for.
    TooLarge,
}

impl GeometryError {
    /// What to do about it.
    pub const fn advice(self) -> &'static str {
        match self {
            Self::NotPowerOfTwo => "a cache's bytes, ways and bytes a line must be powers of two",
            Self::ShortLine => "a cache line must have at least 4 bytes",
            Self::ManyWays => "a cache may have at most 16 ways",
            Self::NoSet => {
                "a cache must hold at least one set: raise its bytes, or lower its ways or bytes a line"
            }
            Self::TooLarge => "the cache has more lines than its type: lower its bytes or raise LINES",
        }
    }
}

impl fmt::Display for GeometryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.advice())
    }
}

impl core::error::Error for GeometryError {}

impl Geometry {
    /// How many lines it has, when there is such a cache.
    ///
    /// # Errors
    /// A [`GeometryError`].
    pub const fn lines(self) -> Result<u32, GeometryError> {
        let Self { bytes, ways, line_bytes } = self;
        if !bytes.is_power_of_two() || !ways.is_power_of_two() || !line_bytes.is_power_of_two() {
            Err(GeometryError::NotPowerOfTwo)
        } else if line_bytes < 4 {
            Err(GeometryError::ShortLine)
        } else if ways > MAX_WAYS {
            Err(GeometryError::ManyWays)
        } else if bytes / line_bytes < ways {
            Err(GeometryError::NoSet)
        } else {
            Ok(bytes / line_bytes)
        }
    }
}

/// A line's number plus one, so that no line is `None`: with four bytes a line or more there are fewer than 2^30 lines.
type Tag = Option<NonZeroU32>;

/// The tags of a set-associative cache of up to `LINES` lines, least recently used out first.
///
/// ```
/// use lucerna_fabric::cache::{Geometry, Tags};
/// let mut tags: Tags<512> = Tags::new(Geometry { bytes: 16384, ways: 4, line_bytes: 32 })?;
/// assert!(!tags.lookup(100));
/// assert_eq!(tags.fill(100), None);
/// assert!(tags.lookup(127));
/// assert!(!tags.lookup(128));
/// # Ok::<(), lucerna_fabric::cache::GeometryError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tags<const LINES: usize> {
    geometry: Geometry,
    line_shift: u32,
    ways_shift: u32,
    set_mask: u32,
    /// Set by set; within a set the most recently used first, and empty places last. The order is the replacement state.
    tags: [Tag; LINES],
}

impl<const LINES: usize> Tags<LINES> {
    /// An empty cache.
    ///
    /// # Errors
    /// A [`GeometryError`].
    pub const fn new(geometry: Geometry) -> Result<Self, GeometryError> {
        let lines = match geometry.lines() {
            Ok(lines) => lines,
            Err(error) => return Err(error),
        };
        if lines as usize > LINES {
            return Err(GeometryError::TooLarge);
        }
        Ok(Self {
            geometry,
            line_shift: geometry.line_bytes.trailing_zeros(),
            ways_shift: geometry.ways.trailing_zeros(),
            set_mask: lines / geometry.ways - 1,
            tags: [None; LINES],
        })
    }

    /// Its size.
    pub const fn geometry(&self) -> Geometry {
        self.geometry
    }

    /// The first byte address of the line that holds this one.
    #[inline]
    pub const fn line(&self, address: u32) -> u32 {
        address & !(self.geometry.line_bytes - 1)
    }

    /// Whether the line of this byte address is there; if so it is now its set's most recently used.
    #[inline]
    pub fn lookup(&mut self, address: u32) -> bool {
        let (first, tag) = self.place(address);
        // Its order in the set does not change.
        self.tags.get(first) == Some(&tag) || self.search(first, tag)
    }

    /// All ways of a set.
    fn search(&mut self, first: usize, tag: Tag) -> bool {
        let set = self.set(first);
        if let [last, held, ..] = set
            && *held == tag
        {
            core::mem::swap(last, held);
            return true;
        }
        let found = set.contains(&tag);
        if found {
            to_front(set, tag);
        }
        found
    }

    /// Whether the line is there; nothing changes.
    #[inline]
    pub fn contains(&self, address: u32) -> bool {
        let (first, tag) = self.place(address);
        self.tags.iter().skip(first).take(1 << self.ways_shift).any(|held| *held == tag)
    }

    /// Puts the line of this byte address in, as its set's most recently used, and gives the first byte address of the line
    /// that had to leave. A line that is there stays.
    #[inline]
    pub fn fill(&mut self, address: u32) -> Option<u32> {
        let (first, tag) = self.place(address);
        let evicted = to_front(self.set(first), tag)?;
        Some((evicted.get() - 1) << self.line_shift)
    }

    /// Empties it.
    pub fn clear(&mut self) {
        self.tags.fill(None);
    }

    /// Where a line's set begins, and the line's tag.
    #[inline]
    const fn place(&self, address: u32) -> (usize, Tag) {
        let line = address >> self.line_shift;
        (((line & self.set_mask) << self.ways_shift) as usize, NonZeroU32::new(line + 1))
    }

    #[inline]
    fn set(&mut self, first: usize) -> &mut [Tag] {
        let ways = 1 << self.ways_shift;
        // Always whole: `new` saw that all sets fit.
        self.tags.get_mut(first..first + ways).unwrap_or_default()
    }
}

/// Puts a tag first and moves the others one back, up to where it was or where there is room; gives the one that drops out.
#[inline]
fn to_front(set: &mut [Tag], tag: Tag) -> Tag {
    let mut moving = tag;
    for place in set {
        moving = core::mem::replace(place, moving);
        if moving == tag || moving.is_none() {
            return None;
        }
    }
    moving
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{Geometry, GeometryError, Tags};
    use proptest::prelude::*;
    use std::{vec, vec::Vec};

    const SMALL: Geometry = Geometry { bytes: 128, ways: 2, line_bytes: 16 };

    #[test]
    fn the_least_recently_used_line_leaves() {
        let mut tags: Tags<8> = Tags::new(SMALL).unwrap();
        // Four sets of 16-byte lines: addresses 64 apart share a set.
        assert_eq!(tags.fill(0), None);
        assert_eq!(tags.fill(64), None);
        assert!(tags.lookup(0));
        assert_eq!(tags.fill(128), Some(64));
        assert!(tags.contains(0) && tags.contains(128) && !tags.contains(64));
    }

    #[test]
    fn looking_without_touching_changes_nothing() {
        let mut tags: Tags<8> = Tags::new(SMALL).unwrap();
        tags.fill(0);
        tags.fill(64);
        assert!(tags.contains(0));
        assert_eq!(tags.fill(128), Some(0));
    }

    #[test]
    fn a_miss_changes_nothing() {
        let mut tags: Tags<8> = Tags::new(SMALL).unwrap();
        tags.fill(0);
        tags.fill(64);
        assert!(!tags.lookup(128));
        assert_eq!(tags.fill(192), Some(0));
    }

    #[test]
    fn the_last_line_of_the_address_space_is_one_like_others() {
        let mut tags: Tags<1> = Tags::new(Geometry { bytes: 4, ways: 1, line_bytes: 4 }).unwrap();
        assert!(!tags.lookup(u32::MAX));
        assert_eq!(tags.fill(u32::MAX), None);
        assert!(tags.lookup(tags.line(u32::MAX)));
        assert_eq!(tags.fill(0), Some(u32::MAX - 3));
    }

    #[test]
    fn sizes_no_cache_has_are_refused() {
        let refuse = |bytes, ways, line_bytes| Tags::<8>::new(Geometry { bytes, ways, line_bytes }).err();
        assert_eq!(refuse(128, 2, 16), None);
        assert_eq!(refuse(0, 2, 16), Some(GeometryError::NotPowerOfTwo));
        assert_eq!(refuse(128, 3, 16), Some(GeometryError::NotPowerOfTwo));
        assert_eq!(refuse(128, 2, 0), Some(GeometryError::NotPowerOfTwo));
        assert_eq!(refuse(128, 2, 2), Some(GeometryError::ShortLine));
        assert_eq!(refuse(128, 32, 4), Some(GeometryError::ManyWays));
        assert_eq!(refuse(16, 2, 16), Some(GeometryError::NoSet));
        assert_eq!(refuse(256, 2, 16), Some(GeometryError::TooLarge));
    }

    /// Each set a list of line addresses, the most recently used first.
    struct Naive {
        sets: Vec<Vec<u32>>,
        geometry: Geometry,
    }

    impl Naive {
        fn set(&mut self, address: u32) -> (&mut Vec<u32>, u32) {
            let line = address / self.geometry.line_bytes;
            let sets = self.sets.len();
            (&mut self.sets[line as usize % sets], line * self.geometry.line_bytes)
        }
        fn lookup(&mut self, address: u32) -> bool {
            let (set, line) = self.set(address);
            let Some(at) = set.iter().position(|held| *held == line) else { return false };
            let line = set.remove(at);
            set.insert(0, line);
            true
        }
        fn fill(&mut self, address: u32) -> Option<u32> {
            if self.lookup(address) {
                return None;
            }
            let ways = self.geometry.ways as usize;
            let (set, line) = self.set(address);
            set.insert(0, line);
            if set.len() > ways { set.pop() } else { None }
        }
    }

    proptest! {
        #[test]
        fn is_a_list_a_set(
            (ways, sets, words) in (0u32..5, 0u32..4, 0u32..4),
            accesses in prop::collection::vec((0u8..8, 0u32..2048), 1..400),
        ) {
            let geometry = Geometry { bytes: 4 << (ways + sets + words), ways: 1 << ways, line_bytes: 4 << words };
            let mut tags: Tags<128> = Tags::new(geometry).unwrap();
            let mut naive = Naive { sets: vec![Vec::new(); 1 << sets], geometry };
            for (what, address) in accesses {
                match what {
                    0..4 => prop_assert_eq!(tags.lookup(address), naive.lookup(address)),
                    4..7 => prop_assert_eq!(tags.fill(address), naive.fill(address)),
                    _ => {
                        let (set, line) = naive.set(address);
                        prop_assert_eq!(tags.contains(address), set.contains(&line));
                        prop_assert_eq!(tags.line(address), line);
                    }
                }
            }
            tags.clear();
            prop_assert!((0..2048).all(|address| !tags.contains(address)));
        }
    }
}

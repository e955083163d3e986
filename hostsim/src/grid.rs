//! In: hit points. Out: the index table, each cell's hit-point numbers side by side, and the lookup of a position in it.
//! Cost: two passes over the hit points, each in about eight cells; a lookup is a hash and two loads.
//!
//! ```
//! # use hostsim::{grid::HashGrid, scene::{LoadOptions, Scene}, trace::eye_pass};
//! let scene = Scene::load("cornell-balls", &LoadOptions::default())?;
//! let points = eye_pass(&scene, 20, 15);
//! let grid = HashGrid::build(&points, 20, 15)?;
//! assert_eq!(grid.entries().len(), 4848);
//! let list = grid.lookup(points[0].position);
//! assert!(grid.numbers(list).contains(&0), "a hit point is listed in its own cell");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::scene::Vec3;
use crate::trace::HitPoint;

/// Why no grid could be built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum GridError {
    /// There is nothing to estimate.
    #[error(
        "the camera sees no diffuse surface, so there are no hit points: turn the camera, or check the scene's materials"
    )]
    NoHitPoints,
    /// All hit points are in one place, so the search radius is zero.
    #[error("all {0} hit points are in one place: move the camera back or enlarge the picture")]
    NoExtent(usize),
    /// The index table would not fit 32-bit numbers.
    #[error("the index table would need more than 2^32 - 1 entries: make the picture smaller")]
    TooLarge,
}

/// A cell's list, as a photon record names it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct List {
    /// Number of its first entry in the index table.
    pub p_addr: u32,
    /// Its length.
    pub n: u32,
}

/// Hit points by place: a hash table over cells twice the search radius wide.
#[derive(Clone, Debug)]
pub struct HashGrid {
    radius: f64,
    min: Vec3,
    scale: f64,
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl HashGrid {
    /// Lists each hit point in every cell its search sphere's box touches.
    ///
    /// The numbers are those of `points`, 0 the oldest. The points are taken newest first and each goes to the front of its
    /// lists, so a list is walked oldest first.
    ///
    /// # Errors
    /// [`GridError`].
    pub fn build(points: &[HitPoint], width: u32, height: u32) -> Result<Self, GridError> {
        let first = points.first().ok_or(GridError::NoHitPoints)?.position;
        let buckets = u32::try_from(points.len()).map_err(|_| GridError::TooLarge)?;
        let fit = |(min, max): (Vec3, Vec3), p: &HitPoint| (min.min(p.position), max.max(p.position));
        let (min, max) = points.iter().fold((first, first), fit);
        let extent = max - min;
        let radius =
            ((extent.x + extent.y + extent.z) / 3.0) / ((f64::from(width) + f64::from(height)) / 2.0) * 2.0;
        if radius <= 0.0 {
            return Err(GridError::NoExtent(points.len()));
        }
        let mut grid = Self {
            radius,
            min: min - Vec3::splat(radius),
            scale: 1.0 / (radius * 2.0),
            starts: Vec::new(),
            entries: Vec::new(),
        };

        // Count, sum, then fill each list from its end.
        let mut starts = vec![0u32; points.len() + 1];
        let mut total = 0u64;
        for p in points {
            grid.for_each_bucket(p.position, buckets, |bucket| {
                starts[bucket as usize] += 1;
                total += 1;
            });
        }
        if total > u64::from(u32::MAX) {
            return Err(GridError::TooLarge);
        }
        let mut sum = 0;
        for s in &mut starts {
            sum += *s;
            *s = sum;
        }
        let mut entries = vec![0u32; total as usize];
        for (number, p) in points.iter().enumerate().rev() {
            grid.for_each_bucket(p.position, buckets, |bucket| {
                let next = &mut starts[bucket as usize];
                *next -= 1;
                entries[*next as usize] = number as u32;
            });
        }
        grid.starts = starts;
        grid.entries = entries;
        Ok(grid)
    }

    /// The initial search radius: every hit point's R² starts at its square.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The index table: hit-point numbers, cell after cell.
    pub fn entries(&self) -> &[u32] {
        &self.entries
    }

    /// Number of hit points, which is also the number of buckets.
    pub fn buckets(&self) -> usize {
        self.starts.len() - 1
    }

    /// The hit-point numbers of a list.
    ///
    /// # Panics
    /// When the list is not one of this grid.
    pub fn numbers(&self, list: List) -> &[u32] {
        &self.entries[list.p_addr as usize..][..list.n as usize]
    }

    /// The list of the cell a position is in. Positions outside the box share buckets with cells inside it; the distance test
    /// turns their candidates away, but they are examined and counted, as in the published program.
    #[inline]
    pub fn lookup(&self, position: Vec3) -> List {
        let h = (position - self.min) * self.scale;
        let bucket = hash(cell(h.x), cell(h.y), cell(h.z), self.buckets() as u32) as usize;
        let (start, end) = (self.starts[bucket], self.starts[bucket + 1]);
        List { p_addr: start, n: end - start }
    }

    fn for_each_bucket(&self, position: Vec3, buckets: u32, mut visit: impl FnMut(u32)) {
        let low = (position - Vec3::splat(self.radius) - self.min) * self.scale;
        let high = (position + Vec3::splat(self.radius) - self.min) * self.scale;
        for iz in cell(low.z)..=cell(high.z) {
            for iy in cell(low.y)..=cell(high.y) {
                for ix in cell(low.x)..=cell(high.x) {
                    visit(hash(ix, iy, iz, buckets));
                }
            }
        }
    }
}

/// Truncation toward zero, then the magnitude: positions a little below the box share the first cell.
#[inline]
fn cell(x: f64) -> i32 {
    (x as i32).saturating_abs()
}

#[inline]
fn hash(ix: i32, iy: i32, iz: i32, buckets: u32) -> u32 {
    let mixed = ix.wrapping_mul(73_856_093) ^ iy.wrapping_mul(19_349_663) ^ iz.wrapping_mul(83_492_791);
    mixed as u32 % buckets
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(position: [f64; 3]) -> HitPoint {
        HitPoint { position: position.into(), normal: Vec3::ONE, colour: Vec3::ONE, pixel: 0 }
    }

    #[test]
    fn nothing_to_list_is_an_error() {
        assert_eq!(HashGrid::build(&[], 4, 4).unwrap_err(), GridError::NoHitPoints);
        assert_eq!(HashGrid::build(&[point([1.0; 3]); 2], 4, 4).unwrap_err(), GridError::NoExtent(2));
    }

    proptest! {
        /// Every hit point whose sphere holds a position is in that position's list.
        #[test]
        fn no_candidate_is_missed(
            positions in prop::collection::vec(prop::array::uniform3(-20.0f64..20.0), 2..60),
            photon in prop::array::uniform3(-20.0f64..20.0),
        ) {
            let points: Vec<_> = positions.into_iter().map(point).collect();
            let grid = HashGrid::build(&points, 16, 16).unwrap();
            let photon = Vec3::from(photon);
            let listed = grid.numbers(grid.lookup(photon));
            prop_assert!(listed.is_sorted());
            for (number, p) in points.iter().enumerate() {
                let v = p.position - photon;
                if v.dot(v) <= grid.radius() * grid.radius() {
                    prop_assert!(listed.contains(&(number as u32)));
                }
            }
        }
    }
}

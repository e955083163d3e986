//! The switch's input (Fig. 6); in: a job, out: one ray after the other; cost: none that is counted.
//!
//! What hands rays to the unit is another unit's business in the paper (its ray tracer); here records are read ahead, or pixels
//! counted, and the unit never waits for a ray.

use lucerna_softfloat::Format;

use crate::job::{self, Job};
use crate::record::{RAY_WORDS, RayRecord};
use crate::view::{self, View};

/// Where the next ray comes from.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    next: u32,
    count: u32,
    column: u32,
    row: u32,
}

impl Source {
    /// All rays of a job are to come.
    pub const fn new<F: Format>(job: &Job<F>) -> Self {
        Self { next: 0, count: job.results.count(), column: 0, row: 0 }
    }

    /// Whether there is no other ray.
    #[inline]
    pub const fn is_dry(&self) -> bool {
        self.next == self.count
    }

    /// The next ray's number, and what the view calculation makes of it.
    #[inline(never)]
    pub fn take<F: Format>(&mut self, job: &Job<F>, memory: &[u32]) -> Option<(u32, View<F>)> {
        if self.is_dry() {
            return None;
        }
        let number = self.next;
        self.next += 1;
        let view = match &job.source {
            job::Source::List { .. } => {
                let words = job.rays.read::<{ RAY_WORDS as usize }>(memory, number, 0)?;
                view::list(&job.tbn, &RayRecord::of(words))
            }
            job::Source::Raster(raster) => {
                let view = view::raster(&job.tbn, raster, self.column, self.row);
                self.column += 1;
                if self.column == raster.width {
                    self.column = 0;
                    self.row += 1;
                }
                view
            }
        };
        Some((number, view))
    }
}

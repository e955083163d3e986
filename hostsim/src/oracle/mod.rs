//! In: what the units are given. Out: what they should make of it, computed without them. Cost: 10 to 60 ns an operation.
//!
//! Of photons: [`Reference`] is the estimator in f64 with whole photon counts, as the published program has it; [`Scalar`] repeats the
//! engine's arithmetic, operation by operation, in its number format, one photon after the other.
//!
//! Of displaced surfaces: [`Tangent`] rounds a pixel's ray as the device does; [`Columns`] marches a ray through every column;
//! [`Pyramid`] traverses in f64.
//!
//! None shares code with the units they judge: not the datapath, not the soft-float, not the record layout.

mod march;
mod number;
mod order;
mod pyramid;
mod reference;
mod scalar;
mod tangent;

pub use march::{Column, Columns};
pub use number::{Bits24, Number};
pub use order::{evaluation_order, leap};
pub use pyramid::{LevelUp, Pyramid, Rules, Walk};
pub use reference::Reference;
pub use scalar::{Scalar, State};
pub use tangent::{Pinhole, RoundedRay, Tangent};

/// What an estimator has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Photons with a list.
    pub photons: u64,
    /// Photons whose cell is empty (D9).
    pub empty_cells: u64,
    /// Hit-point update operations: list entries examined, before any test.
    pub operations: u64,
    /// Operations that pass the normal test; 0 when the test is off or comes second and was not reached.
    pub facing: u64,
    /// Operations that pass every test and so change a hit point.
    pub updates: u64,
}

impl Counts {
    /// Surface hits, with or without a list.
    pub const fn surface_hits(&self) -> u64 {
        self.photons + self.empty_cells
    }
}

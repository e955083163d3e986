//! What the device's result is held against; in: the same photons, out: a verdict; cost: two reference loops over them.

use std::time::{Duration, Instant};

use lucerna_driver::{Allocation, NumberFormat};

use super::Prepared;
use crate::accelerate::session::ALPHA;
use crate::accelerate::{Outcome, Setup, Workload};
use crate::oracle::{self, Bits24, Number, Reference, Scalar};
use crate::trace::PhotonChunk;

/// The in-order scalar loop in the device's format.
enum InOrder {
    F32(Scalar<f32>),
    F24(Scalar<Bits24>),
}

/// Watches the photons go by.
pub struct Judge {
    reference: Reference,
    scalar: InOrder,
    /// Cycles that the PREUs would take without AFTSO: one photon at a time.
    one_photon_cycles: u64,
    units: u32,
    reference_time: Duration,
    scalar_time: Duration,
}

/// What the judge found.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Whether every bit of every hit point and pixel is the scalar loop's.
    pub bits_equal_scalar: bool,
    /// The f64 radiance of every pixel.
    pub reference: Vec<[f64; 3]>,
    /// Operations ÷ (cycles × PREUs) without AFTSO.
    pub utilisation_without_aftso: f64,
    /// Host time of the f64 loop.
    pub reference_time: Duration,
    /// Host time of the scalar loop in the device's format.
    pub scalar_time: Duration,
}

impl Judge {
    /// A judge of this device's work.
    pub fn new(prepared: &Prepared, setup: &Setup) -> Self {
        let (points, radius) = (&prepared.points, prepared.grid.radius());
        let alpha = f64::from(ALPHA);
        Self {
            reference: Reference::new(points, radius, true),
            scalar: match setup.format {
                // Words of the study format are f32; there is no loop that keeps more between two photons.
                NumberFormat::F32 | NumberFormat::F64 => {
                    InOrder::F32(Scalar::new(points, radius, alpha, setup.normal_test))
                }
                NumberFormat::F24 => InOrder::F24(Scalar::new(points, radius, alpha, setup.normal_test)),
            },
            one_photon_cycles: 0,
            units: setup.units.count(),
            reference_time: Duration::ZERO,
            scalar_time: Duration::ZERO,
        }
    }

    /// Takes the next photons in.
    pub fn watch(&mut self, chunk: &PhotonChunk, index: &[u32]) {
        self.one_photon_cycles +=
            chunk.lists.iter().map(|list| u64::from(list.n.div_ceil(self.units))).sum::<u64>();
        let started = Instant::now();
        self.reference.feed(chunk, index);
        self.reference_time += started.elapsed();
        let started = Instant::now();
        match &mut self.scalar {
            InOrder::F32(scalar) => scalar.feed(chunk, index),
            InOrder::F24(scalar) => scalar.feed(chunk, index),
        }
        self.scalar_time += started.elapsed();
    }

    /// Compares.
    pub fn finish(self, outcome: &Outcome, workload: &Workload<'_>, setup: &Setup) -> Verdict {
        let hits = workload.points.len() as u32;
        let leap = match setup.policies.allocation {
            Allocation::Leaping => oracle::leap(hits, self.units),
            Allocation::Sequential => 1,
        };
        let order = oracle::evaluation_order(hits, self.units, leap);
        let bits_equal_scalar = match &self.scalar {
            InOrder::F32(scalar) => equal(scalar, outcome, workload, order),
            InOrder::F24(scalar) => equal(scalar, outcome, workload, order),
        };
        // The first cycle only loads.
        let slots = (self.one_photon_cycles + 1) * u64::from(self.units);
        Verdict {
            bits_equal_scalar,
            reference: self.reference.radiance(workload.pixels, workload.emitted),
            utilisation_without_aftso: outcome.update.operations as f64 / slots as f64,
            reference_time: self.reference_time,
            scalar_time: self.scalar_time,
        }
    }
}

fn equal<N: Number>(scalar: &Scalar<N>, outcome: &Outcome, workload: &Workload<'_>, order: Vec<u32>) -> bool {
    let states = scalar.states().eq(outcome.states.iter().copied());
    let pixels = scalar.radiance(workload.pixels, workload.emitted, order);
    let pixels = pixels.iter().map(|pixel| pixel.map(Number::to_bits)).eq(outcome.pixel_bits.iter().copied());
    states && pixels
}

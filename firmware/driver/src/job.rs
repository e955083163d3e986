//! Jobs: what the device shall do, and nothing it cannot. In: a layout, numbers, policies. Out: a job, or why
//! there is none. Cost: a few comparisons; no access.

use core::fmt;

use lucerna_regs::pree::{Allocation, Busy, Config, Hazard, InputWidth, Mode, Scheduler};

use crate::Layout;
use crate::records::encode;

/// The named policies where the paper leaves the choice open. The default is the device's reset value: the
/// paper's unit, protected against hazards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Policies {
    /// A hit point (D7) or pixel (D12) used again while in flight.
    pub hazard: Hazard,
    /// When a full buffer takes the next photon (D4).
    pub busy: Busy,
    /// Photons accepted a cycle (D5).
    pub input_width: InputWidth,
    /// How photons share a dispatch.
    pub scheduler: Scheduler,
    /// In which order evaluation takes the hit points (D10).
    pub allocation: Allocation,
}

impl Default for Policies {
    fn default() -> Self {
        Self {
            hazard: Hazard::Interlock,
            busy: Busy::Registered,
            input_width: InputWidth::One,
            scheduler: Scheduler::Aftso,
            allocation: Allocation::Leaping,
        }
    }
}

impl Policies {
    /// The configuration register of a job.
    pub(crate) const fn config(&self, mode: Mode, normal_test: bool) -> Config {
        Config::RESET
            .with_mode(mode)
            .with_normal_test(normal_test)
            .with_hazard(self.hazard)
            .with_busy(self.busy)
            .with_input_width(self.input_width)
            .with_scheduler(self.scheduler)
            .with_allocation(self.allocation)
    }
}

/// Adds the flux of photons to hit points, eqs. (6) to (8).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UpdateJob {
    layout: Layout,
    policies: Policies,
    alpha: u32,
    ring_low: u32,
}

impl UpdateJob {
    /// A job with the fraction `alpha` of new photons kept, in (0, 1]. The ring-space interrupt comes when half
    /// of the ring has been taken.
    pub fn new(layout: &Layout, alpha: f32, policies: Policies) -> Result<Self, JobError> {
        let bits = encode(layout.format(), alpha);
        // Bits of positive numbers are in the order of the numbers; negative ones and NaNs are above them.
        let one = encode(layout.format(), 1.0);
        if alpha > 1.0 || !(1..=one).contains(&bits) {
            return Err(JobError::Alpha);
        }
        Ok(Self { layout: *layout, policies, alpha: bits, ring_low: layout.sizes().ring_entries / 2 })
    }

    /// Raises the ring-space interrupt when the records waiting fall to `records`, fewer than the ring holds.
    pub fn with_ring_low(self, records: u32) -> Result<Self, JobError> {
        if records >= self.layout.sizes().ring_entries {
            return Err(JobError::RingLow);
        }
        Ok(Self { ring_low: records, ..self })
    }

    /// Its buffers.
    pub const fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Its policies.
    pub const fn policies(&self) -> &Policies {
        &self.policies
    }

    /// α in the device's format.
    pub(crate) const fn alpha(&self) -> u32 {
        self.alpha
    }

    pub(crate) const fn ring_low(&self) -> u32 {
        self.ring_low
    }
}

/// Adds the radiance of all hit points to their pixels, eq. (9).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EvaluateJob {
    layout: Layout,
    policies: Policies,
    emitted: u32,
}

impl EvaluateJob {
    /// A job after `emitted` photons in all, N_emitted, a positive number.
    pub fn new(layout: &Layout, emitted: f32, policies: Policies) -> Result<Self, JobError> {
        let bits = encode(layout.format(), emitted);
        let infinity = encode(layout.format(), f32::INFINITY);
        if !(1..infinity).contains(&bits) {
            return Err(JobError::Emitted);
        }
        Ok(Self { layout: *layout, policies, emitted: bits })
    }

    /// Its buffers.
    pub const fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Its policies.
    pub const fn policies(&self) -> &Policies {
        &self.policies
    }

    /// N_emitted in the device's format.
    pub(crate) const fn emitted(&self) -> u32 {
        self.emitted
    }
}

/// Why there is no such job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum JobError {
    /// α is not in (0, 1], or is 0 in the device's format.
    Alpha,
    /// N_emitted is not a positive number of the device's format.
    Emitted,
    /// The ring-space threshold is not below the ring's size.
    RingLow,
}

impl fmt::Display for JobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Alpha => "α must be above 0 and at most 1: the usual value is 0.7",
            Self::Emitted => "the photons emitted must be a positive number which the device's format holds",
            Self::RingLow => "the ring-space threshold must be below the ring's size: half of it is usual",
        })
    }
}

impl core::error::Error for JobError {}

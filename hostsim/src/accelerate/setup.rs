//! Which device to build and how to run it; in: command-line choices, out: a value; cost: none.

use std::path::PathBuf;

use lucerna_bus::Timing;
use lucerna_driver::{NumberFormat, Policies};
use lucerna_softfloat::{F24, F32, Format};

use crate::format::{HostF24, HostF32, HostF64};

/// How many PREUs the device has.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Units {
    /// As in the paper's chip.
    #[default]
    Four,
    /// Table II, second row.
    Eight,
    /// Table II, third row.
    Sixteen,
}

impl Units {
    /// The number.
    pub const fn count(self) -> u32 {
        match self {
            Self::Four => 4,
            Self::Eight => 8,
            Self::Sixteen => 16,
        }
    }
}

/// What computes the device's numbers; the bits are the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Arith {
    /// The host's floating-point unit.
    #[default]
    Fast,
    /// The soft-float that also runs on a Cortex-M.
    Soft,
}

impl Arith {
    /// As on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Soft => "soft",
        }
    }
}

/// A device and its job's policies.
#[derive(Clone, Debug)]
pub struct Setup {
    /// PREUs.
    pub units: Units,
    /// Number format of datapath and records.
    pub format: NumberFormat,
    /// What computes it.
    pub arith: Arith,
    /// Cycle by cycle, or fast-forward.
    pub timing: Timing,
    /// Hazards, busy style, input width, scheduler, allocation.
    pub policies: Policies,
    /// D8.
    pub normal_test: bool,
    /// Records of the photon ring, a power of two.
    pub ring_entries: u32,
    /// Where every bus access is written down, if anywhere.
    pub bus_trace: Option<PathBuf>,
}

impl Setup {
    /// The timing as on the command line.
    pub const fn timing_name(&self) -> &'static str {
        match self.timing {
            Timing::Tick => "tick",
            Timing::Fast => "fast",
        }
    }
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            units: Units::default(),
            format: NumberFormat::F32,
            arith: Arith::default(),
            timing: Timing::Fast,
            policies: Policies::default(),
            normal_test: true,
            ring_entries: 1 << 13,
            bus_trace: None,
        }
    }
}

/// Something to do on a device whose format and number of PREUs are types.
pub trait OnDevice {
    /// What it comes to.
    type Output;

    /// Does it on `N` PREUs of format `F`.
    fn on<F: Format, const N: usize>(self) -> Self::Output;
}

/// Does it on the device that the choices name: the one place where they become types.
pub fn on_device<T: OnDevice>(format: NumberFormat, arith: Arith, units: Units, task: T) -> T::Output {
    match (format, arith) {
        (NumberFormat::F32, Arith::Fast) => by_units::<HostF32, T>(units, task),
        (NumberFormat::F32, Arith::Soft) => by_units::<F32, T>(units, task),
        (NumberFormat::F24, Arith::Fast) => by_units::<HostF24, T>(units, task),
        (NumberFormat::F24, Arith::Soft) => by_units::<F24, T>(units, task),
        (NumberFormat::F64, _) => by_units::<HostF64, T>(units, task),
    }
}

fn by_units<F: Format, T: OnDevice>(units: Units, task: T) -> T::Output {
    match units {
        Units::Four => task.on::<F, 4>(),
        Units::Eight => task.on::<F, 8>(),
        Units::Sixteen => task.on::<F, 16>(),
    }
}

//! Which displacement unit to build and how to run it; in: command-line choices, out: a value; cost: none.

use lucerna_bus::Timing;
use lucerna_displace::engine::Sizes;
use lucerna_driver::NumberFormat;
use lucerna_driver::displace::Policies;
use lucerna_softfloat::{F24, F32, Format};

use crate::accelerate::Arith;
use crate::format::{HostF24, HostF32, HostF64};

/// Most instances of the unit.
pub const MOST_UNITS: usize = 4;
/// Lines of a cache of the usual type.
const FEW_LINES: usize = 512;
/// Lines of the largest cache.
pub const MOST_LINES: usize = 8192;

/// A device and its job's policies.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Number format of datapath and records.
    pub format: NumberFormat,
    /// What computes it.
    pub arith: Arith,
    /// Cycle by cycle, or fast-forward.
    pub timing: Timing,
    /// Up and down the pyramid.
    pub policies: Policies,
    /// Most steps of a ray.
    pub watchdog: u32,
    /// Instances, caches, FIFOs, port.
    pub sizes: Sizes,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            format: NumberFormat::F24,
            arith: Arith::default(),
            timing: Timing::Fast,
            policies: Policies::default(),
            watchdog: 4096,
            sizes: Sizes::default(),
        }
    }
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

/// Something to do on a device whose format and capacities are types.
pub trait OnDevice {
    /// What it comes to.
    type Output;

    /// Does it on up to `U` instances of format `F` with caches of up to `L` lines.
    fn on<F: Format, const U: usize, const L: usize>(self) -> Self::Output;
}

/// Does it on the device that the choices name: the one place where they become types.
pub fn on_device<T: OnDevice>(setup: &Setup, task: T) -> T::Output {
    match (setup.format, setup.arith) {
        (NumberFormat::F24, Arith::Fast) => by_lines::<HostF24, T>(&setup.sizes, task),
        (NumberFormat::F24, Arith::Soft) => by_lines::<F24, T>(&setup.sizes, task),
        (NumberFormat::F32, Arith::Fast) => by_lines::<HostF32, T>(&setup.sizes, task),
        (NumberFormat::F32, Arith::Soft) => by_lines::<F32, T>(&setup.sizes, task),
        (NumberFormat::F64, _) => by_lines::<HostF64, T>(&setup.sizes, task),
    }
}

fn by_lines<F: Format, T: OnDevice>(sizes: &Sizes, task: T) -> T::Output {
    let few = |geometry: lucerna_displace::engine::Geometry| {
        geometry.lines().is_ok_and(|lines| lines as usize <= FEW_LINES)
    };
    match (sizes.units, few(sizes.height_cache) && few(sizes.texture_cache)) {
        (1, true) => task.on::<F, 1, FEW_LINES>(),
        (_, true) => task.on::<F, MOST_UNITS, FEW_LINES>(),
        (_, false) => task.on::<F, MOST_UNITS, MOST_LINES>(),
    }
}

//! Any device of the family behind one type; in: units, format, arithmetic, memory, out: a target; cost: one virtual call an access.

use hostsim::format::{HostF24, HostF32, HostF64};
use lucerna_bus::{Target, TargetError};
use lucerna_device::{FullDevice, PreeDevice};
use lucerna_displace::engine::Sizes;
use lucerna_driver::NumberFormat;
use lucerna_softfloat::{F24, F32, Format};

/// Which device.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Kind {
    /// PREUs: 4, 8 or 16.
    pub preus: u32,
    /// Number format.
    pub format: NumberFormat,
    /// Soft-float rather than the host's arithmetic.
    pub soft: bool,
}

/// A device whose type is forgotten.
pub struct Any(Box<dyn Target>);

impl Kind {
    /// All six of one arithmetic.
    pub fn all(soft: bool) -> impl Iterator<Item = Self> {
        [NumberFormat::F32, NumberFormat::F24]
            .into_iter()
            .flat_map(move |format| [4, 8, 16].map(|preus| Self { preus, format, soft }))
    }

    /// Builds it around its memory.
    ///
    /// # Panics
    /// When `preus` is not 4, 8 or 16.
    pub fn build(self, memory: Vec<u32>) -> Any {
        match (self.format, self.soft) {
            (NumberFormat::F32, false) => build::<HostF32>(self.preus, memory),
            (NumberFormat::F32, true) => build::<F32>(self.preus, memory),
            (NumberFormat::F24, false) => build::<HostF24>(self.preus, memory),
            (NumberFormat::F24, true) => build::<F24>(self.preus, memory),
            (NumberFormat::F64, _) => panic!("the study format has no bits to compare"),
        }
    }
}

/// A device with four PREUs and a displacement unit of some sizes.
///
/// # Panics
/// When there is no such unit, or no device of the format.
pub fn full(format: NumberFormat, soft: bool, sizes: Sizes, memory: Vec<u32>) -> Any {
    fn build<F: Format>(sizes: Sizes, memory: Vec<u32>) -> Any {
        Any(Box::new(FullDevice::<F, 4, 4, 512, _>::new(sizes, memory).expect("sizes of a unit")))
    }
    match (format, soft) {
        (NumberFormat::F32, false) => build::<HostF32>(sizes, memory),
        (NumberFormat::F32, true) => build::<F32>(sizes, memory),
        (NumberFormat::F24, false) => build::<HostF24>(sizes, memory),
        (NumberFormat::F24, true) => build::<F24>(sizes, memory),
        (NumberFormat::F64, _) => build::<HostF64>(sizes, memory),
    }
}

fn build<F: Format>(preus: u32, memory: Vec<u32>) -> Any {
    Any(match preus {
        4 => Box::new(PreeDevice::<F, 4, _>::new(memory)),
        8 => Box::new(PreeDevice::<F, 8, _>::new(memory)),
        16 => Box::new(PreeDevice::<F, 16, _>::new(memory)),
        other => panic!("no device has {other} PREUs"),
    })
}

impl std::fmt::Debug for Any {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a device")
    }
}

impl Target for Any {
    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        self.0.read(offset)
    }
    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        self.0.write(offset, value)
    }
    fn load(&self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
        self.0.load(address, words)
    }
    fn store(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
        self.0.store(address, words)
    }
    fn tick(&mut self) {
        self.0.tick();
    }
    fn advance(&mut self, cycles: u64) {
        self.0.advance(cycles);
    }
    fn interrupt(&self) -> bool {
        self.0.interrupt()
    }
}

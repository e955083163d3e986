//! Jobs; in: what the registers say, out: only what the engine can do, or the fault to report; cost: a few compares at start.

use lucerna_fabric::window::{Buffer, BufferError, Windows};

use crate::allocation::Allocation;
use crate::hazard::Hazard;
use crate::record::{HIT_WORDS, INDEX_WORDS, PHOTON_WORDS, PHOTON_WORDS_WITH_NORMAL, PIXEL_WORDS};
use crate::schedule::Scheduler;

/// Why a job was refused or stopped; the codes of register `ERROR`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FaultCode {
    /// A field of `CONFIG` holds no legal value.
    BadConfig,
    /// The ring's entries are not a power of two in 1..=65536.
    BadRing,
    /// A buffer is misaligned or not wholly inside one window.
    Window,
    /// The tail is more than the ring's entries ahead of the head.
    RingOverrun,
    /// A photon's list leaves the index table.
    IndexRange,
    /// An index entry names no hit point.
    HitRange,
    /// A hit point names no pixel.
    PixelRange,
    /// Start while a job runs (which goes on).
    NotIdle,
    /// A buffer's size in bytes does not fit 32 bits.
    TooLarge,
}

/// A fault and the byte address it is about (0 where there is none).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Fault {
    /// What is wrong.
    pub code: FaultCode,
    /// Where.
    pub address: u32,
}

/// When the controller says that it takes no photon (D4).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Busy {
    /// While the buffer was full at the cycle's start: one bubble whenever a full buffer empties.
    #[default]
    Registered,
    /// While it is full after this cycle's dispatch and shift.
    Combinational,
}

/// Photons accepted in one cycle (D5).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[repr(u8)]
pub enum InputWidth {
    /// The port of Fig. 8: 6 + 1 + 1 words.
    #[default]
    One = 1,
    /// Twice as wide.
    Two = 2,
    /// As wide as the buffer.
    Four = 4,
}

/// The policies of an update.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Rules {
    /// D7.
    pub hazard: Hazard,
    /// D4.
    pub busy: Busy,
    /// D5.
    pub input_width: InputWidth,
    /// AFTSO or the baseline.
    pub scheduler: Scheduler,
    /// D8.
    pub normal_test: bool,
}

/// The largest photon ring.
pub const MAX_RING_ENTRIES: u32 = 1 << 16;

/// A buffer's base address and number of records, as registers have them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Table {
    /// Byte address.
    pub base: u32,
    /// Records.
    pub count: u32,
}

impl Table {
    fn checked<const W: usize>(self, windows: &Windows<W>, stride: u32) -> Result<Buffer, Fault> {
        windows.buffer(self.base, self.count, stride).map_err(|error| Fault {
            code: match error {
                BufferError::Outside => FaultCode::Window,
                BufferError::TooLarge => FaultCode::TooLarge,
            },
            address: self.base,
        })
    }
}

/// An update of hit points by a stream of photons.
#[derive(Clone, Copy, Debug)]
pub struct UpdateJob<F> {
    pub(crate) hits: Buffer,
    pub(crate) index: Buffer,
    pub(crate) ring: Buffer,
    pub(crate) alpha: F,
    pub(crate) rules: Rules,
}

impl<F> UpdateJob<F> {
    /// # Errors
    /// [`FaultCode::BadRing`], [`FaultCode::Window`], [`FaultCode::TooLarge`].
    pub fn new<const W: usize>(
        windows: &Windows<W>,
        hits: Table,
        index: Table,
        ring: Table,
        alpha: F,
        rules: Rules,
    ) -> Result<Self, Fault> {
        if !ring.count.is_power_of_two() || ring.count > MAX_RING_ENTRIES {
            return Err(Fault { code: FaultCode::BadRing, address: 0 });
        }
        let photon_words = if rules.normal_test { PHOTON_WORDS_WITH_NORMAL } else { PHOTON_WORDS };
        Ok(Self {
            hits: hits.checked(windows, HIT_WORDS)?,
            index: index.checked(windows, INDEX_WORDS)?,
            ring: ring.checked(windows, photon_words)?,
            alpha,
            rules,
        })
    }
}

/// An evaluation of all hit points into their pixels.
#[derive(Clone, Copy, Debug)]
pub struct EvaluateJob<F> {
    pub(crate) hits: Buffer,
    pub(crate) pixels: Buffer,
    pub(crate) emitted: F,
    pub(crate) hazard: Hazard,
    pub(crate) allocation: Allocation,
}

impl<F> EvaluateJob<F> {
    /// # Errors
    /// [`FaultCode::Window`], [`FaultCode::TooLarge`].
    pub fn new<const W: usize>(
        windows: &Windows<W>,
        hits: Table,
        pixels: Table,
        emitted: F,
        hazard: Hazard,
        allocation: Allocation,
    ) -> Result<Self, Fault> {
        Ok(Self {
            hits: hits.checked(windows, HIT_WORDS)?,
            pixels: pixels.checked(windows, PIXEL_WORDS)?,
            emitted,
            hazard,
            allocation,
        })
    }
}

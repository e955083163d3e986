//! Block `pree` at 0x100: Progressive radiance estimation engine (PREE). Generated from rdl/pree.rdl by
//! `regenerate`; do not edit.
//!
//! Job registers. Configuration, buffers and windows are latched at START; only RING_TAIL and RING_LOW are
//! looked at while a job runs.

use crate::register::{Field, Illegal, Register};

/// Byte offset of CONTROL: Job control. Write-only pulses; reads as 0. With several at once, ABORT comes
/// first, then START, then FLUSH.
///
/// Fields: [`Control`].
pub const CONTROL: u32 = 0x100;
/// Byte offset of CONFIG: Job configuration. Mode and policies. The reset value is the paper's unit,
/// protected against hazards.
///
/// Fields: [`Config`].
pub const CONFIG: u32 = 0x104;
/// Byte offset of STATUS: Job status. Where the job is.
///
/// Fields: [`Status`].
pub const STATUS: u32 = 0x108;
/// Byte offset of ERROR: Error. The first error since START or ABORT; NOT_IDLE, which ends no job, gives way
/// to one that does.
///
/// Fields: [`Error`].
pub const ERROR: u32 = 0x10C;
/// Byte offset of FAULT_ADDRESS: Faulting address. The byte address which ERROR is about, where its
/// description names one; otherwise 0.
///
/// Plain number, read-only; reset 0x0.
pub const FAULT_ADDRESS: u32 = 0x110;
/// Byte offset of ALPHA: Radius reduction α. The fraction of new photons kept, eq. (7), between 0 and 1;
/// usually 0.7.
///
/// Plain number, read-write; reset 0x0.
pub const ALPHA: u32 = 0x114;
/// Byte offset of EMITTED: Photons emitted. N_emitted of eq. (9), all photons shot at the scene, as a number
/// and not as an integer. Used in evaluation.
///
/// Plain number, read-write; reset 0x0.
pub const EMITTED: u32 = 0x118;
/// Byte offset of HIT_BASE: Hit-point base. Where the hit-point records are. A record is 16 words: position
/// 3, normal 3, colour 3, flux 3, radius squared, accumulated photon count N + αM (D14), pixel number, one
/// reserved.
///
/// Plain number, read-write; reset 0x0.
pub const HIT_BASE: u32 = 0x11C;
/// Byte offset of HIT_COUNT: Hit-point count. How many hit-point records there are.
///
/// Plain number, read-write; reset 0x0.
pub const HIT_COUNT: u32 = 0x120;
/// Byte offset of INDEX_BASE: Index table base. Where the index table is: one word an entry, a hit-point
/// number. The list of a photon is n entries from p_addr.
///
/// Plain number, read-write; reset 0x0.
pub const INDEX_BASE: u32 = 0x124;
/// Byte offset of INDEX_COUNT: Index table count. How many entries the index table has.
///
/// Plain number, read-write; reset 0x0.
pub const INDEX_COUNT: u32 = 0x128;
/// Byte offset of PIXEL_BASE: Pixel base. Where the pixels are: 3 words each, red, green, blue. Evaluation
/// adds to them; the host zeroes them first.
///
/// Plain number, read-write; reset 0x0.
pub const PIXEL_BASE: u32 = 0x12C;
/// Byte offset of PIXEL_COUNT: Pixel count. How many pixels there are.
///
/// Plain number, read-write; reset 0x0.
pub const PIXEL_COUNT: u32 = 0x130;
/// Byte offset of RING_BASE: Photon ring base. Where the photon ring is. A record is 8 words: position 3,
/// flux 3, p_addr, n; with the normal test 12 words: normal 3 and one reserved follow.
///
/// Plain number, read-write; reset 0x0.
pub const RING_BASE: u32 = 0x134;
/// Byte offset of RING_ENTRIES: Photon ring entries. Records the ring has room for: a power of two from 1 to
/// 65536, otherwise an update job ends in error BAD_RING.
///
/// Plain number, read-write; reset 0x0.
pub const RING_ENTRIES: u32 = 0x138;
/// Byte offset of RING_HEAD: Photon ring head. Photons taken from the ring since START, modulo 2^32. The slot
/// of photon i is i modulo RING_ENTRIES.
///
/// Plain number, read-only; reset 0x0.
pub const RING_HEAD: u32 = 0x13C;
/// Byte offset of RING_TAIL: Photon ring tail. Photons put in the ring since START, modulo 2^32; START sets
/// it to 0. Writing it is the doorbell: records before it must be complete in memory. More than RING_ENTRIES
/// ahead of RING_HEAD, or a change after FLUSH, is error RING_OVERRUN. Without a running update job it is
/// stored and has no effect.
///
/// Plain number, read-write; reset 0x0.
pub const RING_TAIL: u32 = 0x140;
/// Byte offset of RING_LOW: Photon ring low mark. The RING_SPACE interrupt is raised when the records
/// waiting, tail minus head, fall to this count or below while running.
///
/// Plain number, read-write; reset 0x0.
pub const RING_LOW: u32 = 0x144;

/// Mode: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Mode {
    /// Hit-point update operations, photons taken from the ring (AFTSO-HpUOC, PREE §IV.B).
    Update = 0,
    /// Radiance evaluation of all hit points into pixels (ADISO-REC, PREE §IV.C).
    Evaluate = 1,
}

impl Mode {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 2] = [Self::Update, Self::Evaluate];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Update),
            1 => Ok(Self::Evaluate),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Update => "update",
            Self::Evaluate => "evaluate",
        }
    }
}

impl TryFrom<u32> for Mode {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Hazard policy: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Hazard {
    /// An operation waits until the one before it has been written back: every bit as if in order.
    Interlock = 0,
    /// An operation waits until the result in flight can be bypassed into the stage that needs it (6 cycles
    /// in an update, 2 in an evaluation): every bit as if in order.
    Forward = 1,
    /// No protection, as the paper has none: stale reads happen and are counted.
    Published = 2,
}

impl Hazard {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 3] = [Self::Interlock, Self::Forward, Self::Published];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Interlock),
            1 => Ok(Self::Forward),
            2 => Ok(Self::Published),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Interlock => "interlock",
            Self::Forward => "forward",
            Self::Published => "published",
        }
    }
}

impl TryFrom<u32> for Hazard {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Busy style: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Busy {
    /// A photon is accepted if the buffer was not full at the start of the cycle.
    Registered = 0,
    /// A photon is accepted into whatever room the shift of this cycle left.
    Combinational = 1,
}

impl Busy {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 2] = [Self::Registered, Self::Combinational];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Registered),
            1 => Ok(Self::Combinational),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Registered => "registered",
            Self::Combinational => "combinational",
        }
    }
}

impl TryFrom<u32> for Busy {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Input width: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum InputWidth {
    /// One photon a cycle, as in Fig. 8.
    One = 1,
    /// Two photons a cycle.
    Two = 2,
    /// Four photons a cycle: the whole buffer.
    Four = 4,
}

impl InputWidth {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 3] = [Self::One, Self::Two, Self::Four];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            1 => Ok(Self::One),
            2 => Ok(Self::Two),
            4 => Ok(Self::Four),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::One => "one",
            Self::Two => "two",
            Self::Four => "four",
        }
    }
}

impl TryFrom<u32> for InputWidth {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Scheduler of updates: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Scheduler {
    /// Up to four photons share a dispatch (PREE §IV.B).
    Aftso = 0,
    /// One photon a dispatch: the baseline of Table II without AFTSO.
    OnePhoton = 1,
}

impl Scheduler {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 2] = [Self::Aftso, Self::OnePhoton];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Aftso),
            1 => Ok(Self::OnePhoton),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Aftso => "aftso",
            Self::OnePhoton => "one photon",
        }
    }
}

impl TryFrom<u32> for Scheduler {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Allocation of evaluations: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Allocation {
    /// Leaping addresses, which keep hit points of a pixel apart (PREE §IV.C).
    Leaping = 0,
    /// Each unit walks its group address by address (Fig. 3): the baseline of Fig. 4.
    Sequential = 1,
}

impl Allocation {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 2] = [Self::Leaping, Self::Sequential];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Leaping),
            1 => Ok(Self::Sequential),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Leaping => "leaping",
            Self::Sequential => "sequential",
        }
    }
}

impl TryFrom<u32> for Allocation {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// State: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum State {
    /// No job; START is taken.
    Idle = 0,
    /// A job is being worked on.
    Running = 1,
    /// A job ended in the error of ERROR; START or ABORT leaves this state.
    Fault = 2,
}

impl State {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 3] = [Self::Idle, Self::Running, Self::Fault];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::Idle),
            1 => Ok(Self::Running),
            2 => Ok(Self::Fault),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Idle => "idle",
            Self::Running => "running",
            Self::Fault => "fault",
        }
    }
}

impl TryFrom<u32> for State {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Error code: the encoding of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum ErrorCode {
    /// No error since START.
    None = 0,
    /// CONFIG holds an illegal hazard policy or input width.
    BadConfig = 1,
    /// RING_ENTRIES is not a power of two from 1 to 65536.
    BadRing = 2,
    /// A buffer is misaligned or not wholly in one window; FAULT_ADDRESS is its base.
    Window = 3,
    /// RING_TAIL ran more than RING_ENTRIES ahead of RING_HEAD, or moved on after FLUSH; FAULT_ADDRESS is the
    /// base of the ring.
    RingOverrun = 4,
    /// The list of a photon leaves the index table; FAULT_ADDRESS is the record.
    IndexRange = 5,
    /// An index entry is not below HIT_COUNT; FAULT_ADDRESS is the entry.
    HitRange = 6,
    /// The pixel of a hit point is not below PIXEL_COUNT; FAULT_ADDRESS is the hit point.
    PixelRange = 7,
    /// START while running; the running job goes on.
    NotIdle = 8,
    /// The byte size or the end of a buffer does not fit 32 bits; FAULT_ADDRESS is its base.
    TooLarge = 9,
}

impl ErrorCode {
    /// Every legal value, in the order of its bits.
    pub const ALL: [Self; 10] = [
        Self::None,
        Self::BadConfig,
        Self::BadRing,
        Self::Window,
        Self::RingOverrun,
        Self::IndexRange,
        Self::HitRange,
        Self::PixelRange,
        Self::NotIdle,
        Self::TooLarge,
    ];

    /// Decodes a field's value.
    ///
    /// # Errors
    /// The value is none of the above.
    pub const fn from_bits(bits: u32) -> Result<Self, Illegal> {
        match bits {
            0 => Ok(Self::None),
            1 => Ok(Self::BadConfig),
            2 => Ok(Self::BadRing),
            3 => Ok(Self::Window),
            4 => Ok(Self::RingOverrun),
            5 => Ok(Self::IndexRange),
            6 => Ok(Self::HitRange),
            7 => Ok(Self::PixelRange),
            8 => Ok(Self::NotIdle),
            9 => Ok(Self::TooLarge),
            _ => Err(Illegal { bits }),
        }
    }

    /// The field's value.
    pub const fn bits(self) -> u32 {
        self as u32
    }

    /// Its name in words, for reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::BadConfig => "bad config",
            Self::BadRing => "bad ring",
            Self::Window => "window",
            Self::RingOverrun => "ring overrun",
            Self::IndexRange => "index range",
            Self::HitRange => "hit range",
            Self::PixelRange => "pixel range",
            Self::NotIdle => "not idle",
            Self::TooLarge => "too large",
        }
    }
}

impl TryFrom<u32> for ErrorCode {
    type Error = Illegal;

    fn try_from(bits: u32) -> Result<Self, Illegal> {
        Self::from_bits(bits)
    }
}

/// Job control (CONTROL). Write-only pulses; reads as 0. With several at once, ABORT comes first, then START,
/// then FLUSH.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Control(u32);

impl Control {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::START, Self::FLUSH, Self::ABORT];
    /// Place of START.
    pub const START: Field = Field { name: "START", shift: 0, width: 1 };
    /// Place of FLUSH.
    pub const FLUSH: Field = Field { name: "FLUSH", shift: 1, width: 1 };
    /// Place of ABORT.
    pub const ABORT: Field = Field { name: "ABORT", shift: 2, width: 1 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::START.mask() | Self::FLUSH.mask() | Self::ABORT.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Start, write-only pulse. Latches the configuration, clears ERROR and FAULT_ADDRESS, sets RING_HEAD and
    /// RING_TAIL to 0, checks every buffer, and runs; the interrupt status is left alone. While RUNNING,
    /// refused with error NOT_IDLE.
    pub const fn start(self) -> bool {
        Self::START.get(self.0) != 0
    }

    /// The word with START replaced.
    #[must_use]
    pub const fn with_start(self, value: bool) -> Self {
        Self(Self::START.put(self.0, value as u32))
    }

    /// Flush, write-only pulse. Ends an update job: no more photons come, the buffer is drained (D2), and
    /// DONE follows when all is written back. Ignored unless an update job is running.
    pub const fn flush(self) -> bool {
        Self::FLUSH.get(self.0) != 0
    }

    /// The word with FLUSH replaced.
    #[must_use]
    pub const fn with_flush(self, value: bool) -> Self {
        Self(Self::FLUSH.put(self.0, value as u32))
    }

    /// Abort, write-only pulse. To IDLE at once; results in flight are dropped, ERROR and FAULT_ADDRESS are
    /// cleared, the interrupt status is not.
    pub const fn abort(self) -> bool {
        Self::ABORT.get(self.0) != 0
    }

    /// The word with ABORT replaced.
    #[must_use]
    pub const fn with_abort(self, value: bool) -> Self {
        Self(Self::ABORT.put(self.0, value as u32))
    }
}

impl Default for Control {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Control {
    const NAME: &'static str = "pree.CONTROL";
    const OFFSET: u32 = CONTROL;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0x0;
    const WRITABLE: u32 = 0x7;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Control {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Control")
            .field("start", &self.start())
            .field("flush", &self.flush())
            .field("abort", &self.abort())
            .finish()
    }
}

/// Job configuration (CONFIG). Mode and policies. The reset value is the paper's unit, protected against
/// hazards.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Config(u32);

impl Config {
    /// Value after reset.
    pub const RESET: Self = Self(0x20);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[
        Self::MODE,
        Self::NORMAL_TEST,
        Self::HAZARD,
        Self::BUSY,
        Self::INPUT_WIDTH,
        Self::SCHEDULER,
        Self::ALLOCATION,
    ];
    /// Place of MODE.
    pub const MODE: Field = Field { name: "MODE", shift: 0, width: 1 };
    /// Place of NORMAL_TEST.
    pub const NORMAL_TEST: Field = Field { name: "NORMAL_TEST", shift: 1, width: 1 };
    /// Place of HAZARD.
    pub const HAZARD: Field = Field { name: "HAZARD", shift: 2, width: 2 };
    /// Place of BUSY.
    pub const BUSY: Field = Field { name: "BUSY", shift: 4, width: 1 };
    /// Place of INPUT_WIDTH.
    pub const INPUT_WIDTH: Field = Field { name: "INPUT_WIDTH", shift: 5, width: 3 };
    /// Place of SCHEDULER.
    pub const SCHEDULER: Field = Field { name: "SCHEDULER", shift: 8, width: 1 };
    /// Place of ALLOCATION.
    pub const ALLOCATION: Field = Field { name: "ALLOCATION", shift: 9, width: 1 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::MODE.mask()
        | Self::NORMAL_TEST.mask()
        | Self::HAZARD.mask()
        | Self::BUSY.mask()
        | Self::INPUT_WIDTH.mask()
        | Self::SCHEDULER.mask()
        | Self::ALLOCATION.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Mode, read-write. Which of its two jobs the engine does.
    pub const fn mode(self) -> Mode {
        match Self::MODE.get(self.0) {
            0 => Mode::Update,
            _ => Mode::Evaluate,
        }
    }

    /// The word with MODE replaced.
    #[must_use]
    pub const fn with_mode(self, value: Mode) -> Self {
        Self(Self::MODE.put(self.0, value.bits()))
    }

    /// Normal test, read-write. Photon records are 12 words with a normal, and a photon counts only if its
    /// normal agrees with the hit point's (D8). Without it, records are 8 words.
    pub const fn normal_test(self) -> bool {
        Self::NORMAL_TEST.get(self.0) != 0
    }

    /// The word with NORMAL_TEST replaced.
    #[must_use]
    pub const fn with_normal_test(self, value: bool) -> Self {
        Self(Self::NORMAL_TEST.put(self.0, value as u32))
    }

    /// Hazard policy, read-write. What happens to a hit point (D7) or pixel (D12) used again while in flight.
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn hazard(self) -> Result<Hazard, Illegal> {
        Hazard::from_bits(Self::HAZARD.get(self.0))
    }

    /// The word with HAZARD replaced.
    #[must_use]
    pub const fn with_hazard(self, value: Hazard) -> Self {
        Self(Self::HAZARD.put(self.0, value.bits()))
    }

    /// Busy style, read-write. When a full buffer takes the next photon (D4).
    pub const fn busy(self) -> Busy {
        match Self::BUSY.get(self.0) {
            0 => Busy::Registered,
            _ => Busy::Combinational,
        }
    }

    /// The word with BUSY replaced.
    #[must_use]
    pub const fn with_busy(self, value: Busy) -> Self {
        Self(Self::BUSY.put(self.0, value.bits()))
    }

    /// Input width, read-write. Photons taken from the ring a cycle: 1, 2 or 4 (D5).
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn input_width(self) -> Result<InputWidth, Illegal> {
        InputWidth::from_bits(Self::INPUT_WIDTH.get(self.0))
    }

    /// The word with INPUT_WIDTH replaced.
    #[must_use]
    pub const fn with_input_width(self, value: InputWidth) -> Self {
        Self(Self::INPUT_WIDTH.put(self.0, value.bits()))
    }

    /// Scheduler of updates, read-write. How photons of the buffer share a dispatch.
    pub const fn scheduler(self) -> Scheduler {
        match Self::SCHEDULER.get(self.0) {
            0 => Scheduler::Aftso,
            _ => Scheduler::OnePhoton,
        }
    }

    /// The word with SCHEDULER replaced.
    #[must_use]
    pub const fn with_scheduler(self, value: Scheduler) -> Self {
        Self(Self::SCHEDULER.put(self.0, value.bits()))
    }

    /// Allocation of evaluations, read-write. In which order evaluation takes the hit points.
    pub const fn allocation(self) -> Allocation {
        match Self::ALLOCATION.get(self.0) {
            0 => Allocation::Leaping,
            _ => Allocation::Sequential,
        }
    }

    /// The word with ALLOCATION replaced.
    #[must_use]
    pub const fn with_allocation(self, value: Allocation) -> Self {
        Self(Self::ALLOCATION.put(self.0, value.bits()))
    }
}

impl Default for Config {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Config {
    const NAME: &'static str = "pree.CONFIG";
    const OFFSET: u32 = CONFIG;
    const RESET: u32 = 0x20;
    const READABLE: u32 = 0x3FF;
    const WRITABLE: u32 = 0x3FF;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Config {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Config")
            .field("mode", &self.mode())
            .field("normal_test", &self.normal_test())
            .field("hazard", &self.hazard())
            .field("busy", &self.busy())
            .field("input_width", &self.input_width())
            .field("scheduler", &self.scheduler())
            .field("allocation", &self.allocation())
            .finish()
    }
}

/// Job status (STATUS). Where the job is.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Status(u32);

impl Status {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::STATE, Self::STARVED, Self::FLUSHING];
    /// Place of STATE.
    pub const STATE: Field = Field { name: "STATE", shift: 0, width: 2 };
    /// Place of STARVED.
    pub const STARVED: Field = Field { name: "STARVED", shift: 2, width: 1 };
    /// Place of FLUSHING.
    pub const FLUSHING: Field = Field { name: "FLUSHING", shift: 3, width: 1 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::STATE.mask() | Self::STARVED.mask() | Self::FLUSHING.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// State, read-only. State of the engine.
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn state(self) -> Result<State, Illegal> {
        State::from_bits(Self::STATE.get(self.0))
    }

    /// The word with STATE replaced.
    #[must_use]
    pub const fn with_state(self, value: State) -> Self {
        Self(Self::STATE.put(self.0, value.bits()))
    }

    /// Starved, read-only. The clock of the engine is gated: an update job would load photons that are not
    /// there, and FLUSH has not come.
    pub const fn starved(self) -> bool {
        Self::STARVED.get(self.0) != 0
    }

    /// The word with STARVED replaced.
    #[must_use]
    pub const fn with_starved(self, value: bool) -> Self {
        Self(Self::STARVED.put(self.0, value as u32))
    }

    /// Flushing, read-only. FLUSH has been taken; the buffer and datapath are draining.
    pub const fn flushing(self) -> bool {
        Self::FLUSHING.get(self.0) != 0
    }

    /// The word with FLUSHING replaced.
    #[must_use]
    pub const fn with_flushing(self, value: bool) -> Self {
        Self(Self::FLUSHING.put(self.0, value as u32))
    }
}

impl Default for Status {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Status {
    const NAME: &'static str = "pree.STATUS";
    const OFFSET: u32 = STATUS;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Status {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Status")
            .field("state", &self.state())
            .field("starved", &self.starved())
            .field("flushing", &self.flushing())
            .finish()
    }
}

/// Error (ERROR). The first error since START or ABORT; NOT_IDLE, which ends no job, gives way to one that
/// does.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Error(u32);

impl Error {
    /// Value after reset.
    pub const RESET: Self = Self(0x0);
    /// All fields, from the lowest bit up.
    pub const FIELDS: &'static [Field] = &[Self::CODE];
    /// Place of CODE.
    pub const CODE: Field = Field { name: "CODE", shift: 0, width: 8 };

    /// The bits that belong to a field: a write to the others is ignored.
    pub const MASK: u32 = Self::CODE.mask();

    /// Takes a word as it is.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The word.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Error code, read-only. What went wrong.
    ///
    /// # Errors
    /// The field's bits are no legal value.
    pub const fn code(self) -> Result<ErrorCode, Illegal> {
        ErrorCode::from_bits(Self::CODE.get(self.0))
    }

    /// The word with CODE replaced.
    #[must_use]
    pub const fn with_code(self, value: ErrorCode) -> Self {
        Self(Self::CODE.put(self.0, value.bits()))
    }
}

impl Default for Error {
    fn default() -> Self {
        Self::RESET
    }
}

impl Register for Error {
    const NAME: &'static str = "pree.ERROR";
    const OFFSET: u32 = ERROR;
    const RESET: u32 = 0x0;
    const READABLE: u32 = 0xFF;
    const WRITABLE: u32 = 0x0;

    fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    fn bits(self) -> u32 {
        self.0
    }
}

impl core::fmt::Debug for Error {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Error").field("code", &self.code()).finish()
    }
}

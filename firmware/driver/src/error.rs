//! What can go wrong in a driver call. In: what bus and device said. Out: a cause, and the state the device is
//! in. Cost: `Copy`, a few words; the sentences are only in flash if they are printed.

use core::fmt;

use lucerna_regs::displace;
use lucerna_regs::pree::ErrorCode;

/// Why a call failed, and what the device is doing now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Error<E> {
    /// What happened.
    pub cause: Cause<E>,
    /// Where that leaves the device.
    pub state: State,
}

/// What the driver knows of the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum State {
    /// Idle, and the failed call has written no register: correct the call and make it again.
    Untouched,
    /// Idle: no job, or the last one is complete.
    Idle,
    /// The job runs on: poll or wait again, or recover.
    Running,
    /// The device ended the job with an error: recover.
    Faulted,
    /// A register write may or may not have reached the device: recover.
    Unknown,
}

/// What happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cause<E> {
    /// An access failed on the bus.
    Bus(E),
    /// The identification register does not say Lucerna.
    WrongDevice {
        /// What it says.
        id: u32,
    },
    /// The register map is not one this driver was written for.
    WrongVersion {
        /// The device's major version.
        major: u32,
        /// The device's minor version.
        minor: u32,
    },
    /// A register holds what no Lucerna writes.
    Nonsense {
        /// The register's byte offset.
        offset: u32,
        /// What it holds.
        bits: u32,
    },
    /// The device was built without the unit.
    NoUnit,
    /// The last job was left running, or ended in an error.
    NotReady,
    /// There is no job to resume: the last one was seen to its end, or none was started.
    NoJob,
    /// The layout was made for a device of another number format or with more memory.
    ForeignLayout,
    /// `first` and the slice's length lead past the end of the call's buffer: hit points, index table, pixels, rays or
    /// results, as its name says, with the count the layout's [`Sizes`](crate::Sizes) (or
    /// [`displace::Sizes`](crate::displace::Sizes)) give it. Nothing was read or written.
    OutsideBuffer,
    /// An image has another width or height than the layout's map of its kind. Nothing was written.
    WrongShape,
    /// An element refers to a hit point or pixel which the layout does not have: a hit point's `pixel` is not below
    /// [`Sizes::pixels`](crate::Sizes::pixels), or an index entry not below
    /// [`Sizes::hit_points`](crate::Sizes::hit_points). Nothing was written.
    BadReference {
        /// The element's place in the slice, from 0; its number in the buffer is the call's `first` more.
        position: usize,
    },
    /// The progressive radiance estimation engine found an error in the job.
    Device(DeviceError),
    /// The displacement unit found an error in the job.
    Displace(DisplaceError),
    /// The deadline passed first.
    Timeout,
    /// The job is complete, but its interrupt never came.
    LostInterrupt,
    /// The interrupt pin failed.
    Pin,
    /// The ring's two counts contradict each other: somebody else writes the ring, or the device was reset.
    RingOverrun {
        /// Records the device says it has taken.
        head: u32,
        /// Records the driver has announced.
        tail: u32,
    },
    /// The device does not stop on ABORT.
    Stuck,
}

/// An error the progressive radiance estimation engine found: the code, and the address it is about (0 where there is none).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DeviceError {
    /// The error code.
    pub code: ErrorCode,
    /// The byte address in device memory.
    pub address: u32,
}

/// An error the displacement unit found: the code, and the address it is about (0 where there is none).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DisplaceError {
    /// The error code.
    pub code: displace::ErrorCode,
    /// The byte address in device memory.
    pub address: u32,
}

impl<E> Error<E> {
    /// A call refused before it wrote anything, the device being idle.
    pub(crate) const fn untouched(cause: Cause<E>) -> Self {
        Self { cause, state: State::Untouched }
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Untouched => "device untouched",
            Self::Idle => "device idle",
            Self::Running => "device running",
            Self::Faulted => "device faulted",
            Self::Unknown => "device state unknown",
        })
    }
}

impl fmt::Display for DeviceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at = self.address;
        match self.code {
            ErrorCode::None => {
                f.write_str("the device reports an error without a code: recover and try again")
            }
            ErrorCode::BadConfig => {
                f.write_str("CONFIG holds an illegal policy or width: make the job with this driver's types")
            }
            ErrorCode::BadRing => {
                f.write_str("the ring's size is not a power of two from 1 to 65536: choose one that is")
            }
            ErrorCode::Window => {
                write!(f, "the buffer at {at:#x} is misaligned or in no window: lay it out again")
            }
            ErrorCode::RingOverrun => {
                f.write_str("more records were announced than the ring holds: let only one stream push")
            }
            ErrorCode::IndexRange => {
                write!(f, "the photon at {at:#x} has a list which leaves the index table: check p_addr and n")
            }
            ErrorCode::HitRange => {
                write!(f, "the index entry at {at:#x} names no hit point: write the table again")
            }
            ErrorCode::PixelRange => {
                write!(f, "the hit point at {at:#x} names no pixel: write the hit points again")
            }
            ErrorCode::NotIdle => {
                f.write_str("a second START came while the job ran: let only one driver use the device")
            }
            ErrorCode::TooLarge => f.write_str("a buffer's bytes do not fit 32 bits: split the job"),
        }
    }
}

impl fmt::Display for DisplaceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use displace::ErrorCode;
        let at = self.address;
        match self.code {
            ErrorCode::None => {
                f.write_str("the displacement unit reports an error without a code: recover and try again")
            }
            ErrorCode::BadConfig => f.write_str(
                "the displacement unit's CONFIG or WATCHDOG is illegal: make the job with this driver's types",
            ),
            ErrorCode::Window => {
                write!(f, "the map, rays or results at {at:#x} are misaligned or in no window: lay them out again")
            }
            ErrorCode::TooLarge => {
                write!(f, "the bytes of the map, rays or results at {at:#x} do not fit 32 bits: split the job")
            }
            ErrorCode::BadMap => {
                write!(f, "the map at {at:#x} is larger than 4096 texels along an axis: make it smaller")
            }
            ErrorCode::BadRaster => f.write_str("the raster has no pixel, or too many: choose another size"),
            ErrorCode::GrazingRay => write!(
                f,
                "the ray of the result at {at:#x} does not come down on the surface: leave it out, or record such rays"
            ),
            ErrorCode::Watchdog => write!(
                f,
                "the ray of the result at {at:#x} took as many steps as the watchdog allows: allow more, or record                  such rays"
            ),
            ErrorCode::Overlap => {
                write!(f, "the results at {at:#x} would overwrite what the job reads: move them apart")
            }
            ErrorCode::NotIdle => {
                f.write_str("a second START of the displacement unit came while the job ran: let only one driver use it")
            }
        }
    }
}

impl<E: fmt::Debug> fmt::Display for Error<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.cause {
            Cause::Bus(ref error) => {
                write!(f, "the bus failed ({error:?}): check it, recover, and try again")?
            }
            Cause::WrongDevice { id } => {
                write!(f, "the device says {id:#010x}, not Lucerna: check address and power")?;
            }
            Cause::WrongVersion { major, minor } => {
                write!(f, "the register map is {major}.{minor}: use the driver made for it")?;
            }
            Cause::Nonsense { offset, bits } => {
                write!(f, "register {offset:#05x} holds {bits:#010x}, which means nothing: check the bus")?;
            }
            Cause::NoUnit => f.write_str("the device was built without this unit: use another")?,
            Cause::NotReady => f.write_str("the last job is not complete: wait for it, or recover")?,
            Cause::NoJob => f.write_str("there is no job to resume: start one")?,
            Cause::WrongShape => f.write_str(
                "the image is not as wide and high as the layout's map of its kind: scale it, or lay out another size",
            )?,
            Cause::ForeignLayout => {
                f.write_str("the layout is for another device: make it from this one's capabilities")?
            }
            Cause::OutsideBuffer => f.write_str(
                "`first` plus the slice's length is above this buffer's count in Sizes (hit_points, index_entries, \
                 pixels, rays or results): pass fewer, or lay out more",
            )?,
            Cause::BadReference { position } => write!(
                f,
                "element {position} of the slice, from 0, leads nowhere: a hit point's pixel must be below \
                 Sizes::pixels, an index entry below Sizes::hit_points"
            )?,
            Cause::Device(error) => error.fmt(f)?,
            Cause::Displace(error) => error.fmt(f)?,
            Cause::Timeout => f.write_str("the deadline passed: wait on, or recover")?,
            Cause::LostInterrupt => {
                f.write_str("the job is complete, but its interrupt never came: check the pin")?
            }
            Cause::Pin => f.write_str("the interrupt pin failed: check it, or wait by polling")?,
            Cause::RingOverrun { head, tail } => {
                write!(f, "the device took {head} records of {tail} announced, which cannot be: recover")?;
            }
            Cause::Stuck => f.write_str("the device does not stop: reset it")?,
        }
        write!(f, " ({})", self.state)
    }
}

impl<E: fmt::Debug> core::error::Error for Error<E> {}

impl core::error::Error for DeviceError {}

impl core::error::Error for DisplaceError {}

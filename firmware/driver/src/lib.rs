//! The driver: typed jobs over any bus. In: host numbers. Out: pixels and counters, or an error which says what
//! state the device is in. Cost: a block write and a doorbell per 32 photons; no allocation; every wait bounded.
//!
//! 1. [`Lucerna::probe`] reads what the device is: [`Capabilities`].
//! 2. A [`Layout`] places the buffers of a job in device memory; an [`UpdateJob`] or [`EvaluateJob`] says what to
//!    do with them. Their constructors are checked: an illegal job cannot be expressed.
//! 3. [`Pree`] writes the buffers and starts jobs: [`Pree::update`] gives a [`Stream`] to push photons into,
//!    [`Pree::evaluate`] a [`Run`]. Both borrow the handle, so no other job is started, and no result read, while
//!    one runs.
//! 4. A run is polled, waited for with a [`Deadline`], or awaited on the interrupt pin.
//! 5. Every [`Error`] has a cause and a [`State`]; [`Lucerna::recover`] brings the device back from any of them.
//!
//! ```
//! use embedded_hal::delay::DelayNs;
//! use lucerna_bus::Bus;
//! use lucerna_driver::{
//!     Deadline, Error, EvaluateJob, HitPoint, Layout, Lucerna, Photon, Policies, UpdateJob,
//! };
//!
//! /// One pass: photons in, pixels out. The jobs and their layout are made beforehand.
//! fn pass<B: Bus, D: DelayNs>(
//!     lucerna: &mut Lucerna<B, D>,
//!     (update, evaluate): (&UpdateJob, &EvaluateJob),
//!     (hit_points, index, photons): (&[HitPoint], &[u32], &[Photon]),
//!     pixels: &mut [[f32; 3]],
//! ) -> Result<(), Error<B::Error>> {
//!     let layout = update.layout();
//!     let mut pree = lucerna.pree()?;
//!     pree.write_hit_points(layout, 0, hit_points)?;
//!     pree.write_index(layout, 0, index)?;
//!     pree.zero_pixels(layout)?;
//!
//!     let mut stream = pree.update(update)?;
//!     stream.push_all(photons, Deadline::seconds(10))?;
//!     stream.finish(Deadline::seconds(1))?;
//!
//!     pree.evaluate(evaluate)?.wait(Deadline::seconds(1))?;
//!     pree.read_pixels(layout, 0, pixels)
//! }
//!
//! // The probe, against a script of the very accesses it makes: an F32 device with 4 units and 1 MiB.
//! use lucerna_bus::{Access, Scripted};
//! use lucerna_driver::{NumberFormat, Sizes};
//! # struct NoDelay;
//! # impl DelayNs for NoDelay { fn delay_ns(&mut self, _: u32) {} }
//! let script = [
//!     Access::Read(0x000, 0x4C55_4352),
//!     Access::Read(0x004, 0x0001_0000),
//!     Access::Read(0x008, 0x0001_4004),
//!     Access::Read(0x00C, 0x0000_0C0A),
//!     Access::Read(0x010, 1 << 20),
//!     Access::Read(0x108, 0),
//! ];
//! let mut bus = Scripted::new(&script);
//! let lucerna = Lucerna::probe(&mut bus, NoDelay)?;
//! let device = *lucerna.capabilities();
//! assert_eq!((device.preus, device.format, device.update_stages), (4, NumberFormat::F32, 10));
//! bus.finish().unwrap();
//!
//! let sizes = Sizes { hit_points: 606, index_entries: 9000, pixels: 300, ring_entries: 4096, normal_test: true };
//! let layout = Layout::packed(&device, sizes)?;
//! let update = UpdateJob::new(&layout, 0.7, Policies::default())?;
//! assert!(UpdateJob::new(&layout, 1.1, Policies::default()).is_err(), "α is a fraction");
//! # let _ = (update, pass::<Scripted<'_>, NoDelay>);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
#![cfg_attr(not(test), no_std)]

mod capabilities;
mod counters;
mod deadline;
mod error;
mod interrupt;
mod job;
mod layout;
mod lucerna;
mod memory;
mod pree;
pub mod records;
mod run;
mod stream;

pub use capabilities::{Capabilities, NumberFormat, VERSION};
pub use counters::Counters;
pub use deadline::Deadline;
pub use error::{Cause, DeviceError, Error, State};
pub use job::{EvaluateJob, JobError, Policies, UpdateJob};
pub use layout::{Bases, Buffer, Layout, LayoutError, RING_ENTRIES_MAX, Region, Sizes};
pub use lucerna::{Lucerna, Progress};
pub use lucerna_regs::counters::Counter;
pub use lucerna_regs::pree::{Allocation, Busy, ErrorCode, Hazard, InputWidth, Scheduler};
pub use pree::Pree;
pub use records::{HitPoint, Photon};
pub use run::Run;
pub use stream::{PUSH_BLOCK, Stream};

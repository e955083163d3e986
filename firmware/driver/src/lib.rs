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
//! 5. [`Displace`] does the same for the pyramidal displacement mapping unit; see [`displace`].
//! 6. Every [`Error`] has a cause and a [`State`]; [`Lucerna::recover`] brings the device back from any of them.
//!
//! A whole program on a modelled device is `tests/examples/first_job.rs`; run it with
//! `cargo run --release -p lucerna-tests --example first_job`. One pass of it:
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
//!     Access::Read(0x004, 0x0001_0001),
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
//!
//! # Lists
//!
//! The host finds out which hit points are near a photon (commonly by a grid, a list a cell); the device tests them.
//! All lists lie one behind the other in the index table: entries `p_addr..p_addr + n` are the numbers of the hit
//! points which a photon is tested against. Photons may share a list, and lists may overlap.
//!
//! ```text
//! index table    0  1 | 1  2 | 2  3        hit points 0 and 1 for the first cell, 1 and 2 for the next, ...
//! entry          0  1   2  3   4  5        a photon in the second cell: p_addr = 2, n = 2
//! ```
//!
//! `n = 0` says that nothing is near (D9): `p_addr` is not looked at, and the photon belongs to N_emitted all the
//! same. A hit point takes a photon within its radius, and starts with a
//! [`radius_squared`](HitPoint::radius_squared) above 0, as photons only shrink it.
//!
//! # Ring size
//!
//! A photon takes 32 bytes of ring, 48 with the normal test. Once the ring is full, [`Stream::push_all`] waits until a
//! quarter of it is free, looking after pauses of 1 µs doubling to 1 ms; what is left must keep the device busy
//! meanwhile. Take 4,096 entries upwards on a host, and 16 to 64 on a small part, where memory is short. A
//! ring that is too small costs starved cycles ([`Counters::starved_cycles`]), never a photon.
//!
//! # Time
//!
//! The driver has no clock. A [`Deadline`] is measured by the delay given to [`Lucerna::probe`], or to an async call:
//! the sum of the pauses, not the time of the accesses. Behind a `lucerna_bus::Model` model time advances only by
//! accesses and delays: a device whose driver does nothing stands still, and with a delay that is not the model's
//! ([`delay()`](lucerna_bus::Model::delay)) a wait lets only the clocks of its own looks pass, and soon times out.
//!
//! # Dropping a stream or a run
//!
//! The job runs on, and the handle knows. [`Lucerna::pree`] and [`Pree::counters`] still work; whatever needs an idle
//! device (buffers, the next start) fails with [`Cause::NotReady`] and [`State::Running`]. [`Pree::resume`] and
//! [`Displace::resume`](Displace::resume) give the stream or run back, also to a driver which finds the job at its
//! probe; [`recover`](Lucerna::recover) gives the job up. A dropped *future* of `done` or `push_all_on` takes nothing
//! away: its run or stream is still there to wait with.
//!
//! # Async
//!
//! With the interrupt pin as an `embedded_hal_async` `Wait`, nothing is polled but a look every ten milliseconds:
//!
//! ```
//! use embedded_hal::delay::DelayNs;
//! use embedded_hal_async::{delay::DelayNs as AsyncDelayNs, digital::Wait};
//! use lucerna_bus::Bus;
//! use lucerna_driver::{Deadline, Error, Photon, Pree, UpdateJob};
//!
//! async fn update<B: Bus, D: DelayNs>(
//!     pree: &mut Pree<'_, B, D>,
//!     job: &UpdateJob,
//!     photons: &[Photon],
//!     (irq, delay): (&mut impl Wait, &mut impl AsyncDelayNs),
//! ) -> Result<(), Error<B::Error>> {
//!     let mut stream = pree.update(job)?;
//!     stream.push_all_on(photons, irq, delay, Deadline::millis(100)).await?; // for each wait for room
//!     stream.flush()?.done(irq, delay, Deadline::seconds(1)).await
//! }
//! ```
#![cfg_attr(not(test), no_std)]

mod capabilities;
mod counters;
mod deadline;
pub mod displace;
mod error;
mod interrupt;
mod job;
mod layout;
mod lucerna;
mod memory;
mod pree;
pub mod records;
mod resume;
mod run;
mod stream;
mod unit;

pub use capabilities::{Cache, Capabilities, DisplaceCapabilities, NumberFormat, VERSION};
pub use counters::Counters;
pub use deadline::Deadline;
pub use displace::Displace;
pub use error::{Cause, DeviceError, DisplaceError, Error, State};
pub use job::{EvaluateJob, JobError, Policies, UpdateJob};
pub use layout::{Bases, Buffer, Layout, LayoutError, RING_ENTRIES_MAX, Region, Sizes};
pub use lucerna::{Lucerna, Progress};
pub use lucerna_regs::counters::Counter;
pub use lucerna_regs::pree::{Allocation, Busy, ErrorCode, Hazard, InputWidth, Scheduler};
pub use pree::Pree;
pub use records::{HitPoint, Photon};
pub use resume::Resumed;
pub use run::Run;
pub use stream::{PUSH_BLOCK, Stream};
pub use unit::Unit;

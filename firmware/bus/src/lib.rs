//! How a driver reaches a device. In: register offsets, device-memory addresses, words. Out: words, or an
//! error of the back end. Cost: what the back end costs; the traits add nothing.
//!
//! | type | reaches | used by |
//! |---|---|---|
//! | [`ModelBus`] | a [`Target`] in this process, whose clock runs with the accesses | hostsim, tests, the app |
//! | [`Mmio`] | registers and memory mapped into the address space | the Cortex-M driver |
//! | [`Spi`] | a device behind an `embedded_hal::spi::SpiDevice` | a board beside the host |
//! | [`Traced`] | whatever it wraps, and writes a line an access; [`replay`] reads them back | `--bus-trace` |
//! | [`Faulty`] | whatever it wraps, but fails chosen accesses | tests |
//! | [`Scripted`] | nothing: compares each access with a list | tests |
//!
//! ```
//! use lucerna_bus::{Bus, Model, Target, TargetError, Traced, replay};
//!
//! /// A device of one register, which counts its clocks, and no memory.
//! #[derive(Default)]
//! struct Clock(u32);
//!
//! impl Target for Clock {
//!     fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
//!         if offset == 0 { Ok(self.0) } else { Err(TargetError::Unmapped) }
//!     }
//!     fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
//!         if offset == 0 { Ok(self.0 = value) } else { Err(TargetError::Unmapped) }
//!     }
//!     fn load(&self, _: u32, _: &mut [u32]) -> Result<(), TargetError> { Err(TargetError::OutOfRange) }
//!     fn store(&mut self, _: u32, _: &[u32]) -> Result<(), TargetError> { Err(TargetError::OutOfRange) }
//!     fn tick(&mut self) { self.0 += 1 }
//!     fn advance(&mut self, cycles: u64) { self.0 += cycles as u32 }
//!     fn interrupt(&self) -> bool { self.0 >= 1000 }
//! }
//!
//! let model = Model::new(Clock::default());
//! let mut bus = Traced::new(model.bus(), String::new());
//! bus.write(0, 40)?;
//! assert_eq!(bus.read(0)?, 41, "an access takes one clock");
//! let (_, text) = bus.into_parts();
//!
//! // The same accesses on a fresh device: every read must answer as it did.
//! let fresh = Model::new(Clock::default());
//! assert_eq!(replay(&text, &mut fresh.bus()).unwrap().accesses, 2);
//! # Ok::<(), TargetError>(())
//! ```
//!
//! # A modelled Lucerna
//!
//! [`Model::bus`], [`Model::delay`] and [`Model::irq`] borrow the model, so it must have a name and outlive them;
//! `Model::new(…).bus()` in one expression does not compile once the bus is kept. The device's number format and count
//! of units cannot be inferred and are written out; the memory's type can. With `lucerna_device`, `lucerna_driver` and
//! `lucerna_softfloat` (this crate depends on none of them):
//!
//! ```ignore
//! let device = PreeDevice::<F32, 4, _>::new(vec![0u32; words]);
//! let model = Model::new(device);
//! let mut lucerna = Lucerna::probe(model.bus(), model.delay())?;
//! ```
//!
//! Model time advances only by accesses, delays and waits for the pin. The whole program is
//! `tests/examples/first_job.rs`.
#![cfg_attr(not(test), no_std)]

mod bus;
mod faulty;
mod mmio;
mod model;
mod replay;
mod scripted;
mod spi;
mod target;
mod traced;

pub use bus::Bus;
pub use faulty::{Fault, Faulty, FaultyError, Moment};
pub use mmio::{Mmio, MmioError};
pub use model::{Model, ModelBus, ModelDelay, ModelIrq, Timing};
pub use replay::{Malformed, ReplayError, ReplayErrorKind, Replayed, replay, replay_timed};
pub use scripted::{Access, Divergence, Found, ScriptError, Scripted};
pub use spi::{Spi, SpiError, SpiFrame};
pub use target::{Target, TargetError};
pub use traced::{SharedSink, Traced, TracedDelay};

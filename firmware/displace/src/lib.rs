//! The pyramidal displacement-mapping unit; in: rays and a pyramid of heights, out: hit texels and colours; cost: one
//! traversal step a cycle and instance.
//!
//! The data's way: [`source`] hands rays to [`view`], which turns them into texture space; the ring of [`slots`] lets each do
//! one [`traverse`] step a turn, with heights from its cache; [`shade`] finds addresses and colours, [`read`] fetches texels.
//! [`operators`] is Table 1 as schedules, from which the pace of these units follows; [`instance`] wires one unit, [`engine`] up to
//! four of them to one memory port, and its `advance` does what `tick` does, with the same bits and counters, sooner.
//! [`pyramid`] says where a texel is, [`record`] what a ray and a result are in memory, [`job`] what may be asked for.
//!
//! Numbers such as P7 are decisions on what the paper leaves open; the project's documentation lists them.
//!
//! ```
//! use lucerna_displace::engine::{Displace, Event, Sizes};
//! use lucerna_displace::job::{Description, Job, MapDescription, RayFaults, Source};
//! use lucerna_displace::traverse::Policies;
//! use lucerna_fabric::window::{Window, Windows};
//! use lucerna_softfloat::{F24, Format};
//!
//! // Maps of one texel: height 51, so 204/255 = 0.8 deep; a white texture; a normal that points up. One ray, straight down.
//! let number = |x: f32| F24::from_f32(x);
//! let mut memory = [0u32; 96];
//! memory[0] = 51;
//! memory[16] = 0x00FF_FFFF;
//! memory[32] = 0x00FF_8080;
//! memory[48..53].copy_from_slice(&[0.5, 0.5, 0.0, 0.0, -1.0].map(|x| number(x).to_bits()));
//! let [zero, one] = [F24::ZERO, F24::ONE];
//! let map = |base| MapDescription { base, log2: [0, 0] };
//! let description = Description {
//!     policies: Policies::default(),
//!     source: Source::List { base: 192, count: 1 },
//!     ray_faults: RayFaults::Stop,
//!     watchdog: 4096,
//!     map: map(0),
//!     texture: map(64),
//!     normals: map(128),
//!     results: 256,
//!     height_scale: one,
//!     tbn: [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
//!     light: [zero, zero, one],
//!     ambient: zero,
//!     diffuse: one,
//!     background: 0,
//! };
//! let windows = Windows::new([Window { base: 0, limit: 384 }], 384);
//! let mut unit: Displace<F24, 1, 512> = Displace::new(Sizes::default()).unwrap();
//! unit.start(Job::new(&windows, &description).unwrap()).unwrap();
//! while unit.tick(&mut memory) != Some(Event::Done) {}
//! assert_eq!(F24::from_bits(memory[66]).to_f32(), F24::from_f32(0.8).to_f32(), "t");
//! assert_eq!(memory[68], 0x00FF_FFFF, "colour");
//! assert_eq!(unit.counters().steps, 1, "the root is the leaf");
//! ```
#![cfg_attr(not(test), no_std)]

#[cfg(feature = "shortcut")]
mod alone;
pub mod counters;
pub mod engine;
mod fast;
pub mod instance;
pub mod job;
pub mod operators;
mod outlook;
pub mod outside;
#[cfg(feature = "shortcut")]
mod passage;
pub mod pyramid;
pub mod read;
pub mod record;
pub mod shade;
pub mod sizes;
mod slot;
pub mod slots;
pub mod source;
pub mod traverse;
pub mod view;

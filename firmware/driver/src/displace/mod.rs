//! The pyramidal displacement mapping unit. In: maps, and rays or a camera. Out: what each ray hits, and its colour.
//! Cost: 37 register writes a job of a list, 50 of a camera.
//!
//! A ray enters a map of heights at its top plane, and goes up and down a pyramid of maxima until it hits a texel
//! (pyramidal displacement, §2 and §3). `§`, tables and figures are that paper's; `P` numbers are decisions where it
//! leaves something open.
//!
//! 1. [`Layout`] places a height map's pyramid, a texture, a normal map, rays and results in device memory.
//! 2. [`Displace`] writes the maps from [`Image`]s or functions, in the order the device wants them.
//! 3. A [`Job`] is a list of [`Ray`]s, or a [`Camera`] over a [`Plane`], with the [`Policies`] of a traversal.
//! 4. [`Displace::start`] gives a [`Run`] to poll, wait for, or await; then the [`RayResult`]s can be read.
//!
//! ```
//! use embedded_hal::delay::DelayNs;
//! use lucerna_bus::Bus;
//! use lucerna_driver::displace::{Image, Job, Light, RayResult, normal};
//! use lucerna_driver::{Deadline, Displace, Error};
//!
//! /// A picture of a height map: its maps are written, its pixels found and read.
//! fn picture<B: Bus, D: DelayNs>(
//!     displace: &mut Displace<'_, B, D>,
//!     job: &Job,
//!     (heights, texture): (&Image<'_, u8>, &Image<'_, u32>),
//!     pixels: &mut [RayResult],
//! ) -> Result<(), Error<B::Error>> {
//!     let layout = job.layout();
//!     displace.write_map(layout, heights)?;
//!     displace.write_texture(layout, texture)?;
//!     let scale = job.frame().height_scale;
//!     displace.write_normals_with(layout, |x, y| normal(heights.normal_at(x, y, scale)))?;
//!     displace.start(job)?.wait(Deadline::seconds(10))?;
//!     displace.read_results(layout, 0, pixels)
//! }
//!
//! // A job for a device with 4 MiB: 320 by 240 pixels, looking down on a plane.
//! use lucerna_driver::displace::{Camera, Layout, Plane, Policies, Shape, Sizes};
//! # use lucerna_driver::{Capabilities, NumberFormat};
//! # let device = Capabilities {
//! #     version: (1, 1), preus: 0, format: NumberFormat::F32, buffer_entries: 0, units: 2, update_stages: 0,
//! #     evaluate_stages: 0, operand_latency: 0, memory_bytes: 4 << 20, displace: None,
//! # };
//! let map = Shape::of(256, 256).unwrap();
//! let sizes = Sizes { map, texture: map, normals: map, rays: 0, results: 320 * 240 };
//! let layout = Layout::packed(&device, sizes)?;
//! let plane = Plane {
//!     origin: [-100.0, 0.0, 100.0],
//!     tangent: [200.0, 0.0, 0.0],
//!     bitangent: [0.0, 0.0, -200.0],
//!     normal: [0.0, 1.0, 0.0],
//!     repeat: [1.0, 1.0],
//!     height_scale: 0.1,
//!     bounded: true,
//! };
//! let camera = Camera {
//!     position: [0.0, 215.0, 0.0],
//!     direction: [0.0, -1.0, 0.0],
//!     up: [0.0, 0.0, -1.0],
//!     field_of_view: 45f32.to_radians(),
//!     width: 320,
//!     height: 240,
//! };
//! let job = Job::raster(&layout, &camera, &plane, Policies::MIX)?
//!     .with_light(Light::towards([1.0, 1.0, 2.0], 0.2, 0.8))?
//!     .with_background([0, 0, 64]);
//! assert_eq!(job.rays(), 76_800);
//! let below = Camera { position: [0.0, -1.0, 0.0], ..camera };
//! assert!(Job::raster(&layout, &below, &plane, Policies::MIX).is_err(), "the eye is above the plane");
//! # let _ = picture::<lucerna_bus::Scripted<'_>, NoDelay>;
//! # struct NoDelay;
//! # impl DelayNs for NoDelay { fn delay_ns(&mut self, _: u32) {} }
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod camera;
mod counters;
mod image;
mod job;
mod layout;
mod memory;
mod policies;
pub mod pyramid;
pub mod records;
mod run;
mod shape;
mod unit;

pub use camera::{Camera, Frame, Plane, Raster};
pub use counters::Counters;
pub use image::{Image, ImageError, channels, colour, components, normal};
pub use job::{Job, JobError, Light, Source};
pub use layout::{ALIGNMENT, Bases, Buffer, Layout, LayoutError, Sizes};
pub use lucerna_regs::displace::{Ascend, Coherent, ErrorCode, LevelsDown, RayFaults, Reach, Wrap};
pub use lucerna_regs::displace_counters::Counter;
pub use policies::{Algorithm, Policies, START_GRID_MAX};
pub use records::{Ray, RayResult, RayStatus};
pub use run::Run;
pub use shape::{MAX_LOG2, Shape};
pub use unit::Displace;

//! Displacement jobs: what the unit shall do, and nothing it cannot. In: a layout, rays or a camera, a plane, policies.
//! Out: a job, or why there is none. Cost: a few dozen comparisons; no access.

use core::fmt;

use lucerna_regs::displace::{self as regs, Config, RayFaults};

use super::camera::unit;
use super::image::colour;
use super::policies::START_GRID_MAX;
use super::{Camera, Frame, Layout, Plane, Policies, Raster};
use crate::records::{decode, encode};

/// The most pixels a raster may have along an axis, and the most steps of the watchdog.
const MAX_16: u32 = 0xFFFF;

/// Where the rays of a job come from.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Source {
    /// The first `count` records of the ray buffer.
    List {
        /// How many: 1 up to the layout's rays, and not more than its results.
        count: u32,
    },
    /// The pixels of a camera, row by row from the top; not more than the layout's results.
    Raster(Raster),
}

/// How a hit is coloured: texel times (`ambient` + `diffuse` · max(0, normal · `direction`)).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Light {
    /// Towards the light, in tangent space (along u, along v, upwards), of length one.
    pub direction: [f32; 3],
    /// Light that is everywhere.
    pub ambient: f32,
    /// Light from the light.
    pub diffuse: f32,
}

impl Light {
    /// A light in a direction of any length but 0, in tangent space.
    pub fn towards(direction: [f32; 3], ambient: f32, diffuse: f32) -> Self {
        Self { direction: unit(direction), ambient, diffuse }
    }
}

impl Default for Light {
    /// From straight above: four parts of five; the rest from everywhere.
    fn default() -> Self {
        Self { direction: [0.0, 0.0, 1.0], ambient: 0.2, diffuse: 0.8 }
    }
}

/// Finds what rays hit, and its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Job {
    layout: Layout,
    source: Source,
    frame: Frame,
    policies: Policies,
    light: Light,
    ray_faults: RayFaults,
    watchdog: u32,
    background: u32,
}

impl Job {
    /// A job of the first `count` rays of the layout's ray buffer.
    pub fn list(layout: &Layout, count: u32, plane: &Plane, policies: Policies) -> Result<Self, JobError> {
        Self::new(layout, Source::List { count }, plane.frame()?, policies)
    }

    /// A job of a camera's pixels.
    pub fn raster(
        layout: &Layout,
        camera: &Camera,
        plane: &Plane,
        policies: Policies,
    ) -> Result<Self, JobError> {
        Self::new(layout, Source::Raster(camera.raster(plane)?), plane.frame()?, policies)
    }

    /// A job in the device's own terms. The light comes from above, the watchdog stops a ray after 4096 steps, rays that
    /// fail are recorded, and the background is black; the methods below change that.
    pub fn new(layout: &Layout, source: Source, frame: Frame, policies: Policies) -> Result<Self, JobError> {
        if policies.start_grid > START_GRID_MAX {
            return Err(JobError::StartGrid);
        }
        let job = Self {
            layout: *layout,
            source,
            frame,
            policies,
            light: Light::default(),
            ray_faults: RayFaults::Record,
            watchdog: regs::WATCHDOG_RESET,
            background: 0,
        };
        if !job.is_positive(frame.height_scale) {
            return Err(JobError::HeightScale);
        }
        let vanishes = |row: [f32; 3]| row.iter().all(|x| job.number(*x) == 0.0);
        if !job.all_finite(frame.rows().as_flattened()) || frame.rows().into_iter().any(vanishes) {
            return Err(JobError::Plane);
        }
        match source {
            Source::List { count } => {
                if !(1..=layout.sizes().rays.min(layout.sizes().results)).contains(&count) {
                    return Err(JobError::RayCount);
                }
            }
            Source::Raster(raster) => job.check_raster(&raster)?,
        }
        Ok(job)
    }

    fn check_raster(&self, raster: &Raster) -> Result<(), JobError> {
        let sides = 1..=MAX_16;
        // Two sides of 16 bits do not leave 32.
        if !sides.contains(&raster.width)
            || !sides.contains(&raster.height)
            || raster.width * raster.height > self.layout.sizes().results
        {
            return Err(JobError::RasterSize);
        }
        if !self.all_finite([raster.origin, raster.right, raster.down].as_flattened()) {
            return Err(JobError::Camera);
        }
        let [u, v, above] = raster.eye;
        if !self.is_positive(above) || !self.all_finite(&[u, v]) {
            return Err(JobError::Eye);
        }
        if !self.all_finite(&raster.extent) || raster.extent.iter().any(|end| *end < 0.0) {
            return Err(JobError::Plane);
        }
        Ok(())
    }

    /// The same job under another light.
    pub fn with_light(self, light: Light) -> Result<Self, JobError> {
        let [x, y, z] = light.direction;
        if !self.all_finite(&[x, y, z, light.ambient, light.diffuse]) {
            return Err(JobError::Light);
        }
        Ok(Self { light, ..self })
    }

    /// The same job which stops a ray after so many steps (P1), 1 to 65535.
    pub fn with_watchdog(self, steps: u32) -> Result<Self, JobError> {
        if !(1..=MAX_16).contains(&steps) {
            return Err(JobError::Watchdog);
        }
        Ok(Self { watchdog: steps, ..self })
    }

    /// The same job, recording rays which fail or ending at the first.
    #[must_use]
    pub const fn with_ray_faults(self, ray_faults: RayFaults) -> Self {
        Self { ray_faults, ..self }
    }

    /// The same job with another colour of results which are no hit: red, green, blue.
    #[must_use]
    pub const fn with_background(self, background: [u8; 3]) -> Self {
        Self { background: colour(background), ..self }
    }

    /// Its buffers.
    pub const fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Where its rays come from.
    pub const fn source(&self) -> &Source {
        &self.source
    }

    /// Its way from the world to tangent space.
    pub const fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Its policies.
    pub const fn policies(&self) -> &Policies {
        &self.policies
    }

    /// Its light.
    pub const fn light(&self) -> &Light {
        &self.light
    }

    /// The most steps of a ray.
    pub const fn watchdog(&self) -> u32 {
        self.watchdog
    }

    /// How many rays it has, and results it writes.
    pub const fn rays(&self) -> u32 {
        match self.source {
            Source::List { count } => count,
            Source::Raster(raster) => raster.width * raster.height,
        }
    }

    pub(crate) const fn config(&self) -> Config {
        let source = match self.source {
            Source::List { .. } => regs::Source::List,
            Source::Raster(_) => regs::Source::Raster,
        };
        self.policies.config(source, self.ray_faults)
    }

    pub(crate) const fn background(&self) -> u32 {
        self.background
    }

    /// A number as the device sees it.
    fn number(&self, number: f32) -> f32 {
        let format = self.layout.format();
        decode(format, encode(format, number))
    }

    fn is_positive(&self, number: f32) -> bool {
        let number = self.number(number);
        number > 0.0 && number.is_finite()
    }

    fn all_finite(&self, numbers: &[f32]) -> bool {
        numbers.iter().all(|number| self.number(*number).is_finite())
    }
}

/// Why there is no such job. All numbers are meant in the device's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum JobError {
    /// A list of no ray, or of more than the layout has rays or results.
    RayCount,
    /// A raster of no pixel, of more than 65535 along an axis, or of more than the layout has results.
    RasterSize,
    /// The camera has no direction, looks along its up, or its field of view is not between 0 and π.
    Camera,
    /// The eye is not above the plane, or too far away.
    Eye,
    /// Tangent, bitangent and normal span no space, or a repeat is not above 0.
    Plane,
    /// The height scale is not a positive number.
    HeightScale,
    /// The start grid is finer than 8 times.
    StartGrid,
    /// The watchdog's steps are not 1 to 65535.
    Watchdog,
    /// The light has no direction, or is not finite.
    Light,
}

impl fmt::Display for JobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::RayCount => "a list has one ray or more: lay out as many rays, and as many results",
            Self::RasterSize => {
                "a picture has 1 to 65535 pixels along either side: lay out a result for each pixel"
            }
            Self::Camera => {
                "the camera sees nothing: give it a direction, an up beside it, and a view between 0 and π radians"
            }
            Self::Eye => "the eye must be above the plane, where its normal points, and not too far: move it",
            Self::Plane => {
                "the plane is flat or out of range: give it three directions of some length, and repeats above 0"
            }
            Self::HeightScale => "the height scale must be a positive number: 0.02 to 0.2 are usual",
            Self::StartGrid => "the start grid is at most 2^3 times finer: take 0 to 3",
            Self::Watchdog => "the watchdog allows 1 to 65535 steps: 4096 is usual",
            Self::Light => "the light needs a direction and finite numbers: straight down is [0, 0, 1]",
        })
    }
}

impl core::error::Error for JobError {}

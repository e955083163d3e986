//! A picture through the driver; in: a workload and what device to build, out: what the device made of each ray, counters, host
//! time; cost: the device's cycles.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use lucerna_bus::{Bus, Model, TargetError};
use lucerna_device::DisplaceDevice;
use lucerna_displace::engine::SizeError;
use lucerna_driver::displace::{
    Counters, Frame, Image, Job, JobError, Layout, LayoutError, Light, Raster, Ray, RayResult, RayStatus,
    Shape, Sizes, Source as JobSource, normal,
};
use lucerna_driver::{Capabilities, Cause, Deadline, Displace, Error, Lucerna};
use lucerna_softfloat::Format;

use super::picture::BACKGROUND;
use super::setup::{self, OnDevice, Setup};
use super::workload::{Source, TANGENT_ROWS, Workload};
use crate::accelerate::memory::{self, HostMemory};

/// Rays of a list that are in device memory at a time.
const BATCH: usize = 1 << 20;

/// Device time between two looks at the progress.
const LOOK: Deadline = Deadline::millis(20);

/// Looks at a job after which it is given up: an hour of device time.
const LOOKS: u32 = 3600 * 50;

/// Towards the light, along u, v and upwards.
const LIGHT: [f32; 3] = [-0.5, -0.35, 0.8];

/// What the device gave back.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// What it said it is.
    pub capabilities: Capabilities,
    /// Counted over all batches.
    pub counters: Counters,
    /// In the order of the workload's results.
    pub results: Vec<RayResult>,
    /// Host time from start to done, transfers not included.
    pub run_time: Duration,
    /// Host time of everything.
    pub host_time: Duration,
}

/// Why there is no outcome.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Nothing to do.
    #[error(
        "no pixel meets the surface from this view: look down on the grid, which is 200 by 200 around the origin"
    )]
    NoRays,
    /// There is no such unit.
    #[error("the unit cannot be built: {0}")]
    Sizes(#[from] SizeError),
    /// More memory than 32-bit addresses reach.
    #[error(
        "the job needs {0} bytes of device memory, more than 32-bit addresses reach: make the picture smaller"
    )]
    TooLarge(u64),
    /// The buffers could not be laid out.
    #[error("the job's buffers cannot be laid out: {0}")]
    Layout(#[from] LayoutError),
    /// The job could not be expressed.
    #[error("the job is not one the device has: {0}")]
    Job(#[from] JobError),
    /// The driver gave up.
    #[error("the driver reports: {0}")]
    Driver(#[from] Error<TargetError>),
}

/// Builds the device that `setup` names and runs the workload on it. `bar` grows by the results.
///
/// # Errors
/// [`RunError`].
pub fn run(setup: &Setup, workload: &Workload, bar: &ProgressBar) -> Result<Outcome, RunError> {
    if workload.results() == 0 {
        return Err(RunError::NoRays);
    }
    setup::on_device(setup, Session { setup, workload, bar })
}

/// A run whose device is yet to be built.
struct Session<'a> {
    setup: &'a Setup,
    workload: &'a Workload,
    bar: &'a ProgressBar,
}

impl OnDevice for Session<'_> {
    type Output = Result<Outcome, RunError>;

    fn on<F: Format, const U: usize, const L: usize>(self) -> Self::Output {
        let sizes = self.buffers();
        let bytes = sizes.bytes();
        let words = memory::words(bytes).ok_or(RunError::TooLarge(bytes))?;
        let device = DisplaceDevice::<F, U, L, _>::new(self.setup.sizes, HostMemory::new(words))?;
        // The caches' tags do not belong on a stack.
        let model = Box::new(Model::new(device).with_timing(self.setup.timing));
        self.drive(Lucerna::probe(model.bus(), model.delay())?, sizes)
    }
}

impl Session<'_> {
    fn buffers(&self) -> Sizes {
        let [width, height] = self.workload.map.log2();
        let shape = Shape::new(width, height).expect("a map's sides are checked when it is made");
        let (rays, results) = match self.workload.source {
            Source::List => {
                let batch = self.workload.rays.len().min(BATCH) as u32;
                (batch, batch)
            }
            Source::Raster => (0, self.workload.results() as u32),
        };
        Sizes { map: shape, texture: shape, normals: shape, rays, results }
    }

    fn drive<B: Bus<Error = TargetError>, D: embedded_hal::delay::DelayNs>(
        &self,
        mut lucerna: Lucerna<B, D>,
        sizes: Sizes,
    ) -> Result<Outcome, RunError> {
        let started = Instant::now();
        let capabilities = *lucerna.capabilities();
        let layout = Layout::packed(&capabilities, sizes)?;
        let mut unit = lucerna.displace()?;
        let scale = self.workload.surface.scale as f32;
        let image = |texels| Image::new(sizes.map, texels).expect("a height a texel");
        let heights = image(self.workload.map.heights());
        let texture = Image::new(sizes.texture, &self.workload.texture).expect("a colour a texel");
        unit.write_map(&layout, &heights)?;
        unit.write_texture(&layout, &texture)?;
        unit.write_normals_with(&layout, |x, y| normal(heights.normal_at(x, y, scale)))?;
        unit.clear_counters()?;

        let mut results = vec![RayResult::default(); self.workload.results()];
        let mut run_time = Duration::ZERO;
        for batch in self.batches() {
            if self.workload.source == Source::List {
                let records: Vec<Ray> = self.workload.rays[batch.clone()]
                    .iter()
                    .map(|ray| {
                        let [u, v, x, y, z] = ray.record();
                        Ray { entry: [u, v], view: [x, y, z] }
                    })
                    .collect();
                unit.write_rays(&layout, 0, &records)?;
            }
            let job = self.job(&layout, batch.len() as u32)?;
            let started = Instant::now();
            self.wait(&mut unit, &job, batch.start)?;
            run_time += started.elapsed();
            unit.read_results(&layout, 0, &mut results[batch])?;
        }
        let counters = unit.counters()?;
        Ok(Outcome { capabilities, counters, results, run_time, host_time: started.elapsed() })
    }

    /// Ranges of results that are one job each.
    fn batches(&self) -> Vec<std::ops::Range<usize>> {
        let results = self.workload.results();
        match self.workload.source {
            Source::Raster => std::iter::once(0..results).collect(),
            Source::List => {
                (0..results).step_by(BATCH).map(|first| first..(first + BATCH).min(results)).collect()
            }
        }
    }

    fn job(&self, layout: &Layout, count: u32) -> Result<Job, JobError> {
        let workload = self.workload;
        let [tangent, bitangent, normal] = TANGENT_ROWS;
        let frame = Frame { tangent, bitangent, normal, height_scale: workload.surface.scale as f32 };
        let source = match workload.source {
            Source::List => JobSource::List { count },
            Source::Raster => {
                let vector = |vector: [f64; 3]| vector.map(|x| x as f32);
                let raster = workload.raster;
                JobSource::Raster(Raster {
                    width: raster.width,
                    height: raster.height,
                    origin: vector(raster.origin),
                    right: vector(raster.right),
                    down: vector(raster.down),
                    eye: workload.eye(),
                    extent: workload.surface.extent().map(|x| x as f32),
                })
            }
        };
        Job::new(layout, source, frame, self.setup.policies)?
            .with_light(Light::towards(LIGHT, 0.25, 0.8))?
            .with_watchdog(self.setup.watchdog)
            .map(|job| job.with_background(BACKGROUND))
    }

    /// Runs a job, and shows its progress from `before` on.
    fn wait<B: Bus<Error = TargetError>, D: embedded_hal::delay::DelayNs>(
        &self,
        unit: &mut Displace<'_, B, D>,
        job: &Job,
        before: usize,
    ) -> Result<(), RunError> {
        let mut run = unit.start(job)?;
        for _ in 0..LOOKS {
            match run.wait(LOOK) {
                Err(Error { cause: Cause::Timeout, .. }) => {
                    self.bar.set_position(before as u64 + u64::from(run.rays_done()?));
                }
                other => return Ok(other?),
            }
        }
        Ok(run.wait(LOOK)?)
    }
}

impl Outcome {
    /// Rays that were traversed: those that took steps.
    pub fn traversed(&self) -> u64 {
        self.results.iter().filter(|result| result.steps > 0).count() as u64
    }

    /// The texels' numbers as words, for a digest: texel, steps and status of each result.
    pub fn words(&self) -> impl Iterator<Item = u32> {
        self.results.iter().flat_map(|result| {
            let [x, y] = result.texel.map(|texel| texel as u32);
            let hit = u32::from(result.status == RayStatus::Hit);
            [x, y, u32::from(result.steps) | hit << 16, result.t.to_bits()]
        })
    }
}

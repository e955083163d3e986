//! The displacement units of a scene; in: rays that wait, out: what the device says they hit; cost: the device's cycles.
//!
//! Each displaced surface has a device of its own, whose memory holds its maps all the time; each wave is one job, or a few. The
//! unit's light is taken out of its colours (ambient 1, diffuse 0): the photons bring the light.

use std::time::{Duration, Instant};

use lucerna_bus::Model;
use lucerna_device::DisplaceDevice;
use lucerna_driver::displace::{
    Counters, Frame, Job, JobError, Layout, Light, Ray, RayResult, RayStatus, Sizes, Source,
};
use lucerna_driver::{Deadline, Lucerna};
use lucerna_softfloat::Format;

use super::relief::{Relief, ReliefError, reflectance};
use crate::accelerate::Setup;
use crate::accelerate::memory::{self, HostMemory};
use crate::displace::session::RunError;
use crate::displace::setup::{self, OnDevice};
use crate::scene::{Displaced, Scene, Vec3};
use crate::trace::{Answer, Displacer, Request};

/// Rays of a job.
const MOST_RAYS: u32 = 1 << 16;

/// Device time of a job.
const DEADLINE: Deadline = Deadline::seconds(3600);

/// Why a displaced surface gives no answer.
#[derive(Debug, thiserror::Error)]
pub enum DisplacedError {
    /// Its maps.
    #[error("scene `{scene}`, [[displaced]] number {number}: {error}")]
    Relief {
        /// The scene.
        scene: String,
        /// From 1.
        number: usize,
        /// What is wrong.
        error: ReliefError,
    },
    /// Its device.
    #[error("a displaced surface: {0}")]
    Device(#[from] RunError),
}

/// A device per displaced surface.
pub struct Units {
    units: Vec<Box<dyn Unit>>,
    notes: Vec<String>,
    host_time: Duration,
}

impl Units {
    /// Loads the maps of a scene's displaced surfaces and builds a device for each, of the number format that `setup` has.
    ///
    /// # Errors
    /// [`DisplacedError`].
    pub fn new(scene: &Scene, setup: &Setup) -> Result<Self, DisplacedError> {
        let device = setup::Setup {
            format: setup.format,
            arith: setup.arith,
            timing: setup.timing,
            ..setup::Setup::default()
        };
        let started = Instant::now();
        let (mut units, mut notes) = (Vec::new(), Vec::new());
        for (index, surface) in scene.displaced().iter().enumerate() {
            let relief = Relief::load(surface).map_err(|error| DisplacedError::Relief {
                scene: scene.name().to_owned(),
                number: index + 1,
                error,
            })?;
            notes.extend(relief.notes().iter().cloned());
            units.push(setup::on_device(&device, Build { device: &device, surface, relief })?);
        }
        Ok(Self { units, notes, host_time: started.elapsed() })
    }

    /// What a user should know of how the maps were read.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Host time of loading and of all answers.
    pub const fn host_time(&self) -> Duration {
        self.host_time
    }

    /// Counters and jobs of each surface's device.
    ///
    /// # Errors
    /// The driver's.
    pub fn counters(&self) -> Result<Vec<(Counters, u64)>, DisplacedError> {
        self.units.iter().map(|unit| Ok(unit.counters()?)).collect()
    }
}

impl Displacer for Units {
    type Error = DisplacedError;

    fn answer(
        &mut self,
        surface: usize,
        requests: &[Request],
        answers: &mut Vec<Answer>,
    ) -> Result<(), DisplacedError> {
        let started = Instant::now();
        for requests in requests.chunks(MOST_RAYS as usize) {
            self.units[surface].answer(requests, answers)?;
        }
        self.host_time += started.elapsed();
        Ok(())
    }
}

/// A device whose type is its own affair.
trait Unit {
    fn answer(&mut self, requests: &[Request], answers: &mut Vec<Answer>) -> Result<(), RunError>;
    fn counters(&self) -> Result<(Counters, u64), RunError>;
}

/// A surface whose device is yet to be built.
struct Build<'a> {
    device: &'a setup::Setup,
    surface: &'a Displaced,
    relief: Relief,
}

impl OnDevice for Build<'_> {
    type Output = Result<Box<dyn Unit>, RunError>;

    fn on<F: Format, const U: usize, const L: usize>(self) -> Self::Output {
        let Self { device, surface, relief } = self;
        let sizes = Sizes {
            map: relief.heights().shape(),
            texture: relief.texture().shape(),
            normals: relief.normals().shape(),
            rays: MOST_RAYS,
            results: MOST_RAYS,
        };
        let bytes = sizes.bytes();
        let words = memory::words(bytes).ok_or(RunError::TooLarge(bytes))?;
        let target = DisplaceDevice::<F, U, L, _>::new(device.sizes, HostMemory::new(words))?;
        // The caches' tags do not belong on a stack.
        let model = Box::new(Model::new(target).with_timing(device.timing));
        let mut lucerna = Lucerna::probe(model.bus(), model.delay())?;
        let layout = Layout::packed(lucerna.capabilities(), sizes)?;
        let mut unit = lucerna.displace()?;
        unit.write_map(&layout, &relief.heights())?;
        unit.write_texture(&layout, &relief.texture())?;
        unit.write_normals(&layout, &relief.normals())?;
        unit.clear_counters()?;
        let [tangent, bitangent, normal] = surface.tbn().map(Vec3::to_f32);
        let frame = Frame { tangent, bitangent, normal, height_scale: surface.height_scale() as f32 };
        Ok(Box::new(OneUnit { model, relief, layout, frame, device: *device, jobs: 0 }))
    }
}

struct OneUnit<F: Format, const U: usize, const L: usize> {
    model: Box<Model<DisplaceDevice<F, U, L, HostMemory>>>,
    relief: Relief,
    layout: Layout,
    frame: Frame,
    device: setup::Setup,
    jobs: u64,
}

impl<F: Format, const U: usize, const L: usize> OneUnit<F, U, L> {
    fn job(&self, count: u32) -> Result<Job, JobError> {
        Job::new(&self.layout, Source::List { count }, self.frame, self.device.policies)?
            .with_light(Light::towards([0.0, 0.0, 1.0], 1.0, 0.0))?
            .with_watchdog(self.device.watchdog)
    }

    fn understand(&self, request: &Request, result: &RayResult) -> Answer {
        match result.status {
            RayStatus::Hit => Answer {
                t: f64::from(result.t),
                normal: self.relief.normal(result.texel),
                colour: reflectance(result.colour),
            },
            // A ray so flat that the device's format cannot tell it from one along the lid, or one given up: as the lid.
            _ => Answer::flat(self.relief.colour(request.entry)),
        }
    }
}

impl<F: Format, const U: usize, const L: usize> Unit for OneUnit<F, U, L> {
    fn answer(&mut self, requests: &[Request], answers: &mut Vec<Answer>) -> Result<(), RunError> {
        // The maps repeat: which copy it is does not matter, and numbers near 0 are finer.
        let ray = |request: &Request| Ray {
            entry: request.entry.map(|at| at.rem_euclid(1.0) as f32),
            view: request.view.to_f32(),
        };
        let rays: Vec<Ray> = requests.iter().map(ray).collect();
        let mut results = vec![RayResult::default(); rays.len()];
        let mut lucerna = Lucerna::probe(self.model.bus(), self.model.delay())?;
        let mut unit = lucerna.displace()?;
        unit.write_rays(&self.layout, 0, &rays)?;
        unit.start(&self.job(rays.len() as u32)?)?.wait(DEADLINE)?;
        unit.read_results(&self.layout, 0, &mut results)?;
        answers
            .extend(requests.iter().zip(&results).map(|(request, result)| self.understand(request, result)));
        self.jobs += 1;
        Ok(())
    }

    fn counters(&self) -> Result<(Counters, u64), RunError> {
        let mut lucerna = Lucerna::probe(self.model.bus(), self.model.delay())?;
        Ok((lucerna.displace()?.counters()?, self.jobs))
    }
}

//! The displacement unit, idle. In: a checked job. Out: a run to wait for. Cost: 37 or 50 register writes a job.
//!
//! The handle is borrowed by what it starts, as that of the progressive radiance estimation engine is.

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_regs::displace::{self, MapSize, NormalSize, RasterSize, TextureSize};
use lucerna_regs::window;

use super::layout::{Buffer, Layout};
use super::{Counters, Frame, Job, Light, Raster, Run, Source};
use crate::records::encode;
use crate::{Capabilities, Cause, Error, Lucerna, State, Unit};

/// The displacement unit between jobs.
///
/// Results are not to be had before the job is over; this does not compile:
///
/// ```compile_fail,E0499
/// # use {embedded_hal::delay::DelayNs, lucerna_bus::Bus, lucerna_driver::{Deadline, Displace, Error}};
/// # use lucerna_driver::displace::{Job, RayResult};
/// fn early<B: Bus, D: DelayNs>(
///     displace: &mut Displace<'_, B, D>,
///     job: &Job,
///     results: &mut [RayResult],
/// ) -> Result<(), Error<B::Error>> {
///     let mut run = displace.start(job)?;
///     displace.read_results(job.layout(), 0, results)?;
///     run.wait(Deadline::seconds(1))
/// }
/// ```
#[derive(Debug)]
pub struct Displace<'a, B, D> {
    pub(crate) device: &'a mut Lucerna<B, D>,
}

impl<'a, B: Bus, D: DelayNs> Displace<'a, B, D> {
    pub(crate) const fn new(device: &'a mut Lucerna<B, D>) -> Self {
        Self { device }
    }

    /// What the device was built of.
    pub const fn capabilities(&self) -> &Capabilities {
        self.device.capabilities()
    }

    /// What is known of the device's state, without asking it.
    pub const fn state(&self) -> State {
        self.device.state()
    }

    /// Starts a job.
    pub fn start(&mut self, job: &Job) -> Result<Run<'_, B, D>, Error<B::Error>> {
        self.guard(job.layout())?;
        self.describe(job)?;
        self.device.start(Unit::Displace)?;
        Ok(Run::new(self.device))
    }

    /// A run of the job whose run was dropped, or which an earlier owner of the device left running. Nothing is accessed.
    pub fn resume(&mut self) -> Result<Run<'_, B, D>, Error<B::Error>> {
        self.device.expect_job(Unit::Displace)?;
        Ok(Run::new(self.device))
    }

    /// See [`Lucerna::recover`].
    pub fn recover(&mut self) -> Result<(), Error<B::Error>> {
        self.device.recover()
    }

    /// All counters of the unit, from one moment. They accumulate over jobs; see [`Counters`] for the exception.
    pub fn counters(&mut self) -> Result<Counters, Error<B::Error>> {
        Counters::read(self.device)
    }

    /// Sets all of them to 0.
    pub fn clear_counters(&mut self) -> Result<(), Error<B::Error>> {
        Counters::clear(self.device)
    }

    /// All that must hold before the first write.
    pub(crate) fn guard(&self, layout: &Layout) -> Result<(), Error<B::Error>> {
        self.device.expect(State::Idle)?;
        if !layout.fits(self.capabilities()) {
            return Err(Error::untouched(Cause::ForeignLayout));
        }
        Ok(())
    }

    /// Writes everything a job is, from windows to background.
    fn describe(&mut self, job: &Job) -> Result<(), Error<B::Error>> {
        for (number, region) in job.layout().windows().iter().enumerate() {
            self.device.command(window::base(number), region.base())?;
            self.device.command(window::limit(number), region.limit())?;
        }
        self.device.command(displace::CONFIG, job.config().bits())?;
        self.device.command(displace::WATCHDOG, job.watchdog())?;
        self.maps(job.layout())?;
        match job.source() {
            Source::List { count } => {
                self.device.command(displace::RAY_BASE, job.layout().region(Buffer::Rays).base())?;
                self.device.command(displace::RAY_COUNT, *count)?;
            }
            Source::Raster(raster) => {
                let size = RasterSize::RESET.with_width(raster.width).with_height(raster.height);
                self.device.command(displace::RASTER_SIZE, size.bits())?;
            }
        }
        self.device.command(displace::RESULT_BASE, job.layout().region(Buffer::Results).base())?;
        self.frame(job, job.frame())?;
        if let Source::Raster(raster) = job.source() {
            self.raster(job, raster)?;
        }
        self.light(job, job.light())?;
        self.device.command(displace::BACKGROUND, job.background())
    }

    fn maps(&mut self, layout: &Layout) -> Result<(), Error<B::Error>> {
        let sizes = layout.sizes();
        let [width, height] = sizes.map.log2();
        let map = MapSize::RESET.with_log2_width(width).with_log2_height(height);
        let [width, height] = sizes.texture.log2();
        let texture = TextureSize::RESET.with_log2_width(width).with_log2_height(height);
        let [width, height] = sizes.normals.log2();
        let normals = NormalSize::RESET.with_log2_width(width).with_log2_height(height);
        let registers = [
            (displace::MAP_BASE, layout.region(Buffer::Map).base()),
            (displace::MAP_SIZE, map.bits()),
            (displace::TEXTURE_BASE, layout.region(Buffer::Texture).base()),
            (displace::TEXTURE_SIZE, texture.bits()),
            (displace::NORMAL_BASE, layout.region(Buffer::Normals).base()),
            (displace::NORMAL_SIZE, normals.bits()),
        ];
        registers.iter().try_for_each(|(offset, value)| self.device.command(*offset, *value))
    }

    fn frame(&mut self, job: &Job, frame: &Frame) -> Result<(), Error<B::Error>> {
        self.number(job, displace::HEIGHT_SCALE, frame.height_scale)?;
        self.vector(job, [displace::TANGENT_X, displace::TANGENT_Y, displace::TANGENT_Z], frame.tangent)?;
        let bitangent = [displace::BITANGENT_X, displace::BITANGENT_Y, displace::BITANGENT_Z];
        self.vector(job, bitangent, frame.bitangent)?;
        self.vector(job, [displace::NORMAL_X, displace::NORMAL_Y, displace::NORMAL_Z], frame.normal)
    }

    fn raster(&mut self, job: &Job, raster: &Raster) -> Result<(), Error<B::Error>> {
        self.vector(job, [displace::EYE_U, displace::EYE_V, displace::EYE_HEIGHT], raster.eye)?;
        self.vector(job, [displace::EXTENT_U, displace::EXTENT_V], raster.extent)?;
        self.vector(job, [displace::ORIGIN_X, displace::ORIGIN_Y, displace::ORIGIN_Z], raster.origin)?;
        self.vector(job, [displace::RIGHT_X, displace::RIGHT_Y, displace::RIGHT_Z], raster.right)?;
        self.vector(job, [displace::DOWN_X, displace::DOWN_Y, displace::DOWN_Z], raster.down)
    }

    fn light(&mut self, job: &Job, light: &Light) -> Result<(), Error<B::Error>> {
        self.vector(job, [displace::LIGHT_X, displace::LIGHT_Y, displace::LIGHT_Z], light.direction)?;
        self.number(job, displace::AMBIENT, light.ambient)?;
        self.number(job, displace::DIFFUSE, light.diffuse)
    }

    fn vector<const N: usize>(
        &mut self,
        job: &Job,
        offsets: [u32; N],
        numbers: [f32; N],
    ) -> Result<(), Error<B::Error>> {
        offsets.into_iter().zip(numbers).try_for_each(|(offset, number)| self.number(job, offset, number))
    }

    fn number(&mut self, job: &Job, offset: u32, number: f32) -> Result<(), Error<B::Error>> {
        self.device.command(offset, encode(job.layout().format(), number))
    }
}

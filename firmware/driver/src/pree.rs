//! The progressive radiance estimation engine, idle. In: a checked job. Out: a stream of photons to push, or a
//! run to wait for. Cost: 25 register writes a job.
//!
//! The handle is borrowed by what it starts, so no second job can be started, and no buffer read or written,
//! while one runs. A stream or run that is dropped goes on in the device: the handle remembers, and
//! refuses with [`Cause::NotReady`] until [`resume`](Pree::resume) or [`recover`](Pree::recover).

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_regs::pree::{self, Mode};
use lucerna_regs::window;

use crate::layout::Buffer;
use crate::stream::Ring;
use crate::{
    Capabilities, Cause, Counters, Error, EvaluateJob, Layout, Lucerna, Policies, Run, State, Stream, Unit,
    UpdateJob,
};

/// The engine between jobs.
///
/// Results are not to be had before the job is over; this does not compile:
///
/// ```compile_fail,E0499
/// # use {embedded_hal::delay::DelayNs, lucerna_bus::Bus, lucerna_driver::{Deadline, Error, EvaluateJob, Pree}};
/// fn early<B: Bus, D: DelayNs>(
///     pree: &mut Pree<'_, B, D>,
///     job: &EvaluateJob,
///     pixels: &mut [[f32; 3]],
/// ) -> Result<(), Error<B::Error>> {
///     let mut run = pree.evaluate(job)?;
///     pree.read_pixels(job.layout(), 0, pixels)?;
///     run.wait(Deadline::seconds(1))
/// }
/// ```
///
/// Nor does a second job while one runs, or a photon after the flush:
///
/// ```compile_fail,E0382
/// # use {embedded_hal::delay::DelayNs, lucerna_bus::Bus, lucerna_driver::{Deadline, Error, Photon, Pree, UpdateJob}};
/// fn late<B: Bus, D: DelayNs>(
///     pree: &mut Pree<'_, B, D>,
///     job: &UpdateJob,
///     photons: &[Photon],
/// ) -> Result<(), Error<B::Error>> {
///     let mut stream = pree.update(job)?;
///     let mut run = stream.flush()?;
///     stream.push_all(photons, Deadline::seconds(1))?;
///     run.wait(Deadline::seconds(1))
/// }
/// ```
#[derive(Debug)]
pub struct Pree<'a, B, D> {
    pub(crate) device: &'a mut Lucerna<B, D>,
}

impl<'a, B: Bus, D: DelayNs> Pree<'a, B, D> {
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

    /// Starts an update job; photons are pushed into the stream.
    pub fn update(&mut self, job: &UpdateJob) -> Result<Stream<'_, B, D>, Error<B::Error>> {
        self.guard(job.layout())?;
        self.describe(job.layout(), Mode::Update, job.policies())?;
        self.device.command(pree::ALPHA, job.alpha())?;
        self.device.command(pree::RING_LOW, job.ring_low())?;
        self.device.start(Unit::Pree)?;
        Ok(Stream::new(self.device, Ring::new(job)))
    }

    /// Starts an evaluation job. The pixels are added to, so set them to zero first.
    pub fn evaluate(&mut self, job: &EvaluateJob) -> Result<Run<'_, B, D>, Error<B::Error>> {
        self.guard(job.layout())?;
        self.describe(job.layout(), Mode::Evaluate, job.policies())?;
        self.device.command(pree::EMITTED, job.emitted())?;
        self.device.start(Unit::Pree)?;
        Ok(Run::new(self.device))
    }

    /// See [`Lucerna::recover`].
    pub fn recover(&mut self) -> Result<(), Error<B::Error>> {
        self.device.recover()
    }

    /// See [`Lucerna::counters`].
    pub fn counters(&mut self) -> Result<Counters, Error<B::Error>> {
        self.device.counters()
    }

    /// See [`Lucerna::clear_counters`].
    pub fn clear_counters(&mut self) -> Result<(), Error<B::Error>> {
        self.device.clear_counters()
    }

    /// All that must hold before the first write.
    pub(crate) fn guard(&self, layout: &Layout) -> Result<(), Error<B::Error>> {
        self.device.expect(State::Idle)?;
        if !layout.fits(self.capabilities()) {
            return Err(Error::untouched(Cause::ForeignLayout));
        }
        Ok(())
    }

    /// Writes what all jobs have in common: windows, configuration, buffers.
    fn describe(&mut self, layout: &Layout, mode: Mode, policies: &Policies) -> Result<(), Error<B::Error>> {
        for (number, buffer) in Buffer::ALL.iter().enumerate() {
            let region = layout.region(*buffer);
            self.device.command(window::base(number), region.base())?;
            self.device.command(window::limit(number), region.limit())?;
        }
        let sizes = layout.sizes();
        let registers = [
            (pree::CONFIG, policies.config(mode, sizes.normal_test).bits()),
            (pree::HIT_BASE, layout.region(Buffer::HitPoints).base()),
            (pree::HIT_COUNT, sizes.hit_points),
            (pree::INDEX_BASE, layout.region(Buffer::Index).base()),
            (pree::INDEX_COUNT, sizes.index_entries),
            (pree::PIXEL_BASE, layout.region(Buffer::Pixels).base()),
            (pree::PIXEL_COUNT, sizes.pixels),
            (pree::RING_BASE, layout.region(Buffer::Ring).base()),
            (pree::RING_ENTRIES, sizes.ring_entries),
        ];
        registers.iter().try_for_each(|(offset, value)| self.device.command(*offset, *value))
    }
}

//! A job taken up again. In: a running device. Out: a stream or a run, as the job is. Cost: two reads, and five for a
//! ring.
//!
//! Everything a stream knows is in the device's registers too, so even a driver that has just been started goes on
//! where an earlier one ended.

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;
use lucerna_regs::pree::{self, Mode};

use crate::layout::RING_ENTRIES_MAX;
use crate::stream::Ring;
use crate::{Cause, Error, Pree, Run, Stream, Unit};

/// A job of the progressive radiance estimation engine, found running.
#[derive(Debug)]
#[must_use = "dropped, the job runs on as before: finish the stream, wait for the run, or abort either"]
pub enum Resumed<'a, B, D> {
    /// An update which was not flushed: it takes photons. [`Stream::pushed`] goes on from what the device counts,
    /// modulo 2^32.
    Stream(Stream<'a, B, D>),
    /// An evaluation, or an update that was flushed, or a job which has ended since.
    Run(Run<'a, B, D>),
}

impl<B: Bus, D: DelayNs> Pree<'_, B, D> {
    /// Takes up the job whose stream or run was dropped, or which an earlier owner of the device left running. Nothing
    /// is written.
    ///
    /// The number format of the ring's records is the device's own; photons for another layout than the job's are the
    /// caller's mistake to avoid.
    pub fn resume(&mut self) -> Result<Resumed<'_, B, D>, Error<B::Error>> {
        self.device.expect_job(Unit::Pree)?;
        let config = pree::Config::from_bits(self.device.read(pree::CONFIG)?);
        let status = pree::Status::from_bits(self.device.read(pree::STATUS)?);
        let open = status.state() == Ok(pree::State::Running) && !status.flushing();
        if !open || config.mode() == Mode::Evaluate {
            return Ok(Resumed::Run(Run::new(self.device)));
        }
        let base = self.device.read(pree::RING_BASE)?;
        let entries = self.device.read(pree::RING_ENTRIES)?;
        if !entries.is_power_of_two() || entries > RING_ENTRIES_MAX {
            return Err(self.device.error(Cause::Nonsense { offset: pree::RING_ENTRIES, bits: entries }));
        }
        let low = self.device.read(pree::RING_LOW)?;
        let tail = self.device.read(pree::RING_TAIL)?;
        let head = self.device.read(pree::RING_HEAD)?;
        let Some(free) = entries.checked_sub(tail.wrapping_sub(head)) else {
            return Err(self.device.overrun(head, tail));
        };
        let ring = Ring {
            base,
            entries,
            format: self.capabilities().format,
            normal_test: config.normal_test(),
            low: low.min(entries - 1),
            tail,
            free,
            pushed: u64::from(tail),
        };
        Ok(Resumed::Stream(Stream::new(self.device, ring)))
    }
}

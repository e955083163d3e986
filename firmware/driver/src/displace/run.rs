//! A displacement job on its way to its end. In: looks, or a deadline. Out: done, or why not. Cost: a register read a
//! look.

use embedded_hal::delay::DelayNs;
use embedded_hal_async::delay::DelayNs as AsyncDelayNs;
use embedded_hal_async::digital::Wait;
use lucerna_bus::Bus;
use lucerna_regs::displace;

use super::Counters;
use crate::{Deadline, Error, Lucerna, Progress};

/// A running displacement job.
///
/// If it is dropped before it was seen to be done, the job runs on: [`Displace::resume`](super::Displace::resume) gives
/// a run to wait with again, [`Lucerna::recover`] gives the job up.
#[derive(Debug)]
#[must_use = "dropped, the job runs on and the next start fails with NotReady: wait for it or abort it"]
pub struct Run<'a, B, D> {
    device: &'a mut Lucerna<B, D>,
}

impl<'a, B: Bus, D: DelayNs> Run<'a, B, D> {
    pub(crate) const fn new(device: &'a mut Lucerna<B, D>) -> Self {
        Self { device }
    }

    /// One look, without waiting.
    pub fn poll(&mut self) -> Result<Progress, Error<B::Error>> {
        self.device.poll()
    }

    /// Looks again and again, with pauses from 1 µs doubling to 1 ms. After a timeout the job runs on, and can
    /// be waited for again.
    pub fn wait(&mut self, deadline: Deadline) -> Result<(), Error<B::Error>> {
        self.device.wait(deadline)
    }

    /// Waits for the interrupt; see [`crate::Run::done`].
    ///
    /// The future may be dropped; the job runs on.
    pub async fn done(
        &mut self,
        irq: &mut impl Wait,
        delay: &mut impl AsyncDelayNs,
        deadline: Deadline,
    ) -> Result<(), Error<B::Error>> {
        self.device.done(irq, delay, deadline).await
    }

    /// How many results have been written since the start, of [`Job::rays`](super::Job::rays): one read.
    pub fn rays_done(&mut self) -> Result<u32, Error<B::Error>> {
        self.device.read(displace::RAYS_DONE)
    }

    /// See [`Displace::counters`](super::Displace::counters); the job runs on.
    pub fn counters(&mut self) -> Result<Counters, Error<B::Error>> {
        Counters::read(self.device)
    }

    /// Gives the job up. See [`Lucerna::recover`].
    pub fn abort(self) -> Result<(), Error<B::Error>> {
        self.device.recover()
    }
}

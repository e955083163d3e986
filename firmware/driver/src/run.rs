//! A job on its way to its end. In: looks, or a deadline. Out: done, or why not. Cost: a register read a look.

use embedded_hal::delay::DelayNs;
use embedded_hal_async::delay::DelayNs as AsyncDelayNs;
use embedded_hal_async::digital::Wait;
use lucerna_bus::Bus;

use crate::{Counters, Deadline, Error, Lucerna, Progress};

/// A running job which needs nothing more: evaluation, or an update that was flushed.
///
/// If it is dropped before it was seen to be done, the job runs on, and nothing else can be started
/// ([`Cause::NotReady`](crate::Cause::NotReady)) until [`Pree::resume`](crate::Pree::resume) takes it up again, or
/// [`Lucerna::recover`] gives it up.
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

    /// Waits for the interrupt. `delay` bounds the wait and uncovers a lost interrupt: the device is looked at
    /// every ten milliseconds, and if the job is complete with the line low, that is
    /// [`Cause::LostInterrupt`](crate::Cause::LostInterrupt); its results are good all the same.
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

    /// See [`Lucerna::counters`]; the job runs on.
    pub fn counters(&mut self) -> Result<Counters, Error<B::Error>> {
        self.device.counters()
    }

    /// Gives the job up. See [`Lucerna::recover`].
    pub fn abort(self) -> Result<(), Error<B::Error>> {
        self.device.recover()
    }
}

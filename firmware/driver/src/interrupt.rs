//! Waiting for the interrupt line, and never for ever. In: a pin, a delay, a deadline. Out: the job's end. Cost:
//! two writes, two reads, and a read every ten milliseconds.

use core::future::{Future, poll_fn};
use core::pin::{Pin, pin};
use core::task::Poll;

use embedded_hal::delay::DelayNs;
use embedded_hal_async::delay::DelayNs as AsyncDelayNs;
use embedded_hal_async::digital::Wait;
use lucerna_bus::Bus;
use lucerna_regs::interrupts;

use crate::{Cause, Deadline, Error, Lucerna, Progress};

/// The longest sleep before the device is asked itself, in microseconds.
const RECHECK: u32 = 10_000;

impl<B: Bus, D: DelayNs> Lucerna<B, D> {
    /// Waits for the job's end by the line; it is enabled only meanwhile.
    pub(crate) async fn done(
        &mut self,
        irq: &mut impl Wait,
        delay: &mut impl AsyncDelayNs,
        deadline: Deadline,
    ) -> Result<(), Error<B::Error>> {
        self.adjust(interrupts::ENABLE, self.unit().done() | self.unit().failed())?;
        let result = self.ended(irq, delay, deadline).await;
        let disabled = self.adjust(interrupts::ENABLE, 0);
        result.and(disabled)
    }

    async fn ended(
        &mut self,
        irq: &mut impl Wait,
        delay: &mut impl AsyncDelayNs,
        deadline: Deadline,
    ) -> Result<(), Error<B::Error>> {
        // It may be done already: before the line was enabled, or in an earlier wait.
        if self.poll()? == Progress::Done {
            return Ok(());
        }
        // The line follows STATUS, so a job done with the line low has lost its interrupt; unless it became done
        // just after the line was looked at, which a second look tells.
        let mut suspect = false;
        let look = |high: bool| {
            let events = self.events()?;
            if events.done && !high && !suspect {
                suspect = true;
                return Ok(None);
            }
            let silent = !high && suspect;
            Ok((self.settle(events)? == Progress::Done).then_some(silent))
        };
        let silent = match watch(irq, delay, deadline, look).await {
            Ok(silent) => silent,
            Err(Ended::Look(error)) => return Err(error),
            Err(Ended::Pin) => return Err(self.error(Cause::Pin)),
            Err(Ended::Deadline) if self.poll()? == Progress::Done => suspect,
            Err(Ended::Deadline) => return Err(self.error(Cause::Timeout)),
        };
        if silent { Err(self.error(Cause::LostInterrupt)) } else { Ok(()) }
    }
}

/// Why a wait for the line ended with nothing seen.
pub(crate) enum Ended<E> {
    /// All of the deadline is used up.
    Deadline,
    /// The pin failed.
    Pin,
    /// The look failed.
    Look(E),
}

/// Calls `look` whenever the line is high, and every [`RECHECK`] microseconds, with the line's level, until it
/// has seen something or the deadline is used up. A line held high by somebody else costs looks, not the
/// deadline.
pub(crate) async fn watch<T, E>(
    irq: &mut impl Wait,
    delay: &mut impl AsyncDelayNs,
    deadline: Deadline,
    mut look: impl FnMut(bool) -> Result<Option<T>, E>,
) -> Result<T, Ended<E>> {
    let mut left = deadline.as_micros();
    while left > 0 {
        let slice = left.min(RECHECK);
        left -= slice;
        let mut pause = pin!(delay.delay_us(slice));
        while let First::One(level) = first(pin!(irq.wait_for_high()), pause.as_mut()).await {
            level.map_err(|_| Ended::Pin)?;
            if let Some(seen) = look(true).map_err(Ended::Look)? {
                return Ok(seen);
            }
            // Lets others run; the pause goes on, whatever the line does.
            if let First::Other(()) = first(pin!(pass()), pause.as_mut()).await {
                break;
            }
        }
        let high = matches!(once(pin!(irq.wait_for_high())).await, Some(Ok(())));
        if let Some(seen) = look(high).map_err(Ended::Look)? {
            return Ok(seen);
        }
    }
    Err(Ended::Deadline)
}

/// Which of two futures was ready first.
enum First<A, B> {
    One(A),
    Other(B),
}

/// Polls both; the one before the other when both are ready.
async fn first<A: Future, B: Future>(
    mut one: Pin<&mut A>,
    mut other: Pin<&mut B>,
) -> First<A::Output, B::Output> {
    poll_fn(|context| {
        if let Poll::Ready(output) = one.as_mut().poll(context) {
            return Poll::Ready(First::One(output));
        }
        other.as_mut().poll(context).map(First::Other)
    })
    .await
}

/// One poll: the output, if it is ready.
async fn once<A: Future>(mut future: Pin<&mut A>) -> Option<A::Output> {
    poll_fn(|context| match future.as_mut().poll(context) {
        Poll::Ready(output) => Poll::Ready(Some(output)),
        Poll::Pending => Poll::Ready(None),
    })
    .await
}

/// Gives way once.
async fn pass() {
    let mut passed = false;
    poll_fn(|context| {
        if passed {
            return Poll::Ready(());
        }
        passed = true;
        context.waker().wake_by_ref();
        Poll::Pending
    })
    .await;
}

//! A device in this process. In: accesses, delays and waits of a driver. Out: the device's answers. Cost: each
//! access takes the stated clocks of device time, a delay takes its nanoseconds at the device clock.
//!
//! One [`Model`] is shared by the three things a driver needs: [`ModelBus`], [`ModelDelay`] and [`ModelIrq`].
//! The host's time plays no part: a run is the same, to the clock, on any machine.

use core::cell::{Cell, RefCell};
use core::convert::Infallible;
use core::future::poll_fn;
use core::task::{Context, Poll};

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{ErrorType, InputPin};
use embedded_hal_async::delay::DelayNs as AsyncDelayNs;
use embedded_hal_async::digital::Wait;

use crate::{Bus, Target, TargetError};

/// How the device's clock is run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Timing {
    /// [`Target::tick`], clock by clock.
    Tick,
    /// [`Target::advance`]: the same state, sooner.
    #[default]
    Fast,
}

/// Clocks that pass in one poll of a waiting future: short beside a job, long beside a poll's own cost.
const WAIT_QUANTUM: u64 = 256;

/// A device and its clock, shared by bus, delay and interrupt pin, which borrow it: give it a name.
///
/// ```compile_fail,E0716
/// # use lucerna_bus::{Bus, Model, Target, TargetError};
/// # fn early(device: impl Target) -> Result<u32, TargetError> {
/// let mut bus = Model::new(device).bus();
/// bus.read(0)
/// # }
/// ```
///
/// ```
/// # use lucerna_bus::{Bus, Model, Target, TargetError};
/// # fn named(device: impl Target) -> Result<u32, TargetError> {
/// let model = Model::new(device);
/// let mut bus = model.bus();
/// bus.read(0)
/// # }
/// ```
#[derive(Debug)]
pub struct Model<T> {
    target: RefCell<T>,
    elapsed: Cell<u64>,
    timing: Timing,
    clock_hz: u32,
    access_cycles: u32,
    word_cycles: u32,
}

impl<T: Target> Model<T> {
    /// The device clock of PREE §V, in hertz.
    pub const CLOCK_HZ: u32 = 125_000_000;

    /// A model with a clock of 125 MHz, fast timing, and accesses of one clock.
    pub const fn new(target: T) -> Self {
        Self {
            target: RefCell::new(target),
            elapsed: Cell::new(0),
            timing: Timing::Fast,
            clock_hz: Self::CLOCK_HZ,
            access_cycles: 1,
            word_cycles: 0,
        }
    }

    /// Runs the clock in another way.
    pub const fn with_timing(mut self, timing: Timing) -> Self {
        self.timing = timing;
        self
    }

    /// Another device clock, by which delays are turned into clocks.
    pub const fn with_clock_hz(mut self, clock_hz: u32) -> Self {
        self.clock_hz = clock_hz;
        self
    }

    /// Device clocks that pass after every access (default 1).
    pub const fn with_access_cycles(mut self, cycles: u32) -> Self {
        self.access_cycles = cycles;
        self
    }

    /// Device clocks that pass besides for every word of a block (default 0: blocks go by a port of their own).
    pub const fn with_word_cycles(mut self, cycles: u32) -> Self {
        self.word_cycles = cycles;
        self
    }

    /// The driver's way to the registers and memory; borrows the model, as [`delay`](Self::delay) and
    /// [`irq`](Self::irq) do.
    pub const fn bus(&self) -> ModelBus<'_, T> {
        ModelBus(self)
    }

    /// A delay in device time, blocking and async.
    pub const fn delay(&self) -> ModelDelay<'_, T> {
        ModelDelay(self)
    }

    /// The interrupt line as a pin.
    pub const fn irq(&self) -> ModelIrq<'_, T> {
        ModelIrq(self)
    }

    /// Lets `cycles` clocks pass.
    pub fn advance(&self, cycles: u64) {
        let mut target = self.target.borrow_mut();
        self.run(&mut target, cycles);
    }

    /// Clocks passed since the model was made.
    pub fn elapsed(&self) -> u64 {
        self.elapsed.get()
    }

    /// Looks at the device; no time passes.
    ///
    /// # Panics
    /// When `look` uses a handle of this same model.
    pub fn inspect<R>(&self, look: impl FnOnce(&T) -> R) -> R {
        look(&self.target.borrow())
    }

    /// Changes the device behind the driver's back, as a test does; no time passes.
    ///
    /// # Panics
    /// When `change` uses a handle of this same model.
    pub fn tamper<R>(&self, change: impl FnOnce(&mut T) -> R) -> R {
        change(&mut self.target.borrow_mut())
    }

    /// The device, when the model is done with.
    pub fn into_inner(self) -> T {
        self.target.into_inner()
    }

    fn access<R>(&self, words: usize, act: impl FnOnce(&mut T) -> R) -> R {
        let mut target = self.target.borrow_mut();
        let answer = act(&mut target);
        let cycles = u64::from(self.access_cycles) + u64::from(self.word_cycles) * words as u64;
        self.run(&mut target, cycles);
        answer
    }

    fn run(&self, target: &mut T, cycles: u64) {
        match self.timing {
            Timing::Tick => (0..cycles).for_each(|_| target.tick()),
            Timing::Fast if cycles == 0 => {}
            Timing::Fast => target.advance(cycles),
        }
        self.elapsed.set(self.elapsed.get().wrapping_add(cycles));
    }

    /// `amount / per_second` seconds in clocks, rounded up: a delay is never short.
    fn cycles(&self, amount: u32, per_second: u64) -> u64 {
        (u64::from(amount) * u64::from(self.clock_hz)).div_ceil(per_second)
    }

    /// Waits in device time: every poll lets at most [`WAIT_QUANTUM`] clocks pass, so that whatever is polled
    /// beside it sees the device on its way.
    async fn sleep(&self, cycles: u64) {
        let end = self.elapsed().saturating_add(cycles);
        poll_fn(|context| {
            let left = end.saturating_sub(self.elapsed());
            if left == 0 {
                return Poll::Ready(());
            }
            self.advance(left.min(WAIT_QUANTUM));
            if self.elapsed() >= end { Poll::Ready(()) } else { again(context) }
        })
        .await;
    }

    /// Waits for a level; in [`Timing::Tick`] not a clock too long, in [`Timing::Fast`] up to [`WAIT_QUANTUM`].
    async fn level(&self, level: bool) {
        poll_fn(|context| {
            let mut target = self.target.borrow_mut();
            let mut left = WAIT_QUANTUM;
            while target.interrupt() != level {
                if left == 0 {
                    return again(context);
                }
                let step = if self.timing == Timing::Tick { 1 } else { left };
                self.run(&mut target, step);
                left -= step;
            }
            Poll::Ready(())
        })
        .await;
    }
}

fn again(context: &mut Context<'_>) -> Poll<()> {
    context.waker().wake_by_ref();
    Poll::Pending
}

/// A [`Bus`] to a [`Model`]: an access takes effect, then its clocks pass.
#[derive(Debug)]
pub struct ModelBus<'a, T>(&'a Model<T>);

impl<T> Clone for ModelBus<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for ModelBus<'_, T> {}

impl<T: Target> Bus for ModelBus<'_, T> {
    type Error = TargetError;

    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        self.0.access(0, |target| target.read(offset))
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        self.0.access(0, |target| target.write(offset, value))
    }

    fn read_block(&mut self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
        self.0.access(words.len(), |target| target.load(address, words))
    }

    fn write_block(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
        self.0.access(words.len(), |target| target.store(address, words))
    }
}

/// A delay in the time of a [`Model`]: nanoseconds become device clocks.
#[derive(Debug)]
pub struct ModelDelay<'a, T>(&'a Model<T>);

impl<T: Target> DelayNs for ModelDelay<'_, T> {
    fn delay_ns(&mut self, ns: u32) {
        self.0.advance(self.0.cycles(ns, 1_000_000_000));
    }

    fn delay_us(&mut self, us: u32) {
        self.0.advance(self.0.cycles(us, 1_000_000));
    }

    fn delay_ms(&mut self, ms: u32) {
        self.0.advance(self.0.cycles(ms, 1_000));
    }
}

impl<T: Target> AsyncDelayNs for ModelDelay<'_, T> {
    async fn delay_ns(&mut self, ns: u32) {
        self.0.sleep(self.0.cycles(ns, 1_000_000_000)).await;
    }

    async fn delay_us(&mut self, us: u32) {
        self.0.sleep(self.0.cycles(us, 1_000_000)).await;
    }

    async fn delay_ms(&mut self, ms: u32) {
        self.0.sleep(self.0.cycles(ms, 1_000)).await;
    }
}

/// The interrupt line of a [`Model`]. Waiting lets the device run; as with a real pin, a level that never comes
/// is waited for for ever, so race it against a delay.
#[derive(Debug)]
pub struct ModelIrq<'a, T>(&'a Model<T>);

impl<T> ErrorType for ModelIrq<'_, T> {
    type Error = Infallible;
}

impl<T: Target> InputPin for ModelIrq<'_, T> {
    fn is_high(&mut self) -> Result<bool, Infallible> {
        Ok(self.0.inspect(Target::interrupt))
    }

    fn is_low(&mut self) -> Result<bool, Infallible> {
        Ok(!self.0.inspect(Target::interrupt))
    }
}

impl<T: Target> Wait for ModelIrq<'_, T> {
    async fn wait_for_high(&mut self) -> Result<(), Infallible> {
        self.0.level(true).await;
        Ok(())
    }

    async fn wait_for_low(&mut self) -> Result<(), Infallible> {
        self.0.level(false).await;
        Ok(())
    }

    async fn wait_for_rising_edge(&mut self) -> Result<(), Infallible> {
        self.0.level(false).await;
        self.0.level(true).await;
        Ok(())
    }

    async fn wait_for_falling_edge(&mut self) -> Result<(), Infallible> {
        self.0.level(true).await;
        self.0.level(false).await;
        Ok(())
    }

    async fn wait_for_any_edge(&mut self) -> Result<(), Infallible> {
        let now = self.0.inspect(Target::interrupt);
        self.0.level(!now).await;
        Ok(())
    }
}

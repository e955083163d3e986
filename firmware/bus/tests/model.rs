//! Does the model's time pass as stated: by accesses, by delays, by waits?

use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::InputPin;
use embedded_hal_async::delay::DelayNs as AsyncDelayNs;
use embedded_hal_async::digital::Wait;
use lucerna_bus::{Bus, Model, Target, TargetError, Timing};

/// Counts its clocks; interrupts from clock `alarm` on.
struct Clock {
    now: u64,
    ticks: u64,
    alarm: u64,
}

impl Target for Clock {
    fn read(&mut self, _: u32) -> Result<u32, TargetError> {
        Ok(self.now as u32)
    }
    fn write(&mut self, _: u32, _: u32) -> Result<(), TargetError> {
        Err(TargetError::Unmapped)
    }
    fn load(&self, _: u32, words: &mut [u32]) -> Result<(), TargetError> {
        words.fill(self.now as u32);
        Ok(())
    }
    fn store(&mut self, _: u32, _: &[u32]) -> Result<(), TargetError> {
        Ok(())
    }
    fn tick(&mut self) {
        self.now += 1;
        self.ticks += 1;
    }
    fn advance(&mut self, cycles: u64) {
        self.now += cycles;
    }
    fn interrupt(&self) -> bool {
        self.now >= self.alarm
    }
}

fn clock(alarm: u64) -> Model<Clock> {
    Model::new(Clock { now: 0, ticks: 0, alarm })
}

/// Polls to the end; the number of polls is bounded, so a wait that never ends is a failure.
fn block_on<F: Future>(future: F, polls: usize) -> Option<F::Output> {
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    (0..polls).find_map(|_| match future.as_mut().poll(&mut context) {
        Poll::Ready(output) => Some(output),
        Poll::Pending => None,
    })
}

#[test]
fn an_access_acts_then_takes_its_time() {
    let model = clock(0).with_access_cycles(3).with_word_cycles(2);
    let mut bus = model.bus();
    assert_eq!(bus.read(0), Ok(0));
    assert_eq!(bus.read(0), Ok(3));
    assert_eq!(bus.write(0, 0), Err(TargetError::Unmapped), "a refused access takes time too");
    let mut words = [0; 4];
    bus.read_block(0, &mut words).unwrap();
    assert_eq!(words, [9; 4]);
    assert_eq!(model.elapsed(), 9 + 3 + 4 * 2);
}

#[test]
fn timing_chooses_ticks_or_advance_and_no_other_difference() {
    for (timing, ticks) in [(Timing::Tick, 21), (Timing::Fast, 0)] {
        let model = clock(0).with_timing(timing);
        model.bus().read(0).unwrap();
        model.advance(20);
        assert_eq!(model.elapsed(), 21);
        assert_eq!(model.inspect(|clock| (clock.now, clock.ticks)), (21, ticks));
    }
}

#[test]
fn delays_are_rounded_up_to_clocks() {
    let model = clock(0);
    let mut delay = model.delay();
    DelayNs::delay_ns(&mut delay, 1);
    assert_eq!(model.elapsed(), 1, "8 ns is a clock");
    DelayNs::delay_ns(&mut delay, 8);
    assert_eq!(model.elapsed(), 2);
    DelayNs::delay_us(&mut delay, 3);
    assert_eq!(model.elapsed(), 2 + 375);
    DelayNs::delay_ms(&mut delay, u32::MAX);
    assert_eq!(model.elapsed(), 2 + 375 + u64::from(u32::MAX) * 125_000);
    let slow = clock(0).with_clock_hz(1_000_000);
    DelayNs::delay_ns(&mut slow.delay(), 1_500);
    assert_eq!(slow.elapsed(), 2);
}

#[test]
fn async_delays_take_the_same_time() {
    let model = clock(0);
    block_on(AsyncDelayNs::delay_us(&mut model.delay(), 10), 100).unwrap();
    assert_eq!(model.elapsed(), 1250);
    block_on(AsyncDelayNs::delay_ns(&mut model.delay(), 0), 1).unwrap();
    assert_eq!(model.elapsed(), 1250);
}

#[test]
fn waiting_for_the_interrupt_runs_the_device() {
    let model = clock(1000).with_timing(Timing::Tick);
    let mut irq = model.irq();
    assert_eq!(irq.is_high(), Ok(false));
    assert!(block_on(irq.wait_for_high(), 2).is_none(), "512 clocks are not enough");
    assert_eq!(model.elapsed(), 512);
    block_on(irq.wait_for_high(), 10).unwrap().unwrap();
    assert_eq!(model.elapsed(), 1000, "ticks stop at the very clock");
    assert_eq!(irq.is_high(), Ok(true));
    assert!(block_on(irq.wait_for_low(), 10).is_none());
    block_on(clock(300).irq().wait_for_rising_edge(), 10).unwrap().unwrap();
    block_on(clock(300).irq().wait_for_any_edge(), 10).unwrap().unwrap();
    assert!(block_on(clock(300).irq().wait_for_falling_edge(), 10).is_none());
}

#[test]
fn tampering_and_taking_back_reach_the_device() {
    let model = clock(5);
    model.tamper(|clock| clock.now = 5);
    assert_eq!(model.irq().is_low(), Ok(false));
    assert_eq!(model.elapsed(), 0);
    assert_eq!(model.into_inner().now, 5);
}

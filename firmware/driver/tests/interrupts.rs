//! Does waiting on the pin end when the job ends, and end at all when it does not?

mod common;

use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};

use common::{Fake, SIZES, evaluate_job, hit_points, layout, model, photons, update_job};
use embedded_hal::digital::{ErrorKind, ErrorType, InputPin};
use embedded_hal_async::digital::Wait;
use lucerna_bus::{Bus, Fault, Faulty, FaultyError, Model, ModelDelay, Moment, Timing};
use lucerna_driver::{Cause, Deadline, DeviceError, Error, ErrorCode, Lucerna, State};
use lucerna_regs::interrupts;

const PLENTY: Deadline = Deadline::millis(100);
/// 10 ms: how often the device is looked at behind the pin's back.
const RECHECK: u64 = 1_250_000;

/// Polls to the end. The number of polls is bounded, so a wait for ever is a failure.
fn block_on<F: Future>(future: F) -> F::Output {
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    for _ in 0..1_000_000 {
        if let Poll::Ready(output) = future.as_mut().poll(&mut context) {
            return output;
        }
    }
    panic!("waits for ever");
}

type Outcome = Result<(), Error<lucerna_bus::TargetError>>;

/// An evaluation awaited on the pin; the clocks it took.
fn evaluate(model: &Model<Fake>, deadline: Deadline) -> (Outcome, State, u64) {
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut run = pree.evaluate(&evaluate_job(&layout)).unwrap();
    let start = model.elapsed();
    let outcome = block_on(run.done(&mut model.irq(), &mut model.delay(), deadline));
    (outcome, lucerna.state(), model.elapsed() - start)
}

#[test]
fn the_interrupt_ends_the_wait_at_once() {
    for timing in [Timing::Tick, Timing::Fast] {
        let model = Model::new(Fake::default()).with_timing(timing);
        model.tamper(|fake| fake.pace = 1000);
        let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
        let layout = layout(SIZES);
        let mut pree = lucerna.pree().unwrap();
        let mut stream = pree.update(&update_job(&layout)).unwrap();
        stream.push_all(&photons(8), PLENTY).unwrap();
        let mut run = stream.flush().unwrap();
        let start = model.elapsed();
        block_on(run.done(&mut model.irq(), &mut model.delay(), PLENTY)).unwrap();
        let clocks = model.elapsed() - start;
        assert!((7_900..8_700).contains(&clocks), "8 photons of 1,000 clocks took {clocks}");
        assert_eq!(model.inspect(|fake| fake.get(interrupts::ENABLE)), 0, "the line is given back");
        assert_eq!(model.inspect(|fake| fake.get(interrupts::STATUS)), 0);
        // Once more: it is done already.
        block_on(run.done(&mut model.irq(), &mut model.delay(), Deadline::NOW)).unwrap();
    }
}

#[test]
fn a_job_done_before_the_wait_is_done() {
    let model = model(|_| {});
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut run = pree.evaluate(&evaluate_job(&layout)).unwrap();
    model.advance(1000);
    block_on(run.done(&mut model.irq(), &mut model.delay(), Deadline::NOW)).unwrap();
}

#[test]
fn an_error_raises_the_line_too() {
    let model = model(|fake| fake.error = Some((0, ErrorCode::PixelRange, 0x40)));
    let (outcome, state, clocks) = evaluate(&model, PLENTY);
    let found = DeviceError { code: ErrorCode::PixelRange, address: 0x40 };
    assert_eq!(outcome.unwrap_err().cause, Cause::Device(found));
    assert_eq!(state, State::Faulted);
    assert!(clocks < 1000);
}

#[test]
fn a_lost_interrupt_is_found_out_and_the_results_are_good() {
    for (deadline, slices) in [(PLENTY, 2), (Deadline::millis(20), 2), (Deadline::millis(10), 1)] {
        let model = model(|fake| fake.cut = true);
        let (outcome, state, clocks) = evaluate(&model, deadline);
        let error = outcome.unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::LostInterrupt, State::Idle));
        assert_eq!(state, State::Idle);
        let longest = slices * RECHECK + 2_000;
        assert!((slices * RECHECK..longest).contains(&clocks), "{clocks} clocks within {deadline:?}");
    }
    // Nothing to recover: the pixels can be read, and the next job started.
    let model = model(|fake| fake.cut = true);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    pree.write_hit_points(&layout, 0, &hit_points()).unwrap();
    let mut run = pree.evaluate(&evaluate_job(&layout)).unwrap();
    block_on(run.done(&mut model.irq(), &mut model.delay(), PLENTY)).unwrap_err();
    let mut pixels = [[0.0; 3]; 2];
    pree.read_pixels(&layout, 0, &mut pixels).unwrap();
    assert_eq!(pixels, [[1.5, 3.0, 6.0], [5.5, 11.0, 22.0]]);
    lucerna.recover().unwrap();
}

#[test]
fn a_device_that_does_not_get_on_is_a_timeout() {
    for millis in [0, 1, 10, 35] {
        let model = model(|fake| fake.asleep = true);
        let (outcome, state, clocks) = evaluate(&model, Deadline::millis(millis));
        let error = outcome.unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::Timeout, State::Running));
        assert_eq!(state, State::Running);
        let wanted = u64::from(millis) * 125_000;
        assert!((wanted..wanted + 3_000).contains(&clocks), "{clocks} clocks in {millis} ms");
    }
}

#[test]
fn a_line_stuck_high_delays_nothing_and_hides_nothing() {
    let model = model(|fake| fake.stuck_high = true);
    let (outcome, _, clocks) = evaluate(&model, PLENTY);
    outcome.unwrap();
    assert!(clocks < 2_000);
    // Nor does it keep a wait for ever.
    let model = common::model(|fake| (fake.stuck_high, fake.asleep) = (true, true));
    let (outcome, _, clocks) = evaluate(&model, Deadline::millis(35));
    assert_eq!(outcome.unwrap_err().cause, Cause::Timeout);
    assert!(clocks < 2 * 35 * 125_000, "{clocks} clocks");
}

/// A pin that fails when it is waited for.
struct Broken;

#[derive(Debug)]
struct Loose;

impl embedded_hal::digital::Error for Loose {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Other
    }
}

impl ErrorType for Broken {
    type Error = Loose;
}

impl Wait for Broken {
    async fn wait_for_high(&mut self) -> Result<(), Loose> {
        Err(Loose)
    }
    async fn wait_for_low(&mut self) -> Result<(), Loose> {
        Err(Loose)
    }
    async fn wait_for_rising_edge(&mut self) -> Result<(), Loose> {
        Err(Loose)
    }
    async fn wait_for_falling_edge(&mut self) -> Result<(), Loose> {
        Err(Loose)
    }
    async fn wait_for_any_edge(&mut self) -> Result<(), Loose> {
        Err(Loose)
    }
}

#[test]
fn a_broken_pin_is_an_error_and_the_job_can_be_polled() {
    let model = model(|_| {});
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut run = pree.evaluate(&evaluate_job(&layout)).unwrap();
    let error = block_on(run.done(&mut Broken, &mut model.delay(), PLENTY)).unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::Pin, State::Running));
    run.wait(PLENTY).unwrap();
}

#[test]
fn a_dropped_wait_can_be_taken_up_again() {
    let model = model(|fake| fake.pace = 1000);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    stream.push_all(&photons(8), PLENTY).unwrap();
    let mut run = stream.flush().unwrap();
    {
        let (mut irq, mut delay) = (model.irq(), model.delay());
        let mut wait = pin!(run.done(&mut irq, &mut delay, PLENTY));
        let mut context = Context::from_waker(Waker::noop());
        assert!(wait.as_mut().poll(&mut context).is_pending());
    }
    block_on(run.done(&mut model.irq(), &mut model.delay(), PLENTY)).unwrap();
    assert_eq!(model.inspect(|fake| fake.taken.len()), 8);
}

#[test]
fn photons_are_pushed_on_the_ring_space_interrupt() {
    for (cut, low) in [(false, 4), (false, 0), (false, 7), (true, 4)] {
        let model = model(|fake| (fake.pace, fake.cut) = (10_000, cut));
        let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
        let layout = layout(SIZES);
        let mut pree = lucerna.pree().unwrap();
        let job = update_job(&layout).with_ring_low(low).unwrap();
        let mut stream = pree.update(&job).unwrap();
        let start = model.elapsed();
        block_on(stream.push_all_on(&photons(50), &mut model.irq(), &mut model.delay(), PLENTY)).unwrap();
        let clocks = model.elapsed() - start;
        if cut {
            assert!(clocks > 4 * RECHECK, "without the line it takes looks: {clocks}");
        } else {
            assert!(clocks < 50 * 10_600, "{clocks} clocks");
            // At most a wake a photon, and three looks a wake: nobody spins on an old event.
            let reads = model.inspect(|fake| fake.head_reads);
            assert!(reads < 150, "{reads} reads of the head");
        }
        stream.finish(PLENTY).unwrap();
        assert_eq!(model.inspect(|fake| fake.taken.len()), 50);
        assert_eq!(model.inspect(|fake| fake.get(interrupts::ENABLE)), 0);
    }
}

#[test]
fn pushing_on_the_pin_times_out_and_sees_errors() {
    let model = model(|fake| fake.asleep = true);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    let (mut irq, mut delay) = (model.irq(), model.delay());
    let push = block_on(stream.push_all_on(&photons(9), &mut irq, &mut delay, Deadline::millis(5)));
    let error = push.unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::Timeout, State::Running));
    assert_eq!(stream.pushed(), 8);
    model.tamper(|fake| (fake.asleep, fake.error) = (false, Some((0, ErrorCode::IndexRange, 0x138))));
    let push = block_on(stream.push_all_on(&photons(1), &mut irq, &mut delay, PLENTY));
    let found = DeviceError { code: ErrorCode::IndexRange, address: 0x138 };
    assert_eq!(push.unwrap_err().cause, Cause::Device(found));
    stream.abort().unwrap();
    assert_eq!(lucerna.state(), State::Idle);
}

/// An update and an evaluation, all waiting on the pin.
async fn whole_job<B: Bus>(
    lucerna: &mut Lucerna<B, ModelDelay<'_, Fake>>,
    model: &Model<Fake>,
) -> Result<(), Error<B::Error>> {
    let (mut irq, mut delay) = (model.irq(), model.delay());
    let layout = layout(SIZES);
    let mut pree = lucerna.pree()?;
    let mut stream = pree.update(&update_job(&layout))?;
    stream.push_all_on(&photons(20), &mut irq, &mut delay, PLENTY).await?;
    stream.flush()?.done(&mut irq, &mut delay, PLENTY).await?;
    pree.evaluate(&evaluate_job(&layout))?.done(&mut irq, &mut delay, PLENTY).await
}

#[test]
fn a_fault_at_any_access_ends_the_wait_and_is_recoverable() {
    let clean = model(|_| {});
    let mut bus = Faulty::new(clean.bus(), Fault::Never);
    block_on(whole_job(&mut Lucerna::probe(&mut bus, clean.delay()).unwrap(), &clean)).unwrap();
    for (number, moment) in (6..bus.accesses()).flat_map(|n| [(n, Moment::Before), (n, Moment::After)]) {
        let model = model(|_| {});
        let bus = Faulty::new(model.bus(), Fault::Nth(number)).at(moment);
        let mut lucerna = Lucerna::probe(bus, model.delay()).unwrap();
        let error = block_on(whole_job(&mut lucerna, &model)).expect_err("an access failed");
        assert_eq!(error.cause, Cause::Bus(FaultyError::Injected), "access {number} {moment:?}");
        lucerna.recover().unwrap();
        assert!(model.irq().is_low().unwrap(), "access {number} {moment:?}");
        block_on(whole_job(&mut lucerna, &model)).unwrap();
    }
}

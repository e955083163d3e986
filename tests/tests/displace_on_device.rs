//! Does the driver bring a displacement unit through lists and cameras, through everything that goes wrong, and back?

use std::convert::Infallible;
use std::future::{Future, pending};
use std::pin::pin;
use std::task::{Context, Poll, Waker};

use embedded_hal::digital::ErrorType;
use embedded_hal_async::digital::Wait;
use lucerna_bus::{Bus, Fault, Faulty, FaultyError, Moment, Target, Timing};
use lucerna_driver::displace::{Buffer, ErrorCode, Ray, RayFaults, RayResult, RayStatus};
use lucerna_driver::{Cause, Deadline, DisplaceError, Lucerna, Progress, State};
use lucerna_regs::displace as regs;
use lucerna_tests::relief::{BOTH, PATIENCE, PIXELS, What};

/// Polls until it is ready. A model's futures wake themselves.
fn block_on<T>(future: impl Future<Output = T>) -> T {
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    for _ in 0..1_000_000 {
        if let Poll::Ready(output) = future.as_mut().poll(&mut context) {
            return output;
        }
    }
    panic!("it is never ready");
}

/// A camera over a plane, in world coordinates, sees what geometry says; so does a list.
#[test]
fn the_right_texels_are_hit() {
    for what in BOTH {
        let (mut hits, mut others) = (0, 0);
        for (record, (entry, direction)) in what.expected().iter().zip(what.exact()) {
            let on_surface = what == What::List || entry.iter().all(|at| (0.0..2.0).contains(at));
            assert_eq!(record[3] >> 24, u32::from(!on_surface), "{entry:?}");
            if on_surface {
                hits += 1;
                let texel = [record[0], record[1]].map(|index| i64::from(index as i32));
                others += u32::from(What::columns().march(entry, direction).texel != texel);
            }
        }
        assert!(hits > 100 && others <= 2, "{what:?}: {others} of {hits}");
    }
}

#[test]
fn blocking_polling_and_by_the_interrupt_it_is_the_same() {
    for what in BOTH {
        let expected = what.expected();
        let hits = expected.iter().filter(|record| record[3] >> 24 == 0).count();
        assert!(hits > 100, "{hits}");
        for timing in [Timing::Tick, Timing::Fast] {
            let model = what.model(timing);
            let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
            assert_eq!(what.run(&mut device).unwrap(), expected);
            let layout = what.prepare(&mut device).unwrap();
            let mut unit = device.displace().unwrap();
            let mut run = unit.start(&what.job(&layout)).unwrap();
            let mut done = 0;
            while run.poll().unwrap() == Progress::Running {
                assert!(run.rays_done().unwrap() >= done);
                done = run.rays_done().unwrap();
            }
            assert_eq!((run.poll(), run.rays_done()), (Ok(Progress::Done), Ok(PIXELS)));
            assert_eq!(what.read(&mut device, &layout).unwrap(), expected);

            let layout = what.prepare(&mut device).unwrap();
            let mut unit = device.displace().unwrap();
            let mut run = unit.start(&what.job(&layout)).unwrap();
            block_on(run.done(&mut model.irq(), &mut model.delay(), PATIENCE)).unwrap();
            assert_eq!(run.counters().unwrap().rays, 3 * u64::from(PIXELS), "they accumulate over jobs");
            assert!(!model.inspect(Target::interrupt), "nothing is pending");
            assert_eq!(what.read(&mut device, &layout).unwrap(), expected);
            assert_eq!(device.state(), State::Idle);
        }
    }
}

/// In the middle of it: aborted, waited for again, given up by its owner, found by the next.
#[test]
fn a_job_s_handle_may_be_lost_and_the_job_is_not() {
    for what in BOTH {
        let expected = what.expected();
        for pause in [0, 20, 150, 400] {
            let model = what.model(Timing::Fast);
            let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
            let layout = what.prepare(&mut device).unwrap();
            let job = what.job(&layout);
            let start = |device: &mut Lucerna<_, _>| {
                let mut unit = device.displace().unwrap();
                let mut run = unit.start(&job).unwrap();
                model.advance(pause);
                assert_eq!(run.poll(), Ok(Progress::Running));
            };
            assert_eq!(
                device.displace().unwrap().resume().map(|_| ()).expect_err("no job").cause,
                Cause::NoJob
            );
            // Dropped, and taken up.
            start(&mut device);
            assert_eq!(device.state(), State::Running);
            let refused = device.displace().unwrap().start(&job).map(|_| ()).expect_err("one job at a time");
            assert_eq!((refused.cause, refused.state), (Cause::NotReady, State::Running));
            device.displace().unwrap().resume().unwrap().wait(PATIENCE).unwrap();
            assert_eq!(what.read(&mut device, &layout).unwrap(), expected);
            // Aborted: idle, no interrupt, and the same job once more.
            start(&mut device);
            device.displace().unwrap().resume().unwrap().abort().unwrap();
            assert_eq!((device.state(), model.bus().read(regs::STATUS)), (State::Idle, Ok(0)));
            model.advance(100_000);
            assert!(!model.inspect(Target::interrupt));
            assert_eq!(what.run(&mut device).unwrap(), expected);
            // Another owner finds it running, and may wait for it just as well.
            start(&mut device);
            let _ = device.release();
            let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
            assert_eq!(device.state(), State::Running);
            let early = device
                .displace()
                .unwrap()
                .read_result_words(&layout, 0, &mut [[0; 8]])
                .expect_err("not done");
            assert_eq!(early.cause, Cause::NotReady);
            block_on(async {
                let mut unit = device.displace().unwrap();
                let mut run = unit.resume().unwrap();
                run.done(&mut model.irq(), &mut model.delay(), PATIENCE).await.unwrap();
            });
            assert_eq!(what.read(&mut device, &layout).unwrap(), expected);
        }
    }
}

/// A fault at every access, seen by the device or not: an error that says where it leaves the device, and after a recovery
/// everything is as if nothing had been.
#[test]
fn recovers_from_a_fault_at_any_access() {
    for what in BOTH {
        let expected = what.expected();
        let accesses = {
            let model = what.model(Timing::Fast);
            let mut bus = Faulty::new(model.bus(), Fault::Never);
            what.run(&mut Lucerna::probe(&mut bus, model.delay()).unwrap()).unwrap();
            bus.accesses()
        };
        assert!(accesses > 60, "{accesses}");
        for number in 0..accesses {
            for moment in [Moment::Before, Moment::After] {
                let model = what.model(Timing::Fast);
                let mut bus = Faulty::new(model.bus(), Fault::Nth(number)).at(moment);
                let Ok(mut device) = Lucerna::probe(&mut bus, model.delay()) else { continue };
                let context = format!("{what:?}, access {number} {moment:?}");
                let error = what.run(&mut device).expect_err(&context);
                assert_eq!(error.cause, Cause::Bus(FaultyError::Injected), "{context}");
                if matches!(error.state, State::Untouched | State::Idle) {
                    assert_eq!(
                        what.run(&mut device).as_ref(),
                        Ok(&expected),
                        "{context}: not as idle as it said"
                    );
                } else {
                    assert_eq!(what.run(&mut device).expect_err(&context).cause, Cause::NotReady);
                }
                device.recover().unwrap();
                assert_eq!(what.run(&mut device).as_ref(), Ok(&expected), "{context}");
            }
        }
    }
}

/// A line that was never soldered.
struct Unconnected;

impl ErrorType for Unconnected {
    type Error = Infallible;
}

impl Wait for Unconnected {
    async fn wait_for_high(&mut self) -> Result<(), Infallible> {
        pending().await
    }
    async fn wait_for_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
    async fn wait_for_rising_edge(&mut self) -> Result<(), Infallible> {
        pending().await
    }
    async fn wait_for_falling_edge(&mut self) -> Result<(), Infallible> {
        pending().await
    }
    async fn wait_for_any_edge(&mut self) -> Result<(), Infallible> {
        pending().await
    }
}

#[test]
fn too_little_time_and_a_lost_interrupt_lose_no_result() {
    for what in BOTH {
        let expected = what.expected();
        let model = what.model(Timing::Tick);
        let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
        let layout = what.prepare(&mut device).unwrap();
        {
            let mut unit = device.displace().unwrap();
            let mut run = unit.start(&what.job(&layout)).unwrap();
            for deadline in [Deadline::NOW, Deadline::micros(1), Deadline::micros(2)] {
                let error = run.wait(deadline).expect_err("it takes longer");
                assert_eq!((error.cause, error.state), (Cause::Timeout, State::Running));
            }
            let error =
                block_on(run.done(&mut Unconnected, &mut model.delay(), PATIENCE)).expect_err("no line");
            assert_eq!((error.cause, error.state), (Cause::LostInterrupt, State::Idle));
        }
        assert!(!model.inspect(Target::interrupt));
        assert_eq!(what.read(&mut device, &layout).unwrap(), expected);
    }
}

/// What the device finds reaches the caller with code, address and words; recovery brings it back.
#[test]
fn device_errors_are_explained() {
    let what = What::List;
    let expected = what.expected();
    let model = what.model(Timing::Fast);
    let mut device = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = what.prepare(&mut device).unwrap();
    let results = layout.region(Buffer::Results).base();
    let job = what.job(&layout).with_ray_faults(RayFaults::Stop);
    let upwards = Ray { entry: [0.5, 0.5], view: [0.0, 1.0, 0.0] };
    let provocations = [
        (ErrorCode::GrazingRay, job, Some(results + 32 * 7)),
        (ErrorCode::Watchdog, job.with_watchdog(1).expect("one step"), None),
    ];
    for (code, job, address) in provocations {
        if code == ErrorCode::GrazingRay {
            device.displace().unwrap().write_rays(&layout, 7, &[upwards]).unwrap();
        }
        let error = device
            .displace()
            .unwrap()
            .start(&job)
            .unwrap()
            .wait(PATIENCE)
            .expect_err("an error was provoked");
        let Cause::Displace(DisplaceError { code: found, address: at }) = error.cause else {
            panic!("{error}")
        };
        assert_eq!((found, error.state), (code, State::Faulted));
        assert!(address.is_none_or(|address| address == at) && (at - results).is_multiple_of(32));
        assert!(error.to_string().contains(&format!("{at:#x}")) && error.to_string().len() > 40, "{error}");
        device.recover().unwrap();
        assert_eq!(what.run(&mut device).unwrap(), expected);
    }
    // Recorded, it is no error.
    device.displace().unwrap().write_rays(&layout, 7, &[upwards]).unwrap();
    device.displace().unwrap().start(&what.job(&layout)).unwrap().wait(PATIENCE).unwrap();
    let mut result = [RayResult::default()];
    device.displace().unwrap().read_results(&layout, 7, &mut result).unwrap();
    assert_eq!((result[0].status, result[0].steps), (RayStatus::Grazing, 0));
    // Behind the driver's back, a register of the job is another's: refused by the device, with its address.
    model.bus().write(lucerna_regs::window::base(0), 0).unwrap();
    assert_eq!(what.run(&mut device).unwrap(), expected, "every job writes its own");
}

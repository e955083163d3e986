//! Is every failure of a displacement job an error that tells the truth, and does `recover` bring the device back? And
//! do the two units of a device leave each other alone?

mod common;

use std::collections::BTreeSet;
use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};

use common::NoDelay;
use common::displacer::{Displacer, SIZES, layout, list, model, raster, rays};
use embedded_hal::delay::DelayNs;
use lucerna_bus::Access::{self, Read, Write};
use lucerna_bus::{Bus, Fault, Faulty, FaultyError, Model, Moment, Scripted};
use lucerna_driver::displace::{Counters, ErrorCode, Image, Job, RayResult};
use lucerna_driver::{Cause, Deadline, DisplaceError, Error, Lucerna, Progress, State, Unit};
use lucerna_regs::displace::{self, Control};
use lucerna_regs::interrupts;

const PLENTY: Deadline = Deadline::millis(100);

/// Everything a driver does, once.
fn whole_job<B: Bus, D: DelayNs>(lucerna: &mut Lucerna<B, D>) -> Result<Counters, Error<B::Error>> {
    let layout = layout(SIZES);
    let mut displace = lucerna.displace()?;
    displace.clear_counters()?;
    let heights = [9; 64];
    displace.write_map(&layout, &Image::new(SIZES.map, &heights).unwrap())?;
    displace.write_texture_with(&layout, |_, _| 0)?;
    displace.write_normals_with(&layout, |_, _| 0)?;
    displace.write_rays(&layout, 0, &rays(4))?;
    for job in [list(&layout, 4), raster(&layout)] {
        displace.start(&job)?.wait(PLENTY)?;
        let mut results = [RayResult::default(); 4];
        displace.read_results(&layout, 0, &mut results)?;
        let wanted = [0, 1, 2, 3].map(|number: i32| ([number, !number], number as u16 + 1));
        assert_eq!(results.map(|result| (result.texel, result.steps)), wanted);
    }
    displace.counters()
}

#[test]
fn a_fault_at_any_access_is_an_error_and_recoverable() {
    let model_of_all = model(|_| {});
    let mut bus = Faulty::new(model_of_all.bus(), Fault::Never);
    whole_job(&mut Lucerna::probe(&mut bus, model_of_all.delay()).unwrap()).unwrap();
    let accesses = bus.accesses();
    assert!(accesses > 100, "the job is worth testing: {accesses}");
    let mut states = BTreeSet::new();
    for (number, moment) in (0..accesses).flat_map(|n| [(n, Moment::Before), (n, Moment::After)]) {
        let model = model(|_| {});
        let mut bus = Faulty::new(model.bus(), Fault::Nth(number)).at(moment);
        let mut lucerna = match Lucerna::probe(&mut bus, model.delay()) {
            Ok(lucerna) => lucerna,
            Err(error) => {
                assert!(number < 10, "the probe has ten accesses");
                assert_eq!((error.cause, error.state), (Cause::Bus(FaultyError::Injected), State::Untouched));
                continue;
            }
        };
        let error = whole_job(&mut lucerna).expect_err("an access failed");
        assert_eq!(error.cause, Cause::Bus(FaultyError::Injected), "access {number} {moment:?}");
        assert_eq!(error.state, lucerna.state());
        states.insert(format!("{}", error.state));
        if matches!(error.state, State::Untouched | State::Idle) {
            assert_eq!(model.inspect(Displacer::state), displace::State::Idle, "access {number} {moment:?}");
        }
        lucerna.recover().unwrap();
        assert_eq!(lucerna.state(), State::Idle);
        whole_job(&mut lucerna).unwrap_or_else(|error| panic!("access {number} {moment:?}: {error}"));
    }
    let states: Vec<_> = states.iter().map(String::as_str).collect();
    assert_eq!(states, ["device idle", "device running", "device state unknown"]);
}

#[test]
fn every_error_of_the_unit_is_told_and_recoverable() {
    for code in ErrorCode::ALL {
        if matches!(code, ErrorCode::None | ErrorCode::NotIdle) {
            continue;
        }
        for after in [0, 3] {
            let model = model(|fake| fake.error = Some((after, code, 0x180)));
            let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
            let error = whole_job(&mut lucerna).unwrap_err();
            assert_eq!(error.cause, Cause::Displace(DisplaceError { code, address: 0x180 }));
            assert_eq!((error.state, lucerna.state()), (State::Faulted, State::Faulted));
            lucerna.recover().unwrap();
            whole_job(&mut lucerna).unwrap();
        }
    }
}

#[test]
fn a_second_start_from_elsewhere_is_noticed() {
    let model = model(|_| {});
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut displace = lucerna.displace().unwrap();
    let mut run = displace.start(&list(&layout, 4)).unwrap();
    model.bus().write(displace::CONTROL, Control::default().with_start(true).bits()).unwrap();
    let error = run.poll().unwrap_err();
    let found = DisplaceError { code: ErrorCode::NotIdle, address: 0 };
    assert_eq!((error.cause, error.state), (Cause::Displace(found), State::Unknown));
    run.abort().unwrap();
    whole_job(&mut lucerna).unwrap();
}

#[test]
fn a_timeout_comes_at_its_time_and_the_job_can_be_waited_for_again() {
    let model = model(|fake| fake.asleep = true);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut displace = lucerna.displace().unwrap();
    let mut run = displace.start(&list(&layout, 4)).unwrap();
    let start = model.elapsed();
    let error = run.wait(Deadline::millis(5)).unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::Timeout, State::Running));
    let clocks = model.elapsed() - start;
    assert!((625_000..626_000).contains(&clocks), "5 ms are 625,000 clocks, not {clocks}");
    assert_eq!(run.rays_done(), Ok(0));
    model.tamper(|fake| fake.asleep = false);
    model.advance(20);
    assert!((2..4).contains(&run.rays_done().unwrap()), "8 clocks a ray");
    run.wait(PLENTY).unwrap();
    assert_eq!((run.rays_done(), run.counters().unwrap().rays), (Ok(4), 4));
}

#[test]
fn recovery_says_when_it_has_not_worked() {
    let model = model(|fake| (fake.asleep, fake.deaf) = (true, true));
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    whole_job(&mut lucerna).unwrap_err();
    let error = lucerna.recover().unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::Stuck, State::Unknown));
    model.tamper(|fake| *fake = Displacer::default());
    lucerna.recover().unwrap();
    whole_job(&mut lucerna).unwrap();
}

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

fn awaited(model: &Model<Displacer>, job: &Job) -> (Result<(), Cause<lucerna_bus::TargetError>>, State, u64) {
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let mut displace = lucerna.displace().unwrap();
    let mut run = displace.start(job).unwrap();
    let start = model.elapsed();
    let outcome = block_on(run.done(&mut model.irq(), &mut model.delay(), PLENTY));
    (outcome.map_err(|error| error.cause), lucerna.state(), model.elapsed() - start)
}

#[test]
fn the_interrupt_ends_the_wait_at_once() {
    let job = list(&layout(SIZES), 4);
    let slow = model(|fake| fake.pace = 1000);
    let (outcome, state, clocks) = awaited(&slow, &job);
    assert_eq!((outcome, state), (Ok(()), State::Idle));
    assert!((3_900..4_700).contains(&clocks), "4 rays of 1,000 clocks took {clocks}");
    assert_eq!(slow.inspect(|fake| fake.get(interrupts::ENABLE)), 0, "the line is given back");
    assert_eq!(slow.inspect(|fake| fake.get(interrupts::STATUS)), 0);

    let failing = model(|fake| fake.error = Some((2, ErrorCode::GrazingRay, 0x1C0)));
    let (outcome, state, clocks) = awaited(&failing, &job);
    let found = DisplaceError { code: ErrorCode::GrazingRay, address: 0x1C0 };
    assert_eq!((outcome, state), (Err(Cause::Displace(found)), State::Faulted));
    assert!(clocks < 1000);

    let cut = model(|fake| fake.cut = true);
    let (outcome, state, _) = awaited(&cut, &job);
    assert_eq!((outcome, state), (Err(Cause::LostInterrupt), State::Idle));
    let asleep = model(|fake| fake.asleep = true);
    let (outcome, state, _) = awaited(&asleep, &job);
    assert_eq!((outcome, state), (Err(Cause::Timeout), State::Running));
}

#[test]
fn a_driver_just_started_takes_up_the_job_it_finds() {
    let layout = layout(SIZES);
    let model = model(|_| {});
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let _ = lucerna.displace().unwrap().start(&list(&layout, 4)).unwrap();

    let mut next = Lucerna::probe(model.bus(), model.delay()).unwrap();
    assert_eq!((next.state(), next.unit()), (State::Running, Unit::Displace));
    let mut displace = next.displace().unwrap();
    assert_eq!(displace.write_rays(&layout, 0, &rays(1)).unwrap_err().cause, Cause::NotReady);
    let mut run = displace.resume().unwrap();
    assert_eq!(run.poll(), Ok(Progress::Running));
    run.wait(PLENTY).unwrap();
    whole_job(&mut next).unwrap();
    // One that found its end instead.
    model.tamper(|fake| fake.error = Some((1, ErrorCode::Window, 0x80)));
    let _ = next.displace().unwrap().start(&list(&layout, 4)).unwrap();
    model.advance(100);
    let mut last = Lucerna::probe(model.bus(), model.delay()).unwrap();
    assert_eq!(last.state(), State::Faulted);
    assert_eq!(last.displace().unwrap().resume().unwrap_err().cause, Cause::NotReady);
    last.recover().unwrap();
    whole_job(&mut last).unwrap();
}

/// A probe of a device with both units, in these states.
fn both(pree: u32, displace: u32) -> [Access<'static>; 11] {
    [
        Read(0x000, 0x4C55_4352),
        Read(0x004, 0x0001_0001),
        Read(0x008, 0x0003_4008),
        Read(0x00C, 0x0001_0C0A),
        Read(0x010, 64 * 1024),
        Read(0x3C0, 0x0028_0F01),
        Read(0x3C4, 0x0020_040E),
        Read(0x3C8, 0x0020_040E),
        Read(0x3CC, 0x0008_1010),
        Read(0x108, pree),
        Read(0x308, displace),
    ]
}

#[test]
fn a_probe_of_both_units_knows_which_one_runs() {
    let cases = [
        (0, 0, State::Idle, None),
        (1, 0, State::Running, Some(Unit::Pree)),
        (0, 1, State::Running, Some(Unit::Displace)),
        (2, 0, State::Faulted, Some(Unit::Pree)),
        (0, 2, State::Faulted, Some(Unit::Displace)),
        (1, 1, State::Unknown, None),
        (2, 1, State::Unknown, None),
        (0, 3, State::Unknown, None),
    ];
    for (pree, displace, state, unit) in cases {
        let script = both(pree, displace);
        let mut lucerna = Lucerna::probe(Scripted::new(&script), NoDelay).unwrap();
        assert_eq!(lucerna.state(), state, "{pree} {displace}");
        if let Some(unit) = unit {
            assert_eq!(lucerna.unit(), unit);
        }
        // The other unit's handle cannot take it up.
        let cause = if state == State::Idle { Cause::NoJob } else { Cause::NotReady };
        if unit != Some(Unit::Displace) || state != State::Running {
            assert_eq!(lucerna.displace().unwrap().resume().unwrap_err().cause, cause);
        }
        if unit != Some(Unit::Pree) || state != State::Running {
            assert_eq!(lucerna.pree().unwrap().resume().unwrap_err().cause, cause);
        }
    }
}

#[test]
fn recovery_ends_the_jobs_of_both_units() {
    let mut script = both(1, 1).to_vec();
    script.extend([
        Read(0x000, 0x4C55_4352),
        Write(0x100, 4),
        Write(0x300, 2),
        Write(0x044, 0),
        Write(0x040, 0x1F),
        Read(0x108, 0),
        Read(0x308, 0),
    ]);
    let mut bus = Scripted::new(&script);
    let mut lucerna = Lucerna::probe(&mut bus, NoDelay).unwrap();
    lucerna.recover().unwrap();
    assert_eq!(lucerna.state(), State::Idle);
    bus.finish().unwrap();
    // One of them does not stop.
    let last = script.len() - 1;
    script[last] = Read(0x308, 1);
    let mut bus = Scripted::new(&script);
    let error = Lucerna::probe(&mut bus, NoDelay).unwrap().recover().unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::Stuck, State::Unknown));
    bus.finish().unwrap();
}

//! Is every failure an error that tells the truth about the device, and does `recover` bring it back?

mod common;

use std::collections::BTreeSet;

use common::{Fake, SIZES, evaluate_job, hit_points, layout, model, photons, update_job};
use embedded_hal::delay::DelayNs;
use lucerna_bus::{Bus, Fault, Faulty, FaultyError, Model, Moment, TargetError};
use lucerna_driver::{
    Cause, Counters, Deadline, DeviceError, DisplaceError, Error, ErrorCode, Lucerna, Progress, Resumed,
    State, displace,
};
use lucerna_regs::ident;
use lucerna_regs::pree::{self, Control};

const PLENTY: Deadline = Deadline::millis(100);
const PIXELS: [[f32; 3]; 2] = [[1.5, 3.0, 6.0], [5.5, 11.0, 22.0]];

/// Everything a driver does, once; more photons than the ring holds.
fn whole_job<B: Bus, D: DelayNs>(lucerna: &mut Lucerna<B, D>) -> Result<Counters, Error<B::Error>> {
    let layout = layout(SIZES);
    let mut pree = lucerna.pree()?;
    pree.clear_counters()?;
    pree.write_hit_points(&layout, 0, &hit_points())?;
    pree.write_index(&layout, 0, &[0, 1, 2, 3])?;
    pree.zero_pixels(&layout)?;
    let mut stream = pree.update(&update_job(&layout))?;
    stream.push_all(&photons(40), PLENTY)?;
    stream.finish(PLENTY)?;
    pree.evaluate(&evaluate_job(&layout))?.wait(PLENTY)?;
    let mut pixels = [[0.0; 3]; 2];
    pree.read_pixels(&layout, 0, &mut pixels)?;
    assert_eq!(pixels, PIXELS);
    pree.counters()
}

fn accesses_of_a_job() -> u64 {
    let model = model(|_| {});
    let mut bus = Faulty::new(model.bus(), Fault::Never);
    whole_job(&mut Lucerna::probe(&mut bus, model.delay()).unwrap()).unwrap();
    bus.accesses()
}

#[test]
fn a_fault_at_any_access_is_an_error_and_recoverable() {
    let accesses = accesses_of_a_job();
    assert!(accesses > 100, "the job is worth testing: {accesses}");
    let mut states = BTreeSet::new();
    for (number, moment) in (0..accesses).flat_map(|n| [(n, Moment::Before), (n, Moment::After)]) {
        let model = model(|_| {});
        let mut bus = Faulty::new(model.bus(), Fault::Nth(number)).at(moment);
        let mut lucerna = match Lucerna::probe(&mut bus, model.delay()) {
            Ok(lucerna) => lucerna,
            Err(error) => {
                assert!(number < 6, "the probe has six accesses");
                assert_eq!(error.cause, Cause::Bus(FaultyError::Injected));
                continue;
            }
        };
        let error = whole_job(&mut lucerna).expect_err("an access failed");
        assert_eq!(error.cause, Cause::Bus(FaultyError::Injected), "access {number} {moment:?}");
        assert_eq!(error.state, lucerna.state());
        states.insert(format!("{}", error.state));
        if matches!(error.state, State::Untouched | State::Idle) {
            assert_eq!(model.inspect(Fake::state), pree::State::Idle, "access {number} {moment:?}");
        }
        lucerna.recover().unwrap();
        assert_eq!(lucerna.state(), State::Idle);
        whole_job(&mut lucerna).unwrap_or_else(|error| panic!("access {number} {moment:?}: {error}"));
    }
    let states: Vec<_> = states.iter().map(String::as_str).collect();
    assert_eq!(states, ["device idle", "device running", "device state unknown"]);
}

#[test]
fn a_bus_gone_for_good_fails_recovery_too_and_a_new_probe_finds_the_device_as_it_is() {
    let mut found = BTreeSet::new();
    for number in 6..accesses_of_a_job() {
        let model = model(|_| {});
        let mut lucerna =
            Lucerna::probe(Faulty::new(model.bus(), Fault::From(number)), model.delay()).unwrap();
        whole_job(&mut lucerna).unwrap_err();
        lucerna.recover().unwrap_err();
        let (mut bus, delay) = lucerna.release();
        bus.plan(Fault::Never);
        let mut lucerna = Lucerna::probe(bus, delay).unwrap();
        found.insert(format!("{}", lucerna.state()));
        if lucerna.state() != State::Idle {
            let error = whole_job(&mut lucerna).unwrap_err();
            assert_eq!(error.cause, Cause::NotReady);
        }
        lucerna.recover().unwrap();
        whole_job(&mut lucerna).unwrap();
    }
    let found: Vec<_> = found.iter().map(String::as_str).collect();
    assert_eq!(found, ["device idle", "device running"]);
}

#[test]
fn a_failed_read_does_not_end_the_job() {
    let model = model(|_| {});
    let layout = layout(SIZES);
    // Six reads of the probe, 20 writes of the job; then the first poll.
    let bus = Faulty::new(model.bus(), Fault::Nth(26));
    let mut lucerna = Lucerna::probe(bus, model.delay()).unwrap();
    let mut pree = lucerna.pree().unwrap();
    let mut run = pree.evaluate(&evaluate_job(&layout)).unwrap();
    let error = run.poll().unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::Bus(FaultyError::Injected), State::Running));
    run.wait(PLENTY).unwrap();
}

#[test]
fn every_error_of_the_device_is_told_and_recoverable() {
    for code in ErrorCode::ALL {
        if matches!(code, ErrorCode::None | ErrorCode::NotIdle) {
            continue;
        }
        for after in [0, 3, 20] {
            let model = model(|fake| fake.error = Some((after, code, 0x120)));
            let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
            let error = whole_job(&mut lucerna).unwrap_err();
            assert_eq!(error.cause, Cause::Device(DeviceError { code, address: 0x120 }));
            assert_eq!((error.state, lucerna.state()), (State::Faulted, State::Faulted));
            lucerna.recover().unwrap();
            whole_job(&mut lucerna).unwrap();
        }
    }
}

#[test]
fn a_full_ring_of_a_faulted_device_is_an_error_and_not_full() {
    let model = model(|fake| fake.error = Some((0, ErrorCode::HitRange, 0x104)));
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    assert_eq!(stream.push(&photons(8)), Ok(8));
    let error = stream.push(&photons(1)).unwrap_err();
    assert_eq!(error.cause, Cause::Device(DeviceError { code: ErrorCode::HitRange, address: 0x104 }));
    assert_eq!(stream.poll().unwrap_err().cause, Cause::NotReady);
    assert_eq!(stream.push(&photons(1)).unwrap_err().cause, Cause::NotReady);
    stream.abort().unwrap();
    whole_job(&mut lucerna).unwrap();
}

#[test]
fn a_second_start_from_elsewhere_is_noticed() {
    let model = model(|_| {});
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    model.bus().write(pree::CONTROL, Control::default().with_start(true).bits()).unwrap();
    let error = stream.poll().unwrap_err();
    assert_eq!(error.cause, Cause::Device(DeviceError { code: ErrorCode::NotIdle, address: 0 }));
    assert_eq!(error.state, State::Unknown);
    assert_eq!(stream.flush().unwrap_err().cause, Cause::NotReady);
    lucerna.recover().unwrap();
    whole_job(&mut lucerna).unwrap();
}

/// Runs to the deadline against a device that does not get on.
fn timed_out(model: &Model<Fake>, act: impl FnOnce() -> Error<TargetError>) {
    let start = model.elapsed();
    let error = act();
    assert_eq!((error.cause, error.state), (Cause::Timeout, State::Running));
    let clocks = model.elapsed() - start;
    assert!((625_000..626_000).contains(&clocks), "5 ms are 625,000 clocks, not {clocks}");
}

#[test]
fn a_timeout_comes_at_its_time_and_the_job_can_be_waited_for_again() {
    let model = model(|fake| fake.asleep = true);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    timed_out(&model, || stream.push_all(&photons(9), Deadline::millis(5)).unwrap_err());
    assert_eq!(stream.pushed(), 8, "what fitted is in the ring");
    let mut run = stream.flush().unwrap();
    timed_out(&model, || run.wait(Deadline::millis(5)).unwrap_err());
    assert_eq!(run.poll(), Ok(Progress::Running));
    model.tamper(|fake| fake.asleep = false);
    run.wait(PLENTY).unwrap();
    assert_eq!(model.inspect(|fake| fake.taken.len()), 8);
}

#[test]
fn after_a_timeout_recovery_ends_the_job() {
    let model = model(|fake| fake.asleep = true);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let error = whole_job(&mut lucerna).unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::Timeout, State::Running));
    model.tamper(|fake| fake.asleep = false);
    lucerna.recover().unwrap();
    whole_job(&mut lucerna).unwrap();
}

#[test]
fn a_head_that_cannot_be_is_an_overrun() {
    // Eight records were announced and none was taken, then seven; then one more was announced.
    for (taken, head, announced) in [(None, 100, 8), (None, 9, 8), (None, u32::MAX, 8), (Some(7), 5, 9)] {
        let model = model(|fake| fake.pace = u64::MAX);
        let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
        let layout = layout(SIZES);
        let mut pree = lucerna.pree().unwrap();
        let mut stream = pree.update(&update_job(&layout)).unwrap();
        assert_eq!(stream.push(&photons(8)), Ok(8));
        if let Some(taken) = taken {
            model.tamper(|fake| fake.set(pree::RING_HEAD, taken));
            assert_eq!(stream.push(&photons(1)), Ok(1));
        }
        model.tamper(|fake| fake.set(pree::RING_HEAD, head));
        let error = stream.push(&photons(8)).unwrap_err();
        let cause = Cause::RingOverrun { head, tail: announced };
        assert_eq!((error.cause, error.state), (cause, State::Unknown));
        assert_eq!(stream.push(&photons(1)).unwrap_err().cause, Cause::NotReady);
        stream.abort().unwrap();
        model.tamper(|fake| fake.pace = 8);
        whole_job(&mut lucerna).unwrap();
    }
}

#[test]
fn a_tail_written_from_elsewhere_is_an_overrun_the_device_finds() {
    let model = model(|_| {});
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let stream = pree.update(&update_job(&layout)).unwrap();
    model.bus().write(pree::RING_TAIL, 9).unwrap();
    let error = stream.finish(PLENTY).unwrap_err();
    assert_eq!(error.cause, Cause::Device(DeviceError { code: ErrorCode::RingOverrun, address: 0 }));
    assert_eq!(error.state, State::Faulted);
    lucerna.recover().unwrap();
    whole_job(&mut lucerna).unwrap();
}

#[test]
fn a_driver_just_started_takes_up_the_job_it_finds() {
    let layout = layout(SIZES);
    let model = model(|_| {});
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let all = photons(40);
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    stream.push_all(&all[..20], PLENTY).unwrap();

    let mut next = Lucerna::probe(model.bus(), model.delay()).unwrap();
    assert_eq!(next.state(), State::Running);
    let mut pree = next.pree().unwrap();
    let Resumed::Stream(mut stream) = pree.resume().unwrap() else { panic!("it takes photons") };
    assert_eq!(stream.pushed(), 20);
    stream.push_all(&all[20..], PLENTY).unwrap();
    stream.finish(PLENTY).unwrap();
    assert_eq!(model.inspect(|fake| fake.taken.len()), 40);
    assert!((0..40).all(|number| model.inspect(|fake| fake.taken[number][0]) == (number as f32).to_bits()));
    whole_job(&mut next).unwrap();
}

#[test]
fn a_device_reset_under_a_job_is_not_taken_for_done() {
    let model = model(|fake| fake.asleep = true);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut run = pree.evaluate(&evaluate_job(&layout)).unwrap();
    model.tamper(|fake| *fake = Fake::default());
    assert_eq!(run.wait(Deadline::millis(1)).unwrap_err().cause, Cause::Timeout);
    run.abort().unwrap();
    whole_job(&mut lucerna).unwrap();
}

#[test]
fn recovery_says_when_it_has_not_worked() {
    let model = model(|fake| (fake.asleep, fake.deaf) = (true, true));
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    whole_job(&mut lucerna).unwrap_err();
    let error = lucerna.recover().unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::Stuck, State::Unknown));
    assert_eq!(whole_job(&mut lucerna).unwrap_err().cause, Cause::NotReady);
    // A dead device reads as zeros, which would say "idle".
    model.tamper(|fake| fake.set(ident::ID, 0));
    assert_eq!(lucerna.recover().unwrap_err().cause, Cause::WrongDevice { id: 0 });
    model.tamper(|fake| *fake = Fake::default());
    lucerna.recover().unwrap();
    whole_job(&mut lucerna).unwrap();
}

#[test]
fn a_bus_of_ones_is_nonsense_and_not_an_error_of_the_device() {
    let model = model(|fake| fake.asleep = true);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut run = pree.evaluate(&evaluate_job(&layout)).unwrap();
    model.tamper(|fake| fake.registers.fill(u32::MAX));
    let error = run.poll().unwrap_err();
    let cause = Cause::Nonsense { offset: pree::ERROR, bits: u32::MAX };
    assert_eq!((error.cause, error.state), (cause, State::Unknown));
}

#[test]
fn every_message_is_a_sentence_with_advice_and_the_state() {
    let device = |code| Cause::Device(DeviceError { code, address: 0x40 });
    let mut causes: Vec<Cause<TargetError>> = ErrorCode::ALL.iter().map(|code| device(*code)).collect();
    let displace = |code| Cause::Displace(DisplaceError { code, address: 0x40 });
    causes.extend(displace::ErrorCode::ALL.iter().map(|code| displace(*code)));
    causes.extend([
        Cause::NoJob,
        Cause::WrongShape,
        Cause::Bus(TargetError::Unmapped),
        Cause::WrongDevice { id: 0 },
        Cause::WrongVersion { major: 2, minor: 0 },
        Cause::Nonsense { offset: 8, bits: 9 },
        Cause::NoUnit,
        Cause::NotReady,
        Cause::ForeignLayout,
        Cause::OutsideBuffer,
        Cause::BadReference { position: 3 },
        Cause::Timeout,
        Cause::LostInterrupt,
        Cause::Pin,
        Cause::RingOverrun { head: 2, tail: 1 },
        Cause::Stuck,
    ]);
    let texts: BTreeSet<String> =
        causes.iter().map(|cause| Error { cause: *cause, state: State::Unknown }.to_string()).collect();
    assert_eq!(texts.len(), causes.len(), "no two causes read the same");
    for text in texts {
        assert!(text.ends_with(" (device state unknown)"), "{text}");
        assert!(text.contains([':', ',']), "what, then what to do: {text}");
        assert!(!text.contains('\n'), "{text}");
    }
}

//! Does a displacement job run, end, stop and count as its registers' descriptions say? In: a job of twenty rays.

mod common;

use common::*;
use lucerna_bus::Target;
use lucerna_regs::displace::{self as regs, Config, Control, ErrorCode, RayFaults, State};
use lucerna_regs::displace_counters::{self as counters, Counter};
use lucerna_regs::{REGISTERS, interrupts, pree, window};

/// More cycles than any of these jobs takes.
const LONG: u64 = 1_000_000;

fn count(device: &mut Both, counter: Counter) -> u64 {
    write(device, counters::CONTROL, counters::Control::default().with_snapshot(true).bits());
    let low = read(device, counter.low());
    u64::from(read(device, counter.high())) << 32 | u64::from(low)
}

fn results(device: &Both) -> Vec<u32> {
    let mut words = vec![0; COUNT as usize * 8];
    device.load(RESULTS, &mut words).expect("in memory");
    words
}

fn done(units: u32) -> Both {
    let mut device = ready(units);
    start(&mut device);
    device.advance(LONG);
    assert_eq!((state(&mut device), error(&mut device)), (State::Idle, (ErrorCode::None, 0)));
    device
}

/// Makes ray `number` go up, away from the surface.
fn turn_up(device: &mut Both, number: u32) {
    device.store(RAYS + number * 32 + 16, &[1f32.to_bits()]).expect("in memory");
}

fn stopping(device: &mut Both) {
    write(device, regs::CONFIG, Config::RESET.with_ray_faults(RayFaults::Stop).bits());
}

#[test]
fn a_job_runs_and_is_done() {
    let mut device = ready(1);
    let enable = interrupts::Enable::default().with_displace_done(true);
    write(&mut device, interrupts::ENABLE, enable.bits());
    start(&mut device);
    assert_eq!((state(&mut device), read(&mut device, regs::RAYS_DONE)), (State::Running, 0));
    let mut before = 0;
    while state(&mut device) == State::Running {
        assert!(!device.interrupt());
        device.advance(7);
        let done = read(&mut device, regs::RAYS_DONE);
        assert!(done >= before && done <= COUNT);
        before = done;
    }
    assert_eq!(before, COUNT);
    assert!(device.interrupt());
    assert_eq!(raised(&mut device), interrupts::Status::default().with_displace_done(true));
    write(&mut device, interrupts::STATUS, u32::MAX);
    device.advance(LONG);
    assert!(!device.interrupt(), "an idle unit raises nothing");

    // Every ray has a record: a hit with a colour, at its own place.
    for record in results(&device).as_chunks::<8>().0 {
        assert_eq!(record[3] >> 24, 0, "{record:x?}");
        assert_ne!(record[4], 0, "{record:x?}");
        assert!(record[3] & 0xFFFF > 0 && record[7] == 0, "{record:x?}");
    }
    for (counter, expected) in [
        (Counter::Rays, COUNT),
        (Counter::Hits, COUNT),
        (Counter::Missed, 0),
        (Counter::Grazing, 0),
        (Counter::Watchdogs, 0),
        (Counter::StartPasses, COUNT),
        (Counter::ResultBytes, COUNT * 32),
        (Counter::Folds, 0),
    ] {
        assert_eq!(count(&mut device, counter), u64::from(expected), "{}", counter.name());
    }
    let steps: u32 = results(&device).as_chunks::<8>().0.iter().map(|record| record[3] & 0xFFFF).sum();
    assert_eq!(count(&mut device, Counter::Steps), u64::from(steps));
    // The same rays at the same time on two instances: the same bits, sooner.
    let mut two = done(2);
    assert_eq!(results(&device), results(&two));
    assert!(count(&mut two, Counter::Cycles) < count(&mut device, Counter::Cycles));
}

#[test]
fn a_list_of_no_ray_is_done_in_the_next_cycle() {
    let mut device = ready(1);
    write(&mut device, regs::RAY_COUNT, 0);
    start(&mut device);
    assert_eq!(state(&mut device), State::Running);
    let mut slow = device.clone();
    slow.tick();
    device.advance(LONG);
    for device in [&mut device, &mut slow] {
        assert_eq!((state(device), count(device, Counter::Cycles)), (State::Idle, 1));
        assert!(raised(device).displace_done());
    }
}

#[test]
fn counts_stand_still_in_the_snapshot_and_add_up_over_jobs() {
    let mut device = done(1);
    let cycles = count(&mut device, Counter::Cycles);
    start(&mut device);
    device.advance(LONG);
    assert_eq!(u64::from(read(&mut device, Counter::Cycles.low())), cycles, "no new snapshot");
    assert_eq!(count(&mut device, Counter::Cycles), 2 * cycles);
    let both = counters::Control::default().with_snapshot(true).with_clear(true);
    write(&mut device, counters::CONTROL, both.bits());
    assert_eq!(u64::from(read(&mut device, Counter::Cycles.low())), 2 * cycles, "taken, then cleared");
    assert_eq!(count(&mut device, Counter::Cycles), 0);
}

#[test]
fn not_idle_lets_the_job_run() {
    let expected = results(&done(1));
    let mut device = ready(1);
    start(&mut device);
    device.advance(50);
    start(&mut device);
    assert_eq!((state(&mut device), error(&mut device)), (State::Running, (ErrorCode::NotIdle, 0)));
    assert!(raised(&mut device).displace_error());
    device.advance(LONG);
    assert_eq!((state(&mut device), error(&mut device)), (State::Idle, (ErrorCode::NotIdle, 0)));
    assert_eq!(results(&device), expected);
}

#[test]
fn not_idle_gives_way_to_what_ends_the_job() {
    let mut device = ready(1);
    stopping(&mut device);
    turn_up(&mut device, COUNT - 1);
    start(&mut device);
    start(&mut device);
    assert_eq!(error(&mut device).0, ErrorCode::NotIdle);
    device.advance(LONG);
    assert_eq!(error(&mut device), (ErrorCode::GrazingRay, RESULTS + (COUNT - 1) * 32));
}

#[test]
fn grazing_rays_are_recorded_or_stop_the_job() {
    let mut device = ready(1);
    turn_up(&mut device, 5);
    start(&mut device);
    device.advance(LONG);
    assert_eq!((state(&mut device), count(&mut device, Counter::Grazing)), (State::Idle, 1));
    assert_eq!(results(&device)[5 * 8 + 3] >> 24, 2);

    let mut device = ready(1);
    stopping(&mut device);
    turn_up(&mut device, 5);
    start(&mut device);
    device.advance(LONG);
    assert_eq!(
        (state(&mut device), error(&mut device)),
        (State::Fault, (ErrorCode::GrazingRay, RESULTS + 5 * 32))
    );
    let raised = raised(&mut device);
    assert!(raised.displace_error() && !raised.displace_done());
}

#[test]
fn the_watchdog_is_recorded_or_stops_the_job() {
    let mut device = ready(1);
    write(&mut device, regs::WATCHDOG, 1);
    start(&mut device);
    device.advance(LONG);
    assert_eq!(state(&mut device), State::Idle);
    let barked = count(&mut device, Counter::Watchdogs);
    assert!(barked > 0);
    let recorded = results(&device).as_chunks::<8>().0.iter().filter(|record| record[3] >> 24 == 3).count();
    assert_eq!(recorded as u64, barked);

    let mut device = ready(1);
    stopping(&mut device);
    write(&mut device, regs::WATCHDOG, 1);
    start(&mut device);
    device.advance(LONG);
    let (code, address) = error(&mut device);
    assert_eq!((state(&mut device), code), (State::Fault, ErrorCode::Watchdog));
    assert!((RESULTS..RESULTS + COUNT * 32).step_by(32).any(|record| record == address), "{address:#x}");
}

#[test]
fn what_an_abort_drops_never_arrives() {
    for cycles in [0, 1, 30, 100, 150, 200, 300] {
        let mut device = ready(1);
        start(&mut device);
        device.advance(cycles);
        assert_eq!(state(&mut device), State::Running, "{cycles}");
        let written = results(&device);
        abort(&mut device);
        assert_eq!(state(&mut device), State::Idle);
        device.advance(LONG);
        assert_eq!(results(&device), written, "aborted after {cycles}");
        assert_eq!(read(&mut device, interrupts::STATUS), 0);
        // Together with START: the job from its beginning.
        start(&mut device);
        device.advance(cycles);
        let again = Control::default().with_abort(true).with_start(true);
        write(&mut device, regs::CONTROL, again.bits());
        assert_eq!((state(&mut device), error(&mut device)), (State::Running, (ErrorCode::None, 0)));
        assert_eq!(read(&mut device, regs::RAYS_DONE), 0);
        device.advance(LONG);
        assert_eq!(results(&device), results(&done(1)));
    }
}

/// START latches everything: what is written after it is the next job's.
#[test]
fn a_running_job_is_not_disturbed() {
    let mut quiet = done(1);
    let mut device = ready(1);
    start(&mut device);
    for (number, register) in (0u32..).zip(&REGISTERS) {
        let harmless = matches!(register.offset, regs::CONTROL | counters::CONTROL | pree::CONTROL);
        if register.writable != 0 && !harmless {
            write(&mut device, register.offset, number.wrapping_mul(0x9E37_79B9));
        }
        device.advance(3);
    }
    device.advance(LONG);
    assert_eq!(state(&mut device), State::Idle);
    assert_eq!(results(&device), results(&quiet));
    for counter in Counter::ALL {
        assert_eq!(count(&mut device, counter), count(&mut quiet, counter), "{}", counter.name());
    }
}

/// Two units at work at once: each does what it does alone, and `advance` what ticks do.
#[test]
fn units_side_by_side_do_what_they_do_alone() {
    let update = |device: &mut Both| {
        write(device, window::base(1), 0x2000);
        write(device, window::limit(1), 0x2400);
        // Forty evaluations of one hit point each, into one pixel each.
        for (offset, value) in [
            (pree::HIT_BASE, 0x2000),
            (pree::HIT_COUNT, 8),
            (pree::PIXEL_BASE, 0x2200),
            (pree::PIXEL_COUNT, 1),
            (pree::EMITTED, 1f32.to_bits()),
            (pree::CONFIG, pree::Config::RESET.with_mode(pree::Mode::Evaluate).bits()),
        ] {
            write(device, offset, value);
        }
        for hit in 0..8 {
            let flux = [3f32.to_bits(), 0, 0, 1f32.to_bits()];
            device.store(0x2000 + hit * 64 + 36, &flux).expect("in memory");
        }
        write(device, pree::CONTROL, pree::Control::default().with_start(true).bits());
    };
    let pixel = |device: &Both| device.memory()[0x2200 / 4];
    let mut pree = ready(1);
    update(&mut pree);
    pree.advance(LONG);
    assert_ne!(pixel(&pree), 0);
    let mut displace = done(1);

    for pause in [0, 1, 5, 100] {
        let mut device = ready(1);
        start(&mut device);
        device.advance(pause);
        update(&mut device);
        let mut slow = device.clone();
        for cycles in [1, 2, 3, 10, 11, 70, 300] {
            device.advance(cycles);
            (0..cycles).for_each(|_| slow.tick());
            assert!(device.memory() == slow.memory() && raised(&mut device) == raised(&mut slow));
            assert_eq!(read(&mut device, regs::RAYS_DONE), read(&mut slow, regs::RAYS_DONE));
        }
        device.advance(LONG);
        assert_eq!(
            raised(&mut device),
            interrupts::Status::default().with_done(true).with_displace_done(true)
        );
        assert_eq!((pixel(&device), results(&device)), (pixel(&pree), results(&displace)));
        for counter in Counter::ALL {
            assert_eq!(count(&mut device, counter), count(&mut displace, counter), "{}", counter.name());
        }
    }
}

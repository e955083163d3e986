//! Is fast-forward the same device as clock after clock, and does the host's pace change nothing but the starved cycles?

use lucerna_bus::Target;
use lucerna_regs::counters::Counter;
use lucerna_regs::pree::{self, Mode, State};
use lucerna_regs::{interrupts, window};
use lucerna_tests::devices::Any;
use lucerna_tests::job::{self, Job, differences, visible};
use lucerna_tests::random::{Rng, Shape, shapes};
use proptest::prelude::*;

/// Lets `cycles` pass in random portions, each ticked or advanced.
fn mixed(device: &mut Any, mut cycles: u64, rng: &mut Rng) {
    while cycles > 0 {
        let portion = match rng.below(3) {
            0 => 1,
            1 => 1 + u64::from(rng.below(12)).min(cycles - 1),
            _ => cycles,
        };
        match rng.once_in(3) {
            true => (0..portion).for_each(|_| device.tick()),
            false => device.advance(portion),
        }
        cycles -= portion;
    }
}

/// How long a host leaves the device alone: mostly briefly.
fn pause(rng: &mut Rng) -> u64 {
    match rng.below(8) {
        0 => 0,
        1..4 => 1,
        4..6 => 1 + u64::from(rng.below(20)),
        6 => 1 + u64::from(rng.below(300)),
        _ => 2000,
    }
}

/// The same host on two devices, one ticked, one not: equal after every step.
fn in_lockstep(job: &Job, pace: u64) -> Result<Any, String> {
    let (mut truth, mut fast) = (job.device(), job.device());
    let mut rng = Rng(pace);
    let words = job.bases().end as usize / 4;
    for mode in [Mode::Update, Mode::Evaluate] {
        job.start(&mut truth, mode);
        job.start(&mut fast, mode);
        let mut pushed = 0;
        for step in 0..3_000 {
            if mode == Mode::Update {
                let at_most = rng.below(9);
                let flush = pushed == job.photons.len() && rng.once_in(2);
                let count = job.push(&mut truth, at_most);
                assert_eq!(job.push(&mut fast, at_most), count);
                pushed += count as usize;
                if flush {
                    job::flush(&mut truth);
                    job::flush(&mut fast);
                }
            }
            if rng.once_in(40) {
                let clear = rng.word();
                job::write(&mut truth, interrupts::STATUS, clear);
                job::write(&mut fast, interrupts::STATUS, clear);
            }
            let cycles = pause(&mut rng);
            (0..cycles).for_each(|_| truth.tick());
            mixed(&mut fast, cycles, &mut rng);
            let views = (visible(&mut truth, words), visible(&mut fast, words));
            if views.0 != views.1 {
                return Err(format!("{mode:?}, step {step}:\n{}", differences(&views.0, &views.1)));
            }
            if job::state(&mut truth) != State::Running {
                break;
            }
        }
        if job::state(&mut truth) == State::Running {
            return Err(format!("{mode:?} does not end"));
        }
    }
    Ok(fast)
}

/// Counters that a host may not influence, and memory.
fn unpaced(job: &Job, device: &mut Any) -> impl PartialEq + std::fmt::Debug + use<> {
    let counters =
        job::counters(device).into_iter().filter(|(counter, _)| *counter != Counter::StarvedCycles);
    (counters.collect::<Vec<_>>(), job.hits_in(device), job.pixels_in(device))
}

fn broken() -> impl Strategy<Value = Shape> {
    (shapes(), 3u32..200).prop_map(|(shape, broken)| Shape { broken, ..shape })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn on_random_jobs(shape in shapes(), pace in any::<u64>()) {
        let job = shape.job();
        let paced = in_lockstep(&job, pace);
        if let Err(why) = &paced {
            return Err(TestCaseError::fail(why.clone()));
        }
        // A host that is never late.
        let mut device = job.device();
        job.update(&mut device);
        job.evaluate(&mut device);
        prop_assert_eq!(unpaced(&job, &mut paced.unwrap()), unpaced(&job, &mut device));
    }

    /// Jobs that end in a fault, sooner or later: the same fault in the same clock.
    #[test]
    fn on_jobs_with_references_that_lead_nowhere(shape in broken(), pace in any::<u64>()) {
        let job = shape.job();
        if let Err(why) = in_lockstep(&job, pace) {
            return Err(TestCaseError::fail(why));
        }
        // What was done before the fault does not depend on the host's pace; only how far the feed has run ahead does.
        let mut paced = job.device();
        let mut rng = Rng(pace);
        job.start(&mut paced, Mode::Update);
        while job::state(&mut paced) == State::Running {
            job.push(&mut paced, rng.below(3));
            if job::read(&mut paced, pree::RING_TAIL) as usize == job.photons.len() {
                job::flush(&mut paced);
            }
            paced.advance(1 + pause(&mut rng));
        }
        let mut device = job.device();
        job.update(&mut device);
        let ends = [paced, device].map(|mut device| {
            let mut counters = job::counters(&mut device);
            let ahead = [Counter::StarvedCycles, Counter::Photons, Counter::EmptyCells];
            counters.retain(|(counter, _)| !ahead.contains(counter));
            let fault = [pree::STATUS, pree::ERROR, pree::FAULT_ADDRESS].map(|offset| job::read(&mut device, offset));
            (fault, counters, job.hits_in(&device))
        });
        prop_assert_eq!(&ends[0], &ends[1]);
    }

    /// Buffers over one another, in one window over all memory: results overwrite lists, photons, pixel numbers.
    #[test]
    fn on_buffers_that_overlap(shape in shapes(), pace in any::<u64>(), moves in prop::array::uniform4(0u32..400)) {
        let job = shape.job();
        let words = job.bases().end as usize / 4;
        let mut devices = [job.device(), job.device()];
        let room = |words: u32| job.bases().end / 4 - words;
        let sizes = [
            job.hits.len() as u32 * 16,
            job.index.len() as u32,
            job.pixels.len() as u32 * 3,
            job.ring_entries * job.record_words() as u32,
        ];
        let places: Vec<u32> = moves.iter().zip(sizes).map(|(place, size)| place % (room(size) + 1) * 4).collect();
        for device in &mut devices {
            job::write(device, window::base(0), 0);
            job::write(device, window::limit(0), words as u32 * 4);
            job::write(device, pree::HIT_BASE, places[0]);
            if pace & 1 == 0 {
                job::write(device, pree::PIXEL_BASE, places[2]);
            }
            if pace & 2 == 0 {
                job::write(device, pree::RING_BASE, places[3]);
            }
            if pace & 4 == 0 {
                job::write(device, pree::INDEX_BASE, places[1]);
            }
        }
        let mut rng = Rng(pace);
        for mode in [Mode::Update, Mode::Evaluate] {
            devices.iter_mut().for_each(|device| job.start(device, mode));
            for _ in 0..60 {
                let (at_most, flush) = (rng.below(9), rng.once_in(7));
                for device in &mut devices {
                    job.push(device, at_most);
                    if flush {
                        job::flush(device);
                    }
                }
                let cycles = pause(&mut rng);
                (0..cycles).for_each(|_| devices[0].tick());
                mixed(&mut devices[1], cycles, &mut rng);
                let [truth, fast] = devices.each_mut().map(|device| visible(device, words));
                prop_assert!(truth == fast, "{}", differences(&truth, &fast));
            }
            devices.iter_mut().for_each(job::abort);
        }
    }
}

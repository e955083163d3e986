//! Does each result arrive in the cycle it should, not one before and not one after?
//!
//! The cycles are derived from the constants of the units and, independently, from what the PIPELINE register says.

use lucerna_bus::Target;
use lucerna_driver::records::encode;
use lucerna_driver::{Allocation, Busy, Hazard, InputWidth, NumberFormat, Scheduler};
use lucerna_pree::hazard::{EVALUATE_BYPASS, UPDATE_BYPASS};
use lucerna_pree::preu::components::{EVALUATE_STAGES, UPDATE_STAGES};
use lucerna_pree::update::{OPERAND_LATENCY, READ_LATENCY};
use lucerna_regs::counters::Counter;
use lucerna_regs::ident::{self, Pipeline};
use lucerna_regs::interrupts;
use lucerna_regs::pree::{Config, Mode, State};
use lucerna_tests::devices::{Any, Kind};
use lucerna_tests::job::{self, Job};

const KIND: Kind = Kind { preus: 4, format: NumberFormat::F32, soft: true };

/// The tick in which the first photon is in the buffer: the ring's first read, then the load.
const LOADED: usize = READ_LATENCY + 1;

/// Photons whose lists follow one another in the index table; every one of them counts for every hit point.
fn lists(kind: Kind, config: Config, hits: u32, lists: &[&[u32]]) -> Job {
    let number = |x: f32| encode(kind.format, x);
    let hit = |pixel: u32| {
        let mut words = [0; 16];
        words[6..9].fill(number(1.0));
        words[9..12].fill(number(1.0));
        words[12] = number(1000.0);
        words[14] = pixel;
        words
    };
    let mut first = 0;
    let photons = lists.iter().enumerate().map(|(photon, list)| {
        let mut words = [0; 12];
        // No two alike: a result computed from the same stale operands is another one all the same.
        words[3..6].fill(number(photon as f32 + 1.0));
        (words[6], words[7]) = (first, list.len() as u32);
        first += list.len() as u32;
        words
    });
    Job {
        kind,
        config,
        alpha: number(0.5),
        emitted: number(2.0),
        photons: photons.collect(),
        hits: (0..hits).map(|_| hit(0)).collect(),
        index: lists.concat(),
        pixels: vec![[0; 3]; 2],
        ring_entries: 64,
        ring_low: 0,
    }
}

/// A device with all photons in the ring and the flush given, before its first clock.
fn ready(job: &Job) -> Any {
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    assert_eq!(job.push(&mut device, u32::MAX) as usize, job.photons.len());
    job::flush(&mut device);
    device
}

/// In which ticks each hit point's N changes; `(tick, hit point)`, in order.
fn changes(job: &Job, device: &mut Any) -> Vec<(usize, usize)> {
    let mut seen = Vec::new();
    let mut before = job.hits_in(device);
    for tick in 1..400 {
        device.tick();
        let now = job.hits_in(device);
        seen.extend((0..now.len()).filter(|hit| now[*hit] != before[*hit]).map(|hit| (tick, hit)));
        before = now;
    }
    assert_eq!(job::state(device), State::Idle);
    seen
}

/// In which tick the pixels change.
fn pixel_changes(job: &Job) -> Vec<usize> {
    let mut device = job.device();
    job.start(&mut device, Mode::Evaluate);
    let mut before = job.pixels_in(&device);
    let mut seen = Vec::new();
    for tick in 1..200 {
        device.tick();
        let now = job.pixels_in(&device);
        if now != before {
            seen.push(tick);
        }
        before = now;
    }
    assert_eq!(job::state(&mut device), State::Idle);
    seen
}

fn config(hazard: Hazard) -> Config {
    Config::RESET.with_hazard(hazard)
}

#[test]
fn the_register_says_what_the_units_are_built_of() {
    let mut device = KIND.build(vec![0; 16]);
    let pipeline = Pipeline::from_bits(job::read(&mut device, ident::PIPELINE));
    assert_eq!(pipeline.update_stages() as usize, UPDATE_STAGES);
    assert_eq!(pipeline.evaluate_stages() as usize, EVALUATE_STAGES);
    assert_eq!(pipeline.operand_latency() as usize, OPERAND_LATENCY);
    assert_eq!((UPDATE_STAGES, EVALUATE_STAGES, OPERAND_LATENCY), (10, 12, 8));
}

/// Load, dispatch in the next cycle, two reads, ten stages: in memory at that clock, and done with it.
#[test]
fn an_update_is_in_memory_at_its_cycle() {
    let arrives = LOADED + 1 + OPERAND_LATENCY + UPDATE_STAGES;
    for hazard in [Hazard::Interlock, Hazard::Forward, Hazard::Published] {
        let job = lists(KIND, config(hazard), 1, &[&[0]]);
        let mut device = ready(&job);
        job::write(&mut device, interrupts::ENABLE, interrupts::Enable::default().with_done(true).bits());
        let before = job.hits_in(&device);
        (1..arrives).for_each(|_| device.tick());
        assert_eq!(job.hits_in(&device), before, "not a cycle too soon");
        assert_eq!(job::state(&mut device), State::Running);
        assert!(!device.interrupt());
        device.tick();
        assert_ne!(job.hits_in(&device), before, "and not a cycle too late");
        assert_eq!(job::state(&mut device), State::Idle);
        assert!(device.interrupt(), "the interrupt comes with the result");
        assert_eq!(job::count(&mut device, Counter::TotalCycles), arrives as u64);
        assert_eq!(job::count(&mut device, Counter::UpdateCycles), 2);
    }
}

/// An address, one read, twelve stages.
#[test]
fn an_evaluation_is_in_memory_at_its_cycle() {
    let arrives = 1 + READ_LATENCY + EVALUATE_STAGES;
    let job = lists(KIND, config(Hazard::Interlock), 1, &[]);
    assert_eq!(pixel_changes(&job), [arrives]);
    let mut device = job.device();
    job.start(&mut device, Mode::Evaluate);
    device.advance(arrives as u64 - 1);
    assert_eq!(job::state(&mut device), State::Running);
    device.advance(1);
    assert_eq!(job::state(&mut device), State::Idle);
    assert_eq!(job::count(&mut device, Counter::TotalCycles), arrives as u64);
    assert_eq!(job::count(&mut device, Counter::EvaluateCycles), 1);
}

/// Two photons on one hit point, one cycle apart.
#[test]
fn a_successor_waits_as_long_as_the_policy_says() {
    let first = LOADED + 1 + OPERAND_LATENCY + UPDATE_STAGES;
    for (hazard, distance) in
        [(Hazard::Interlock, UPDATE_STAGES), (Hazard::Forward, UPDATE_BYPASS), (Hazard::Published, 1)]
    {
        let config = config(hazard).with_scheduler(Scheduler::OnePhoton);
        let job = lists(KIND, config, 1, &[&[0], &[0]]);
        let mut device = ready(&job);
        assert_eq!(changes(&job, &mut device), [(first, 0), (first + distance, 0)], "{hazard:?}");
        assert_eq!(job::count(&mut device, Counter::StallCycles), distance as u64 - 1);
        assert_eq!(job::count(&mut device, Counter::UpdateConflicts), 1);
        assert_eq!(job::count(&mut device, Counter::Forwards), u64::from(hazard == Hazard::Forward));
        assert_eq!(job::count(&mut device, Counter::StaleUpdates), u64::from(hazard == Hazard::Published));
    }
    assert_eq!((UPDATE_STAGES, UPDATE_BYPASS), (10, 6));
}

/// Both in one group: the second lane waits although the first was issued in the same cycle.
#[test]
fn lanes_of_one_cycle_are_ordered_too() {
    let first = LOADED + 2 + OPERAND_LATENCY + UPDATE_STAGES;
    for (hazard, distance) in [(Hazard::Interlock, UPDATE_STAGES), (Hazard::Forward, UPDATE_BYPASS)] {
        let job = lists(KIND, config(hazard), 1, &[&[0], &[0]]);
        let mut device = ready(&job);
        assert_eq!(changes(&job, &mut device), [(first, 0), (first + distance, 0)], "{hazard:?}");
        assert_eq!(job::count(&mut device, Counter::StallCycles), distance as u64);
    }
    // Unprotected, the last one wins, computed from what was there before both.
    let job = lists(KIND, config(Hazard::Published), 1, &[&[0], &[0]]);
    let mut device = ready(&job);
    assert_eq!(changes(&job, &mut device), [(first, 0)]);
    assert_eq!(f32::from_bits(job.hits_in(&device)[0][13]), 0.5, "one photon was lost");
}

/// What is exactly as far apart as the policy wants is not held, and no conflict where it is the full depth.
#[test]
fn at_the_distance_itself_nothing_waits() {
    let spaced = |others: usize| {
        let fillers: Vec<Vec<u32>> = (0..others).map(|other| vec![other as u32 + 1]).collect();
        let mut all: Vec<&[u32]> = vec![&[0]];
        all.extend(fillers.iter().map(|filler| &filler[..]));
        all.push(&[0]);
        let config = config(Hazard::Interlock).with_scheduler(Scheduler::OnePhoton);
        let forward = config.with_hazard(Hazard::Forward);
        [config, forward].map(|config| {
            let mut device = ready(&lists(KIND, config, 12, &all));
            device.advance(200);
            [Counter::UpdateConflicts, Counter::StallCycles, Counter::Forwards]
                .map(|c| job::count(&mut device, c))
        })
    };
    assert_eq!(spaced(UPDATE_STAGES - 1), [[0, 0, 0], [0, 0, 0]]);
    assert_eq!(spaced(UPDATE_STAGES - 2), [[1, 1, 0], [1, 0, 1]]);
    assert_eq!(spaced(UPDATE_BYPASS - 1), [[1, 4, 0], [1, 0, 1]]);
    assert_eq!(spaced(UPDATE_BYPASS - 2), [[1, 5, 0], [1, 1, 1]]);
}

#[test]
fn pixels_wait_as_long_as_the_policy_says() {
    let first = 1 + READ_LATENCY + EVALUATE_STAGES;
    // Two hit points of one pixel: they are in groups of their own, and meet in one cycle.
    for (hazard, distance) in [(Hazard::Interlock, EVALUATE_STAGES), (Hazard::Forward, EVALUATE_BYPASS)] {
        let job = lists(KIND, config(hazard), 2, &[]);
        assert_eq!(pixel_changes(&job), [first, first + distance], "{hazard:?}");
    }
    assert_eq!(pixel_changes(&lists(KIND, config(Hazard::Published), 2, &[])), [first]);
    assert_eq!((EVALUATE_STAGES, EVALUATE_BYPASS), (12, 2));
}

/// Leaping keeps the hit points of a pixel more than twelve cycles apart where sequential order lets them meet.
#[test]
fn leaping_parts_neighbours() {
    let conflicts = |allocation| {
        let mut job = lists(KIND, config(Hazard::Published).with_allocation(allocation), 256, &[]);
        job.pixels = vec![[0; 3]; 128];
        job.hits.iter_mut().enumerate().for_each(|(number, hit)| hit[14] = number as u32 / 2);
        let mut device = job.device();
        job.evaluate(&mut device);
        job::count(&mut device, Counter::PixelConflicts)
    };
    assert_eq!(conflicts(Allocation::Leaping), 0);
    assert_eq!(conflicts(Allocation::Sequential), 128);
}

fn update_cycles(kind: Kind, config: Config, lengths: &[u32]) -> (u64, u64) {
    let mut next = 0;
    let numbers: Vec<Vec<u32>> = lengths
        .iter()
        .map(|n| {
            let list = (next..next + n).collect();
            next += n;
            list
        })
        .collect();
    let slices: Vec<&[u32]> = numbers.iter().map(|list| &list[..]).collect();
    let mut device = ready(&lists(kind, config, next.max(1), &slices));
    device.advance(10_000);
    assert_eq!(job::state(&mut device), State::Idle);
    assert_eq!(job::count(&mut device, Counter::Operations), u64::from(next));
    (job::count(&mut device, Counter::UpdateCycles), job::count(&mut device, Counter::PartialDispatches))
}

/// D4, D5: eight lists of one entry.
#[test]
fn busy_and_width_make_the_bubble_or_not() {
    let cycles = |busy, width| {
        let config = config(Hazard::Interlock).with_busy(busy).with_input_width(width);
        update_cycles(KIND, config, &[1; 8]).0
    };
    // Load 4, dispatch without a load, load 4, dispatch.
    assert_eq!(cycles(Busy::Registered, InputWidth::One), 10);
    // The dispatch's own cycle loads the fifth.
    assert_eq!(cycles(Busy::Combinational, InputWidth::One), 9);
    assert_eq!(cycles(Busy::Registered, InputWidth::Two), 6);
    assert_eq!(cycles(Busy::Combinational, InputWidth::Two), 5);
    assert_eq!(cycles(Busy::Registered, InputWidth::Four), 4);
    assert_eq!(cycles(Busy::Combinational, InputWidth::Four), 3);
}

/// D1: four lists of one entry never fill eight PREUs; the literal rule would wait for ever.
#[test]
fn a_full_buffer_goes_with_too_little() {
    let kind = Kind { preus: 8, ..KIND };
    let job = lists(kind, config(Hazard::Interlock), 8, &[&[0], &[1], &[2], &[3], &[4]]);
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    job.push(&mut device, u32::MAX);
    // No flush: it goes because the buffer is full. Then the engine wants the sixth photon, and stands still.
    device.advance(1000);
    assert_eq!(job::count(&mut device, Counter::PartialDispatches), 1);
    assert_eq!(job::count(&mut device, Counter::UpdateCycles), 6);
    job::flush(&mut device);
    device.advance(1000);
    assert_eq!(job::count(&mut device, Counter::PartialDispatches), 1, "the fifth goes by the flush");
    assert_eq!(job::count(&mut device, Counter::Operations), 5);
    assert_eq!(update_cycles(kind, config(Hazard::Interlock), &[2, 2, 2, 2]).1, 0, "eight in all are enough");
}

/// D2.
#[test]
fn nothing_goes_before_the_flush_when_more_may_come() {
    let job = lists(KIND, config(Hazard::Interlock), 3, &[&[0], &[1, 2]]);
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    job.push(&mut device, u32::MAX);
    let before = job.hits_in(&device);
    device.advance(1000);
    assert_eq!(job::state(&mut device), State::Running);
    assert_eq!(job.hits_in(&device), before);
    job::flush(&mut device);
    device.advance(UPDATE_STAGES as u64 + OPERAND_LATENCY as u64 + 1);
    assert_ne!(job.hits_in(&device), before);
    assert_eq!(job::state(&mut device), State::Idle);
}

/// D6: eleven entries on four PREUs, from the list's end downwards: 4, 4, 3.
#[test]
fn a_long_list_goes_from_its_end_in_parts() {
    let numbers: Vec<u32> = (0..11).collect();
    let job = lists(KIND, config(Hazard::Interlock), 11, &[&numbers]);
    let mut device = ready(&job);
    let first = LOADED + 1 + OPERAND_LATENCY + UPDATE_STAGES;
    let expected: Vec<_> = (0..11usize).map(|hit| (first + (10 - hit) / 4, hit)).collect::<Vec<_>>();
    let mut seen = changes(&job, &mut device);
    seen.sort_by_key(|(_, hit)| *hit);
    assert_eq!(seen, expected);
}

/// D9: photons without a list change no cycle count, wherever they are.
#[test]
fn empty_cells_cost_no_cycle() {
    for preus in [4, 8, 16] {
        let kind = Kind { preus, ..KIND };
        let dense = [3, 1, 7, 2, 20, 1, 1, 1, 5];
        let sparse: Vec<u32> = dense
            .iter()
            .enumerate()
            .flat_map(|(i, n)| [vec![0; i % 4], vec![*n]].concat())
            .chain([0; 9])
            .collect();
        let config = config(Hazard::Interlock);
        assert_eq!(update_cycles(kind, config, &dense), update_cycles(kind, config, &sparse));
    }
}

/// A job of nothing ends too, in either mode.
#[test]
fn nothing_to_do_is_done() {
    for lengths in [&[][..], &[0, 0, 0]] {
        assert_eq!(update_cycles(KIND, config(Hazard::Interlock), lengths), (0, 0));
    }
    let mut job = lists(KIND, config(Hazard::Interlock), 1, &[]);
    job.hits.clear();
    let mut device = job.device();
    job.evaluate(&mut device);
    assert_eq!(job::count(&mut device, Counter::Evaluations), 0);
    assert_eq!(job::state(&mut device), State::Idle);
}

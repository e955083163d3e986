//! Are the published figures reproduced, and by two computations that meet: the device, and a scheduler over list lengths?

use hostsim::accelerate::{Outcome, Setup, Units, run};
use lucerna_bus::Timing;
use lucerna_driver::{Allocation, Busy, Hazard, InputWidth, Policies, Scheduler};
use lucerna_tests::schedule::{self, Totals, aftso, evaluation, one_photon};
use lucerna_tests::workload::{LARGE, SMALL, Traced};

const PUBLISHED: Policies = Policies {
    hazard: Hazard::Published,
    busy: Busy::Registered,
    input_width: InputWidth::One,
    scheduler: Scheduler::Aftso,
    allocation: Allocation::Leaping,
};

fn device(traced: &Traced, units: Units, timing: Timing, policies: Policies) -> Outcome {
    let setup = Setup { units, timing, policies, normal_test: false, ..Setup::default() };
    run(&setup, &traced.workload(), &mut traced.source()).expect("a job the device can do")
}

fn utilisation(outcome: &Outcome) -> String {
    let (operations, cycles) = (outcome.update.operations, outcome.update.update_cycles);
    Totals { cycles, operations, partial: 0 }.utilisation(outcome.capabilities.preus)
}

/// Table III: 0.25 ms and 496.79 M/s at 125 MHz are 31,120 cycles.
#[test]
fn the_chips_run() {
    assert_eq!(SMALL.prepared.points.len(), 606);
    assert_eq!(SMALL.prepared.grid.entries().len(), 4_848);
    let [tick, fast] =
        [Timing::Tick, Timing::Fast].map(|timing| device(&SMALL, Units::Four, timing, PUBLISHED));
    for outcome in [&tick, &fast] {
        let (update, evaluate) = (&outcome.update, &outcome.evaluate);
        assert_eq!((update.photons, update.empty_cells, update.operations), (3_162, 0, 123_682));
        assert_eq!((update.update_cycles, evaluate.evaluate_cycles), (30_922, 152));
        let total = update.total_cycles + evaluate.total_cycles;
        assert!(total.abs_diff(31_120) <= 30, "{total}");
        assert_eq!(total, 31_112);
        assert_eq!((update.update_conflicts, update.stale_updates, update.updates), (9_403, 281, 6_594));
        assert_eq!((evaluate.evaluations, evaluate.pixel_conflicts), (606, 162));
        assert_eq!((update.stall_cycles, evaluate.stall_cycles), (0, 0));
    }
    assert_eq!((tick.states, tick.pixel_bits), (fast.states, fast.pixel_bits));
}

#[test]
fn protected_the_chips_run_loses_no_update() {
    for hazard in [Hazard::Interlock, Hazard::Forward] {
        let outcome = device(&SMALL, Units::Four, Timing::Fast, Policies { hazard, ..PUBLISHED });
        assert_eq!((outcome.update.updates, outcome.update.stale_updates), (6_506, 0));
    }
}

/// Fig. 4's order at 20×15.
#[test]
fn sequential_addresses_of_the_chips_run() {
    let policies = Policies { allocation: Allocation::Sequential, ..PUBLISHED };
    let sequential = device(&SMALL, Units::Four, Timing::Fast, policies);
    let leaping = device(&SMALL, Units::Four, Timing::Fast, PUBLISHED);
    assert_eq!(sequential.evaluate.evaluate_cycles, 152);
    assert_eq!(sequential.states, leaping.states, "the order of evaluation changes no hit point");
    assert_eq!(sequential.evaluate.pixel_conflicts, conflicts(&SMALL, 4, false));
    assert_eq!(leaping.evaluate.pixel_conflicts, conflicts(&SMALL, 4, true));
}

/// D12: hit points whose pixel was issued fewer than 12 cycles before.
fn conflicts(traced: &Traced, preus: u32, leaping: bool) -> u64 {
    let points = &traced.prepared.points;
    let mut last = vec![None; traced.pixels as usize];
    let mut conflicts = 0;
    for (cycle, group) in evaluation(points.len() as u32, preus, leaping).into_iter().enumerate() {
        for hit in group {
            let before = last[points[hit as usize].pixel as usize].replace(cycle);
            conflicts += u64::from(before.is_some_and(|before: usize| cycle - before < 12));
        }
    }
    conflicts
}

/// Table II, by the scheduler over list lengths: every cell in four digits.
#[test]
fn table_ii() {
    let lists = LARGE.lists();
    assert_eq!((lists.len(), lists.iter().filter(|n| **n == 0).count()), (2_454_756, 16_611));
    use schedule::Busy::{Combinational, Registered};
    let expected = [
        (4, ["95.5134", "99.9990", "99.9999", "100.0000"], [0, 0, 0]),
        (8, ["90.0584", "99.9690", "99.9971", "99.9998"], [82, 0, 0]),
        (16, ["80.7156", "99.2261", "99.8634", "99.9945"], [1251, 0, 0]),
    ];
    for (preus, [without, one, combinational, wide], [partial, ..]) in expected {
        let baseline = one_photon(&lists, preus, 1, Registered, |_, _, _| {});
        let rules = [(1, Registered), (1, Combinational), (4, Combinational)];
        let [a, b, c] = rules.map(|(width, busy)| aftso(&lists, preus, width, busy, |_, _, _| {}));
        assert_eq!(baseline.operations, 78_118_412);
        assert_eq!(
            [baseline, a, b, c].map(|t| t.utilisation(preus)),
            [without, one, combinational, wide],
            "N = {preus}"
        );
        assert_eq!(a.partial, partial, "N = {preus}");
        if preus == 4 {
            assert_eq!(a.cycles, 19_529_799);
        }
    }
}

/// The same by the device, through driver and registers: three input rules and the baseline at N = 4.
#[test]
fn the_large_picture_on_four_preus() {
    assert_eq!(LARGE.prepared.points.len(), 152_046);
    assert_eq!(LARGE.prepared.grid.entries().len(), 1_216_364);
    let run = |policies| device(&LARGE, Units::Four, Timing::Fast, policies);
    let published = run(PUBLISHED);
    let (update, evaluate) = (&published.update, &published.evaluate);
    assert_eq!((update.photons, update.empty_cells), (2_454_756, 16_611));
    assert_eq!((update.operations, update.update_cycles, update.stall_cycles), (78_118_412, 19_529_799, 0));
    assert_eq!((update.update_conflicts, update.partial_dispatches), (275_677, 0));
    assert!(update.stale_updates.abs_diff(3_990) < 100, "{}", update.stale_updates);
    assert_eq!(evaluate.pixel_conflicts, 5);
    assert_eq!(conflicts(&LARGE, 4, true), 5);
    assert_eq!(utilisation(&published), "99.9990");

    let combinational = Policies { busy: Busy::Combinational, ..PUBLISHED };
    assert_eq!(utilisation(&run(combinational)), "99.9999");
    let wide = run(Policies { input_width: InputWidth::Four, ..combinational });
    assert_eq!(utilisation(&wide), "100.0000");
    assert_eq!(wide.update.operations, 78_118_412);
    let baseline =
        run(Policies { scheduler: Scheduler::OnePhoton, allocation: Allocation::Sequential, ..PUBLISHED });
    assert_eq!(utilisation(&baseline), "95.5134");
    assert_eq!(baseline.evaluate.pixel_conflicts, 75_245);
    assert_eq!(conflicts(&LARGE, 4, false), 75_245);
}

/// N = 8 and 16 by the device, default rules.
#[test]
fn the_large_picture_on_more_preus() {
    for (units, expected, partial) in [(Units::Eight, "99.9690", 82), (Units::Sixteen, "99.2261", 1251)] {
        let outcome = device(&LARGE, units, Timing::Fast, PUBLISHED);
        assert_eq!(utilisation(&outcome), expected);
        assert_eq!(outcome.update.partial_dispatches, partial);
        assert_eq!(outcome.update.operations, 78_118_412);
    }
}

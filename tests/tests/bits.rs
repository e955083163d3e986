//! Is every bit what the hazard policy promises: the in-order loop's when protected, exactly the stale one when not?
//!
//! The in-order loop and the event list are in this crate's library; neither knows the units' code.

use lucerna_driver::{Allocation, Hazard, NumberFormat};
use lucerna_regs::counters::Counter;
use lucerna_regs::pree::{Config, State};
use lucerna_tests::devices::Kind;
use lucerna_tests::inorder::{self, Timed, timed_evaluate, timed_update};
use lucerna_tests::job::{self, CANARY, Job};
use lucerna_tests::random::shapes;
use lucerna_tests::workload::SMALL;
use proptest::prelude::*;

/// Runs both modes and holds hit points, pixels and counters against the event list; in the protected policies the hit points and
/// pixels against the in-order loop besides.
fn check(job: &Job) -> Result<(), String> {
    let mut device = job.device();
    job.update(&mut device);
    let hits = job.hits_in(&device);
    let expected = timed_update(job);
    same("hit point (event list)", &hits, &expected.records)?;
    same_counters(&mut device, &expected)?;
    job::clear_counters(&mut device);
    job.evaluate(&mut device);
    let pixels = job.pixels_in(&device);
    let expected = timed_evaluate(job, &hits);
    same("pixel (event list)", &pixels, &expected.records)?;
    same_counters(&mut device, &expected)?;
    if job.config.hazard() != Ok(Hazard::Published) {
        let (in_order, updates) = inorder::update(job);
        same("hit point (in order)", &hits, &in_order)?;
        same("pixel (in order)", &pixels, &inorder::evaluate(job, &in_order))?;
        if !timed_update(job).counters.contains(&(Counter::Updates, updates)) {
            return Err("the two loops disagree on the updates".to_owned());
        }
    }
    if job::state(&mut device) != State::Idle {
        return Err("not idle at the end".to_owned());
    }
    // The device has written hit points and pixels, and nothing else.
    let bases = job.bases();
    let memory = job.memory_in(&device);
    for gap in [bases.hits, bases.index, bases.pixels, bases.ring, bases.end] {
        if memory[gap as usize / 4 - 5..gap as usize / 4].iter().any(|word| *word != CANARY) {
            return Err(format!("words of nobody before {gap:#x} were changed"));
        }
    }
    Ok(())
}

fn same<const W: usize>(what: &str, ours: &[[u32; W]], theirs: &[[u32; W]]) -> Result<(), String> {
    match ours.iter().zip(theirs).position(|(ours, theirs)| ours != theirs) {
        None if ours.len() == theirs.len() => Ok(()),
        None => Err(format!("{what}: {} and {}", ours.len(), theirs.len())),
        Some(i) => Err(format!("{what} {i}: device {:08x?}, expected {:08x?}", ours[i], theirs[i])),
    }
}

fn same_counters<R>(device: &mut impl lucerna_bus::Target, expected: &Timed<R>) -> Result<(), String> {
    for (counter, value) in job::counters(device) {
        let expected =
            expected.counters.iter().find(|(other, _)| *other == counter).map_or(0, |(_, value)| *value);
        if value != expected && counter != Counter::StarvedCycles {
            return Err(format!("{}: device {value}, expected {expected}", counter.name()));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]
    /// Any policies, formats, units; hit points listed twice; lists longer than the PREUs are many; NaNs and subnormals.
    #[test]
    fn random_jobs(shape in shapes()) {
        if let Err(why) = check(&shape.job()) {
            return Err(TestCaseError::fail(why));
        }
    }
}

/// Every device and policy on the chip's own run.
fn small(hazard: Hazard) {
    for kind in Kind::all(true).chain(Kind::all(false)) {
        for normal_test in [false, true] {
            for allocation in [Allocation::Leaping, Allocation::Sequential] {
                let config = Config::RESET
                    .with_hazard(hazard)
                    .with_normal_test(normal_test)
                    .with_allocation(allocation);
                // The soft formats take longer: one allocation of them will do.
                if kind.soft && allocation == Allocation::Sequential {
                    continue;
                }
                let checked = check(&SMALL.job(kind, config));
                checked
                    .unwrap_or_else(|why| panic!("{kind:?} {hazard:?} {normal_test} {allocation:?}: {why}"));
            }
        }
    }
}

#[test]
fn the_small_picture_interlocked() {
    small(Hazard::Interlock);
}

#[test]
fn the_small_picture_forwarded() {
    small(Hazard::Forward);
}

#[test]
fn the_small_picture_as_published() {
    small(Hazard::Published);
}

/// The in-order loop of this crate and hostsim's oracle were written apart.
#[test]
fn two_oracles_agree() {
    use hostsim::oracle::{Bits24, Number, Scalar};
    fn by<N: Number>(format: NumberFormat, normal_test: bool) {
        let kind = Kind { preus: 4, format, soft: false };
        let job = SMALL.job(kind, Config::RESET.with_normal_test(normal_test));
        let (hits, updates) = inorder::update(&job);
        let prepared = &SMALL.prepared;
        let mut scalar = Scalar::<N>::new(&prepared.points, prepared.grid.radius(), 0.7, normal_test);
        SMALL.chunks.iter().for_each(|chunk| scalar.feed(chunk, prepared.grid.entries()));
        assert_eq!(scalar.counts().updates, updates);
        for (state, hit) in scalar.states().zip(&hits) {
            assert_eq!([&state.flux[..], &[state.r2, state.n]].concat(), hit[9..14]);
        }
    }
    for normal_test in [false, true] {
        by::<f32>(NumberFormat::F32, normal_test);
        by::<Bits24>(NumberFormat::F24, normal_test);
    }
}

/// The stale updates of `published` change the picture: otherwise the tests above show nothing.
#[test]
fn without_protection_the_result_is_another() {
    let kind = Kind { preus: 4, format: NumberFormat::F32, soft: false };
    let job = SMALL.job(kind, Config::RESET.with_hazard(Hazard::Published));
    assert_ne!(timed_update(&job).records, inorder::update(&job).0);
}

/// D² <= R² lets the edge in, a cosine of 1e-3 itself is too grazing (D8).
#[test]
fn both_tests_at_their_edges() {
    use lucerna_driver::records::encode;
    for kind in Kind::all(false).chain(Kind::all(true)) {
        let bits = |x: f32| encode(kind.format, x);
        let grazing = bits(1e-3);
        for (x, cosine, counts) in [
            (bits(2.0), bits(1.0), true),
            (bits(2.0) + 1, bits(1.0), false),
            (bits(2.0) - 1, bits(1.0), true),
            (bits(0.0), grazing, false),
            (bits(0.0), grazing + 1, true),
            (bits(0.0), bits(-1.0), false),
        ] {
            let mut hit = [0; 16];
            (hit[0], hit[3], hit[12]) = (x, cosine, bits(4.0));
            let mut photon = [0; 12];
            (photon[7], photon[8]) = (1, bits(1.0));
            let job = Job {
                kind,
                config: Config::RESET.with_normal_test(true),
                alpha: bits(0.7),
                emitted: bits(1.0),
                hits: vec![hit],
                index: vec![0],
                photons: vec![photon],
                pixels: vec![[0; 3]],
                ring_entries: 1,
                ring_low: 0,
            };
            let mut device = job.device();
            job.update(&mut device);
            let updates = job::count(&mut device, Counter::Updates);
            assert_eq!(updates, u64::from(counts), "{kind:?}: x {x:#x}, cosine {cosine:#x}");
            check(&job).unwrap_or_else(|why| panic!("{kind:?}: {why}"));
        }
    }
}

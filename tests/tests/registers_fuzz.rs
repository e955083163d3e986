//! Does nonsense in registers and memory ever do more than give an error code and an interrupt?
//!
//! No panic (overflow checks are on), no hang, nothing outside the windows; and each code for its own nonsense.

use lucerna_bus::{Target, TargetError};
use lucerna_driver::NumberFormat;
use lucerna_regs::counters::Counter;
use lucerna_regs::pree::{self, Config, Control, ErrorCode, Mode, State};
use lucerna_regs::{interrupts, window};
use lucerna_tests::devices::{Any, Kind};
use lucerna_tests::job::{self, Job, REGISTER_BYTES, read, state, write};
use lucerna_tests::random::{Rng, kinds, shapes};
use lucerna_tests::workload::SMALL;
use proptest::prelude::*;

const WORDS: u32 = 1024;
/// Windows stay within these bytes; what lies outside is nobody's.
const OPEN: core::ops::Range<u32> = 512..3584;

/// An address that a window may have: mostly aligned, rarely backwards.
fn open_address(rng: &mut Rng) -> u32 {
    let address = OPEN.start + rng.below(OPEN.end - OPEN.start + 1);
    if rng.once_in(20) { address } else { address & !3 }
}

fn value(rng: &mut Rng, offset: u32) -> u32 {
    match offset {
        _ if rng.once_in(12) => rng.word(),
        pree::CONFIG => Config::RESET.bits() ^ rng.word() & [0x21d, 0x3ff, 0x1f, 1][rng.below(4) as usize],
        pree::CONTROL => rng.below(8),
        pree::HIT_BASE | pree::INDEX_BASE | pree::PIXEL_BASE | pree::RING_BASE => open_address(rng),
        pree::HIT_COUNT => rng.below(24),
        pree::INDEX_COUNT | pree::PIXEL_COUNT => rng.below(96),
        pree::RING_ENTRIES => 1 << rng.below(6),
        pree::RING_TAIL | pree::RING_LOW => rng.below(20),
        _ => rng.word(),
    }
}

/// Registers worth a write.
const BUSY_PLACES: [u32; 16] = [
    pree::CONTROL,
    pree::CONTROL,
    pree::CONTROL,
    pree::CONFIG,
    pree::HIT_BASE,
    pree::HIT_COUNT,
    pree::INDEX_BASE,
    pree::INDEX_COUNT,
    pree::PIXEL_BASE,
    pree::PIXEL_COUNT,
    pree::RING_BASE,
    pree::RING_ENTRIES,
    pree::RING_TAIL,
    pree::RING_TAIL,
    interrupts::STATUS,
    pree::ALPHA,
];

/// Small numbers are what references look like.
fn fill(rng: &mut Rng) -> u32 {
    if rng.once_in(4) { rng.word() } else { rng.below(24) }
}

fn is_window(offset: u32) -> bool {
    window::at(offset).is_some()
}

fn error(device: &mut Any) -> (ErrorCode, u32) {
    let code = pree::Error::from_bits(read(device, pree::ERROR)).code().expect("a code of the map");
    (code, read(device, pree::FAULT_ADDRESS))
}

fn error_raised(device: &mut Any) -> bool {
    interrupts::Status::from_bits(read(device, interrupts::STATUS)).error()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6000))]
    #[test]
    fn anything_goes(kind in kinds(), seed in any::<u64>(), steps in 20u32..400) {
        let mut rng = Rng(seed);
        let mut shadow: Vec<u32> = (0..WORDS).map(|_| fill(&mut rng)).collect();
        let mut device = kind.build(shadow.clone());
        for number in 0..window::COUNT {
            // Two wide ones, so that jobs get under way; two random ones.
            let bounds = if number < 2 { [OPEN.start, OPEN.end] } else { [0; 2].map(|_: u32| open_address(&mut rng)) };
            write(&mut device, window::base(number), bounds[0]);
            write(&mut device, window::limit(number), bounds[1]);
        }
        for offset in BUSY_PLACES[3..12].iter().chain([&pree::RING_LOW]) {
            let value = value(&mut rng, *offset);
            write(&mut device, *offset, value);
        }
        for _ in 0..steps {
            match rng.below(10) {
                0..4 => {
                    let offset = BUSY_PLACES[rng.below(BUSY_PLACES.len() as u32) as usize];
                    let value = value(&mut rng, offset);
                    write(&mut device, offset, value);
                    // A job that was refused, or stopped, says so.
                    if state(&mut device) == State::Fault {
                        prop_assert_ne!(error(&mut device).0, ErrorCode::None);
                    }
                    if offset == pree::CONTROL && value & 1 == 1 && error(&mut device).0 != ErrorCode::None {
                        prop_assert!(error_raised(&mut device));
                    }
                }
                4 => {
                    // Any offset at all; windows only within their part of the memory.
                    let offset = if rng.once_in(8) { rng.word() } else { rng.below(REGISTER_BYTES) };
                    let value = if is_window(offset) { open_address(&mut rng) } else { value(&mut rng, offset) };
                    match device.write(offset, value) {
                        Ok(()) => prop_assert_eq!(offset % 4, 0),
                        Err(TargetError::Misaligned) => prop_assert_ne!(offset % 4, 0),
                        Err(error) => prop_assert_eq!(error, TargetError::Unmapped),
                    }
                }
                5 => {
                    let offset = if rng.once_in(8) { rng.word() } else { rng.below(REGISTER_BYTES) };
                    let mapped = lucerna_regs::describe(offset).is_some() || Counter::at(offset).is_some();
                    let answer = device.read(offset);
                    prop_assert_eq!(answer.is_ok(), mapped, "{:#x}", offset);
                    prop_assert_eq!(device.read(offset), answer, "a read changes nothing");
                }
                6 => {
                    let (first, count) = (rng.below(WORDS + 4), rng.below(40));
                    let words: Vec<u32> = (0..count).map(|_| fill(&mut rng)).collect();
                    let fits = first + count <= WORDS;
                    prop_assert_eq!(device.store(first * 4, &words).is_ok(), fits);
                    prop_assert!(device.store(first * 4 + 1, &words).is_err());
                    if fits {
                        shadow[first as usize..(first + count) as usize].copy_from_slice(&words);
                    }
                }
                7 => device.tick(),
                _ => device.advance(u64::from(rng.below(60))),
            }
        }

        // Nobody's words are as the host left them.
        let mut memory = vec![0; WORDS as usize];
        device.load(0, &mut memory).unwrap();
        let outside = |word: usize| !OPEN.contains(&(word as u32 * 4));
        for word in (0..WORDS as usize).filter(|word| outside(*word)) {
            prop_assert_eq!(memory[word], shadow[word], "word {:#x} is outside all windows", word * 4);
        }

        // No hang: flushed, it comes to an end by itself; aborted, at once.
        let mut other = rng.clone();
        if other.once_in(2) {
            job::flush(&mut device);
            device.advance(32 * 1024 * 12);
            prop_assert_ne!(state(&mut device), State::Running);
        }
        job::abort(&mut device);
        prop_assert_eq!(state(&mut device), State::Idle);
        prop_assert_eq!(error(&mut device), (ErrorCode::None, 0));
        device.load(0, &mut memory).unwrap();
        device.advance(1000);
        let mut after = vec![0; WORDS as usize];
        device.load(0, &mut after).unwrap();
        prop_assert!(memory == after, "an idle device writes nothing");
    }

    /// START, and every register of a job, while it runs: only an error code comes of it.
    #[test]
    fn a_running_job_is_not_disturbed(shape in shapes(), seed in any::<u64>()) {
        let job = shape.job();
        let mut quiet = job.device();
        job.update(&mut quiet);
        job.evaluate(&mut quiet);

        let mut device = job.device();
        let mut rng = Rng(seed);
        for mode in [Mode::Update, Mode::Evaluate] {
            job.start(&mut device, mode);
            let mut pushed = 0;
            while state(&mut device) == State::Running {
                if mode == Mode::Update {
                    pushed += job.push(&mut device, 7) as usize;
                    if pushed == job.photons.len() {
                        job::flush(&mut device);
                    }
                }
                let latched = [
                    pree::CONFIG, pree::ALPHA, pree::EMITTED, pree::HIT_BASE, pree::HIT_COUNT, pree::INDEX_BASE, pree::INDEX_COUNT,
                    pree::PIXEL_BASE, pree::PIXEL_COUNT, pree::RING_BASE, pree::RING_ENTRIES, window::base(0), window::limit(0),
                    window::base(1), window::limit(3),
                ];
                let word = rng.word();
                write(&mut device, latched[rng.below(latched.len() as u32) as usize], word);
                if rng.once_in(3) {
                    write(&mut device, pree::CONTROL, Control::default().with_start(true).bits());
                    prop_assert_eq!(error(&mut device), (ErrorCode::NotIdle, 0));
                    prop_assert!(error_raised(&mut device));
                }
                device.advance(1 + u64::from(rng.below(9)));
            }
            prop_assert_eq!(state(&mut device), State::Idle);
            job.place_registers(&mut device);
        }
        prop_assert_eq!(job.hits_in(&device), job.hits_in(&quiet));
        prop_assert_eq!(job.pixels_in(&device), job.pixels_in(&quiet));
        let counters = |device: &mut Any| {
            let mut counters = job::counters(device);
            counters.retain(|(counter, _)| *counter != Counter::StarvedCycles);
            counters
        };
        prop_assert_eq!(counters(&mut device), counters(&mut quiet));
    }
}

fn small_job() -> Job {
    let kind = Kind { preus: 4, format: NumberFormat::F32, soft: false };
    let mut job = SMALL.job(kind, Config::RESET);
    job.photons.truncate(40);
    job.ring_entries = 64;
    job
}

/// Runs a job with something changed before START; gives the error, and checks what every error has in common.
fn provoked(
    mode: Mode,
    change: impl FnOnce(&mut Job),
    tamper: impl FnOnce(&Job, &mut Any),
) -> (ErrorCode, u32) {
    let mut job = small_job();
    change(&mut job);
    let mut device = job.device();
    tamper(&job, &mut device);
    let config = read(&mut device, pree::CONFIG);
    let mode_bit = mode.bits();
    write(
        &mut device,
        pree::CONFIG,
        if config == Config::RESET.bits() { job.config.with_mode(mode).bits() } else { config | mode_bit },
    );
    write(&mut device, pree::CONTROL, Control::default().with_start(true).bits());
    if state(&mut device) == State::Running && mode == Mode::Update {
        write(&mut device, pree::RING_TAIL, 40);
        job::flush(&mut device);
    }
    device.advance(100_000);
    assert_eq!(state(&mut device), State::Fault);
    assert!(error_raised(&mut device) && device.interrupt());
    let found = error(&mut device);
    // FAULT is left by ABORT, and the same device does the right job right afterwards.
    job::abort(&mut device);
    assert_eq!((state(&mut device), error(&mut device)), (State::Idle, (ErrorCode::None, 0)));
    let good = small_job();
    if good.bases() == job.bases() {
        good.place(&mut device);
        good.update(&mut device);
        assert_eq!(good.hits_in(&device), lucerna_tests::inorder::update(&good).0);
    }
    found
}

/// All photons of a job into its ring, before START.
fn fill_ring(job: &Job, device: &mut Any) {
    let words = job.record_words();
    for (number, photon) in job.photons.iter().enumerate() {
        device.store(job.bases().ring + (number * words * 4) as u32, &photon[..words]).unwrap();
    }
}

#[test]
fn bad_config() {
    for (mode, bits) in [
        (Mode::Update, Config::RESET.bits() | 3 << 2),
        (Mode::Evaluate, Config::RESET.bits() | 3 << 2),
        (Mode::Update, Config::RESET.bits() & !(7 << 5)),
        (Mode::Update, Config::RESET.bits() | 7 << 5),
    ] {
        let found = provoked(mode, |_| {}, |_, device| write(device, pree::CONFIG, bits));
        assert_eq!(found, (ErrorCode::BadConfig, 0), "{bits:#x}");
    }
}

#[test]
fn bad_ring() {
    for entries in [0, 3, 63, 65_537, 131_072, u32::MAX, 1 << 31] {
        let found = provoked(Mode::Update, |_| {}, |_, device| write(device, pree::RING_ENTRIES, entries));
        assert_eq!(found, (ErrorCode::BadRing, 0), "{entries}");
    }
}

#[test]
fn window_of_each_buffer() {
    let bases = small_job().bases();
    for (mode, offset, base) in [
        (Mode::Update, pree::HIT_BASE, bases.hits),
        (Mode::Update, pree::INDEX_BASE, bases.index),
        (Mode::Update, pree::RING_BASE, bases.ring),
        (Mode::Evaluate, pree::HIT_BASE, bases.hits),
        (Mode::Evaluate, pree::PIXEL_BASE, bases.pixels),
    ] {
        for wrong in [base - 4, base + 4, base + 1, base + 2, 0x3fff_fffc] {
            let found = provoked(mode, |_| {}, |_, device| write(device, offset, wrong));
            assert_eq!(found, (ErrorCode::Window, wrong), "{mode:?} {offset:#x}");
        }
    }
    // One word too short, at either end; a window that is closed; one beyond the memory's end.
    for (offset, limit) in [
        (window::limit(0), bases.index - 24),
        (window::base(0), bases.hits + 4),
        (window::limit(0), bases.hits),
    ] {
        let found = provoked(Mode::Update, |_| {}, |_, device| write(device, offset, limit));
        assert_eq!(found, (ErrorCode::Window, bases.hits));
    }
    let found = provoked(
        Mode::Update,
        |_| {},
        |job, device| {
            write(device, window::limit(3), u32::MAX);
            write(device, pree::RING_BASE, job.bases().end - 64 * 32 + 4);
        },
    );
    assert_eq!(found.0, ErrorCode::Window);
}

#[test]
fn ring_overrun() {
    let job = small_job();
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    write(&mut device, pree::RING_TAIL, 65);
    assert_eq!(state(&mut device), State::Fault);
    assert_eq!(error(&mut device).0, ErrorCode::RingOverrun);
    assert!(error_raised(&mut device) && device.interrupt());
    // Behind the head is far ahead of it.
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    job.push(&mut device, 40);
    device.advance(500);
    assert_eq!(read(&mut device, pree::RING_HEAD), 40);
    write(&mut device, pree::RING_TAIL, 39);
    assert_eq!(error(&mut device).0, ErrorCode::RingOverrun);
    // More after the flush, which said that there is no more; the same tail again says nothing new.
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    job.push(&mut device, 20);
    job::flush(&mut device);
    write(&mut device, pree::RING_TAIL, 20);
    assert_eq!(state(&mut device), State::Running);
    write(&mut device, pree::RING_TAIL, 21);
    assert_eq!(error(&mut device), (ErrorCode::RingOverrun, job.bases().ring));
    // Exactly full is no error.
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    write(&mut device, pree::RING_TAIL, 64);
    assert_eq!(state(&mut device), State::Running);
}

#[test]
fn index_range() {
    for photon in [0, 17, 39] {
        for (p_addr, n) in [(4_848, 1), (4_840, 9), (0, 4_849), (u32::MAX, 1), (1, u32::MAX), (4_849, 0)] {
            let change = |job: &mut Job| job.photons[photon][6..8].copy_from_slice(&[p_addr, n]);
            let expected = small_job().bases().ring + photon as u32 * 32;
            let found = provoked(Mode::Update, change, fill_ring);
            assert_eq!(found, (ErrorCode::IndexRange, expected), "{p_addr} {n}");
        }
    }
    // The last entry itself is none.
    let mut job = small_job();
    job.photons[5][6..8].copy_from_slice(&[4_847, 1]);
    let mut device = job.device();
    job.update(&mut device);
    assert_eq!(error(&mut device).0, ErrorCode::None);
}

#[test]
fn hit_range() {
    let job = small_job();
    let entry = job.photons[3][6];
    for number in [606, 607, u32::MAX] {
        let found = provoked(Mode::Update, |job| job.index[entry as usize] = number, fill_ring);
        assert_eq!(found, (ErrorCode::HitRange, job.bases().index + entry * 4));
    }
}

#[test]
fn pixel_range() {
    for (hit, pixel) in [(0, 300), (605, 301), (300, u32::MAX)] {
        let found = provoked(Mode::Evaluate, |job| job.hits[hit][14] = pixel, |_, _| {});
        assert_eq!(found, (ErrorCode::PixelRange, small_job().bases().hits + hit as u32 * 64));
    }
}

#[test]
fn too_large() {
    for (mode, offset, count) in [
        (Mode::Update, pree::HIT_COUNT, 1 << 26),
        (Mode::Update, pree::HIT_COUNT, u32::MAX),
        (Mode::Update, pree::INDEX_COUNT, 1 << 30),
        (Mode::Evaluate, pree::PIXEL_COUNT, 0x1555_5556),
        (Mode::Evaluate, pree::HIT_COUNT, 0x1000_0000),
    ] {
        let found = provoked(mode, |_| {}, |_, device| write(device, offset, count));
        assert_eq!(found.0, ErrorCode::TooLarge, "{offset:#x} {count:#x}");
    }
}

/// A START that comes too early is an error, but not the one that ended the job.
#[test]
fn not_idle_hides_nothing() {
    let mut job = small_job();
    let entry = job.photons[30][6];
    job.index[entry as usize] = 606;
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    job.push(&mut device, u32::MAX);
    job::flush(&mut device);
    job.start(&mut device, Mode::Update);
    assert_eq!(error(&mut device).0, ErrorCode::NotIdle);
    assert_eq!(state(&mut device), State::Running);
    device.advance(100_000);
    assert_eq!(state(&mut device), State::Fault);
    assert_eq!(error(&mut device), (ErrorCode::HitRange, job.bases().index + entry * 4));
    assert!(error_raised(&mut device));
}

/// The status bits of a job that is done come once, and go when they are written.
#[test]
fn interrupts_are_levels_of_status_and_enable() {
    let job = small_job();
    let mut device = job.device();
    job.update(&mut device);
    let done = interrupts::Status::from_bits(read(&mut device, interrupts::STATUS));
    assert!(done.done() && !done.error());
    assert!(device.interrupt());
    write(&mut device, interrupts::STATUS, 0);
    assert!(device.interrupt(), "zeros clear nothing");
    write(&mut device, interrupts::STATUS, u32::MAX);
    assert!(!device.interrupt());
    device.advance(100);
    assert_eq!(read(&mut device, interrupts::STATUS), 0, "an idle device raises nothing");
    write(&mut device, interrupts::ENABLE, 0);
    job.update(&mut device);
    assert!(!device.interrupt() && read(&mut device, interrupts::STATUS) != 0);
}

/// RING_SPACE belongs to a running job: a doorbell at an idle device is no reason for an interrupt.
#[test]
fn an_idle_device_has_no_ring_to_speak_of() {
    let job = small_job();
    let mut device = job.device();
    write(&mut device, pree::RING_TAIL, 5);
    device.advance(10);
    assert_eq!(read(&mut device, interrupts::STATUS), 0);
    // Nor has an evaluation one.
    job.start(&mut device, Mode::Evaluate);
    write(&mut device, pree::RING_TAIL, 5);
    device.advance(10);
    assert_eq!(state(&mut device), State::Running);
    assert_eq!(read(&mut device, interrupts::STATUS), 0);
}

#[test]
fn ring_space_comes_when_the_ring_falls_to_its_mark() {
    let mut job = small_job();
    job.ring_low = 10;
    let mut device = job.device();
    job.start(&mut device, Mode::Update);
    job.push(&mut device, 40);
    let mut before = 40;
    loop {
        device.tick();
        let waiting = 40 - read(&mut device, pree::RING_HEAD);
        let raised = interrupts::Status::from_bits(read(&mut device, interrupts::STATUS)).ring_space();
        assert_eq!(raised, waiting <= 10, "{before} and now {waiting} waiting");
        if waiting == 0 {
            break;
        }
        before = waiting;
    }
}

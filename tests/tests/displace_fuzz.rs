//! Does nonsense on a device with both units ever do more than give the error code for it? And is `advance` always `tick`?
//!
//! Devices of any sizes and format, jobs right and wrong, numbers of any bits; all through the bus.

use lucerna_bus::{Bus, Model, Target, Timing};
use lucerna_displace::engine::Sizes;
use lucerna_driver::NumberFormat;
use lucerna_regs::displace::{self as regs, Control, ErrorCode, State, Status};
use lucerna_regs::{REGISTERS, counters, displace_counters, interrupts, pree, window};
use lucerna_tests::descriptor::{Descriptor, OPEN, WORDS, legal, spoil};
use lucerna_tests::devices::{Any, full};
use lucerna_tests::random::{Rng, sizes};
use proptest::prelude::*;

/// The same device twice, run in both ways.
struct Twins([Model<Any>; 2]);

impl Twins {
    fn new(format: NumberFormat, soft: bool, sizes: Sizes, memory: &[u32]) -> Self {
        Self([Timing::Fast, Timing::Tick].map(|timing| {
            // The twins' arithmetic differs too: the host's and the soft one agree to the bit.
            let device = full(format, soft ^ (timing == Timing::Tick), sizes, memory.to_vec());
            Model::new(device).with_timing(timing)
        }))
    }

    fn read(&self, offset: u32) -> u32 {
        let [fast, tick] = self.0.each_ref().map(|model| model.bus().read(offset).expect("a register"));
        assert_eq!(fast, tick, "{offset:#x}");
        fast
    }

    fn write(&self, offset: u32, value: u32) {
        self.0.iter().for_each(|model| model.bus().write(offset, value).expect("a register"));
    }

    fn advance(&self, cycles: u64) {
        self.0.iter().for_each(|model| model.advance(cycles));
    }

    fn place(&self, descriptor: &Descriptor) {
        descriptor.registers.iter().for_each(|(offset, value)| self.write(*offset, *value));
    }

    fn control(&self, control: Control) {
        self.write(regs::CONTROL, control.bits());
    }

    fn state(&self) -> State {
        Status::from_bits(self.read(regs::STATUS)).state().expect("a state of the map")
    }

    fn error(&self) -> (ErrorCode, u32) {
        let code = regs::Error::from_bits(self.read(regs::ERROR)).code().expect("a code of the map");
        (code, self.read(regs::FAULT_ADDRESS))
    }

    fn memory(&self) -> Vec<u32> {
        let [fast, tick] = self.0.each_ref().map(|model| {
            let mut words = vec![0; WORDS as usize];
            model.inspect(|device| device.load(0, &mut words)).expect("all of it");
            words
        });
        assert!(fast == tick, "memories differ");
        fast
    }

    /// Every register of both, counters of now included.
    fn compare(&self) {
        self.write(counters::CONTROL, counters::Control::default().with_snapshot(true).bits());
        self.write(
            displace_counters::CONTROL,
            displace_counters::Control::default().with_snapshot(true).bits(),
        );
        REGISTERS.iter().for_each(|register| {
            self.read(register.offset);
        });
        self.memory();
    }

    /// Idle at once, by ABORT alone, and nothing happens any more.
    fn abort(&self) {
        self.control(Control::default().with_abort(true));
        self.write(pree::CONTROL, pree::Control::default().with_abort(true).bits());
        assert_eq!((self.state(), self.error()), (State::Idle, (ErrorCode::None, 0)));
        let before = self.memory();
        self.advance(500);
        assert!(self.memory() == before, "an idle device writes nothing");
    }
}

/// Cycles in which a job has to end, however unlucky: every step a miss behind all the others' lines.
fn bound(sizes: &Sizes, rays: u32, watchdog: u32) -> u64 {
    let line = u64::from(sizes.height_cache.line_bytes.max(sizes.texture_cache.line_bytes));
    let fill = u64::from(sizes.port.latency) + 64 * line.div_ceil(u64::from(sizes.port.bytes_per_cycle));
    200 + u64::from(rays) * (u64::from(watchdog) + 4) * (fill + 30)
}

fn formats() -> impl Strategy<Value = (NumberFormat, bool)> {
    (prop::sample::select(vec![NumberFormat::F24, NumberFormat::F32]), any::<bool>())
}

fn outside(word: u32) -> bool {
    !OPEN.contains(&(word * 4))
}

fn unchanged(before: &[u32], after: &[u32]) -> bool {
    (0..WORDS).filter(|word| outside(*word)).all(|word| before[word as usize] == after[word as usize])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// START says what is wrong, if anything is; a job that begins ends in time, and only its results change.
    #[test]
    fn a_job_is_refused_for_a_reason_or_runs_to_its_end((format, soft) in formats(), seed in any::<u64>(), wrong in 0u32..4) {
        let mut rng = Rng(seed);
        let sizes = sizes(&mut rng);
        let mut descriptor = legal(&mut rng, format);
        prop_assert_eq!(descriptor.faults(), []);
        (0..wrong).for_each(|_| spoil(&mut rng, &mut descriptor));
        let twins = Twins::new(format, soft, sizes, &descriptor.memory);
        twins.place(&descriptor);
        twins.control(Control::default().with_start(true));
        let faults = descriptor.faults();
        let rays = descriptor.rays();
        if !faults.is_empty() {
            prop_assert!(faults.contains(&twins.error()), "{:?} is none of {faults:?}", twins.error());
            prop_assert_eq!(twins.state(), State::Fault);
            prop_assert!(interrupts::Status::from_bits(twins.read(interrupts::STATUS)).displace_error());
            prop_assert!(twins.memory() == descriptor.memory, "a refused job touches nothing");
            twins.abort();
            return Ok(());
        }
        // Aborted on its way, it is started once more.
        if rng.once_in(4) {
            twins.advance(u64::from(rng.below(300)));
            twins.abort();
            twins.control(Control::default().with_start(true));
        }
        let most = bound(&sizes, rays, descriptor.word(regs::WATCHDOG));
        let start = twins.0[0].elapsed();
        while twins.state() == State::Running {
            twins.advance(u64::from(1 + rng.below(800)));
            prop_assert!(twins.0[0].elapsed() - start < most + 1000, "no end after {most} cycles");
        }
        twins.compare();
        let after = twins.memory();
        let results = descriptor.word(regs::RESULT_BASE) / 4;
        let done = twins.read(regs::RAYS_DONE);
        match twins.error() {
            (ErrorCode::None, 0) => {
                prop_assert_eq!((twins.state(), done), (State::Idle, rays));
                prop_assert!(interrupts::Status::from_bits(twins.read(interrupts::STATUS)).displace_done());
                // A list of no ray has its results anywhere.
                for record in after.get(results as usize..).unwrap_or_default().chunks(8).take(rays as usize) {
                    prop_assert!(record[3] >> 24 < 4 && record[4] >> 24 == 0 && record[7] == 0, "{record:x?}");
                    prop_assert!(record[3] & 0xffff <= descriptor.word(regs::WATCHDOG));
                }
            }
            (code, address) => {
                let stop = regs::Config::from_bits(descriptor.word(regs::CONFIG)).ray_faults() == regs::RayFaults::Stop;
                prop_assert!(stop && twins.state() == State::Fault);
                let status = after[address as usize / 4 + 3] >> 24;
                prop_assert_eq!(status, match code { ErrorCode::GrazingRay => 2, ErrorCode::Watchdog => 3, _ => 99 });
                let word = address / 4 - results;
                    prop_assert!(word.is_multiple_of(8) && word / 8 < rays);
            }
        }
        for word in 0..WORDS {
            let result = (results..results + rays * 8).contains(&word);
            prop_assert!(result || after[word as usize] == descriptor.memory[word as usize], "word {word:#x}");
        }
        twins.abort();
    }

    /// Any register, any word, in any order, with both units at work.
    #[test]
    fn anything_goes((format, soft) in formats(), seed in any::<u64>(), acts in 10u32..120) {
        let mut rng = Rng(seed);
        let descriptor = legal(&mut rng, format);
        let twins = Twins::new(format, soft, sizes(&mut rng), &descriptor.memory);
        // A window that is closed by zeros would be opened from 0 on by its limit alone.
        (0..window::COUNT).for_each(|number| twins.write(window::base(number), OPEN.start));
        twins.place(&descriptor);
        let mut memory = descriptor.memory.clone();
        for _ in 0..acts {
            match rng.below(8) {
                0..3 => {
                    // Windows stay within their part of the memory.
                    let offset = if rng.once_in(10) { rng.word() } else { REGISTERS[rng.below(REGISTERS.len() as u32) as usize].offset };
                    let value = match offset {
                        _ if window::at(offset).is_some() => OPEN.start + 4 * rng.below((OPEN.end - OPEN.start) / 4),
                        _ if rng.once_in(3) => rng.word(),
                        pree::RING_ENTRIES => 1 << rng.below(6),
                        _ if rng.once_in(2) => (OPEN.start + 64 * rng.below(220)) & !63,
                        _ => rng.below(40),
                    };
                    let answers = twins.0.each_ref().map(|model| model.bus().write(offset, value));
                    prop_assert_eq!(answers[0], answers[1]);
                }
                3 => {
                    let offset = if rng.once_in(2) { rng.word() } else { rng.below(0x600) };
                    let answers = twins.0.each_ref().map(|model| model.bus().read(offset));
                    prop_assert_eq!(answers[0], answers[1]);
                    prop_assert_eq!(answers[0].is_ok(), lucerna_regs::describe(offset).is_some(), "{:#x}", offset);
                }
                4 => {
                    let first = rng.below(WORDS);
                    let words: Vec<u32> = (0..rng.below(20).min(WORDS - first)).map(|_| rng.word()).collect();
                    twins.0.iter().for_each(|model| model.bus().write_block(first * 4, &words).expect("in memory"));
                    memory[first as usize..][..words.len()].copy_from_slice(&words);
                }
                5 => twins.control(Control::default().with_start(true).with_abort(rng.once_in(2))),
                6 => twins.write(pree::CONTROL, rng.below(8)),
                _ => twins.advance(u64::from(rng.below(300))),
            }
            if twins.state() == State::Fault {
                prop_assert_ne!(twins.error().0, ErrorCode::None);
            }
            if rng.once_in(12) {
                twins.place(&legal(&mut rng, format));
            }
        }
        twins.compare();
        prop_assert!(unchanged(&memory, &twins.memory()), "words outside all windows");
        twins.abort();
    }
}

//! A job at register level, without the driver; in: records and policies, out: a device with the job laid out, photons pushed,
//! everything visible read back; cost: the device's.
//!
//! Each buffer has a window of its own, and words that belong to nobody between them: canaries.

use lucerna_bus::Target;
use lucerna_regs::counters::Counter;
use lucerna_regs::pree::{self, Config, Control, Mode, State, Status};
use lucerna_regs::{counters, interrupts, window};

use crate::devices::{Any, Kind};

/// Words of nobody before, between and behind the buffers.
const GAP: u32 = 5;
/// What is in them.
pub const CANARY: u32 = 0xdead_beef;
/// One past the last register.
pub const REGISTER_BYTES: u32 = 0x300;

/// A job of both modes.
#[derive(Clone, Debug)]
pub struct Job {
    /// The device it is for.
    pub kind: Kind,
    /// Everything but the mode.
    pub config: Config,
    /// In the device's format.
    pub alpha: u32,
    /// In the device's format.
    pub emitted: u32,
    /// Records.
    pub hits: Vec<[u32; 16]>,
    /// Hit-point numbers.
    pub index: Vec<u32>,
    /// Records; the last four words only with the normal test.
    pub photons: Vec<[u32; 12]>,
    /// What the pixels hold before.
    pub pixels: Vec<[u32; 3]>,
    /// A power of two.
    pub ring_entries: u32,
    /// The low mark.
    pub ring_low: u32,
}

/// Byte addresses.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Bases {
    /// Hit points.
    pub hits: u32,
    /// Index table.
    pub index: u32,
    /// Pixels.
    pub pixels: u32,
    /// Ring.
    pub ring: u32,
    /// End of the memory.
    pub end: u32,
}

/// Everything software can see: all registers (after a snapshot), the memory, the interrupt line.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Visible {
    /// By offset; `None` where there is none.
    pub registers: Vec<Option<u32>>,
    /// All of it.
    pub memory: Vec<u32>,
    /// Its level.
    pub interrupt: bool,
}

impl Job {
    /// Words of a photon's record.
    pub fn record_words(&self) -> usize {
        if self.config.normal_test() { 12 } else { 8 }
    }

    /// Where everything is.
    pub fn bases(&self) -> Bases {
        let mut word = 0;
        let mut next = |words: usize| {
            let base = word + GAP;
            word = base + words as u32;
            base * 4
        };
        let hits = next(self.hits.len() * 16);
        let index = next(self.index.len());
        let pixels = next(self.pixels.len() * 3);
        let ring = next(self.ring_entries as usize * self.record_words());
        Bases { hits, index, pixels, ring, end: next(0) }
    }

    /// A fresh device with the job in memory and registers, and all interrupts enabled.
    pub fn device(&self) -> Any {
        let mut device = self.kind.build(vec![CANARY; self.bases().end as usize / 4]);
        self.place(&mut device);
        device
    }

    /// Writes memory and registers.
    pub fn place(&self, target: &mut impl Target) {
        let bases = self.bases();
        let mut store =
            |address, words: &[u32]| target.store(address, words).expect("laid out inside the memory");
        store(bases.hits, self.hits.as_flattened());
        store(bases.index, &self.index);
        store(bases.pixels, self.pixels.as_flattened());
        self.place_registers(target);
    }

    /// Writes the registers alone.
    pub fn place_registers(&self, target: &mut impl Target) {
        let bases = self.bases();
        let sizes = [
            (bases.hits, self.hits.len() * 16),
            (bases.index, self.index.len()),
            (bases.pixels, self.pixels.len() * 3),
            (bases.ring, self.ring_entries as usize * self.record_words()),
        ];
        for (number, (base, words)) in sizes.into_iter().enumerate() {
            write(target, window::base(number), base);
            write(target, window::limit(number), base + words as u32 * 4);
        }
        for (offset, value) in [
            (pree::ALPHA, self.alpha),
            (pree::EMITTED, self.emitted),
            (pree::HIT_BASE, bases.hits),
            (pree::HIT_COUNT, self.hits.len() as u32),
            (pree::INDEX_BASE, bases.index),
            (pree::INDEX_COUNT, self.index.len() as u32),
            (pree::PIXEL_BASE, bases.pixels),
            (pree::PIXEL_COUNT, self.pixels.len() as u32),
            (pree::RING_BASE, bases.ring),
            (pree::RING_ENTRIES, self.ring_entries),
            (pree::RING_LOW, self.ring_low),
            (interrupts::ENABLE, 7),
        ] {
            write(target, offset, value);
        }
    }

    /// Starts one of the modes.
    pub fn start(&self, target: &mut impl Target, mode: Mode) {
        write(target, pree::CONFIG, self.config.with_mode(mode).bits());
        write(target, pree::CONTROL, Control::default().with_start(true).bits());
    }

    /// Puts photons into the ring: as many as there are, `at_most`, and as the ring has room for. Says how many.
    pub fn push(&self, target: &mut impl Target, at_most: u32) -> u32 {
        let (head, tail) = (read(target, pree::RING_HEAD), read(target, pree::RING_TAIL));
        let room = self.ring_entries - tail.wrapping_sub(head);
        let count = at_most.min(room).min(self.photons.len() as u32 - tail);
        let words = self.record_words();
        for number in tail..tail + count {
            let address = self.bases().ring + number % self.ring_entries * words as u32 * 4;
            target.store(address, &self.photons[number as usize][..words]).expect("a slot of the ring");
        }
        if count > 0 {
            write(target, pree::RING_TAIL, tail + count);
        }
        count
    }

    /// Runs the update to its end, the ring kept full.
    ///
    /// # Panics
    /// When it does not come to one.
    pub fn update(&self, target: &mut impl Target) {
        self.start(target, Mode::Update);
        let mut pushed = 0;
        for _ in 0..10_000 {
            if state(target) != State::Running {
                return;
            }
            if pushed < self.photons.len() {
                pushed += self.push(target, u32::MAX) as usize;
            } else {
                flush(target);
            }
            target.advance(64);
        }
        panic!("the update does not end");
    }

    /// Runs the evaluation to its end.
    ///
    /// # Panics
    /// When it does not come to one.
    pub fn evaluate(&self, target: &mut impl Target) {
        self.start(target, Mode::Evaluate);
        for _ in 0..10_000 {
            if state(target) != State::Running {
                return;
            }
            target.advance(64);
        }
        panic!("the evaluation does not end");
    }

    /// The hit points in memory.
    pub fn hits_in(&self, target: &impl Target) -> Vec<[u32; 16]> {
        let mut hits = vec![[0; 16]; self.hits.len()];
        target.load(self.bases().hits, hits.as_flattened_mut()).expect("laid out inside the memory");
        hits
    }

    /// The pixels in memory.
    pub fn pixels_in(&self, target: &impl Target) -> Vec<[u32; 3]> {
        let mut pixels = vec![[0; 3]; self.pixels.len()];
        target.load(self.bases().pixels, pixels.as_flattened_mut()).expect("laid out inside the memory");
        pixels
    }

    /// The whole memory.
    pub fn memory_in(&self, target: &impl Target) -> Vec<u32> {
        let mut words = vec![0; self.bases().end as usize / 4];
        target.load(0, &mut words).expect("all of the memory");
        words
    }
}

/// Reads a register that is there.
///
/// # Panics
/// When it is not.
pub fn read(target: &mut impl Target, offset: u32) -> u32 {
    target.read(offset).unwrap_or_else(|error| panic!("{offset:#x}: {error}"))
}

/// Writes a register that is there.
///
/// # Panics
/// When it is not.
pub fn write(target: &mut impl Target, offset: u32, value: u32) {
    target.write(offset, value).unwrap_or_else(|error| panic!("{offset:#x}: {error}"));
}

/// The engine's state.
///
/// # Panics
/// When it is none of the register map's.
pub fn state(target: &mut impl Target) -> State {
    Status::from_bits(read(target, pree::STATUS)).state().expect("a state of the map")
}

/// No photon will come behind those in the ring.
pub fn flush(target: &mut impl Target) {
    write(target, pree::CONTROL, Control::default().with_flush(true).bits());
}

/// To idle at once.
pub fn abort(target: &mut impl Target) {
    write(target, pree::CONTROL, Control::default().with_abort(true).bits());
}

/// Takes a snapshot and reads all counters of it.
pub fn counters(target: &mut impl Target) -> Vec<(Counter, u64)> {
    write(target, counters::CONTROL, counters::Control::default().with_snapshot(true).bits());
    Counter::ALL
        .into_iter()
        .map(|counter| {
            let value =
                u64::from(read(target, counter.low())) | u64::from(read(target, counter.high())) << 32;
            (counter, value)
        })
        .collect()
}

/// One counter, now.
///
/// # Panics
/// When there is no such counter.
pub fn count(target: &mut impl Target, counter: Counter) -> u64 {
    counters(target).into_iter().find(|(other, _)| *other == counter).expect("one of all").1
}

/// Sets the counters to 0.
pub fn clear_counters(target: &mut impl Target) {
    write(target, counters::CONTROL, counters::Control::default().with_clear(true).bits());
}

/// Everything software can see; the snapshot is the only thing it changes.
///
/// # Panics
/// When the memory is not `words` long.
pub fn visible(target: &mut impl Target, words: usize) -> Visible {
    write(target, counters::CONTROL, counters::Control::default().with_snapshot(true).bits());
    let mut memory = vec![0; words];
    target.load(0, &mut memory).expect("all of the memory");
    Visible {
        registers: (0..REGISTER_BYTES).step_by(4).map(|offset| target.read(offset).ok()).collect(),
        memory,
        interrupt: target.interrupt(),
    }
}

/// The offsets at which two views differ, for messages.
pub fn differences(a: &Visible, b: &Visible) -> String {
    let registers = a.registers.iter().zip(&b.registers).enumerate().filter(|(_, (a, b))| a != b);
    let registers = registers.map(|(i, (a, b))| {
        let name =
            lucerna_regs::describe(i as u32 * 4).map_or("counter or nothing", |register| register.name);
        format!("register {:#x} ({name}): {a:x?} and {b:x?}\n", i * 4)
    });
    let memory = a.memory.iter().zip(&b.memory).enumerate().filter(|(_, (a, b))| a != b);
    let memory = memory.map(|(i, (a, b))| format!("memory {:#x}: {a:#x} and {b:#x}\n", i * 4));
    registers
        .chain(memory.take(8))
        .chain([format!("interrupt: {} and {}", a.interrupt, b.interrupt)])
        .collect()
}

//! A device of the register map without arithmetic: enough to drive a driver into every corner.
//!
//! Update takes a photon record every `pace` clocks and keeps it in `taken`; evaluation takes a clock a hit point
//! and adds the words of its flux to its pixel. Knobs make it fail.
#![allow(dead_code, reason = "each test file uses its part")]

pub mod displacer;

use embedded_hal::delay::DelayNs;
use lucerna_bus::{Model, Target, TargetError};
use lucerna_driver::{
    Capabilities, ErrorCode, EvaluateJob, HitPoint, Layout, Lucerna, Photon, Policies, Sizes, UpdateJob,
};
use lucerna_regs::pree::{Config, Control, Mode, State};
use lucerna_regs::{counters, ident, interrupts, pree};

pub const MEMORY_BYTES: u32 = 64 * 1024;

#[derive(Clone, Debug)]
pub struct Fake {
    pub registers: [u32; 0x280 / 4],
    pub memory: Vec<u32>,
    /// Records taken from the ring, whole.
    pub taken: Vec<Vec<u32>>,
    /// Reads of RING_HEAD.
    pub head_reads: u64,
    pub starts: u64,
    flushing: bool,
    clock: u64,
    // The knobs.
    /// Clocks a photon.
    pub pace: u64,
    /// Ends the next job in this error, at this address, after so many photons.
    pub error: Option<(u64, ErrorCode, u32)>,
    /// The interrupt line is cut.
    pub cut: bool,
    /// The interrupt line is stuck high.
    pub stuck_high: bool,
    /// ABORT does nothing.
    pub deaf: bool,
    /// The device does not get on.
    pub asleep: bool,
}

impl Default for Fake {
    fn default() -> Self {
        let mut fake = Self {
            registers: [0; 0x280 / 4],
            memory: vec![0; MEMORY_BYTES as usize / 4],
            taken: Vec::new(),
            head_reads: 0,
            starts: 0,
            flushing: false,
            clock: 0,
            pace: 8,
            error: None,
            cut: false,
            stuck_high: false,
            deaf: false,
            asleep: false,
        };
        fake.set(ident::ID, ident::ID_RESET);
        fake.set(ident::VERSION, ident::Version::RESET.bits());
        fake.set(ident::CAPABILITIES, ident::Capabilities::RESET.with_preus(8).bits());
        fake.set(ident::PIPELINE, ident::Pipeline::RESET.with_operand_latency(1).bits());
        fake.set(ident::MEMORY_BYTES, MEMORY_BYTES);
        fake
    }
}

impl Fake {
    pub fn get(&self, offset: u32) -> u32 {
        self.registers[offset as usize / 4]
    }

    pub fn set(&mut self, offset: u32, value: u32) {
        self.registers[offset as usize / 4] = value;
    }

    pub fn state(&self) -> State {
        pree::Status::from_bits(self.get(pree::STATUS)).state().unwrap_or(State::Idle)
    }

    fn become_(&mut self, state: State) {
        let status = pree::Status::default().with_state(state).with_flushing(self.flushing);
        self.set(pree::STATUS, status.bits());
    }

    fn raise(&mut self, event: interrupts::Status) {
        self.set(interrupts::STATUS, self.get(interrupts::STATUS) | event.bits());
    }

    fn fail(&mut self, code: ErrorCode, address: u32) {
        self.set(pree::ERROR, pree::Error::default().with_code(code).bits());
        self.set(pree::FAULT_ADDRESS, address);
        self.raise(interrupts::Status::default().with_error(true));
        if code != ErrorCode::NotIdle {
            self.become_(State::Fault);
        }
    }

    fn control(&mut self, control: Control) {
        if control.abort() && !self.deaf {
            self.flushing = false;
            self.become_(State::Idle);
        }
        if control.start() {
            if self.state() == State::Running {
                return self.fail(ErrorCode::NotIdle, 0);
            }
            self.set(pree::ERROR, 0);
            self.set(pree::RING_HEAD, 0);
            self.set(pree::RING_TAIL, 0);
            self.flushing = false;
            self.clock = 0;
            self.starts += 1;
            self.taken.clear();
            self.become_(State::Running);
        }
        if control.flush() && self.state() == State::Running {
            self.flushing = true;
            self.become_(State::Running);
        }
    }

    fn done(&mut self) {
        self.flushing = false;
        self.become_(State::Idle);
        self.raise(interrupts::Status::default().with_done(true));
    }

    fn place(address: u32, words: usize, size: usize) -> Result<std::ops::Range<usize>, TargetError> {
        let first = address as usize / 4;
        match () {
            () if !address.is_multiple_of(4) => Err(TargetError::Misaligned),
            () if first + words > size => Err(TargetError::OutOfRange),
            () => Ok(first..first + words),
        }
    }

    fn update(&mut self, config: Config) {
        let (head, tail) = (self.get(pree::RING_HEAD), self.get(pree::RING_TAIL));
        let (entries, waiting) = (self.get(pree::RING_ENTRIES), tail.wrapping_sub(head));
        if let Some((after, code, address)) = self.error
            && self.taken.len() as u64 >= after
        {
            self.error = None;
            return self.fail(code, address);
        }
        if waiting > entries {
            return self.fail(ErrorCode::RingOverrun, 0);
        }
        if waiting == 0 {
            if self.flushing {
                self.done();
            }
            return;
        }
        if !self.clock.is_multiple_of(self.pace) {
            return;
        }
        let words = if config.normal_test() { 12 } else { 8 };
        let base = self.get(pree::RING_BASE) / 4 + head % entries * words;
        let record = self.memory[base as usize..(base + words) as usize].to_vec();
        self.taken.push(record);
        self.set(pree::RING_HEAD, head.wrapping_add(1));
        if waiting - 1 == self.get(pree::RING_LOW) {
            self.raise(interrupts::Status::default().with_ring_space(true));
        }
    }

    fn evaluate(&mut self) {
        if let Some((_, code, address)) = self.error.take() {
            return self.fail(code, address);
        }
        if self.clock < u64::from(self.get(pree::HIT_COUNT)) {
            return;
        }
        for hit in 0..self.get(pree::HIT_COUNT) {
            let record = (self.get(pree::HIT_BASE) / 4 + hit * 16) as usize;
            let pixel = (self.get(pree::PIXEL_BASE) / 4 + self.memory[record + 14] * 3) as usize;
            for channel in 0..3 {
                let sum = f32::from_bits(self.memory[pixel + channel])
                    + f32::from_bits(self.memory[record + 9 + channel]);
                self.memory[pixel + channel] = sum.to_bits();
            }
        }
        self.done();
    }
}

impl Target for Fake {
    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        self.head_reads += u64::from(offset == pree::RING_HEAD);
        Self::place(offset, 1, self.registers.len()).map(|place| self.registers[place.start])
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        Self::place(offset, 1, self.registers.len())?;
        match offset {
            pree::CONTROL => self.control(Control::from_bits(value)),
            interrupts::STATUS => self.set(offset, self.get(offset) & !value),
            counters::CONTROL => {
                let control = counters::Control::from_bits(value);
                for counter in counters::Counter::ALL {
                    // A snapshot nobody can confuse: the counter's number in both halves.
                    let number = counter.index() as u32 + 1;
                    let value = if control.snapshot() { number } else { 0 };
                    self.set(counter.low(), value);
                    self.set(counter.high(), value << 8);
                }
            }
            offset if lucerna_regs::describe(offset).is_some_and(|register| register.writable != 0) => {
                self.set(offset, value);
            }
            _ => {}
        }
        Ok(())
    }

    fn load(&self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
        words.copy_from_slice(&self.memory[Self::place(address, words.len(), self.memory.len())?]);
        Ok(())
    }

    fn store(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
        let place = Self::place(address, words.len(), self.memory.len())?;
        self.memory[place].copy_from_slice(words);
        Ok(())
    }

    fn tick(&mut self) {
        if self.state() != State::Running || self.asleep {
            return;
        }
        self.clock += 1;
        let config = Config::from_bits(self.get(pree::CONFIG));
        match config.mode() {
            Mode::Update => self.update(config),
            Mode::Evaluate => self.evaluate(),
        }
    }

    fn interrupt(&self) -> bool {
        let pending = self.get(interrupts::STATUS) & self.get(interrupts::ENABLE) != 0;
        self.stuck_high || (pending && !self.cut)
    }
}

/// A model of the fake, changed by `change` first.
pub fn model(change: impl FnOnce(&mut Fake)) -> Model<Fake> {
    let mut fake = Fake::default();
    change(&mut fake);
    Model::new(fake)
}

pub fn capabilities() -> Capabilities {
    let model = model(|_| {});
    *Lucerna::probe(model.bus(), model.delay()).unwrap().capabilities()
}

pub const SIZES: Sizes =
    Sizes { hit_points: 4, index_entries: 8, pixels: 2, ring_entries: 8, normal_test: false };

pub fn layout(sizes: Sizes) -> Layout {
    Layout::packed(&capabilities(), sizes).unwrap()
}

pub fn update_job(layout: &Layout) -> UpdateJob {
    UpdateJob::new(layout, 0.5, Policies::default()).unwrap()
}

pub fn evaluate_job(layout: &Layout) -> EvaluateJob {
    EvaluateJob::new(layout, 1000.0, Policies::default()).unwrap()
}

/// Photons that can be told apart.
pub fn photons(count: u32) -> Vec<Photon> {
    let photon = |number: u32| Photon {
        position: [number as f32, 1.0, 2.0],
        normal: [0.0, 1.0, 0.0],
        flux: [0.25, 0.5, number as f32 + 0.5],
        p_addr: number % 8,
        n: 1,
    };
    (0..count).map(photon).collect()
}

/// Four hit points over two pixels, whose flux adds up to [1.5, 3, 6] and [5.5, 11, 22].
pub fn hit_points() -> Vec<HitPoint> {
    let hit_point = |number: u32| {
        let flux = number as f32 + 0.25;
        HitPoint { flux: [flux, 2.0 * flux, 4.0 * flux], pixel: number / 2, ..HitPoint::default() }
    };
    (0..4).map(hit_point).collect()
}

/// A delay which takes no time at all.
#[derive(Debug)]
pub struct NoDelay;

impl DelayNs for NoDelay {
    fn delay_ns(&mut self, _: u32) {}
}

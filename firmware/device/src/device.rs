//! The wiring; in: accesses and clocks, out: words and the interrupt line; cost: the units' own.

use lucerna_bus::{Target, TargetError};
use lucerna_pree::engine::{Event, Pree, Status};
use lucerna_pree::job::{Fault, FaultCode};
use lucerna_pree::preu::components::{EVALUATE_STAGES, UPDATE_STAGES};
use lucerna_pree::schedule::ENTRIES;
use lucerna_pree::update::OPERAND_LATENCY;
use lucerna_regs::counters::Counter;
use lucerna_regs::ident::NumberFormat;
use lucerna_regs::{UNIT_PREE, counters, ident, interrupts, pree};
use lucerna_softfloat::{Format, FormatCode};

use crate::job::{self, Job};
use crate::registers::Registers;

/// A device with one PREE of `N` PREUs of format `F`, and memory `M`.
#[derive(Clone, Debug)]
pub struct Device<F, const N: usize, M> {
    registers: Registers,
    pree: Pree<F, N>,
    memory: M,
}

impl<F: Format, const N: usize, M: AsRef<[u32]> + AsMut<[u32]>> Device<F, N, M> {
    /// A device after reset, around its memory. Only the first 2^30 - 1 words of it can be addressed.
    pub fn new(memory: M) -> Self {
        Self { registers: Registers::default(), pree: Pree::new(), memory }
    }

    /// The memory, as it is.
    pub fn memory(&self) -> &[u32] {
        self.memory.as_ref()
    }

    fn memory_bytes(&self) -> u32 {
        u32::try_from(self.memory.as_ref().len()).map_or(u32::MAX / 4, |words| words.min(u32::MAX / 4)) * 4
    }

    /// The words `first..first + count` of the memory as indices, if they are there.
    fn span(&self, address: u32, count: usize) -> Result<core::ops::Range<usize>, TargetError> {
        if !address.is_multiple_of(4) {
            return Err(TargetError::Misaligned);
        }
        let first = (address / 4) as usize;
        let end = first.checked_add(count).ok_or(TargetError::OutOfRange)?;
        if end > (self.memory_bytes() / 4) as usize { Err(TargetError::OutOfRange) } else { Ok(first..end) }
    }

    fn control(&mut self, control: pree::Control) {
        if control.abort() {
            self.pree.abort();
            self.registers.clear_error();
        }
        if control.start() {
            self.start();
        }
        if control.flush() {
            self.pree.flush();
        }
    }

    fn start(&mut self) {
        if let Err(fault) = self.try_start() {
            self.pree.refuse(fault);
            self.registers.record(fault);
        }
    }

    fn try_start(&mut self) -> Result<(), Fault> {
        if self.pree.is_running() {
            return Err(Fault { code: FaultCode::NotIdle, address: 0 });
        }
        self.registers.clear_error();
        self.registers.tail = 0;
        match job::decode(&self.registers, self.memory_bytes())? {
            Job::Update(job) => self.pree.update(job),
            Job::Evaluate(job) => self.pree.evaluate(job),
        }
    }

    fn count(&mut self, control: counters::Control) {
        if control.snapshot() {
            self.registers.snapshot = *self.pree.counters();
        }
        if control.clear() {
            self.pree.clear_counters();
        }
    }

    /// What a clock, or many, left behind; `waiting` records were in the ring before. Not RING_TAIL less RING_HEAD: software
    /// may write the tail when no update runs, and that is no ring to fall low.
    fn settle(&mut self, waiting: u32, event: Option<Event>) {
        if waiting > self.registers.low && self.pree.ring().waiting <= self.registers.low {
            self.registers.status = self.registers.status.with_ring_space(true);
        }
        match event {
            None => {}
            Some(Event::Done) => self.registers.status = self.registers.status.with_done(true),
            Some(Event::Fault(fault)) => self.registers.record(fault),
        }
    }

    fn capabilities() -> ident::Capabilities {
        let format = match F::CODE {
            FormatCode::F32 => NumberFormat::F32,
            FormatCode::F24 => NumberFormat::F24,
        };
        ident::Capabilities::default()
            .with_preus(N as u32)
            .with_format(format)
            .with_buffer_entries(ENTRIES as u32)
            .with_units(UNIT_PREE)
    }

    fn pipeline() -> ident::Pipeline {
        ident::Pipeline::default()
            .with_update_stages(UPDATE_STAGES as u32)
            .with_evaluate_stages(EVALUATE_STAGES as u32)
            .with_operand_latency(OPERAND_LATENCY as u32)
    }

    fn status(&self) -> pree::Status {
        let idle = pree::Status::default();
        match self.pree.status() {
            Status::Idle => idle,
            Status::Running { starved, flushing } => {
                idle.with_state(pree::State::Running).with_starved(starved).with_flushing(flushing)
            }
            Status::Fault(_) => idle.with_state(pree::State::Fault),
        }
    }
}

impl<F: Format, const N: usize, M: AsRef<[u32]> + AsMut<[u32]>> Target for Device<F, N, M> {
    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        if !offset.is_multiple_of(4) {
            return Err(TargetError::Misaligned);
        }
        Ok(match offset {
            ident::ID => ident::ID_RESET,
            ident::VERSION => ident::Version::RESET.bits(),
            ident::CAPABILITIES => Self::capabilities().bits(),
            ident::PIPELINE => Self::pipeline().bits(),
            ident::MEMORY_BYTES => self.memory_bytes(),
            interrupts::STATUS => self.registers.status.bits(),
            interrupts::ENABLE => self.registers.enable.bits(),
            pree::CONTROL | counters::CONTROL => 0,
            pree::CONFIG => self.registers.config.bits(),
            pree::STATUS => self.status().bits(),
            pree::ERROR => pree::Error::default().with_code(self.registers.error).bits(),
            pree::FAULT_ADDRESS => self.registers.fault_address,
            pree::RING_HEAD => self.pree.ring().head,
            pree::RING_TAIL => self.registers.tail,
            _ => match Counter::at(offset) {
                Some((counter, half)) => half.of(self.registers.counter(counter)),
                None => *self.registers.plain(offset).ok_or(TargetError::Unmapped)?,
            },
        })
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        if !offset.is_multiple_of(4) {
            return Err(TargetError::Misaligned);
        }
        match offset {
            ident::ID | ident::VERSION | ident::CAPABILITIES | ident::PIPELINE | ident::MEMORY_BYTES => {}
            pree::STATUS | pree::ERROR | pree::FAULT_ADDRESS | pree::RING_HEAD => {}
            interrupts::STATUS => {
                let kept = self.registers.status.bits() & !value;
                self.registers.status = interrupts::Status::from_bits(kept);
            }
            interrupts::ENABLE => {
                self.registers.enable = interrupts::Enable::from_bits(value & interrupts::Enable::MASK);
            }
            pree::CONTROL => self.control(pree::Control::from_bits(value)),
            pree::CONFIG => self.registers.config = pree::Config::from_bits(value & pree::Config::MASK),
            pree::RING_TAIL => match self.pree.doorbell(value) {
                Ok(()) => self.registers.tail = value,
                Err(fault) => self.registers.record(fault),
            },
            counters::CONTROL => self.count(counters::Control::from_bits(value)),
            _ if Counter::at(offset).is_some() => {}
            _ => *self.registers.plain(offset).ok_or(TargetError::Unmapped)? = value,
        }
        Ok(())
    }

    fn load(&self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
        let span = self.span(address, words.len())?;
        words.copy_from_slice(&self.memory.as_ref()[span]);
        Ok(())
    }

    fn store(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
        let span = self.span(address, words.len())?;
        self.memory.as_mut()[span].copy_from_slice(words);
        Ok(())
    }

    fn tick(&mut self) {
        let waiting = self.pree.ring().waiting;
        let event = self.pree.tick(self.memory.as_mut());
        self.settle(waiting, event);
    }

    fn advance(&mut self, mut cycles: u64) {
        while cycles > 0 {
            let waiting = self.pree.ring().waiting;
            let (used, event) = self.pree.advance(self.memory.as_mut(), cycles);
            self.settle(waiting, event);
            cycles -= used;
        }
    }

    fn interrupt(&self) -> bool {
        self.registers.status.bits() & self.registers.enable.bits() != 0
    }
}

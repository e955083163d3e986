//! The radiance estimation engine with its registers, blocks `pree` and `counters`; in: accesses, clocks, out: words, interrupts
//! raised; cost: the engine's. [`registers`] keeps bits, [`job`] gives them a meaning at START.

pub mod job;
pub mod registers;

use lucerna_fabric::window::Windows;
use lucerna_pree::engine::{Event, Pree, Status};
use lucerna_pree::job::{Fault, FaultCode};
use lucerna_pree::preu::components::{EVALUATE_STAGES, UPDATE_STAGES};
use lucerna_pree::schedule::ENTRIES;
use lucerna_pree::update::OPERAND_LATENCY;
use lucerna_regs::counters::Counter;
use lucerna_regs::{UNIT_PREE, counters, interrupts, pree as regs, window};
use lucerna_softfloat::Format;

use crate::block::{Block, Identity};
use job::Job;
use registers::Registers;

const NOTHING: interrupts::Status = interrupts::Status::RESET;

/// One PREE of `N` PREUs of format `F`.
#[derive(Clone, Debug)]
pub struct PreeBlock<F, const N: usize> {
    registers: Registers,
    pree: Pree<F, N>,
}

impl<F: Format, const N: usize> Default for PreeBlock<F, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<F: Format, const N: usize> PreeBlock<F, N> {
    /// After reset.
    pub fn new() -> Self {
        Self { registers: Registers::default(), pree: Pree::new() }
    }

    fn control(
        &mut self,
        control: regs::Control,
        windows: &Windows<{ window::COUNT }>,
    ) -> interrupts::Status {
        let mut raised = NOTHING;
        if control.abort() {
            self.pree.abort();
            self.registers.clear_error();
        }
        if control.start()
            && let Err(fault) = self.start(windows)
        {
            self.pree.refuse(fault);
            raised = self.registers.record(fault);
        }
        if control.flush() {
            self.pree.flush();
        }
        raised
    }

    fn start(&mut self, windows: &Windows<{ window::COUNT }>) -> Result<(), Fault> {
        if self.pree.is_running() {
            return Err(Fault { code: FaultCode::NotIdle, address: 0 });
        }
        self.registers.clear_error();
        self.registers.tail = 0;
        match job::decode(&self.registers, windows)? {
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

    /// What a clock, or many, raised; `waiting` records were in the ring before. Not RING_TAIL less RING_HEAD: software may
    /// write the tail when no update runs, and that is no ring to fall low.
    fn settle(&mut self, waiting: u32, event: Option<Event>) -> interrupts::Status {
        let raised = match event {
            None => NOTHING,
            Some(Event::Done) => NOTHING.with_done(true),
            Some(Event::Fault(fault)) => self.registers.record(fault),
        };
        let low = self.registers.low;
        raised.with_ring_space(waiting > low && self.pree.ring().waiting <= low)
    }

    fn status(&self) -> regs::Status {
        let idle = regs::Status::default();
        match self.pree.status() {
            Status::Idle => idle,
            Status::Running { starved, flushing } => {
                idle.with_state(regs::State::Running).with_starved(starved).with_flushing(flushing)
            }
            Status::Fault(_) => idle.with_state(regs::State::Fault),
        }
    }
}

impl<F: Format, const N: usize> Block for PreeBlock<F, N> {
    fn identify(&self, identity: &mut Identity) {
        identity.add(UNIT_PREE, F::CODE);
        identity.capabilities =
            identity.capabilities.with_preus(N as u32).with_buffer_entries(ENTRIES as u32);
        identity.pipeline = identity
            .pipeline
            .with_update_stages(UPDATE_STAGES as u32)
            .with_evaluate_stages(EVALUATE_STAGES as u32)
            .with_operand_latency(OPERAND_LATENCY as u32);
    }

    fn read(&self, offset: u32) -> Option<u32> {
        Some(match offset {
            regs::CONTROL | counters::CONTROL => 0,
            regs::CONFIG => self.registers.config.bits(),
            regs::STATUS => self.status().bits(),
            regs::ERROR => regs::Error::default().with_code(self.registers.error.code()).bits(),
            regs::FAULT_ADDRESS => self.registers.error.address(),
            regs::RING_HEAD => self.pree.ring().head,
            regs::RING_TAIL => self.registers.tail,
            _ => match Counter::at(offset) {
                Some((counter, half)) => half.of(self.registers.counter(counter)),
                None => self.registers.plain(offset)?,
            },
        })
    }

    fn write(
        &mut self,
        offset: u32,
        value: u32,
        windows: &Windows<{ window::COUNT }>,
    ) -> Option<interrupts::Status> {
        match offset {
            regs::STATUS | regs::ERROR | regs::FAULT_ADDRESS | regs::RING_HEAD => {}
            regs::CONTROL => return Some(self.control(regs::Control::from_bits(value), windows)),
            regs::CONFIG => self.registers.config = regs::Config::from_bits(value & regs::Config::MASK),
            regs::RING_TAIL => match self.pree.doorbell(value) {
                Ok(()) => self.registers.tail = value,
                Err(fault) => return Some(self.registers.record(fault)),
            },
            counters::CONTROL => self.count(counters::Control::from_bits(value)),
            _ if Counter::at(offset).is_some() => {}
            _ => *self.registers.plain_mut(offset)? = value,
        }
        Some(NOTHING)
    }

    fn is_running(&self) -> bool {
        self.pree.is_running()
    }

    fn tick(&mut self, memory: &mut [u32]) -> interrupts::Status {
        let waiting = self.pree.ring().waiting;
        let event = self.pree.tick(memory);
        self.settle(waiting, event)
    }

    fn advance(&mut self, memory: &mut [u32], cycles: u64) -> (u64, interrupts::Status) {
        let waiting = self.pree.ring().waiting;
        let (used, event) = self.pree.advance(memory, cycles);
        (used, self.settle(waiting, event))
    }
}

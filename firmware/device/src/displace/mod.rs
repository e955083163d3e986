//! The displacement unit with its registers, blocks `displace` and `displace_counters`; in: accesses, clocks, out: words,
//! interrupts raised; cost: the unit's. [`registers`] keeps bits, [`job`] gives them a meaning at START.

pub mod job;
pub mod registers;

use lucerna_displace::engine::{Displace, Event, Geometry, SizeError, Sizes, Status};
use lucerna_displace::job::{Fault, FaultCode};
use lucerna_displace::slots::STAGES;
use lucerna_fabric::window::Windows;
use lucerna_regs::displace_counters::{self as counters, Counter};
use lucerna_regs::{UNIT_DISPLACE, displace as regs, interrupts, window};
use lucerna_softfloat::Format;

use crate::block::{Block, Identity};
use registers::Registers;

const NOTHING: interrupts::Status = interrupts::Status::RESET;

/// A displacement unit of format `F`: up to `U` instances with caches of up to `L` lines.
#[derive(Clone, Debug)]
pub struct DisplaceBlock<F: Format, const U: usize, const L: usize> {
    registers: Registers,
    unit: Displace<F, U, L>,
}

impl<F: Format, const U: usize, const L: usize> DisplaceBlock<F, U, L> {
    /// After reset.
    ///
    /// # Errors
    /// Sizes that the unit cannot have.
    pub fn new(sizes: Sizes) -> Result<Self, SizeError> {
        Ok(Self { registers: Registers::default(), unit: Displace::new(sizes)? })
    }

    fn control(
        &mut self,
        control: regs::Control,
        windows: &Windows<{ window::COUNT }>,
    ) -> interrupts::Status {
        if control.abort() {
            self.unit.abort();
            self.registers.clear_error();
        }
        if control.start()
            && let Err(fault) = self.start(windows)
        {
            self.unit.refuse(fault);
            return self.registers.record(fault);
        }
        NOTHING
    }

    fn start(&mut self, windows: &Windows<{ window::COUNT }>) -> Result<(), Fault> {
        if self.unit.is_running() {
            return Err(Fault { code: FaultCode::NotIdle, address: 0 });
        }
        self.registers.clear_error();
        self.unit.start(job::decode(&self.registers, windows)?)
    }

    fn count(&mut self, control: counters::Control) {
        if control.snapshot() {
            self.registers.snapshot = *self.unit.counters();
        }
        if control.clear() {
            self.unit.clear_counters();
        }
    }

    fn settle(&mut self, event: Option<Event>) -> interrupts::Status {
        match event {
            None => NOTHING,
            Some(Event::Done) => NOTHING.with_displace_done(true),
            Some(Event::Fault(fault)) => self.registers.record(fault),
        }
    }

    fn state(&self) -> regs::State {
        match self.unit.status() {
            Status::Idle => regs::State::Idle,
            Status::Running => regs::State::Running,
            Status::Fault(_) => regs::State::Fault,
        }
    }

    /// What was synthesised, as its registers say it.
    fn built(&self, offset: u32) -> Option<u32> {
        let sizes = self.unit.sizes();
        Some(match offset {
            regs::PIPELINE => {
                let stages = regs::Pipeline::RESET.with_stages(STAGES as u32);
                stages.with_units(sizes.units).with_fill_latency(sizes.port.latency).bits()
            }
            regs::HEIGHT_CACHE => {
                let Geometry { bytes, ways, line_bytes } = sizes.height_cache;
                let cache = regs::HeightCache::default().with_log2_bytes(log2(bytes));
                cache.with_ways(ways).with_line_bytes(line_bytes).bits()
            }
            regs::TEXTURE_CACHE => {
                let Geometry { bytes, ways, line_bytes } = sizes.texture_cache;
                let cache = regs::TextureCache::default().with_log2_bytes(log2(bytes));
                cache.with_ways(ways).with_line_bytes(line_bytes).bits()
            }
            regs::FIFOS => {
                let fifos = regs::Fifos::default().with_fifo0(sizes.fifo0).with_fifo1(sizes.fifo1);
                fifos.with_port_bytes(sizes.port.bytes_per_cycle).bits()
            }
            _ => return None,
        })
    }
}

const fn log2(bytes: u32) -> u32 {
    match bytes.checked_ilog2() {
        Some(log2) => log2,
        None => 0,
    }
}

impl<F: Format, const U: usize, const L: usize> Block for DisplaceBlock<F, U, L> {
    fn identify(&self, identity: &mut Identity) {
        identity.add(UNIT_DISPLACE, F::CODE);
    }

    fn read(&self, offset: u32) -> Option<u32> {
        Some(match offset {
            regs::CONTROL | counters::CONTROL => 0,
            regs::STATUS => regs::Status::default().with_state(self.state()).bits(),
            regs::ERROR => regs::Error::default().with_code(self.registers.error.code()).bits(),
            regs::FAULT_ADDRESS => self.registers.error.address(),
            regs::RAYS_DONE => self.unit.done(),
            _ => match Counter::at(offset) {
                Some((counter, half)) => half.of(self.registers.counter(counter)),
                None => self.registers.read(offset).or_else(|| self.built(offset))?,
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
            regs::STATUS | regs::ERROR | regs::FAULT_ADDRESS | regs::RAYS_DONE => {}
            regs::CONTROL => return Some(self.control(regs::Control::from_bits(value), windows)),
            counters::CONTROL => self.count(counters::Control::from_bits(value)),
            _ if Counter::at(offset).is_some() || self.built(offset).is_some() => {}
            _ => self.registers.write(offset, value)?,
        }
        Some(NOTHING)
    }

    fn is_running(&self) -> bool {
        self.unit.is_running()
    }

    fn tick(&mut self, memory: &mut [u32]) -> interrupts::Status {
        let event = self.unit.tick(memory);
        self.settle(event)
    }

    fn advance(&mut self, memory: &mut [u32], cycles: u64) -> (u64, interrupts::Status) {
        let (used, event) = self.unit.advance(memory, cycles);
        (used, self.settle(event))
    }
}

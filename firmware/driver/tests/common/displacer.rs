//! A displacement unit of the register map without arithmetic: a ray is done every `pace` clocks, and its result is its
//! number. Knobs make it fail.

use lucerna_bus::{Model, Target, TargetError};
use lucerna_driver::displace::{Camera, ErrorCode, Job, Layout, Plane, Policies, Ray, Shape, Sizes};
use lucerna_driver::{Capabilities, Lucerna};
use lucerna_regs::displace::{self, Config, Control, RasterSize, Source, State};
use lucerna_regs::{UNIT_DISPLACE, displace_counters, ident, interrupts};

use super::MEMORY_BYTES;

/// An 8 by 8 map (85 bytes in 128), 2 by 2 texels (16 bytes in 64) of the others, four rays.
pub const SIZES: Sizes = {
    let Some(map) = Shape::new(3, 3) else { panic!() };
    let Some(one) = Shape::new(1, 1) else { panic!() };
    Sizes { map, texture: one, normals: one, rays: 4, results: 4 }
};

#[derive(Clone, Debug)]
pub struct Displacer {
    pub registers: Vec<u32>,
    pub memory: Vec<u32>,
    clock: u64,
    // The knobs.
    /// Clocks a ray.
    pub pace: u64,
    /// Ends the next job in this error, at this address, after so many rays.
    pub error: Option<(u32, ErrorCode, u32)>,
    /// The interrupt line is cut.
    pub cut: bool,
    /// ABORT does nothing.
    pub deaf: bool,
    /// The unit does not get on.
    pub asleep: bool,
}

impl Default for Displacer {
    fn default() -> Self {
        let mut fake = Self {
            registers: vec![0; 0x540 / 4],
            memory: vec![0; MEMORY_BYTES as usize / 4],
            clock: 0,
            pace: 8,
            error: None,
            cut: false,
            deaf: false,
            asleep: false,
        };
        fake.set(ident::ID, ident::ID_RESET);
        fake.set(ident::VERSION, ident::Version::RESET.bits());
        fake.set(ident::CAPABILITIES, ident::Capabilities::from_bits(0).with_units(UNIT_DISPLACE).bits());
        fake.set(ident::MEMORY_BYTES, MEMORY_BYTES);
        fake.set(displace::PIPELINE, displace::Pipeline::RESET.with_units(1).with_fill_latency(40).bits());
        fake.set(displace::HEIGHT_CACHE, 0x0020_040E);
        fake.set(displace::TEXTURE_CACHE, 0x0040_020D);
        fake.set(displace::FIFOS, 0x0008_1110);
        fake
    }
}

impl Displacer {
    pub fn get(&self, offset: u32) -> u32 {
        self.registers[offset as usize / 4]
    }

    pub fn set(&mut self, offset: u32, value: u32) {
        self.registers[offset as usize / 4] = value;
    }

    pub fn state(&self) -> State {
        displace::Status::from_bits(self.get(displace::STATUS)).state().unwrap_or(State::Idle)
    }

    fn become_(&mut self, state: State) {
        self.set(displace::STATUS, displace::Status::default().with_state(state).bits());
    }

    fn raise(&mut self, event: interrupts::Status) {
        self.set(interrupts::STATUS, self.get(interrupts::STATUS) | event.bits());
    }

    fn fail(&mut self, code: ErrorCode, address: u32) {
        self.set(displace::ERROR, displace::Error::default().with_code(code).bits());
        self.set(displace::FAULT_ADDRESS, address);
        self.raise(interrupts::Status::default().with_displace_error(true));
        if code != ErrorCode::NotIdle {
            self.become_(State::Fault);
        }
    }

    fn control(&mut self, control: Control) {
        if control.abort() && !self.deaf {
            self.become_(State::Idle);
        }
        if control.start() {
            if self.state() == State::Running {
                return self.fail(ErrorCode::NotIdle, 0);
            }
            self.set(displace::ERROR, 0);
            self.set(displace::RAYS_DONE, 0);
            self.clock = 0;
            self.become_(State::Running);
        }
    }

    fn rays(&self) -> u32 {
        match Config::from_bits(self.get(displace::CONFIG)).source() {
            Source::List => self.get(displace::RAY_COUNT),
            Source::Raster => {
                let size = RasterSize::from_bits(self.get(displace::RASTER_SIZE));
                size.width() * size.height()
            }
        }
    }

    fn place(address: u32, words: usize, size: usize) -> Result<std::ops::Range<usize>, TargetError> {
        let first = address as usize / 4;
        match () {
            () if !address.is_multiple_of(4) => Err(TargetError::Misaligned),
            () if first + words > size => Err(TargetError::OutOfRange),
            () => Ok(first..first + words),
        }
    }
}

impl Target for Displacer {
    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        Self::place(offset, 1, self.registers.len()).map(|place| self.registers[place.start])
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        Self::place(offset, 1, self.registers.len())?;
        match offset {
            displace::CONTROL => self.control(Control::from_bits(value)),
            interrupts::STATUS => self.set(offset, self.get(offset) & !value),
            displace_counters::CONTROL => {
                let done = self.get(displace::RAYS_DONE);
                self.set(displace_counters::Counter::Rays.low(), done);
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
        let done = self.get(displace::RAYS_DONE);
        if let Some((after, code, address)) = self.error
            && done >= after
        {
            self.error = None;
            return self.fail(code, address);
        }
        if done == self.rays() {
            self.become_(State::Idle);
            return self.raise(interrupts::Status::default().with_displace_done(true));
        }
        if self.clock.is_multiple_of(self.pace) {
            let record = (self.get(displace::RESULT_BASE) / 4 + done * 8) as usize;
            self.memory[record..record + 8].copy_from_slice(&[done, !done, 0, done + 1, 0, 0, 0, 0]);
            self.set(displace::RAYS_DONE, done + 1);
        }
    }

    fn interrupt(&self) -> bool {
        self.get(interrupts::STATUS) & self.get(interrupts::ENABLE) != 0 && !self.cut
    }
}

/// A model of the fake, changed by `change` first.
pub fn model(change: impl FnOnce(&mut Displacer)) -> Model<Displacer> {
    let mut fake = Displacer::default();
    change(&mut fake);
    Model::new(fake)
}

pub fn capabilities() -> Capabilities {
    let model = model(|_| {});
    *Lucerna::probe(model.bus(), model.delay()).unwrap().capabilities()
}

pub fn layout(sizes: Sizes) -> Layout {
    Layout::packed(&capabilities(), sizes).unwrap()
}

/// 200 by 200 around the origin; y is up.
pub fn plane() -> Plane {
    Plane {
        origin: [-100.0, 0.0, 100.0],
        tangent: [200.0, 0.0, 0.0],
        bitangent: [0.0, 0.0, -200.0],
        normal: [0.0, 1.0, 0.0],
        repeat: [1.0, 1.0],
        height_scale: 0.25,
        bounded: true,
    }
}

/// Two by two pixels, straight down from a height of 100.
pub fn camera() -> Camera {
    Camera {
        position: [0.0, 100.0, 0.0],
        direction: [0.0, -1.0, 0.0],
        up: [0.0, 0.0, -1.0],
        field_of_view: 45f32.to_radians(),
        width: 2,
        height: 2,
    }
}

pub fn list(layout: &Layout, count: u32) -> Job {
    Job::list(layout, count, &plane(), Policies::MIX).unwrap()
}

pub fn raster(layout: &Layout) -> Job {
    Job::raster(layout, &camera(), &plane(), Policies::MIX).unwrap()
}

/// Rays that can be told apart.
pub fn rays(count: u32) -> Vec<Ray> {
    (0..count).map(|number| Ray { entry: [number as f32, 0.5], view: [0.0, -1.0, 0.25] }).collect()
}

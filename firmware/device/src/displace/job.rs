//! From registers to a job; in: bits, out: what the unit can do, or the fault; cost: decoding at start.

use lucerna_displace::job::{Description, Fault, FaultCode, Job, MapDescription, Raster, RayFaults, Source};
use lucerna_displace::traverse::{Ascend, Coherent, Policies, Wrap};
use lucerna_fabric::window::Windows;
use lucerna_regs::displace::{self as regs, Config};
use lucerna_regs::window;
use lucerna_softfloat::Format;

use super::registers::Registers;

/// Decodes the registers as START finds them.
///
/// # Errors
/// A fault of the register's codes; nothing was touched.
pub fn decode<F: Format>(
    registers: &Registers,
    windows: &Windows<{ window::COUNT }>,
) -> Result<Job<F>, Fault> {
    Job::new(windows, &describe(registers)?)
}

fn describe<F: Format>(registers: &Registers) -> Result<Description<F>, Fault> {
    let config = Config::from_bits(registers.word(regs::CONFIG));
    let map = regs::MapSize::from_bits(registers.word(regs::MAP_SIZE));
    let texture = regs::TextureSize::from_bits(registers.word(regs::TEXTURE_SIZE));
    let normals = regs::NormalSize::from_bits(registers.word(regs::NORMAL_SIZE));
    Ok(Description {
        policies: policies(config)?,
        source: match config.source() {
            regs::Source::List => {
                Source::List { base: registers.word(regs::RAY_BASE), count: registers.word(regs::RAY_COUNT) }
            }
            regs::Source::Raster => Source::Raster(raster(registers)),
        },
        ray_faults: match config.ray_faults() {
            regs::RayFaults::Record => RayFaults::Record,
            regs::RayFaults::Stop => RayFaults::Stop,
        },
        watchdog: registers.word(regs::WATCHDOG),
        map: MapDescription {
            base: registers.word(regs::MAP_BASE),
            log2: [map.log2_width(), map.log2_height()],
        },
        texture: MapDescription {
            base: registers.word(regs::TEXTURE_BASE),
            log2: [texture.log2_width(), texture.log2_height()],
        },
        normals: MapDescription {
            base: registers.word(regs::NORMAL_BASE),
            log2: [normals.log2_width(), normals.log2_height()],
        },
        results: registers.word(regs::RESULT_BASE),
        height_scale: number(registers, regs::HEIGHT_SCALE),
        tbn: [regs::TANGENT_X, regs::BITANGENT_X, regs::NORMAL_X].map(|row| numbers(registers, row)),
        light: numbers(registers, regs::LIGHT_X),
        ambient: number(registers, regs::AMBIENT),
        diffuse: number(registers, regs::DIFFUSE),
        background: registers.word(regs::BACKGROUND),
    })
}

fn policies(config: Config) -> Result<Policies, Fault> {
    const BAD_CONFIG: Fault = Fault { code: FaultCode::BadConfig, address: 0 };
    Ok(Policies {
        wrap: match config.wrap() {
            regs::Wrap::Repeat => Wrap::Repeat,
            regs::Wrap::Border => Wrap::Border,
        },
        start_level: config.start_level(),
        start_grid: config.start_grid(),
        levels_down: config.levels_down().map_err(|_| BAD_CONFIG)?.bits(),
        ascend: match config.ascend().map_err(|_| BAD_CONFIG)? {
            regs::Ascend::Never => Ascend::Never,
            regs::Ascend::Parity => Ascend::Parity,
            regs::Ascend::Selective => Ascend::Selective,
            regs::Ascend::Coherent => Ascend::Coherent,
        },
        coherent: match config.coherent().map_err(|_| BAD_CONFIG)? {
            regs::Coherent::Toggle => Coherent::Toggle,
            regs::Coherent::Consecutive => Coherent::Consecutive,
            regs::Coherent::Parity => Coherent::Parity,
        },
        reach: config.reach().map_err(|_| BAD_CONFIG)?.bits(),
        siblings: config.siblings(),
    })
}

fn raster<F: Format>(registers: &Registers) -> Raster<F> {
    let size = regs::RasterSize::from_bits(registers.word(regs::RASTER_SIZE));
    Raster {
        width: size.width(),
        height: size.height(),
        origin: numbers(registers, regs::ORIGIN_X),
        right: numbers(registers, regs::RIGHT_X),
        down: numbers(registers, regs::DOWN_X),
        eye: numbers(registers, regs::EYE_U),
        extent: numbers(registers, regs::EXTENT_U),
    }
}

fn number<F: Format>(registers: &Registers, offset: u32) -> F {
    F::from_bits(registers.word(offset))
}

/// The numbers of registers side by side, the first at `offset`.
fn numbers<F: Format, const COUNT: usize>(registers: &Registers, offset: u32) -> [F; COUNT] {
    core::array::from_fn(|place| number(registers, offset + 4 * place as u32))
}

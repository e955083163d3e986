//! A small displacement job by hand; in: nothing, out: a device ready to start; cost: 16 KiB of memory.
#![allow(dead_code, reason = "each of the tests uses a part of it")]

use lucerna_bus::Target;
use lucerna_device::FullDevice;
use lucerna_displace::engine::Sizes;
use lucerna_regs::displace::{self as regs, Control, ErrorCode, MapSize, State, Status};
use lucerna_regs::{interrupts, window};
use lucerna_softfloat::F32;

/// A device with both units.
pub type Both = FullDevice<F32, 4, 2, 512, Vec<u32>>;

/// Words of its memory; window 0 is all of it but the first and the last page.
pub const WORDS: usize = 4096;
/// What lies in the window, in bytes.
pub const OPEN: core::ops::Range<u32> = 0x1000..0x3000;
pub const MAP: u32 = 0x1000;
pub const TEXTURE: u32 = 0x1100;
pub const NORMALS: u32 = 0x1200;
pub const RAYS: u32 = 0x1300;
pub const RESULTS: u32 = 0x1800;
/// How many rays there are.
pub const COUNT: u32 = 20;

pub fn read(device: &mut impl Target, offset: u32) -> u32 {
    device.read(offset).unwrap_or_else(|error| panic!("{offset:#x}: {error}"))
}

pub fn write(device: &mut impl Target, offset: u32, value: u32) {
    device.write(offset, value).unwrap_or_else(|error| panic!("{offset:#x}: {error}"));
}

pub fn start(device: &mut impl Target) {
    write(device, regs::CONTROL, Control::default().with_start(true).bits());
}

pub fn abort(device: &mut impl Target) {
    write(device, regs::CONTROL, Control::default().with_abort(true).bits());
}

pub fn state(device: &mut impl Target) -> State {
    Status::from_bits(read(device, regs::STATUS)).state().expect("a state of the map")
}

pub fn error(device: &mut impl Target) -> (ErrorCode, u32) {
    let code = regs::Error::from_bits(read(device, regs::ERROR)).code().expect("a code of the map");
    (code, read(device, regs::FAULT_ADDRESS))
}

pub fn raised(device: &mut impl Target) -> interrupts::Status {
    interrupts::Status::from_bits(read(device, interrupts::STATUS))
}

/// An 8 by 8 map with a few steps, a texture of 4 by 4, normals of 2 by 2, and rays that come down slanted; for `units` instances.
pub fn ready(units: u32) -> Both {
    let sizes = Sizes { units, ..Sizes::default() };
    let mut device = FullDevice::new(sizes, vec![0; WORDS]).expect("sizes");
    let numbers = |first: u32, values: &[f32]| {
        (0u32..).zip(values).map(|(place, value)| (first + 4 * place, value.to_bits())).collect::<Vec<_>>()
    };
    let size = |width, height| MapSize::default().with_log2_width(width).with_log2_height(height).bits();
    let mut words = vec![
        (window::base(0), OPEN.start),
        (window::limit(0), OPEN.end),
        (regs::MAP_BASE, MAP),
        (regs::MAP_SIZE, size(3, 3)),
        (regs::TEXTURE_BASE, TEXTURE),
        (regs::TEXTURE_SIZE, size(2, 2)),
        (regs::NORMAL_BASE, NORMALS),
        (regs::NORMAL_SIZE, size(1, 1)),
        (regs::RAY_BASE, RAYS),
        (regs::RAY_COUNT, COUNT),
        (regs::RESULT_BASE, RESULTS),
        (regs::BACKGROUND, 0x0012_3456),
    ];
    words.extend(numbers(regs::HEIGHT_SCALE, &[0.5, 1., 0., 0., 0., 1., 0., 0., 0., 1.]));
    words.extend(numbers(regs::LIGHT_X, &[0., 0., 1., 0.25, 0.75]));
    for (offset, value) in words {
        write(&mut device, offset, value);
    }
    // Level 0: 64 bytes, level 1: 16, level 2: 4, level 3: 1. Heights of 64 below, of 255 at one corner.
    let mut heights = [64u8; 88];
    heights[0..4].fill(255);
    for root in [64, 80, 84] {
        heights[root] = 255;
    }
    let heights: Vec<u32> =
        heights.as_chunks::<4>().0.iter().map(|bytes| u32::from_le_bytes(*bytes)).collect();
    device.store(MAP, &heights).expect("in memory");
    device.store(TEXTURE, &[0x0080_4020; 16]).expect("in memory");
    device.store(NORMALS, &[0x00FF_8080; 4]).expect("in memory");
    for number in 0..COUNT {
        let place = number as f32 / COUNT as f32;
        let record = [place, 0.9 - place, 0.3, 0.1, -1.].map(f32::to_bits);
        device.store(RAYS + number * 32, &record).expect("in memory");
    }
    device
}

//! Does every nonsense of a displacement job, as far as START can see it, give its own code and address, and nothing else?

mod common;

use common::*;
use lucerna_bus::Target;
use lucerna_regs::displace::{
    self as regs, Ascend, Coherent, Config, ErrorCode, LevelsDown, RasterSize, Reach, Source, State,
};
use lucerna_regs::{interrupts, pree, window};

const RASTER: Config = Config::RESET.with_source(Source::Raster);

/// Starts the job after some writes; gives the error, and checks what every refusal has in common.
fn provoked(writes: &[(u32, u32)]) -> (ErrorCode, u32) {
    let mut device = ready(1);
    write(&mut device, interrupts::ENABLE, interrupts::Enable::default().with_displace_error(true).bits());
    for (offset, value) in writes {
        write(&mut device, *offset, *value);
    }
    let before = device.memory().to_vec();
    start(&mut device);
    assert_eq!(state(&mut device), State::Fault);
    assert_eq!(raised(&mut device), interrupts::Status::default().with_displace_error(true));
    assert!(device.interrupt());
    let found = error(&mut device);
    device.advance(1000);
    assert_eq!((state(&mut device), error(&mut device)), (State::Fault, found), "it stays");
    assert!(device.memory() == before, "a refused job touches nothing");
    assert_eq!(read(&mut device, pree::STATUS), 0, "the other unit has no part in it");
    assert_eq!(read(&mut device, pree::ERROR), 0);

    write(&mut device, interrupts::STATUS, u32::MAX);
    assert!(!device.interrupt());
    abort(&mut device);
    assert_eq!((state(&mut device), error(&mut device)), (State::Idle, (ErrorCode::None, 0)));
    found
}

#[test]
fn a_right_job_is_no_error() {
    for writes in [
        &[][..],
        &[(regs::RAY_COUNT, 0)],
        // Maps of one texel, in the last 64 bytes of the window.
        &[(regs::MAP_SIZE, 0), (regs::MAP_BASE, OPEN.end - 64)],
        // Rays are not looked at by a raster.
        &[
            (regs::CONFIG, RASTER.bits()),
            (regs::RASTER_SIZE, RasterSize::default().with_width(5).with_height(3).bits()),
            (regs::RAY_BASE, 1),
            (regs::RAY_COUNT, u32::MAX),
        ],
        &[(regs::WATCHDOG, 1)],
        &[(regs::WATCHDOG, 65_535)],
    ] {
        let mut device = ready(1);
        for (offset, value) in writes {
            write(&mut device, *offset, *value);
        }
        start(&mut device);
        assert_eq!(error(&mut device), (ErrorCode::None, 0), "{writes:x?}");
        assert_eq!(raised(&mut device), interrupts::Status::default());
    }
}

#[test]
fn bad_config() {
    let levels = (0..8).filter(|bits| LevelsDown::from_bits(*bits).is_err());
    let ascend = (0..8).filter(|bits| Ascend::from_bits(*bits).is_err());
    let coherent = (0..4).filter(|bits| Coherent::from_bits(*bits).is_err());
    let reach = (0..4).filter(|bits| Reach::from_bits(*bits).is_err());
    let words: Vec<u32> = levels
        .map(|bits| Config::LEVELS_DOWN.put(Config::RESET.bits(), bits))
        .chain(ascend.map(|bits| Config::ASCEND.put(Config::RESET.bits(), bits)))
        .chain(coherent.map(|bits| Config::COHERENT.put(Config::RESET.bits(), bits)))
        .chain(reach.map(|bits| Config::REACH.put(Config::RESET.bits(), bits)))
        .collect();
    assert_eq!(words.len(), 4 + 4 + 1 + 1);
    for word in words {
        assert_eq!(provoked(&[(regs::CONFIG, word)]), (ErrorCode::BadConfig, 0), "{word:#x}");
        let raster = Config::from_bits(word).with_source(Source::Raster).bits();
        assert_eq!(provoked(&[(regs::CONFIG, raster)]), (ErrorCode::BadConfig, 0), "{raster:#x}");
    }
    for steps in [0, 65_536, u32::MAX] {
        assert_eq!(provoked(&[(regs::WATCHDOG, steps)]), (ErrorCode::BadConfig, 0), "{steps}");
    }
}

#[test]
fn window_of_each_buffer() {
    for (offset, alignment, last) in [
        (regs::MAP_BASE, 64, OPEN.end - 128),
        (regs::TEXTURE_BASE, 64, OPEN.end - 64),
        (regs::NORMAL_BASE, 64, OPEN.end - 64),
        (regs::RAY_BASE, 4, OPEN.end - COUNT * 32),
        (regs::RESULT_BASE, 4, OPEN.end - COUNT * 32),
    ] {
        let wrong = [
            OPEN.start - alignment,
            last + alignment,
            last + 1,
            OPEN.start + alignment / 2,
            OPEN.end,
            0,
            0x3FFF_FFC0,
        ];
        for base in wrong {
            assert_eq!(provoked(&[(offset, base)]), (ErrorCode::Window, base), "{offset:#x}");
        }
    }
    // A closed window; one that ends a word too soon for what is first looked at; one beyond the memory.
    assert_eq!(provoked(&[(window::limit(0), MAP)]), (ErrorCode::Window, MAP));
    assert_eq!(provoked(&[(window::limit(0), MAP + 124)]), (ErrorCode::Window, MAP));
    let beyond = [(window::limit(0), u32::MAX), (regs::RESULT_BASE, 4 * WORDS as u32 - 4)];
    assert_eq!(provoked(&beyond), (ErrorCode::Window, 4 * WORDS as u32 - 4));
}

#[test]
fn too_large() {
    for (offset, base) in [
        (regs::MAP_BASE, u32::MAX - 63),
        (regs::TEXTURE_BASE, u32::MAX - 63),
        (regs::NORMAL_BASE, u32::MAX - 63),
        (regs::RAY_BASE, u32::MAX - 31),
        (regs::RESULT_BASE, u32::MAX - 3),
    ] {
        assert_eq!(provoked(&[(offset, base)]), (ErrorCode::TooLarge, base), "{offset:#x}");
    }
    for count in [1 << 27, 1 << 29, u32::MAX] {
        assert_eq!(provoked(&[(regs::RAY_COUNT, count)]), (ErrorCode::TooLarge, RAYS), "{count}");
    }
    let raster = [(regs::CONFIG, RASTER.bits()), (regs::RASTER_SIZE, u32::MAX)];
    assert_eq!(provoked(&raster), (ErrorCode::TooLarge, RESULTS));
}

#[test]
fn bad_map() {
    for (offset, base) in [(regs::MAP_SIZE, MAP), (regs::TEXTURE_SIZE, TEXTURE), (regs::NORMAL_SIZE, NORMALS)]
    {
        for log2 in 13..16 {
            assert_eq!(provoked(&[(offset, log2)]), (ErrorCode::BadMap, base), "{offset:#x}");
            assert_eq!(provoked(&[(offset, log2 << 8)]), (ErrorCode::BadMap, base), "{offset:#x}");
        }
        // The largest legal one is only too large for its window.
        assert_eq!(provoked(&[(offset, 12 | 12 << 8)]), (ErrorCode::Window, base), "{offset:#x}");
    }
}

#[test]
fn bad_raster() {
    for size in [0, 640, 480 << 16] {
        let raster = [(regs::CONFIG, RASTER.bits()), (regs::RASTER_SIZE, size)];
        assert_eq!(provoked(&raster), (ErrorCode::BadRaster, 0), "{size:#x}");
    }
}

#[test]
fn overlap() {
    let bytes = COUNT * 32;
    for (base, size) in [(MAP, 128), (TEXTURE, 64), (NORMALS, 64), (RAYS, bytes)] {
        // Its first and its last word; from below, only where something fits into the window.
        let mut results = vec![base, base + size - 4];
        results.extend((base - OPEN.start >= bytes).then(|| base + 4 - bytes));
        for results in results {
            let found = provoked(&[(regs::RESULT_BASE, results)]);
            assert_eq!(found, (ErrorCode::Overlap, results), "{base:#x}");
        }
    }
}

/// START leaves a fault behind, and ERROR with it.
#[test]
fn a_start_forgets_the_error_before() {
    let mut device = ready(1);
    write(&mut device, regs::WATCHDOG, 0);
    start(&mut device);
    assert_eq!(error(&mut device), (ErrorCode::BadConfig, 0));
    write(&mut device, regs::WATCHDOG, regs::WATCHDOG_RESET);
    write(&mut device, regs::MAP_BASE, 4);
    start(&mut device);
    assert_eq!(error(&mut device), (ErrorCode::Window, 4));
    write(&mut device, regs::MAP_BASE, MAP);
    start(&mut device);
    assert_eq!(error(&mut device), (ErrorCode::None, 0));
    assert!(raised(&mut device).displace_error(), "interrupts are cleared by software alone");
}

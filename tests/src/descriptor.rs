//! Random displacement jobs at register level; in: a seed, out: memory and registers, and what START may say of them; cost: small.
//!
//! `faults` is written from the register map's descriptions alone: what is wrong with a job, each with its code and address.

use lucerna_driver::NumberFormat;
use lucerna_driver::records::encode;
use lucerna_regs::displace::{self as regs, Ascend, Coherent, Config, ErrorCode, LevelsDown, Reach, Source};
use lucerna_regs::window;

use crate::random::Rng;

/// Words of a device's memory.
pub const WORDS: u32 = 4096;
/// Windows stay within these bytes; what lies outside is nobody's.
pub const OPEN: core::ops::Range<u32> = 0x400..0x3c00;

/// Registers and memory before START.
#[derive(Clone, Debug)]
pub struct Descriptor {
    /// Offsets and words; the last one of an offset counts.
    pub registers: Vec<(u32, u32)>,
    /// All of it.
    pub memory: Vec<u32>,
}

impl Descriptor {
    /// What a register was given.
    pub fn word(&self, offset: u32) -> u32 {
        self.registers.iter().rev().find(|(other, _)| *other == offset).map_or(0, |(_, word)| *word)
    }

    /// Rays of the job.
    pub fn rays(&self) -> u32 {
        let size = regs::RasterSize::from_bits(self.word(regs::RASTER_SIZE));
        match Config::from_bits(self.word(regs::CONFIG)).source() {
            Source::List => self.word(regs::RAY_COUNT),
            Source::Raster => size.width().saturating_mul(size.height()),
        }
    }

    /// Its buffers: base, bytes, alignment, and whether it is read.
    fn buffers(&self) -> [(u32, u64, u32, bool); 5] {
        let texels = |offset: u32, pyramid: bool| {
            let size = regs::MapSize::from_bits(self.word(offset));
            let (mut w, mut h) = (1u64 << size.log2_width(), 1u64 << size.log2_height());
            if !pyramid {
                return w * h * 4;
            }
            let mut bytes = w * h;
            while w * h > 1 {
                (w, h) = ((w / 2).max(1), (h / 2).max(1));
                bytes += w * h;
            }
            bytes
        };
        let list = Config::from_bits(self.word(regs::CONFIG)).source() == Source::List;
        let records = u64::from(self.rays()) * 32;
        let map =
            |base, size, pyramid| (self.word(base), texels(size, pyramid).next_multiple_of(64), 64, true);
        [
            map(regs::MAP_BASE, regs::MAP_SIZE, true),
            map(regs::TEXTURE_BASE, regs::TEXTURE_SIZE, false),
            map(regs::NORMAL_BASE, regs::NORMAL_SIZE, false),
            if list { (self.word(regs::RAY_BASE), records, 4, true) } else { (0, 0, 4, true) },
            (self.word(regs::RESULT_BASE), records, 4, false),
        ]
    }

    /// Everything that START may find wrong: code and address. Nothing: the job runs.
    pub fn faults(&self) -> Vec<(ErrorCode, u32)> {
        let mut faults = Vec::new();
        let config = Config::from_bits(self.word(regs::CONFIG));
        let illegal = config.levels_down().is_err()
            || config.ascend().is_err()
            || config.coherent().is_err()
            || config.reach().is_err();
        if illegal || !(1..=65_535).contains(&self.word(regs::WATCHDOG)) {
            faults.push((ErrorCode::BadConfig, 0));
        }
        for (size, base) in [
            (regs::MAP_SIZE, regs::MAP_BASE),
            (regs::TEXTURE_SIZE, regs::TEXTURE_BASE),
            (regs::NORMAL_SIZE, regs::NORMAL_BASE),
        ] {
            let size = regs::MapSize::from_bits(self.word(size));
            if size.log2_width() > 12 || size.log2_height() > 12 {
                faults.push((ErrorCode::BadMap, self.word(base)));
            }
        }
        let size = regs::RasterSize::from_bits(self.word(regs::RASTER_SIZE));
        if config.source() == Source::Raster && (size.width() == 0 || size.height() == 0) {
            faults.push((ErrorCode::BadRaster, 0));
        }
        let windows: Vec<_> =
            (0..window::COUNT).map(|n| (self.word(window::base(n)), self.word(window::limit(n)))).collect();
        let buffers = self.buffers();
        for (base, bytes, alignment, _) in buffers {
            let (first, end) = (u64::from(base), u64::from(base) + bytes);
            if end > u64::from(u32::MAX) {
                faults.push((ErrorCode::TooLarge, base));
            }
            let inside = windows
                .iter()
                .any(|(low, high)| first >= u64::from(*low) && end <= u64::from((*high).min(WORDS * 4)));
            if base % alignment != 0 || bytes > 0 && !inside {
                faults.push((ErrorCode::Window, base));
            }
        }
        let [.., (results, bytes, ..)] = buffers;
        let shares = |base: u32, other: u64| {
            let (a, b) = (u64::from(results), u64::from(base));
            bytes > 0 && other > 0 && a < b + other && b < a + bytes
        };
        if buffers.iter().any(|(base, other, _, read)| *read && shares(*base, *other)) {
            faults.push((ErrorCode::Overlap, results));
        }
        faults
    }
}

/// A job that can be done, with rays, maps and numbers by chance.
pub fn legal(rng: &mut Rng, format: NumberFormat) -> Descriptor {
    let mut memory: Vec<u32> = (0..WORDS).map(|_| rng.word()).collect();
    let size = |log2: [u32; 2]| log2[0] | log2[1] << 8;
    let map = [rng.below(7), rng.below(7)];
    let texture = [rng.below(4), rng.below(5)];
    let normals = [rng.below(4), rng.below(4)];
    let raster = [1 + rng.below(7), 1 + rng.below(6)];
    let list = rng.once_in(2);
    let rays = if list { rng.below(40) } else { raster[0] * raster[1] };
    let pyramid = (0..7).map(|l| 1 << (map[0].saturating_sub(l) + map[1].saturating_sub(l))).sum::<u32>();
    let mut buffers = [
        (regs::MAP_BASE, pyramid),
        (regs::TEXTURE_BASE, 4 << (texture[0] + texture[1])),
        (regs::NORMAL_BASE, 4 << (normals[0] + normals[1])),
        (regs::RAY_BASE, if list { rays * 32 } else { 0 }),
        (regs::RESULT_BASE, rays * 32),
    ];
    buffers.rotate_left(rng.below(5) as usize);
    let mut base = OPEN.start;
    let mut registers: Vec<(u32, u32)> = buffers
        .into_iter()
        .map(|(offset, bytes)| {
            // Records may begin at any word.
            let records = offset == regs::RAY_BASE || offset == regs::RESULT_BASE;
            base = base.next_multiple_of(if records { 4 } else { 64 });
            let placed = (offset, base);
            base += if records { bytes + 4 * rng.below(20) } else { bytes.next_multiple_of(64) };
            placed
        })
        .collect();
    let config = Config::from_bits(rng.word() & 1 << 13 | rng.word() & 0x401e)
        .with_source(if list { Source::List } else { Source::Raster })
        .with_levels_down(
            [LevelsDown::One, LevelsDown::Two, LevelsDown::Three, LevelsDown::Four][rng.below(4) as usize],
        )
        .with_ascend(
            [Ascend::Never, Ascend::Parity, Ascend::Selective, Ascend::Coherent][rng.below(4) as usize],
        )
        .with_coherent([Coherent::Toggle, Coherent::Consecutive, Coherent::Parity][rng.below(3) as usize])
        .with_reach([Reach::One, Reach::Two, Reach::Three][rng.below(3) as usize]);
    let watchdog = if rng.once_in(3) { 1 + rng.below(20) } else { 1 + rng.below(2000) };
    registers.extend([
        (regs::CONFIG, config.bits()),
        (regs::WATCHDOG, watchdog),
        (regs::MAP_SIZE, size(map)),
        (regs::TEXTURE_SIZE, size(texture)),
        (regs::NORMAL_SIZE, size(normals)),
        (regs::RAY_COUNT, if list { rays } else { rng.word() }),
        (regs::RASTER_SIZE, raster[0] | raster[1] << 16),
        (regs::BACKGROUND, rng.word()),
        (window::base(1), OPEN.start),
        (window::limit(1), OPEN.end),
    ]);
    // Numbers of a camera and a surface, or any bits at all.
    let odd = if rng.once_in(4) { 3 } else { 40 };
    let mut number = |low: f32, high: f32| {
        if rng.once_in(odd) { rng.word() } else { encode(format, rng.real(low, high)) }
    };
    let frame = [0.5, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let camera = [0.5, 0.5, 3.0, 4.0, 4.0, -0.3, -0.3, -1.0, 0.1, 0.0, 0.0, 0.0, 0.1, 0.0];
    let light = [0.1, 0.2, 0.9, 0.3, 0.7];
    for (place, value) in (0..).zip(frame.into_iter().chain(camera).chain(light)) {
        registers.push((regs::HEIGHT_SCALE + 4 * place, number(value - 0.1, value + 0.1)));
    }
    let descriptor = Descriptor { registers, memory: Vec::new() };
    if list {
        let first = descriptor.word(regs::RAY_BASE) as usize / 4;
        for record in memory[first..first + rays as usize * 8].chunks_mut(8) {
            for (word, (low, high)) in
                record.iter_mut().zip([(-2., 2.), (-2., 2.), (-1., 1.), (-1., 1.), (-1.5, 0.1)])
            {
                *word = number(low, high);
            }
        }
    }
    Descriptor { memory, ..descriptor }
}

/// Something wrong with it, or almost.
pub fn spoil(rng: &mut Rng, descriptor: &mut Descriptor) {
    let offset = [
        regs::CONFIG,
        regs::WATCHDOG,
        regs::MAP_BASE,
        regs::MAP_SIZE,
        regs::TEXTURE_BASE,
        regs::TEXTURE_SIZE,
        regs::NORMAL_BASE,
        regs::NORMAL_SIZE,
        regs::RAY_BASE,
        regs::RAY_COUNT,
        regs::RASTER_SIZE,
        regs::RESULT_BASE,
        window::base(1),
        window::limit(1),
    ][rng.below(14) as usize];
    let before = descriptor.word(offset);
    let inside = |rng: &mut Rng| (OPEN.start + rng.below(OPEN.end - OPEN.start)) & !3;
    let word = match offset {
        // A window may become narrower, never wider.
        _ if window::at(offset).is_some() => inside(rng),
        regs::WATCHDOG => [0, 1, 65_535, 65_536, u32::MAX][rng.below(5) as usize],
        regs::RASTER_SIZE => [0, 3, 3 << 16, u32::MAX, 0x0001_0001, 0x0100_0002][rng.below(6) as usize],
        regs::RAY_COUNT => [0, 1, 200, 1 << 26, 1 << 27, u32::MAX][rng.below(6) as usize],
        regs::CONFIG => before ^ 1 << rng.below(20),
        regs::MAP_SIZE | regs::TEXTURE_SIZE | regs::NORMAL_SIZE => rng.word() & 0x0f0f,
        _ => match rng.below(6) {
            0 => before.wrapping_add(4),
            1 => before.wrapping_sub(64),
            2 => before.wrapping_add(1),
            3 => inside(rng),
            4 => inside(rng) & !63,
            _ => u32::MAX - rng.below(200),
        },
    };
    descriptor.registers.push((offset, word));
}

//! Random jobs; in: a shape and a seed, out: the job; cost: small. The shape shrinks, the seed does not.

use lucerna_displace::engine::{Geometry, PortSizes, Sizes};
use lucerna_driver::records::encode;
use lucerna_driver::{Allocation, Busy, Hazard, InputWidth, NumberFormat, Scheduler};
use lucerna_regs::pree::Config;
use proptest::prelude::*;

use crate::devices::Kind;
use crate::job::Job;

/// SplitMix64.
#[derive(Clone, Debug)]
pub struct Rng(pub u64);

impl Rng {
    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// 32 random bits.
    pub fn word(&mut self) -> u32 {
        (self.bits() >> 32) as u32
    }

    /// Less than `end`; 0 when that is 0.
    pub fn below(&mut self, end: u32) -> u32 {
        ((u64::from(self.word()) * u64::from(end)) >> 32) as u32
    }

    /// True once in `n`.
    pub fn once_in(&mut self, n: u32) -> bool {
        self.below(n) == 0
    }

    /// In `low..high`.
    pub fn real(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.below(1 << 24) as f32 / (1 << 24) as f32)
    }
}

/// What a job is like.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The device.
    pub kind: Kind,
    /// Everything but the mode.
    pub config: Config,
    /// Hit points.
    pub hits: u32,
    /// Pixels.
    pub pixels: u32,
    /// Index entries.
    pub index: u32,
    /// Photons.
    pub photons: u32,
    /// The longest list.
    pub longest: u32,
    /// The ring's entries, as a power of two.
    pub ring: u32,
    /// Once in how many numbers a NaN, infinity, subnormal, zero or plain noise; 0: never.
    pub odd: u32,
    /// Once in how many references one that leads nowhere; 0: never.
    pub broken: u32,
    /// Everything else.
    pub seed: u64,
}

/// Any policies.
pub fn configs() -> impl Strategy<Value = Config> {
    let select = |n: usize| 0..n;
    (select(3), select(2), select(3), select(2), select(2), any::<bool>()).prop_map(
        |(h, b, w, s, a, normal_test)| {
            Config::RESET
                .with_hazard([Hazard::Interlock, Hazard::Forward, Hazard::Published][h])
                .with_busy([Busy::Registered, Busy::Combinational][b])
                .with_input_width([InputWidth::One, InputWidth::Two, InputWidth::Four][w])
                .with_scheduler([Scheduler::Aftso, Scheduler::OnePhoton][s])
                .with_allocation([Allocation::Leaping, Allocation::Sequential][a])
                .with_normal_test(normal_test)
        },
    )
}

/// Any device.
pub fn kinds() -> impl Strategy<Value = Kind> {
    (0usize..3, any::<bool>(), any::<bool>()).prop_map(|(preus, f24, soft)| Kind {
        preus: [4, 8, 16][preus],
        format: if f24 { NumberFormat::F24 } else { NumberFormat::F32 },
        soft,
    })
}

/// Jobs that no device refuses.
pub fn shapes() -> impl Strategy<Value = Shape> {
    // Few hit points: many hazards. Lists: none, some, far more than there are PREUs.
    let hits = prop_oneof![1u32..6, 1u32..40, 100u32..400];
    let longest = prop_oneof![Just(1u32), 1u32..5, 4u32..20, 30u32..90];
    let odd = prop_oneof![Just(0u32), 2u32..60];
    (kinds(), configs(), hits, 1u32..12, (1u32..120, 0u32..80, longest), (0u32..6, odd), any::<u64>())
        .prop_map(|(kind, config, hits, pixels, (index, photons, longest), (ring, odd), seed)| Shape {
            kind,
            config,
            hits,
            pixels,
            index,
            photons,
            longest,
            ring,
            odd,
            broken: 0,
            seed,
        })
}

impl Shape {
    /// The job.
    pub fn job(&self) -> Job {
        let mut rng = Rng(self.seed);
        let format = self.kind.format;
        let odd = self.odd;
        let number = move |rng: &mut Rng, low: f32, high: f32| match odd > 0 && rng.once_in(odd) {
            false => encode(format, rng.real(low, high)),
            true => oddity(rng, format),
        };
        let broken = |rng: &mut Rng| self.broken > 0 && rng.once_in(self.broken);
        let hits = (0..self.hits)
            .map(|_| {
                let mut words = [0; 16];
                for (word, value) in words.iter_mut().enumerate() {
                    *value = match word {
                        0..3 => number(&mut rng, -1.0, 1.0),
                        3..6 => number(&mut rng, -0.5, 1.0),
                        6..9 => number(&mut rng, 0.0, 1.0),
                        9..12 => number(&mut rng, 0.0, 3.0),
                        12 => number(&mut rng, 0.5, 6.0),
                        13 => number(&mut rng, 0.0, 5.0),
                        14 if broken(&mut rng) => self.pixels + rng.word() % 3,
                        14 => rng.below(self.pixels),
                        _ => rng.word(),
                    };
                }
                words
            })
            .collect();
        let index = (0..self.index)
            .map(|_| if broken(&mut rng) { self.hits + rng.word() % 3 } else { rng.below(self.hits) })
            .collect();
        let photons = (0..self.photons)
            .map(|_| {
                let mut words = [0; 12];
                for value in &mut words[..3] {
                    *value = number(&mut rng, -1.0, 1.0);
                }
                for value in &mut words[3..6] {
                    *value = number(&mut rng, 0.0, 2.0);
                }
                for value in &mut words[8..11] {
                    *value = number(&mut rng, -0.5, 1.0);
                }
                let n = if rng.once_in(5) { 0 } else { rng.below(self.longest.min(self.index) + 1) };
                words[6] = rng.below(self.index - n + 1);
                words[7] = if broken(&mut rng) { self.index + 1 } else { n };
                words
            })
            .collect();
        Job {
            kind: self.kind,
            config: self.config,
            alpha: number(&mut rng, 0.1, 1.0),
            emitted: number(&mut rng, 1.0, 5000.0),
            hits,
            index,
            photons,
            pixels: (0..self.pixels).map(|_| [0; 3].map(|_: u32| number(&mut rng, 0.0, 0.1))).collect(),
            ring_entries: 1 << self.ring,
            ring_low: rng.below((1 << self.ring) + 1),
        }
    }
}

/// Bits that a careful host would not write: specials, subnormals, noise above the format's own bits.
fn oddity(rng: &mut Rng, format: NumberFormat) -> u32 {
    let fraction = if format == NumberFormat::F32 { 23 } else { 16 };
    let top = match format {
        NumberFormat::F32 | NumberFormat::F64 => 0xff << 23,
        NumberFormat::F24 => 0x7f << 16,
    };
    let sign = (rng.word() & 1) << if format == NumberFormat::F32 { 31 } else { 23 };
    match rng.below(8) {
        0 => 0,
        1 => sign | top,
        2 => sign | top | 1 << (fraction - 1),
        3 => sign | top | 1,
        4 => sign | (1 + rng.below(1 << fraction) % ((1 << fraction) - 1)),
        5 => sign,
        6 => sign | (top - 1),
        _ => rng.word(),
    }
}

/// Any displacement unit.
pub fn sizes(rng: &mut Rng) -> Sizes {
    let mut geometry = || {
        let (sets, ways, line) = (rng.below(4), rng.below(3), 2 + rng.below(5));
        Geometry { bytes: 1 << (sets + ways + line), ways: 1 << ways, line_bytes: 1 << line }
    };
    let (height_cache, texture_cache) = (geometry(), geometry());
    Sizes {
        units: 1 + rng.below(4),
        height_cache,
        texture_cache,
        fifo0: 1 + rng.below(18),
        fifo1: 1 + rng.below(18),
        port: PortSizes { latency: 1 + rng.below(60), bytes_per_cycle: 1 + rng.below(16) },
    }
}

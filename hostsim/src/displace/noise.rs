//! Numbers by chance that are always the same; in: a seed, or a place, out: numbers; cost: two multiplications each.

/// Mixes 64 bits so that each depends on all (SplitMix64's last step).
pub const fn mix(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A sequence: SplitMix64.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub const fn new(seed: u64) -> Self {
        Self(mix(seed ^ 0x6c75_6365_726e_6121))
    }

    /// 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mix(self.0)
    }

    /// At least 0, less than 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Less than `n`, which is not 0.
    pub const fn below(&mut self, n: u32) -> u32 {
        (((self.bits() >> 32) * n as u64) >> 32) as u32
    }
}

/// 0 to 1 for a lattice point, by chance.
pub fn lattice(seed: u64, x: u32, y: u32) -> f64 {
    let place = u64::from(x) << 32 | u64::from(y);
    (mix(place ^ mix(seed)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Smooth noise of 0 to 1 that repeats: `x` and `y` are of 0 to 1, with `cells` lattice points along each.
pub fn smooth(seed: u64, x: f64, y: f64, cells: u32) -> f64 {
    let (x, y) = (x * f64::from(cells), y * f64::from(cells));
    let (left, top) = (x.floor(), y.floor());
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (fx, fy) = (ease(x - left), ease(y - top));
    let at = |dx: u32, dy: u32| lattice(seed, (left as u32 + dx) % cells, (top as u32 + dy) % cells);
    let row = |dy: u32| at(0, dy) + (at(1, dy) - at(0, dy)) * fx;
    row(0) + (row(1) - row(0)) * fy
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chance_is_even_and_repeats() {
        let (mut a, mut b) = (Random::new(7), Random::new(7));
        let mean = (0..4096).map(|_| a.unit()).sum::<f64>() / 4096.0;
        assert!((mean - 0.5).abs() < 0.02);
        assert_eq!(b.unit(), Random::new(7).unit());
        assert!((0..1000).all(|_| b.below(3) < 3));
        assert!((smooth(1, 0.0, 0.3, 4) - smooth(1, 1.0 - 1e-12, 0.3, 4)).abs() < 1e-9, "it repeats");
    }
}

//! Operands: a third random bits, a third near each other, a third special.

use lucerna_softfloat::Float;

/// A small random generator (xorshift64*).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    pub fn below(&mut self, bound: u32) -> u32 {
        (((self.bits() >> 32) * u64::from(bound)) >> 32) as u32
    }

    /// A pair of operands of a format.
    pub fn pair<const EXP: u32, const FRAC: u32>(&mut self) -> (Float<EXP, FRAC>, Float<EXP, FRAC>) {
        let choice = self.below(9);
        let a = match choice {
            0..6 => self.any(),
            _ => self.special(),
        };
        let b = match choice {
            0..3 => self.any(),
            3..6 => self.near(a),
            6 => self.special(),
            7 => self.near(a),
            _ => self.any(),
        };
        if self.below(2) == 0 { (a, b) } else { (b, a) }
    }

    pub fn any<const EXP: u32, const FRAC: u32>(&mut self) -> Float<EXP, FRAC> {
        Float::from_bits(self.bits() as u32)
    }

    /// A number whose exponent is within `FRAC` + 3 of another's, or of that which brings a product or a quotient to the
    /// ends of the range.
    fn near<const EXP: u32, const FRAC: u32>(&mut self, a: Float<EXP, FRAC>) -> Float<EXP, FRAC> {
        let exponent = (a.abs().to_bits() >> FRAC) as i32;
        let bias = Float::<EXP, FRAC>::BIAS;
        let spread = self.below(2 * (FRAC + 3) + 1) as i32 - (FRAC + 3) as i32;
        let aim = match self.below(5) {
            0 | 1 => exponent,
            2 => bias - exponent,
            3 => 3 * bias - exponent,
            _ => exponent + bias,
        };
        let exponent = (aim + spread).clamp(0, 2 * bias) as u32;
        let bits = self.bits() as u32;
        // Some significands are short, so that ties and exact results come up.
        let fraction = bits & (u32::MAX << if self.below(2) == 0 { 0 } else { self.below(FRAC) });
        let fraction = fraction & ((1 << FRAC) - 1);
        Float::from_bits(self.below(2) << (EXP + FRAC) | exponent << FRAC | fraction)
    }

    /// A value at a border of something, or a few units from one, of either sign.
    fn special<const EXP: u32, const FRAC: u32>(&mut self) -> Float<EXP, FRAC> {
        type F<const EXP: u32, const FRAC: u32> = Float<EXP, FRAC>;
        let borders = [
            F::<EXP, FRAC>::ZERO,
            F::ONE,
            F::MIN_POSITIVE,
            F::MIN_SUBNORMAL,
            F::MAX,
            F::INFINITY,
            F::NAN,
            F::from_f32(2.0),
            F::from_f32(0.5),
            F::from_f32(4_294_967_296.0),
            F::from_f32(2_147_483_648.0),
        ];
        let border = borders[self.below(borders.len() as u32) as usize].to_bits();
        let bits = border.wrapping_add(self.below(7)).wrapping_sub(3);
        Float::from_bits(bits ^ self.below(2) << (EXP + FRAC))
    }
}

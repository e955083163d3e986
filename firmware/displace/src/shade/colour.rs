//! Colour calculation (§4.1); in: a texture and a normal texel, out: the colour that the light gives; cost:
//! [`COLOUR`](crate::operators::COLOUR).
//!
//! The paper says "using the texture and normal data" and Table 1 which operators there are. Diffuse light on a normal whose
//! length is divided out needs exactly those: 1 adder, 1 3-input adder, 3 multipliers, 1 divider, 1 square root.

use lucerna_softfloat::{F24, Format, FormatCode};

/// The light of a job.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Light<F> {
    /// Towards the light, in tangent space, of length one.
    pub towards: [F; 3],
    /// Light that is everywhere.
    pub ambient: F,
    /// Light that falls at right angles.
    pub diffuse: F,
}

/// What a byte of a normal texel stands for: `(byte - 128) / 127`.
const COMPONENT: [f32; 256] = {
    let (mut table, mut byte) = ([0.0; 256], 0);
    while byte < 256 {
        table[byte] = (byte as i32 - 128) as f32 / 127.0;
        byte += 1;
    }
    table
};

/// The bits of the same in the narrow format.
const NARROW: [u32; 256] = {
    let (mut table, mut byte) = ([0; 256], 0);
    while byte < 256 {
        table[byte] = F24::from_f32(COMPONENT[byte]).to_bits();
        byte += 1;
    }
    table
};

/// The component of a byte, rounded once.
#[inline]
fn component<F: Format>(byte: u32) -> F {
    let byte = (byte & 0xFF) as usize;
    if matches!(F::CODE, FormatCode::F24) { F::from_bits(NARROW[byte]) } else { F::from_f32(COMPONENT[byte]) }
}

/// The colour `0x00RRGGBB` of a texture texel `0x00RRGGBB` with a normal texel `0x00ZZYYXX`. A light turned away, a normal of no
/// length, and numbers that are none, give the ambient light; a channel that is no number is black.
#[inline(never)]
pub fn colour<F: Format>(light: &Light<F>, texture: u32, normal: u32) -> u32 {
    let shade = shade(light, normal);
    let channel = |shift: u32| u32::from(shade.times_byte((texture >> shift) as u8)) << shift;
    channel(16) | channel(8) | channel(0)
}

/// `ambient + diffuse · max(0, n · l / |n|)`.
#[inline]
pub fn shade<F: Format>(light: &Light<F>, normal: u32) -> F {
    let n = [0, 8, 16].map(|shift| component(normal >> shift));
    let [towards, square] = F::dots([&light.towards, &n], &n);
    let cosine = towards.div(square.sqrt());
    // By the sign and the class of the number: Table 1 has no comparator here.
    let lambert = if F::ZERO.lt(cosine) { cosine } else { F::ZERO };
    light.ambient.add(light.diffuse.mul(lambert))
}

#[cfg(test)]
mod tests {
    use super::{COMPONENT, Light, colour, shade};
    use lucerna_softfloat::{F24, F32, Format};
    use proptest::prelude::*;

    const UP: u32 = 0x00FF_8080;

    fn light<F: Format>(towards: [f32; 3], ambient: f32, diffuse: f32) -> Light<F> {
        Light {
            towards: towards.map(F::from_f32),
            ambient: F::from_f32(ambient),
            diffuse: F::from_f32(diffuse),
        }
    }

    fn by_hand<F: Format>() {
        let overhead = |ambient, diffuse| light::<F>([0.0, 0.0, 1.0], ambient, diffuse);
        assert_eq!(colour(&overhead(0.25, 0.75), 0x00FF_8001, UP), 0x00FF_8001);
        // Half the light: 127.5, 64, 0.5; halves go up.
        assert_eq!(colour(&overhead(0.25, 0.25), 0x00FF_8001, UP), 0x0080_4001);
        assert_eq!(colour(&overhead(0.0, 2.0), 0x00FF_8001, UP), 0x00FF_FF02, "clipped");
        assert_eq!(colour(&overhead(-1.0, 0.0), 0x00FF_8001, UP), 0, "clipped");
        // The normal (127, 0, 127) / 127: the cosine is 1 / sqrt 2, and 200 / sqrt 2 is 141.4.
        assert_eq!(colour(&overhead(0.0, 1.0), 0x00C8_0000, 0x00FF_80FF), 0x008D_0000);
        assert_eq!(colour(&light::<F>([0.0, 0.0, -1.0], 0.5, 1.0), 0x00C8_0000, UP), 0x0064_0000, "behind");
        assert_eq!(colour(&overhead(1.0, 0.0), 0xFF11_2233, UP), 0x0011_2233, "upper bits do not count");
    }

    #[test]
    fn values_worked_by_hand() {
        by_hand::<F32>();
        by_hand::<F24>();
    }

    fn nonsense<F: Format>() {
        let overhead = light::<F>([0.0, 0.0, 1.0], 0.5, 1.0);
        assert_eq!(shade(&overhead, 0x0080_8080), F::from_f32(0.5), "a normal of no length");
        let dark = light::<F>([f32::NAN, 0.0, 1.0], 0.5, 1.0);
        assert_eq!(shade(&dark, UP), F::from_f32(0.5));
        assert_eq!(colour(&light::<F>([0.0, 0.0, 1.0], f32::NAN, 1.0), 0x00FF_FFFF, UP), 0);
        assert_eq!(colour(&light::<F>([0.0, 0.0, 1.0], f32::INFINITY, 1.0), 0x00FF_00FF, UP), 0x00FF_00FF);
    }

    #[test]
    fn nonsense_has_a_colour() {
        nonsense::<F32>();
        nonsense::<F24>();
    }

    /// Rounding the quotient to f32 first does not change its rounding to the narrow format.
    #[test]
    fn components_are_rounded_once() {
        for (byte, component) in COMPONENT.iter().enumerate() {
            let quotient = (byte as f64 - 128.0) / 127.0;
            assert_eq!(F24::from_f32(*component), F24::from_f64(quotient), "{byte}");
            assert_eq!(*component, quotient as f32, "{byte}");
        }
    }

    /// In binary64, with the number of roundings of the datapath as tolerance.
    fn near<F: Format>(
        towards: [f32; 3],
        ambient: f32,
        diffuse: f32,
        texel: u32,
        normal: u32,
        tolerance: f64,
    ) {
        let light = light::<F>(towards, ambient, diffuse);
        let n = [0, 8, 16].map(|shift| (f64::from(normal >> shift & 0xFF) - 128.0) / 127.0);
        let l = towards.map(f64::from);
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let lambert = if dot(n, n) > 0.0 { (dot(n, l) / dot(n, n).sqrt()).max(0.0) } else { 0.0 };
        let expected = f64::from(ambient) + f64::from(diffuse) * lambert;
        let got = shade(&light, normal);
        assert!((f64::from(got.to_f32()) - expected).abs() < tolerance, "{} {expected}", got.to_f32());
        for shift in [0, 8, 16] {
            let exact = (f64::from(texel >> shift & 0xFF) * expected).min(255.0);
            let channel = f64::from(colour(&light, texel, normal) >> shift & 0xFF);
            assert!((channel - exact).abs() <= 0.5 + 256.0 * tolerance, "{channel} {exact}");
        }
    }

    proptest! {
        #[test]
        fn is_the_diffuse_light_within_rounding(
            towards in prop::array::uniform3(-1.0f32..1.0),
            (ambient, diffuse) in (0.0f32..1.0, 0.0f32..1.0),
            (texel, normal) in (any::<u32>(), any::<u32>()),
        ) {
            near::<F32>(towards, ambient, diffuse, texel, normal, 3e-6);
            near::<F24>(towards, ambient, diffuse, texel, normal, 4e-4);
        }

        /// Whatever the bits, there is a colour.
        #[test]
        fn is_total(bits in prop::array::uniform7(any::<u32>())) {
            let [x, y, z, ambient, diffuse] = [0, 1, 2, 3, 4].map(|i| F24::from_bits(bits[i]));
            let light = Light { towards: [x, y, z], ambient, diffuse };
            prop_assert_eq!(colour(&light, bits[5], bits[6]) >> 24, 0);
        }
    }
}

//! Are the host's numbers the soft ones, to the bit?

use super::*;
use lucerna_softfloat::{F24, Line};
use proptest::prelude::*;

/// Bits with all exponents, and the special values more often than chance has them.
fn bits(width: u32) -> impl Strategy<Value = u32> {
    let special =
        prop::sample::select(vec![0u32, 1, 2, 0x7f_ffff, 0x80_0000, 0x80_0001, 0x01_0000, 0x00_ffff]);
    let top = if width == 24 { 0x7f_0000u32 } else { 0x7f80_0000 };
    prop_oneof![6 => any::<u32>(), 1 => special, 1 => Just(top), 1 => Just(top | 0x4000), 1 => Just(top - 1)]
        .prop_map(move |bits| if width == 24 { bits & 0xff_ffff } else { bits })
}

fn same<H: Format, S: Format>(a: u32, b: u32) -> Result<(), TestCaseError> {
    let (ha, hb, sa, sb) = (H::from_bits(a), H::from_bits(b), S::from_bits(a), S::from_bits(b));
    let host = [ha.add(hb), ha.sub(hb), ha.mul(hb), ha.div(hb), ha.square(), ha.sqrt()].map(H::to_bits);
    let soft = [sa.add(sb), sa.sub(sb), sa.mul(sb), sa.div(sb), sa.square(), sa.sqrt()].map(S::to_bits);
    prop_assert_eq!(host, soft, "{:08x} {:08x}", a, b);
    prop_assert_eq!((ha.lt(hb), ha.le(hb), ha.eq(hb)), (sa.lt(sb), sa.le(sb), sa.eq(sb)));
    let x = f32::from_bits(a);
    prop_assert_eq!(H::from_f32(x).to_bits(), S::from_f32(x).to_bits());
    for log2 in [0, 1, b % 14, 31] {
        prop_assert_eq!(ha.floor_scaled(log2), sa.floor_scaled(log2), "{:08x} {}", a, log2);
        for integer in [b as i32, b as i32 >> 8, (b & 0x3fff) as i32 - 0x2000] {
            let (host, soft) = (H::from_scaled(integer, log2), S::from_scaled(integer, log2));
            prop_assert_eq!(host.to_bits(), soft.to_bits(), "{} {}", integer, log2);
        }
    }
    lines::<H, S>([a, b], [b, a], b)?;
    lines::<H, S>([a, b], [b, b], a)
}

/// The methods that are more than an operation.
fn formulas<H: Format, S: Format>(numbers: [u32; 8]) -> Result<(), TestCaseError> {
    fn dots<F: Format>([a, b, c, d, e, f, g, h]: [u32; 8]) -> [u32; 8] {
        let (one, two, with) =
            ([a, b, c].map(F::from_bits), [d, e, f].map(F::from_bits), [g, h, c].map(F::from_bits));
        let ([x], [y, z]) = (F::dots([&one], &two), F::dots([&one, &with], &with));
        let [u, v] = F::along([one[0], two[0]], [one[1], two[1]], with[0]);
        let bytes = [1, 2, 100, 255].map(|byte| with[0].times_byte(byte));
        let [r, s] = [x, y].map(|x| x.times_byte(c as u8).into());
        [x, y, z, u, v]
            .map(F::to_bits)
            .iter()
            .copied()
            .chain([u32::from_le_bytes(bytes), r, s])
            .collect::<Vec<_>>()
            .try_into()
            .unwrap()
    }
    prop_assert_eq!(dots::<H>(numbers), dots::<S>(numbers), "{:x?}", numbers);
    Ok(())
}

/// What crossings and landings of rays are found by.
fn lines<H: Format, S: Format>(point: [u32; 2], direction: [u32; 2], t: u32) -> Result<(), TestCaseError> {
    let from_0_to_1 = S::ZERO.le(S::from_bits(t)) && S::from_bits(t).le(S::ONE);
    let t = if from_0_to_1 { t } else { S::from_f32((t % 256) as f32 / 255.0).to_bits() };
    let (host_t, soft_t) = (H::from_bits(t), S::from_bits(t));
    let small = [point[1] as i32 % 5000, direction[0] as i32 % 5000];
    for (log2, edge) in [([0, 12], small), ([8, 8], [small[0]; 2]), ([11, 3], [t as i32, 1 << 17])] {
        let host = H::Line::new(point.map(H::from_bits), direction.map(H::from_bits), log2);
        let soft = S::Line::new(point.map(S::from_bits), direction.map(S::from_bits), log2);
        let (from_host, from_soft) = (
            H::Line::from_edge(point.map(H::from_bits), direction.map(H::from_bits), log2),
            S::Line::from_edge(point.map(S::from_bits), direction.map(S::from_bits), log2),
        );
        prop_assert_eq!(from_host.map(|(edge, _)| edge), from_soft.map(|(edge, _)| edge), "{:x?}", soft);
        if let (Some((_, host)), Some((_, soft))) = (from_host, from_soft) {
            prop_assert_eq!(host.first(), soft.first(), "{:x?}", soft);
            prop_assert_eq!(host.cell(host_t, 0), soft.cell(soft_t, 0), "{:08x} {:x?}", t, soft);
            prop_assert_eq!(host.cell(host_t, 1), soft.cell(soft_t, 1), "{:08x} {:x?}", t, soft);
            let exit = host.exit(edge).map(|(axis, t)| (axis, t.to_bits()));
            prop_assert_eq!(exit, soft.exit(edge).map(|(axis, t)| (axis, t.to_bits())), "{:x?}", soft);
        }
        prop_assert_eq!(host.first(), soft.first(), "{:x?}", soft);
        let cells = (host.cell(host_t, 0), host.cell(host_t, 2));
        prop_assert_eq!(cells, (soft.cell(soft_t, 0), soft.cell(soft_t, 2)), "{:08x} {:x?}", t, soft);
        for axis in 0..2 {
            prop_assert_eq!(host.index(axis, host_t), soft.index(axis, soft_t), "{:08x} {:x?}", t, soft);
        }
        for edge in [edge, cells.0, [cells.0[0] + 1, cells.0[1] - 1]] {
            let exit = host.exit(edge).map(|(axis, t)| (axis, t.to_bits()));
            prop_assert_eq!(
                exit,
                soft.exit(edge).map(|(axis, t)| (axis, t.to_bits())),
                "{:?} {:x?}",
                edge,
                soft
            );
        }
    }
    Ok(())
}

/// Every F24 number there is.
#[test]
fn every_floor_is_the_soft_one() {
    for bits in 0..1 << 24 {
        let (host, soft) = (HostF24::from_bits(bits), F24::from_bits(bits));
        assert_eq!(host.floor_scaled(8), soft.floor_scaled(8), "{bits:06x}");
    }
}

#[test]
fn floors_go_down_and_are_clipped() {
    let floor = |x: f64| HostF64(x).floor_scaled(2);
    for (x, below) in [(0.9, 3), (-0.1, -1), (-0.25, -1), (-0.26, -2), (0.0, 0), (-0.0, 0), (1e-300, 0)] {
        assert_eq!(floor(x), below, "{x}");
    }
    assert_eq!([f64::NAN, 1e30, f64::NEG_INFINITY, -5e6].map(floor), [0, 1 << 24, -(1 << 24), -(1 << 24)]);
    assert_eq!(HostF64::from_scaled(-3, 2), HostF64(-0.75));
    let third = HostF64::ONE.div(HostF64::from_f32(3.0));
    assert_eq!(HostF64(1.0 / 3.0), third, "53 bits inside");
    assert_eq!(HostF64::from_bits(third.to_bits()).to_f32(), 1.0 / 3.0, "24 outside");
    assert_eq!(HostF64(f64::NAN).to_bits(), 0x7fc0_0000);
    for nan in [0x7fff_ffff, 0xffff_ffff, 0x7f80_0001].map(f32::from_bits) {
        assert_eq!(HostF24::from_f32(nan).to_bits(), F24::from_f32(nan).to_bits());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200_000))]
    #[test]
    fn f32_is_the_soft_one((a, b) in (bits(32), bits(32))) {
        same::<HostF32, F32>(a, b)?;
    }
    #[test]
    fn f24_is_the_soft_one((a, b) in (bits(24), bits(24))) {
        same::<HostF24, F24>(a, b)?;
    }
    /// Results near the least normal and near overflow.
    #[test]
    fn f24_at_its_edges((a, b) in (bits(24), prop::sample::select(vec![0x20_0000u32, 0x1f_ffff, 0x5f_0001, 0x3f_0000]))) {
        same::<HostF24, F24>(a, b)?;
        same::<HostF24, F24>(0x20_0000 | a & 0xffff, b)?;
    }
    #[test]
    fn f24_formulas_are_the_soft_ones(
        numbers in prop::array::uniform8(bits(24)),
        small in prop::array::uniform8(bits(24)),
        mask in any::<u8>(),
        exponent in 0u32..128,
    ) {
        formulas::<HostF24, F24>(numbers)?;
        // Many zeros, and exponents near each other, so that terms cancel or lose digits.
        let near: [u32; 8] = core::array::from_fn(|i| {
            if mask >> i & 1 == 1 { small[i] & 0x80_0000 } else { small[i] & 0x83_ffff | exponent << 16 }
        });
        formulas::<HostF24, F24>(near)?;
        formulas::<HostF24, F24>(near.map(|x| x & 0x80_ffff | (0x3e + (x >> 16 & 3)) << 16))?;
    }
    #[test]
    fn f32_formulas_are_the_soft_ones(numbers in prop::array::uniform8(bits(32))) {
        formulas::<HostF32, F32>(numbers)?;
    }
    /// Rays as jobs have them: points on tiles, often on a texel's edge or a digit beside it, so that what is rounded decides.
    #[test]
    fn rays_are_the_soft_ones(
        texels in prop::array::uniform2(-600i32..600),
        beside in prop::array::uniform2(0u32..3),
        slopes in prop::array::uniform2(prop_oneof![Just(0.0f32), Just(0.125), Just(-0.25), -1.0f32..1.0]),
        t in prop_oneof![Just(0.0f32), Just(1.0), (0u8..=255).prop_map(|height| f32::from(255 - height) / 255.0), 0.0f32..1.0],
    ) {
        let texel = |axis: usize| F24::from_f32(texels[axis] as f32 / 256.0).to_bits();
        let point = [0, 1].map(|axis| texel(axis).wrapping_add(beside[axis]).wrapping_sub(1) & 0xff_ffff);
        lines::<HostF24, F24>(point, slopes.map(|x| F24::from_f32(x).to_bits()), F24::from_f32(t).to_bits())?;
        let point = [0, 1].map(|axis| (texels[axis] as f32 / 256.0).to_bits().wrapping_add(beside[axis]).wrapping_sub(1));
        lines::<HostF32, F32>(point, slopes.map(f32::to_bits), t.to_bits())?;
    }
}

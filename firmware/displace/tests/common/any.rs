//! Any cache, any way through a pyramid, any small height field.

use lucerna_displace::traverse::{Ascend, Coherent, Policies, Wrap};
use lucerna_fabric::cache::Geometry;
use proptest::prelude::*;

use super::Heights;

pub fn geometry() -> impl Strategy<Value = Geometry> {
    (0u32..3, 0u32..3, 2u32..7).prop_map(|(sets, ways, line)| Geometry {
        bytes: 1 << (sets + ways + line),
        ways: 1 << ways,
        line_bytes: 1 << line,
    })
}

pub fn policies() -> impl Strategy<Value = Policies> {
    let ascend =
        prop::sample::select(vec![Ascend::Never, Ascend::Parity, Ascend::Selective, Ascend::Coherent]);
    let coherent = prop::sample::select(vec![Coherent::Toggle, Coherent::Consecutive, Coherent::Parity]);
    let wrap = prop::sample::select(vec![Wrap::Repeat, Wrap::Border]);
    (wrap, any::<bool>(), 0u32..4, 1u32..5, ascend, coherent, 1u32..4, any::<bool>()).prop_map(
        |(wrap, start_level, start_grid, levels_down, ascend, coherent, reach, siblings)| Policies {
            wrap,
            start_level,
            start_grid,
            levels_down,
            ascend,
            coherent,
            reach,
            siblings,
        },
    )
}

pub fn heights() -> impl Strategy<Value = Heights> {
    (0u32..6, 0u32..6, any::<u32>(), 0u32..4).prop_map(|(w, h, seed, kind)| {
        Heights::new([w, h], |x, y| {
            let noise = (x.wrapping_mul(0x85EB_CA6B) ^ y.wrapping_mul(0xC2B2_AE35) ^ seed)
                .wrapping_mul(0x27D4_EB2F)
                .rotate_left(13)
                .wrapping_mul(0x1656_67B1);
            match kind {
                0 => (noise >> 24) as u8,
                1 => 255 * u8::from(noise >> 29 == 0),
                2 => (x * 8 + y * 5) as u8,
                _ => (seed >> 24) as u8,
            }
        })
    })
}

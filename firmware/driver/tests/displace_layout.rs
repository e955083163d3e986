//! Can an illegal layout of a displacement job be made?

mod common;

use common::displacer::{SIZES, capabilities, layout};
use lucerna_driver::Capabilities;
use lucerna_driver::displace::{Bases, Buffer, Layout, LayoutError, Shape, Sizes};
use proptest::prelude::*;

const BASES: Bases = Bases { map: 0, texture: 0x80, normals: 0xC0, rays: 0x100, results: 0x180 };

#[test]
fn a_packed_layout_is_as_small_as_it_can_be() {
    let packed = layout(SIZES);
    assert_eq!(packed, Layout::new(&capabilities(), SIZES, BASES).unwrap());
    assert_eq!(SIZES.bytes(), 0x200);
    assert_eq!(packed.region(Buffer::Results).limit(), 0x200);
    let windows = packed.windows().map(|window| (window.base(), window.limit()));
    assert_eq!(windows, [(0, 0x80), (0x80, 0x100), (0x100, 0x180), (0x180, 0x200)]);
    let device = |memory_bytes| Capabilities { memory_bytes, ..capabilities() };
    Layout::packed(&device(0x200), SIZES).unwrap();
    let short = Layout::packed(&device(0x1FF), SIZES);
    assert_eq!(short, Err(LayoutError::OutsideMemory(Buffer::Results)));
    // Elsewhere.
    let moved = Layout::packed_at(&capabilities(), SIZES, 0x400).unwrap();
    assert_eq!(moved.region(Buffer::Normals).base(), 0x4C0);
    let error = Layout::packed_at(&capabilities(), SIZES, 0x404).unwrap_err();
    assert_eq!(error, LayoutError::Misaligned(Buffer::Map));
    let error = Layout::packed_at(&capabilities(), SIZES, !63).unwrap_err();
    assert_eq!(error, LayoutError::OutsideMemory(Buffer::Map));
    // Without rays their window is closed, and their base is not looked at.
    let none = Sizes { rays: 0, ..SIZES };
    let layout = Layout::new(&capabilities(), none, Bases { rays: 3, ..BASES }).unwrap();
    assert_eq!((layout.region(Buffer::Rays).base(), layout.region(Buffer::Rays).limit()), (0, 0));
}

#[test]
fn every_illegal_layout_has_its_error() {
    let device = capabilities();
    let sized = |sizes| Layout::new(&device, sizes, BASES).unwrap_err();
    assert_eq!(sized(Sizes { results: 0, ..SIZES }), LayoutError::Empty);
    assert_eq!(sized(Sizes { results: u32::MAX, ..SIZES }), LayoutError::OutsideMemory(Buffer::Results));
    let large = Shape::new(12, 12).unwrap();
    assert_eq!(sized(Sizes { map: large, ..SIZES }), LayoutError::OutsideMemory(Buffer::Map));
    let error = sized(Sizes { rays: 5, ..SIZES });
    assert_eq!(error, LayoutError::Overlap(Buffer::Rays, Buffer::Results));
    let placed = |bases| Layout::new(&device, SIZES, bases).unwrap_err();
    assert_eq!(placed(Bases { rays: 0x104, ..BASES }), LayoutError::Misaligned(Buffer::Rays));
    let error = placed(Bases { results: 0, ..BASES });
    assert_eq!(error, LayoutError::Overlap(Buffer::Map, Buffer::Results));
    let error = placed(Bases { normals: 0x400, ..BASES });
    assert_eq!(error, LayoutError::Between(Buffer::Rays));
    let error = placed(Bases { normals: 0, map: 0x400, texture: 0x600, ..BASES });
    assert_eq!(error, LayoutError::Between(Buffer::Map));
    assert!(error.to_string().contains("share a window: place it elsewhere"));
    // The other way round is fine, and so is a gap.
    Layout::new(&device, SIZES, Bases { texture: 0xC0, normals: 0x80, ..BASES }).unwrap();
    Layout::new(&device, SIZES, Bases { texture: 0x400, normals: 0x800, ..BASES }).unwrap();
}

proptest! {
    #[test]
    fn a_layout_that_is_made_is_legal(
        logs in prop::array::uniform6(0u32..6),
        rays in 0u32..20,
        results in 0u32..20,
        places in prop::array::uniform5(prop_oneof![
            18 => (0u32..40).prop_map(|n| n * 1024),
            1 => 0u32..4000,
            1 => any::<u32>(),
        ]),
    ) {
        let shape = |first: usize| Shape::new(logs[first], logs[first + 1]).unwrap();
        let sizes = Sizes { map: shape(0), texture: shape(2), normals: shape(4), rays, results };
        let [map, texture, normals, ray_base, result_base] = places;
        let bases = Bases { map, texture, normals, rays: ray_base, results: result_base };
        let up = |bytes: u32| u64::from(bytes.div_ceil(64) * 64);
        let mut buffers = vec![
            (places[0], up(sizes.map.pyramid_bytes())),
            (places[1], up(sizes.texture.texels() * 4)),
            (places[2], up(sizes.normals.texels() * 4)),
            (places[4], up(results * 32)),
        ];
        if rays > 0 {
            buffers.push((places[3], up(rays * 32)));
        }
        let end = |(base, bytes): (u32, u64)| u64::from(base) + bytes;
        let apart = |a: (u32, u64), b: (u32, u64)| end(a) <= u64::from(b.0) || end(b) <= u64::from(a.0);
        let pairs = (0..buffers.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        let (first, last) = (texture.min(normals), end(buffers[1]).max(end(buffers[2])));
        let shading = (first, last - u64::from(first));
        let legal = results > 0
            && buffers.iter().all(|(base, bytes)| base % 64 == 0 && end((*base, *bytes)) <= u64::from(common::MEMORY_BYTES))
            && pairs.into_iter().all(|(a, b)| apart(buffers[a], buffers[b]))
            && buffers.iter().enumerate().all(|(number, buffer)| matches!(number, 1 | 2) || apart(*buffer, shading));
        prop_assert_eq!(Layout::new(&capabilities(), sizes, bases).is_ok(), legal);
    }
}

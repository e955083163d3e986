//! Can an illegal layout, job or number be made? And are records what they should be in both formats?

mod common;

use common::{SIZES, capabilities, layout};
use lucerna_driver::records::{HIT_POINT_WORDS, decode, encode};
use lucerna_driver::{
    Bases, Buffer, Capabilities, EvaluateJob, HitPoint, JobError, Layout, LayoutError, NumberFormat,
    Policies, Sizes, UpdateJob,
};
use lucerna_softfloat::{F24, F32};
use proptest::prelude::*;

fn bases() -> Bases {
    Bases { hit_points: 0, index: 0x100, pixels: 0x120, ring: 0x138 }
}

#[test]
fn a_packed_layout_is_as_small_as_it_can_be() {
    let packed = layout(SIZES);
    assert_eq!(packed, Layout::new(&capabilities(), SIZES, bases()).unwrap());
    assert_eq!(u64::from(packed.region(Buffer::Ring).limit()), SIZES.bytes());
    let exact = Capabilities { memory_bytes: 0x238, ..capabilities() };
    Layout::packed(&exact, SIZES).unwrap();
    let short = Capabilities { memory_bytes: 0x237, ..capabilities() };
    assert_eq!(Layout::packed(&short, SIZES), Err(LayoutError::OutsideMemory(Buffer::Ring)));
}

#[test]
fn every_illegal_layout_has_its_error() {
    let device = capabilities();
    let sized = |sizes| Layout::new(&device, sizes, bases()).unwrap_err();
    assert_eq!(sized(Sizes { hit_points: 0, ..SIZES }), LayoutError::Empty(Buffer::HitPoints));
    assert_eq!(sized(Sizes { index_entries: 0, ..SIZES }), LayoutError::Empty(Buffer::Index));
    assert_eq!(sized(Sizes { pixels: 0, ..SIZES }), LayoutError::Empty(Buffer::Pixels));
    for entries in [0, 3, 12, 1 << 17, u32::MAX] {
        let error = sized(Sizes { ring_entries: entries, ..SIZES });
        assert_eq!(error, LayoutError::RingEntries { entries });
    }
    assert_eq!(
        sized(Sizes { hit_points: 5, ..SIZES }),
        LayoutError::Overlap(Buffer::HitPoints, Buffer::Index)
    );
    assert_eq!(sized(Sizes { pixels: 3, ..SIZES }), LayoutError::Overlap(Buffer::Pixels, Buffer::Ring));
    assert_eq!(sized(Sizes { pixels: u32::MAX, ..SIZES }), LayoutError::OutsideMemory(Buffer::Pixels));
    let placed = |bases| Layout::new(&device, SIZES, bases).unwrap_err();
    assert_eq!(placed(Bases { index: 0x101, ..bases() }), LayoutError::Misaligned(Buffer::Index));
    assert_eq!(placed(Bases { ring: u32::MAX - 3, ..bases() }), LayoutError::OutsideMemory(Buffer::Ring));
    assert_eq!(placed(Bases { ring: 0, ..bases() }), LayoutError::Overlap(Buffer::HitPoints, Buffer::Ring));
    let swapped = Bases { hit_points: 0x10, index: 0, ..bases() };
    assert_eq!(placed(swapped), LayoutError::Overlap(Buffer::HitPoints, Buffer::Index));
    let error = placed(Bases { index: 0x102, ..bases() });
    assert_eq!(error.to_string(), "the index table is misaligned: place it at a multiple of 4");
}

#[test]
fn alpha_is_a_fraction_in_the_device_s_format() {
    let f24 = Capabilities { format: NumberFormat::F24, ..capabilities() };
    let cases = [
        (0.7, true, true),
        (1.0, true, true),
        (0.0, false, false),
        (-0.0, false, false),
        (-0.5, false, false),
        (1.000_000_1, false, false),
        (f32::NAN, false, false),
        (f32::INFINITY, false, false),
        // Below half of the least F24, 2^-78.
        (1e-24, true, false),
    ];
    for (alpha, in_f32, in_f24) in cases {
        for (device, legal) in [(capabilities(), in_f32), (f24, in_f24)] {
            let layout = Layout::packed(&device, SIZES).unwrap();
            let job = UpdateJob::new(&layout, alpha, Policies::default());
            assert_eq!(job.err(), (!legal).then_some(JobError::Alpha), "{alpha} {:?}", device.format);
        }
    }
}

#[test]
fn the_photons_emitted_are_a_positive_number_of_the_device_s_format() {
    let f24 = Capabilities { format: NumberFormat::F24, ..capabilities() };
    let cases = [
        (1.0, true, true),
        (768_000.0, true, true),
        (0.0, false, false),
        (-1.0, false, false),
        (f32::NAN, false, false),
        (f32::INFINITY, false, false),
        // Above the greatest F24, just below 2^64.
        (2e19, true, false),
    ];
    for (emitted, in_f32, in_f24) in cases {
        for (device, legal) in [(capabilities(), in_f32), (f24, in_f24)] {
            let layout = Layout::packed(&device, SIZES).unwrap();
            let job = EvaluateJob::new(&layout, emitted, Policies::default());
            assert_eq!(job.err(), (!legal).then_some(JobError::Emitted), "{emitted} {:?}", device.format);
        }
    }
}

#[test]
fn the_ring_space_threshold_is_below_the_ring() {
    let job = UpdateJob::new(&layout(SIZES), 0.7, Policies::default()).unwrap();
    assert_eq!(job.with_ring_low(8), Err(JobError::RingLow));
    job.with_ring_low(7).unwrap();
    job.with_ring_low(0).unwrap();
}

proptest! {
    #[test]
    fn a_layout_that_is_made_is_legal(
        counts in prop::array::uniform3(prop_oneof![9 => 1u32..20, 1 => any::<u32>()]),
        ring in prop_oneof![9 => (0u32..10).prop_map(|bit| 1 << bit), 1 => any::<u32>()],
        places in prop::array::uniform4(prop_oneof![
            18 => (0u32..60).prop_map(|n| n * 256),
            1 => 0u32..4000,
            1 => any::<u32>(),
        ]),
        normal_test: bool,
    ) {
        let [hit_points, index_entries, pixels] = counts;
        let sizes = Sizes { hit_points, index_entries, pixels, ring_entries: ring, normal_test };
        let bases = Bases { hit_points: places[0], index: places[1], pixels: places[2], ring: places[3] };
        let record = if normal_test { 48 } else { 32 };
        let buffers = [
            (places[0], u128::from(hit_points) * 64),
            (places[1], u128::from(index_entries) * 4),
            (places[2], u128::from(pixels) * 12),
            (places[3], u128::from(ring) * record),
        ];
        let inside = |(base, bytes): (u32, u128)| {
            bytes > 0 && base % 4 == 0 && u128::from(base) + bytes <= u128::from(common::MEMORY_BYTES)
        };
        let apart = |a: (u32, u128), b: (u32, u128)| {
            u128::from(a.0) + a.1 <= u128::from(b.0) || u128::from(b.0) + b.1 <= u128::from(a.0)
        };
        let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
        let legal = buffers.into_iter().all(inside)
            && pairs.into_iter().all(|(a, b)| apart(buffers[a], buffers[b]))
            && ring.count_ones() == 1
            && ring <= 65536;
        prop_assert_eq!(Layout::new(&capabilities(), sizes, bases).is_ok(), legal);
    }

    #[test]
    fn a_packed_layout_fails_only_for_want_of_memory(
        hit_points in 1u32..2000, index_entries in 1u32..2000, pixels in 1u32..2000, ring in 0u32..10,
    ) {
        let ring_entries = 1 << ring;
        let sizes = Sizes { hit_points, index_entries, pixels, ring_entries, normal_test: true };
        let fits = sizes.bytes() <= u64::from(common::MEMORY_BYTES);
        prop_assert_eq!(Layout::packed(&capabilities(), sizes).is_ok(), fits);
    }

    #[test]
    fn numbers_are_rounded_once_and_read_back_exactly(number: f32) {
        prop_assert_eq!(encode(NumberFormat::F24, number), F24::from_f32(number).to_bits());
        prop_assert_eq!(encode(NumberFormat::F32, number), F32::from_f32(number).to_bits());
        if !number.is_nan() {
            prop_assert_eq!(encode(NumberFormat::F32, number), number.to_bits());
            prop_assert_eq!(decode(NumberFormat::F32, number.to_bits()).to_bits(), number.to_bits());
        }
        let bits = encode(NumberFormat::F24, number);
        prop_assert_eq!(encode(NumberFormat::F24, decode(NumberFormat::F24, bits)), bits);
    }

    #[test]
    fn hit_points_pack_and_unpack(words: [u32; HIT_POINT_WORDS]) {
        for format in [NumberFormat::F32, NumberFormat::F24] {
            let packed = HitPoint::unpack(format, &words).pack(format);
            prop_assert_eq!(HitPoint::unpack(format, &packed).pack(format), packed);
            prop_assert_eq!((packed[14], packed[15]), (words[14], 0));
            for place in 0..14 {
                prop_assert_eq!(packed[place], encode(format, decode(format, words[place])));
            }
        }
    }
}

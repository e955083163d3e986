//! Does every photon reach the device once and in order, however it is pushed, and cheaply?

mod common;

use common::{SIZES, layout, model, photons, update_job};
use embedded_hal::delay::DelayNs;
use lucerna_driver::records::{PHOTON_NORMAL_WORDS, PHOTON_WORDS};
use lucerna_driver::{Deadline, Lucerna, NumberFormat, Photon, Sizes};
use proptest::prelude::*;

const PLENTY: Deadline = Deadline::seconds(10);

/// What the device should have taken.
fn words(photons: &[Photon], normal_test: bool) -> Vec<Vec<u32>> {
    let format = NumberFormat::F32;
    photons
        .iter()
        .map(
            |photon| {
                if normal_test { photon.pack_normal(format).to_vec() } else { photon.pack(format).to_vec() }
            },
        )
        .collect()
}

#[test]
fn full_gives_back_what_was_not_taken() {
    let model = model(|fake| fake.asleep = true);
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let layout = layout(SIZES);
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    let photons = photons(20);
    assert_eq!(stream.push(&photons), Ok(8));
    assert_eq!(stream.push(&photons[8..]), Ok(0));
    model.tamper(|fake| fake.asleep = false);
    model.advance(8 * 3);
    assert_eq!(stream.push(&photons[8..]), Ok(3));
    stream.push_all(&photons[11..], PLENTY).unwrap();
    stream.finish(PLENTY).unwrap();
    assert_eq!(model.inspect(|fake| fake.taken.clone()), words(&photons, false));
}

#[test]
fn the_head_is_read_rarely_and_the_device_kept_busy() {
    let sizes = Sizes { ring_entries: 1024, ..SIZES };
    let (model, layout) = (model(|_| {}), layout(sizes));
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    let start = model.elapsed();
    let photons = photons(50_000);
    for slice in photons.chunks(100) {
        stream.push_all(slice, PLENTY).unwrap();
    }
    stream.finish(PLENTY).unwrap();
    assert_eq!(model.inspect(|fake| fake.taken.len()), 50_000);
    // A quarter of the ring, 256 photons or 16 µs, is waited for with pauses of 1, 2, 4, 8 and 16 µs.
    let reads = model.inspect(|fake| fake.head_reads);
    assert!(reads < 50_000 / 256 * 6, "{reads} reads of the head");
    // Eight clocks a photon, plus the end of the last wait: nothing is lost to a dry ring.
    let clocks = model.elapsed() - start;
    assert!(clocks < 8 * 50_000 + 8 * 1024, "{clocks} clocks");
}

#[test]
fn a_ring_of_one_entry_works() {
    let layout = layout(Sizes { ring_entries: 1, ..SIZES });
    let model = model(|_| {});
    let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
    let mut pree = lucerna.pree().unwrap();
    let mut stream = pree.update(&update_job(&layout)).unwrap();
    stream.push_all(&photons(10), PLENTY).unwrap();
    stream.finish(PLENTY).unwrap();
    assert_eq!(model.inspect(|fake| fake.taken.clone()), words(&photons(10), false));
}

proptest! {
    #[test]
    fn any_way_of_pushing_delivers_every_photon_once_in_order(
        ring in 0u32..8,
        normal_test: bool,
        pace in 1u64..40,
        steps in prop::collection::vec((0usize..100, 0u32..2000, any::<bool>()), 1..12),
    ) {
        let layout = layout(Sizes { ring_entries: 1 << ring, normal_test, ..SIZES });
        let model = model(|fake| fake.pace = pace);
        let mut lucerna = Lucerna::probe(model.bus(), model.delay()).unwrap();
        let mut pree = lucerna.pree().unwrap();
        let mut stream = pree.update(&update_job(&layout)).unwrap();
        let all = photons(1200);
        let mut sent = 0;
        for (count, wait_ns, blocking) in steps {
            let slice = &all[sent..sent + count];
            sent += if blocking {
                stream.push_all(slice, PLENTY).unwrap();
                count
            } else {
                let accepted = stream.push(slice).unwrap();
                prop_assert!(accepted <= count && accepted <= 1 << ring);
                accepted
            };
            prop_assert_eq!(stream.pushed(), sent as u64);
            model.delay().delay_ns(wait_ns);
        }
        stream.finish(PLENTY).unwrap();
        let taken = model.inspect(|fake| fake.taken.clone());
        prop_assert_eq!(taken, words(&all[..sent], normal_test));
    }

    #[test]
    fn what_is_packed_is_unpacked(words: [u32; PHOTON_NORMAL_WORDS]) {
        // F24 keeps 24 bits; a NaN becomes the canonical one. So unpack and pack once, then it must be stable.
        for format in [NumberFormat::F32, NumberFormat::F24] {
            let photon = Photon::unpack_normal(format, &words);
            let packed = photon.pack_normal(format);
            prop_assert_eq!(Photon::unpack_normal(format, &packed).pack_normal(format), packed);
            prop_assert_eq!((packed[6], packed[7], packed[11]), (words[6], words[7], 0));
            let [short @ .., _, _, _, _] = packed;
            prop_assert_eq!(photon.pack(format), short);
            let _: [u32; PHOTON_WORDS] = short;
        }
    }
}

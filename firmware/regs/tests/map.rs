//! Is the map what the documents promise: places, reset values, no overlap? In: the tables. Cost: milliseconds.

use lucerna_regs::counters::{self, Counter, Half};
use lucerna_regs::{BLOCKS, REGISTERS, UNIT_DISPLACE, UNIT_PREE};
use lucerna_regs::{describe, displace, displace_counters, ident, interrupts, pree, window};

#[test]
fn registers_are_words_in_ascending_order() {
    for register in &REGISTERS {
        assert_eq!(register.offset % 4, 0, "{}", register.name);
    }
    for pair in REGISTERS.windows(2) {
        assert!(pair[0].offset + 4 <= pair[1].offset, "{} and {}", pair[0].name, pair[1].name);
    }
}

#[test]
fn every_register_lies_in_the_block_it_is_named_after() {
    for pair in BLOCKS.windows(2) {
        assert!(pair[0].base + pair[0].count * pair[0].stride <= pair[1].base);
    }
    for register in &REGISTERS {
        let block = BLOCKS
            .iter()
            .find(|b| (b.base..b.base + b.count * b.stride).contains(&register.offset))
            .unwrap_or_else(|| panic!("{} is in no block", register.name));
        let place = register.name.split('.').next().unwrap();
        assert_eq!(place.split('[').next().unwrap(), block.name, "{}", register.name);
    }
}

#[test]
fn fields_do_not_overlap_and_make_up_the_masks() {
    for register in &REGISTERS {
        let mut used = 0;
        for field in register.fields {
            assert_eq!(used & field.mask(), 0, "{}.{}", register.name, field.name);
            used |= field.mask();
        }
        assert_eq!(register.readable | register.writable, used, "{}", register.name);
        assert_eq!(register.reset & !used, 0, "{}", register.name);
        assert_eq!(register.pulses & register.readable, 0, "{}: a pulse reads as 0", register.name);
        assert_eq!(register.clears & !(register.readable & register.writable), 0, "{}", register.name);
    }
}

/// The places drivers in the field rely on; a change here is a new major version.
#[test]
fn offsets_are_those_of_version_1() {
    let blocks: Vec<_> = BLOCKS.iter().map(|b| (b.name, b.base, b.count, b.stride)).collect();
    assert_eq!(
        blocks,
        [
            ("ident", 0x000, 1, 0x14),
            ("interrupts", 0x040, 1, 0x08),
            ("window", 0x080, 4, 0x08),
            ("pree", 0x100, 1, 0x48),
            ("counters", 0x200, 1, 0x80),
            ("displace", 0x300, 1, 0xD0),
            ("displace_counters", 0x400, 1, 0x130),
        ]
    );
    let ident = [ident::ID, ident::VERSION, ident::CAPABILITIES, ident::PIPELINE, ident::MEMORY_BYTES];
    assert_eq!(ident, [0x00, 0x04, 0x08, 0x0C, 0x10]);
    assert_eq!([interrupts::STATUS, interrupts::ENABLE], [0x40, 0x44]);
    assert_eq!(
        [window::base(0), window::limit(0), window::base(3), window::limit(3)],
        [0x80, 0x84, 0x98, 0x9C]
    );
    let pree = [
        pree::CONTROL,
        pree::CONFIG,
        pree::STATUS,
        pree::ERROR,
        pree::FAULT_ADDRESS,
        pree::ALPHA,
        pree::EMITTED,
        pree::HIT_BASE,
        pree::HIT_COUNT,
        pree::INDEX_BASE,
        pree::INDEX_COUNT,
        pree::PIXEL_BASE,
        pree::PIXEL_COUNT,
        pree::RING_BASE,
        pree::RING_ENTRIES,
        pree::RING_HEAD,
        pree::RING_TAIL,
        pree::RING_LOW,
    ];
    assert!(pree.iter().copied().eq((0x100..).step_by(4).take(18)), "{pree:x?}");
    assert_eq!([counters::CONTROL, Counter::Photons.low(), Counter::Forwards.high()], [0x200, 0x208, 0x27C]);
}

/// What minor version 1 added.
#[test]
fn offsets_of_the_displacement_unit_are_those_of_version_1_1() {
    use displace_counters::Counter;
    let named = |first: &str, last: &str| {
        let place = |name: &str| REGISTERS.iter().position(|r| r.name == name).expect("a register");
        REGISTERS[place(first)..=place(last)].iter().map(|r| r.offset).collect::<Vec<_>>()
    };
    let upper = named("displace.CONTROL", "displace.BACKGROUND");
    assert!(upper.iter().copied().eq((0x300..=0x3B8).step_by(4)), "{upper:x?}");
    let lower = named("displace.PIPELINE", "displace.FIFOS");
    assert_eq!(lower, [0x3C0, 0x3C4, 0x3C8, 0x3CC]);
    for (offset, expected) in [
        (displace::CONFIG, 0x304),
        (displace::RAYS_DONE, 0x314),
        (displace::WATCHDOG, 0x318),
        (displace::MAP_BASE, 0x31C),
        (displace::NORMAL_SIZE, 0x330),
        (displace::RAY_BASE, 0x334),
        (displace::RASTER_SIZE, 0x33C),
        (displace::RESULT_BASE, 0x340),
        (displace::HEIGHT_SCALE, 0x344),
        (displace::TANGENT_X, 0x348),
        (displace::BITANGENT_X, 0x354),
        (displace::NORMAL_X, 0x360),
        (displace::EYE_U, 0x36C),
        (displace::EXTENT_U, 0x378),
        (displace::ORIGIN_X, 0x380),
        (displace::RIGHT_X, 0x38C),
        (displace::DOWN_X, 0x398),
        (displace::LIGHT_X, 0x3A4),
        (displace::AMBIENT, 0x3B0),
        (displace::DIFFUSE, 0x3B4),
        (displace_counters::CONTROL, 0x400),
        (Counter::Rays.low(), 0x408),
        (Counter::Cycles.low(), 0x468),
        (Counter::Folds.high(), 0x52C),
    ] {
        assert_eq!(offset, expected, "{}", describe(offset).expect("mapped").name);
    }
}

#[test]
fn reset_values_are_those_of_version_1() {
    for register in &REGISTERS {
        let expected = match register.name {
            "ident.ID" => u32::from_be_bytes(*b"LUCR"),
            "ident.VERSION" => 0x0001_0001,
            "ident.CAPABILITIES" => 0x0001_4000,
            "ident.PIPELINE" => 0x0000_0C0A,
            "pree.CONFIG" => 0x20,
            "displace.CONFIG" => 1 << 15 | 2 << 8 | 2 << 5 | 1 << 2,
            "displace.WATCHDOG" => 4096,
            "displace.PIPELINE" => 15 << 8,
            _ => 0,
        };
        assert_eq!(register.reset, expected, "{}", register.name);
    }
    assert_eq!(ident::ID_RESET, 0x4C55_4352);
    assert_eq!(displace::WATCHDOG_RESET, 4096);
    assert_eq!([UNIT_PREE, UNIT_DISPLACE], [1, 2]);
}

#[test]
fn access_is_as_documented() {
    let masks = |offset| {
        let register = describe(offset).expect("mapped");
        (register.readable, register.writable, register.pulses, register.clears)
    };
    assert_eq!(masks(pree::CONTROL), (0, 7, 7, 0));
    assert_eq!(masks(counters::CONTROL), (0, 3, 3, 0));
    assert_eq!(masks(interrupts::STATUS), (0x1F, 0x1F, 0, 0x1F));
    assert_eq!(masks(interrupts::ENABLE), (0x1F, 0x1F, 0, 0));
    assert_eq!(masks(pree::CONFIG), (0x3FF, 0x3FF, 0, 0));
    assert_eq!(masks(pree::STATUS), (0xF, 0, 0, 0));
    assert_eq!(masks(pree::RING_HEAD), (u32::MAX, 0, 0, 0));
    assert_eq!(masks(pree::RING_TAIL), (u32::MAX, u32::MAX, 0, 0));
    assert_eq!(masks(displace::CONTROL), (0, 3, 3, 0));
    assert_eq!(masks(displace_counters::CONTROL), (0, 3, 3, 0));
    assert_eq!(masks(displace::CONFIG), (0x1_FFFF, 0x1_FFFF, 0, 0), "bit 17 is reserved");
    assert_eq!(masks(displace::STATUS), (3, 0, 0, 0));
    assert_eq!(masks(displace::MAP_SIZE), (0xF0F, 0xF0F, 0, 0));
    assert_eq!(masks(displace::BACKGROUND), (0xFF_FFFF, 0xFF_FFFF, 0, 0));
    let writable: Vec<_> = REGISTERS.iter().filter(|r| r.writable != 0).map(|r| r.offset).collect();
    assert!(writable.iter().all(|&o| o >= 0x40 && !(pree::STATUS..=pree::FAULT_ADDRESS).contains(&o)));
    let read_only =
        [counters::CONTROL + 4..displace::CONTROL, displace::PIPELINE..displace_counters::CONTROL];
    assert!(writable.iter().all(|o| !read_only.iter().any(|range| range.contains(o))), "counts, sizes");
    assert!(
        writable.iter().all(|o| !(displace::STATUS..=displace::RAYS_DONE).contains(o)),
        "what a unit says is read-only"
    );
    assert_eq!(writable.last(), Some(&displace_counters::CONTROL), "counts are read-only");
}

#[test]
fn offsets_decode_to_the_names_in_the_table_and_no_others() {
    for offset in (0..0x600).chain([u32::MAX - 3, u32::MAX]) {
        let name = describe(offset).map(|r| r.name.to_owned());
        if let Some((index, part)) = window::at(offset) {
            let expected = match part {
                window::Part::Base => format!("window[{index}].BASE"),
                window::Part::Limit => format!("window[{index}].LIMIT"),
            };
            assert_eq!(name, Some(expected));
        } else if let Some((counter, half)) = Counter::at(offset) {
            let half = if half == Half::Low { "LO" } else { "HI" };
            assert_eq!(name, Some(format!("counters.{}.{half}", counter.name().to_uppercase())));
        } else if let Some((counter, half)) = displace_counters::Counter::at(offset) {
            let half = if half == Half::Low { "LO" } else { "HI" };
            assert_eq!(name, Some(format!("displace_counters.{}.{half}", counter.name().to_uppercase())));
        } else {
            let name = name.unwrap_or_default();
            assert!(
                !name.starts_with("window") && !name.ends_with(".LO") && !name.ends_with(".HI"),
                "{name}"
            );
        }
    }
}

#[test]
fn counters_are_in_the_order_of_the_map() {
    for (place, counter) in Counter::ALL.into_iter().enumerate() {
        assert_eq!(counter.index(), place);
        assert_eq!(Counter::at(counter.low()), Some((counter, Half::Low)));
        assert_eq!(Counter::at(counter.high()), Some((counter, Half::High)));
    }
    assert_eq!(displace_counters::Counter::COUNT, 37);
    for (place, counter) in displace_counters::Counter::ALL.into_iter().enumerate() {
        use displace_counters::Counter;
        assert_eq!(counter.index(), place);
        assert_eq!(Counter::at(counter.low()), Some((counter, Half::Low)));
        assert_eq!(Counter::at(counter.high()), Some((counter, Half::High)));
    }
    assert_eq!(Half::Low.of(0x1_2345_6789), 0x2345_6789);
    assert_eq!(Half::High.of(0x1_2345_6789), 1);
}

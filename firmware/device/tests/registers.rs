//! Does every register read back what its description says, and nothing else answer?

use lucerna_bus::{Target, TargetError};
use lucerna_device::{DisplaceDevice, FullDevice, PreeDevice};
use lucerna_displace::engine::{Geometry, PortSizes, Sizes};
use lucerna_regs::{BLOCKS, Description, REGISTERS, UNIT_DISPLACE, UNIT_PREE, displace, ident};
use lucerna_softfloat::{F24, F32};

type Small = PreeDevice<F32, 4, Vec<u32>>;

fn device() -> Small {
    PreeDevice::new(vec![0; 64])
}

/// Every combination of units, with the offsets that it leaves unmapped.
fn all() -> [(Box<dyn Target>, &'static [&'static str]); 3] {
    let memory = || vec![0; 64];
    let sizes = Sizes::default();
    [
        (Box::new(PreeDevice::<F32, 4, _>::new(memory())), &["displace", "displace_counters"]),
        (Box::new(DisplaceDevice::<F32, 1, 512, _>::new(sizes, memory()).unwrap()), &["pree", "counters"]),
        (Box::new(FullDevice::<F32, 4, 1, 512, _>::new(sizes, memory()).unwrap()), &[]),
    ]
}

/// The registers of the units that are there.
fn mapped(absent: &[&str]) -> Vec<&'static Description> {
    let block = |register: &Description| {
        let within = |block: &&lucerna_regs::Block| {
            (block.base..block.base + block.count * block.stride).contains(&register.offset)
        };
        BLOCKS.iter().find(within).expect("a block").name
    };
    REGISTERS.iter().filter(|register| !absent.contains(&block(register))).collect()
}

/// Offsets whose registers come from how the device was built, not from the description's reset value.
const BUILT: [u32; 7] = [
    ident::CAPABILITIES,
    ident::PIPELINE,
    ident::MEMORY_BYTES,
    displace::PIPELINE,
    displace::HEIGHT_CACHE,
    displace::TEXTURE_CACHE,
    displace::FIFOS,
];

#[test]
fn reset_values_are_the_descriptions() {
    for (mut device, absent) in all() {
        for register in mapped(absent) {
            let value =
                device.read(register.offset).unwrap_or_else(|error| panic!("{}: {error}", register.name));
            if !BUILT.contains(&register.offset) {
                assert_eq!(value, register.reset & register.readable, "{}", register.name);
            }
        }
    }
}

#[test]
fn identification_is_that_of_the_units_present() {
    let read = |device: &mut dyn Target| {
        let capabilities = ident::Capabilities::from_bits(device.read(ident::CAPABILITIES).unwrap());
        let pipeline = device.read(ident::PIPELINE).unwrap();
        (capabilities.units(), capabilities.preus(), capabilities.buffer_entries(), pipeline)
    };
    let [mut pree, mut displace, mut full] = all().map(|(device, _)| device);
    let pipeline = ident::Pipeline::RESET.with_operand_latency(8).bits();
    assert_eq!(read(&mut *pree), (UNIT_PREE, 4, 4, pipeline));
    assert_eq!(read(&mut *displace), (UNIT_DISPLACE, 0, 0, 0));
    assert_eq!(read(&mut *full), (UNIT_PREE | UNIT_DISPLACE, 4, 4, pipeline));
    let mut other = DisplaceDevice::<F24, 1, 512, _>::new(Sizes::default(), [0; 0]).unwrap();
    let capabilities = ident::Capabilities::from_bits(other.read(ident::CAPABILITIES).unwrap());
    assert_eq!(capabilities.format(), Ok(ident::NumberFormat::F24));
}

#[test]
fn what_was_synthesised_can_be_read() {
    let sizes = Sizes {
        units: 3,
        height_cache: Geometry { bytes: 8192, ways: 2, line_bytes: 64 },
        texture_cache: Geometry { bytes: 4096, ways: 1, line_bytes: 16 },
        fifo0: 8,
        fifo1: 32,
        port: PortSizes { latency: 300, bytes_per_cycle: 4 },
    };
    let mut device = DisplaceDevice::<F32, 4, 512, _>::new(sizes, [0; 64]).unwrap();
    let mut read = |offset| device.read(offset).unwrap();
    let pipeline = displace::Pipeline::from_bits(read(displace::PIPELINE));
    assert_eq!((pipeline.units(), pipeline.stages(), pipeline.fill_latency()), (3, 15, 300));
    let cache = displace::HeightCache::from_bits(read(displace::HEIGHT_CACHE));
    assert_eq!((cache.log2_bytes(), cache.ways(), cache.line_bytes()), (13, 2, 64));
    let cache = displace::TextureCache::from_bits(read(displace::TEXTURE_CACHE));
    assert_eq!((cache.log2_bytes(), cache.ways(), cache.line_bytes()), (12, 1, 16));
    let fifos = displace::Fifos::from_bits(read(displace::FIFOS));
    assert_eq!((fifos.fifo0(), fifos.fifo1(), fifos.port_bytes()), (8, 32, 4));
}

/// A driver bounds its waits by these registers, so what they cannot say is not built.
#[test]
fn sizes_that_no_register_can_say_are_refused() {
    let usual = Sizes::default();
    let cache = |bytes, ways, line_bytes| Geometry { bytes, ways, line_bytes };
    for sizes in [
        Sizes { units: 0, ..usual },
        Sizes { units: 5, ..usual },
        Sizes { height_cache: cache(12_000, 4, 32), ..usual },
        Sizes { height_cache: cache(16_384, 256, 32), ..usual },
        Sizes { texture_cache: cache(0, 4, 32), ..usual },
        Sizes { fifo0: 256, ..usual },
        Sizes { fifo1: 1 << 20, ..usual },
        Sizes { port: PortSizes { latency: 65_536, ..usual.port }, ..usual },
        Sizes { port: PortSizes { bytes_per_cycle: 256, ..usual.port }, ..usual },
    ] {
        assert!(DisplaceDevice::<F32, 4, 512, _>::new(sizes, [0; 64]).is_err(), "{sizes:?}");
        assert!(FullDevice::<F32, 4, 4, 512, _>::new(sizes, [0; 64]).is_err(), "{sizes:?}");
    }
}

/// Bits that may be written are kept, the others are not; pulses and bits that clear leave nothing behind.
#[test]
fn what_is_written_is_read_as_far_as_the_description_goes() {
    let number = all().len();
    for (which, value) in
        (0..number).flat_map(|which| [u32::MAX, 0x5555_5555, 0xaaaa_aaaa, 0].map(|v| (which, v)))
    {
        for register in mapped(all()[which].1) {
            let mut device = all().into_iter().nth(which).expect("a device").0;
            let before = device.read(register.offset).unwrap();
            device.write(register.offset, value).unwrap();
            let after = device.read(register.offset).unwrap();
            let kept = register.writable & !register.pulses & !register.clears;
            let stays = !kept & register.readable;
            assert_eq!(after & stays, before & stays, "{}", register.name);
            assert_eq!(after & kept, value & kept & register.readable, "{}", register.name);
            assert_eq!(after & !register.readable, 0, "{}", register.name);
        }
    }
}

/// Every register keeps a word of its own: none is another's shadow.
#[test]
fn registers_do_not_share_their_bits() {
    for (mut device, absent) in all() {
        let kept = |register: &&Description| {
            (register.writable & !register.pulses & !register.clears & register.readable) != 0
        };
        let registers: Vec<_> = mapped(absent).into_iter().filter(kept).collect();
        let value = |register: &Description| register.offset.wrapping_mul(0x9E37_79B9) & register.writable;
        for register in &registers {
            device.write(register.offset, value(register)).unwrap();
        }
        for register in &registers {
            assert_eq!(device.read(register.offset), Ok(value(register)), "{}", register.name);
        }
    }
}

#[test]
fn only_described_offsets_answer() {
    for (mut device, absent) in all() {
        let offsets: Vec<_> = mapped(absent).iter().map(|register| register.offset).collect();
        for offset in (0..0x1000).chain([u32::MAX, u32::MAX - 3, 0x8000_0000]) {
            let expected = match offset % 4 {
                0 if offsets.contains(&offset) => None,
                0 => Some(TargetError::Unmapped),
                _ => Some(TargetError::Misaligned),
            };
            assert_eq!(device.read(offset).err(), expected, "{offset:#x}");
            assert_eq!(device.write(offset, 0).err(), expected, "{offset:#x}");
        }
    }
}

#[test]
fn memory_is_checked_to_the_word() {
    let mut device = device();
    assert_eq!(device.store(252, &[7]), Ok(()));
    assert_eq!(device.store(252, &[7, 8]), Err(TargetError::OutOfRange));
    assert_eq!(device.store(256, &[]), Ok(()), "nothing, at the end");
    assert_eq!(device.store(260, &[]), Err(TargetError::OutOfRange));
    assert_eq!(device.store(2, &[7]), Err(TargetError::Misaligned));
    assert_eq!(device.load(u32::MAX - 3, &mut [0]), Err(TargetError::OutOfRange));
    let mut word = [0];
    assert_eq!((device.load(252, &mut word), word), (Ok(()), [7]));
    assert_eq!(device.memory()[62], 0, "a refused block writes none of its words");
}

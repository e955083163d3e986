//! Does every register read back what its description says, and nothing else answer?

use lucerna_bus::{Target, TargetError};
use lucerna_device::Device;
use lucerna_regs::counters::Counter;
use lucerna_regs::pree::{self, Config, Control, Mode, State, Status};
use lucerna_regs::{REGISTERS, counters, describe, ident, interrupts, window};
use lucerna_softfloat::F32;

type Small = Device<F32, 4, Vec<u32>>;

fn device() -> Small {
    Device::new(vec![0; 64])
}

fn state(device: &mut Small) -> State {
    Status::from_bits(device.read(pree::STATUS).unwrap()).state().unwrap()
}

/// Offsets whose registers come from how the device was built, not from the description's reset value.
const BUILT: [u32; 3] = [ident::CAPABILITIES, ident::PIPELINE, ident::MEMORY_BYTES];

#[test]
fn reset_values_are_the_descriptions() {
    let mut device = device();
    for register in &REGISTERS {
        let value = device.read(register.offset).unwrap_or_else(|error| panic!("{}: {error}", register.name));
        if !BUILT.contains(&register.offset) {
            assert_eq!(value, register.reset & register.readable, "{}", register.name);
        }
    }
}

/// Bits that may be written are kept, the others are not; pulses and bits that clear leave nothing behind.
#[test]
fn what_is_written_is_read_as_far_as_the_description_goes() {
    for register in &REGISTERS {
        for value in [u32::MAX, 0x5555_5555, 0xaaaa_aaaa, 0] {
            let mut device = device();
            let before = device.read(register.offset).unwrap();
            device.write(register.offset, value).unwrap();
            let after = device.read(register.offset).unwrap();
            let kept = register.writable & !register.pulses & !register.clears;
            assert_eq!(
                after & !kept & register.readable,
                before & !kept & register.readable,
                "{}",
                register.name
            );
            assert_eq!(
                after & kept & register.readable,
                value & kept & register.readable,
                "{}",
                register.name
            );
        }
    }
}

#[test]
fn only_described_offsets_answer() {
    let mut device = device();
    for offset in (0..0x1000).chain([u32::MAX, u32::MAX - 3, 0x8000_0000]) {
        let mapped = describe(offset).is_some() || Counter::at(offset).is_some();
        let (read, write) = (device.read(offset), device.write(offset, 0));
        match (offset % 4, mapped) {
            (0, true) => assert!(read.is_ok() && write.is_ok(), "{offset:#x}"),
            (0, false) => assert_eq!(
                (read, write),
                (Err(TargetError::Unmapped), Err(TargetError::Unmapped)),
                "{offset:#x}"
            ),
            _ => assert_eq!(
                (read, write),
                (Err(TargetError::Misaligned), Err(TargetError::Misaligned)),
                "{offset:#x}"
            ),
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

/// An evaluation of one hit point, by hand.
fn one_hit_point(device: &mut Small) {
    for (offset, value) in [
        (window::limit(0), 256),
        (pree::HIT_COUNT, 1),
        (pree::PIXEL_BASE, 64),
        (pree::PIXEL_COUNT, 1),
        (pree::EMITTED, 1f32.to_bits()),
        (pree::CONFIG, Config::RESET.with_mode(Mode::Evaluate).bits()),
    ] {
        device.write(offset, value).unwrap();
    }
    device.store(36, &[3f32.to_bits(), 0, 0, 1f32.to_bits()]).unwrap();
    device.write(pree::CONTROL, Control::default().with_start(true).bits()).unwrap();
}

fn snapshot(device: &mut Small, control: counters::Control, counter: Counter) -> u32 {
    device.write(counters::CONTROL, control.bits()).unwrap();
    device.read(counter.low()).unwrap()
}

/// The counters are read from one moment: they stay until the next snapshot, also over a clear.
#[test]
fn a_snapshot_stands_still() {
    let mut device = device();
    one_hit_point(&mut device);
    device.advance(3);
    let take = counters::Control::default().with_snapshot(true);
    assert_eq!(snapshot(&mut device, take, Counter::TotalCycles), 3);
    device.advance(5);
    assert_eq!(device.read(Counter::TotalCycles.low()), Ok(3));
    assert_eq!(snapshot(&mut device, take.with_clear(true), Counter::TotalCycles), 8, "taken, then cleared");
    device.advance(100);
    assert_eq!(snapshot(&mut device, take, Counter::TotalCycles), 9, "17 in all");
    assert_eq!(state(&mut device), State::Idle);
    assert_eq!(f32::from_bits(device.memory()[16]), 3.0 * core::f32::consts::FRAC_1_PI);
}

/// ABORT, then START, then FLUSH, when one write has them all.
#[test]
fn control_bits_together_have_an_order() {
    let mut device = device();
    one_hit_point(&mut device);
    device.advance(3);
    let again = Control::default().with_abort(true).with_start(true);
    device.write(pree::CONTROL, again.bits()).unwrap();
    assert_eq!(state(&mut device), State::Running);
    assert_eq!(device.read(pree::ERROR), Ok(0), "the first one was aborted before");
    device.advance(16);
    assert_eq!(state(&mut device), State::Running, "from the beginning");
    device.advance(1);
    assert_eq!(state(&mut device), State::Idle);

    let config = Config::RESET.with_mode(Mode::Update);
    device.write(pree::CONFIG, config.bits()).unwrap();
    device.write(pree::RING_ENTRIES, 1).unwrap();
    let nothing = Control::default().with_start(true).with_flush(true);
    device.write(pree::CONTROL, nothing.bits()).unwrap();
    assert!(Status::from_bits(device.read(pree::STATUS).unwrap()).flushing());
    device.advance(5);
    assert_eq!(state(&mut device), State::Idle, "flushed with the start");
}

#[test]
fn what_an_abort_drops_never_arrives() {
    for cycles in 0..17 {
        let mut device = device();
        one_hit_point(&mut device);
        device.advance(cycles);
        device.write(pree::CONTROL, Control::default().with_abort(true).bits()).unwrap();
        assert_eq!(state(&mut device), State::Idle);
        device.advance(100);
        assert_eq!(device.memory()[16], 0, "aborted after {cycles}");
        assert_eq!(device.read(interrupts::STATUS), Ok(0));
    }
}

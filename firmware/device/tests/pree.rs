//! Do CONTROL, counters and ABORT of the PREE do what their descriptions say?

use lucerna_bus::Target;
use lucerna_device::PreeDevice;
use lucerna_regs::counters::Counter;
use lucerna_regs::pree::{self, Config, Control, Mode, State, Status};
use lucerna_regs::{counters, interrupts, window};
use lucerna_softfloat::F32;

type Small = PreeDevice<F32, 4, Vec<u32>>;

fn device() -> Small {
    PreeDevice::new(vec![0; 64])
}

fn state(device: &mut Small) -> State {
    Status::from_bits(device.read(pree::STATUS).unwrap()).state().unwrap()
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

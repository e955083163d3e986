//! Does nonsense at a device with two units ever do more than give error codes, and do ticks and `advance` ever differ?

mod common;

use common::*;
use lucerna_bus::Target;
use lucerna_regs::{REGISTERS, counters, displace as regs, displace_counters, pree, window};
use proptest::prelude::*;

/// What software may do.
#[derive(Clone, Debug)]
enum Act {
    Write(u32, u32),
    Read(u32),
    Store(u32, u32),
    Wait(u64),
    Start(bool),
    Pree(u32),
}

/// Registers whose words decide whether a job begins: changed seldom, or none would.
fn value(offset: u32) -> BoxedStrategy<u32> {
    let address = || (OPEN.start / 64..OPEN.end / 64).prop_map(|line| line * 64);
    let number = prop_oneof![(-2f32..2f32).prop_map(f32::to_bits), any::<u32>()];
    match offset {
        regs::CONFIG => prop_oneof![
            (any::<u32>(), 1u32..5, 0u32..4, 0u32..3, 1u32..4).prop_map(
                |(word, down, up, coherent, reach)| {
                    let word = regs::Config::LEVELS_DOWN.put(word, down);
                    let word = regs::Config::ASCEND.put(word, up);
                    regs::Config::REACH.put(regs::Config::COHERENT.put(word, coherent), reach)
                }
            ),
            any::<u32>(),
        ]
        .boxed(),
        regs::MAP_BASE | regs::TEXTURE_BASE | regs::NORMAL_BASE | regs::RAY_BASE | regs::RESULT_BASE => {
            prop_oneof![4 => address(), 1 => any::<u32>()].boxed()
        }
        regs::MAP_SIZE | regs::TEXTURE_SIZE | regs::NORMAL_SIZE => {
            prop_oneof![4 => (0u32..6, 0u32..6).prop_map(|(w, h)| w | h << 8), 1 => any::<u32>()].boxed()
        }
        regs::RAY_COUNT | pree::HIT_COUNT | pree::INDEX_COUNT | pree::PIXEL_COUNT => {
            prop_oneof![4 => 0u32..40, 1 => any::<u32>()].boxed()
        }
        regs::RASTER_SIZE => (0u32..8, 0u32..8).prop_map(|(w, h)| w | h << 16).boxed(),
        regs::WATCHDOG => prop_oneof![Just(4096), 1u32..50, any::<u32>()].boxed(),
        regs::HEIGHT_SCALE..=regs::DIFFUSE => number.boxed(),
        pree::HIT_BASE | pree::INDEX_BASE | pree::PIXEL_BASE | pree::RING_BASE => address().boxed(),
        pree::RING_ENTRIES => (0u32..6).prop_map(|log2| 1 << log2).boxed(),
        pree::RING_TAIL | pree::RING_LOW => (0u32..20).boxed(),
        _ => any::<u32>().boxed(),
    }
}

/// Windows stay as they are: what lies outside them is looked at in the end.
fn offset() -> impl Strategy<Value = u32> {
    let mapped = (0..REGISTERS.len()).prop_map(|place| REGISTERS[place].offset);
    let any_offset = prop_oneof![4 => mapped, 1 => 0u32..0x600, 1 => any::<u32>()];
    any_offset.prop_filter("a window", |offset| window::at(*offset).is_none())
}

fn act() -> impl Strategy<Value = Act> {
    prop_oneof![
        6 => offset().prop_flat_map(|offset| value(offset).prop_map(move |value| Act::Write(offset, value))),
        2 => offset().prop_map(Act::Read),
        2 => (OPEN.start / 4..OPEN.end / 4, prop_oneof![0u32..24, any::<u32>()])
            .prop_map(|(word, value)| Act::Store(word * 4, value)),
        4 => (0u64..300).prop_map(Act::Wait),
        3 => any::<bool>().prop_map(Act::Start),
        2 => (0u32..8).prop_map(Act::Pree),
    ]
}

/// The registers in which two devices differ, counters of now included.
fn differences(one: &mut Both, other: &mut Both) -> Vec<(&'static str, u32, u32)> {
    let snapshot = counters::Control::default().with_snapshot(true).bits();
    for device in [&mut *one, &mut *other] {
        write(device, counters::CONTROL, snapshot);
        write(device, displace_counters::CONTROL, snapshot);
    }
    let words = REGISTERS.iter().map(|r| (r.name, read(one, r.offset), read(other, r.offset)));
    words.filter(|(_, one, other)| one != other).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn anything_goes(acts in prop::collection::vec(act(), 1..80)) {
        let mut fast = ready(2);
        // A second, narrow window, and pages of nobody around them.
        write(&mut fast, window::base(2), OPEN.start + 64);
        write(&mut fast, window::limit(2), OPEN.start + 256);
        let outside: Vec<u32> = (0..WORDS as u32).filter(|word| !OPEN.contains(&(word * 4))).collect();
        for word in &outside {
            fast.store(word * 4, &[!word]).unwrap();
        }
        let mut slow = fast.clone();
        for act in acts {
            match act {
                Act::Write(offset, value) => prop_assert_eq!(fast.write(offset, value), slow.write(offset, value)),
                Act::Read(offset) => {
                    let answer = fast.read(offset);
                    prop_assert_eq!(answer, slow.read(offset));
                    prop_assert_eq!(answer, fast.read(offset), "a read changes nothing");
                }
                Act::Store(address, value) => {
                    fast.store(address, &[value]).unwrap();
                    slow.store(address, &[value]).unwrap();
                }
                Act::Wait(cycles) => {
                    fast.advance(cycles);
                    (0..cycles).for_each(|_| slow.tick());
                }
                Act::Start(abort) => {
                    let control = regs::Control::default().with_start(true).with_abort(abort).bits();
                    write(&mut fast, regs::CONTROL, control);
                    write(&mut slow, regs::CONTROL, control);
                    // A job that was refused says so.
                    if state(&mut fast) == regs::State::Fault {
                        prop_assert_ne!(error(&mut fast).0, regs::ErrorCode::None);
                        prop_assert!(raised(&mut fast).displace_error());
                    }
                }
                Act::Pree(control) => {
                    write(&mut fast, pree::CONTROL, control);
                    write(&mut slow, pree::CONTROL, control);
                }
            }
            prop_assert_eq!(fast.interrupt(), slow.interrupt());
        }
        prop_assert_eq!(differences(&mut fast, &mut slow), []);
        prop_assert!(fast.memory() == slow.memory());
        for word in outside {
            prop_assert_eq!(fast.memory()[word as usize], !word, "word {:#x} is outside all windows", word * 4);
        }
        // Aborted, both are idle at once and write nothing more.
        abort(&mut fast);
        write(&mut fast, pree::CONTROL, pree::Control::default().with_abort(true).bits());
        prop_assert_eq!((state(&mut fast), error(&mut fast)), (regs::State::Idle, (regs::ErrorCode::None, 0)));
        let before = fast.memory().to_vec();
        fast.advance(1 << 40);
        prop_assert!(fast.memory() == before);
    }
}

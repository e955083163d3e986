//! Does a trace say what was done, and does its replay do the same again, to the clock?

use std::cell::RefCell;
use std::fmt::Write;

use embedded_hal::delay::DelayNs;
use lucerna_bus::{
    Access, Bus, Fault, Faulty, Malformed, Model, ReplayError, ReplayErrorKind, Scripted, SharedSink, Target,
    TargetError, Traced, TracedDelay, replay, replay_timed,
};
use proptest::prelude::*;

/// Four registers, the first of which counts clocks, and 2,048 words of memory.
#[derive(Clone, Debug, PartialEq)]
struct Device {
    registers: [u32; 4],
    memory: Vec<u32>,
}

impl Default for Device {
    fn default() -> Self {
        Self { registers: [0; 4], memory: vec![0; 2048] }
    }
}

impl Device {
    fn place(address: u32, count: usize, size: usize) -> Result<std::ops::Range<usize>, TargetError> {
        let first = address as usize / 4;
        if !address.is_multiple_of(4) {
            Err(TargetError::Misaligned)
        } else if first + count > size {
            Err(TargetError::OutOfRange)
        } else {
            Ok(first..first + count)
        }
    }
}

impl Target for Device {
    fn read(&mut self, offset: u32) -> Result<u32, TargetError> {
        Self::place(offset, 1, 4).map(|place| self.registers[place.start])
    }
    fn write(&mut self, offset: u32, value: u32) -> Result<(), TargetError> {
        Self::place(offset, 1, 4).map(|place| self.registers[place.start] = value)
    }
    fn load(&self, address: u32, words: &mut [u32]) -> Result<(), TargetError> {
        Self::place(address, words.len(), 2048).map(|place| words.copy_from_slice(&self.memory[place]))
    }
    fn store(&mut self, address: u32, words: &[u32]) -> Result<(), TargetError> {
        Self::place(address, words.len(), 2048).map(|place| self.memory[place].copy_from_slice(words))
    }
    fn tick(&mut self) {
        self.registers[0] = self.registers[0].wrapping_add(1);
    }
    fn interrupt(&self) -> bool {
        false
    }
}

#[test]
fn one_line_an_access() {
    let model = Model::new(Device::default());
    let mut bus = Traced::new(Faulty::new(model.bus(), Fault::From(4)), String::new());
    bus.write(8, 0xABC).unwrap();
    bus.read(8).unwrap();
    bus.write_block(0x10, &[1, 0xFFFF_FFFF]).unwrap();
    bus.read_block(0x14, &mut [0; 2]).unwrap();
    bus.read(8).unwrap_err();
    bus.write(8, 1).unwrap_err();
    bus.write_block(0x10, &[2, 3]).unwrap_err();
    bus.read_block(0x14, &mut [0; 17]).unwrap_err();
    assert_eq!(bus.lost(), 0);
    let (_, text) = bus.into_parts();
    let expected = "w 8 abc\nr 8 abc\nW 10 1 ffffffff\nR 14 ffffffff 0\n\
                    r 8 !\nw 8 1 !\nW 10 2 3 !\nR 14 11 !\n";
    assert_eq!(text, expected);
}

#[test]
fn a_replay_makes_the_same_accesses() {
    let text = "# a remark!\n\nw 8 abc\n  r 8 ABC \r\nW 10 1 2\nR 10 1 2\nR 10\nr 4 !\nw 4 1 !\nd 50\n";
    let script = [
        Access::Write(8, 0xABC),
        Access::Read(8, 0xABC),
        Access::WriteBlock(0x10, &[1, 2]),
        Access::ReadBlock(0x10, &[1, 2]),
        Access::ReadBlock(0x10, &[]),
        Access::FailRead(4),
        Access::FailWrite(4, 1),
    ];
    let mut bus = Scripted::new(&script);
    let done = replay(text, &mut bus).unwrap();
    bus.finish().unwrap();
    assert_eq!((done.accesses, done.delay_ns), (7, 50));
}

#[test]
fn a_long_block_is_replayed_in_pieces_and_a_failed_one_fails_once() {
    let words = (0..1500).map(|word| format!(" {word:x}")).collect::<String>();
    let model = Model::new(Device::default());
    let mut bus = Faulty::new(model.bus(), Fault::Nth(0));
    let text = format!("W 0{words} !\nW 40{words}\nR 40{words}\n");
    assert_eq!(replay(&text, &mut bus).unwrap().accesses, 3);
    assert_eq!(bus.accesses(), 1 + 2 + 2);
    let expected: Vec<u32> = (0..1500).collect();
    assert_eq!(model.inspect(|device| device.memory[16..1516].to_vec()), expected);
}

#[test]
fn a_replay_tells_the_line_that_differs() {
    let model = Model::new(Device::default()).with_access_cycles(0);
    let mut bus = model.bus();
    let error = |line, kind| Err(ReplayError { line, kind });
    assert_eq!(
        replay("w 8 1\nr 8 2", &mut bus),
        error(2, ReplayErrorKind::Differs { address: 8, traced: 2, now: 1 })
    );
    assert_eq!(
        replay("W 10 1 2 3\nR 10 1 2 4", &mut bus),
        error(2, ReplayErrorKind::Differs { address: 0x18, traced: 4, now: 3 })
    );
    assert_eq!(replay("r 8 1 \nr 8 !", &mut bus), error(2, ReplayErrorKind::Succeeds));
    assert_eq!(replay("r 2 0", &mut bus), error(1, ReplayErrorKind::Bus(TargetError::Misaligned)));
    assert_eq!(
        replay("r 8 2", &mut bus).unwrap_err().to_string(),
        "line 1: 0x8 reads 0x1, but 0x2 in the trace"
    );
}

#[test]
fn malformed_lines_are_named_and_touch_nothing() {
    let cases = [
        ("x 1 2", Malformed::Kind),
        ("write 1 2", Malformed::Kind),
        ("!", Malformed::Kind),
        ("d 1 !", Malformed::Kind),
        ("r", Malformed::Short),
        ("w 8", Malformed::Short),
        ("r 8", Malformed::Short),
        ("W", Malformed::Short),
        ("R 10 !", Malformed::Short),
        ("r 8 1 2", Malformed::Long),
        ("r 8 1 !", Malformed::Long),
        ("d 1 2", Malformed::Long),
        ("w 8 zz", Malformed::Number),
        ("w 8 +1", Malformed::Number),
        ("w -8 1", Malformed::Number),
        ("d 1f", Malformed::Number),
        ("W 10 1 2 3 nonsense", Malformed::Number),
        ("w 8 100000000", Malformed::TooLarge),
        ("w ! 8", Malformed::Number),
    ];
    for (line, why) in cases {
        let text = format!("# first\n{line}\nw 8 1\n");
        let mut bus = Scripted::new(&[]);
        let error = ReplayError { line: 2, kind: ReplayErrorKind::Malformed(why) };
        assert_eq!(replay(&text, &mut bus), Err(error), "{line}");
        bus.finish().unwrap();
    }
}

#[test]
fn a_sink_that_fails_loses_lines_not_accesses() {
    struct Full(usize);
    impl Write for Full {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            self.0 = self.0.checked_sub(text.len()).ok_or(std::fmt::Error)?;
            Ok(())
        }
    }
    let model = Model::new(Device::default());
    let mut bus = Traced::new(model.bus(), Full(10));
    for _ in 0..5 {
        bus.write(8, 1).unwrap();
    }
    assert_eq!(bus.lost(), 4);
}

#[derive(Clone, Debug)]
enum Step {
    Read(u32),
    Write(u32, u32),
    ReadBlock(u32, usize),
    WriteBlock(u32, Vec<u32>),
    Delay(u32),
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    // Places outside the device and misaligned ones too: failures are replayed as failures.
    let step = prop_oneof![
        (0u32..20).prop_map(Step::Read),
        (0u32..20, any::<u32>()).prop_map(|(offset, value)| Step::Write(offset, value)),
        (0u32..9000, 0usize..1024).prop_map(|(address, words)| Step::ReadBlock(address & !1, words)),
        (0u32..9000, prop::collection::vec(any::<u32>(), 0..1024))
            .prop_map(|(address, words)| Step::WriteBlock(address & !3, words)),
        (0u32..100_000).prop_map(Step::Delay),
    ];
    prop::collection::vec(step, 0..30)
}

proptest! {
    #[test]
    fn a_replayed_trace_leaves_the_same_device(steps in steps()) {
        let model = Model::new(Device::default());
        let text = RefCell::new(String::new());
        let mut bus = Traced::new(model.bus(), SharedSink::new(&text));
        let mut delay = TracedDelay::new(model.delay(), SharedSink::new(&text));
        for step in &steps {
            // An error is part of the trace.
            let _ = match step {
                Step::Read(offset) => bus.read(*offset).map(drop),
                Step::Write(offset, value) => bus.write(*offset, *value),
                Step::ReadBlock(address, words) => bus.read_block(*address, &mut vec![0; *words]),
                Step::WriteBlock(address, words) => bus.write_block(*address, words),
                Step::Delay(ns) => { delay.delay_ns(*ns); Ok(()) }
            };
        }
        prop_assert_eq!(bus.lost(), 0);
        let again = Model::new(Device::default());
        replay_timed(&text.borrow(), &mut again.bus(), &mut again.delay()).unwrap();
        prop_assert_eq!(again.elapsed(), model.elapsed());
        prop_assert_eq!(again.into_inner(), model.into_inner());
    }

    #[test]
    fn any_text_is_replayed_or_refused(text in "[rwRWd#! 0-9a-f\n]{0,200}") {
        let model = Model::new(Device::default());
        let lines = text.lines().count();
        if let Err(error) = replay(&text, &mut model.bus()) {
            prop_assert!((1..=lines).contains(&error.line));
        }
    }
}

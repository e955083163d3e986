//! Does every field give back what was put in, leave its neighbours alone, and take nonsense calmly? In: any word.

use lucerna_regs::ident::{Capabilities, NumberFormat, Pipeline, Version};
use lucerna_regs::pree::{
    Allocation, Busy, Config, Control, Error, ErrorCode, Hazard, InputWidth, Mode, Scheduler,
};
use lucerna_regs::pree::{State, Status};
use lucerna_regs::{Illegal, REGISTERS, Register, counters, describe, interrupts};
use proptest::prelude::*;

/// A word after `with_x`: x reads back, and no bit outside its field has changed.
macro_rules! round_trip {
    ($word:expr, $register:ty, $field:ident, $setter:ident, $getter:ident, $value:expr, $read:expr) => {{
        let before = <$register>::from_bits($word);
        let after = before.$setter($value);
        prop_assert_eq!(after.$getter(), $read, "{}", stringify!($register::$field));
        prop_assert_eq!((before.bits() ^ after.bits()) & !<$register>::$field.mask(), 0);
    }};
}
/// Number fields: wider values are cut to the field.
macro_rules! number {
    ($word:expr, $value:expr, $register:ty, $($field:ident $setter:ident $getter:ident),+) => {$(
        round_trip!($word, $register, $field, $setter, $getter, $value, $value & (u32::MAX >> (32 - <$register>::$field.width)));
    )+};
}
macro_rules! flag {
    ($word:expr, $value:expr, $register:ty, $($field:ident $setter:ident $getter:ident),+) => {$(
        round_trip!($word, $register, $field, $setter, $getter, $value & 1 == 1, $value & 1 == 1);
    )+};
}
/// Encoded fields of which every bit pattern is legal read as the enum; the others as a `Result`.
macro_rules! total {
    ($word:expr, $register:ty, $($field:ident $setter:ident $getter:ident $encoding:ident),+) => {$(
        for value in $encoding::ALL { round_trip!($word, $register, $field, $setter, $getter, value, value); }
    )+};
}
macro_rules! partial {
    ($word:expr, $register:ty, $($field:ident $setter:ident $getter:ident $encoding:ident),+) => {$(
        for value in $encoding::ALL { round_trip!($word, $register, $field, $setter, $getter, value, Ok(value)); }
        let raw = <$register>::$field.get($word);
        prop_assert_eq!(<$register>::from_bits($word).$getter(), $encoding::from_bits(raw));
    )+};
}

proptest! {
    #[test]
    fn every_typed_field_round_trips(word: u32, value: u32) {
        number!(word, value, Version, MAJOR with_major major, MINOR with_minor minor);
        number!(word, value, Capabilities, PREUS with_preus preus, BUFFER_ENTRIES with_buffer_entries buffer_entries,
            UNITS with_units units);
        partial!(word, Capabilities, FORMAT with_format format NumberFormat);
        number!(word, value, Pipeline, UPDATE_STAGES with_update_stages update_stages,
            EVALUATE_STAGES with_evaluate_stages evaluate_stages, OPERAND_LATENCY with_operand_latency operand_latency);
        flag!(word, value, interrupts::Status, DONE with_done done, ERROR with_error error,
            RING_SPACE with_ring_space ring_space);
        flag!(word, value, interrupts::Enable, DONE with_done done, ERROR with_error error,
            RING_SPACE with_ring_space ring_space);
        flag!(word, value, Control, START with_start start, FLUSH with_flush flush, ABORT with_abort abort);
        flag!(word, value, Config, NORMAL_TEST with_normal_test normal_test);
        total!(word, Config, MODE with_mode mode Mode, BUSY with_busy busy Busy,
            SCHEDULER with_scheduler scheduler Scheduler, ALLOCATION with_allocation allocation Allocation);
        partial!(word, Config, HAZARD with_hazard hazard Hazard, INPUT_WIDTH with_input_width input_width InputWidth);
        flag!(word, value, Status, STARVED with_starved starved, FLUSHING with_flushing flushing);
        partial!(word, Status, STATE with_state state State);
        partial!(word, Error, CODE with_code code ErrorCode);
        flag!(word, value, counters::Control, SNAPSHOT with_snapshot snapshot, CLEAR with_clear clear);
    }

    #[test]
    fn every_field_of_the_table_round_trips(word: u32, value: u32) {
        for register in &REGISTERS {
            for field in register.fields {
                let after = field.put(word, value);
                prop_assert_eq!(field.get(after), value & (u32::MAX >> (32 - field.width)));
                prop_assert_eq!((after ^ word) & !field.mask(), 0);
            }
        }
    }

    #[test]
    fn any_word_can_be_held_and_printed(word: u32) {
        let config = Config::from_bits(word);
        prop_assert_eq!(config.bits(), word);
        let text = format!("{config:?}");
        prop_assert!(text.contains("hazard"), "{}", text);
    }
}

/// The table and the types are written by different lines of the generator.
#[test]
fn types_agree_with_the_table() {
    fn check<R: Register>(typed: &mut Vec<u32>) {
        let register = describe(R::OFFSET).expect("mapped");
        assert_eq!((register.name, register.reset), (R::NAME, R::RESET));
        assert_eq!((register.readable, register.writable), (R::READABLE, R::WRITABLE));
        assert_eq!(R::default().bits(), R::RESET);
        typed.push(R::OFFSET);
    }
    let mut typed = Vec::new();
    check::<Version>(&mut typed);
    check::<Capabilities>(&mut typed);
    check::<Pipeline>(&mut typed);
    check::<interrupts::Status>(&mut typed);
    check::<interrupts::Enable>(&mut typed);
    check::<Control>(&mut typed);
    check::<Config>(&mut typed);
    check::<Status>(&mut typed);
    check::<Error>(&mut typed);
    check::<counters::Control>(&mut typed);
    let with_fields: Vec<_> =
        REGISTERS.iter().filter(|r| r.fields[0].width != 32).map(|register| register.offset).collect();
    assert_eq!(typed, with_fields, "a register with fields is not tested here");
}

#[test]
fn encodings_are_those_of_version_1() {
    let codes = ErrorCode::ALL.map(|code| (code.bits(), code));
    let expected = [
        (0, ErrorCode::None),
        (1, ErrorCode::BadConfig),
        (2, ErrorCode::BadRing),
        (3, ErrorCode::Window),
        (4, ErrorCode::RingOverrun),
        (5, ErrorCode::IndexRange),
        (6, ErrorCode::HitRange),
        (7, ErrorCode::PixelRange),
        (8, ErrorCode::NotIdle),
        (9, ErrorCode::TooLarge),
    ];
    assert_eq!(codes, expected);
    assert_eq!(Hazard::ALL.map(Hazard::bits), [0, 1, 2]);
    assert_eq!(Hazard::ALL, [Hazard::Interlock, Hazard::Forward, Hazard::Published]);
    assert_eq!(InputWidth::ALL.map(InputWidth::bits), [1, 2, 4]);
    assert_eq!([Mode::Update.bits(), Mode::Evaluate.bits()], [0, 1]);
    assert_eq!([Busy::Registered.bits(), Busy::Combinational.bits()], [0, 1]);
    assert_eq!([Scheduler::Aftso.bits(), Scheduler::OnePhoton.bits()], [0, 1]);
    assert_eq!([Allocation::Leaping.bits(), Allocation::Sequential.bits()], [0, 1]);
    assert_eq!([State::Idle.bits(), State::Running.bits(), State::Fault.bits()], [0, 1, 2]);
    assert_eq!([NumberFormat::F32.bits(), NumberFormat::F24.bits()], [0, 1]);
}

#[test]
fn illegal_values_are_named_and_not_rounded_to_a_legal_one() {
    for bits in 10..=255 {
        assert_eq!(Error::from_bits(bits).code(), Err(Illegal { bits }));
    }
    assert_eq!(Hazard::try_from(3), Err(Illegal { bits: 3 }));
    assert_eq!(State::try_from(3), Err(Illegal { bits: 3 }));
    for bits in [0, 3, 5, 6, 7] {
        assert_eq!(Config::from_bits(bits << 5).input_width(), Err(Illegal { bits }));
    }
    assert_eq!(Mode::try_from(2), Err(Illegal { bits: 2 }));
    assert_eq!(Illegal { bits: 3 }.to_string(), "illegal field value 3");
}

#[test]
fn config_resets_to_the_papers_unit_protected() {
    let reset = Config::default();
    assert_eq!((reset.mode(), reset.normal_test()), (Mode::Update, false));
    assert_eq!((reset.hazard(), reset.busy()), (Ok(Hazard::Interlock), Busy::Registered));
    assert_eq!(reset.input_width(), Ok(InputWidth::One));
    assert_eq!((reset.scheduler(), reset.allocation()), (Scheduler::Aftso, Allocation::Leaping));
}

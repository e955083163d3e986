//! Does every field give back what was put in, leave its neighbours alone, and take nonsense calmly? In: any word.

use lucerna_regs::ident::{Capabilities, NumberFormat, Pipeline, Version};
use lucerna_regs::pree::{
    Allocation, Busy, Config, Control, Error, ErrorCode, Hazard, InputWidth, Mode, Scheduler,
};
use lucerna_regs::pree::{State, Status};
use lucerna_regs::{
    Illegal, REGISTERS, Register, counters, describe, displace, displace_counters, interrupts,
};
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
            RING_SPACE with_ring_space ring_space, DISPLACE_DONE with_displace_done displace_done,
            DISPLACE_ERROR with_displace_error displace_error);
        flag!(word, value, interrupts::Enable, DONE with_done done, ERROR with_error error,
            RING_SPACE with_ring_space ring_space, DISPLACE_DONE with_displace_done displace_done,
            DISPLACE_ERROR with_displace_error displace_error);
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
    fn every_typed_field_of_the_displacement_unit_round_trips(word: u32, value: u32) {
        use displace::{Ascend, Coherent, Config, Control, Error, ErrorCode, LevelsDown, RayFaults, Reach, Source, State, Status, Wrap};
        flag!(word, value, Control, START with_start start, ABORT with_abort abort);
        total!(word, Config, SOURCE with_source source Source, WRAP with_wrap wrap Wrap,
            RAY_FAULTS with_ray_faults ray_faults RayFaults);
        flag!(word, value, Config, START_LEVEL with_start_level start_level, SIBLINGS with_siblings siblings);
        number!(word, value, Config, START_GRID with_start_grid start_grid);
        partial!(word, Config, LEVELS_DOWN with_levels_down levels_down LevelsDown, ASCEND with_ascend ascend Ascend,
            COHERENT with_coherent coherent Coherent, REACH with_reach reach Reach);
        partial!(word, Status, STATE with_state state State);
        partial!(word, Error, CODE with_code code ErrorCode);
        number!(word, value, displace::MapSize, LOG2_WIDTH with_log2_width log2_width, LOG2_HEIGHT with_log2_height log2_height);
        number!(word, value, displace::TextureSize, LOG2_WIDTH with_log2_width log2_width, LOG2_HEIGHT with_log2_height log2_height);
        number!(word, value, displace::NormalSize, LOG2_WIDTH with_log2_width log2_width, LOG2_HEIGHT with_log2_height log2_height);
        number!(word, value, displace::RasterSize, WIDTH with_width width, HEIGHT with_height height);
        number!(word, value, displace::Background, RED with_red red, GREEN with_green green, BLUE with_blue blue);
        number!(word, value, displace::Pipeline, UNITS with_units units, STAGES with_stages stages,
            FILL_LATENCY with_fill_latency fill_latency);
        number!(word, value, displace::HeightCache, LOG2_BYTES with_log2_bytes log2_bytes, WAYS with_ways ways,
            LINE_BYTES with_line_bytes line_bytes);
        number!(word, value, displace::TextureCache, LOG2_BYTES with_log2_bytes log2_bytes, WAYS with_ways ways,
            LINE_BYTES with_line_bytes line_bytes);
        number!(word, value, displace::Fifos, FIFO0 with_fifo0 fifo0, FIFO1 with_fifo1 fifo1, PORT_BYTES with_port_bytes port_bytes);
        flag!(word, value, displace_counters::Control, SNAPSHOT with_snapshot snapshot, CLEAR with_clear clear);
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
    check::<displace::Control>(&mut typed);
    check::<displace::Config>(&mut typed);
    check::<displace::Status>(&mut typed);
    check::<displace::Error>(&mut typed);
    check::<displace::MapSize>(&mut typed);
    check::<displace::TextureSize>(&mut typed);
    check::<displace::NormalSize>(&mut typed);
    check::<displace::RasterSize>(&mut typed);
    check::<displace::Background>(&mut typed);
    check::<displace::Pipeline>(&mut typed);
    check::<displace::HeightCache>(&mut typed);
    check::<displace::TextureCache>(&mut typed);
    check::<displace::Fifos>(&mut typed);
    check::<displace_counters::Control>(&mut typed);
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
    assert_eq!(NumberFormat::ALL.map(NumberFormat::bits), [0, 1, 2]);
    assert_eq!(NumberFormat::ALL, [NumberFormat::F32, NumberFormat::F24, NumberFormat::F64]);
}

#[test]
fn encodings_of_the_displacement_unit_are_those_of_version_1_1() {
    use displace::{Ascend, Coherent, ErrorCode, LevelsDown, RayFaults, Reach, Source, State, Wrap};
    let expected = [
        (0, ErrorCode::None),
        (1, ErrorCode::BadConfig),
        (2, ErrorCode::Window),
        (3, ErrorCode::TooLarge),
        (4, ErrorCode::BadMap),
        (5, ErrorCode::BadRaster),
        (6, ErrorCode::GrazingRay),
        (7, ErrorCode::Watchdog),
        (8, ErrorCode::Overlap),
        (9, ErrorCode::NotIdle),
    ];
    assert_eq!(ErrorCode::ALL.map(|code| (code.bits(), code)), expected);
    assert_eq!(LevelsDown::ALL.map(LevelsDown::bits), [1, 2, 3, 4]);
    assert_eq!(Ascend::ALL, [Ascend::Never, Ascend::Parity, Ascend::Selective, Ascend::Coherent]);
    assert_eq!(Ascend::ALL.map(Ascend::bits), [0, 1, 2, 3]);
    assert_eq!(Coherent::ALL, [Coherent::Toggle, Coherent::Consecutive, Coherent::Parity]);
    assert_eq!(Coherent::ALL.map(Coherent::bits), [0, 1, 2]);
    assert_eq!(Reach::ALL.map(Reach::bits), [1, 2, 3]);
    assert_eq!([Source::List.bits(), Source::Raster.bits()], [0, 1]);
    assert_eq!([Wrap::Repeat.bits(), Wrap::Border.bits()], [0, 1]);
    assert_eq!([RayFaults::Record.bits(), RayFaults::Stop.bits()], [0, 1]);
    assert_eq!([State::Idle.bits(), State::Running.bits(), State::Fault.bits()], [0, 1, 2]);
    for bits in 0..8 {
        let config = displace::Config::from_bits(bits << 5 | bits << 8);
        assert_eq!(config.levels_down().is_ok(), (1..=4).contains(&bits));
        assert_eq!(config.ascend().is_ok(), bits < 4);
    }
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
fn displacement_config_resets_to_the_papers_hardware() {
    use displace::{Ascend, Coherent, Config, LevelsDown, RayFaults, Reach, Source, Wrap};
    let reset = Config::default();
    assert_eq!(
        (reset.source(), reset.wrap(), reset.ray_faults()),
        (Source::List, Wrap::Repeat, RayFaults::Record)
    );
    assert_eq!((reset.start_level(), reset.start_grid()), (true, 0), "(a)");
    assert_eq!(reset.levels_down(), Ok(LevelsDown::Two), "(b)");
    assert_eq!((reset.ascend(), reset.coherent()), (Ok(Ascend::Selective), Ok(Coherent::Toggle)), "(c1)");
    assert_eq!((reset.reach(), reset.siblings()), (Ok(Reach::One), false), "nothing beyond the paper");
}

#[test]
fn config_resets_to_the_papers_unit_protected() {
    let reset = Config::default();
    assert_eq!((reset.mode(), reset.normal_test()), (Mode::Update, false));
    assert_eq!((reset.hazard(), reset.busy()), (Ok(Hazard::Interlock), Busy::Registered));
    assert_eq!(reset.input_width(), Ok(InputWidth::One));
    assert_eq!((reset.scheduler(), reset.allocation()), (Scheduler::Aftso, Allocation::Leaping));
}

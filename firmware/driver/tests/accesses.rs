//! Does every operation make exactly the accesses it should, in this order? Offsets are written out as numbers
//! here, so that a slip in the register map shows.

mod common;

use common::{NoDelay, SIZES, evaluate_job, hit_points, layout, photons, update_job};
use lucerna_bus::Access::{self, Read, ReadBlock, Write, WriteBlock};
use lucerna_bus::Scripted;
use lucerna_driver::{
    Allocation, Busy, Cause, Deadline, DeviceError, ErrorCode, EvaluateJob, Hazard, InputWidth, Lucerna,
    NumberFormat, Photon, Policies, Pree, Progress, Resumed, Scheduler, Sizes, State, UpdateJob,
};

const PROBE: [Access<'static>; 6] = [
    Read(0x000, 0x4C55_4352),
    Read(0x004, 0x0001_0001),
    Read(0x008, 0x0001_4008),
    Read(0x00C, 0x0001_0C0A),
    Read(0x010, 64 * 1024),
    Read(0x108, 0),
];

/// The hit points lie at 0..0x100, the index at 0x100..0x120, the pixels at 0x120..0x138, the ring at
/// 0x138..0x238.
const WINDOWS: [Access<'static>; 8] = [
    Write(0x080, 0),
    Write(0x084, 0x100),
    Write(0x088, 0x100),
    Write(0x08C, 0x120),
    Write(0x090, 0x120),
    Write(0x094, 0x138),
    Write(0x098, 0x138),
    Write(0x09C, 0x238),
];

const BUFFERS: [Access<'static>; 8] = [
    Write(0x11C, 0),
    Write(0x120, 4),
    Write(0x124, 0x100),
    Write(0x128, 8),
    Write(0x12C, 0x120),
    Write(0x130, 2),
    Write(0x134, 0x138),
    Write(0x138, 8),
];

/// From windows to START, of an update with this configuration.
fn start_update(config: u32) -> Vec<Access<'static>> {
    let own = [Write(0x114, 0x3F00_0000), Write(0x144, 4), Write(0x040, 7), Write(0x100, 1)];
    [&WINDOWS[..], &[Write(0x104, config)], &BUFFERS, &own].concat()
}

fn start_evaluate(config: u32) -> Vec<Access<'static>> {
    let own = [Write(0x118, 0x447A_0000), Write(0x040, 7), Write(0x100, 1)];
    [&WINDOWS[..], &[Write(0x104, config)], &BUFFERS, &own].concat()
}

/// Probes, then checks that `act` makes the accesses of `script` and no others.
fn check<'s>(script: &[Access<'s>], act: impl FnOnce(&mut Pree<'_, &mut Scripted<'_>, NoDelay>)) {
    let script = [&PROBE[..], script].concat();
    let mut bus = Scripted::new(&script);
    let mut lucerna = Lucerna::probe(&mut bus, NoDelay).unwrap();
    act(&mut lucerna.pree().unwrap());
    bus.finish().unwrap_or_else(|divergence| panic!("{divergence}"));
}

#[test]
fn probe_reads_and_does_not_write() {
    check(&[], |pree| {
        let device = pree.capabilities();
        assert_eq!((device.preus, device.format, device.buffer_entries), (8, NumberFormat::F32, 4));
        assert_eq!((device.update_stages, device.evaluate_stages, device.operand_latency), (10, 12, 1));
        assert_eq!((device.version, device.memory_bytes, device.units), ((1, 1), 64 * 1024, 1));
        assert_eq!(pree.state(), State::Idle);
    });
}

#[test]
fn a_probe_of_the_wrong_device_stops_at_once() {
    let cases: [(&[Access<'_>], Cause<_>); 7] = [
        (&[Read(0, 0)], Cause::WrongDevice { id: 0 }),
        (&[Read(0, u32::MAX)], Cause::WrongDevice { id: u32::MAX }),
        (&[PROBE[0], Read(4, 0x0002_0000)], Cause::WrongVersion { major: 2, minor: 0 }),
        (&[PROBE[0], Read(4, 0x0001_0000)], Cause::WrongVersion { major: 1, minor: 0 }),
        (&[PROBE[0], Read(4, 0x0000_0009)], Cause::WrongVersion { major: 0, minor: 9 }),
        (&[PROBE[0], PROBE[1], Read(8, 0x0001_4308)], Cause::Nonsense { offset: 8, bits: 0x0001_4308 }),
        (&[PROBE[0], PROBE[1], Read(8, 0x0001_4000)], Cause::Nonsense { offset: 8, bits: 0x0001_4000 }),
    ];
    for (script, cause) in cases {
        let mut bus = Scripted::new(script);
        let error = Lucerna::probe(&mut bus, NoDelay).unwrap_err();
        assert_eq!((error.cause, error.state), (cause, State::Untouched));
        bus.finish().unwrap();
    }
    // A newer minor version is fine.
    let mut script = PROBE;
    script[1] = Read(4, 0x0001_0007);
    assert_eq!(Lucerna::probe(Scripted::new(&script), NoDelay).unwrap().capabilities().version, (1, 7));
    // Without the unit there is nothing to ask for its state, and no handle.
    script[2] = Read(8, 0x0004_4008);
    let mut bus = Scripted::new(&script[..5]);
    let error = Lucerna::probe(&mut bus, NoDelay).unwrap().pree().unwrap_err();
    assert_eq!((error.cause, error.state), (Cause::NoUnit, State::Untouched));
    bus.finish().unwrap();
    let mut lucerna = Lucerna::probe(Scripted::new(&script[..5]), NoDelay).unwrap();
    assert_eq!(lucerna.displace().unwrap_err().cause, Cause::NoUnit);
    assert_eq!(lucerna.counters().unwrap_err().cause, Cause::NoUnit);
    assert_eq!(lucerna.clear_counters().unwrap_err().cause, Cause::NoUnit);
}

#[test]
fn update_writes_its_job_and_starts_last() {
    let layout = layout(SIZES);
    check(&start_update(0x020), |pree| {
        let stream = pree.update(&update_job(&layout)).unwrap();
        assert_eq!((stream.pushed(), stream.room()), (0, 8));
    });
}

#[test]
fn every_policy_has_its_bits() {
    let layout = layout(SIZES);
    let normal = Policies::default();
    let cases = [
        (Policies { hazard: Hazard::Forward, ..normal }, 0x024),
        (Policies { hazard: Hazard::Published, ..normal }, 0x028),
        (Policies { busy: Busy::Combinational, ..normal }, 0x030),
        (Policies { input_width: InputWidth::Two, ..normal }, 0x040),
        (Policies { input_width: InputWidth::Four, ..normal }, 0x080),
        (Policies { scheduler: Scheduler::OnePhoton, ..normal }, 0x120),
        (Policies { allocation: Allocation::Sequential, ..normal }, 0x220),
    ];
    for (policies, config) in cases {
        check(&start_update(config), |pree| {
            let _ = pree.update(&UpdateJob::new(&layout, 0.5, policies).unwrap()).unwrap();
        });
        check(&start_evaluate(config | 1), |pree| {
            let _ = pree.evaluate(&EvaluateJob::new(&layout, 1000.0, policies).unwrap()).unwrap();
        });
    }
}

#[test]
fn the_normal_test_sets_its_bit_and_the_long_records() {
    let layout = layout(Sizes { normal_test: true, ring_entries: 2, ..SIZES });
    let mut script = start_update(0x022);
    for (place, access) in script.iter_mut().enumerate() {
        match (place, access) {
            (7, access) => *access = Write(0x09C, 0x138 + 2 * 48),
            (16, access) => *access = Write(0x138, 2),
            (18, access) => *access = Write(0x144, 1),
            _ => {}
        }
    }
    let photon = Photon { normal: [0.0, -1.0, 0.0], ..photons(4)[3] };
    let record = [
        0x4040_0000,
        0x3F80_0000,
        0x4000_0000,
        0x3E80_0000,
        0x3F00_0000,
        0x4060_0000,
        3,
        1,
        0,
        0xBF80_0000,
        0,
        0,
    ];
    script.extend([WriteBlock(0x138, &record), Write(0x140, 1)]);
    check(&script, |pree| {
        assert_eq!(pree.update(&update_job(&layout)).unwrap().push(&[photon]), Ok(1));
    });
}

/// The words of photons `range` of [`photons`].
fn records(range: std::ops::Range<u32>) -> Vec<u32> {
    let all = photons(range.end);
    all[range.start as usize..].iter().flat_map(|photon| photon.pack(NumberFormat::F32)).collect()
}

#[test]
fn push_writes_records_then_rings_and_reads_the_head_only_when_short() {
    let layout = layout(SIZES);
    let (a, b, c, d) = (records(0..3), records(3..8), records(8..10), records(10..12));
    let mut script = start_update(0x020);
    script.extend([
        // Three, then five: the room is known.
        WriteBlock(0x138, &a),
        Write(0x140, 3),
        WriteBlock(0x138 + 3 * 32, &b),
        Write(0x140, 8),
        // Full: the head is asked, and the status as nothing fits.
        Read(0x13C, 0),
        Read(0x040, 0),
        // Two more fit; then full again.
        Read(0x13C, 2),
        WriteBlock(0x138, &c),
        Write(0x140, 10),
        // Six taken since: room for two of two is known, without a question for them after the first.
        Read(0x13C, 8),
        WriteBlock(0x138 + 2 * 32, &d),
        Write(0x140, 12),
        Write(0x100, 2),
    ]);
    check(&script, |pree| {
        let mut stream = pree.update(&update_job(&layout)).unwrap();
        let photons = photons(12);
        assert_eq!(stream.push(&photons[..3]), Ok(3));
        assert_eq!(stream.push(&photons[3..8]), Ok(5));
        assert_eq!(stream.push(&photons[8..]), Ok(0));
        assert_eq!(stream.push(&photons[8..]), Ok(2));
        assert_eq!(stream.push(&photons[10..]), Ok(2));
        assert_eq!(stream.push(&[]), Ok(0));
        assert_eq!((stream.pushed(), stream.room()), (12, 4));
        let _ = stream.flush().unwrap();
    });
}

#[test]
fn push_splits_blocks_at_32_records_and_at_the_ring_s_end() {
    let layout = layout(Sizes { ring_entries: 64, ..SIZES });
    let (a, b, c, d, e) =
        (records(0..32), records(32..40), records(40..64), records(64..72), records(72..80));
    let mut script = start_update(0x020);
    script[7] = Write(0x09C, 0x138 + 64 * 32);
    script[16] = Write(0x138, 64);
    script[18] = Write(0x144, 32);
    script.extend([
        WriteBlock(0x138, &a),
        Write(0x140, 32),
        WriteBlock(0x138 + 32 * 32, &b),
        Write(0x140, 40),
        Read(0x13C, 40),
        WriteBlock(0x138 + 40 * 32, &c),
        Write(0x140, 64),
        WriteBlock(0x138, &d),
        Write(0x140, 72),
        WriteBlock(0x138 + 8 * 32, &e),
        Write(0x140, 80),
    ]);
    check(&script, |pree| {
        let mut stream = pree.update(&update_job(&layout)).unwrap();
        let photons = photons(80);
        assert_eq!(stream.push(&photons[..40]), Ok(40));
        assert_eq!(stream.push(&photons[40..72]), Ok(32));
        assert_eq!(stream.push(&photons[72..]), Ok(8));
    });
}

#[test]
fn poll_reads_one_register_and_the_end_clears_the_events() {
    let layout = layout(SIZES);
    let mut script = start_evaluate(0x021);
    script.extend([Read(0x040, 0), Read(0x040, 4), Read(0x040, 1), Write(0x040, 7)]);
    check(&script, |pree| {
        let mut run = pree.evaluate(&evaluate_job(&layout)).unwrap();
        assert_eq!(run.poll(), Ok(Progress::Running));
        assert_eq!(run.poll(), Ok(Progress::Running));
        assert_eq!(run.poll(), Ok(Progress::Done));
        assert_eq!(run.poll(), Ok(Progress::Done), "and asks no more");
        run.wait(Deadline::NOW).unwrap();
        assert_eq!(pree.state(), State::Idle);
    });
}

#[test]
fn an_error_is_read_with_its_address() {
    let layout = layout(SIZES);
    let mut script = start_evaluate(0x021);
    // Done and error at once: the error counts.
    script.extend([Read(0x040, 3), Read(0x10C, 7), Read(0x110, 0x40)]);
    check(&script, |pree| {
        let error = pree.evaluate(&evaluate_job(&layout)).unwrap().poll().unwrap_err();
        let found = DeviceError { code: ErrorCode::PixelRange, address: 0x40 };
        assert_eq!((error.cause, error.state), (Cause::Device(found), State::Faulted));
        assert_eq!(
            error.to_string(),
            "the hit point at 0x40 names no pixel: write the hit points again (device faulted)"
        );
        // Refused until recovered, and nothing is accessed.
        let error = pree.zero_pixels(&layout).unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::NotReady, State::Faulted));
    });
    // A code nobody knows.
    let mut script = start_evaluate(0x021);
    script.extend([Read(0x040, 2), Read(0x10C, 0xFF), Read(0x110, 0)]);
    check(&script, |pree| {
        let error = pree.evaluate(&evaluate_job(&layout)).unwrap().poll().unwrap_err();
        let cause = Cause::Nonsense { offset: 0x10C, bits: 0xFF };
        assert_eq!((error.cause, error.state), (cause, State::Unknown));
    });
}

#[test]
fn recover_checks_aborts_and_clears() {
    let script = [Read(0, 0x4C55_4352), Write(0x100, 4), Write(0x044, 0), Write(0x040, 7), Read(0x108, 0)];
    check(&script, |pree| pree.recover().unwrap());
    let mut stuck = script;
    stuck[4] = Read(0x108, 1);
    check(&stuck, |pree| {
        let error = pree.recover().unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::Stuck, State::Unknown));
    });
    check(&[Read(0, 0)], |pree| {
        let error = pree.recover().unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::WrongDevice { id: 0 }, State::Unknown));
        assert_eq!(pree.state(), State::Unknown);
    });
}

#[test]
fn counters_are_a_snapshot_and_thirty_reads() {
    let mut script = vec![Write(0x200, 1)];
    for number in 0..15 {
        script.extend([Read(0x208 + 8 * number, 100 + number), Read(0x20C + 8 * number, number)]);
    }
    script.push(Write(0x200, 2));
    check(&script, |pree| {
        let counters = pree.counters().unwrap();
        assert_eq!((counters.photons, counters.empty_cells), (100, 101 | 1 << 32));
        assert_eq!(counters.update_cycles, 104 | 4 << 32);
        assert_eq!(counters.forwards, 114 | 14 << 32);
        pree.clear_counters().unwrap();
    });
}

#[test]
fn buffers_are_written_and_read_in_blocks() {
    let layout = layout(Sizes { hit_points: 40, pixels: 100, index_entries: 600, ..SIZES });
    let zeros = [0; 192];
    let hit_point: Vec<u32> = hit_points()[1].pack(NumberFormat::F32).to_vec();
    assert_eq!(hit_point[9..15], [0x3FA0_0000, 0x4020_0000, 0x40A0_0000, 0, 0, 0]);
    let (full, rest) = (hit_point.repeat(16), hit_point.repeat(4));
    let index: Vec<u32> = (0..600).map(|entry| entry % 40).collect();
    let pixels: Vec<u32> = (0..99).flat_map(|pixel| [1, 2, pixel]).collect();
    let (index_base, pixel_base) = (40 * 64, 40 * 64 + 600 * 4);
    let script = [
        WriteBlock(4 * 64, &full),
        WriteBlock(20 * 64, &full),
        WriteBlock(36 * 64, &rest),
        ReadBlock(39 * 64, &hit_point),
        WriteBlock(index_base, &index[..512]),
        WriteBlock(index_base + 2048, &index[512..]),
        WriteBlock(pixel_base, &zeros),
        WriteBlock(pixel_base + 768, &zeros[..108]),
        ReadBlock(pixel_base + 12, &pixels[..192]),
        ReadBlock(pixel_base + 12 + 768, &pixels[192..]),
    ];
    check(&script, |pree| {
        pree.write_hit_points(&layout, 4, &[hit_points()[1]; 36]).unwrap();
        let mut back = [hit_points()[0]];
        pree.read_hit_points(&layout, 39, &mut back).unwrap();
        assert_eq!(back, [hit_points()[1]]);
        pree.write_index(&layout, 0, &index).unwrap();
        pree.zero_pixels(&layout).unwrap();
        let mut bits = [[0; 3]; 99];
        pree.read_pixel_bits(&layout, 1, &mut bits).unwrap();
        assert_eq!(bits.as_flattened(), pixels);
    });
}

#[test]
fn guards_come_before_the_first_access() {
    let layout = layout(SIZES);
    check(&[], |pree| {
        let untouched = |result: Result<(), lucerna_driver::Error<_>>| {
            let error = result.unwrap_err();
            assert_eq!(error.state, State::Untouched);
            error.cause
        };
        let bad = Cause::BadReference { position: 2 };
        assert_eq!(untouched(pree.write_index(&layout, 0, &[0, 3, 4])), bad);
        let mut points = hit_points();
        points[2].pixel = 2;
        assert_eq!(untouched(pree.write_hit_points(&layout, 0, &points)), bad);
        assert_eq!(untouched(pree.write_hit_points(&layout, 1, &hit_points())), Cause::OutsideBuffer);
        assert_eq!(untouched(pree.write_index(&layout, 8, &[0])), Cause::OutsideBuffer);
        assert_eq!(untouched(pree.write_index(&layout, u32::MAX, &[0])), Cause::OutsideBuffer);
        assert_eq!(untouched(pree.read_pixels(&layout, 0, &mut [[0.0; 3]; 3])), Cause::OutsideBuffer);
        assert_eq!(untouched(pree.read_hit_points(&layout, 4, &mut points)), Cause::OutsideBuffer);

        let mut other = *pree.capabilities();
        other.format = NumberFormat::F24;
        let foreign = lucerna_driver::Layout::packed(&other, SIZES).unwrap();
        assert_eq!(untouched(pree.zero_pixels(&foreign)), Cause::ForeignLayout);
        assert_eq!(untouched(pree.update(&update_job(&foreign)).map(|_| ())), Cause::ForeignLayout);
        assert_eq!(untouched(pree.evaluate(&evaluate_job(&foreign)).map(|_| ())), Cause::ForeignLayout);
    });
}

#[test]
fn a_dropped_stream_is_taken_up_where_it_was() {
    let layout = layout(SIZES);
    let (front, back) = (records(0..3), records(3..4));
    let mut script = start_update(0x020);
    script.extend([
        WriteBlock(0x138, &front),
        Write(0x140, 3),
        // Configuration, status: an update that is not flushing. Then the ring: base, entries, low, tail, head.
        Read(0x104, 0x020),
        Read(0x108, 1),
        Read(0x134, 0x138),
        Read(0x138, 8),
        Read(0x144, 4),
        Read(0x140, 3),
        Read(0x13C, 2),
        WriteBlock(0x138 + 3 * 32, &back),
        Write(0x140, 4),
        Write(0x100, 2),
        // Flushing: a run.
        Read(0x104, 0x020),
        Read(0x108, 9),
        Read(0x040, 1),
        Write(0x040, 7),
    ]);
    check(&script, |pree| {
        assert_eq!(pree.update(&update_job(&layout)).unwrap().push(&photons(3)), Ok(3));
        let Resumed::Stream(mut stream) = pree.resume().unwrap() else { panic!("it was not flushed") };
        assert_eq!((stream.pushed(), stream.room()), (3, 7));
        assert_eq!(stream.push(&photons(4)[3..]), Ok(1));
        let _ = stream.flush().unwrap();
        let Resumed::Run(mut run) = pree.resume().unwrap() else { panic!("it was flushed") };
        run.wait(Deadline::NOW).unwrap();
        let error = pree.resume().unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::NoJob, State::Idle));
    });
}

#[test]
fn a_ring_that_cannot_be_is_not_taken_up() {
    let layout = layout(SIZES);
    let resume = |entries, tail, head| {
        let mut script = start_update(0x020);
        script.extend([Read(0x104, 0x020), Read(0x108, 1), Read(0x134, 0x138), Read(0x138, entries)]);
        if entries == 8 {
            script.extend([Read(0x144, 4), Read(0x140, tail), Read(0x13C, head)]);
        }
        script
    };
    for entries in [0, 6, 1 << 17] {
        check(&resume(entries, 0, 0), |pree| {
            let _ = pree.update(&update_job(&layout)).unwrap();
            let error = pree.resume().unwrap_err();
            let cause = Cause::Nonsense { offset: 0x138, bits: entries };
            assert_eq!((error.cause, error.state), (cause, State::Running));
        });
    }
    check(&resume(8, 3, 4), |pree| {
        let _ = pree.update(&update_job(&layout)).unwrap();
        let error = pree.resume().unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::RingOverrun { head: 4, tail: 3 }, State::Unknown));
        assert_eq!(pree.resume().unwrap_err().cause, Cause::NotReady);
    });
}

#[test]
fn a_dropped_run_is_remembered() {
    let layout = layout(SIZES);
    check(&start_evaluate(0x021), |pree| {
        let _ = pree.evaluate(&evaluate_job(&layout)).unwrap();
        for result in [
            pree.evaluate(&evaluate_job(&layout)).map(|_| ()),
            pree.update(&update_job(&layout)).map(|_| ()),
            pree.read_pixels(&layout, 0, &mut [[0.0; 3]]),
        ] {
            let error = result.unwrap_err();
            assert_eq!((error.cause, error.state), (Cause::NotReady, State::Running));
        }
    });
}

//! Does every operation of the displacement unit make exactly the accesses it should, in this order? Offsets are written
//! out as numbers here, so that a slip in the register map shows.

mod common;

use common::NoDelay;
use common::displacer::{SIZES, capabilities, layout, list, plane, raster, rays};
use lucerna_bus::Access::{self, FailWrite, Read, ReadBlock, Write, WriteBlock};
use lucerna_bus::{ScriptError, Scripted};
use lucerna_driver::displace::{
    Algorithm, Coherent, Counter, ErrorCode, Image, Job, Layout, LevelsDown, Light, Policies, RayFaults,
    RayResult, RayStatus, Reach, Shape, Sizes, Wrap,
};
use lucerna_driver::{
    Cache, Capabilities, Cause, Deadline, Displace, DisplaceError, Error, Lucerna, NumberFormat, Progress,
    State, Unit,
};

const PROBE: [Access<'static>; 10] = [
    Read(0x000, 0x4C55_4352),
    Read(0x004, 0x0001_0001),
    Read(0x008, 0x0002_0000),
    Read(0x00C, 0),
    Read(0x010, 64 * 1024),
    Read(0x3C0, 0x0028_0F01),
    Read(0x3C4, 0x0020_040E),
    Read(0x3C8, 0x0040_020D),
    Read(0x3CC, 0x0008_1110),
    Read(0x308, 0),
];

/// The map's pyramid lies at 0..0x80, the texture at 0x80..0xC0, the normals to 0x100, rays to 0x180, results to 0x200.
const WINDOWS: [Access<'static>; 8] = [
    Write(0x080, 0),
    Write(0x084, 0x080),
    Write(0x088, 0x080),
    Write(0x08C, 0x100),
    Write(0x090, 0x100),
    Write(0x094, 0x180),
    Write(0x098, 0x180),
    Write(0x09C, 0x200),
];

const MAPS: [Access<'static>; 7] = [
    Write(0x318, 4096),
    Write(0x31C, 0),
    Write(0x320, 0x303),
    Write(0x324, 0x80),
    Write(0x328, 0x101),
    Write(0x32C, 0xC0),
    Write(0x330, 0x101),
];

/// Height scale, tangent, bitangent and normal: 0.25, and a two hundredth each.
const FRAME: [Access<'static>; 10] = [
    Write(0x344, 0x3E80_0000),
    Write(0x348, 0x3BA3_D70A),
    Write(0x34C, 0),
    Write(0x350, 0),
    Write(0x354, 0),
    Write(0x358, 0),
    Write(0x35C, 0xBBA3_D70A),
    Write(0x360, 0),
    Write(0x364, 0x3BA3_D70A),
    Write(0x368, 0),
];

const LIGHT: [Access<'static>; 6] = [
    Write(0x3A4, 0),
    Write(0x3A8, 0),
    Write(0x3AC, 0x3F80_0000),
    Write(0x3B0, 0x3E4C_CCCD),
    Write(0x3B4, 0x3F4C_CCCD),
    Write(0x3B8, 0),
];

const START: [Access<'static>; 2] = [Write(0x040, 0x18), Write(0x300, 1)];

/// From windows to START, of a list of three rays.
fn start_list(config: u32) -> Vec<Access<'static>> {
    let source = [Write(0x334, 0x100), Write(0x338, 3), Write(0x340, 0x180)];
    [&WINDOWS[..], &[Write(0x304, config)], &MAPS, &source, &FRAME, &LIGHT, &START].concat()
}

/// Probes, then checks that `act` makes the accesses of `script` and no others.
fn check<'s>(script: &[Access<'s>], act: impl FnOnce(&mut Displace<'_, &mut Scripted<'_>, NoDelay>)) {
    let script = [&PROBE[..], script].concat();
    let mut bus = Scripted::new(&script);
    let mut lucerna = Lucerna::probe(&mut bus, NoDelay).unwrap();
    act(&mut lucerna.displace().unwrap());
    bus.finish().unwrap_or_else(|divergence| panic!("{divergence}"));
}

#[test]
fn probe_reads_the_unit_s_sizes() {
    check(&[], |displace| {
        let device = displace.capabilities();
        assert_eq!((device.preus, device.units, device.has(Unit::Pree)), (0, 2, false));
        let unit = device.displace.unwrap();
        assert_eq!((unit.units, unit.stages, unit.fill_latency), (1, 15, 40));
        assert_eq!(unit.height_cache, Cache { bytes: 16384, ways: 4, line_bytes: 32 });
        assert_eq!(unit.texture_cache, Cache { bytes: 8192, ways: 2, line_bytes: 64 });
        assert_eq!((unit.fifo0, unit.fifo1, unit.port_bytes), (16, 17, 8));
        assert_eq!(displace.state(), State::Idle);
    });
    // Nonsense is refused: no instance, a cache of more bytes than 32 bits count.
    for (place, bits) in [(5, 0x0028_0F00), (6, 0x0020_0420), (7, 0x0040_02FF)] {
        let mut script = PROBE;
        let Read(offset, _) = script[place] else { panic!() };
        script[place] = Read(offset, bits);
        let error = Lucerna::probe(Scripted::new(&script), NoDelay).unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::Nonsense { offset, bits }, State::Untouched));
    }
}

#[test]
fn a_list_writes_its_job_and_starts_last() {
    let layout = layout(SIZES);
    check(&start_list(0x8244), |displace| {
        let _ = displace.start(&list(&layout, 3)).unwrap();
        assert_eq!(displace.state(), State::Running);
    });
}

#[test]
fn a_raster_writes_its_camera_too() {
    // tan(22.5°) / 2 pixels' half height; the corner is half a pixel from the middle.
    let pixel = 0x3ED4_13CD;
    let half = 0x3E54_13CD;
    let source = [Write(0x33C, 0x0002_0002), Write(0x340, 0x180)];
    let eye = [
        // u, v, and 100 over a displacement 50 deep.
        Write(0x36C, 0x3F00_0000),
        Write(0x370, 0x3F00_0000),
        Write(0x374, 0x4000_0000),
        Write(0x378, 0x3F80_0000),
        Write(0x37C, 0x3F80_0000),
    ];
    let view = [
        Write(0x380, half | 1 << 31),
        Write(0x384, 0xBF80_0000),
        Write(0x388, half | 1 << 31),
        Write(0x38C, pixel),
        Write(0x390, 0),
        Write(0x394, 0),
        Write(0x398, 0),
        Write(0x39C, 0),
        Write(0x3A0, pixel),
    ];
    let parts: [&[Access<'_>]; 9] =
        [&WINDOWS, &[Write(0x304, 0x8245)], &MAPS, &source, &FRAME, &eye, &view, &LIGHT, &START];
    let layout = layout(SIZES);
    check(&parts.concat(), |displace| {
        let job = raster(&layout);
        assert_eq!(job.rays(), 4);
        let _ = displace.start(&job).unwrap();
    });
}

#[test]
fn every_policy_has_its_bits() {
    let layout = layout(SIZES);
    let cases = [
        (Algorithm::Oh.policies(), 0x8020),
        (Algorithm::Tevs.policies(), 0x8120),
        (Algorithm::A.policies(), 0x8024),
        (Algorithm::B(LevelsDown::Two).policies(), 0x8040),
        (Algorithm::B(LevelsDown::Four).policies(), 0x8080),
        (Algorithm::C1.policies(), 0x8220),
        (Algorithm::C2.policies(), 0x8320),
        (Algorithm::Mix.policies(), 0x8244),
        (Algorithm::MixGpu.policies(), 0x8344),
        (Algorithm::Fold.policies(), 0x1_4264),
        (Policies { reach: Reach::Three, ..Policies::C1 }, 0x1_8220),
        (Policies::MIX.with_wrap(Wrap::Border), 0x8246),
        (Policies::A.with_start_grid(3), 0x803C),
        (Policies::C2.with_coherent(Coherent::Consecutive), 0x8B20),
        (Policies::C2.with_coherent(Coherent::Parity), 0x9320),
    ];
    for (policies, config) in cases {
        check(&start_list(config), |displace| {
            let job = Job::list(&layout, 3, &plane(), policies).unwrap();
            let _ = displace.start(&job).unwrap();
        });
    }
    // Whatever else a job can be told.
    let mut script = start_list(0xA244);
    for access in &mut script {
        match access {
            Write(0x318, value) => *value = 100,
            Write(0x3A8, value) => *value = 0x3F80_0000,
            Write(0x3AC, value) | Write(0x3B0, value) => *value = 0,
            Write(0x3B4, value) => *value = 0x3F80_0000,
            Write(0x3B8, value) => *value = 0x0010_2030,
            _ => {}
        }
    }
    check(&script, |displace| {
        let job = list(&layout, 3).with_watchdog(100).unwrap().with_ray_faults(RayFaults::Stop);
        let job = job.with_light(Light::towards([0.0, 3.0, 0.0], 0.0, 1.0)).unwrap();
        let _ = displace.start(&job.with_background([0x10, 0x20, 0x30])).unwrap();
    });
}

#[test]
fn poll_reads_the_status_and_clears_its_own_events_at_the_end() {
    let layout = layout(SIZES);
    let mut script = start_list(0x8244);
    // Events of the other unit are none of this job's.
    script.extend([Read(0x040, 0), Read(0x040, 7), Read(0x314, 2), Read(0x040, 8), Write(0x040, 0x18)]);
    check(&script, |displace| {
        let mut run = displace.start(&list(&layout, 3)).unwrap();
        assert_eq!(run.poll(), Ok(Progress::Running));
        assert_eq!(run.poll(), Ok(Progress::Running));
        assert_eq!(run.rays_done(), Ok(2));
        assert_eq!(run.poll(), Ok(Progress::Done));
        assert_eq!(run.poll(), Ok(Progress::Done), "and asks no more");
        run.wait(Deadline::NOW).unwrap();
        assert_eq!(displace.state(), State::Idle);
    });
}

#[test]
fn an_error_is_read_with_its_address() {
    let layout = layout(SIZES);
    let mut script = start_list(0x8244);
    script.extend([Read(0x040, 0x18), Read(0x30C, 7), Read(0x310, 0x1A0)]);
    check(&script, |displace| {
        let error = displace.start(&list(&layout, 3)).unwrap().poll().unwrap_err();
        let found = DisplaceError { code: ErrorCode::Watchdog, address: 0x1A0 };
        assert_eq!((error.cause, error.state), (Cause::Displace(found), State::Faulted));
        assert!(error.to_string().starts_with("the ray of the result at 0x1a0 took as many steps"));
        for error in [
            displace.start(&list(&layout, 3)).map(|_| ()).unwrap_err(),
            displace.resume().map(|_| ()).unwrap_err(),
        ] {
            assert_eq!((error.cause, error.state), (Cause::NotReady, State::Faulted));
        }
    });
    let mut script = start_list(0x8244);
    script.extend([Read(0x040, 0x10), Read(0x30C, 10), Read(0x310, 0)]);
    check(&script, |displace| {
        let error = displace.start(&list(&layout, 3)).unwrap().poll().unwrap_err();
        assert_eq!(error.cause, Cause::Nonsense { offset: 0x30C, bits: 10 });
        assert_eq!(error.state, State::Unknown);
    });
}

#[test]
fn a_dropped_run_is_taken_up_without_an_access() {
    let layout = layout(SIZES);
    let mut script = start_list(0x8244);
    script.extend([Read(0x040, 8), Write(0x040, 0x18)]);
    check(&script, |displace| {
        assert_eq!(displace.resume().unwrap_err().cause, Cause::NoJob);
        let _ = displace.start(&list(&layout, 3)).unwrap();
        let error = displace.read_results(&layout, 0, &mut []).unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::NotReady, State::Running));
        displace.resume().unwrap().wait(Deadline::NOW).unwrap();
    });
}

#[test]
fn recover_checks_aborts_and_clears() {
    let script = [Read(0, 0x4C55_4352), Write(0x300, 2), Write(0x044, 0), Write(0x040, 0x18), Read(0x308, 0)];
    check(&script, |displace| displace.recover().unwrap());
    let mut stuck = script;
    stuck[4] = Read(0x308, 1);
    check(&stuck, |displace| {
        let error = displace.recover().unwrap_err();
        assert_eq!((error.cause, error.state), (Cause::Stuck, State::Unknown));
    });
}

#[test]
fn counters_are_a_snapshot_and_two_reads_each() {
    let mut script = vec![Write(0x400, 1)];
    for number in 0..37 {
        script.extend([Read(0x408 + 8 * number, 100 + number), Read(0x40C + 8 * number, number)]);
    }
    script.push(Write(0x400, 2));
    check(&script, |displace| {
        let counters = displace.counters().unwrap();
        assert_eq!((counters.rays, counters.hits), (100, 101 | 1 << 32));
        assert_eq!((counters.max_steps, counters.cycles), (106 | 6 << 32, 112 | 12 << 32));
        assert_eq!(counters.folds, 136 | 36 << 32);
        for counter in Counter::ALL {
            let number = counter.index() as u64;
            assert_eq!(counters.get(counter), (100 + number) | (number << 32), "{}", counter.name());
        }
        displace.clear_counters().unwrap();
    });
}

#[test]
fn buffers_are_written_and_read_in_blocks() {
    let layout = layout(Sizes { rays: 20, results: 70, ..SIZES });
    let heights: Vec<u8> = (0..64).collect();
    let heights = Image::new(Shape::new(3, 3).unwrap(), &heights).unwrap();
    let mut level: Vec<u32> = vec![0; 16];
    for place in 0..64 {
        let (x, y) = heights.shape().texel(place);
        level[place as usize / 4] |= (8 * y + x) << (8 * (place % 4));
    }
    let texels = [0xFF00_0001, 2, 3, 4];
    let texture = Image::new(Shape::new(1, 1).unwrap(), &texels).unwrap();
    let ray = |number: f32| [number.to_bits(), 0x3F00_0000, 0, 0xBF80_0000, 0x3E80_0000, 0, 0, 0];
    let list: Vec<u32> = (0..18).flat_map(|number| ray(number as f32)).collect();
    let results: Vec<u32> = (0..70).flat_map(|number| [number, !number, 0, number, 0, 0, 0, 0]).collect();
    let (ray_base, result_base) = (0x100, 0x100 + 20 * 32);
    let script = [
        // The next level is done with the last texel; so are the two above it, which end in a word with one byte.
        WriteBlock(0, &level),
        WriteBlock(64, &[0x1B19_0B09, 0x1F1D_0F0D, 0x3B39_2B29, 0x3F3D_2F2D]),
        WriteBlock(80, &[0x3F3B_1F1B]),
        WriteBlock(84, &[0x3F]),
        WriteBlock(0x80, &[1, 2, 3, 4]),
        WriteBlock(0xC0, &[0x00FF_8080; 4]),
        WriteBlock(ray_base + 2 * 32, &list[..128]),
        WriteBlock(ray_base + 18 * 32, &list[128..]),
        ReadBlock(result_base + 32, &results[8..136]),
        ReadBlock(result_base + 17 * 32, &results[136..144]),
        ReadBlock(result_base, &results[..512]),
        ReadBlock(result_base + 64 * 32, &results[512..]),
    ];
    check(&script, |displace| {
        displace.write_map(&layout, &heights).unwrap();
        displace.write_texture(&layout, &texture).unwrap();
        displace.write_normals_with(&layout, |_, _| 0x00FF_8080).unwrap();
        displace.write_rays(&layout, 2, &rays(18)).unwrap();
        let mut decoded = [RayResult::default(); 17];
        displace.read_results(&layout, 1, &mut decoded).unwrap();
        assert_eq!(
            (decoded[16].texel, decoded[16].steps, decoded[16].status),
            ([17, -18], 17, RayStatus::Hit)
        );
        let mut raw = [[0; 8]; 70];
        displace.read_result_words(&layout, 0, &mut raw).unwrap();
        assert_eq!(raw.as_flattened(), results);
    });
}

fn untouched(result: Result<(), Error<ScriptError>>) -> Cause<ScriptError> {
    let error = result.unwrap_err();
    assert_eq!(error.state, State::Untouched);
    error.cause
}

#[test]
fn guards_come_before_the_first_access() {
    let layout = layout(SIZES);
    let (bytes, words) = ([0; 128], [0; 8]);
    check(&[], |displace| {
        for (first, count) in [(1, 4), (4, 1), (u32::MAX, 1), (5, 0)] {
            let mut results = vec![RayResult::default(); count];
            let mut raw = vec![[0; 8]; count];
            let list = rays(count as u32);
            assert_eq!(untouched(displace.write_rays(&layout, first, &list)), Cause::OutsideBuffer);
            assert_eq!(untouched(displace.read_results(&layout, first, &mut results)), Cause::OutsideBuffer);
            assert_eq!(untouched(displace.read_result_words(&layout, first, &mut raw)), Cause::OutsideBuffer);
        }
        // As many texels, but of another shape.
        let heights = Image::new(Shape::new(4, 2).unwrap(), &bytes[..64]).unwrap();
        assert_eq!(untouched(displace.write_map(&layout, &heights)), Cause::WrongShape);
        let texels = Image::new(Shape::new(2, 0).unwrap(), &words[..4]).unwrap();
        assert_eq!(untouched(displace.write_texture(&layout, &texels)), Cause::WrongShape);
        assert_eq!(untouched(displace.write_normals(&layout, &texels)), Cause::WrongShape);

        let f24 = Capabilities { format: NumberFormat::F24, ..capabilities() };
        let large = Capabilities { memory_bytes: 1 << 20, ..capabilities() };
        for device in [f24, large] {
            let foreign = Layout::packed(&device, SIZES).unwrap();
            let mut asked = 0;
            let heights = displace.write_map_with(&foreign, |_, _| {
                asked += 1;
                0
            });
            assert_eq!(untouched(heights), Cause::ForeignLayout);
            let texels = displace.write_texture_with(&foreign, |_, _| {
                asked += 1;
                0
            });
            assert_eq!((untouched(texels), asked), (Cause::ForeignLayout, 0));
            assert_eq!(untouched(displace.write_normals_with(&foreign, |_, _| 0)), Cause::ForeignLayout);
            assert_eq!(untouched(displace.write_rays(&foreign, 0, &rays(1))), Cause::ForeignLayout);
            assert_eq!(untouched(displace.start(&list(&foreign, 1)).map(|_| ())), Cause::ForeignLayout);
        }
    });
}

#[test]
fn a_start_which_may_not_have_arrived_leaves_the_state_open() {
    let layout = layout(SIZES);
    let accesses = start_list(0x8244);
    for place in 0..accesses.len() {
        let mut script = accesses[..=place].to_vec();
        let Write(offset, value) = script[place] else { panic!() };
        script[place] = FailWrite(offset, value);
        check(&script, |displace| {
            let error = displace.start(&list(&layout, 3)).unwrap_err();
            assert_eq!((error.cause, error.state), (Cause::Bus(ScriptError::Refused), State::Unknown));
            assert_eq!(displace.start(&list(&layout, 3)).unwrap_err().cause, Cause::NotReady);
            assert_eq!(displace.resume().unwrap_err().cause, Cause::NotReady);
        });
    }
}

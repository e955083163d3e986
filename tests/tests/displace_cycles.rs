//! Does a displaced ray take the cycles it should, not one more and not one less?
//!
//! Every number is added up by hand from what is documented: a view calculation of 9 cycles (a raster's: 14) that takes a ray
//! every 3 (5), a loop of 15 stages, an address calculation of 4 cycles every 2, one texel a cycle, a colour of 14 every 4, a
//! line 40 cycles after its request; and a cycle over each link between two of them.

use hostsim::displace::map::HeightMap;
use lucerna_displace::engine::{PortSizes, Sizes};
use lucerna_driver::displace::{Job, Policies, Raster, Ray, RayStatus, Shape, Source};
use lucerna_softfloat::F24;
use lucerna_tests::displaced::{Bench, Ended, FLAT, map, ray};

/// From START to the turn of the first ray: the view calculation, FIFO #0, stage 1 to stage 2.
const FIRST_TURN: u64 = 9 + 1 + 1;
/// From stage 2 of the last step to stage 1 of the next round, where the ray leaves.
const OUT: u64 = 14;
/// From stage 1 to the texture's access: FIFO #1, and the address calculation.
const TO_READ: u64 = 1 + 4;
/// From the normal's access to the result in memory, the cycle of the result included.
const FROM_READ: u64 = 1 + 14 + 1;
const FILL: u64 = 40;

fn sizes(units: u32, latency: u32) -> Sizes {
    Sizes { units, port: PortSizes { latency, ..Sizes::default().port }, ..Sizes::default() }
}

fn run(map: &HeightMap, rays: &[Ray], policies: Policies, unit: Sizes) -> Ended {
    let one = Shape::of(1, 1).expect("one texel");
    Bench::<F24>::sized(map, [one; 2], rays.len(), unit).list(rays, FLAT, policies)
}

fn cycles(map: &HeightMap, rays: &[Ray], policies: Policies, unit: Sizes) -> u64 {
    run(map, rays, policies, unit).counters.cycles
}

/// The step whose line comes `latency` cycles after its first turn: the slot comes round every 15.
fn served(latency: u64) -> u64 {
    latency.div_ceil(15) * 15
}

#[test]
fn a_ray_alone_on_a_flat_map() {
    let down = [ray([0.4, 0.4], [0.0, 0.0])];
    let flat = map(4, &[128; 16]);
    // Levels 2, 1 and 0; all 21 bytes of the pyramid are in one line, which the first of them misses.
    let ended = run(&flat, &down, Policies::OH, Sizes::default());
    let c = ended.counters;
    assert_eq!((c.steps, c.height_misses, c.height_forwards, c.height_hits), (3, 1, 1, 2));
    // Texture and normal are in two lines.
    let shading = TO_READ + FILL + 1 + FILL + FROM_READ;
    let by_hand = FIRST_TURN + served(FILL) + 2 * 15 + OUT + shading;
    assert_eq!((c.cycles, by_hand), (by_hand, 202));
    assert_eq!((c.traverse_busy, c.traverse_waits, c.read_stalls), (3, 3, 2 * (FILL - 1)));
    // Each texel is asked for, and comes with its line.
    assert_eq!((c.view_busy, c.address_busy, c.read_busy, c.colour_busy), (3, 2, 2 * 2, 4));
    assert_eq!((c.port_bytes, c.port_busy, c.result_bytes), (3 * 32, 3 * 4, 32));

    // The start level of a ray straight down is 0: a pass, and one step.
    let ended = run(&flat, &down, Policies::A, Sizes::default());
    let c = ended.counters;
    assert_eq!((c.steps, c.start_passes, c.levels_saved), (1, 1, 2));
    assert_eq!(c.cycles, FIRST_TURN + 15 + served(FILL) + OUT + shading);

    // Two levels down at once.
    let ended = run(&flat, &down, Policies::B, Sizes::default());
    assert_eq!((ended.counters.steps, ended.counters.level_downs), (2, 1));
    assert_eq!(ended.counters.cycles, FIRST_TURN + served(FILL) + 15 + OUT + shading);

    // A map that is one texel, which is as high as can be.
    assert_eq!(cycles(&map(1, &[255]), &down, Policies::MIX, Sizes::default()), by_hand - 2 * 15 + 15);
}

/// A pixel's entry point takes the view calculation five cycles more.
#[test]
fn a_pixel_alone() {
    let flat = map(4, &[128; 16]);
    let one = Shape::of(1, 1).expect("one texel");
    let bench = Bench::<F24>::sized(&flat, [one; 2], 1, Sizes::default());
    let raster = Raster {
        width: 1,
        height: 1,
        origin: [0.0, 0.0, -1.0],
        right: [0.0; 3],
        down: [0.0; 3],
        eye: [0.4, 0.4, 2.0],
        extent: [1.0, 1.0],
    };
    let job = |raster| Job::new(&bench.layout, Source::Raster(raster), FLAT, Policies::OH).expect("a camera");
    let ended = bench.run(&[], &job(raster));
    assert_eq!(ended.results[0].status, RayStatus::Hit);
    assert_eq!((ended.counters.cycles, ended.counters.view_busy), (202 + 5, 5));
    // One that misses is done when its view is: 14 cycles and the one of its result.
    let ended = bench.run(&[], &job(Raster { eye: [1.4, 0.4, 2.0], ..raster }));
    assert_eq!((ended.results[0].status, ended.counters.cycles), (RayStatus::Miss, 15));
}

/// 39 cycles or 40: the read unit goes on when its line is there; a slot of the ring when it comes round next.
#[test]
fn a_fill_is_there_at_its_cycle() {
    let down = [ray([0.4, 0.4], [0.0, 0.0])];
    let flat = map(4, &[128; 16]);
    for latency in [1, 2, 3, 14, 15, 16, 29, 30, 31, 39, 40, 41, 44, 45, 46, 60, 61, 200] {
        let fill = u64::from(latency);
        // A line has the memory's port for four cycles: with a quick memory the normal's waits for the texture's.
        let by_hand =
            FIRST_TURN + served(fill) + 2 * 15 + OUT + TO_READ + (fill + 1).max(4) + fill + FROM_READ;
        assert_eq!(cycles(&flat, &down, Policies::OH, sizes(1, latency)), by_hand, "{latency}");
        assert_eq!(cycles(&flat, &down, Policies::OH, sizes(4, latency)), by_hand, "one ray needs one unit");
    }
}

/// Rays behind one another on a warm cache: the slowest unit's interval each, which is the colour's 4, or a raster's view's 5.
#[test]
fn many_rays_take_the_interval_of_the_slowest_unit() {
    let top = map(1, &[255]);
    let many = |count: usize| vec![ray([0.25, 0.75], [0.1, 0.2]); count];
    let list = |count: usize| cycles(&top, &many(count), Policies::OH, Sizes::default());
    assert_eq!(list(400) - list(300), 100 * 4);

    let one = Shape::of(1, 1).expect("one texel");
    let bench = Bench::<F24>::sized(&top, [one; 2], 400, Sizes::default());
    let raster = |width: u32| {
        let (origin, eye) = ([0.1, 0.2, -1.0], [0.5, 0.5, 2.0]);
        let raster =
            Raster { width, height: 1, origin, right: [0.0; 3], down: [0.0; 3], eye, extent: [0.0; 2] };
        let job = Job::new(&bench.layout, Source::Raster(raster), FLAT, Policies::OH).expect("a camera");
        bench.run(&[], &job).counters.cycles
    };
    assert_eq!(raster(400) - raster(300), 100 * 5);
    // Rays that graze are no further than the view calculation: one every three cycles, a result 9 cycles after the last.
    let grazing = vec![Ray { entry: [0.0; 2], view: [1.0, 0.0, 0.0] }; 100];
    assert_eq!(cycles(&top, &grazing, Policies::OH, Sizes::default()), 99 * 3 + 9 + 1);
    // Thirteen levels: the ring is the slowest, with a step every cycle, and loses none when rays change.
    let plain = map(1 << 12, &vec![0; 1 << 12]);
    let deep =
        |count: usize| run(&plain, &vec![ray([0.5, 0.5], [0.0, 0.0]); count], Policies::OH, Sizes::default());
    let (a, b) = (deep(450), deep(300));
    assert_eq!(b.counters.steps, 300 * 13);
    assert_eq!(a.counters.cycles - b.counters.cycles, 150 * 13);
}

/// Four instances: the same results, in less time; and the port is shared, so not in a quarter.
#[test]
fn instances_share_the_work() {
    let heights: Vec<u8> = (0..4096u32).map(|i| (i.wrapping_mul(0x9e37_79b9) >> 24) as u8).collect();
    let map = map(64, &heights);
    let rays: Vec<Ray> = (0..2000)
        .map(|i| {
            let at = |n: u32| (i * n % 1999) as f32 / 1999.0;
            ray([at(7), at(31)], [at(113) - 0.5, at(57) - 0.5])
        })
        .collect();
    for policies in [Policies::MIX, Policies::TEVS, Policies::FOLD] {
        let ended = [1, 2, 3, 4].map(|units| run(&map, &rays, policies, sizes(units, 40)));
        for pair in ended.windows(2) {
            assert!(pair[0].results == pair[1].results, "the same bits");
            assert_eq!(pair[0].counters.steps, pair[1].counters.steps);
            assert!(pair[0].counters.cycles > pair[1].counters.cycles);
        }
        let [one, .., four] = ended.map(|ended| ended.counters.cycles);
        assert!(one > 2 * four && one < 5 * four, "{one} and {four}");
    }
}

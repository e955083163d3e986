//! Does a ray of any coordinates end, and in the right texel: repeats that are no powers of two, below 0, far away, no numbers?

use hostsim::displace::ray::Surface;
use hostsim::displace::view::View;
use hostsim::displace::workload::TANGENT_ROWS;
use hostsim::format::{HostF24, HostF32, HostF64};
use hostsim::oracle::{Bits24, Number, Pinhole, Tangent};
use lucerna_driver::displace::{Frame, Job, Policies, Raster, Ray, RayStatus, Source, Wrap};
use lucerna_softfloat::{F24, F32, Format};
use lucerna_tests::displaced::{
    Bench, FLAT, agrees, algorithms, columns, fixtures, frame, map, pixels, ray, records, rounded,
};
use lucerna_tests::random::Rng;

/// Rays whose texel is another than the march's (and who is not in a corner), of how many.
fn mismatches<F: Format, N: Number>(
    bench: &Bench<F>,
    columns: &hostsim::oracle::Columns<'_>,
    (rays, frame): (&[Ray], Frame),
    policies: Policies,
) -> (usize, usize) {
    let ended = bench.list(rays, frame, policies);
    assert_eq!(ended.counters.watchdogs, 0, "{policies:?}");
    let exact = rounded::<N>(&frame, rays);
    let pairs = ended.results.iter().zip(&exact);
    let wrong = pairs.filter(|(result, ray)| {
        let (entry, direction) = ray.expect("all of them come down");
        let column = columns.march(entry, direction);
        !agrees(result, &column) && !column.corner
    });
    (wrong.count(), rays.len())
}

#[test]
fn any_repeat_is_traversed_exactly() {
    let mut worst = 0.0f64;
    for (map, surface) in fixtures().into_iter().skip(1).step_by(3) {
        let columns = columns(&map, Wrap::Repeat);
        let f64 = Bench::<HostF64>::new(&map, 4000);
        let f24 = Bench::<HostF24>::new(&map, 4000);
        for repeat in [3.0, 5.0, 2.5] {
            let surface = Surface { repeat, ..surface };
            let frame = frame(&surface);
            for view in [View::FRONT, View::oblique()] {
                let rays = records(&pixels(&surface, &view, (64, 48)));
                for (name, policies) in algorithms().into_iter().step_by(3) {
                    let context = format!("{} x{repeat} {name}", map.name());
                    let (wrong, of) = mismatches::<_, f64>(&f64, &columns, (&rays, frame), policies);
                    assert!(wrong == 0 && of > 2000, "{context}: {wrong} of {of}");
                    let (wrong, of) = mismatches::<_, Bits24>(&f24, &columns, (&rays, frame), policies);
                    worst = worst.max(wrong as f64 / of as f64);
                }
            }
        }
    }
    println!("F24: at worst {:.3} % of a picture's rays end in another texel", 100.0 * worst);
    assert!(worst < 0.003, "{worst}");
}

/// A camera's own rays, the surface ending at a repeat that is no whole number: a miss is just what lies beyond.
#[test]
fn a_raster_ends_where_its_extent_does() {
    fn check<F: Format, N: Number>(repeat: f64, view: &View) -> [u32; 2] {
        let (map, surface) = fixtures().swap_remove(5);
        let surface = Surface { repeat, ..surface };
        let f32s = |v: [f64; 3]| v.map(|x| x as f32);
        let pixels = view.raster(72, 54);
        let vectors = [f32s(pixels.origin), f32s(pixels.right), f32s(pixels.down)];
        let (eye, extent) = (f32s(surface.eye(view)), [repeat as f32; 2]);
        let [origin, right, down] = vectors;
        let raster = Raster { width: 72, height: 54, origin, right, down, eye, extent };
        let bench = Bench::<F>::new(&map, 72 * 54);
        let job = Job::new(&bench.layout, Source::Raster(raster), frame(&surface), Policies::MIX)
            .expect("a camera");
        let ended = bench.run(&[], &job);
        let tangent = Tangent::<N>::new(TANGENT_ROWS, surface.scale as f32);
        let pinhole = Pinhole::<N>::new(vectors, eye);
        let columns = columns(&map, Wrap::Repeat);
        let mut counts = [0; 2];
        for (pixel, result) in (0..).zip(&ended.results) {
            let ray = tangent.of_pixel(&pinhole, pixel % 72, pixel / 72);
            let inside = |entry: [f64; 2]| entry.iter().all(|at| (0.0..repeat).contains(at));
            match ray.filter(|(entry, _)| inside(*entry)) {
                None => assert_eq!((result.status, result.steps), (RayStatus::Miss, 0), "pixel {pixel}"),
                Some((entry, direction)) => {
                    assert_eq!(result.status, RayStatus::Hit, "pixel {pixel} at {entry:?}");
                    counts[0] += 1;
                    counts[1] += u32::from(!agrees(result, &columns.march(entry, direction)));
                }
            }
        }
        counts
    }
    for repeat in [3.0, 5.0, 2.5] {
        for view in [View::FRONT, View::oblique(), View::random(11)] {
            let [hits, wrong] = check::<HostF64, f64>(repeat, &view);
            assert!(hits > 300 && wrong == 0, "{repeat}: {wrong} of {hits}");
            let [hits, wrong] = check::<HostF24, Bits24>(repeat, &view);
            println!("x{repeat}: {wrong} of {hits}");
            assert!(hits > 300 && wrong * 300 < hits, "{repeat}: {wrong} of {hits} in F24");
        }
    }
}

fn tiles(rng: &mut Rng, offset: f32) -> Vec<Ray> {
    let mut real = |low, high| rng.real(low, high);
    (0..300)
        .map(|_| {
            ray([offset + real(-2.0, 2.0), -offset + real(-2.0, 2.0)], [real(-0.7, 0.7), real(-0.7, 0.7)])
        })
        .collect()
}

/// Below 0 as above, and as far as 1000 tiles away, where a texel is less than the last bit of an F24: what is rounded is the
/// way from the entry and not the place on the map (P24), so the ray of the rounded entry is followed as well as any.
#[test]
fn below_zero_and_far_away() {
    let mut rng = Rng(3);
    let mut wrong = [[0; 3]; 4];
    let mut of = [0; 4];
    for (number, (map, _)) in fixtures().into_iter().enumerate() {
        let columns = columns(&map, Wrap::Repeat);
        let f64 = Bench::<HostF64>::new(&map, 300);
        let (f32, f24) = (Bench::<HostF32>::new(&map, 300), Bench::<HostF24>::new(&map, 300));
        for (place, offset) in [0.0, -4.0, 37.0, -1000.0].into_iter().enumerate() {
            let rays = (&tiles(&mut rng, offset)[..], FLAT);
            for (_, policies) in algorithms().into_iter().skip(number % 4).step_by(4) {
                let found = [
                    mismatches::<_, f64>(&f64, &columns, rays, policies),
                    mismatches::<_, f32>(&f32, &columns, rays, policies),
                    mismatches::<_, Bits24>(&f24, &columns, rays, policies),
                ];
                of[place] += rays.0.len();
                (0..3).for_each(|format| wrong[place][format] += found[format].0);
            }
        }
    }
    println!("other texels in f64, f32, F24: {wrong:?} of {of:?}");
    for (wrong, of) in wrong.iter().zip(of) {
        assert_eq!(wrong[0], 0, "in f64 there is no excuse");
        assert!(wrong[1] * 5000 < of && wrong[2] * 300 < of, "{wrong:?} of {of}");
    }
}

/// What no host should write: everything that is a number of a kind of its own.
const ODD: [f32; 15] = [
    0.0,
    -0.0,
    0.25,
    -0.75,
    1.0,
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MIN_POSITIVE,
    1e-40,
    -1e-44,
    3e-24,
    1e-7,
    1e4,
    -300.0,
];

/// Ends every job with a status of the map for every ray, in as many steps as the watchdog allows.
fn odd_results<F: Format>(rays: &[Ray], policies: Policies) -> Vec<[u32; 8]> {
    let heights: Vec<u8> = (0..64u32).map(|i| (i.wrapping_mul(0x9e37_79b9) >> 24) as u8).collect();
    let bench = Bench::<F>::new(&map(8, &heights), rays.len());
    let job =
        Job::new(&bench.layout, Source::List { count: rays.len() as u32 }, FLAT, policies).expect("a list");
    let ended = bench.run(rays, &job.with_watchdog(200).expect("enough"));
    for (ray, result) in rays.iter().zip(&ended.results) {
        let downwards = ray.view[2] < 0.0;
        match result.status {
            RayStatus::Grazing => {}
            RayStatus::Hit | RayStatus::Miss => assert!(downwards && result.steps > 0, "{ray:?} {result:?}"),
            RayStatus::Watchdog => {
                // Direction of a tile a step and more, or no number at all.
                let slopes = [ray.view[0] / ray.view[2], ray.view[1] / ray.view[2]];
                let far = ray.entry.iter().any(|at| !at.is_finite())
                    || slopes.iter().any(|s| s.is_nan() || s.abs() >= 10.0);
                assert!(far && result.steps == 200, "{ray:?} {result:?}");
            }
            RayStatus::Unknown(_) => panic!("{ray:?} {result:?}"),
        }
    }
    let mut lucerna =
        lucerna_driver::Lucerna::probe(bench.model.bus(), bench.model.delay()).expect("a device");
    let mut words = vec![[0; 8]; rays.len()];
    lucerna.displace().expect("a unit").read_result_words(&bench.layout, 0, &mut words).expect("results");
    words
}

#[test]
fn what_is_no_number_ends_too() {
    let mut rng = Rng(11);
    let mut odd = || ODD[rng.below(ODD.len() as u32) as usize];
    let mut rays: Vec<Ray> =
        (0..500).map(|_| Ray { entry: [odd(), odd()], view: [odd(), odd(), -odd()] }).collect();
    rays.extend((0..200).map(|_| ray([odd(), odd()], [odd(), odd()])));
    for (name, policies) in algorithms() {
        for wrap in [Wrap::Repeat, Wrap::Border] {
            let policies = policies.with_wrap(wrap);
            // The host's arithmetic and the soft one give the same bits of everything.
            assert!(odd_results::<F24>(&rays, policies) == odd_results::<HostF24>(&rays, policies), "{name}");
            assert!(odd_results::<F32>(&rays, policies) == odd_results::<HostF32>(&rays, policies), "{name}");
            odd_results::<HostF64>(&rays, policies);
        }
    }
}

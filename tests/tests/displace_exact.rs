//! Does every algorithm find the texel that a march through every column finds, in as many steps as it should?
//!
//! Built-in maps, the paper's views and random ones, through driver and device. In f64 there is no excuse but a ray that goes
//! exactly through a corner; in F24 rounding turns a few rays in ten thousand aside.

use hostsim::displace::rules::rules;
use hostsim::displace::view::View;
use hostsim::format::{HostF24, HostF32, HostF64};
use hostsim::oracle::{Bits24, Column, Number, Pyramid, RoundedRay};
use lucerna_driver::displace::{Policies, Ray, RayStatus, Wrap};
use lucerna_softfloat::Format;
use lucerna_tests::displaced::{
    Bench, Ended, agrees, algorithms, columns, fixtures, frame, pixels, records, rounded,
};

type Size = (u32, u32);

/// The paper's views, and one from close by. Few pixels of the grazing view meet the grid.
fn views() -> [(&'static str, View, Size); 4] {
    [
        ("front", View::FRONT, (108, 81)),
        ("oblique", View::oblique(), (108, 81)),
        ("grazing", View::grazing(), (400, 300)),
        ("close", View::turned([31.0, 4.5, -60.0], -72.0, -21.0), (108, 81)),
    ]
}

/// What became of some rays.
#[derive(Clone, Copy, Default, Debug)]
struct Tally {
    rays: usize,
    corners: usize,
    others: usize,
}

impl Tally {
    fn add(&mut self, other: Self) {
        self.rays += other.rays;
        self.corners += other.corners;
        self.others += other.others;
    }

    fn agreement(&self) -> f64 {
        100.0 * (1.0 - (self.corners + self.others) as f64 / self.rays as f64)
    }
}

/// Holds results against the march of the same rays.
fn tally(ended: &Ended, marched: &[Option<Column>]) -> Tally {
    let mut tally = Tally::default();
    for (result, column) in ended.results.iter().zip(marched) {
        let Some(column) = column else {
            assert_eq!(result.status, RayStatus::Grazing);
            continue;
        };
        assert_eq!(result.status, RayStatus::Hit, "a map that repeats is hit by every ray: {result:?}");
        tally.rays += 1;
        if !agrees(result, column) {
            *if column.corner { &mut tally.corners } else { &mut tally.others } += 1;
        }
    }
    tally
}

/// Every map, view and algorithm on a device of format `F`, whose arithmetic is `N`'s.
fn everywhere<F: Format, N: Number>(mut judge: impl FnMut(&str, &Cell<'_>)) {
    for (map, surface) in fixtures() {
        let columns = columns(&map, Wrap::Repeat);
        let bench = Bench::<F>::new(&map, 10_000);
        let pyramid = Pyramid::new(map.log2(), map.heights(), true);
        for (view, camera, size) in views() {
            let rays = records(&pixels(&surface, &camera, size));
            assert!(rays.len() > 3000, "{} {view}: {} rays", map.name(), rays.len());
            let exact = rounded::<N>(&frame(&surface), &rays);
            let marched: Vec<Option<Column>> = exact
                .iter()
                .map(|ray| ray.map(|(entry, direction)| columns.march(entry, direction)))
                .collect();
            for (name, policies) in algorithms() {
                let ended = bench.list(&rays, frame(&surface), policies);
                assert_eq!(ended.counters.watchdogs, 0);
                let cell = format!("{} {view} {name}", map.name());
                judge(
                    &cell,
                    &Cell { policies, ended: &ended, marched: &marched, exact: &exact, pyramid: &pyramid },
                );
            }
        }
    }
}

struct Cell<'a> {
    policies: Policies,
    ended: &'a Ended,
    marched: &'a [Option<Column>],
    exact: &'a [Option<RoundedRay>],
    pyramid: &'a Pyramid,
}

#[test]
fn in_f64_every_texel_is_that_of_the_march_and_every_step_is_counted() {
    let (mut all, mut steps) = (Tally::default(), 0);
    everywhere::<HostF64, f64>(|name, cell| {
        let tally = tally(cell.ended, cell.marched);
        assert_eq!(tally.others, 0, "{name}: hit another texel, and not at a corner");
        all.add(tally);
        let rules = rules(&cell.policies);
        let mut crossings = 0;
        for (result, ray) in cell.ended.results.iter().zip(cell.exact) {
            let Some((entry, direction)) = ray else { continue };
            let walk = cell.pyramid.walk(&rules, *entry, *direction);
            assert_eq!(u32::from(result.steps), walk.steps, "{name}: {result:?} {walk:?}");
            steps += u64::from(walk.steps);
            crossings += u64::from(walk.crossings);
        }
        assert_eq!(cell.ended.counters.crossings, crossings, "{name}");
    });
    println!("f64: {all:?}, {steps} steps as the oracle's");
    assert!(all.rays > 3_000_000, "{all:?}");
    assert!(all.corners * 20_000 < all.rays, "corners are rare: {all:?}");
}

/// Over everything, and in the worst picture: on a flat map seen aslant a rounded way to the bottom is the next texel's.
#[test]
fn in_f24_nearly_every_texel_is_that_of_the_march() {
    let mut cells: Vec<(String, Tally)> = Vec::new();
    everywhere::<HostF24, Bits24>(|name, cell| {
        cells.push((name.to_owned(), tally(cell.ended, cell.marched)));
    });
    let mut all = Tally::default();
    cells.iter().for_each(|(_, tally)| all.add(*tally));
    cells.sort_by(|a, b| a.1.agreement().total_cmp(&b.1.agreement()));
    println!("F24: {:.4} % of {all:?}; worst of {} cells:", all.agreement(), cells.len());
    for (name, tally) in &cells[..12] {
        println!("  {:.4} % {name} {tally:?}", tally.agreement());
    }
    // 99.85 was asked for; P24 is worth the rest, and this is how its loss would be seen.
    assert!(all.agreement() >= 99.95, "{all:?}");
    assert!(cells[0].1.agreement() >= 99.8, "{:?}", cells[0]);
}

/// 200 random views of every map, each by one of the algorithms in turn.
fn at_random<F: Format, N: Number>(size: Size) -> Tally {
    let mut all = Tally::default();
    let algorithms = algorithms();
    for (number, (map, surface)) in fixtures().into_iter().enumerate() {
        let columns = columns(&map, Wrap::Repeat);
        let bench = Bench::<F>::new(&map, (size.0 * size.1) as usize);
        for view in 0..200 {
            let rays: Vec<Ray> = records(&pixels(&surface, &View::random(view), size));
            if rays.is_empty() {
                continue;
            }
            let (name, policies) = &algorithms[(view as usize + number) % algorithms.len()];
            let ended = bench.list(&rays, frame(&surface), *policies);
            assert_eq!(ended.counters.watchdogs, 0, "{} view {view} {name}", map.name());
            let marched: Vec<_> = rounded::<N>(&frame(&surface), &rays)
                .into_iter()
                .map(|ray| ray.map(|(entry, direction)| columns.march(entry, direction)))
                .collect();
            all.add(tally(&ended, &marched));
        }
    }
    println!("{}: {:.4} % of {all:?}", F::NAME, all.agreement());
    all
}

#[test]
fn no_random_view_loops_or_skips() {
    let f24 = at_random::<HostF24, Bits24>((20, 15));
    assert!(f24.rays > 200_000 && f24.agreement() >= 99.95, "{f24:?}");
    let f32 = at_random::<HostF32, f32>((16, 12));
    assert!(f32.rays > 100_000 && f32.agreement() >= 99.99, "{f32:?}");
    let f64 = at_random::<HostF64, f64>((16, 12));
    assert_eq!(f64.others, 0, "{f64:?}");
}

//! Do rays that lie on edges, start on them, go through corners, leave the map or come from outside end where they should?
//!
//! Heights are 0 and 255, coordinates and directions few-bit fractions: every product, sum and quotient is exact in every
//! format, so nothing is excused by rounding. Only in a corner, or where a ray comes down just as it leaves a column, may it be in
//! either of two.

use hostsim::displace::map::HeightMap;
use hostsim::format::{HostF24, HostF32, HostF64};
use lucerna_driver::displace::{Policies, Ray, RayResult, RayStatus, Wrap};
use lucerna_softfloat::{F24, Format};
use lucerna_tests::displaced::{Bench, FLAT, agrees, algorithms, columns, map, ray};
use lucerna_tests::random::Rng;

/// Sides, square or not, down to one texel.
const SIDES: [[u32; 2]; 11] =
    [[1, 1], [1, 8], [8, 1], [2, 1], [1, 2], [2, 2], [4, 4], [16, 4], [2, 32], [8, 8], [32, 32]];

/// Pillars as high as the map's depth, on the bottom.
fn pillars(rng: &mut Rng, [width, height]: [u32; 2]) -> HeightMap {
    let one_in = 2 + rng.below(12);
    map(width, &(0..width * height).map(|_| 255 * u8::from(rng.once_in(one_in))).collect::<Vec<_>>())
}

/// A coordinate: mostly on the map or the next ones, sometimes far away; often on an edge, on an edge of the map, or -0.
fn coordinate(rng: &mut Rng) -> f32 {
    let near = |rng: &mut Rng| (rng.below(6 * 32 + 1) as f32 - 96.0) / 32.0;
    match rng.below(12) {
        0 => -0.0,
        1 => 0.0,
        2 => rng.below(5) as f32 - 2.0,
        3 => 500.0 + near(rng),
        4 => -500.0 + near(rng),
        _ => near(rng),
    }
}

/// A power of two, so that it divides exactly; 0 and -0 as well.
fn slope(rng: &mut Rng) -> f32 {
    let size = [0.0, 0.0, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0][rng.below(8) as usize];
    if rng.once_in(2) { size } else { -size }
}

fn random_rays(rng: &mut Rng, count: u32) -> Vec<Ray> {
    (0..count)
        .map(|_| {
            let (entry, direction) = ([0; 2].map(|_: u32| coordinate(rng)), [0; 2].map(|_: u32| slope(rng)));
            match rng.below(4) {
                // Into both axes at once: through corners, if it starts on one.
                0 => ray([entry[0]; 2], [direction[0]; 2]),
                1 => ray([entry[0], -entry[0]], [direction[0], -direction[0]]),
                _ => ray(entry, direction),
            }
        })
        .collect()
}

/// Every column in which an exact ray may end: through a corner it may go on either side or straight on, and where it comes
/// down on a top just as it leaves the column, it may stay or go on. What is decided there depends on the level.
fn ways(map: &HeightMap, wrap: Wrap, ray: &Ray) -> Vec<[i64; 2]> {
    let sides = [map.width(), map.height()].map(f64::from);
    let (entry, direction) = (ray.entry.map(f64::from), [ray.view[0], ray.view[1]].map(f64::from));
    let beyond = |texel: [i64; 2]| {
        wrap == Wrap::Border && (0..2).any(|axis| !(0..sides[axis] as i64).contains(&texel[axis]))
    };
    let mut open = vec![([0, 1].map(|axis| (entry[axis] * sides[axis]).floor() as i64), 0.0f64)];
    let mut seen = Vec::new();
    let mut ends = Vec::new();
    while let Some((texel, entered)) = open.pop() {
        if seen.contains(&(texel, entered.to_bits())) {
            continue;
        }
        seen.push((texel, entered.to_bits()));
        let height = if beyond(texel) { 0 } else { map.at(texel[0] as u32, texel[1] as u32) };
        let depth = f64::from(255 - height) / 255.0;
        let leaves = [0, 1].map(|axis| match direction[axis] {
            0.0 => f64::INFINITY,
            d => (((texel[axis] + i64::from(d > 0.0)) as f64 / sides[axis] - entry[axis]) / d).max(entered),
        });
        let out = leaves[0].min(leaves[1]);
        if depth <= out {
            ends.push(texel);
        }
        if depth < out {
            continue;
        }
        let ahead = direction.map(|d| if d > 0.0 { 1 } else { -1 });
        let [x, y] = leaves.map(|leave| leave == out);
        let next = [(x, [ahead[0], 0]), (y, [0, ahead[1]]), (x && y, ahead)];
        open.extend(
            next.into_iter().filter(|(may, _)| *may).map(|(_, [x, y])| ([texel[0] + x, texel[1] + y], out)),
        );
    }
    ends
}

#[derive(Default, Debug)]
struct Seen {
    rays: u32,
    misses: u32,
    walls: u32,
    corners: u32,
    either: u32,
}

/// All algorithms on a device of one format, against the exact march of the same numbers.
fn compare<F: Format>(map: &HeightMap, rays: &[Ray], wrap: Wrap, seen: &mut Seen) {
    let columns = columns(map, wrap);
    let bench = Bench::<F>::new(map, rays.len());
    for (name, policies) in algorithms() {
        let ended = bench.list(rays, FLAT, policies.with_wrap(wrap));
        assert_eq!(ended.counters.watchdogs, 0);
        for (ray, result) in rays.iter().zip(&ended.results) {
            let [x, y, _] = ray.view.map(f64::from);
            let column = columns.march(ray.entry.map(f64::from), [x, y]);
            seen.rays += 1;
            seen.misses += u32::from(column.missed);
            seen.walls += u32::from(column.wall);
            seen.corners += u32::from(column.corner);
            if agrees(result, &column) {
                assert!(column.missed || f64::from(result.t) == column.t, "{ray:?} {result:?} {column:?}");
                continue;
            }
            let context = format!("{} {name} {wrap:?} {ray:?} on {map:?}: {result:?}, {column:?}", F::NAME);
            assert!(column.corner, "{context}");
            let ends = ways(map, wrap, ray);
            assert!(ends.contains(&result.texel.map(i64::from)), "{context}, {ends:?}");
            seen.either += 1;
        }
    }
}

#[test]
fn exact_rays_end_where_the_march_says_in_every_format() {
    let mut rng = Rng(7);
    let mut seen = Seen::default();
    for sides in SIDES {
        for _ in 0..3 {
            let map = pillars(&mut rng, sides);
            let rays = random_rays(&mut rng, 120);
            for wrap in [Wrap::Repeat, Wrap::Border] {
                compare::<HostF64>(&map, &rays, wrap, &mut seen);
                compare::<HostF32>(&map, &rays, wrap, &mut seen);
                compare::<HostF24>(&map, &rays, wrap, &mut seen);
                compare::<F24>(&map, &rays, wrap, &mut seen);
            }
        }
    }
    println!("{seen:?}");
    assert!(seen.misses > 10_000 && seen.walls > 10_000 && seen.corners > 10_000, "{seen:?}");
    assert!(seen.either * 20 < seen.rays, "{seen:?}");
}

/// One ray on every algorithm, which must all agree; gives what they agree on.
fn one(map: &HeightMap, ray: Ray, wrap: Wrap) -> RayResult {
    let bench = Bench::<F24>::new(map, 1);
    let mut agreed = None;
    for (name, policies) in algorithms() {
        let result = bench.list(&[ray], FLAT, policies.with_wrap(wrap)).results[0];
        let RayResult { status, texel, t, position, .. } = result;
        let seen = (status, texel, t, position);
        assert_eq!(*agreed.get_or_insert(seen), seen, "{name} {ray:?}");
    }
    bench.list(&[ray], FLAT, Policies::OH.with_wrap(wrap)).results[0]
}

#[test]
fn flat_maps() {
    for sides in SIDES {
        let texels = (sides[0] * sides[1]) as usize;
        let levels = sides[0].max(sides[1]).ilog2();
        for (entry, direction) in
            [([0.375, 0.625], [0.0, 0.0]), ([-0.625, 5.125], [0.25, -0.125]), ([0.0, -0.0], [0.0; 2])]
        {
            let floor = |at: [f32; 2]| [0, 1].map(|axis| (at[axis] * sides[axis] as f32).floor() as i32);
            // As high as can be: there at once, whatever the direction; a level a step.
            let top = one(&map(sides[0], &vec![255; texels]), ray(entry, direction), Wrap::Repeat);
            assert_eq!((top.status, top.texel, top.t), (RayStatus::Hit, floor(entry), 0.0));
            assert_eq!((u32::from(top.steps), u32::from(top.level)), (levels + 1, levels));
            assert_eq!(top.position, entry.map(|x| x + 0.0));
            // As deep as can be.
            let bottom = one(&map(sides[0], &vec![0; texels]), ray(entry, direction), Wrap::Repeat);
            let end = [entry[0] + direction[0], entry[1] + direction[1]];
            assert_eq!((bottom.status, bottom.texel, bottom.t), (RayStatus::Hit, floor(end), 1.0));
            assert_eq!(bottom.position, end);
        }
    }
}

#[test]
fn walls_edges_and_corners_by_hand() {
    let wall = map(4, &[0, 255, 0, 0]);
    let hit = |map: &HeightMap, entry, direction, wrap| {
        let result = one(map, ray(entry, direction), wrap);
        (result.status, result.texel, result.t, result.position)
    };
    let repeat = |map: &HeightMap, entry, direction| hit(map, entry, direction, Wrap::Repeat);
    let border = |map: &HeightMap, entry, direction| hit(map, entry, direction, Wrap::Border);
    use RayStatus::{Hit, Miss};
    // Into the column's side, below its top: from the left, from the right, from the tile before.
    assert_eq!(repeat(&wall, [0.125, 0.5], [0.5, 0.0]), (Hit, [1, 0], 0.25, [0.25, 0.5]));
    assert_eq!(repeat(&wall, [0.75, 0.5], [-0.5, 0.0]), (Hit, [1, 0], 0.5, [0.5, 0.5]));
    assert_eq!(repeat(&wall, [-0.375, 0.5], [-0.25, -0.25]), (Hit, [-3, 0], 0.5, [-0.5, 0.375]));
    // A start on its edge: on the column, or just before it, looking at it or away.
    assert_eq!(repeat(&wall, [0.25, 0.5], [0.5, 0.0]), (Hit, [1, 0], 0.0, [0.25, 0.5]));
    assert_eq!(repeat(&wall, [0.25, 0.5], [-0.125, 0.0]), (Hit, [1, 0], 0.0, [0.25, 0.5]));
    assert_eq!(repeat(&wall, [0.5, 0.5], [-0.125, 0.0]), (Hit, [1, 0], 0.0, [0.5, 0.5]));
    assert_eq!(repeat(&wall, [0.5, 0.5], [0.125, 0.0]), (Hit, [2, 0], 1.0, [0.625, 0.5]));
    // Along the edge of two rows it is in the second.
    let rows = map(2, &[0, 0, 0, 255, 0, 0, 0, 0]);
    for zero in [0.0, -0.0] {
        assert_eq!(repeat(&rows, [0.25, 0.25], [1.0, zero]), (Hit, [1, 1], 0.25, [0.5, 0.25]));
        assert_eq!(repeat(&rows, [0.25, 0.5], [0.5, zero]), (Hit, [1, 2], 1.0, [0.75, 0.5]));
    }
    // Through the corner of four: x goes first (P13), so the wall of the texel on the side is met, and not the one ahead.
    let side = map(2, &[0, 255, 0, 0]);
    assert_eq!(repeat(&side, [0.25, 0.25], [0.5, 0.5]), (Hit, [1, 0], 0.5, [0.5, 0.5]));
    let below = map(2, &[0, 0, 255, 0]);
    assert_eq!(repeat(&below, [0.25, 0.25], [0.5, 0.5]), (Hit, [1, 1], 1.0, [0.75, 0.75]));
    let ahead = map(2, &[0, 0, 0, 255]);
    assert_eq!(repeat(&ahead, [0.25, 0.25], [0.5, 0.5]), (Hit, [1, 1], 0.5, [0.5, 0.5]));
    assert_eq!(repeat(&ahead, [0.25, 0.25], [-0.5, -0.5]), (Hit, [-1, -1], 0.5, [0.0, 0.0]));
    // Beyond the border there is nothing to hit; from there the map's sides can be.
    assert_eq!(border(&wall, [0.875, 0.5], [0.25, 0.0]).0, Miss);
    assert_eq!(border(&wall, [0.125, 0.5], [0.0, -1.0]).0, Miss);
    assert_eq!(border(&wall, [-0.25, 0.5], [0.0, 0.0]).0, Miss);
    assert_eq!(border(&wall, [1.0, 0.5], [0.0, 0.0]).0, Miss, "the last edge is not the map's");
    assert_eq!(border(&wall, [0.0, 0.5], [0.0, 0.0]), (Hit, [0, 0], 1.0, [0.0, 0.5]));
    assert_eq!(border(&wall, [0.25, -0.5], [0.0, 2.0]), (Hit, [1, 0], 0.25, [0.25, 0.0]));
    assert_eq!(border(&wall, [2.25, 0.5], [-2.0, 0.0]), (Hit, [1, 0], 0.875, [0.5, 0.5]));
    assert_eq!(border(&wall, [1.25, 0.5], [-0.5, 0.0]), (Hit, [3, 0], 1.0, [0.75, 0.5]));
}

/// A map of one texel is hit by everything, at its depth; the texel's number says in which repetition.
#[test]
fn one_texel_is_a_plain() {
    let depth = |height: u8| f32::from(255 - height) / 255.0;
    for height in [0, 51, 128, 255] {
        let plain = map(1, &[height]);
        for (entry, direction) in
            [([0.5, 0.5], [0.0, 0.0]), ([-7.5, 3.25], [0.0, 20.0]), ([0.5, 0.5], [-3.75, 60.25])]
        {
            let result = one(&plain, ray(entry, direction), Wrap::Repeat);
            let end = [0, 1].map(|axis| entry[axis] + direction[axis] * depth(height));
            assert_eq!((result.status, result.texel), (RayStatus::Hit, end.map(|x| x.floor() as i32)));
            assert!((result.t - depth(height)).abs() < 1e-5);
        }
    }
}

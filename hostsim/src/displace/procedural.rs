//! Built-in maps; in: a name, out: heights and colours, always the same; cost: some noise a texel.
//!
//! From one height everywhere to one by chance in every texel: how far neighbours are alike decides what a pyramid saves.
//! All repeat without a seam.

use std::f64::consts::TAU;

use super::map::HeightMap;
use super::noise::{Random, lattice, smooth};

/// Texels along each side.
const SIDE: u32 = 256;

/// A map's colour where its height is 0, and where it is 255.
type Colours = [[u8; 3]; 2];

/// A built-in map.
struct BuiltIn {
    name: &'static str,
    colours: Colours,
    heights: fn() -> Vec<f64>,
}

/// From most to least alike neighbours.
const BUILT_IN: [BuiltIn; 9] = [
    BuiltIn { name: "flat", colours: [[120, 120, 120], [120, 120, 120]], heights: flat },
    BuiltIn { name: "pillars", colours: [[54, 44, 40], [206, 190, 160]], heights: pillars },
    BuiltIn { name: "waves", colours: [[10, 40, 90], [150, 200, 220]], heights: waves },
    BuiltIn { name: "bricks", colours: [[150, 145, 135], [165, 80, 55]], heights: bricks },
    BuiltIn { name: "maze", colours: [[70, 60, 50], [90, 140, 80]], heights: maze },
    BuiltIn { name: "craters", colours: [[70, 66, 62], [190, 182, 170]], heights: craters },
    BuiltIn { name: "pebbles", colours: [[40, 34, 30], [176, 164, 150]], heights: pebbles },
    BuiltIn { name: "ridges", colours: [[60, 74, 46], [232, 230, 226]], heights: ridges },
    BuiltIn { name: "noise", colours: [[30, 30, 60], [240, 220, 160]], heights: noise },
];

/// Their names.
pub fn names() -> Vec<&'static str> {
    BUILT_IN.iter().map(|map| map.name).collect()
}

/// The map of this name, if there is one.
pub fn map(name: &str) -> Option<HeightMap> {
    let built_in = BUILT_IN.iter().find(|map| map.name == name)?;
    let heights =
        (built_in.heights)().into_iter().map(|h| (h.clamp(0.0, 1.0) * 255.0).round() as u8).collect();
    Some(HeightMap::new(name, SIDE, SIDE, heights).expect("a power of two, and a height a texel"))
}

/// Colours `0x00RRGGBB` of a map, texel by texel: by height, speckled. Files have the colours of pebbles.
pub fn texture(map: &HeightMap) -> Vec<u32> {
    let named = BUILT_IN.iter().find(|built_in| built_in.name == map.name());
    let colours = named.map_or([[52, 44, 38], [214, 200, 180]], |built_in| built_in.colours);
    let texel = |(i, height): (usize, &u8)| {
        let (x, y) = (i as u32 & (map.width() - 1), i as u32 >> map.log2()[0]);
        let shade = 0.9 + 0.2 * lattice(11, x, y);
        let at = f64::from(*height) / 255.0;
        (0..3).fold(0, |word, c| {
            let [low, high] = colours.map(|colour| f64::from(colour[c]));
            word << 8 | (((low + (high - low) * at) * shade).clamp(0.0, 255.0) as u32)
        })
    };
    map.heights().iter().enumerate().map(texel).collect()
}

/// A height for every texel, from its centre in 0 to 1.
fn each(mut height: impl FnMut(f64, f64) -> f64) -> Vec<f64> {
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
    let mut heights = Vec::with_capacity((SIDE * SIDE) as usize);
    for y in 0..SIDE {
        heights.extend((0..SIDE).map(|x| height(at(x), at(y))));
    }
    heights
}

fn flat() -> Vec<f64> {
    each(|_, _| 0.5)
}

/// Square pillars of four heights.
fn pillars() -> Vec<f64> {
    each(|x, y| {
        let (column, row) = ((x * 8.0) as u32, (y * 8.0) as u32);
        let inside = |t: f64| (0.2..0.8).contains(&(t * 8.0).fract());
        let height = 0.4 + 0.2 * (lattice(5, column, row) * 4.0).floor();
        if inside(x) && inside(y) { height } else { 0.1 }
    })
}

fn waves() -> Vec<f64> {
    each(|x, y| {
        let long = (TAU * (3.0 * x + y)).sin() + 0.7 * (TAU * (x - 4.0 * y)).sin();
        0.5 + 0.22 * long + 0.06 * (TAU * (9.0 * x + 5.0 * y)).sin()
    })
}

/// A running bond, rough.
fn bricks() -> Vec<f64> {
    each(|x, y| {
        let row = (y * 8.0) as u32;
        let along = x * 4.0 + 0.5 * f64::from(row & 1);
        let (u, v) = (along.fract() * 2.0, (y * 8.0).fract());
        let joint = u.min(2.0 - u).min(v).min(1.0 - v);
        let brick = 0.72 + 0.2 * lattice(3, along as u32 & 3, row);
        let rough = 0.08 * (smooth(4, x, y, 64) - 0.5);
        0.15 + (brick - 0.15) * ((joint - 0.05) / 0.06).clamp(0.0, 1.0) + rough
    })
}

/// Walls of a spanning tree of 32×32 cells, grown from one cell at a time.
fn maze() -> Vec<f64> {
    const CELLS: u32 = 32;
    let mut open = vec![false; (4 * CELLS * CELLS) as usize];
    let place = |x: u32, y: u32| (y % (2 * CELLS) * 2 * CELLS + x % (2 * CELLS)) as usize;
    let mut random = Random::new(9);
    let mut path = vec![(0, 0)];
    open[place(0, 0)] = true;
    while let Some(&(x, y)) = path.last() {
        let steps = [(2, 0), (2 * CELLS - 2, 0), (0, 2), (0, 2 * CELLS - 2)];
        let fresh: Vec<_> = steps.into_iter().filter(|(dx, dy)| !open[place(x + dx, y + dy)]).collect();
        if fresh.is_empty() {
            path.pop();
            continue;
        }
        let (dx, dy) = fresh[random.below(fresh.len() as u32) as usize];
        let half = |step: u32| if step > 2 { 2 * CELLS - 1 } else { step / 2 };
        open[place(x + half(dx), y + half(dy))] = true;
        open[place(x + dx, y + dy)] = true;
        path.push(((x + dx) % (2 * CELLS), (y + dy) % (2 * CELLS)));
    }
    let side = f64::from(2 * CELLS);
    each(|x, y| {
        let open = open[place((x * side) as u32, (y * side) as u32)];
        if open { 0.05 } else { 0.8 + 0.15 * smooth(2, x, y, 128) }
    })
}

/// Nearest distance between two coordinates that wrap at 1.
fn apart(a: f64, b: f64) -> f64 {
    let d = (a - b).abs();
    d.min(1.0 - d)
}

fn craters() -> Vec<f64> {
    let mut random = Random::new(21);
    let craters: Vec<_> = (0..60)
        .map(|_| [random.unit(), random.unit(), 0.02 + 0.13 * random.unit() * random.unit()])
        .collect();
    each(|x, y| {
        let ground = 0.55 + 0.25 * (smooth(6, x, y, 6) - 0.5) + 0.06 * (smooth(7, x, y, 48) - 0.5);
        craters.iter().fold(ground, |height, [cx, cy, radius]| {
            let d = apart(x, *cx).hypot(apart(y, *cy)) / radius;
            let bowl = if d < 1.0 { (d * d - 1.0) * 0.9 } else { 0.0 };
            let rim = 0.35 * (-((d - 1.0) / 0.2).powi(2)).exp();
            height + (bowl + rim) * radius * 3.5
        })
    })
}

/// Round stones of all sizes, each over what lies below it.
fn pebbles() -> Vec<f64> {
    let mut random = Random::new(4);
    let stones: Vec<_> = (0..220)
        .map(|i| {
            let radius = if i < 40 { 0.06 } else { 0.025 } * (0.6 + 0.8 * random.unit());
            [random.unit(), random.unit(), radius, random.unit()]
        })
        .collect();
    each(|x, y| {
        let ground = 0.06 + 0.1 * smooth(8, x, y, 40);
        stones.iter().fold(ground, |height, [cx, cy, radius, lift]| {
            let d = apart(x, *cx).hypot(apart(y, *cy)) / radius;
            if d >= 1.0 { height } else { height.max(0.1 + 0.2 * lift + 9.0 * radius * (1.0 - d * d).sqrt()) }
        })
    })
}

/// Mountains: folded noise of five sizes.
fn ridges() -> Vec<f64> {
    each(|x, y| {
        let octave = |i: u32| {
            let fold = 1.0 - (2.0 * smooth(30 + u64::from(i), x, y, 4 << i) - 1.0).abs();
            fold * fold / f64::from(1 << i)
        };
        (0..5).map(octave).sum::<f64>() * 0.5
    })
}

/// A height by chance in every texel.
fn noise() -> Vec<f64> {
    each(|x, y| lattice(1, (x * f64::from(SIDE)) as u32, (y * f64::from(SIDE)) as u32))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean difference of neighbours, in heights.
    fn roughness(map: &HeightMap) -> f64 {
        let pairs = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
        let sum: u32 = pairs.map(|(x, y)| u32::from(map.at(x, y).abs_diff(map.at(x + 1, y)))).sum();
        f64::from(sum) / f64::from(SIDE * SIDE)
    }

    #[test]
    fn maps_are_the_same_every_time_and_all_differ() {
        let maps: Vec<_> = names().into_iter().map(|name| map(name).unwrap()).collect();
        assert!(maps.len() >= 7);
        for (i, map) in maps.iter().enumerate() {
            assert_eq!(super::map(map.name()).unwrap(), *map);
            assert!(maps[..i].iter().all(|other| other.heights() != map.heights()));
            assert_eq!(texture(map).len(), map.heights().len());
            assert!(texture(map).iter().all(|colour| *colour <= 0xff_ffff));
            let span = map.heights().iter().max().unwrap() - map.heights().iter().min().unwrap();
            assert!(map.name() == "flat" || span > 100, "{} uses the depth: {span}", map.name());
        }
        let of = |name: &str| roughness(&map(name).unwrap());
        assert!(of("flat") == 0.0 && of("waves") < 4.0 && of("noise") > 60.0);
        assert!(map("no such").is_none());
    }

    /// A seam is no rougher than what is inside.
    #[test]
    fn maps_repeat_without_a_seam() {
        for name in ["waves", "craters", "ridges", "pebbles"] {
            let map = map(name).unwrap();
            let across =
                |x: u32| (0..SIDE).map(|y| u32::from(map.at(x, y).abs_diff(map.at(x + 1, y)))).sum::<u32>();
            let worst = (0..SIDE - 1).map(across).max().unwrap();
            assert!(across(SIDE - 1) <= worst, "{name}");
        }
    }
}

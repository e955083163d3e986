//! What the figures of Tables 6 and 7 say about the paper's; in: rows, out: sentences that they bear out; cost: none.

use super::published::TABLE_7;
use super::throughput::{Throughput, resources};
use crate::displace::usage::ratio;

/// From this hit rate on, in per cent, a run is taken to be as the paper's was, which prints 99 for every map.
const PAPERS_HIT_RATE: f64 = 98.0;

/// The sentences, one a line; those on all maps only when at least two bear them out.
pub fn conclusion(rows: &[Throughput]) -> String {
    let slowest =
        resources().iter().filter_map(|unit| unit.mpixels_per_s_at_84mhz).fold(f64::INFINITY, f64::min);
    let mut lines = vec![format!(
        "By Table 1's operators the slowest semi-pipelined unit could take {slowest:.1} Mpixels/s at 84 MHz, and four of them \
         {:.1}.",
        4.0 * slowest
    )];
    for one in rows.iter().filter(|row| row.units == 1) {
        let four = rows.iter().find(|row| (row.units, &row.map, row.repeat) == (4, &one.map, one.repeat));
        lines.extend(four.map(|four| of_map(one, four)));
    }
    lines.extend(rows.iter().filter_map(by_chance));
    lines.extend(of_all(rows));
    lines.join("\n")
}

/// A map at a repeat, with one unit and with four.
fn of_map(one: &Throughput, four: &Throughput) -> String {
    let (ours, published) = (four.mpixels_per_s_at_84mhz, four.published_mpixels_per_s);
    let share = if ours > published {
        format!(", {:.0} % of that,", 100.0 * published / ours)
    } else {
        String::new()
    };
    format!(
        "{} at repeat {}: 1 unit does {:.2} Mpixels/s at 84 MHz, limited by {}; 4 units do {ours:.2}, limited by {}. The paper has \
         {published:.1}{share} with {:.2} MB a frame; ours have {:.2}.",
        one.map,
        one.repeat,
        one.mpixels_per_s_at_84mhz,
        one.limit(),
        four.limit(),
        four.published_mb_per_frame,
        four.port_mb_per_frame,
    )
}

/// A rate near the print's with other traffic.
fn by_chance(row: &Throughput) -> Option<String> {
    let share = ratio(row.published_mpixels_per_s, row.mpixels_per_s_at_84mhz);
    let traffic = ratio(row.port_mb_per_frame, row.published_mb_per_frame);
    let near = row.units == 4 && row.repeat != 1.0 && (0.85..1.15).contains(&share) && traffic > 2.0;
    near.then(|| {
        format!(
            "{} at repeat {} comes near the print, but with {traffic:.0} times its memory traffic and a hit rate of {:.1} %: \
             probably by chance.",
            row.map, row.repeat, row.hit_rate_percent,
        )
    })
}

/// What all maps of the paper's hit rate have in common, when there are at least two.
fn of_all(rows: &[Throughput]) -> Vec<String> {
    let like: Vec<&Throughput> = rows
        .iter()
        .filter(|row| row.units == 4 && row.repeat == 1.0 && row.hit_rate_percent >= PAPERS_HIT_RATE)
        .collect();
    if like.len() < 2 {
        return vec![format!(
            "Fewer than two maps reach the paper's hit rate of 99 % at repeat 1 ({PAPERS_HIT_RATE} % is asked for): nothing is \
             concluded of what limits the paper's speed."
        )];
    }
    let frames = || like.iter().map(|row| row.frames_per_s_at_84mhz);
    let (least, most) = (frames().fold(f64::INFINITY, f64::min), frames().fold(0.0, f64::max));
    let mut lines = vec![format!(
        "With the maps once on the surface, where hit rates are the paper's 99 %, four units would give {least:.0} to {most:.0} \
         frames a second, by the map; the paper has 21 to 22 on every map, with its shading units 92 to 94 % busy."
    )];
    if like.iter().all(|row| row.mpixels_per_s_at_84mhz > 1.5 * row.published_mpixels_per_s) {
        lines.push(
            "A rate that does not follow the map, and that four units could exceed by half and more, is set neither by traversal \
             nor by another unit here, but by what feeds them: the ray tracer with its shading units."
                .to_owned(),
        );
    }
    lines.push(format!(
        "The paper's {TABLE_7} at 500 MHz is its 7.5 at 84 MHz times 500/84: scaled, not measured."
    ));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::displace::usage::{Limit, Occupancy};

    fn row(map: &str, units: u32, speed: f64, hit_rate_percent: f64) -> Throughput {
        Throughput {
            map: map.to_owned(),
            repeat: 1.0,
            units,
            rays: 1,
            cycles_per_pixel: 1.0,
            hit_rate_percent,
            published_hit_rate_percent: 99.0,
            port_mb_per_s_at_84mhz: 1.0,
            port_mb_per_frame: 1.0,
            published_mb_per_frame: 1.0,
            frames_per_s_at_84mhz: 40.0,
            published_frames_per_s: 22.0,
            mpixels_per_s_at_84mhz: speed,
            published_mpixels_per_s: 7.5,
            mpixels_per_s_at_500mhz: 1.0,
            published_mpixels_per_s_at_500mhz: None,
            occupancy: Occupancy {
                view: 0.0,
                traverse: 0.0,
                address: 0.0,
                read: 0.0,
                colour: 0.0,
                port: 0.0,
            },
            limited_by: Limit { unit: "traverse", busy: 0.9, waiting: 0.0 },
        }
    }

    #[test]
    fn sentences_need_figures() {
        let rows = |speed, hits| {
            ["rocks", "four"].map(|map| [row(map, 1, speed / 4.0, hits), row(map, 4, speed, hits)]).concat()
        };
        let ours = conclusion(&rows(15.0, 98.9));
        assert!(ours.contains("50 % of that") && ours.contains("ray tracer"), "{ours}");
        let slower = conclusion(&rows(5.0, 98.9));
        assert!(!slower.contains("of that") && !slower.contains("ray tracer"), "{slower}");
        for few in [&rows(15.0, 90.0)[..], &rows(15.0, 99.0)[..2], &[]] {
            let said = conclusion(few);
            assert!(said.contains("nothing is concluded") && !said.contains("21 to 22"), "{said}");
        }
    }
}

//! Do the algorithms save and count what the paper says they do? On the built-in maps; in: the paper's views, out: counters.

use std::sync::LazyLock;

use hostsim::displace::view::View;
use hostsim::format::HostF24;
use lucerna_displace::engine;
use lucerna_driver::displace::{Coherent, Counters, LevelsDown, Policies, Ray, Wrap};
use lucerna_tests::displaced::{
    Bench, Ended, FLAT, algorithms, fixtures, frame, map, pixels, ray, records, shape,
};

/// A map seen from somewhere, by all algorithms.
struct Cell {
    name: String,
    root: u64,
    ended: Vec<(String, Policies, Ended)>,
}

impl Cell {
    fn of(&self, policies: Policies) -> &Counters {
        let same = |(_, other, _): &&(String, Policies, Ended)| *other == policies;
        &self.ended.iter().find(same).expect("one of all").2.counters
    }
}

static CELLS: LazyLock<Vec<Cell>> = LazyLock::new(|| {
    let mut cells = Vec::new();
    for (map, surface) in fixtures() {
        let bench = Bench::<HostF24>::sized(&map, [shape(&map); 2], 4000, engine::Sizes::default());
        for (view, camera, size) in [
            ("front", View::FRONT, (64, 48)),
            ("oblique", View::oblique(), (64, 48)),
            ("grazing", View::grazing(), (240, 180)),
        ] {
            let rays = records(&pixels(&surface, &camera, size));
            let more = [
                Policies { siblings: false, ..Policies::FOLD },
                Policies { siblings: true, ..Policies::MIX },
            ];
            let more = more.map(|policies| (format!("{policies:?}"), policies));
            let all = algorithms().into_iter().chain(more);
            let ended =
                all.map(|(name, policies)| (name, policies, bench.list(&rays, frame(&surface), policies)));
            let name = format!("{} {view}", map.name());
            cells.push(Cell { name, root: u64::from(shape(&map).root()), ended: ended.collect() });
        }
    }
    cells
});

/// What a counter is made of, whatever the algorithm.
#[test]
fn counters_add_up() {
    for cell in &*CELLS {
        for (name, policies, Ended { results, counters: c }) in &cell.ended {
            let context = format!("{} {name}: {c:?}", cell.name);
            let rays = results.len() as u64;
            assert!(rays > 1000, "{context}");
            assert_eq!((c.rays, c.hits, c.missed + c.grazing + c.watchdogs), (rays, rays, 0), "{context}");
            assert_eq!(
                c.steps,
                results.iter().map(|result| u64::from(result.steps)).sum::<u64>(),
                "{context}"
            );
            assert_eq!(
                Some(c.max_steps),
                results.iter().map(|result| u64::from(result.steps)).max(),
                "{context}"
            );
            // A step crosses, goes down or hits; a folded one crosses and does one of the others.
            assert_eq!(c.steps + c.folds, c.crossings + c.level_downs + c.hits, "{context}");
            assert!(policies.siblings || c.folds == 0, "{context}");
            // From where a ray begins to the leaf it hits: down as far as that and as often as it went up.
            if policies.levels_down == LevelsDown::One {
                assert_eq!(c.level_downs, cell.root * rays - c.levels_saved + c.level_ups, "{context}");
            }
            let levels: u64 = results.iter().map(|result| cell.root - u64::from(result.level)).sum();
            assert_eq!(c.levels_saved, levels, "{context}");
            assert_eq!(c.start_passes, if policies.start_level { rays } else { 0 }, "{context}");
            assert_eq!(c.height_accesses, c.steps, "{context}: a height a step, on a map that repeats");
            assert_eq!(c.height_hits + c.height_misses, c.height_accesses, "{context}");
            assert_eq!(c.texture_accesses, 2 * c.hits, "{context}");
            assert_eq!(c.port_bytes, 32 * (c.height_fills + c.texture_fills), "{context}");
            assert_eq!((c.port_busy, c.result_bytes), (c.port_bytes / 8, 32 * rays), "{context}");
            let turns = c.traverse_busy + c.traverse_waits + c.traverse_stalls + c.traverse_bubbles;
            assert_eq!(c.traverse_busy, c.steps + c.start_passes, "{context}");
            assert!(turns >= c.cycles && turns - c.traverse_stalls <= c.cycles, "{context}");
        }
    }
}

/// \[10\] never goes up, so its steps are its levels and its crossings; up is what the others do with a crossing.
#[test]
fn each_algorithm_is_what_it_is() {
    for cell in &*CELLS {
        let oh = cell.of(Policies::OH);
        assert_eq!((oh.level_ups, oh.steps), (0, (cell.root + 1) * oh.rays + oh.crossings), "{}", cell.name);
        assert_eq!(cell.of(Policies::b(LevelsDown::One)), oh, "(b) of one level is [10]");
        let (a, b) = (cell.of(Policies::A), cell.of(Policies::B));
        assert_eq!(
            (a.crossings, a.level_ups),
            (oh.crossings, 0),
            "{}: a start level skips no crossing",
            cell.name
        );
        // §3.1: every level that is skipped is a step less.
        assert_eq!(a.steps + a.levels_saved, oh.steps, "{}", cell.name);
        assert!(b.level_downs < oh.level_downs && b.level_ups == 0, "{}", cell.name);
        let (tevs, c1, c2) = (cell.of(Policies::TEVS), cell.of(Policies::C1), cell.of(Policies::C2));
        for up in [tevs, c1, c2] {
            assert!(up.level_ups <= up.crossings && up.crossings <= oh.crossings, "{}", cell.name);
        }
        // (c1) goes up where [12] does, or not.
        assert!(
            c1.level_ups <= tevs.level_ups && c1.steps <= tevs.steps,
            "{}: {} {}",
            cell.name,
            c1.steps,
            tevs.steps
        );
        // A level-up needs a crossing that stayed before it, so at most every second one goes up.
        for coherent in [Coherent::Toggle, Coherent::Consecutive, Coherent::Parity] {
            let c2 = cell.of(Policies::C2.with_coherent(coherent));
            assert!(2 * c2.level_ups <= c2.crossings, "{} {coherent:?}", cell.name);
        }
    }
}

/// The mix takes no more steps than \[10\] and \[12\], and ours beyond the paper no more than the mix, on every map from every view.
#[test]
fn the_mix_saves_and_fold_saves_more() {
    for cell in &*CELLS {
        let mix = cell.of(Policies::MIX);
        assert!(
            mix.steps <= cell.of(Policies::TEVS).steps && mix.steps <= cell.of(Policies::OH).steps,
            "{}",
            cell.name
        );
        let fold = cell.of(Policies::FOLD);
        println!(
            "{}: mix {:.2}, fold {:.2} steps and {:.2}, {:.2} cycles a ray",
            cell.name,
            mix.steps as f64 / mix.rays as f64,
            fold.steps as f64 / fold.rays as f64,
            mix.cycles as f64 / mix.rays as f64,
            fold.cycles as f64 / fold.rays as f64
        );
        assert!(fold.steps <= mix.steps, "{}: {} {}", cell.name, fold.steps, mix.steps);
    }
}

/// P22: a folded step is a crossing and the descent after it, nothing else; so all but the number of steps is the same.
#[test]
fn siblings_only_fold_steps() {
    for cell in &*CELLS {
        for policies in [Policies::MIX, Policies::FOLD] {
            let find = |siblings: bool| {
                let wanted = Policies { siblings, ..policies };
                cell.ended.iter().find(|(_, other, _)| *other == wanted).expect("one of all")
            };
            let ((_, _, with), (_, _, without)) = (find(true), find(false));
            let (w, o) = (&with.counters, &without.counters);
            assert_eq!(w.steps + w.folds, o.steps, "{}", cell.name);
            assert_eq!((w.crossings, w.level_downs, w.level_ups), (o.crossings, o.level_downs, o.level_ups));
            for (with, without) in with.results.iter().zip(&without.results) {
                let seen = [with, without].map(|r| (r.status, r.texel, r.t, r.level, r.colour, r.position));
                assert_eq!(seen[0], seen[1], "{}", cell.name);
                assert!(with.steps <= without.steps);
            }
        }
    }
}

/// Where to go on looking is no matter of what is there: all end in the texel that \[10\] finds, but for rounding.
#[test]
fn no_rule_changes_the_texel() {
    let (mut rays, mut differ) = (0, 0);
    for cell in &*CELLS {
        let (_, _, oh) = &cell.ended[0];
        for (_, _, ended) in &cell.ended[1..] {
            rays += ended.results.len();
            differ += ended.results.iter().zip(&oh.results).filter(|(a, b)| a.texel != b.texel).count();
        }
    }
    println!("{differ} of {rays} rays end elsewhere than by [10] (F24)");
    assert!(differ * 2000 < rays, "{differ} of {rays}");
}

/// P7: what leaves the map begins at its root; what stays within a node begins there.
#[test]
fn the_start_level_is_that_of_the_ray_s_span() {
    let flat = map(16, &[100; 256]);
    let bench = Bench::<HostF24>::new(&flat, 16);
    let at = |texels: f32| texels / 16.0;
    let span = |from: f32, to: f32| ray([at(from), at(3.5)], [at(to - from), 0.0]);
    let rays: Vec<Ray> = [
        (3.5, 3.75),
        (2.5, 3.5),
        (3.5, 4.5),
        (1.5, 3.5),
        (7.5, 8.5),
        (15.5, 16.5),
        (0.5, -0.5),
        (16.5, 17.5),
        (-1.5, -0.5),
    ]
    .map(|(from, to)| span(from, to))
    .into();
    let expected = [0, 1, 3, 2, 4, 4, 4, 1, 1];
    for (name, policies) in algorithms() {
        for wrap in [Wrap::Repeat, Wrap::Border] {
            let ended = bench.list(&rays, FLAT, policies.with_wrap(wrap));
            let levels: Vec<u8> = ended.results.iter().map(|result| result.level).collect();
            let wanted = if policies.start_level { expected } else { [4; 9] };
            assert_eq!(levels, wanted, "{name}");
            assert_eq!(
                ended.counters.levels_saved,
                wanted.iter().map(|level| 4 - u64::from(*level)).sum::<u64>()
            );
        }
    }
    // P19: on a grid 8 times finer a texel is a node of level 3, and nothing is saved sooner than 8 texels do.
    let ended = bench.list(&rays, FLAT, Policies::A.with_start_grid(3));
    let levels: Vec<u8> = ended.results.iter().map(|result| result.level).collect();
    assert_eq!(levels, [2, 4, 4, 4, 4, 4, 4, 4, 4]);
}

//! Does the host side give the published workload's counts, to the last digit?

use hostsim::grid::HashGrid;
use hostsim::oracle::{Bits24, Counts, Number, Reference, Scalar};
use hostsim::scene::{LoadOptions, Scene};
use hostsim::trace::{HitPoint, PhotonChunk, chunks, eye_pass};

struct Workload {
    scene: Scene,
    points: Vec<HitPoint>,
    grid: HashGrid,
    emitted: u32,
}

impl Workload {
    fn new(width: u32, height: u32, emitted: u32) -> Self {
        let scene = Scene::load("cornell-balls", &LoadOptions::default()).expect("it is built in");
        let points = eye_pass(&scene, width, height);
        let grid = HashGrid::build(&points, width, height).expect("there are hit points");
        Self { scene, points, grid, emitted }
    }

    fn for_each_chunk(&self, size: u32, mut visit: impl FnMut(&PhotonChunk)) {
        let mut chunk = PhotonChunk::default();
        for range in chunks(self.emitted, size) {
            chunk.fill(&self.scene, &self.grid, range);
            visit(&chunk);
        }
    }

    fn scalar<N: Number>(&self, normal_test: bool) -> Scalar<N> {
        Scalar::new(&self.points, self.grid.radius(), 0.7, normal_test)
    }
}

#[test]
fn counts_at_20_by_15() {
    let w = Workload::new(20, 15, 1_000);
    assert_eq!(w.points.len(), 606);
    assert_eq!(w.grid.entries().len(), 4_848);
    assert_eq!(format!("{:.6}", w.grid.radius()), "13.318062");

    let mut reference = Reference::new(&w.points, w.grid.radius(), true);
    let mut scalar: Scalar<f32> = w.scalar(false);
    let mut narrow: Scalar<Bits24> = w.scalar(false);
    let mut longest = 0;
    w.for_each_chunk(300, |chunk| {
        reference.feed(chunk, w.grid.entries());
        scalar.feed(chunk, w.grid.entries());
        narrow.feed(chunk, w.grid.entries());
        longest = chunk.lists.iter().map(|l| l.n).fold(longest, u32::max);
    });
    let Counts { photons, empty_cells, operations, .. } = reference.counts();
    assert_eq!((photons, empty_cells, operations, longest), (3_162, 0, 123_682, 125));
    assert_eq!(scalar.counts().operations, 123_682);
    assert_eq!(scalar.counts().updates, 6_506);
    // Seven fewer bits move the edge of the radius a little.
    assert!(narrow.counts().updates.abs_diff(6_506) < 20, "{:?}", narrow.counts());
}

#[test]
fn counts_at_320_by_240() {
    let w = Workload::new(320, 240, 768_000);
    assert_eq!(w.points.len(), 152_046);
    assert_eq!(w.grid.entries().len(), 1_216_364);
    assert_eq!(format!("{:.6}", w.grid.radius()), "0.832381");

    let mut reference = Reference::new(&w.points, w.grid.radius(), true);
    let mut longest = 0;
    w.for_each_chunk(1 << 15, |chunk| {
        reference.feed(chunk, w.grid.entries());
        longest = chunk.lists.iter().map(|l| l.n).fold(longest, u32::max);
    });
    let counts = reference.counts();
    assert_eq!((counts.surface_hits(), counts.empty_cells, longest), (2_454_756, 16_611, 516));
    assert_eq!(counts.operations, 78_118_412);
    assert_eq!(counts.facing, 61_427_542);
    assert_eq!(counts.updates, 3_536_147);
}

/// How photons are cut into chunks, and how many threads trace them, must not show.
#[test]
fn chunk_sizes_do_not_show() {
    let w = Workload::new(20, 15, 1_000);
    let run = |size: u32| {
        let mut scalar: Scalar<f32> = w.scalar(true);
        w.for_each_chunk(size, |chunk| scalar.feed(chunk, w.grid.entries()));
        let picture = scalar.radiance(300, 1_000, 0..606);
        (scalar.states().collect::<Vec<_>>(), picture)
    };
    let whole = run(1_000);
    assert_eq!(run(1), whole);
    assert_eq!(run(513), whole);
}

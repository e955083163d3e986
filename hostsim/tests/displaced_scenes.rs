//! Do paths that meet a displaced surface go on as if its relief were there, in whatever portions they are traced?

mod march;

use core::convert::Infallible;
use std::fs;
use std::path::Path;

use hostsim::scene::{LoadOptions, Scene, Vec3};
use hostsim::trace::{
    Answer, Displacer, Flat, HitPoint, PhotonChunk, Request, SurfaceHit, chunks, eye_pass, eye_pass_through,
    trace_photons, trace_photons_through,
};
use march::March;

const HEAD: &str = r#"
[camera]
eye = [0.2, 2, 3]
target = [0, -0.2, 0]
field_of_view = 40
[light]
position = [0.3, 3, 0.4]
intensity = [1, 1, 1]
[materials]
grey = { kind = "diffuse", colour = [0.5, 0.5, 0.5] }
glass = { kind = "glass", colour = [1, 1, 1], index = 1.5 }
"#;

/// Two by three, at y = 0.
const LID: &str = r#"
[[displaced]]
corner = [-1, 0, 1.5]
u = [2, 0, 0]
v = [0, 0, -3]
map = "flat"
repeat = 2
height_scale = 0.25
colour = [0.5, 0.5, 0.5]
"#;

const ROOM: &str = "[[objects]]\nshape = \"box\"\nmaterial = \"grey\"\nsize = [2, 4, 3]\n";
const BALL: &str = "[[spheres]]\nradius = 0.3\ncentre = [0, 0.6, 0]\nmaterial = \"glass\"\n";

/// Where the lid is, as triangles.
const QUAD: &str = "v -1 0 1.5\nv 1 0 1.5\nv 1 0 -1.5\nv -1 0 -1.5\nf 1 2 3 4\n";
/// The same, sunk by `height_scale` texture units of 1, and the four walls over it.
const PIT: &str = "v -1 -.25 1.5\nv 1 -.25 1.5\nv 1 -.25 -1.5\nv -1 -.25 -1.5\nv -1 0 1.5\nv 1 0 1.5\nv 1 0 -1.5\nv -1 0 -1.5\n\
                   f 1 2 3 4\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// Level ground about them, so that no pit is seen from outside.
const GROUND: &str = "v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nv -1 0 1.5\nv 1 0 1.5\nv 1 0 -1.5\nv -1 0 -1.5\n\
                      f -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 -1\n";

fn scene(parts: &[&str]) -> Scene {
    Scene::from_toml(&parts.concat(), "trial", Path::new(""), &LoadOptions::default()).expect("it is right")
}

/// The scene whose floor is triangles, grey as the lid.
fn mesh(obj: &str, parts: &[&str]) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("floor.mtl"), "newmtl grey\nKd 0.5 0.5 0.5\n").unwrap();
    fs::write(folder.path().join("floor.obj"), format!("mtllib floor.mtl\nusemtl grey\n{obj}")).unwrap();
    let text = ["mesh = \"floor.obj\"\n", HEAD, &parts.concat()].concat();
    Scene::from_toml(&text, "trial", folder.path(), &LoadOptions::default()).expect("it is right")
}

fn eyes(scene: &Scene, displacer: &mut impl Displacer<Error = Infallible>) -> Vec<HitPoint> {
    let Ok(points) = eye_pass_through(scene, 64, 48, displacer);
    points
}

fn photons(scene: &Scene, displacer: &mut impl Displacer<Error = Infallible>) -> Vec<SurfaceHit> {
    let mut hits = Vec::new();
    let Ok(()) = trace_photons_through(scene, 0..3000, &mut hits, displacer);
    hits
}

#[track_caller]
fn same(a: &[HitPoint], b: &[HitPoint]) {
    assert_eq!(a.len(), b.len());
    assert!(a.len() > 1000);
    for (a, b) in a.iter().zip(b) {
        assert!((a.position - b.position).length() < 1e-9, "{a:?} {b:?}");
        assert!((a.normal - b.normal).length() < 1e-9, "{a:?} {b:?}");
        assert!((a.colour - b.colour).length() < 1e-9 && a.pixel == b.pixel, "{a:?} {b:?}");
    }
}

#[test]
fn without_relief_it_is_a_rectangle() {
    let displaced = scene(&[HEAD, LID, BALL]);
    let plain = mesh(QUAD, &[BALL]);
    let mut flat = March::new(&displaced, |_, _| 255);
    let points = eyes(&displaced, &mut flat);
    same(&points, &eye_pass(&plain, 64, 48));
    assert_eq!(points, eyes(&displaced, &mut Flat));
    assert_eq!(points, eye_pass(&displaced, 64, 48));

    let (ours, mut theirs) = (photons(&displaced, &mut flat), Vec::new());
    trace_photons(&plain, 0..3000, &mut theirs);
    assert_eq!(ours.len(), theirs.len());
    for (a, b) in ours.iter().zip(&theirs) {
        assert!((a.position - b.position).length() < 1e-6 && (a.flux - b.flux).length() < 1e-9);
        assert!((a.normal - b.normal).length() < 1e-9);
    }
}

#[test]
fn at_its_lowest_it_is_a_pit() {
    let displaced = mesh(GROUND, &[LID, BALL]);
    let points = eyes(&displaced, &mut March::new(&displaced, |_, _| 0));
    same(&points, &eye_pass(&mesh(&[PIT, GROUND].concat(), &[BALL]), 64, 48));
    let on_walls = points.iter().filter(|p| p.position.y < -1e-9 && p.normal.y.abs() < 1e-9).count();
    let on_bottom = points.iter().filter(|p| (p.position.y + 0.25).abs() < 1e-9).count();
    assert!(on_walls > 50 && on_bottom > 500, "{on_walls} {on_bottom}");
}

/// Half the map is high, half low: the steps between are where the texture coordinates say.
#[test]
fn the_map_lies_as_its_coordinates_say() {
    let displaced = scene(&[HEAD, LID]);
    let points = eyes(&displaced, &mut March::new(&displaced, |x, _| if x < 4 { 255 } else { 0 }));
    for p in points {
        // u grows with x from -1, two copies over the width of 2: one unit each.
        let u = (p.position.x + 1.0).rem_euclid(1.0);
        let high = p.position.y.abs() < 1e-9;
        let low = (p.position.y + 0.25).abs() < 1e-9;
        let edge = u.min((u - 0.5).abs()).min(1.0 - u) < 1e-9;
        let rim = p.position.x.abs().max(p.position.z.abs() / 1.5) > 1.0 - 1e-9;
        assert!(if high { u < 0.5 + 1e-9 } else { low && u > 0.5 - 1e-9 || edge || rim }, "{p:?}");
    }
}

/// An answer of a request alone, unlike its neighbours'.
#[derive(Clone, Copy)]
struct Rough;

impl Displacer for Rough {
    type Error = Infallible;

    fn answer(
        &mut self,
        surface: usize,
        requests: &[Request],
        answers: &mut Vec<Answer>,
    ) -> Result<(), Self::Error> {
        answers.extend(requests.iter().map(|r| {
            let [a, b] = r.entry.map(|x| (x * (97.0 + surface as f64)).fract().abs());
            let normal = Vec3::new(a - 0.5, b - 0.5, 1.0).normalised();
            Answer { t: a * b, normal, colour: Vec3::new(1.0, b, a) }
        }));
        Ok(())
    }
}

/// A second lid, upright, which closes what the first leaves open: photons wait many times.
const WALL: &str = r#"
[[displaced]]
corner = [-1, 0, -1.5]
u = [2, 0, 0]
v = [0, 2, 0]
map = "flat"
height_scale = 0.1
colour = [0.9, 0.9, 0.9]
"#;

#[test]
fn neither_chunks_nor_threads_show() {
    let scene = scene(&[HEAD, LID, WALL, BALL, ROOM]);
    let points = eyes(&scene, &mut Rough);
    let whole = photons(&scene, &mut Rough);
    assert!(whole.len() > 4000, "{}", whole.len());
    for size in [1, 7, 512, 1000, 2999] {
        let mut hits = Vec::new();
        for range in chunks(3000, size) {
            let Ok(()) = trace_photons_through(&scene, range, &mut hits, &mut Rough);
        }
        assert_eq!(hits, whole, "{size}");
    }
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (p, h) = pool.install(|| (eyes(&scene, &mut Rough), photons(&scene, &mut Rough)));
        assert_eq!((p, h), (points.clone(), whole.clone()), "{threads}");
    }
}

/// Every photon that waits comes back in its place: hits of one photon at a time are what all together are.
#[test]
fn bounces_stay_in_order() {
    let scene = scene(&[HEAD, LID, WALL, ROOM]);
    let mut chunk = PhotonChunk::default();
    let grid = hostsim::grid::HashGrid::build(&eyes(&scene, &mut Rough), 64, 48).unwrap();
    let Ok(()) = chunk.fill_through(&scene, &grid, 0..3000, &mut Rough);
    assert_eq!(chunk.len(), chunk.lists.len());
    let mut i = 0;
    let mut longest = 0;
    for photon in 0..3000 {
        let mut hits = Vec::new();
        let Ok(()) = trace_photons_through(&scene, photon..photon + 1, &mut hits, &mut Rough);
        assert_eq!(hits, chunk.hits[i..i + hits.len()], "{photon}");
        i += hits.len();
        longest = longest.max(hits.len());
    }
    assert!(i == chunk.len() && longest >= 4, "{longest}");
}

/// Paths go on over the lid: nothing is asked for from inside, and no photon is lost through it.
#[test]
fn photons_go_on_over_the_lid() {
    let scene = scene(&[HEAD, LID, ROOM]);
    let mut displacer = March::new(&scene, |x, y| x.wrapping_mul(31).wrapping_add(y * 17));
    let hits = photons(&scene, &mut displacer);
    let mut sunk = 0;
    for h in &hits {
        let [x, y, z] = h.position.to_array();
        assert!(
            x.abs() < 1.0 + 1e-9 && z.abs() < 1.5 + 1e-9 && (-0.25 - 1e-9..4.0 + 1e-9).contains(&y),
            "{h:?}"
        );
        sunk += usize::from(y < -0.01);
    }
    // In a closed room each of 3000 photons has 1 + 1/2 + 1/4 + … hits, to the greatest depth.
    assert!((5700..6300).contains(&hits.len()), "{}", hits.len());
    assert!(sunk > 200, "{sunk}");
    assert!(displacer.asked.iter().all(|r| r.view.y < 0.0), "only from in front");
}

#[test]
fn from_behind_it_is_a_sheet() {
    let below = HEAD.replace("eye = [0.2, 2, 3]", "eye = [0.2, -2, 0.3]");
    let scene = scene(&[&below, LID]);
    let mut displacer = March::new(&scene, |_, _| 0);
    let points = eyes(&scene, &mut displacer);
    assert!(displacer.asked.is_empty() && !points.is_empty());
    assert!(points.iter().all(|p| p.position.y.abs() < 1e-9 && p.normal == Vec3::new(0.0, -1.0, 0.0)));
}

#[test]
fn entries_that_are_wrong_are_explained() {
    for (from, to, expected) in [
        ("v = [0, 0, -3]", "v = [1, 0, -3]", "perpendicular"),
        ("v = [0, 0, -3]", "v = [0, 0, 0]", "of some length"),
        ("v = [0, 0, -3]", "v = [0, nan, 0]", "v must be three finite numbers"),
        ("repeat = 2", "repeat = 0", "repeat must be above zero"),
        ("repeat = 2", "repeat = 1e9", "at most 4096"),
        ("repeat = 2", "depth = 2", "unknown field `depth`"),
        ("height_scale = 0.25", "height_scale = 0", "height_scale must be above 0"),
        ("height_scale = 0.25", "height_scale = nan", "height_scale must be above 0"),
        ("height_scale = 0.25", "", "missing field `height_scale`"),
        ("colour = [0.5, 0.5, 0.5]", "colour = [0.5, 0.5, 2]", "from 0 to 1"),
        ("map = \"flat\"", "", "missing field `map`"),
    ] {
        assert!(LID.contains(from));
        let text = [HEAD, &LID.replace(from, to)].concat();
        let error = Scene::from_toml(&text, "trial", Path::new(""), &LoadOptions::default());
        let error = error.expect_err(to).to_string();
        assert!(error.contains(expected), "{to}: {error}");
    }
}

//! Does a damaged or unusual scene give an error that helps, or a note, and never a panic?

use std::fs;
use std::path::{Path, PathBuf};

use hostsim::scene::{LoadOptions, Material, Scene, SceneError, Vec3, builtin_names};
use hostsim::trace::{eye_pass, trace_photons};

const GOOD: &str = r#"
[camera]
eye = [0, 1, 5]
target = [0, 0, 0]
field_of_view = 40
[light]
position = [0, 4, 2]
intensity = [10, 10, 10]
[materials]
white = { kind = "diffuse", colour = [0.8, 0.8, 0.8] }
[[spheres]]
radius = 1.0
centre = [0, 0, 0]
material = "white"
"#;

fn parse(text: &str) -> Result<Scene, SceneError> {
    Scene::from_toml(text, "trial", Path::new(""), &LoadOptions::default())
}

/// The error after replacing one piece of the good scene.
fn broken(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    parse(&GOOD.replace(from, to)).expect_err("it is broken").to_string()
}

#[test]
fn the_good_scene_is_good() {
    assert_eq!(parse(GOOD).unwrap().spheres().len(), 1);
}

#[test]
fn errors_name_the_entry_and_the_remedy() {
    for (from, to, expected) in [
        ("material = \"white\"", "material = \"wite\"", "[[spheres]] number 1: no material `wite`"),
        ("radius = 1.0", "radius = 0.0", "radius must be above zero"),
        ("radius = 1.0", "radius = nan", "radius must be above zero"),
        ("centre = [0, 0, 0]", "centre = [0, inf, 0]", "centre must be three finite numbers"),
        ("centre = [0, 0, 0]", "center = [0, 0, 0]", "unknown field `center`"),
        ("eye = [0, 1, 5]", "eye = [0, 0, 0]", "`target` must differ from `eye`"),
        ("target = [0, 0, 0]", "target = [0, 9, 5]", "`up` must not be the viewing direction"),
        ("target = [0, 0, 0]", "", "give either a `target` or a `direction`"),
        ("field_of_view = 40", "field_of_view = 180", "below 180"),
        ("field_of_view = 40", "", "give either a `field_of_view` or a `height`"),
        ("intensity = [10, 10, 10]", "intensity = [10, -1, 10]", "finite and not negative"),
        ("[0.8, 0.8, 0.8]", "[0.8, 1.8, 0.8]", "from 0 to 1"),
        ("kind = \"diffuse\"", "kind = \"velvet\"", "velvet"),
        ("[light]", "[[objects]]\nshape = \"cone\"\nmaterial = \"white\"\n[light]", "cone"),
        ("[light]", "[tracing]\nleast_weight = 1.0\n[light]", "least_weight"),
    ] {
        let message = broken(from, to);
        assert!(message.contains(expected), "{to}: {message}");
        assert!(message.contains("`trial`"), "{message}");
    }
}

#[test]
fn a_scene_with_nothing_in_it() {
    let (head, _) = GOOD.split_once("[[spheres]]").unwrap();
    assert!(parse(head).unwrap_err().to_string().contains("it holds nothing"));
}

#[test]
fn names_that_are_no_scene() {
    let error = Scene::load("cornell-bals", &LoadOptions::default()).unwrap_err().to_string();
    assert!(builtin_names().iter().all(|name| error.contains(name)), "{error}");
    for (asked, meant) in [
        ("cornell-bals", Some("cornell-balls")),
        ("Cornell-Teapot", Some("cornell-teapot")),
        ("sibenic", Some("sibenik")),
        ("confer", Some("conference")),
        ("kitchn", Some("kitchen")),
        ("garden", None),
        ("", None),
    ] {
        let error = Scene::load(asked, &LoadOptions::default()).unwrap_err();
        let SceneError::UnknownScene { nearest, .. } = &error else { panic!("{asked}: {error}") };
        assert_eq!(*nearest, meant, "{asked}");
        assert_eq!(error.to_string().contains("did you mean"), meant.is_some(), "{error}");
    }
    assert!(matches!(
        Scene::load("no/such.toml", &LoadOptions::default()),
        Err(SceneError::Unreadable { .. })
    ));
    assert!(matches!(
        Scene::load("no/such.obj", &LoadOptions::default()),
        Err(SceneError::Unreadable { .. })
    ));
}

#[test]
fn a_mesh_that_is_not_there() {
    let options = LoadOptions { mesh: Some("no/such/sibenik.obj".into()) };
    let error = Scene::load("sibenik", &options).unwrap_err();
    assert!(
        matches!(&error, SceneError::MissingMesh { path, .. } if path == Path::new("no/such/sibenik.obj"))
    );
    assert!(error.to_string().contains("--mesh"));
}

fn write(folder: &tempfile::TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, text).expect("the folder is ours");
    path
}

fn load(path: &Path) -> Result<Scene, SceneError> {
    Scene::load(path.to_str().expect("a plain path"), &LoadOptions::default())
}

#[test]
fn polygons_negative_numbers_and_no_normals() {
    let folder = tempfile::tempdir().unwrap();
    let quad = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";
    let path = write(&folder, "quad.obj", &format!("{quad}f -4 -3 -2 -1\nf 1 1 2\nl 1 2\np 1\n"));
    let scene = load(&path).unwrap();
    // A fan of two, and the two of the floor that is added under a thing.
    assert_eq!(scene.triangle_count(), 4);
    let notes = scene.notes().join("\n");
    assert!(notes.contains("1 triangles without an area"), "{notes}");
    assert!(notes.contains("quad.obj: it names no MTL file: every surface is grey"), "{notes}");
}

#[test]
fn damaged_meshes() {
    let folder = tempfile::tempdir().unwrap();
    for (text, expected) in [
        ("", "no faces"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no faces"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "no line before it defines"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n", "no line before it defines"),
        ("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", "finite"),
        ("v 0 0 0\nv 1 0 0\nv 0 1e999 0\nf 1 2 3\n", "finite"),
        ("v 0 0 zero\n", "not a number"),
        ("v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", "no faces with an area (1 without)"),
        ("v 0 0 0\nf 1 two 3\n", "malformed"),
    ] {
        let error = load(&write(&folder, "bad.obj", text)).expect_err(text).to_string();
        assert!(error.contains(expected) && error.contains("bad.obj"), "{text:?}: {error}");
    }
    let path = folder.path().join("binary.obj");
    fs::write(&path, [0xff, 0xfe, 0x00, 0x80, b'\n', 0xc3]).unwrap();
    assert!(load(&path).is_err());
}

#[test]
fn materials_from_a_library() {
    let folder = tempfile::tempdir().unwrap();
    write(
        &folder,
        "m.mtl",
        "newmtl tiled\nKd 0.25 0.5 0.75\nmap_Kd tiles.png\nillum 2\nnewmtl shiny\nKs 0.9 0.9 0.9\nillum 3\n\
         newmtl pane\nNi 1.5\nillum 7\nnewmtl film\nKd 0.1 0.1 0.1\nNi 1.0\nillum 6\n",
    );
    let mut text = "mtllib m.mtl\n".to_owned();
    // Four squares in a row, in the plane z = 0, and one whose material is not in the library.
    for (i, name) in ["tiled", "shiny", "pane", "film", "lost"].iter().enumerate() {
        let x = 2 * i;
        text += &format!("v {x} 0 0\nv {} 0 0\nv {} 1 0\nv {x} 1 0\n", x + 1, x + 1);
        text += &format!("usemtl {name}\nf -4 -3 -2 -1\n");
    }
    let path = write(&folder, "m.obj", &text);
    let scene = load(&path).unwrap();
    let material = |x: f64| {
        let ray =
            hostsim::scene::Ray { origin: Vec3::new(x, 0.4, 3.0), direction: Vec3::new(0.0, 0.0, -1.0) };
        let hit = scene.nearest(&ray).expect("a square is ahead");
        assert_eq!(hit.normal, Vec3::new(0.0, 0.0, 1.0));
        hit.material
    };
    assert_eq!(material(0.3), Material::Diffuse { colour: Vec3::new(0.25, 0.5, 0.75) });
    assert!(matches!(material(2.3), Material::Mirror { .. }));
    assert_eq!(material(4.3), Material::Glass { colour: Vec3::ONE, index: 1.5 });
    assert!(matches!(material(6.3), Material::Diffuse { .. }));
    assert!(matches!(material(8.3), Material::Diffuse { .. }));
    let notes = scene.notes().join("\n");
    for expected in ["tiled", "film", "m.obj: no MTL file defines lost: 2 triangles"] {
        assert!(notes.contains(expected), "{expected}: {notes}");
    }
}

#[test]
fn a_mesh_beside_its_scene_file() {
    let folder = tempfile::tempdir().unwrap();
    write(&folder, "wall.obj", "v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 1 2 3 4\n");
    let (head, _) = GOOD.split_once("[materials]").unwrap();
    let path = write(&folder, "wall.toml", &format!("mesh = \"wall.obj\"\n{head}"));
    let scene = load(&path).unwrap();
    assert_eq!((scene.name(), scene.triangle_count()), ("wall", 2));
    let points = eye_pass(&scene, 8, 6);
    assert!(points.iter().all(|p| p.normal == Vec3::new(0.0, 0.0, 1.0)), "turned to the camera's side");
    // The camera's name in another file wins.
    let options = LoadOptions { mesh: Some(folder.path().join("gone.obj")) };
    assert!(matches!(Scene::load(path.to_str().unwrap(), &options), Err(SceneError::MissingMesh { .. })));
}

#[test]
fn the_teapot_scene_traces() {
    let scene = Scene::load("cornell-teapot", &LoadOptions::default()).unwrap();
    assert!(scene.triangle_count() > 30_000);
    // One hit point a pixel: nothing splits, and the box is closed.
    let points = eye_pass(&scene, 40, 30);
    assert_eq!(points.len(), 1200);
    assert!(points.iter().all(|p| p.position.is_finite() && (p.normal.length() - 1.0).abs() < 1e-9));
    let mut hits = Vec::new();
    trace_photons(&scene, 0..500, &mut hits);
    assert!(hits.len() > 500 && hits.iter().all(|h| h.position.is_finite() && h.flux.is_finite()));
    // Nothing leaves the box.
    assert!(hits.iter().all(|h| (0.9..99.1).contains(&h.position.x) && (-0.1..81.7).contains(&h.position.y)));
}

#[test]
fn folders_other_formats_and_empty_files() {
    let folder = tempfile::tempdir().unwrap();
    let say = |path: &Path| load(path).expect_err("it is no scene").to_string();
    let error = say(folder.path());
    assert!(
        error.contains("is a folder") && error.contains(".obj") && error.contains("cornell-balls"),
        "{error}"
    );
    fs::create_dir(folder.path().join("models.obj")).unwrap();
    assert!(say(&folder.path().join("models.obj")).contains("is a folder"));
    let error = say(&write(&folder, "foo.stl", "solid foo"));
    assert!(error.contains("foo.stl") && error.contains(".toml or an .obj"), "{error}");
    for text in ["", "\n\n", "# nothing yet\n  # at all\n"] {
        let error = say(&write(&folder, "empty.toml", text));
        assert!(error.contains("`empty` is an empty file"), "{error}");
        assert!(error.contains("fixtures/scenes/cornell-balls.toml"), "{error}");
    }
}

#[test]
fn a_mesh_where_none_belongs() {
    let folder = tempfile::tempdir().unwrap();
    let obj = write(&folder, "ball.obj", &cuboid(false, &[0, 1, 2, 3, 4, 5]));
    let options = LoadOptions { mesh: Some(obj.clone()) };
    let name = |path: &Path| path.to_str().expect("a plain path").to_owned();
    let toml = write(&folder, "good.toml", GOOD);
    for (scene, expected) in [
        (name(&obj), "the scene is already a mesh: leave --mesh away"),
        (name(&folder.path().join("sibenik.obj")), "the scene is already a mesh"),
        (name(&toml), "scene `good` names no mesh"),
        ("cornell-balls".to_owned(), "scene `cornell-balls` names no mesh"),
    ] {
        let error = Scene::load(&scene, &options).expect_err(&scene).to_string();
        assert!(error.contains(expected) && error.contains("leave --mesh away"), "{error}");
    }
    // By name it is right.
    assert_eq!(Scene::load("sibenik", &options).unwrap().triangle_count(), 12);
}

/// A box of side 2 about the origin, without some faces, wound outward or inward.
fn cuboid(inward: bool, faces: &[usize]) -> String {
    let mut text = String::new();
    for i in 0..8 {
        let side = |bit: i32| 2 * (i >> bit & 1) - 1;
        text += &format!("v {} {} {}\n", side(0), side(1), side(2));
    }
    // -x, +x, -y, +y, -z, +z.
    const FACES: [[usize; 4]; 6] =
        [[1, 5, 7, 3], [2, 4, 8, 6], [1, 2, 6, 5], [3, 7, 8, 4], [1, 3, 4, 2], [5, 6, 8, 7]];
    for &face in faces {
        let mut f = FACES[face];
        if inward {
            f.reverse();
        }
        text += &format!("f {} {} {} {}\n", f[0], f[1], f[2], f[3]);
    }
    text
}

/// The scene of an OBJ text and its notes.
fn guessed(text: &str) -> (Scene, String) {
    let folder = tempfile::tempdir().unwrap();
    let scene = load(&write(&folder, "my.obj", text)).expect("it is a mesh");
    let notes = scene.notes().join("\n");
    (scene, notes)
}

#[test]
fn the_winding_tells_a_thing_from_a_room() {
    let all = [0, 1, 2, 3, 4, 5];
    let inside = |scene: &Scene| scene.camera().eye.to_array().iter().all(|x| x.abs() < 1.0);
    let (scene, notes) = guessed(&cuboid(false, &all));
    assert!(!inside(&scene) && notes.contains("my.obj: seen from outside, camera ("), "{notes}");
    let (scene, notes) = guessed(&cuboid(true, &all));
    assert!(inside(&scene) && notes.contains("my.obj: seen as a room from inside, camera ("), "{notes}");
    assert_eq!(scene.triangle_count(), 12, "a room gets no ground");
    // Open towards +z: seen through the opening, however it is wound.
    for inward in [false, true] {
        let (scene, notes) = guessed(&cuboid(inward, &[0, 1, 2, 3, 4]));
        assert!(scene.camera().eye.z > 1.0 && notes.contains("through its open side"), "{notes}");
        assert!(notes.contains("looking at (0, 0, 0), light at (0, 0.7, 0)"), "{notes}");
    }
}

#[test]
fn a_ground_where_there_is_none() {
    let (scene, notes) = guessed(&cuboid(false, &[0, 1, 2, 3, 4, 5]));
    assert_eq!(scene.triangle_count(), 14);
    // A thousandth of the diagonal below.
    assert!(notes.contains("a ground added at y = -1.003;"), "{notes}");
    let ray = |x: f64, y: f64, up: f64| {
        let ray = hostsim::scene::Ray { origin: Vec3::new(x, y, 0.1), direction: Vec3::new(0.0, up, 0.0) };
        scene.nearest(&ray).map(|hit| hit.position.y)
    };
    assert!((ray(2.0, 5.0, -1.0).unwrap() + 1.0 + 12f64.sqrt() * 1e-3).abs() < 1e-12);

    let plane = "v -3 -1 -3\nv 3 -1 -3\nv 3 -1 3\nv -3 -1 3\nf -1 -2 -3 -4\n";
    let (scene, notes) = guessed(&(cuboid(false, &[0, 1, 2, 3, 4, 5]) + plane));
    assert_eq!(scene.triangle_count(), 14);
    assert!(notes.contains("seen from outside") && notes.contains("no ground added"), "{notes}");
}

#[test]
fn material_problems_are_noted() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let faces = "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl c\nf 1 2 4\n";
    let good = "newmtl a\nKd 0.1 0.2 0.3\nnewmtl b\nKd 0.5 0.5 0.5\nnewmtl c\n";
    for (library, mtl, expected) in [
        ("mtllib missing.mtl\n", "", "my.obj: missing.mtl cannot be read ("),
        ("mtllib missing.mtl\n", "", "); its 3 materials are grey: a, b, c"),
        ("mtllib my.mtl\nmtllib missing.mtl\n", good, "my.obj: missing.mtl cannot be read ("),
        ("mtllib my.mtl\n", "# none\n", "my.obj: my.mtl defines no material"),
        ("mtllib my.mtl\n", "newmtl a\n", "my.obj: no MTL file defines b, c: 2 triangles"),
        (
            "mtllib my.mtl\n",
            "newmtl a\nKd 0.8 zero 0.8\n",
            "my.mtl line 2 is left out, for `Kd 0.8 zero 0.8`",
        ),
        ("mtllib my.mtl\n", "newmtl a\nKd 0.8 1.5 0.8\n", "not from 0 to 1 are clamped: a"),
        ("mtllib my.mtl\n", "newmtl a\nillum 3\nKs 2 2 2\n", "not from 0 to 1 are clamped: a"),
        ("mtllib my.mtl\n", "newmtl a\nKd nan 1 1\n", "not from 0 to 1 are clamped: a"),
        ("mtllib my.mtl\n", "newmtl a\nKe 5 5 5\n", "emission (Ke) is ignored"),
        ("mtllib my.mtl\n", "newmtl a\nd 0.5\n", "taken as opaque and diffuse: a"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        write(&folder, "my.mtl", mtl);
        let scene = load(&write(&folder, "my.obj", &format!("{library}{square}{faces}"))).unwrap();
        let notes = scene.notes().join("\n");
        assert!(notes.contains(expected), "{library}{mtl}: {notes}");
        assert!(scene.notes().iter().all(|note| note.starts_with("my.obj: ")), "{notes}");
    }
    // A bad line costs itself, not the file; files may share a line; a good library gives no note of its own.
    let folder = tempfile::tempdir().unwrap();
    write(&folder, "one.mtl", "newmtl a\nNi x\nKd 0.1 0.2 0.3\n");
    write(&folder, "two.mtl", "newmtl b\nnewmtl c\n");
    let text = format!("mtllib one.mtl two.mtl\n{square}{faces}");
    let scene = load(&write(&folder, "my.obj", &text)).unwrap();
    assert_eq!(scene.notes().len(), 2, "{:?}", scene.notes());
    let ray = hostsim::scene::Ray { origin: Vec3::new(0.9, 0.5, 3.0), direction: Vec3::new(0.0, 0.0, -1.0) };
    let hit = scene.nearest(&ray).unwrap();
    assert_eq!(hit.material, Material::Diffuse { colour: Vec3::new(0.1, 0.2, 0.3) });
    // So does a mesh which a scene file names.
    let (head, _) = GOOD.split_once("[materials]").unwrap();
    let scene = load(&write(&folder, "my.toml", &format!("mesh = \"my.obj\"\n{head}"))).unwrap();
    assert!(scene.notes()[0].starts_with("my.obj: one.mtl line 2 is left out"), "{:?}", scene.notes());
}

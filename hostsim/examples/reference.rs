//! Renders a scene by the f64 estimator alone: `cargo run --release --example reference -- SCENE [WIDTHxHEIGHT [FILE.png]]`.
//!
//! It prints what each pass took, and the speed of the scalar f32 loop beside that of the f64 one.

use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

use hostsim::grid::HashGrid;
use hostsim::oracle::{Bits24, Number, Reference, Scalar};
use hostsim::picture::{compare, save, tone_map};
use hostsim::scene::{LoadOptions, Scene};
use hostsim::trace::{PhotonChunk, chunks, eye_pass};

fn timed<T>(sum: &mut Duration, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *sum += start.elapsed();
    result
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "cornell-balls".to_owned());
    let size = arguments.next().unwrap_or_else(|| "320x240".to_owned());
    let file = arguments.next().unwrap_or_else(|| "reference.png".to_owned());
    let (width, height) = size.split_once('x').ok_or("a size is WIDTHxHEIGHT, such as 320x240")?;
    let (width, height): (u32, u32) = (width.parse()?, height.parse()?);
    let emitted = 10 * width * height;

    let mut times = [Duration::ZERO; 8];
    let [load, eye, build, trace, f64_loop, f32_loop, f32_normal, f24_loop] = &mut times;
    let scene = timed(load, || Scene::load(&name, &LoadOptions::default()))?;
    for note in scene.notes() {
        println!("note: {note}");
    }
    let points = timed(eye, || eye_pass(&scene, width, height));
    let grid = timed(build, || HashGrid::build(&points, width, height))?;
    let mut reference = Reference::new(&points, grid.radius(), true);
    let mut plain: Scalar<f32> = Scalar::new(&points, grid.radius(), 0.7, false);
    let mut tested: Scalar<f32> = Scalar::new(&points, grid.radius(), 0.7, true);
    let mut narrow: Scalar<Bits24> = Scalar::new(&points, grid.radius(), 0.7, true);
    let mut chunk = PhotonChunk::default();
    for range in chunks(emitted, 1 << 15) {
        timed(trace, || chunk.fill(&scene, &grid, range));
        timed(f64_loop, || reference.feed(&chunk, grid.entries()));
        timed(f32_loop, || plain.feed(&chunk, grid.entries()));
        timed(f32_normal, || tested.feed(&chunk, grid.entries()));
        timed(f24_loop, || narrow.feed(&chunk, grid.entries()));
    }
    let counts = reference.counts();
    println!(
        "{} triangles, {} hit points, {} index entries, {counts:?}",
        scene.triangle_count(),
        points.len(),
        grid.entries().len()
    );
    let picture = tone_map(&reference.radiance(width * height, emitted), width, height)?;
    let numbers = 0..points.len() as u32;
    let wide = |p: Vec<[f32; 3]>| p.into_iter().map(|c| c.map(f64::from)).collect::<Vec<_>>();
    for (what, scalar) in [("without", &plain), ("with", &tested)] {
        let radiance = wide(scalar.radiance(width * height, emitted, numbers.clone()));
        let other = tone_map(&radiance, width, height)?;
        println!(
            "f32 {what} normal test, {} updates: {:?}",
            scalar.counts().updates,
            compare(&picture, &other)?
        );
    }
    let radiance = narrow.radiance(width * height, emitted, numbers);
    let radiance: Vec<_> = radiance.into_iter().map(|c| c.map(Number::to_f64)).collect();
    println!("f24 with normal test: {:?}", compare(&picture, &tone_map(&radiance, width, height)?)?);
    save(&picture, Path::new(&file))?;

    let names = [
        "load",
        "eye pass",
        "grid",
        "photons",
        "f64 loop",
        "f32 loop",
        "f32 with normals",
        "f24 with normals",
    ];
    for (name, time) in names.iter().zip(times) {
        print!("{name:18}{:8.3} s", time.as_secs_f64());
        if name.contains("loop") || name.contains("normals") {
            print!("{:9.2} M operations/s", counts.operations as f64 / time.as_secs_f64() / 1e6);
        }
        println!();
    }
    Ok(())
}

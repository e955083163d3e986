//! Does a camera see what its geometry says, and a frame measure what its plane is?

mod common;

use common::displacer::{camera, plane};
use lucerna_driver::displace::{Camera, Plane};
use proptest::prelude::*;

#[test]
fn a_camera_sees_the_plane_under_its_pixels() {
    // 200 by 200 at y = 0; u = x / 200 + 0.5, v = 0.5 - z / 200; the oblique view of Tables 2 to 4.
    let plane = Plane { height_scale: 0.1, ..plane() };
    let camera = Camera {
        position: [76.099_495, 43.191_154, -110.108_97],
        up: [0.0, 1.0, 0.0],
        width: 1024,
        height: 768,
        ..camera()
    };
    let camera = camera.looking_at([75.590_89, 42.676_582, -109.418_68]);
    let frame = plane.frame().unwrap();
    let raster = camera.raster(&plane).unwrap();
    let eye = camera.position.map(f64::from);
    let mut seen = 0;
    for (column, row) in [(0, 767), (512, 400), (511, 500), (1023, 767), (100, 600)] {
        let view = raster.view(column, row).map(f64::from);
        // As the unit does it: D = V'xy · scale / -V'z, P = eye + D · height.
        let [x, y, z] = frame.apply(raster.view(column, row)).map(f64::from);
        assert!(z < 0.0);
        let scale = f64::from(plane.height_scale);
        let found = [
            f64::from(raster.eye[0]) + x * scale / -z * f64::from(raster.eye[2]),
            f64::from(raster.eye[1]) + y * scale / -z * f64::from(raster.eye[2]),
        ];
        // As geometry says: down to y = 0.
        let down = eye[1] / -view[1];
        let wanted = [(eye[0] + view[0] * down) / 200.0 + 0.5, 0.5 - (eye[2] + view[2] * down) / 200.0];
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-5 * (1.0 + wanted.abs()), "{found} {wanted}");
        }
        seen += usize::from(wanted.iter().all(|coordinate| (0.0..1.0).contains(coordinate)));
    }
    assert!(seen >= 3, "most of these pixels are on the plane: {seen}");
    // The eye is 43.19 over the plane, whose displacement is 20 deep.
    assert!((raster.eye[2] - 43.191_154 / 20.0).abs() < 1e-5);
    assert_eq!((raster.extent, Plane { bounded: false, ..plane }.extent()), ([1.0, 1.0], [0.0, 0.0]));
    // The middle of the picture is where the camera looks.
    let middle: Vec<f64> = (0..3)
        .map(|axis| {
            let at = |column, row| f64::from(raster.view(column, row)[axis]);
            (at(511, 383) + at(512, 384)) / 2.0
        })
        .collect();
    let aim = camera.direction.map(f64::from);
    let cosine = (0..3).map(|axis| middle[axis] * aim[axis]).sum::<f64>()
        / (middle.iter().map(|x| x * x).sum::<f64>() * aim.iter().map(|x| x * x).sum::<f64>()).sqrt();
    assert!(cosine > 1.0 - 1e-9);
    // The picture is 45 degrees high, and down in it is down in the world.
    let height = (0..3).map(|axis| f64::from(raster.down[axis] * 768.0).powi(2)).sum::<f64>().sqrt();
    assert!((height - 2.0 * (22.5f64).to_radians().tan()).abs() < 1e-6);
    assert!(raster.down[1] < 0.0 && raster.right[1].abs() < 1e-9);
}

proptest! {
    #[test]
    fn a_frame_takes_edges_to_texture_units(
        tangent in prop::array::uniform3(-10f32..10.0),
        bitangent in prop::array::uniform3(-10f32..10.0),
        normal in prop::array::uniform3(-10f32..10.0),
        repeat in prop::array::uniform2(0.5f32..8.0),
    ) {
        // Skew is fine, flat is not.
        let volume = (0..3).map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            tangent[i] * (bitangent[j] * normal[k] - bitangent[k] * normal[j])
        }).sum::<f32>();
        prop_assume!(volume.abs() > 20.0);
        let plane = Plane { tangent, bitangent, normal, repeat, ..plane() };
        let frame = plane.frame().unwrap();
        let [u, v] = repeat;
        let near = |found: [f32; 3], wanted: [f32; 3]| {
            found.into_iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 2e-3 * (1.0 + wanted.abs()))
        };
        prop_assert!(near(frame.apply(tangent), [u, 0.0, 0.0]), "{:?}", frame.apply(tangent));
        prop_assert!(near(frame.apply(bitangent), [0.0, v, 0.0]), "{:?}", frame.apply(bitangent));
        let [x, y, up] = frame.apply(normal);
        prop_assert!(up > 0.0 && x.abs() < 2e-3 * (1.0 + up) && y.abs() < 2e-3 * (1.0 + up));
    }
}

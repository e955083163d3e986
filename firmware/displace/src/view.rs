//! The view calculation (§4.1); in: a ray record or a pixel, out: where the ray meets the top plane and how it runs below it;
//! cost: [`VIEW_LIST`](crate::operators::VIEW_LIST) and [`VIEW_RASTER`](crate::operators::VIEW_RASTER).
//!
//! The view vector is turned into tangent space, then divided by its descent, so that the ray is `entry + direction · t` with
//! `t` from 0 at the top plane to 1 at the bottom. The height scale is already in the matrix' first two rows.

use lucerna_softfloat::Format;

use crate::job::Raster;
use crate::record::RayRecord;

/// What the view calculation makes of a ray.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum View<F> {
    /// To be traversed.
    Ray {
        /// Texture coordinate at the top plane.
        entry: [F; 2],
        /// What `t = 1` adds to it.
        direction: [F; 2],
    },
    /// A pixel beside the surface, or one that looks over its horizon.
    Miss,
    /// A ray that does not come down on the surface (P18).
    Grazing,
}

/// A ray from memory.
#[inline]
pub fn list<F: Format>(tbn: &[[F; 3]; 3], ray: &RayRecord<F>) -> View<F> {
    match descent(tbn, ray.view) {
        Some(direction) => View::Ray { entry: ray.entry, direction },
        None => View::Grazing,
    }
}

/// A pixel of a raster, column and row from 0.
#[inline]
pub fn raster<F: Format>(tbn: &[[F; 3]; 3], camera: &Raster<F>, column: u32, row: u32) -> View<F> {
    let Some(direction) = descent(tbn, pixel(camera, column, row)) else { return View::Miss };
    let [u, v, height] = camera.eye;
    let entry = F::along([u, v], direction, height);
    // An extent of 0 has no end, nor a beginning.
    let inside = |p: F, extent: F| extent.eq(F::ZERO) || (F::ZERO.le(p) && p.lt(extent));
    if inside(entry[0], camera.extent[0]) && inside(entry[1], camera.extent[1]) {
        View::Ray { entry, direction }
    } else {
        View::Miss
    }
}

/// The view vector of a pixel, by the raster source: `(ORIGIN + row · DOWN) + column · RIGHT`.
#[inline]
pub fn pixel<F: Format>(camera: &Raster<F>, column: u32, row: u32) -> [F; 3] {
    // A raster's side is a 16-bit field, so both are exact in every format of 16 fraction bits.
    let [column, row] = [column, row].map(|x| F::from_scaled(x.min(0xFFFF) as i32, 0));
    core::array::from_fn(|axis| {
        camera.origin[axis].add(row.mul(camera.down[axis])).add(column.mul(camera.right[axis]))
    })
}

/// Sideways over downwards, when it goes downwards: a z that is NaN, 0 or positive does not. It takes the sign bit and the
/// number's class to tell, no comparator.
#[inline]
fn descent<F: Format>(tbn: &[[F; 3]; 3], view: [F; 3]) -> Option<[F; 2]> {
    let [tangent, bitangent, normal] = tbn;
    let [z] = F::dots([normal], &view);
    if !z.lt(F::ZERO) {
        return None;
    }
    // Of a number that is not 0 this flips the sign bit and nothing else.
    let down = F::ZERO.sub(z);
    Some(F::dots([tangent, bitangent], &view).map(|sideways| sideways.div(down)))
}

#[cfg(test)]
mod tests {
    use super::{View, list, pixel, raster};
    use crate::job::Raster;
    use crate::record::RayRecord;
    use lucerna_softfloat::{F24, F32, Format};
    use proptest::prelude::*;

    const TBN: [[f32; 3]; 3] = [[0.25, 0.0, 0.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.0]];

    fn matrix<F: Format>(rows: [[f32; 3]; 3]) -> [[F; 3]; 3] {
        rows.map(|row| row.map(F::from_f32))
    }

    fn ray<F: Format>(entry: [f32; 2], view: [f32; 3]) -> RayRecord<F> {
        RayRecord { entry: entry.map(F::from_f32), view: view.map(F::from_f32) }
    }

    fn camera<F: Format>(extent: [f32; 2]) -> Raster<F> {
        let of = |v: [f32; 3]| v.map(F::from_f32);
        Raster {
            width: 4,
            height: 4,
            origin: of([-1.0, -2.0, 1.0]),
            right: of([0.5, 0.0, 0.0]),
            down: of([0.0, 0.0, -0.5]),
            eye: of([0.5, 0.5, 2.0]),
            extent: extent.map(F::from_f32),
        }
    }

    fn by_hand<F: Format>() {
        let tbn = matrix::<F>(TBN);
        // World (3, -2, 1): tangent (0.75, 0.25, -2), over its descent (0.375, 0.125).
        let expected =
            View::Ray { entry: [0.5, 0.25].map(F::from_f32), direction: [0.375, 0.125].map(F::from_f32) };
        assert_eq!(list(&tbn, &ray([0.5, 0.25], [3.0, -2.0, 1.0])), expected);
        // Pixel (3, 1): view (0.5, -2, 0.5), direction (1/16, 1/16), entry 0.5 + 2/16.
        let expected = View::Ray { entry: [F::from_f32(0.625); 2], direction: [F::from_f32(0.0625); 2] };
        assert_eq!(raster(&tbn, &camera([1.0, 1.0]), 3, 1), expected);
    }

    #[test]
    fn values_worked_by_hand() {
        by_hand::<F32>();
        by_hand::<F24>();
    }

    fn never_down<F: Format>() {
        let tbn = matrix::<F>(TBN);
        for z in [0.0, -0.0, 1.0, f32::INFINITY, f32::NAN] {
            assert_eq!(list(&tbn, &ray([0.5, 0.5], [1.0, z, 1.0])), View::Grazing, "{z}");
            let level = Raster { origin: [1.0, z, 1.0].map(F::from_f32), ..camera::<F>([0.0, 0.0]) };
            assert_eq!(raster(&tbn, &level, 0, 0), View::Miss, "{z}");
        }
    }

    #[test]
    fn a_ray_that_does_not_come_down_is_none() {
        never_down::<F32>();
        never_down::<F24>();
    }

    #[test]
    fn the_extent_has_its_first_edge_and_not_its_last() {
        let tbn = matrix::<F32>(TBN);
        let straight_down = |eye: [f32; 2], extent: [f32; 2]| {
            let camera = Raster {
                origin: [0.0, -1.0, 0.0].map(F32::from_f32),
                eye: [eye[0], eye[1], 2.0].map(F32::from_f32),
                ..camera(extent)
            };
            raster(&tbn, &camera, 0, 0) != View::Miss
        };
        assert!(straight_down([0.0, 0.5], [1.0, 1.0]));
        assert!(!straight_down([1.0, 0.5], [1.0, 1.0]));
        assert!(!straight_down([0.5, -0.001], [1.0, 1.0]));
        assert!(straight_down([-7.0, 0.5], [0.0, 1.0]), "an extent of 0 has no end");
        assert!(!straight_down([-7.0, 1.5], [0.0, 1.0]), "each axis has its own");
        assert!(!straight_down([f32::NAN, 0.5], [1.0, 1.0]));
    }

    #[test]
    fn pixels_are_summed_in_their_order() {
        let camera = camera::<F24>([0.0, 0.0]);
        let at = |column, row| pixel(&camera, column, row).map(F24::to_f32);
        assert_eq!(at(0, 0), [-1.0, -2.0, 1.0]);
        assert_eq!(at(65535, 65535), [32766.5, -2.0, -32766.5]);
    }

    proptest! {
        /// Against binary64, for rays that come down at a fair angle.
        #[test]
        fn is_the_quotient_within_rounding(
            (x, y) in (-4.0f32..4.0, -4.0f32..4.0),
            z in -1.0f32..-0.25,
            tbn in prop::array::uniform3(prop::array::uniform3(-0.05f32..0.05)),
        ) {
            let mut rows = TBN;
            for (row, noise) in rows.iter_mut().zip(tbn) {
                for (cell, noise) in row.iter_mut().zip(noise) { *cell += noise; }
            }
            let turned = rows.map(|row| (0..3).map(|i| f64::from(row[i]) * f64::from([x, z, y][i])).sum::<f64>());
            prop_assume!(turned[2] < -0.1);
            let expected = [-turned[0] / turned[2], -turned[1] / turned[2]];
            let view = list(&matrix::<F32>(rows), &ray([0.0, 0.0], [x, z, y]));
            let View::Ray { direction, .. } = view else { panic!("{view:?}") };
            for (got, expected) in direction.iter().zip(expected) {
                prop_assert!((f64::from(got.to_f32()) - expected).abs() < 2e-4, "{} {}", got.to_f32(), expected);
            }
        }

        /// Whatever the bits, there is an answer.
        #[test]
        fn is_total(bits in prop::collection::vec(any::<u32>(), 32)) {
            let f = |i: usize| F24::from_bits(bits[i]);
            let three = |i: usize| [f(i), f(i + 1), f(i + 2)];
            let tbn = [three(0), three(3), three(6)];
            list(&tbn, &RayRecord { entry: [f(9), f(10)], view: three(11) });
            let camera = Raster {
                width: 1, height: 1, origin: three(14), right: three(17), down: three(20), eye: three(23),
                extent: [f(26), f(27)],
            };
            raster(&tbn, &camera, bits[28], bits[29]);
        }
    }
}

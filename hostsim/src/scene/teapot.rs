//! In: how fine. Out: Martin Newell's teapot (1975) as triangles, standing on the origin, spout along +x.
//! Cost: 64·detail² triangles.
//!
//! The 32 bicubic Bézier patches are not listed one by one. Six profiles, each a cubic turned about the axis in four quarters,
//! make 24 of them: rim, upper body, lower body, knob, lid, bottom. Handle and spout are two patches each, mirrored.

use super::Vec3;

/// A profile's control point: distance from the axis and height.
type Ring = (f64, f64);

/// The quarter circle's inner control points, as a share of the radius, in Newell's data.
const QUARTER: f64 = 0.56;

/// From the inside outward and downward, so that the surface's outside is on the same hand all along.
const PROFILES: [[Ring; 4]; 6] = [
    [(0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)], // knob
    [(0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)],  // lid
    [(1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)], // rim
    [(1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)], // upper body
    [(2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)], // lower body
    [(1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)], // bottom
];

/// Half of a tube in the plane of symmetry: four stations along it, each with the tube's four control points round one side as
/// (x of the first two, z of the first two, x of the last two, z of the last two, half width).
type Tube = [(f64, f64, f64, f64, f64); 4];

const TUBES: [Tube; 4] = [
    // Handle, upper half: from the body outward.
    [
        (-1.6, 2.025, -1.5, 2.25, 0.3),
        (-2.3, 2.025, -2.5, 2.25, 0.3),
        (-2.7, 2.025, -3.0, 2.25, 0.3),
        (-2.7, 1.8, -3.0, 1.8, 0.3),
    ],
    // Handle, lower half: back to the body.
    [
        (-2.7, 1.8, -3.0, 1.8, 0.3),
        (-2.7, 1.575, -3.0, 1.35, 0.3),
        (-2.5, 1.125, -2.65, 0.9375, 0.3),
        (-2.0, 0.9, -1.9, 0.6, 0.3),
    ],
    // Spout, lower half: from the body outward.
    [
        (1.7, 1.425, 1.7, 0.6, 0.66),
        (2.6, 1.425, 3.1, 0.825, 0.66),
        (2.3, 2.1, 2.4, 2.025, 0.25),
        (2.7, 2.4, 3.3, 2.4, 0.25),
    ],
    // Spout, the lip.
    [
        (2.7, 2.4, 3.3, 2.4, 0.25),
        (2.8, 2.475, 3.525, 2.49375, 0.25),
        (2.9, 2.475, 3.45, 2.5125, 0.15),
        (2.8, 2.4, 3.2, 2.4, 0.15),
    ],
];

/// Sixteen control points, in Newell's axes: z is up.
type Patch = [[Vec3; 4]; 4];

fn quarter_of(profile: &[Ring; 4], quarter: usize) -> Patch {
    profile.map(|(radius, height)| {
        let q = QUARTER * radius;
        [(radius, 0.0), (radius, q), (q, radius), (0.0, radius)].map(|(x, y)| {
            let (x, y) = match quarter {
                0 => (x, y),
                1 => (-y, x),
                2 => (-x, -y),
                _ => (y, -x),
            };
            Vec3::new(x, y, height)
        })
    })
}

fn half_of(tube: &Tube, side: f64) -> Patch {
    tube.map(|(x0, z0, x1, z1, width)| {
        let row = [(x0, 0.0, z0), (x0, width, z0), (x1, width, z1), (x1, 0.0, z1)];
        row.map(|(x, y, z)| Vec3::new(x, y * side, z))
    })
}

/// The patches, each with whether its winding must be turned.
fn patches() -> Vec<(Patch, bool)> {
    let turned = PROFILES.iter().flat_map(|p| (0..4).map(|q| (quarter_of(p, q), false)));
    let tubes = TUBES.iter().flat_map(|t| [(half_of(t, 1.0), false), (half_of(t, -1.0), true)]);
    turned.chain(tubes).collect()
}

fn cubic(p: [Vec3; 4], t: f64) -> Vec3 {
    let s = 1.0 - t;
    p[0] * (s * s * s) + p[1] * (3.0 * s * s * t) + p[2] * (3.0 * s * t * t) + p[3] * (t * t * t)
}

/// The teapot with `detail` steps along each side of a patch; the poles' empty triangles are left out.
pub(super) fn teapot(detail: u32) -> Vec<[Vec3; 3]> {
    let steps = detail.max(1);
    let mut triangles = Vec::with_capacity(64 * (steps * steps) as usize);
    for (patch, turn) in patches() {
        let at = |i: u32, j: u32| {
            let (u, v) = (f64::from(i) / f64::from(steps), f64::from(j) / f64::from(steps));
            let p = cubic(patch.map(|row| cubic(row, v)), u);
            Vec3::new(p.x, p.z, -p.y)
        };
        for i in 0..steps {
            for j in 0..steps {
                let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                for [a, b, c] in [[a, b, c], [a, c, d]] {
                    if (b - a).cross(c - a).length() > 1e-9 {
                        triangles.push(if turn { [a, c, b] } else { [a, b, c] });
                    }
                }
            }
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::super::shapes::six_volumes;
    use super::*;

    #[test]
    fn there_are_32_patches_of_the_known_size() {
        assert_eq!(patches().len(), 32);
        let points = teapot(8).concat();
        let low = points.iter().fold(points[0], |a, &b| a.min(b));
        let high = points.iter().fold(points[0], |a, &b| a.max(b));
        // The handle bows to -3 and the lip reaches a little past 3.4; the knob is at 3.15.
        assert!((low.x + 3.0).abs() < 0.05 && (high.x - 3.43).abs() < 0.05, "{low:?} {high:?}");
        assert!(low.y.abs() < 1e-9 && (high.y - 3.15).abs() < 1e-9, "{low:?} {high:?}");
        assert!((low.z + 2.0).abs() < 0.01 && (high.z - 2.0).abs() < 0.01, "{low:?} {high:?}");
    }

    #[test]
    fn every_part_is_wound_outward() {
        let triangles = teapot(10);
        // Volume of the body's profile is about 6·(2² π · 2 · 0.8): the whole must be clearly positive.
        assert!(six_volumes(&triangles) > 60.0, "{}", six_volumes(&triangles));
        let normal = |t: &[Vec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).normalised();
        for t in &triangles {
            let m = (t[0] + t[1] + t[2]) * (1.0 / 3.0);
            let radial = Vec3::new(m.x, 0.0, m.z);
            // The lower and upper body, away from spout and handle.
            if m.z.abs() > 1.0 && (0.3..2.2).contains(&m.y) {
                assert!(normal(t).dot(radial) > 0.0, "{t:?}");
            }
            // The sides of handle and spout look sideways.
            if m.x.abs() > 2.2 && m.z.abs() > 0.18 {
                assert!(normal(t).z * m.z > 0.0, "{t:?}");
            }
            // The bottom looks down; the top of the knob up.
            if m.y < 0.01 && radial.length() < 1.0 {
                assert!(normal(t).y < 0.0, "{t:?}");
            }
            if m.y > 3.1 {
                assert!(normal(t).y > 0.0, "{t:?}");
            }
        }
    }
}

//! In: a shape's sizes and place. Out: its triangles, wound counter-clockwise seen from outside.

use super::Vec3;

/// Turn about the vertical axis, size, then place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    pub size: Vec3,
    /// Degrees about +y, counter-clockwise seen from above.
    pub turn: f64,
    pub position: Vec3,
}

impl Placement {
    pub fn apply(&self, corners: [Vec3; 3]) -> [Vec3; 3] {
        let (sin, cos) = self.turn.to_radians().sin_cos();
        corners.map(|p| {
            let p = p.scale(self.size);
            Vec3::new(p.x * cos + p.z * sin, p.y, p.z * cos - p.x * sin) + self.position
        })
    }
}

/// The hexahedron of side one that stands on the origin.
pub(super) fn unit_box() -> Vec<[Vec3; 3]> {
    let corner = |i: usize| {
        let pick = |bit: usize| f64::from(u8::from(i >> bit & 1 == 1));
        Vec3::new(pick(0) - 0.5, pick(1), pick(2) - 0.5)
    };
    // Corner numbers: bit 0 is +x, bit 1 is +y, bit 2 is +z.
    const FACES: [[usize; 4]; 6] =
        [[1, 3, 7, 5], [0, 4, 6, 2], [2, 6, 7, 3], [0, 1, 5, 4], [4, 5, 7, 6], [0, 2, 3, 1]];
    FACES
        .iter()
        .flat_map(|&[a, b, c, d]| [[corner(a), corner(b), corner(c)], [corner(a), corner(c), corner(d)]])
        .collect()
}

/// Six times the volume inside, positive when the winding is outward.
#[cfg(test)]
pub(super) fn six_volumes(triangles: &[[Vec3; 3]]) -> f64 {
    triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_is_closed_and_outward() {
        let triangles = unit_box();
        assert!((six_volumes(&triangles) - 6.0).abs() < 1e-12);
        for [a, b, c] in &triangles {
            let centre = Vec3::new(0.0, 0.5, 0.0);
            assert!((*b - *a).cross(*c - *a).dot(*a - centre) > 0.0);
        }
    }

    #[test]
    fn a_placement_keeps_volume_and_winding() {
        let placement =
            Placement { size: Vec3::new(2.0, 3.0, 4.0), turn: 25.0, position: Vec3::new(7.0, 8.0, 9.0) };
        let placed: Vec<_> = unit_box().into_iter().map(|t| placement.apply(t)).collect();
        assert!((six_volumes(&placed) - 6.0 * 24.0).abs() < 1e-9);
    }
}

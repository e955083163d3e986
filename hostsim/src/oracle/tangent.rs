//! In: a view vector as the device is given it. Out: the ray it makes of it, in its number format. Cost: some 20 operations.

use super::Number;

/// From world to tangent space, as the view calculation does it (§4.1).
#[derive(Clone, Copy, Debug)]
pub struct Tangent<N> {
    /// Rows tangent and bitangent, both times the depth of the displacement, and normal.
    rows: [[N; 3]; 3],
}

/// A raster's constants, rounded: of view vectors origin, right and down, and of the eye u, v and height.
#[derive(Clone, Copy, Debug)]
pub struct Pinhole<N> {
    vectors: [[N; 3]; 3],
    eye: [N; 3],
}

/// Texture coordinate at depth 0, and what to add to it for depth 1.
pub type RoundedRay = ([f64; 2], [f64; 2]);

impl<N: Number> Tangent<N> {
    /// The rows before the scale, and the scale.
    pub fn new(rows: [[f32; 3]; 3], scale: f32) -> Self {
        let scale = N::from_f32(scale);
        let [tangent, bitangent, normal] = rows.map(|row| row.map(N::from_f32));
        Self { rows: [tangent.map(|x| x.mul(scale)), bitangent.map(|x| x.mul(scale)), normal] }
    }

    /// What texture coordinates change by from depth 0 to depth 1; `None` when the vector does not come down.
    pub fn direction(&self, view: [N; 3]) -> Option<[N; 2]> {
        let [x, y, z] = self.rows.map(|row| {
            let [a, b, c] = [0, 1, 2].map(|i| row[i].mul(view[i]));
            a.add(b).add(c)
        });
        let down = N::ZERO.sub(z);
        (down > N::ZERO).then(|| [x.div(down), y.div(down)])
    }

    /// The ray of a record.
    pub fn of_record(&self, [u, v, x, y, z]: [f32; 5]) -> Option<RoundedRay> {
        let [u, v] = [u, v].map(N::from_f32);
        let direction = self.direction([x, y, z].map(N::from_f32))?;
        Some(([u.to_f64(), v.to_f64()], direction.map(N::to_f64)))
    }

    /// The ray of a raster's pixel, whether or not it meets the surface.
    pub fn of_pixel(&self, pinhole: &Pinhole<N>, column: u32, row: u32) -> Option<RoundedRay> {
        // Exact: a side is at most 4096 pixels.
        let [column, row] = [column, row].map(|n| N::from_f32(n as f32));
        let [origin, right, down] = pinhole.vectors;
        let view = [0, 1, 2].map(|i| origin[i].add(row.mul(down[i])).add(column.mul(right[i])));
        let direction = self.direction(view)?;
        let entry = [0, 1].map(|axis| pinhole.eye[axis].add(direction[axis].mul(pinhole.eye[2])));
        Some((entry.map(N::to_f64), direction.map(N::to_f64)))
    }
}

impl<N: Number> Pinhole<N> {
    /// From the words that the registers are given.
    pub fn new(vectors: [[f32; 3]; 3], eye: [f32; 3]) -> Self {
        Self { vectors: vectors.map(|vector| vector.map(N::from_f32)), eye: eye.map(N::from_f32) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Bits24;
    use super::*;

    const ROWS: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];

    #[test]
    fn directions_are_scaled_slopes() {
        let tangent = Tangent::<f64>::new(ROWS, 0.5);
        assert_eq!(tangent.direction([3.0, -2.0, 1.0]), Some([0.75, -0.25]));
        assert_eq!(tangent.direction([1.0, 0.0, 0.0]), None, "along the plane");
        assert_eq!(tangent.direction([1.0, 1.0, 0.0]), None, "upwards");
        assert_eq!(tangent.direction([1.0, f64::NAN, 0.0]), None);
        let ray = tangent.of_record([0.25, 0.5, 3.0, -2.0, 1.0]).unwrap();
        assert_eq!(ray, ([0.25, 0.5], [0.75, -0.25]));
    }

    #[test]
    fn pixels_are_rays_from_the_eye() {
        let tangent = Tangent::<f64>::new(ROWS, 0.5);
        let pinhole = Pinhole::new([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 2.0]], [0.5, 0.5, 4.0]);
        assert_eq!(tangent.of_pixel(&pinhole, 3, 1), Some(([6.5, -3.5], [1.5, -1.0])));
    }

    #[test]
    fn a_format_rounds_every_operation() {
        let (coarse, fine) = (Tangent::<Bits24>::new(ROWS, 0.2), Tangent::<f64>::new(ROWS, 0.2));
        let record = [0.1, 0.7, 0.3, -0.9, 0.2];
        let (coarse, fine) = (coarse.of_record(record).unwrap(), fine.of_record(record).unwrap());
        for axis in 0..2 {
            let error = (coarse.1[axis] - fine.1[axis]).abs() / fine.1[axis].abs();
            assert!(error > 0.0 && error < 3.0 / 65536.0, "{error}");
        }
    }
}

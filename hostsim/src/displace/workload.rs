//! A picture of a displaced surface, before any device; in: map, view and size, out: what the device is given, in f64; cost: a
//! division a pixel.

use rayon::prelude::*;

use super::map::HeightMap;
use super::procedural;
use super::ray::{Ray, Surface};
use super::view::{Raster, View};
use crate::oracle::{Bits24, Number, Pinhole, RoundedRay, Tangent};
use lucerna_driver::NumberFormat;

/// Rows tangent, bitangent and normal of the grid: u grows along x, v against z, height along y.
pub const TANGENT_ROWS: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];

/// Who makes the rays.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Source {
    /// The host: a record for each pixel that meets the surface.
    #[default]
    List,
    /// The device, from a camera: every pixel of the picture.
    Raster,
}

impl Source {
    /// As on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::List => "list",
            Self::Raster => "raster",
        }
    }
}

/// A surface, and the rays of a picture of it.
#[derive(Clone, Debug)]
pub struct Workload {
    /// Heights.
    pub map: HeightMap,
    /// Colours, texel by texel.
    pub texture: Vec<u32>,
    /// How it lies on the grid.
    pub surface: Surface,
    /// The camera.
    pub view: View,
    /// Its pixels.
    pub raster: Raster,
    /// Who makes the rays.
    pub source: Source,
    /// One for each pixel that meets the surface, in order.
    pub rays: Vec<Ray>,
}

impl Workload {
    /// The picture of `map` from `view`.
    pub fn new(map: HeightMap, surface: Surface, view: View, size: (u32, u32), source: Source) -> Self {
        let raster = view.raster(size.0, size.1);
        let rays = surface.rays(&view, &raster);
        Self { texture: procedural::texture(&map), map, surface, view, raster, source, rays }
    }

    /// Results of a job: as many as rays in a list, or pixels in a raster.
    pub fn results(&self) -> usize {
        match self.source {
            Source::List => self.rays.len(),
            Source::Raster => self.pixels(),
        }
    }

    /// Pixels of the picture.
    pub fn pixels(&self) -> usize {
        self.raster.width as usize * self.raster.height as usize
    }

    /// The pixel of a result.
    pub fn pixel(&self, result: usize) -> usize {
        match self.source {
            Source::List => self.rays[result].pixel as usize,
            Source::Raster => result,
        }
    }

    /// Texture coordinate under the eye and its height, as the registers are given them.
    pub fn eye(&self) -> [f32; 3] {
        self.surface.eye(&self.view).map(|x| x as f32)
    }

    /// The rays as a device of a format makes them, one a result; `None` for one that does not come down.
    pub fn rounded(&self, format: NumberFormat) -> Vec<Option<RoundedRay>> {
        match format {
            NumberFormat::F32 => self.rounded_to::<f32>(),
            NumberFormat::F24 => self.rounded_to::<Bits24>(),
            NumberFormat::F64 => self.rounded_to::<f64>(),
        }
    }

    fn rounded_to<N: Number + Send + Sync>(&self) -> Vec<Option<RoundedRay>> {
        let tangent = Tangent::<N>::new(TANGENT_ROWS, self.surface.scale as f32);
        match self.source {
            Source::List => self.rays.par_iter().map(|ray| tangent.of_record(ray.record())).collect(),
            Source::Raster => {
                let Raster { width, height, origin, right, down } = self.raster;
                let vectors = [origin, right, down].map(|vector| vector.map(|x| x as f32));
                let pinhole = Pinhole::<N>::new(vectors, self.eye());
                let pixels = (0..width * height).into_par_iter();
                pixels.map(|pixel| tangent.of_pixel(&pinhole, pixel % width, pixel / width)).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both sources describe the same picture.
    #[test]
    fn a_list_and_a_raster_have_the_same_rays() {
        let map = procedural::map("waves").unwrap();
        let surface = Surface { scale: 0.1, repeat: 3.0 };
        let list = Workload::new(map.clone(), surface, View::oblique(), (64, 48), Source::List);
        let raster = Workload::new(map, surface, View::oblique(), (64, 48), Source::Raster);
        assert!(list.results() > 2000 && raster.results() == 64 * 48);
        for (format, tolerance) in
            [(NumberFormat::F24, 4e-4), (NumberFormat::F32, 4e-6), (NumberFormat::F64, 1e-6)]
        {
            let (a, b) = (list.rounded(format), raster.rounded(format));
            for (result, ray) in list.rays.iter().enumerate() {
                let (a, b) = (a[result].unwrap(), b[list.pixel(result)].unwrap());
                for axis in 0..2 {
                    assert!((a.0[axis] - ray.entry[axis]).abs() < tolerance * 3.0, "{format:?}");
                    assert!((a.1[axis] - ray.direction[axis]).abs() < tolerance);
                    assert!((b.0[axis] - a.0[axis]).abs() < tolerance * 3.0, "{format:?}");
                }
            }
        }
    }
}

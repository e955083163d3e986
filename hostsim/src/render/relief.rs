//! What a displaced surface of a scene is made of; in: its map's and texture's names, out: heights, colours, normals; cost: a pass
//! over the texels.

use std::path::PathBuf;

use image::{ImageFormat, ImageReader};
use lucerna_driver::displace::{Image, Shape, channels, colour, components, normal};

use crate::displace::map::{HeightMap, LONGEST, MapError};
use crate::displace::procedural;
use crate::scene::{Displaced, MapName, Texture, Vec3};

/// The exponent of the tone mapping: a texture's numbers are meant for a screen, reflectances are not.
const GAMMA: f64 = 2.2;

/// Why a surface cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ReliefError {
    /// The height map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A name that no map has.
    #[error(
        "there is no built-in height map `{name}`: give one of {}, or the path of a .png file",
        procedural::names().join(", ")
    )]
    UnknownMap {
        /// What was asked for.
        name: String,
    },
    /// The texture.
    #[error("the texture {} cannot be used: {why}", path.display())]
    Texture {
        /// Which.
        path: PathBuf,
        /// Why, and what would do.
        why: String,
    },
}

/// Heights, colours and normals.
#[derive(Clone, Debug)]
pub struct Relief {
    map: HeightMap,
    shape: Shape,
    /// `0x00RRGGBB`, row by row.
    texture: Vec<u32>,
    texture_shape: Shape,
    /// As the driver packs them, of the map's shape.
    normals: Vec<u32>,
}

impl Relief {
    /// Loads what the scene names.
    ///
    /// # Errors
    /// [`ReliefError`], with what to do.
    pub fn load(surface: &Displaced) -> Result<Self, ReliefError> {
        let map = match surface.map() {
            MapName::BuiltIn(name) => {
                procedural::map(name).ok_or_else(|| ReliefError::UnknownMap { name: name.clone() })?
            }
            MapName::File(path) => HeightMap::load(path)?,
        };
        let shape = Shape::of(map.width(), map.height()).expect("a map's sides are checked when it is made");
        let (texture, texture_shape) = match surface.texture() {
            Texture::Plain => (vec![colour([u8::MAX; 3])], Shape::of(1, 1).expect("one texel")),
            Texture::ByHeight => (procedural::texture(&map), shape),
            Texture::File(path) => {
                picture(path).map_err(|why| ReliefError::Texture { path: path.clone(), why })?
            }
        };
        let heights = Image::new(shape, map.heights()).expect("a height a texel");
        let scale = surface.height_scale() as f32;
        let places = (0..shape.height()).flat_map(|y| (0..shape.width()).map(move |x| (x, y)));
        let normals = places.map(|(x, y)| normal(heights.normal_at(x, y, scale))).collect();
        Ok(Self { map, shape, texture, texture_shape, normals })
    }

    /// What a user should know of how the map was read.
    pub fn notes(&self) -> &[String] {
        self.map.notes()
    }

    /// The heights.
    pub fn heights(&self) -> Image<'_, u8> {
        Image::new(self.shape, self.map.heights()).expect("a height a texel")
    }

    /// The colours.
    pub fn texture(&self) -> Image<'_, u32> {
        Image::new(self.texture_shape, &self.texture).expect("a colour a texel")
    }

    /// The normals.
    pub fn normals(&self) -> Image<'_, u32> {
        Image::new(self.shape, &self.normals).expect("a normal a texel")
    }

    /// The normal of a leaf texel, in tangent space.
    pub fn normal(&self, texel: [i32; 2]) -> Vec3 {
        let [x, y] = texel.map(|c| c as u32);
        Vec3::from(components(self.normals().at(x, y)).map(f64::from))
    }

    /// The colour at a texture coordinate.
    pub fn colour(&self, at: [f64; 2]) -> Vec3 {
        let texel = |at: f64, side: u32| (at.rem_euclid(1.0) * f64::from(side)) as u32;
        let (shape, [u, v]) = (self.texture_shape, at);
        reflectance(channels(self.texture().at(texel(u, shape.width()), texel(v, shape.height()))))
    }
}

/// What a texture's colour reflects.
pub fn reflectance(colour: [u8; 3]) -> Vec3 {
    Vec3::from(colour.map(|c| (f64::from(c) / 255.0).powf(GAMMA)))
}

fn picture(path: &std::path::Path) -> Result<(Vec<u32>, Shape), String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{error}; give the path of a PNG file"))?;
    let reader = || ImageReader::with_format(std::io::Cursor::new(&bytes), ImageFormat::Png);
    // The header first, so that no picture of any size is unpacked to be refused.
    let (width, height) = reader().into_dimensions().map_err(|error| error.to_string())?;
    let shape = Shape::of(width, height).ok_or_else(|| {
        format!(
            "it is {width}x{height}; each side has to be a power of two from 1 to {LONGEST}: crop or resample it"
        )
    })?;
    let rgb = reader().decode().map_err(|error| error.to_string())?.to_rgb8();
    Ok((rgb.pixels().map(|pixel| colour(pixel.0)).collect(), shape))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{LoadOptions, Scene};
    use image::{GrayImage, Luma, Rgb, RgbImage};

    fn relief(folder: &std::path::Path, entries: &str) -> Result<Relief, ReliefError> {
        let text = format!(
            "[camera]\neye = [0, 1, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\nfield_of_view = 40\n\
             [light]\nposition = [0, 1, 0]\nintensity = [1, 1, 1]\n\
             [[displaced]]\ncorner = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, -1]\nheight_scale = 0.5\n\
             colour = [1, 1, 1]\n{entries}"
        );
        let scene = Scene::from_toml(&text, "trial", folder, &LoadOptions::default()).expect("it is right");
        Relief::load(&scene.displaced()[0])
    }

    #[test]
    fn maps_and_textures_come_from_files() {
        let folder = tempfile::tempdir().unwrap();
        GrayImage::from_fn(4, 2, |x, _| Luma([60 * x as u8])).save(folder.path().join("h.png")).unwrap();
        let red = |x, _| Rgb(if x == 1 { [255, 0, 0] } else { [0; 3] });
        RgbImage::from_fn(2, 1, red).save(folder.path().join("t.png")).unwrap();
        let relief = relief(folder.path(), "map = \"h.png\"\ntexture = \"t.png\"").unwrap();
        assert_eq!(relief.heights().at(2, 1), 120);
        assert_eq!(relief.colour([0.75, 0.1]), Vec3::new(1.0, 0.0, 0.0));
        assert_eq!(relief.colour([-0.75, 7.1]), Vec3::ZERO);
        // Up by 120 of 255 in two texels: half a texture unit; the depth is half a unit.
        let slope: f64 = 120.0 / 255.0 * 0.5 / 0.5;
        let expected = Vec3::new(-slope, 0.0, 1.0).normalised();
        assert!((relief.normal([1, 0]) - expected).length() < 0.01);
        assert_eq!(relief.normal([1, 0]), relief.normal([-3, 6]), "wraps");
    }

    #[test]
    fn what_is_not_there_is_explained() {
        let folder = tempfile::tempdir().unwrap();
        GrayImage::new(4, 4).save(folder.path().join("h.png")).unwrap();
        RgbImage::new(3, 1).save(folder.path().join("t.png")).unwrap();
        for (entries, expected) in [
            ("map = \"hills\"", "no built-in height map `hills`: give one of"),
            ("map = \"no.png\"", "no.png cannot be read"),
            ("map = \"h.png\"\ntexture = \"no.png\"", "no.png cannot be used"),
            ("map = \"h.png\"\ntexture = \"t.png\"", "power of two"),
        ] {
            let error = relief(folder.path(), entries).unwrap_err().to_string();
            assert!(error.contains(expected), "{entries}: {error}");
        }
    }
}

//! Height maps; in: a PNG file or heights, out: 8-bit heights with sides of powers of two, or why not; cost: a pass over the texels.

use std::path::{Path, PathBuf};

use image::{DynamicImage, ImageError, ImageFormat, ImageReader};

/// The longest side.
pub const LONGEST: u32 = 4096;

/// Heights, row by row from v = 0; 255 is the top plane.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct HeightMap {
    name: String,
    log2: [u32; 2],
    heights: Vec<u8>,
    notes: Vec<String>,
}

/// Why there is no map.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// The file cannot be opened.
    #[error(
        "the height map {path} cannot be read: {source}; give a PNG file or one of the built-in maps: {}",
        super::procedural::names().join(", ")
    )]
    Unreadable {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Neither a file nor built in.
    #[error(
        "{name:?} is neither a file nor a built-in height map; give a PNG file or one of the built-in maps: {}",
        super::procedural::names().join(", ")
    )]
    Unknown {
        /// What was asked for.
        name: String,
    },
    /// It is not a picture that can be read.
    #[error(
        "the height map {path} is no PNG file that can be read: {why}; save it as an 8- or 16-bit grey PNG"
    )]
    NotPng {
        /// Which.
        path: PathBuf,
        /// The reader's words.
        why: String,
    },
    /// Its sides are not what the unit takes.
    #[error(
        "the height map {name} is {width}x{height}; each side has to be a power of two from 1 to {LONGEST} (square or not): \
         crop or resample it"
    )]
    Sides {
        /// Which.
        name: String,
        /// Texels.
        width: u32,
        /// Texels.
        height: u32,
    },
    /// The heights do not fill it.
    #[error("the height map {name} has {count} heights, but {width}x{height} texels")]
    Count {
        /// Which.
        name: String,
        /// Heights given.
        count: usize,
        /// Texels.
        width: u32,
        /// Texels.
        height: u32,
    },
}

impl HeightMap {
    /// A map of given heights.
    ///
    /// # Errors
    /// [`MapError::Sides`] or [`MapError::Count`].
    pub fn new(name: &str, width: u32, height: u32, heights: Vec<u8>) -> Result<Self, MapError> {
        let name = name.to_owned();
        let log2 = sides(&name, width, height)?;
        if heights.len() != (width * height) as usize {
            return Err(MapError::Count { name, count: heights.len(), width, height });
        }
        Ok(Self { name, log2, heights, notes: Vec::new() })
    }

    /// A PNG file: grey of up to 16 bits is taken as it is, or rounded to the unit's 8; of colour, the luminance (Rec. 709).
    /// The map's name is the file's, without `_height`.
    ///
    /// # Errors
    /// [`MapError`], with what to do.
    pub fn load(path: &Path) -> Result<Self, MapError> {
        let stem = path.file_stem().map_or("map".into(), |stem| stem.to_string_lossy().into_owned());
        let name = stem.strip_suffix("_height").unwrap_or(&stem).to_owned();
        let unreadable = |source| MapError::Unreadable { path: path.to_owned(), source };
        let not_png = |error: ImageError| MapError::NotPng { path: path.to_owned(), why: error.to_string() };
        // Read at once: a folder opens as a file does, and fails only here.
        let bytes = std::fs::read(path).map_err(unreadable)?;
        let reader = || ImageReader::with_format(std::io::Cursor::new(&bytes), ImageFormat::Png);
        // The header is looked at first, so that no picture of any size is unpacked to be refused.
        let (width, height) = reader().into_dimensions().map_err(not_png)?;
        sides(&name, width, height)?;
        let (heights, notes) = grey(&reader().decode().map_err(not_png)?);
        Ok(Self { notes, ..Self::new(&name, width, height, heights)? })
    }

    /// The same map at half its sides while a side is longer than `longest`; a texel is the mean of the up to four it replaces.
    #[must_use]
    pub fn reduced(mut self, longest: u32) -> Self {
        let (width, height) = (self.width(), self.height());
        while self.width().max(self.height()) > longest.max(1) {
            let half = |log2: u32| log2.saturating_sub(1);
            let log2 = self.log2.map(half);
            let fold = [self.log2[0] - log2[0], self.log2[1] - log2[1]];
            let count = 1 << (fold[0] + fold[1]);
            let mean = |x: u32, y: u32| {
                let texels = (0..count).map(|i| {
                    u32::from(self.at((x << fold[0]) + (i & fold[0]), (y << fold[1]) + (i >> fold[0])))
                });
                ((texels.sum::<u32>() + count / 2) / count) as u8
            };
            let heights = (0..1 << log2[1]).flat_map(|y| (0..1 << log2[0]).map(move |x| (x, y)));
            let heights = heights.map(|(x, y)| mean(x, y)).collect();
            (self.log2, self.heights) = (log2, heights);
        }
        if (self.width(), self.height()) != (width, height) {
            self.notes.push(format!(
                "{} was reduced from {width}x{height} to {}x{} by the mean of 2x2 (P2)",
                self.name,
                self.width(),
                self.height()
            ));
        }
        self
    }

    /// Its name: a preset's, or a file's.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// What the user should know of how it was read.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
    /// Binary logarithms of width and height.
    pub const fn log2(&self) -> [u32; 2] {
        self.log2
    }
    /// Texels a row.
    pub const fn width(&self) -> u32 {
        1 << self.log2[0]
    }
    /// Rows.
    pub const fn height(&self) -> u32 {
        1 << self.log2[1]
    }
    /// All heights, row by row.
    pub fn heights(&self) -> &[u8] {
        &self.heights
    }
    /// A height; coordinates wrap.
    pub fn at(&self, x: u32, y: u32) -> u8 {
        let [x, y] = [x & (self.width() - 1), y & (self.height() - 1)];
        self.heights[(y << self.log2[0] | x) as usize]
    }
}

fn sides(name: &str, width: u32, height: u32) -> Result<[u32; 2], MapError> {
    let fits = |side: u32| side.is_power_of_two() && side <= LONGEST;
    if fits(width) && fits(height) {
        Ok([width.ilog2(), height.ilog2()])
    } else {
        Err(MapError::Sides { name: name.to_owned(), width, height })
    }
}

/// The heights of a picture, and what was done to them.
fn grey(picture: &DynamicImage) -> (Vec<u8>, Vec<String>) {
    let colour = picture.color();
    let mut notes = Vec::new();
    if colour.has_color() {
        notes.push("the height map is in colour: its luminance (Rec. 709) was taken".to_owned());
    }
    if colour.has_alpha() {
        notes.push("the height map's alpha channel was left out".to_owned());
    }
    if colour.bytes_per_pixel() / colour.channel_count() < 2 {
        return (picture.to_luma8().into_raw(), notes);
    }
    notes.push("the height map has 16 bits: they were rounded to the unit's 8".to_owned());
    let round = |height: u16| ((u32::from(height) + 128) / 257) as u8;
    (picture.to_luma16().into_raw().into_iter().map(round).collect(), notes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, ImageBuffer, Luma, Rgb, RgbImage};

    fn saved(picture: impl Into<DynamicImage>) -> Result<HeightMap, MapError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("hills_height.png");
        picture.into().save(&path).unwrap();
        HeightMap::load(&path)
    }

    #[test]
    fn grey_of_any_depth_is_read() {
        let map = saved(GrayImage::from_fn(4, 2, |x, y| Luma([(x + 10 * y) as u8]))).unwrap();
        assert_eq!((map.name(), map.log2(), map.notes().len()), ("hills", [2, 1], 0));
        assert_eq!(map.heights(), [0, 1, 2, 3, 10, 11, 12, 13]);
        assert_eq!(map.at(5, 3), 11, "wraps");
        let deep: ImageBuffer<Luma<u16>, _> = ImageBuffer::from_raw(2, 2, vec![0, 128, 129, 65535]).unwrap();
        let map = saved(deep).unwrap();
        assert_eq!(map.heights(), [0, 0, 1, 255]);
        assert!(map.notes()[0].contains("rounded"));
        let map = saved(RgbImage::from_pixel(1, 1, Rgb([0, 255, 0]))).unwrap();
        assert!((180..186).contains(&map.heights()[0]) && map.notes()[0].contains("luminance"));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        for (width, height) in [(3, 4), (4, 6), (8192, 1), (100, 100)] {
            let error = saved(GrayImage::new(width, height)).unwrap_err().to_string();
            assert!(
                error.contains(&format!("{width}x{height}")) && error.contains("power of two"),
                "{error}"
            );
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("text.png");
        std::fs::write(&path, "not a picture").unwrap();
        assert!(matches!(HeightMap::load(&path), Err(MapError::NotPng { .. })));
        assert!(matches!(HeightMap::load(folder.path()), Err(MapError::Unreadable { .. })));
        let error = HeightMap::load(Path::new("nowhere.png")).unwrap_err().to_string();
        assert!(error.contains("nowhere.png") && error.contains("built-in"), "{error}");
        assert!(HeightMap::new("x", 2, 2, vec![0; 3]).is_err());
    }

    #[test]
    fn means_replace_texels() {
        let map = HeightMap::new("m", 4, 2, vec![0, 1, 9, 9, 2, 3, 9, 9]).unwrap();
        assert_eq!(map.clone().reduced(4), map);
        let half = map.clone().reduced(2);
        assert_eq!((half.heights(), half.log2()), (&[2, 9][..], [1, 0]));
        assert_eq!(map.reduced(1).heights(), [6], "a side of one stays, and halves go up");
    }
}

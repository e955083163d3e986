//! Maps as a host has them. In: a slice, row by row. Out: texels. Cost: an index each; nothing is copied.

use core::fmt;

use lucerna_softfloat::F32;

use super::Shape;

/// A map as a host has it: texels row by row, x fastest, `width * height` of them.
///
/// Heights are bytes (255 is the top plane, P14), colours and normals words made by [`colour`] and [`normal`].
///
/// ```
/// use lucerna_driver::displace::{Image, Shape, colour};
///
/// let chequers = [colour([255, 0, 0]), colour([255; 3]), colour([255; 3]), colour([255, 0, 0])];
/// let texture = Image::new(Shape::new(1, 1).unwrap(), &chequers)?;
/// assert_eq!(texture.at(1, 0), 0x00FF_FFFF);
/// assert_eq!(texture.at(2, 0), 0x00FF_0000, "coordinates wrap");
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image<'a, T> {
    shape: Shape,
    texels: &'a [T],
}

impl<'a, T: Copy + Default> Image<'a, T> {
    /// An image of `shape` in a slice of exactly so many texels.
    pub fn new(shape: Shape, texels: &'a [T]) -> Result<Self, ImageError> {
        let wanted = shape.texels();
        if texels.len() != wanted as usize {
            return Err(ImageError { wanted });
        }
        Ok(Self { shape, texels })
    }

    /// Its width and height.
    pub const fn shape(&self) -> Shape {
        self.shape
    }

    /// Its texels, row by row.
    pub const fn texels(&self) -> &'a [T] {
        self.texels
    }

    /// A texel; coordinates wrap.
    pub fn at(&self, x: u32, y: u32) -> T {
        let [width, height] = [self.shape.width(), self.shape.height()];
        let place = (y & (height - 1)) * width + (x & (width - 1));
        self.texels.get(place as usize).copied().unwrap_or_default()
    }
}

impl Image<'_, u8> {
    /// The normal of a height map at a texel, in tangent space, of length one: central differences which wrap at the
    /// edges. `scale` is the depth of the displacement in texture units, as in
    /// [`Plane::height_scale`](super::Plane::height_scale).
    ///
    /// The same bits on every host: each operation rounds once, and the root is the soft one.
    pub fn normal_at(&self, x: u32, y: u32, scale: f32) -> [f32; 3] {
        let height = |dx: u32, dy: u32| f32::from(self.at(x.wrapping_add(dx), y.wrapping_add(dy)));
        let back = u32::MAX;
        // Heights of 255 are one `scale`; the neighbours are two texels apart.
        let step = scale / 510.0;
        let u = (height(back, 0) - height(1, 0)) * (step * self.shape.width() as f32);
        let v = (height(0, back) - height(0, 1)) * (step * self.shape.height() as f32);
        let length = root(u * u + v * v + 1.0);
        [u / length, v / length, 1.0 / length]
    }
}

/// The word of a colour: `0x00RRGGBB`.
pub const fn colour([red, green, blue]: [u8; 3]) -> u32 {
    u32::from_be_bytes([0, red, green, blue])
}

/// Red, green and blue of a colour's word.
pub const fn channels(word: u32) -> [u8; 3] {
    let [_, red, green, blue] = word.to_be_bytes();
    [red, green, blue]
}

/// The word of a normal of length one or less: `0x00ZZYYXX`, a byte c being (c − 128) / 127. Rounded to nearest, clipped
/// to ±1; a NaN becomes 0.
pub fn normal([x, y, z]: [f32; 3]) -> u32 {
    let byte = |component: f32| (component.clamp(-1.0, 1.0) * 127.0 + 128.5) as u8;
    let quiet = |component: f32| if component.is_nan() { 0.0 } else { component };
    let [x, y, z] = [x, y, z].map(|component| byte(quiet(component)));
    u32::from_le_bytes([x, y, z, 0])
}

/// The components of a normal's word.
pub fn components(word: u32) -> [f32; 3] {
    let [x, y, z, _] = word.to_le_bytes();
    [x, y, z].map(|byte| (f32::from(byte) - 128.0) / 127.0)
}

/// The square root, correctly rounded: `core` has none.
pub(crate) fn root(x: f32) -> f32 {
    F32::from_f32(x).sqrt().to_f32()
}

/// A slice does not hold as many texels as its shape has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ImageError {
    /// How many it should hold.
    pub wanted: u32,
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the slice is not as long as the shape has texels: pass exactly {}", self.wanted)
    }
}

impl core::error::Error for ImageError {}

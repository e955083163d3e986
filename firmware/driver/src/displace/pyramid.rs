//! The max pyramid of a height map (§2). In: heights. Out: words as they lie in device memory, all at once or as a
//! stream. Cost: a read a height, four thirds of a byte written each, and 1.8 KiB of stack; nothing is allocated.
//!
//! A texel of level l + 1 is the largest of the two or four below it, which are neighbours in Morton order. So one pass
//! over the heights makes all levels at the same time: each level has a block of its own that is passed on when it is
//! full.

use super::shape::MAX_LOG2;
use super::{Image, ImageError, Shape};

/// Words of a level that are passed on at a time.
pub const BLOCK: usize = 32;

/// Bytes in a block.
const BLOCK_BYTES: u32 = BLOCK as u32 * 4;

/// A level in the making.
#[derive(Clone, Copy)]
struct Level {
    block: [u32; BLOCK],
    /// Texels made so far.
    made: u32,
    /// The largest texel since the last one of the level above.
    largest: u8,
}

/// Makes the pyramid of `shape`, asking for each height once, in Morton order. `sink` gets the byte offset from the
/// pyramid's base, a multiple of 4, and the words there: all [`words`] of them, each once.
///
/// ```
/// use lucerna_driver::displace::{Shape, pyramid};
///
/// let mut memory = [0; 2];
/// pyramid::stream(Shape::new(1, 1).unwrap(), |x, y| (10 * y + x) as u8, |offset, words| {
///     let first = offset as usize / 4;
///     memory[first..first + words.len()].copy_from_slice(words);
///     Ok::<_, core::convert::Infallible>(())
/// })?;
/// assert_eq!(memory, [0x0B_0A_01_00, 11]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
///
/// # Errors
/// What `sink` fails with, at once.
pub fn stream<E>(
    shape: Shape,
    mut height: impl FnMut(u32, u32) -> u8,
    mut sink: impl FnMut(u32, &[u32]) -> Result<(), E>,
) -> Result<(), E> {
    let mut levels = [Level { block: [0; BLOCK], made: 0, largest: 0 }; MAX_LOG2 as usize + 1];
    // Levels of fewer than four texels share the last word.
    let (mut tail, mut in_tail) = (0, 0);
    for place in 0..shape.texels() {
        let (x, y) = shape.texel(place);
        let mut texel = height(x, y);
        for (number, level) in (0..=shape.root()).zip(&mut levels) {
            let texels = shape.level(number).texels();
            level.take(texel);
            if texels < 4 {
                tail |= u32::from(texel) << (8 * in_tail);
                in_tail += 1;
            } else if let Some(words) = level.full(texels) {
                sink(shape.level_offset(number) + level.made - words.len() as u32 * 4, words)?;
            }
            if !level.made.is_multiple_of(shape.arity(number)) {
                break;
            }
            texel = core::mem::take(&mut level.largest);
        }
    }
    if in_tail > 0 { sink(shape.pyramid_bytes() - in_tail, &[tail]) } else { Ok(()) }
}

impl Level {
    /// Adds a texel.
    fn take(&mut self, texel: u8) {
        let place = self.made % BLOCK_BYTES;
        if let Some(word) = self.block.get_mut(place as usize / 4) {
            let shift = 8 * (place % 4);
            *word = *word & !(0xFF << shift) | u32::from(texel) << shift;
        }
        self.made += 1;
        self.largest = self.largest.max(texel);
    }

    /// The words to pass on, if the block, or the level of `texels`, is full.
    fn full(&self, texels: u32) -> Option<&[u32]> {
        if self.made.is_multiple_of(BLOCK_BYTES) {
            return Some(&self.block);
        }
        // A level that ends within a block is that block: sizes are powers of two.
        if self.made == texels { self.block.get(..texels as usize / 4) } else { None }
    }
}

/// Words of a pyramid in device memory: its bytes, rounded up.
pub const fn words(shape: Shape) -> usize {
    shape.pyramid_bytes().div_ceil(4) as usize
}

/// Makes the pyramid of a height map in `memory`, which must hold exactly [`words`] of the image's shape.
pub fn build(heights: &Image<'_, u8>, memory: &mut [u32]) -> Result<(), ImageError> {
    let wanted = words(heights.shape());
    if memory.len() != wanted {
        return Err(ImageError { wanted: wanted as u32 });
    }
    let at = |x, y| heights.at(x, y);
    stream(heights.shape(), at, |offset, words| {
        let first = offset as usize / 4;
        if let Some(place) = memory.get_mut(first..first + words.len()) {
            place.copy_from_slice(words);
        }
        Ok(())
    })
}

/// Puts a colour or normal map into Morton order, a word a texel. `memory` must hold exactly as many words.
pub fn reorder(image: &Image<'_, u32>, memory: &mut [u32]) -> Result<(), ImageError> {
    let wanted = image.shape().texels();
    if memory.len() != wanted as usize {
        return Err(ImageError { wanted });
    }
    for (place, word) in (0..wanted).zip(memory) {
        let (x, y) = image.shape().texel(place);
        *word = image.at(x, y);
    }
    Ok(())
}

//! Block `window` at 0x080: Memory window. Generated from rdl/window.rdl by `regenerate`; do not edit.
//!
//! One of four ranges of device memory, from BASE up to but without LIMIT. The device touches nothing outside
//! the open windows, and each buffer of a job must lie wholly in one of them, otherwise START ends in error
//! WINDOW. Windows may overlap. They are latched at START.

/// Instances of the block.
pub const COUNT: usize = 4;
/// Byte offset of the first instance.
pub const FIRST: u32 = 0x080;
/// Bytes from an instance to the next.
pub const STRIDE: u32 = 0x8;

/// A register of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// First byte address. The first byte address in the window, a multiple of 4.
    Base,
    /// End byte address. The byte address just past the window. The window is closed when this is not above
    /// BASE, as at reset.
    Limit,
}

/// Which register of which instance is at a byte offset; the index is below [`COUNT`].
pub const fn at(offset: u32) -> Option<(usize, Part)> {
    if offset < FIRST || offset >= FIRST + STRIDE * COUNT as u32 {
        return None;
    }
    let index = ((offset - FIRST) / STRIDE) as usize;
    match (offset - FIRST) % STRIDE {
        0x0 => Some((index, Part::Base)),
        0x4 => Some((index, Part::Limit)),
        _ => None,
    }
}

/// Byte offset of BASE of an instance: First byte address. The first byte address in the window, a multiple
/// of 4.
///
/// Plain number, read-write; reset 0x0. An index of [`COUNT`] or more gives an offset outside the block.
pub const fn base(index: usize) -> u32 {
    FIRST + STRIDE * index as u32
}

/// Byte offset of LIMIT of an instance: End byte address. The byte address just past the window. The window
/// is closed when this is not above BASE, as at reset.
///
/// Plain number, read-write; reset 0x0. An index of [`COUNT`] or more gives an offset outside the block.
pub const fn limit(index: usize) -> u32 {
    FIRST + STRIDE * index as u32 + 0x4
}

//! A job's buffers in device memory, between jobs. In: elements. Out: elements. Cost: a block write or read per
//! 64 elements or fewer, through a kilobyte of stack.

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;

use crate::layout::{Buffer, Layout};
use crate::records::{HIT_POINT_WORDS, HitPoint, PIXEL_WORDS, decode};
use crate::{Cause, Error, Pree};

/// Hit points in a block.
const HIT_POINT_BLOCK: usize = 16;
/// Pixels in a block.
const PIXEL_BLOCK: usize = 64;
/// Index entries in a block; they need no buffer.
const INDEX_BLOCK: usize = 512;

impl<B: Bus, D: DelayNs> Pree<'_, B, D> {
    /// Writes hit points from number `first` on. Each must name a pixel the layout has; else nothing is written.
    pub fn write_hit_points(
        &mut self,
        layout: &Layout,
        first: u32,
        hit_points: &[HitPoint],
    ) -> Result<(), Error<B::Error>> {
        let mut address = self.span(layout, Buffer::HitPoints, first, hit_points.len(), HIT_POINT_WORDS)?;
        let pixels = layout.sizes().pixels;
        refer(hit_points.iter().position(|hit_point| hit_point.pixel >= pixels))?;
        let mut block = [[0; HIT_POINT_WORDS]; HIT_POINT_BLOCK];
        for chunk in hit_points.chunks(HIT_POINT_BLOCK) {
            for (record, hit_point) in block.iter_mut().zip(chunk) {
                *record = hit_point.pack(layout.format());
            }
            let words = block.as_flattened().get(..chunk.len() * HIT_POINT_WORDS).unwrap_or_default();
            self.device.store(address, words)?;
            address += bytes(words.len());
        }
        Ok(())
    }

    /// Reads hit points from number `first` on.
    pub fn read_hit_points(
        &mut self,
        layout: &Layout,
        first: u32,
        hit_points: &mut [HitPoint],
    ) -> Result<(), Error<B::Error>> {
        let mut address = self.span(layout, Buffer::HitPoints, first, hit_points.len(), HIT_POINT_WORDS)?;
        let mut block = [[0; HIT_POINT_WORDS]; HIT_POINT_BLOCK];
        for chunk in hit_points.chunks_mut(HIT_POINT_BLOCK) {
            let words = block.as_flattened_mut().get_mut(..chunk.len() * HIT_POINT_WORDS).unwrap_or_default();
            self.device.fetch(address, words)?;
            address += bytes(words.len());
            for (record, hit_point) in block.iter().zip(chunk) {
                *hit_point = HitPoint::unpack(layout.format(), record);
            }
        }
        Ok(())
    }

    /// Writes index entries from number `first` on. Each must name a hit point the layout has; else nothing is
    /// written.
    pub fn write_index(
        &mut self,
        layout: &Layout,
        first: u32,
        entries: &[u32],
    ) -> Result<(), Error<B::Error>> {
        let mut address = self.span(layout, Buffer::Index, first, entries.len(), 1)?;
        let hit_points = layout.sizes().hit_points;
        refer(entries.iter().position(|entry| *entry >= hit_points))?;
        for chunk in entries.chunks(INDEX_BLOCK) {
            self.device.store(address, chunk)?;
            address += bytes(chunk.len());
        }
        Ok(())
    }

    /// Sets all pixels to zero, as evaluation adds to them.
    pub fn zero_pixels(&mut self, layout: &Layout) -> Result<(), Error<B::Error>> {
        let pixels = layout.sizes().pixels as usize;
        let mut address = self.span(layout, Buffer::Pixels, 0, pixels, PIXEL_WORDS)?;
        let block = [0; PIXEL_BLOCK * PIXEL_WORDS];
        let mut left = pixels * PIXEL_WORDS;
        while left > 0 {
            let words = block.get(..left).unwrap_or(&block);
            self.device.store(address, words)?;
            address += bytes(words.len());
            left -= words.len();
        }
        Ok(())
    }

    /// Reads pixels from number `first` on, as host numbers: exact in both formats.
    pub fn read_pixels(
        &mut self,
        layout: &Layout,
        first: u32,
        pixels: &mut [[f32; 3]],
    ) -> Result<(), Error<B::Error>> {
        self.pixels(layout, first, pixels, |bits| decode(layout.format(), bits))
    }

    /// Reads pixels from number `first` on, as bits of the device's format: for digests.
    pub fn read_pixel_bits(
        &mut self,
        layout: &Layout,
        first: u32,
        pixels: &mut [[u32; 3]],
    ) -> Result<(), Error<B::Error>> {
        self.pixels(layout, first, pixels, |bits| bits)
    }

    fn pixels<T>(
        &mut self,
        layout: &Layout,
        first: u32,
        pixels: &mut [[T; 3]],
        number: impl Fn(u32) -> T,
    ) -> Result<(), Error<B::Error>> {
        let mut address = self.span(layout, Buffer::Pixels, first, pixels.len(), PIXEL_WORDS)?;
        let mut block = [[0; PIXEL_WORDS]; PIXEL_BLOCK];
        for chunk in pixels.chunks_mut(PIXEL_BLOCK) {
            let words = block.as_flattened_mut().get_mut(..chunk.len() * PIXEL_WORDS).unwrap_or_default();
            self.device.fetch(address, words)?;
            address += bytes(words.len());
            for (record, pixel) in block.iter().zip(chunk) {
                *pixel = record.map(&number);
            }
        }
        Ok(())
    }

    /// The address of elements which the buffer has, on a device which is idle.
    fn span(
        &self,
        layout: &Layout,
        buffer: Buffer,
        first: u32,
        count: usize,
        words: usize,
    ) -> Result<u32, Error<B::Error>> {
        self.guard(layout)?;
        layout.span(buffer, first, count, words).ok_or(Error::untouched(Cause::OutsideBuffer))
    }
}

fn refer<E>(bad: Option<usize>) -> Result<(), Error<E>> {
    bad.map_or(Ok(()), |position| Err(Error::untouched(Cause::BadReference { position })))
}

const fn bytes(words: usize) -> u32 {
    words as u32 * 4
}

//! A displacement job's buffers in device memory, between jobs. In: maps and rays. Out: results. Cost: a block write or
//! read per 64 texels, 128 heights or 16 records, through a kilobyte or two of stack.

use embedded_hal::delay::DelayNs;
use lucerna_bus::Bus;

use super::layout::{Buffer, Layout};
use super::records::{RAY_WORDS, RESULT_WORDS, Ray, RayResult};
use super::{Displace, Image, Shape, pyramid};
use crate::{Cause, Error};

/// Records in a block.
const RECORD_BLOCK: usize = 16;
/// Texels in a block.
const TEXEL_BLOCK: usize = 64;
/// Results read raw in a block; they need no buffer.
const RAW_BLOCK: usize = 64;

impl<B: Bus, D: DelayNs> Displace<'_, B, D> {
    /// Writes a height map and the pyramid over it. The image must be as wide and high as the layout's map.
    pub fn write_map(&mut self, layout: &Layout, heights: &Image<'_, u8>) -> Result<(), Error<B::Error>> {
        self.guard(layout)?;
        fit(layout.sizes().map, heights.shape())?;
        self.write_map_with(layout, |x, y| heights.at(x, y))
    }

    /// The same from a function, which is asked for each texel once, in Morton order.
    pub fn write_map_with(
        &mut self,
        layout: &Layout,
        height: impl FnMut(u32, u32) -> u8,
    ) -> Result<(), Error<B::Error>> {
        self.guard(layout)?;
        let base = layout.region(Buffer::Map).base();
        pyramid::stream(layout.sizes().map, height, |offset, words| self.device.store(base + offset, words))
    }

    /// Writes a texture: words made by [`colour`](super::colour). The image must be as wide and high as the layout's
    /// texture.
    pub fn write_texture(
        &mut self,
        layout: &Layout,
        texture: &Image<'_, u32>,
    ) -> Result<(), Error<B::Error>> {
        self.guard(layout)?;
        fit(layout.sizes().texture, texture.shape())?;
        self.write_texture_with(layout, |x, y| texture.at(x, y))
    }

    /// The same from a function, which is asked for each texel once, in Morton order.
    pub fn write_texture_with(
        &mut self,
        layout: &Layout,
        texel: impl FnMut(u32, u32) -> u32,
    ) -> Result<(), Error<B::Error>> {
        self.guard(layout)?;
        self.texels(layout.region(Buffer::Texture).base(), layout.sizes().texture, texel)
    }

    /// Writes a normal map: words made by [`normal`](super::normal). The image must be as wide and high as the layout's
    /// normal map.
    pub fn write_normals(
        &mut self,
        layout: &Layout,
        normals: &Image<'_, u32>,
    ) -> Result<(), Error<B::Error>> {
        self.guard(layout)?;
        fit(layout.sizes().normals, normals.shape())?;
        self.write_normals_with(layout, |x, y| normals.at(x, y))
    }

    /// The same from a function, which is asked for each texel once, in Morton order. Normals of a height map:
    /// `|x, y| normal(heights.normal_at(x, y, scale))`.
    pub fn write_normals_with(
        &mut self,
        layout: &Layout,
        texel: impl FnMut(u32, u32) -> u32,
    ) -> Result<(), Error<B::Error>> {
        self.guard(layout)?;
        self.texels(layout.region(Buffer::Normals).base(), layout.sizes().normals, texel)
    }

    /// Writes rays from number `first` on.
    pub fn write_rays(&mut self, layout: &Layout, first: u32, rays: &[Ray]) -> Result<(), Error<B::Error>> {
        let mut address = self.span(layout, Buffer::Rays, first, rays.len())?;
        let mut block = [[0; RAY_WORDS]; RECORD_BLOCK];
        for chunk in rays.chunks(RECORD_BLOCK) {
            for (record, ray) in block.iter_mut().zip(chunk) {
                *record = ray.pack(layout.format());
            }
            let words = block.as_flattened().get(..chunk.len() * RAY_WORDS).unwrap_or_default();
            self.device.store(address, words)?;
            address += bytes(words.len());
        }
        Ok(())
    }

    /// Reads results from number `first` on: that of a ray has its number, that of a pixel `row * width + column`.
    pub fn read_results(
        &mut self,
        layout: &Layout,
        first: u32,
        results: &mut [RayResult],
    ) -> Result<(), Error<B::Error>> {
        let mut address = self.span(layout, Buffer::Results, first, results.len())?;
        let mut block = [[0; RESULT_WORDS]; RECORD_BLOCK];
        for chunk in results.chunks_mut(RECORD_BLOCK) {
            let words = block.as_flattened_mut().get_mut(..chunk.len() * RESULT_WORDS).unwrap_or_default();
            self.device.fetch(address, words)?;
            address += bytes(words.len());
            for (record, result) in block.iter().zip(chunk) {
                *result = RayResult::unpack(layout.format(), record);
            }
        }
        Ok(())
    }

    /// Reads result records from number `first` on as they are: for digests.
    pub fn read_result_words(
        &mut self,
        layout: &Layout,
        first: u32,
        records: &mut [[u32; RESULT_WORDS]],
    ) -> Result<(), Error<B::Error>> {
        let mut address = self.span(layout, Buffer::Results, first, records.len())?;
        for chunk in records.chunks_mut(RAW_BLOCK) {
            let words = chunk.as_flattened_mut();
            self.device.fetch(address, words)?;
            address += bytes(words.len());
        }
        Ok(())
    }

    /// Writes the texels of a map in Morton order.
    fn texels(
        &mut self,
        base: u32,
        shape: Shape,
        mut texel: impl FnMut(u32, u32) -> u32,
    ) -> Result<(), Error<B::Error>> {
        let mut block = [0; TEXEL_BLOCK];
        for first in (0..shape.texels()).step_by(TEXEL_BLOCK) {
            // A map smaller than a block is one.
            let count = shape.texels().min(TEXEL_BLOCK as u32);
            for (place, word) in (first..first + count).zip(&mut block) {
                let (x, y) = shape.texel(place);
                *word = texel(x, y) & 0x00FF_FFFF;
            }
            self.device.store(base + first * 4, block.get(..count as usize).unwrap_or(&block))?;
        }
        Ok(())
    }

    /// The address of records which the buffer has, on a device which is idle.
    fn span(
        &self,
        layout: &Layout,
        buffer: Buffer,
        first: u32,
        count: usize,
    ) -> Result<u32, Error<B::Error>> {
        self.guard(layout)?;
        layout.span(buffer, first, count).ok_or(Error::untouched(Cause::OutsideBuffer))
    }
}

fn fit<E>(wanted: Shape, shape: Shape) -> Result<(), Error<E>> {
    if wanted == shape { Ok(()) } else { Err(Error::untouched(Cause::WrongShape)) }
}

const fn bytes(words: usize) -> u32 {
    words as u32 * 4
}

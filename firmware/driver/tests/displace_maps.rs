//! Are maps in device memory what the host had: every texel in its place, every level the maximum of the one below?

use std::convert::Infallible;

use lucerna_driver::displace::pyramid::{build, reorder, stream, words};
use lucerna_driver::displace::{Image, ImageError, MAX_LOG2, Shape, channels, colour, components, normal};
use proptest::prelude::*;

/// The place of a texel, bit by bit.
fn place(shape: Shape, x: u32, y: u32) -> u32 {
    let [w, h] = shape.log2();
    let mut bits = Vec::new();
    for bit in 0..w.max(h) {
        if bit < w {
            bits.push(x >> bit & 1);
        }
        if bit < h {
            bits.push(y >> bit & 1);
        }
    }
    bits.iter().rev().fold(0, |place, bit| place << 1 | bit)
}

/// The pyramid level by level, each from the one below by coordinates, then put in its place byte by byte.
fn naive(heights: &Image<'_, u8>) -> Vec<u8> {
    let shape = heights.shape();
    let (mut width, mut height) = (shape.width() as usize, shape.height() as usize);
    let mut level = heights.texels().to_vec();
    let mut bytes = Vec::new();
    loop {
        let logs = Shape::of(width as u32, height as u32).unwrap();
        let mut placed = vec![None; level.len()];
        for y in 0..height {
            for x in 0..width {
                placed[place(logs, x as u32, y as u32) as usize] = Some(level[y * width + x]);
            }
        }
        bytes.extend(placed.into_iter().map(|texel| texel.expect("each place once")));
        if width == 1 && height == 1 {
            return bytes;
        }
        let (next_width, next_height) = (width.div_ceil(2), height.div_ceil(2));
        let mut next = vec![0; next_width * next_height];
        for y in 0..height {
            for x in 0..width {
                let above = &mut next[y / 2 * next_width + x / 2];
                *above = level[y * width + x].max(*above);
            }
        }
        (width, height, level) = (next_width, next_height, next);
    }
}

fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// Shapes up to 64 by 64 or 2^12 long, and heights for them.
fn map() -> impl Strategy<Value = (Shape, Vec<u8>)> {
    let logs = prop_oneof![3 => (0u32..=6, 0u32..=6), 1 => (0u32..=MAX_LOG2, 0u32..=1), 1 => (0u32..=1, 0u32..=MAX_LOG2)];
    logs.prop_flat_map(|(w, h)| {
        let shape = Shape::new(w, h).unwrap();
        (Just(shape), prop::collection::vec(any::<u8>(), shape.texels() as usize))
    })
}

proptest! {
    #[test]
    fn the_pyramid_is_that_of_its_definition((shape, heights) in map()) {
        let image = Image::new(shape, &heights).unwrap();
        let wanted = naive(&image);
        prop_assert_eq!(wanted.len(), shape.pyramid_bytes() as usize);
        let mut memory = vec![u32::MAX; words(shape)];
        build(&image, &mut memory).unwrap();
        let found = bytes(&memory);
        prop_assert_eq!(&found[..wanted.len()], &wanted[..]);
        prop_assert!(found[wanted.len()..].iter().all(|byte| *byte == 0), "the rest of the last word");
        // And each level is where it is said to be.
        for level in 0..=shape.root() {
            let (from, part) = (shape.level_offset(level) as usize, shape.level(level));
            let largest = wanted[from..from + part.texels() as usize].iter().max();
            prop_assert_eq!(largest, heights.iter().max());
        }
    }

    #[test]
    fn a_stream_asks_once_and_writes_every_word_once((shape, heights) in map()) {
        let image = Image::new(shape, &heights).unwrap();
        let mut asked = vec![0; heights.len()];
        let mut memory = vec![None; words(shape)];
        let height = |x, y| {
            asked[(y * shape.width() + x) as usize] += 1;
            image.at(x, y)
        };
        stream(shape, height, |offset, block| {
            assert!(offset % 4 == 0 && !block.is_empty());
            for (place, word) in (offset as usize / 4..).zip(block) {
                assert_eq!(memory[place].replace(*word), None, "word {place}");
            }
            Ok::<_, Infallible>(())
        })
        .unwrap();
        prop_assert!(asked.iter().all(|times| *times == 1));
        let mut wanted = vec![0; words(shape)];
        build(&image, &mut wanted).unwrap();
        prop_assert_eq!(memory.into_iter().map(Option::unwrap).collect::<Vec<_>>(), wanted);
    }

    #[test]
    fn places_and_texels_are_each_other_s_inverse(w in 0u32..=12, h in 0u32..=12, x: u32, y: u32, any: u32) {
        let shape = Shape::new(w, h).unwrap();
        let (inside_x, inside_y) = (x % shape.width(), y % shape.height());
        prop_assert_eq!(shape.morton(x, y), place(shape, inside_x, inside_y));
        prop_assert_eq!(shape.texel(shape.morton(x, y)), (inside_x, inside_y));
        let (x, y) = shape.texel(any);
        prop_assert_eq!(shape.morton(x, y), any % shape.texels());
        // The texel above is at the place above.
        if w > 0 && h > 0 {
            prop_assert_eq!(shape.level(1).morton(x / 2, y / 2), shape.morton(x, y) / 4);
        }
    }

    #[test]
    fn a_texture_keeps_its_texels(w in 0u32..=5, h in 0u32..=5, seed: u32) {
        let shape = Shape::new(w, h).unwrap();
        let texels: Vec<u32> = (0..shape.texels()).map(|texel| texel.wrapping_mul(seed | 1)).collect();
        let mut memory = vec![0; texels.len()];
        reorder(&Image::new(shape, &texels).unwrap(), &mut memory).unwrap();
        for y in 0..shape.height() {
            for x in 0..shape.width() {
                let row_major = (y * shape.width() + x) as usize;
                prop_assert_eq!(memory[place(shape, x, y) as usize], texels[row_major]);
            }
        }
    }

    #[test]
    fn normals_survive_a_byte_a_component(x in -1f32..=1.0, y in -1f32..=1.0, z in -1f32..=1.0) {
        let back = components(normal([x, y, z]));
        for (before, after) in [x, y, z].into_iter().zip(back) {
            prop_assert!((before - after).abs() <= 0.5001 / 127.0);
        }
        prop_assert_eq!(normal(back), normal([x, y, z]));
    }

    #[test]
    fn normals_of_heights_are_those_of_double_precision(
        heights in prop::collection::vec(any::<u8>(), 128), x in 0u32..16, y in 0u32..8, scale in 0.001f32..1.0,
    ) {
        let image = Image::new(Shape::new(4, 3).unwrap(), &heights).unwrap();
        let height = |x: u32, y: u32| f64::from(heights[(y % 8 * 16 + x % 16) as usize]) / 255.0 * f64::from(scale);
        // Texels are a 16th and an 8th of a texture unit apart.
        let slope_u = (height(x + 1, y) - height(x + 15, y)) * 16.0 / 2.0;
        let slope_v = (height(x, y + 1) - height(x, y + 7)) * 8.0 / 2.0;
        let length = (slope_u * slope_u + slope_v * slope_v + 1.0).sqrt();
        let wanted = [-slope_u / length, -slope_v / length, 1.0 / length];
        for (found, wanted) in image.normal_at(x, y, scale).into_iter().zip(wanted) {
            prop_assert!((f64::from(found) - wanted).abs() < 1e-6, "{found} {wanted}");
        }
    }
}

#[test]
fn the_largest_map_has_a_pyramid() {
    let shape = Shape::new(MAX_LOG2, MAX_LOG2).unwrap();
    assert_eq!(shape.pyramid_bytes(), (4u32.pow(13) - 1) / 3);
    let (mut written, mut last) = (0, None);
    // A slope with one peak, near the end.
    let height = |x, y| if (x, y) == (4000, 4095) { 255 } else { (x >> 5) as u8 };
    stream(shape, height, |offset, block| {
        written += block.len();
        last = Some((offset, block[block.len() - 1]));
        Ok::<_, Infallible>(())
    })
    .unwrap();
    assert_eq!(written, words(shape));
    assert_eq!(last, Some((shape.pyramid_bytes() - 1, 255)));
}

#[test]
fn a_sink_that_fails_is_asked_no_more() {
    let mut calls = 0;
    let result = stream(
        Shape::new(6, 6).unwrap(),
        |_, _| 0,
        |_, _| {
            calls += 1;
            if calls == 3 { Err("full") } else { Ok(()) }
        },
    );
    assert_eq!((result, calls), (Err("full"), 3));
}

#[test]
fn slices_of_another_length_are_refused() {
    let shape = Shape::new(2, 1).unwrap();
    assert_eq!(Image::new(shape, &[0u8; 7]), Err(ImageError { wanted: 8 }));
    assert_eq!(Image::new(shape, &[0u8; 9]), Err(ImageError { wanted: 8 }));
    let heights = [0; 8];
    let image = Image::new(shape, &heights).unwrap();
    assert_eq!(build(&image, &mut [0; 2]), Err(ImageError { wanted: 3 }), "8 + 2 + 1 bytes");
    assert_eq!(reorder(&Image::new(shape, &[0; 8]).unwrap(), &mut [0; 9]), Err(ImageError { wanted: 8 }));
    assert_eq!(
        (Shape::new(13, 0), Shape::new(0, 13), Shape::of(0, 4), Shape::of(4, 12)),
        (None, None, None, None)
    );
}

#[test]
fn texels_have_their_bytes() {
    assert_eq!(colour([1, 2, 3]), 0x0001_0203);
    assert_eq!(channels(0xFF01_0203), [1, 2, 3]);
    assert_eq!(normal([0.0, 0.0, 1.0]), 0x00FF_8080);
    assert_eq!(normal([-1.0, 1.0, 0.0]), 0x0080_FF01);
    assert_eq!(normal([-2.0, f32::INFINITY, f32::NAN]), 0x0080_FF01);
    assert_eq!(components(0x0080_FF01), [-1.0, 1.0, 0.0]);
}

#[test]
fn a_flat_map_looks_up_and_wraps() {
    let flat = [7; 16];
    let image = Image::new(Shape::new(2, 2).unwrap(), &flat).unwrap();
    assert_eq!(image.normal_at(0, 3, 0.2), [0.0, 0.0, 1.0]);
    // A texel beyond the edge is the one at the other side.
    let mut ridge = [0; 16];
    ridge[3] = 255;
    let image = Image::new(Shape::new(2, 2).unwrap(), &ridge).unwrap();
    assert!(image.normal_at(0, 0, 0.2)[0] > 0.0, "the ridge is to the left");
    assert!(image.normal_at(2, 0, 0.2)[0] < 0.0, "the ridge is to the right");
    // A map of one texel has itself for a neighbour.
    assert_eq!(Image::new(Shape::new(0, 0).unwrap(), &[9]).unwrap().normal_at(0, 0, 1.0), [0.0, 0.0, 1.0]);
}

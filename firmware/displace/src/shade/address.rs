//! Texture and normal address calculation (§4.1); in: a hit, out: its texture coordinate and two texels' places in their maps;
//! cost: [`ADDRESS`](crate::operators::ADDRESS).
//!
//! The leaf texel is the traversal's integer, and the truth; the coordinate is only as good as the number format. So the
//! coordinate is clamped to the texel (P15), its edges included, as a hit on a wall is on one. And a texel of another map is found
//! by integers: in a map as fine as the heights or coarser it is the leaf texel or the one that holds it, in a finer one the
//! texel under the coordinate, kept inside the leaf texel. More than 2^24 texels of such a map away from the origin it is a corner
//! of the leaf texel: no number of the formats tells them apart much further out.

use lucerna_softfloat::Format;

use crate::pyramid::Shape;

/// Where a ray hit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Hit<F> {
    /// Texture coordinate at the top plane.
    pub entry: [F; 2],
    /// What `t = 1` adds to it.
    pub direction: [F; 2],
    /// Ray parameter of the hit.
    pub t: F,
    /// Leaf texel, not wrapped.
    pub texel: [i32; 2],
}

/// What is to be read for it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Addresses<F> {
    /// Texture coordinate of the hit.
    pub position: [F; 2],
    /// Number of the texture's word.
    pub texture: u32,
    /// Number of the normal map's word.
    pub normal: u32,
}

/// Both addresses of a hit on a map of `heights`.
#[inline]
pub fn addresses<F: Format>(hit: &Hit<F>, heights: Shape, texture: Shape, normals: Shape) -> Addresses<F> {
    let position = position(hit, heights);
    let word = |map: Shape| place(position, hit.texel, heights, map);
    let place = word(texture);
    Addresses { position, texture: place, normal: if normals == texture { place } else { word(normals) } }
}

/// `P + D · t`, clamped to the leaf texel; a NaN becomes its lower edge.
#[inline]
pub fn position<F: Format>(hit: &Hit<F>, heights: Shape) -> [F; 2] {
    let along = F::along(hit.entry, hit.direction, hit.t);
    core::array::from_fn(|axis| {
        let at = along[axis];
        let [low, high] =
            [0, 1].map(|edge| F::from_scaled(hit.texel[axis].saturating_add(edge), heights.log2()[axis]));
        if !low.le(at) {
            low
        } else if at.le(high) {
            at
        } else {
            high
        }
    })
}

/// The place of a map's texel under a position in the leaf texel.
#[inline]
pub fn place<F: Format>(position: [F; 2], texel: [i32; 2], heights: Shape, map: Shape) -> u32 {
    if map == heights {
        return map.morton(texel[0] as u32, texel[1] as u32);
    }
    let [x, y] = core::array::from_fn(|axis| {
        let (leaf, log2) = (heights.log2()[axis], map.log2()[axis]);
        if log2 <= leaf {
            return texel[axis] >> (leaf - log2);
        }
        let finer = log2 - leaf;
        let index = position[axis].floor_scaled(log2);
        // Of a leaf texel far out upper bits are lost here, which the wrap does not look at.
        let first = texel[axis].wrapping_shl(finer);
        match (index >> finer).cmp(&texel[axis]) {
            core::cmp::Ordering::Less => first,
            core::cmp::Ordering::Equal => index,
            core::cmp::Ordering::Greater => first | ((1 << finer) - 1),
        }
    });
    map.morton(x as u32, y as u32)
}

#[cfg(test)]
mod tests {
    use super::{Hit, addresses, place, position};
    use crate::pyramid::{MAX_LOG2, Shape};
    use lucerna_softfloat::{F24, F32, Format};
    use proptest::prelude::*;

    const HEIGHTS: Shape = Shape::new(8, 8);

    fn hit<F: Format>(entry: [f32; 2], direction: [f32; 2], t: f32, texel: [i32; 2]) -> Hit<F> {
        Hit { entry: entry.map(F::from_f32), direction: direction.map(F::from_f32), t: F::from_f32(t), texel }
    }

    fn by_hand<F: Format>() {
        // 0.5 + 0.25 * 0.25 = 0.5625 = 144 / 256; -0.25 - 0.5 * 0.25 = -0.375 = -96 / 256.
        let inside = hit::<F>([0.5, -0.25], [0.25, -0.5], 0.25, [144, -96]);
        let got = addresses(&inside, HEIGHTS, HEIGHTS, Shape::new(10, 2));
        assert_eq!(got.position.map(F::to_f32), [0.5625, -0.375]);
        assert_eq!(got.texture, HEIGHTS.morton(144, 160));
        assert_eq!(got.normal, Shape::new(10, 2).morton(576, 2));
        // The same ray in texels beside: the coordinate is put on the nearest edge.
        let beside = Hit { texel: [145, -98], ..inside };
        let got = addresses(&beside, HEIGHTS, HEIGHTS, Shape::new(10, 10));
        assert_eq!(got.position.map(F::to_f32), [145.0 / 256.0, -97.0 / 256.0]);
        assert_eq!(got.texture, HEIGHTS.morton(145, 158));
        assert_eq!(got.normal, Shape::new(10, 10).morton(580, (-97i32 * 4 - 1) as u32));
    }

    #[test]
    fn values_worked_by_hand() {
        by_hand::<F32>();
        by_hand::<F24>();
    }

    #[test]
    fn nonsense_has_an_address() {
        for t in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let got = position(&hit::<F24>([0.5, 0.5], [1.0, -1.0], t, [7, 7]), HEIGHTS);
            for at in got.map(F24::to_f32) {
                assert!((7.0 / 256.0..=8.0 / 256.0).contains(&at), "{t}: {at}");
            }
        }
        let far = hit::<F32>([0.5, 0.5], [1.0, 1.0], 0.5, [i32::MAX, i32::MIN]);
        let got = addresses(&far, Shape::new(0, 0), Shape::new(12, 12), Shape::new(0, 12));
        assert!(got.texture < 1 << 24 && got.normal < 1 << 12);
    }

    fn shape() -> impl Strategy<Value = Shape> {
        (0..=MAX_LOG2, 0..=MAX_LOG2).prop_map(|(w, h)| Shape::new(w, h))
    }

    /// Undoes the Morton order by looking at each bit of the place.
    fn texel_of(shape: Shape, place: u32) -> [u32; 2] {
        let [w, h] = shape.log2();
        let (mut xy, mut used) = ([0, 0], [0, 0]);
        let mut axis = if w == 0 { 1 } else { 0 };
        for bit in 0..w + h {
            xy[axis] |= (place >> bit & 1) << used[axis];
            used[axis] += 1;
            let other = 1 - axis;
            if used[other] < [w, h][other] {
                axis = other;
            }
        }
        xy
    }

    proptest! {
        #[test]
        fn texels_are_those_that_hold_the_leaf_or_lie_in_it(
            heights in shape(),
            map in shape(),
            // Within ±2^24 texels of the finest map.
            texel in prop::array::uniform2(-4000i32..4000),
            offset in prop::array::uniform2(-0.5f32..1.5),
        ) {
            let at: [F32; 2] = core::array::from_fn(|axis| {
                F32::from_f32((texel[axis] as f32 + offset[axis]) / (1u32 << heights.log2()[axis]) as f32)
            });
            let straight = Hit { entry: at, direction: [F32::ZERO; 2], t: F32::ZERO, texel };
            let clamped = position(&straight, heights);
            let found = texel_of(map, place(clamped, texel, heights, map));
            for axis in 0..2 {
                let (leaf, log2) = (heights.log2()[axis], map.log2()[axis]);
                let edge = |texel: i32| f64::from(texel) / f64::from(1u32 << leaf);
                let held = f64::from(clamped[axis].to_f32());
                prop_assert!((edge(texel[axis])..=edge(texel[axis] + 1)).contains(&held));
                // In units of the finer of the two maps, wrapped by the map's size.
                let expected = if log2 <= leaf {
                    texel[axis].div_euclid(1 << (leaf - log2))
                } else {
                    let first = texel[axis] * (1 << (log2 - leaf));
                    ((held * f64::from(1u32 << log2)).floor() as i32).min(first + (1 << (log2 - leaf)) - 1)
                };
                prop_assert_eq!(found[axis], expected.rem_euclid(1 << log2) as u32, "axis {}", axis);
            }
        }

        /// A map of the height map's size is read at the leaf texel itself, whatever the coordinate.
        #[test]
        fn a_map_of_the_same_size_is_read_at_the_leaf(
            heights in shape(),
            texel in prop::array::uniform2(any::<i32>()),
            bits in prop::array::uniform5(any::<u32>()),
        ) {
            let [u, v, x, y, t] = bits.map(F24::from_bits);
            let got = addresses(&Hit { entry: [u, v], direction: [x, y], t, texel }, heights, heights, heights);
            let leaf = heights.morton(texel[0] as u32, texel[1] as u32);
            prop_assert_eq!((got.texture, got.normal), (leaf, leaf));
        }
    }
}

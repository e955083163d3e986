//! The PREU datapath (PREE Figs. 6 and 7); in: a hit point, a photon or a pixel, out: what is written back; cost: 10 stages
//! for an update, 12 for an evaluation, one operation a cycle each.
//!
//! Arithmetic is computed at issue, in the order drawn (D13, D14), and carried down the pipeline; [`components`] holds which
//! Table I component works in which stage, and proves the two depths.

pub mod components;

use lucerna_softfloat::Format;

use crate::record::{Accumulated, Photon, Surface};

/// The operands that no record holds: registers and hard-wired numbers.
#[derive(Clone, Copy, Debug)]
pub struct Constants<F> {
    /// α, how much of a new photon is kept (eq. 1).
    pub alpha: F,
    /// 1/π, rounded to the format.
    pub inverse_pi: F,
    /// The least cosine between the two normals of an accepted photon, 1e-3 (D8).
    pub grazing: F,
}

impl<F: Format> Constants<F> {
    /// The hard-wired numbers beside `alpha`.
    pub fn new(alpha: F) -> Self {
        Self { alpha, inverse_pi: F::from_f32(core::f32::consts::FRAC_1_PI), grazing: F::from_f32(1e-3) }
    }
}

/// 1/π, rounded to the format.
pub fn inverse_pi<F: Format>() -> F {
    F::from_f32(core::f32::consts::FRAC_1_PI)
}

/// Block 1 of Fig. 6 and its comparator: eq. (6), D² <= R².
#[inline]
pub fn within<F: Format>(hit: &[F; 3], radius2: F, photon: &[F; 3]) -> bool {
    let dx = hit[0].sub(photon[0]).square();
    let dy = hit[1].sub(photon[1]).square();
    let dz = hit[2].sub(photon[2]).square();
    dx.add(dy).add(dz).le(radius2)
}

/// The optional normal test (D8): the photon arrived on the side the hit point faces.
#[inline]
pub fn faces<F: Format>(hit: &[F; 3], photon: &[F; 3], grazing: F) -> bool {
    let [x, y, z] = core::array::from_fn(|axis| hit[axis].mul(photon[axis]));
    grazing.lt(x.add(y).add(z))
}

/// Blocks 2 and 3 of Fig. 6: eqs. (7) and (8) with M = 1, N accumulated as N + α (D14).
#[inline]
pub fn refine<F: Format>(
    before: &Accumulated<F>,
    colour: &[F; 3],
    flux: &[F; 3],
    constants: &Constants<F>,
) -> Accumulated<F> {
    let count = before.count.add(constants.alpha);
    let correction = count.div(before.count.add(F::ONE));
    let refined = |channel: usize| {
        let arriving = colour[channel].mul(flux[channel]).mul(constants.inverse_pi);
        before.flux[channel].add(arriving).mul(correction)
    };
    Accumulated { flux: [refined(0), refined(1), refined(2)], radius2: before.radius2.mul(correction), count }
}

/// One whole hit-point update operation; `None` when the photon does not count for this hit point.
#[inline]
pub fn update<F: Format>(
    surface: &Surface<F>,
    before: &Accumulated<F>,
    photon: &Photon<F>,
    constants: &Constants<F>,
    normal_test: bool,
) -> Option<Accumulated<F>> {
    let counts = within(&surface.position, before.radius2, &photon.position)
        && (!normal_test || faces(&surface.normal, &photon.normal, constants.grazing));
    counts.then(|| refine(before, &surface.colour, &photon.flux, constants))
}

/// One radiance evaluation (Fig. 7, eq. 9): the pixel with this hit point's radiance added, in the order of D13.
#[inline]
pub fn evaluate<F: Format>(pixel: &[F; 3], hit: &Accumulated<F>, emitted: F, inverse_pi: F) -> [F; 3] {
    let area = F::ONE.div(hit.radius2.mul(emitted));
    core::array::from_fn(|channel| pixel[channel].add(hit.flux[channel].mul(inverse_pi).mul(area)))
}

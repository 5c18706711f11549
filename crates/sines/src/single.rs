//! Constants of the computation in f32.
//!
//! The parts of π/2: 17 bits, 18 bits and the rest to 2⁻⁶³. The polynomials are
//! minimax (Remez) on |r| ≤ 0.78545, rounded coefficient by coefficient with
//! the others fitted again: relative error of the sine below 2⁻²⁷·⁹, of the
//! cosine, absolute, below 2⁻³³·¹ (`tests.rs`).

use crate::angle::Angle;
use crate::number::{Number, Products};

/// (r − sin r)/r³ over r², from the lowest power.
pub(crate) const SINE: [f32; 3] = [0.16666655, -0.008332189, 0.00019518287];

/// (cos r − 1 + r²/2)/r⁴ over r², from the lowest power.
pub(crate) const COSINE: [f32; 3] = [0.041666646, -0.0013887301, 2.443067e-5];

#[inline(always)]
fn polynomial<P: Products<f32>, V: Number<f32>>(c: [f32; 3], z: V) -> V {
    let high = P::plus(P::of(z, z.all(c[2])), z.all(c[1]));
    P::plus(P::of(high, z), z.all(c[0]))
}

impl Angle for f32 {
    const SIGN: usize = 31;
    const LARGEST: f32 = crate::LARGEST_F32;
    const INVERSE: f32 = core::f32::consts::FRAC_2_PI;
    const SHIFT: f32 = 12582912.0;
    const QUARTER: [f32; 3] = [1.5707855, 1.0804331e-05, 2.563344e-12];
    const HALF: f32 = 0.5;
    const ONE: f32 = 1.0;

    #[inline(always)]
    fn polynomials<P: Products<f32>, V: Number<f32>>(z: V, _: V) -> (V, V) {
        (polynomial::<P, V>(SINE, z), polynomial::<P, V>(COSINE, z))
    }

    fn library(self) -> (f32, f32) {
        libm::sincosf(self)
    }
}

//! Constants of the computation in f64.
//!
//! The parts of π/2: 40 bits, 38 bits and the rest to 2⁻¹³⁵. The polynomials
//! are minimax (Remez) on |r| ≤ 0.7854, rounded coefficient by coefficient
//! with the others fitted again: relative error of the sine below 2⁻⁵⁷·⁸⁸, of
//! the cosine, absolute, below 2⁻⁶⁴·¹⁸ (`tests.rs`).

use crate::angle::Angle;
use crate::number::{Number, Products};

/// (r − sin r)/r³ over r², from the lowest power.
pub(crate) const SINE: [f64; 6] = [
    0.1666666666666663,
    -0.00833333333332184,
    0.0001984126982935851,
    -2.755731353849849e-6,
    2.5050734385279406e-8,
    -1.5895432974606856e-10,
];

/// (cos r − 1 + r²/2)/r⁴ over r², from the lowest power.
pub(crate) const COSINE: [f64; 6] = [
    0.0416666666666666,
    -0.0013888888888874474,
    2.4801587289671513e-5,
    -2.755731440101526e-7,
    2.0875729278007775e-9,
    -1.1359934021914191e-11,
];

/// Returns the polynomial of degree 5, in halves: shorter than one product after the other.
#[inline(always)]
fn polynomial<P: Products<f64>, V: Number<f64>>(c: [f64; 6], z: V, w: V) -> V {
    let low = P::plus(P::of(z, z.all(c[1])), z.all(c[0]));
    let middle = P::plus(P::of(z, z.all(c[3])), z.all(c[2]));
    let high = P::plus(P::of(z, z.all(c[5])), z.all(c[4]));
    P::added(low, P::of(w, P::added(middle, P::of(w, high))))
}

impl Angle for f64 {
    const SIGN: usize = 63;
    const LARGEST: f64 = crate::LARGEST;
    const INVERSE: f64 = core::f64::consts::FRAC_2_PI;
    const SHIFT: f64 = 6755399441055744.0;
    const QUARTER: [f64; 3] = [
        1.5707963267941523,
        7.443547480480255e-13,
        6.36831716351095e-25,
    ];
    const HALF: f64 = 0.5;
    const ONE: f64 = 1.0;

    #[inline(always)]
    fn polynomials<P: Products<f64>, V: Number<f64>>(z: V, w: V) -> (V, V) {
        (
            polynomial::<P, V>(SINE, z, w),
            polynomial::<P, V>(COSINE, z, w),
        )
    }

    fn library(self) -> (f64, f64) {
        libm::sincos(self)
    }
}

//! Constants of the computation.
//!
//! The parts of π/2: 40 bits, 38 bits and the rest to 2⁻¹³⁵, in f32 17 bits, 18 bits and the
//! rest to 2⁻⁶³. The polynomials are minimax (Remez) on |r| ≤ 0.7854, in f32 0.78545, rounded
//! coefficient by coefficient with the others fitted again: relative error of the sine below
//! 2⁻⁵⁷·⁸⁸ (2⁻²⁷·⁹), of the cosine, absolute, below 2⁻⁶⁴·¹⁸ (2⁻³³·¹) (`tests.rs`).

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
        let sine = polynomial::<P, V>(SINE, z, w);
        (sine, polynomial::<P, V>(COSINE, z, w))
    }

    fn library(self) -> (f64, f64) {
        libm::sincos(self)
    }
}

/// [`SINE`] in f32.
pub(crate) const SINE_F32: [f32; 3] = [0.16666655, -0.008332189, 0.00019518287];

/// [`COSINE`] in f32.
pub(crate) const COSINE_F32: [f32; 3] = [0.041666646, -0.0013887301, 2.443067e-5];

#[inline(always)]
fn polynomial_f32<P: Products<f32>, V: Number<f32>>(c: [f32; 3], z: V) -> V {
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
        let sine = polynomial_f32::<P, V>(SINE_F32, z);
        (sine, polynomial_f32::<P, V>(COSINE_F32, z))
    }

    fn library(self) -> (f32, f32) {
        libm::sincosf(self)
    }
}

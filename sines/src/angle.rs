//! The computation, one text for both scalars.

use core::ops::{Add, Mul, Sub};

use crate::lanes::{LANES, Lanes, Number};

/// A float that angles are in.
pub trait Angle:
    Number<Self> + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// Up to here, in magnitude, the polynomials are for.
    const LARGEST: Self;
    /// 2/π
    const INVERSE: Self;
    /// 1.5·2^(p−1): next to it the floats are the integers.
    const SHIFT: Self;
    /// π/2 in three parts; a count of quarter turns times one of the first two
    /// is exact.
    const QUARTER: [Self; 3];
    /// 1/2
    const HALF: Self;
    /// 1
    const ONE: Self;

    /// (r − sin r)/r³ and (cos r − 1 + r²/2)/r⁴ of z = r² and w = z².
    fn polynomials<V: Number<Self>>(z: V, w: V) -> (V, V);

    /// Sine and cosine of the angle from those of what is left of it. The last
    /// two bits of the shifted count say by how many quarter turns: an odd one
    /// exchanges them, the second bit is the sine's sign, and that of the
    /// count plus one the cosine's.
    fn turned(shifted: Self, sin: Self, cos: Self) -> (Self, Self);

    /// Whether the polynomials are for this angle; they are not for NaN.
    fn is_usual(self) -> bool;

    /// What is right for every angle.
    fn library(self) -> (Self, Self);
}

/// The shifted count of quarter turns of an angle, and sine and cosine of what
/// is left of it. The documentation of the crate says why every line is as exact
/// as is needed.
#[inline(always)]
pub fn rest<T: Angle, V: Number<T>>(x: V) -> (V, V, V) {
    let shifted = x * T::INVERSE + T::SHIFT;
    let k = shifted - T::SHIFT;
    let [much, little, least] = T::QUARTER;
    let rest = x - k * much;
    let second = k * little;
    let r = rest - second;
    // What r lacks, with the other sign: subtracted below, so that the sine of
    // -0 is -0.
    let lacks = k * least - ((rest - r) - second);

    let z = r * r;
    let w = z * z;
    let (sine, cosine) = T::polynomials(z, w);
    let half = z * T::HALF;
    let one = V::all(T::ONE);
    let top = one - half;
    let sin = r - (lacks * top + (r * z) * sine);
    let cos = top + (((one - top) - half) + (w * cosine + r * lacks));
    (shifted, sin, cos)
}

/// Sines and cosines of as many angles as there are lanes, and whether the
/// polynomials were for all of them.
#[inline(always)]
fn lanes<T: Angle>(angles: [T; LANES]) -> ([T; LANES], [T; LANES], bool) {
    let (shifted, sin, cos) = rest(Lanes(angles));
    let (mut sines, mut cosines) = ([T::default(); LANES], [T::default(); LANES]);
    let mut usual = true;
    let mut lane = 0;
    while lane < LANES {
        (sines[lane], cosines[lane]) = T::turned(shifted.0[lane], sin.0[lane], cos.0[lane]);
        usual &= angles[lane].is_usual();
        lane += 1;
    }
    (sines, cosines, usual)
}

/// Sines and cosines of any number of angles.
#[inline(always)]
pub fn all<T: Angle, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
    match cfg!(debug_assertions) {
        true => singly(angles),
        false => together(angles),
    }
}

/// One after the other, to the same bits: where nothing is optimised, lanes
/// would take eight times as long.
pub(crate) fn singly<T: Angle, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
    let (mut sines, mut cosines) = ([T::default(); N], [T::default(); N]);
    for ((angle, sine), cosine) in angles.iter().zip(&mut sines).zip(&mut cosines) {
        let (shifted, sin, cos) = rest::<T, T>(*angle);
        (*sine, *cosine) = match angle.is_usual() {
            true => T::turned(shifted, sin, cos),
            false => angle.library(),
        };
    }
    (sines, cosines)
}

/// As many at a time as there are lanes.
///
/// Loops over indices, not iterators: where a call of one of these is not inlined, as
/// happens without link-time optimisation of a crate's parts, no length is known any
/// more, and the lanes of no angle are computed, too (four angles: 43 ns for 15).
#[inline(always)]
pub(crate) fn together<T: Angle, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
    let (mut sines, mut cosines) = ([T::default(); N], [T::default(); N]);
    let mut usual = true;
    let mut start = 0;
    while start + LANES <= N {
        usual &= from(angles, &mut sines, &mut cosines, start);
        start += LANES;
    }
    if !N.is_multiple_of(LANES) {
        usual &= from(angles, &mut sines, &mut cosines, N - N % LANES);
    }
    if !usual {
        unusual(angles, &mut sines, &mut cosines);
    }
    (sines, cosines)
}

/// As many as there are lanes, or as are left, from one on. The other lanes are zeros,
/// which an optimising compiler leaves out.
#[inline(always)]
fn from<T: Angle, const N: usize>(
    angles: &[T; N],
    sines: &mut [T; N],
    cosines: &mut [T; N],
    start: usize,
) -> bool {
    let mut taken = [T::default(); LANES];
    let mut lane = 0;
    while lane < LANES && start + lane < N {
        taken[lane] = angles[start + lane];
        lane += 1;
    }
    let (sin, cos, usual) = lanes(taken);
    let mut lane = 0;
    while lane < LANES && start + lane < N {
        sines[start + lane] = sin[lane];
        cosines[start + lane] = cos[lane];
        lane += 1;
    }
    usual
}

/// Sines and cosines of any number of angles in every lane of a caller: a loop
/// over scalars, which a compiler makes vectors of as wide as the processor that
/// the caller is compiled for has.
#[inline(always)]
pub fn across<T: Angle, const N: usize, const L: usize>(
    angles: &[[T; L]; N],
) -> ([[T; L]; N], [[T; L]; N]) {
    let (mut sines, mut cosines) = ([[T::default(); L]; N], [[T::default(); L]; N]);
    let mut usual = true;
    let mut angle = 0;
    while angle < N {
        let mut lane = 0;
        while lane < L {
            let x = angles[angle][lane];
            let (shifted, sin, cos) = rest::<T, T>(x);
            (sines[angle][lane], cosines[angle][lane]) = T::turned(shifted, sin, cos);
            usual &= x.is_usual();
            lane += 1;
        }
        angle += 1;
    }
    if !usual {
        for ((angles, sines), cosines) in angles.iter().zip(&mut sines).zip(&mut cosines) {
            unusual(angles, sines, cosines);
        }
    }
    (sines, cosines)
}

/// The angles that the polynomials are not for.
#[cold]
#[inline(never)]
fn unusual<T: Angle>(angles: &[T], sines: &mut [T], cosines: &mut [T]) {
    for ((angle, sin), cos) in angles.iter().zip(sines).zip(cosines) {
        if !angle.is_usual() {
            (*sin, *cos) = angle.library();
        }
    }
}

//! The computation, one text for both scalars.

use core::ops::{Add, Mul, Sub};

use crate::number::{Floats, Number, Pair, Products, Rounded};

/// A float that angles are in.
pub trait Angle:
    Floats<Self> + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// The bit of the sign.
    const SIGN: usize;
    /// Up to here, in magnitude, the polynomials are for.
    const LARGEST: Self;
    /// 2/π
    const INVERSE: Self;
    /// 1.5·2^(p−1): next to it the floats are the integers.
    const SHIFT: Self;
    /// π/2 in three parts; a count of quarter turns times one of the first two is exact.
    const QUARTER: [Self; 3];
    const HALF: Self;
    const ONE: Self;

    /// Returns (r − sin r)/r³ and (cos r − 1 + r²/2)/r⁴ of z = r² and w = z².
    fn polynomials<P: Products<Self>, V: Number<Self>>(z: V, w: V) -> (V, V);

    /// Computes sine and cosine of any angle, by libm.
    fn library(self) -> (Self, Self);
}

/// The shifted count of quarter turns, and sine and cosine of what is left of the angle. The
/// crate's documentation says why every line is exact enough.
#[inline(always)]
pub fn rest<T: Angle, P: Products<T>, V: Number<T>>(x: V) -> (V, V, V) {
    let shifted = P::plus(P::of(x, x.all(T::INVERSE)), x.all(T::SHIFT));
    let k = shifted - x.all(T::SHIFT);
    let [much, little, least] = T::QUARTER;
    let rest = P::taken(x, P::of(k, x.all(much)));
    let second = P::of(k, x.all(little));
    let r = P::taken(rest, second);
    // The part that r lacks, with the other sign: subtracted below, so that the sine of -0 is -0.
    let third = P::of(k, x.all(least));
    let lacks = P::less(third, P::taken(rest - r, second));

    let z = r * r;
    let w = z * z;
    let (sine, cosine) = T::polynomials::<P, V>(z, w);
    let half = P::of(z, x.all(T::HALF));
    let top = P::taken(x.all(T::ONE), half);
    let sin = r - P::added(lacks * top, P::of(r * z, sine));
    let small = P::taken(x.all(T::ONE) - top, half);
    let cos = top + (small + P::plus(P::of(w, cosine), r * lacks));
    (shifted, sin, cos)
}

/// Returns sine and cosine of the angle from those of what is left of it. The last two bits of the
/// shifted count say by how many quarter turns: an odd one exchanges them, the second bit is the
/// sine's sign, and that of the count plus one the cosine's.
#[inline(always)]
pub(crate) fn turned<T: Angle, V: Floats<T>>(shifted: V, sin: V, cos: V) -> (V, V) {
    let one = shifted.power(0);
    let (first, sign) = (shifted.power(T::SIGN - 1), shifted.power(T::SIGN));
    let (count, sin, cos) = (shifted.bits(), sin.bits(), cos.bits());
    // None of the bits for an odd count, all that differ for an even one.
    let kept = (sin ^ cos) & ((count & one) - one);
    let half_turn = V::raised(count);
    let next = half_turn + first;
    (
        V::of_bits(cos ^ kept ^ (half_turn & sign)),
        V::of_bits(sin ^ kept ^ (next & sign)),
    )
}

#[inline(never)]
pub(crate) fn singly<T: Angle, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
    let (mut sines, mut cosines) = ([T::default(); N], [T::default(); N]);
    for ((angle, sine), cosine) in angles.iter().zip(&mut sines).zip(&mut cosines) {
        (*sine, *cosine) = alone::<T, Rounded>(*angle);
    }
    (sines, cosines)
}

/// Computes sine and cosine of any angle, to the bits that it has among others.
#[inline(always)]
pub fn alone<T: Angle, P: Products<T>>(angle: T) -> (T, T) {
    let (shifted, sin, cos) = rest::<T, P, T>(angle);
    match angle.are_within(T::LARGEST) {
        true => turned(shifted, sin, cos),
        false => angle.library(),
    }
}

/// Four angles at a time, the last ones in pairs; true if the polynomials are for all of them.
#[inline(always)]
pub fn together<T, P, V, const N: usize>(angles: &[V; N]) -> ([V; N], [V; N], bool)
where
    T: Angle,
    P: Products<T>,
    V: Floats<T>,
{
    let (mut sines, mut cosines) = (*angles, *angles);
    let mut usual = true;
    let mut at = 0;
    while at < N {
        usual &= angles[at].are_within(T::LARGEST);
        at += 1;
    }
    at = 0;
    while at + 4 <= N {
        let four = [angles[at], angles[at + 1], angles[at + 2], angles[at + 3]];
        let four = Pair(Pair(four[0], four[1]), Pair(four[2], four[3]));
        let (shifted, sin, cos) = rest::<T, P, _>(four);
        (sines[at], cosines[at]) = turned(shifted.0.0, sin.0.0, cos.0.0);
        (sines[at + 1], cosines[at + 1]) = turned(shifted.0.1, sin.0.1, cos.0.1);
        (sines[at + 2], cosines[at + 2]) = turned(shifted.1.0, sin.1.0, cos.1.0);
        (sines[at + 3], cosines[at + 3]) = turned(shifted.1.1, sin.1.1, cos.1.1);
        at += 4;
    }
    while at < N {
        let other = if at + 1 < N { at + 1 } else { at };
        let (shifted, sin, cos) = rest::<T, P, _>(Pair(angles[at], angles[other]));
        (sines[other], cosines[other]) = turned(shifted.1, sin.1, cos.1);
        (sines[at], cosines[at]) = turned(shifted.0, sin.0, cos.0);
        at += 2;
    }
    (sines, cosines, usual)
}

#[cold]
#[inline(never)]
pub fn unusual<T: Angle>(angles: &[T], sines: &mut [T], cosines: &mut [T]) {
    for ((angle, sin), cos) in angles.iter().zip(sines).zip(cosines) {
        if !angle.are_within(T::LARGEST) {
            (*sin, *cos) = angle.library();
        }
    }
}

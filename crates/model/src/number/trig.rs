//! π, and sine and cosine of exact angles, to any number of bits, in integers.
//!
//! Fixed point: a number x is ⌊x·2^w⌋ to a few units, without libm the same on every machine.

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::{Angle, Rational};

const KEPT: usize = 512;

/// ⌊π·2^512⌋, the least significant words first.
const PI: [u32; 17] = [
    0xb5470917, 0x3f84d5b5, 0xc97c50dd, 0xc0ac29b7, 0x34e90c6c, 0xbe5466cf, 0x38d01377, 0x452821e6,
    0xec4e6c89, 0x082efa98, 0x299f31d0, 0xa4093822, 0x03707344, 0x13198a2e, 0x85a308d3, 0x243f6a88,
    0x00000003,
];

/// Series of some hundred bits are asked for thousands of times, so as many are kept.
pub(super) fn pi(w: usize) -> BigInt {
    match KEPT.checked_sub(w) {
        Some(more) => BigInt::from_slice(Sign::Plus, &PI) >> more,
        None => machin(w),
    }
}

/// Computes π by Machin's formula: π = 16 atan(1/5) − 4 atan(1/239).
fn machin(w: usize) -> BigInt {
    let guard = 32;
    let one = BigInt::one() << (w + guard);
    let atan_inverse = |n: u32| {
        let square = BigInt::from(n) * n;
        let mut power = &one / n;
        let mut sum = power.clone();
        let mut k = 1u32;
        while !power.is_zero() {
            power = -(power / &square);
            k += 2;
            sum += &power / k;
        }
        sum
    };
    (atan_inverse(5) * 16 - atan_inverse(239) * 4) >> guard
}

/// The errors of [`sin_cos`] are below 2^(`SLACK` − w).
pub(super) const SLACK: usize = 8;

/// Returns (sin, cos) of an angle as integers scaled by 2^w, within 2^`SLACK` of the true values.
pub(super) fn sin_cos(angle: &Angle, w: usize) -> (BigInt, BigInt) {
    if let Angle::TwiceAtan(tangent) = angle {
        let scaled = |part: Rational| (part.numer() << w).div_floor(part.denom());
        let [sin, cos] = circle(tangent);
        return (scaled(sin), scaled(cos));
    }
    // Bits to spare: for the reduction by π, and for the series' roundings.
    let size = match angle {
        Angle::Radians(value) => value.to_integer().bits() as usize,
        _ => 0,
    };
    let work = w + size + 32;
    let pi = pi(work + size);
    let (turns, rest) = match angle {
        Angle::PiTimes(multiple) => {
            let halves = multiple * Rational::from_integer(2.into());
            let whole = halves.round().to_integer();
            let rest = halves - Rational::from_integer(whole.clone());
            let scaled = (&pi >> size) * rest.numer();
            (whole, scaled.div_floor(&(rest.denom() * 2)))
        }
        Angle::Radians(value) | Angle::TwiceAtan(value) => {
            let scaled = (value.numer() << (work + size)).div_floor(value.denom());
            let quarter: BigInt = &pi >> 1;
            let whole = (&scaled + (&quarter >> 1u32)).div_floor(&quarter);
            let rest: BigInt = scaled - &whole * &quarter;
            (whole, rest >> size)
        }
    };
    let (sin, cos) = series(&rest, work);
    let (sin, cos): (BigInt, BigInt) = (sin >> (work - w), cos >> (work - w));
    match u8::try_from(turns.mod_floor(&4.into())).unwrap_or(0) {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Returns sine and cosine of 2 atan t: (2t, 1 − t²)/(1 + t²).
pub(super) fn circle(tangent: &Rational) -> [Rational; 2] {
    let (square, one) = (tangent * tangent, Rational::one());
    let per = (&one + &square).recip();
    [(tangent + tangent) * &per, (one - square) * per]
}

/// Returns 2 atan t as an integer scaled by 2^w, within a few units.
pub(super) fn twice_atan(tangent: &Rational, w: usize) -> BigInt {
    const HALVINGS: u32 = 4;
    let work = w + 32;
    let is_steep = tangent.abs() > Rational::one();
    let flat = match is_steep {
        true => tangent.recip(),
        false => tangent.clone(),
    };
    let one = BigInt::one() << work;
    let mut x = (flat.numer() << work).div_floor(flat.denom());
    for _ in 0..HALVINGS {
        // tan(φ/2) = tan φ / (1 + √(1 + tan² φ))
        let root = (&one * &one + &x * &x).sqrt();
        x = (&x << work).div_floor(&(&one + root));
    }
    let square: BigInt = (&x * &x) >> work;
    let (mut power, mut sum, mut k) = (x, BigInt::zero(), 1u32);
    // Truncates towards zero, so that the loop ends for negative x too.
    while !power.is_zero() {
        let term = &power / k;
        sum += if k % 4 == 1 { term } else { -term };
        power = -(-(&power * &square) / &one);
        k += 2;
    }
    let twice: BigInt = sum << (HALVINGS + 1);
    let angle = match is_steep {
        true if tangent.is_negative() => -pi(work) - twice,
        true => pi(work) - twice,
        false => twice,
    };
    angle >> (work - w)
}

fn series(x: &BigInt, w: usize) -> (BigInt, BigInt) {
    let mut term = BigInt::one() << w;
    let (mut sin, mut cos) = (BigInt::zero(), term.clone());
    let mut n = 0u32;
    while !term.is_zero() {
        n += 1;
        term = (&term * x) >> w;
        // Truncates towards zero, so that the loop ends for negative x too.
        term /= n;
        match n % 4 {
            1 => sin += &term,
            2 => cos -= &term,
            3 => sin -= &term,
            _ => cos += &term,
        }
    }
    (sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_of_pi_is_what_the_series_gives() {
        for w in [1, 240, KEPT - 1, KEPT, KEPT + 1, 1000] {
            let (kept, series) = (pi(w), machin(w + 64) >> 64u32);
            assert_eq!(kept, series, "{w}");
        }
    }
}

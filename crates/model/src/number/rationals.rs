//! Sums, products, order and doubles of rationals. The numbers of a robot file have a few digits, and
//! most that come of them are as small: then words do what big integers would. Those of odd angles
//! grow to thousands of bits; there the common divisors are what takes the time.

use core::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Zero;

use super::Rational;
use super::divisor::greatest_common_divisor;

pub(super) fn product(a: &Rational, b: &Rational) -> Rational {
    let (Some((p, q)), Some((r, s))) = (words(a), words(b)) else {
        return long_product(a, b);
    };
    if p == 0 || r == 0 {
        return Rational::zero();
    }
    // Common factors go first, so that the product is in lowest terms. Each factor is below 2⁶³.
    let (first, second) = (common(p, s), common(r, q));
    let [numerator, denominator] = [(p / first) * (r / second), (q / second) * (s / first)];
    Rational::new_raw(numerator.into(), denominator.into())
}

pub(super) fn sum(a: &Rational, b: &Rational) -> Rational {
    let (Some((p, q)), Some((r, s))) = (words(a), words(b)) else {
        return long_sum(a, b);
    };
    // Two products below 2¹²⁶ each.
    let (numerator, denominator) = match q == s {
        true => (p + r, q),
        false => (p * s + r * q, q * s),
    };
    let common = common(numerator, denominator);
    Rational::new_raw((numerator / common).into(), (denominator / common).into())
}

pub(super) fn compare(a: &Rational, b: &Rational) -> Ordering {
    match (words(a), words(b)) {
        // Denominators are above zero.
        (Some((p, q)), Some((r, s))) => (p * s).cmp(&(r * q)),
        _ if a.denom() == b.denom() => a.numer().cmp(b.numer()),
        _ => (a.numer() * b.denom()).cmp(&(b.numer() * a.denom())),
    }
}

pub(super) fn nearest_double(a: &Rational) -> Option<f64> {
    const EXACT: i128 = 1 << f64::MANTISSA_DIGITS;
    let (p, q) = words(a)?;
    (p.abs() <= EXACT && q <= EXACT).then(|| p as f64 / q as f64)
}

fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    greatest_common_divisor(a.magnitude(), b.magnitude()).into()
}

/// Common divisors of numerators and denominators go first, as with words.
fn long_product(a: &Rational, b: &Rational) -> Rational {
    let [first, second] = [(a, b), (b, a)].map(|(x, y)| common_divisor(x.numer(), y.denom()));
    let numerator = (a.numer() / &first) * (b.numer() / &second);
    let denominator = (a.denom() / &second) * (b.denom() / &first);
    if numerator.is_zero() {
        return Rational::zero();
    }
    Rational::new_raw(numerator, denominator)
}

/// Only factors that both denominators share can leave the sum (Knuth, section 4.5.1).
fn long_sum(a: &Rational, b: &Rational) -> Rational {
    let shared = common_divisor(a.denom(), b.denom());
    let [of_a, of_b] = [a, b].map(|x| x.denom() / &shared);
    let numerator = a.numer() * &of_b + b.numer() * &of_a;
    let common = common_divisor(&numerator, &shared);
    if numerator.is_zero() {
        return Rational::zero();
    }
    Rational::new_raw(numerator / &common, of_a * (b.denom() / common))
}

fn words(x: &Rational) -> Option<(i128, i128)> {
    let word = |part: &BigInt| {
        let word = i64::try_from(part).ok()?;
        (word != i64::MIN).then_some(i128::from(word))
    };
    Some((word(x.numer())?, word(x.denom())?))
}

fn common(a: i128, b: i128) -> i128 {
    match (i64::try_from(a), i64::try_from(b)) {
        (Ok(a), Ok(b)) => a.gcd(&b).into(),
        _ => a.gcd(&b),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ratio, round::round_magnitude};
    use super::*;
    use crate::scalar::field::Points;
    use alloc::vec::Vec;

    #[test]
    fn words_and_big_integers_agree() {
        let mut points = Points::new(1);
        let mut draw = |most: u32| {
            let bits = points.bits();
            let shift = 64 - (bits >> 40) as u32 % most - 1;
            ((bits ^ (bits << 23)) as i64) >> shift.min(63)
        };
        let mut rational = |most: u32| {
            let (numerator, denominator) = (draw(most), draw(most));
            let denominator = if denominator == 0 { 1 } else { denominator };
            Rational::new(numerator.into(), denominator.into())
        };
        let edges = [i64::MAX, i64::MIN, i64::MIN + 1, 0, 1, -1].map(|edge| ratio(edge, 1));
        let pair = |k: u32| (rational(1 + k % 63), rational(1 + (k / 7) % 63));
        let mut pairs: Vec<(Rational, Rational)> = (0..20_000).map(pair).collect();
        for a in &edges {
            for b in &edges {
                pairs.push((a.clone(), b.clone()));
                let below = if b.is_zero() { a.clone() } else { b.recip() };
                pairs.push((a.clone(), below));
            }
        }
        for (a, b) in pairs {
            let cubes = (a.pow(3), b.pow(3) * &a);
            for (a, b) in [(&a, &b), (&cubes.0, &cubes.1)] {
                for (found, expected) in [(product(a, b), a * b), (sum(a, b), a + b)] {
                    assert_eq!(found.numer(), expected.numer(), "{a} {b}");
                    assert_eq!(found.denom(), expected.denom(), "{a} {b}");
                }
                assert_eq!(compare(a, b), a.cmp(b), "{a} {b}");
            }
            if let Some(double) = nearest_double(&a) {
                let digits = round_magnitude(&a, 53, -1074, 1024);
                assert_eq!(double.abs().to_bits(), digits.to_bits(), "{a}");
                assert_eq!(double < 0.0, a < Rational::zero());
            }
        }
    }
}

//! Sums, products, order and doubles of rationals. The numbers of a robot file have a few digits, and
//! most that come of them are as small: then words do what big integers would.

use core::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Zero;

use super::Rational;

pub(super) fn product(a: &Rational, b: &Rational) -> Rational {
    let (Some((p, q)), Some((r, s))) = (words(a), words(b)) else {
        return a * b;
    };
    if p == 0 || r == 0 {
        return Rational::zero();
    }
    // What they have in common goes first: p/q and r/s are in lowest terms, so
    // the product is. Each factor is below 2⁶³.
    let (first, second) = (common(p, s), common(r, q));
    let [numerator, denominator] = [(p / first) * (r / second), (q / second) * (s / first)];
    Rational::new_raw(numerator.into(), denominator.into())
}

pub(super) fn sum(a: &Rational, b: &Rational) -> Rational {
    let (Some((p, q)), Some((r, s))) = (words(a), words(b)) else {
        return a + b;
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

/// Returns numerator and denominator, if both are below 2⁶³ in magnitude.
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
    use super::super::round::round_magnitude;
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
        let edges = [i64::MAX, i64::MIN, i64::MIN + 1, 0, 1, -1];
        let edges = edges.map(|x| Rational::from_integer(x.into()));
        let mut pairs: Vec<(Rational, Rational)> = (0..20_000)
            .map(|k| (rational(1 + k % 63), rational(1 + (k / 7) % 63)))
            .collect();
        for a in &edges {
            for b in &edges {
                pairs.push((a.clone(), b.clone()));
                let below = if b.is_zero() { a.clone() } else { b.recip() };
                pairs.push((a.clone(), below));
            }
        }
        for (a, b) in pairs {
            for (found, expected) in [(product(&a, &b), &a * &b), (sum(&a, &b), &a + &b)] {
                assert_eq!(found.numer(), expected.numer(), "{a} {b}");
                assert_eq!(found.denom(), expected.denom(), "{a} {b}");
            }
            assert_eq!(compare(&a, &b), a.cmp(&b), "{a} {b}");
            let [cube, other] = [a.pow(3), b.pow(3)];
            assert_eq!(compare(&cube, &other), cube.cmp(&other), "{a} {b}");
            if let Some(double) = nearest_double(&a) {
                let digits = round_magnitude(&a, 53, -1074, 1024);
                assert_eq!(double.abs().to_bits(), digits.to_bits(), "{a}");
                assert_eq!(double < 0.0, a < Rational::zero());
            }
        }
    }
}

//! The numbers that the proof in the crate's documentation takes, from exact arithmetic: constants,
//! the polynomials' errors, and how near angles come to multiples of π/2.

extern crate std;

use dalembert_model::number::{Angle as Turn, Rational, Rounded};
use dalembert_model::scalar::field::Points;
use std::vec::Vec;

use crate::angle::{Angle, singly};
use crate::constants::{COSINE, COSINE_F32, SINE, SINE_F32};
use crate::vectors;

fn exact(x: f64) -> Rational {
    Rational::from_float(x).unwrap()
}

fn whole(n: u64) -> Rational {
    Rational::from_integer(n.into())
}

fn magnitude(x: Rational) -> Rational {
    if x < whole(0) { -x } else { x }
}

fn bits(x: &Rational) -> f64 {
    f64::nearest_rational(x).log2()
}

fn quarter() -> Rational {
    Turn::right_angles(1).radians()
}

/// Returns an upper bound of |Σ c_k z^k| over 0 ≤ z ≤ top: about the middle of each of many pieces,
/// the sum of the polynomial's coefficients' magnitudes is next to its largest value.
fn largest(coefficients: &[Rational], top: &Rational, pieces: u64) -> Rational {
    let radius = top / whole(2 * pieces);
    let piece = |index: u64| {
        let centre = &radius * whole(2 * index + 1);
        let mut shifted = coefficients.to_vec();
        for from in 0..shifted.len() {
            for k in (from..shifted.len() - 1).rev() {
                shifted[k] = &shifted[k] + &shifted[k + 1] * &centre;
            }
        }
        let terms = shifted.into_iter().rev();
        terms.fold(whole(0), |sum, c| sum * &radius + magnitude(c))
    };
    (0..pieces).map(piece).max().unwrap()
}

/// Returns Taylor's coefficients 1/first!, −1/(first + 2)!, …, and a bound of the rest for r² ≤ 1.
fn taylor(first: u64, terms: u64) -> (Vec<Rational>, Rational) {
    let factorial = |n: u64| (1..=n).fold(whole(1), |product, k| product * whole(k));
    let term = |k: u64| {
        let size = whole(1) / factorial(first + 2 * k);
        if k.is_multiple_of(2) { size } else { -size }
    };
    let rest = whole(1) / factorial(first + 2 * terms);
    ((0..terms).map(term).collect(), rest)
}

/// Returns the error of a polynomial p against (r − sin r)/r³ = 1/3! − r²/5! + … or
/// (cos r − 1 + r²/2)/r⁴ = 1/4! − r²/6! + …, times r^power: a bound in bits.
fn error(polynomial: &[f64], first: u64, power: usize, reach: f64) -> f64 {
    let (mut difference, rest) = taylor(first, 11);
    for (d, c) in difference.iter_mut().zip(polynomial) {
        *d -= exact(*c);
    }
    // Over z = r²: times z^(power/2).
    let zeros = std::vec![whole(0); power / 2];
    let difference: Vec<Rational> = zeros.into_iter().chain(difference).collect();
    let top = exact(reach) * exact(reach);
    bits(&(largest(&difference, &top, 64) + rest))
}

/// The relative error of the sine is r²·Δp over sin r/r ≥ 0.9003, the cosine's absolute one r⁴·Δp.
#[test]
fn polynomials_are_as_near_as_stated() {
    let sine = SINE_F32.map(f64::from);
    let cosine = COSINE_F32.map(f64::from);
    let least = (0.78545f64.sin() / 0.78545).log2();
    for (what, exponent, stated) in [
        ("sine", error(&SINE, 3, 2, 0.78541) - least, -57.6),
        ("cosine", error(&COSINE, 4, 4, 0.78541), -63.9),
        ("sine of f32", error(&sine, 3, 2, 0.78545) - least, -27.6),
        ("cosine of f32", error(&cosine, 4, 4, 0.78545), -32.9),
    ] {
        std::println!("{what}: 2^{exponent:.2}");
        assert!(exponent < stated, "{what}: 2^{exponent}");
        // A bound far below would be one of another polynomial.
        assert!(exponent > stated - 0.5, "{what}: 2^{exponent}");
    }
}

fn counts(largest: f64) -> u64 {
    (largest / core::f64::consts::FRAC_PI_2).round() as u64
}

fn width(x: f64) -> u32 {
    let significand = (x.to_bits() & ((1 << 52) - 1)) | 1 << 52;
    53 - significand.trailing_zeros()
}

/// A count times a part of π/2 is exact in the scalar, and the parts are π/2.
#[test]
fn the_parts_are_of_a_quarter_turn() {
    let singles = f32::QUARTER.map(f64::from);
    let most = [counts(f64::LARGEST), counts(f32::LARGEST.into())];
    assert_eq!(most, [5215, 64]);
    for (parts, digits, most, missing) in [
        (f64::QUARTER, 53, most[0], -134.9),
        (singles, 24, most[1], -63.3),
    ] {
        for part in &parts[..2] {
            // No part is negative: what is left of -0 is -0.
            let widest = (1..=most).map(|k| width(k as f64 * part)).max();
            assert!(*part > 0.0 && widest <= Some(digits), "{part:e}");
            assert!(width(*part) + most.ilog2() <= 53, "{part:e}");
        }
        let sum = parts.iter().fold(whole(0), |sum, part| sum + exact(*part));
        let exponent = bits(&magnitude(quarter() - sum));
        let is_as_stated = exponent < missing && exponent > missing - 0.5;
        assert!(is_as_stated, "2^{exponent}");
    }
}

#[test]
fn no_angle_is_nearer_to_a_quarter_turn_than_stated() {
    let nearest = |most: u64, round: fn(&Rational) -> f64| {
        let distance = |k: u64| {
            let angle = quarter() * whole(k);
            magnitude(exact(round(&angle)) - angle)
        };
        bits(&(1..=most).map(distance).min().unwrap())
    };
    let in_single = |x: &Rational| f32::nearest_rational(x).into();
    let double = nearest(counts(f64::LARGEST) + 1, f64::nearest_rational);
    let single = nearest(counts(f32::LARGEST.into()) + 1, in_single);
    assert!((-60.49..-60.48).contains(&double), "{double}");
    assert!((-26.33..-26.32).contains(&single), "{single}");
}

/// Covers whole vectors, a rest, and unusual angles among others.
#[test]
fn vectors_and_single_angles_have_the_same_bits() {
    let mut points = Points::new(1);
    for round in 0..500 {
        let angles: [f64; 21] = core::array::from_fn(|_| match round % 4 {
            0 => f64::from_bits(points.bits()),
            1 => points.unit() * 2.0 * f64::LARGEST,
            _ => points.unit() * 3.5,
        });
        let singles = angles.map(|x| x as f32);
        let (a, b) = (singly(&angles), vectors::together(&angles));
        assert_eq!(a.0.map(f64::to_bits), b.0.map(f64::to_bits), "{angles:?}");
        assert_eq!(a.1.map(f64::to_bits), b.1.map(f64::to_bits), "{angles:?}");
        let (a, b) = (singly(&singles), vectors::together(&singles));
        assert_eq!(a.0.map(f32::to_bits), b.0.map(f32::to_bits), "{singles:?}");
        assert_eq!(a.1.map(f32::to_bits), b.1.map(f32::to_bits), "{singles:?}");
    }
}

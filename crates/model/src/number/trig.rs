//! Sine and cosine of exact angles to any number of bits, in integers.
//!
//! Fixed point: a number x is ⌊x·2^w⌋ with an error of a few units. No
//! platform libm takes part, so constants are the same on every machine.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::pi::pi;
use super::{Angle, Rational};

/// The errors of [`sin_cos`] are below 2^(`SLACK` − w).
pub(super) const SLACK: usize = 8;

/// Returns (sin, cos) of an angle as integers scaled by 2^w, each within
/// 2^`SLACK` units of the true value.
pub(super) fn sin_cos(angle: &Angle, w: usize) -> (BigInt, BigInt) {
    // Bits to spare: for the reduction by π, and for the series' roundings.
    let size = match angle {
        Angle::PiTimes(_) => 0,
        Angle::Radians(value) => value.to_integer().bits() as usize,
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
        Angle::Radians(value) => {
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

fn series(x: &BigInt, w: usize) -> (BigInt, BigInt) {
    let mut term = BigInt::one() << w;
    let (mut sin, mut cos) = (BigInt::zero(), term.clone());
    let mut n = 0u32;
    while !term.is_zero() {
        n += 1;
        term = (&term * x) >> w;
        // Truncate towards zero, so that the loop ends for negative x too.
        term = if term.is_negative() {
            -((-term) / n)
        } else {
            term / n
        };
        match n % 4 {
            1 => sin += &term,
            2 => cos -= &term,
            3 => sin -= &term,
            _ => cos += &term,
        }
    }
    (sin, cos)
}

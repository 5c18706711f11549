//! Polynomials in sines, cosines, rates and errors, with a bound of what was left out.
//!
//! Every variable is at most one in magnitude over the box: cos φ and sin φ of a joint
//! that turns, where sin² is replaced by 1 − cos²; of a joint that slides, its position
//! as the cosine of an angle that goes round; q̇ and q̈ in units of a power of two; and
//! errors of sines in units of their largest. So a monomial is at most one, and whatever
//! is not written down — what rounding a coefficient costs, terms that all but cancelled,
//! products of two errors — adds its magnitude to `rest`.

use crate::fault::Fault;
use crate::interval::UNIT;
use crate::work::Work;

/// Nanoseconds for a product of two terms.
const PRODUCT: u64 = 20;

/// The exponents of a monomial: `WIDTH` bits a joint.
pub type Key = u128;
/// The most joints that a key has room for.
pub const MAX_JOINTS: usize = 9;
const WIDTH: usize = 13;
/// Where the exponents of a joint start, and how many bits they have, the highest of
/// which must stay zero (but for sin, whose square is replaced).
const FIELDS: [(usize, usize); 6] = [(0, 2), (2, 4), (6, 3), (9, 2), (11, 1), (12, 1)];
const MOST_TERMS: usize = 1 << 18;
/// The factor that summing up `rest` in floating point may cost: far fewer than 2³⁰
/// additions, each rounded by at most one part in 2⁵³.
pub const SLACK: f64 = 1.000_001;
/// The least double, at least what a product is off where it underflows.
const LEAST: f64 = f64::from_bits(1);
const SMALL: f64 = 1e-290;

/// The variables of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// sin φ
    Sin,
    /// cos φ, or the position of a joint that slides.
    Cos,
    /// q̇
    Velocity,
    /// q̈
    Acceleration,
    /// The error of a sine or cosine, even.
    EvenError,
    /// The same, odd.
    OddError,
}

/// Returns the monomial that is a variable of a joint.
pub fn key(variable: Variable, joint: usize) -> Key {
    1 << (joint * WIDTH + FIELDS[variable as usize].0)
}

/// Returns the exponent of a variable of a joint in a monomial.
pub fn exponent(key: Key, variable: Variable, joint: usize) -> u32 {
    let (start, bits) = FIELDS[variable as usize];
    (key >> (joint * WIDTH + start)) as u32 & ((1 << bits) - 1)
}

/// The first bit of every joint: a geometric series.
const EACH: Key = ((1 << (WIDTH * MAX_JOINTS)) - 1) / ((1 << WIDTH) - 1);
/// Bits that are only set by a power that there is no room for.
const GUARD: Key = EACH * (1 << 5 | 1 << 8 | 1 << 10);
const ERRORS: Key = EACH * (3 << 11);
const SINE_SQUARED: Key = EACH * (1 << 1);
/// The exponents that angles have, sin and cos.
pub const ANGLES: Key = EACH * ((1 << 6) - 1);

/// A function of the state: the sum of its terms, and at most `rest` more or less.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial {
    /// In the order of their keys, each key once.
    pub terms: Vec<(Key, f64)>,
    /// The largest magnitude of all that is left out.
    pub rest: f64,
}

impl Polynomial {
    /// Returns a variable times a power of two, or any double.
    pub fn variable(variable: Variable, joint: usize, factor: f64) -> Polynomial {
        Polynomial::term(key(variable, joint), factor, 0.0)
    }

    fn term(key: Key, factor: f64, rest: f64) -> Polynomial {
        let terms = Some((key, factor)).filter(|_| factor != 0.0);
        let terms = terms.into_iter().collect();
        Polynomial { terms, rest }
    }

    fn norm(&self) -> f64 {
        let sum: f64 = self.terms.iter().map(|(_, c)| c.abs()).sum();
        (sum + self.rest) * SLACK
    }

    /// Returns a number that is at most so far from a double.
    pub fn constant(value: f64, radius: f64) -> Polynomial {
        Polynomial::term(0, value, radius)
    }

    /// Returns the opposite.
    #[must_use]
    pub fn negated(&self) -> Polynomial {
        let terms = self.terms.iter().map(|&(key, c)| (key, -c)).collect();
        Polynomial { terms, ..*self }
    }

    /// Returns the sum of two.
    #[must_use]
    pub fn plus(&self, other: &Polynomial) -> Polynomial {
        let terms = [self.terms.as_slice(), &other.terms].concat();
        merged(terms, self.rest + other.rest)
    }

    pub(crate) fn sum(&self, other: &Polynomial, work: &Work) -> Result<Polynomial, Fault> {
        work.spend(self.terms.len() + other.terms.len(), PRODUCT)?;
        self.plus(other).short()
    }

    fn short(self) -> Result<Polynomial, Fault> {
        let is_short = self.terms.len() <= MOST_TERMS;
        is_short.then_some(self).ok_or(Fault::Large)
    }

    /// Returns the product of two.
    ///
    /// # Errors
    /// More than is written out, or more work than is done.
    pub fn times(&self, other: &Polynomial, work: &Work) -> Result<Polynomial, Fault> {
        let zero = Polynomial::default();
        if *self == zero || *other == zero {
            return Ok(zero);
        }
        work.spend(self.terms.len() * other.terms.len(), PRODUCT)?;
        let mut rest = 0.0;
        // So that NaN, of numbers that overflowed, stays in the rest.
        if self.rest + other.rest != 0.0 {
            rest = (self.rest * other.norm() + other.rest * self.norm()) * SLACK + LEAST;
        }
        let mut terms = Vec::new();
        for (left, a) in &self.terms {
            for (right, b) in &other.terms {
                let product = a * b;
                if left & ERRORS != 0 && right & ERRORS != 0 {
                    rest += product.abs() * SLACK + LEAST;
                    continue;
                }
                let exact = a.abs() == 1.0 || b.abs() == 1.0;
                rest += if exact { 0.0 } else { product.abs() * UNIT };
                rest += if product.abs() < SMALL { LEAST } else { 0.0 };
                reduce(left + right, product, &mut terms)?;
            }
            if terms.len() > 8 * MOST_TERMS {
                Polynomial { terms, rest } = merged(terms, rest).short()?;
            }
        }
        merged(terms, rest).short()
    }
}

/// Pushes a term, every sin² in it replaced by 1 − cos².
fn reduce(key: Key, coefficient: f64, terms: &mut Vec<(Key, f64)>) -> Result<(), Fault> {
    if key & GUARD != 0 {
        return Err(Fault::Large);
    }
    let squares = key & SINE_SQUARED;
    let first = squares & squares.wrapping_neg();
    if first == 0 {
        terms.push((key, coefficient));
        return Ok(());
    }
    // The bit of sin² is two below that of cos².
    reduce(key & !first, coefficient, terms)?;
    reduce((key & !first) + (first << 2), -coefficient, terms)
}

/// Sums up terms of the same key; what all but cancelled goes into the rest.
fn merged(mut terms: Vec<(Key, f64)>, mut rest: f64) -> Polynomial {
    // Stable: sums are taken in the order of the products on every machine.
    terms.sort_by_key(|(key, _)| *key);
    let mut sums: Vec<(Key, f64)> = Vec::with_capacity(terms.len());
    let mut largest = 0.0f64;
    for (key, coefficient) in terms {
        match sums.last_mut() {
            Some((last, sum)) if *last == key => {
                let exact = *sum == -coefficient;
                *sum += coefficient;
                rest += if exact { 0.0 } else { sum.abs() * UNIT };
            }
            _ => sums.push((key, coefficient)),
        }
        largest = largest.max(coefficient.abs());
    }
    let least = 4.0 * largest * UNIT;
    sums.retain(|(_, c)| {
        let kept = c.abs() > least;
        rest += if kept { 0.0 } else { c.abs() };
        kept
    });
    let rest = if rest == 0.0 { 0.0 } else { rest * SLACK };
    Polynomial { terms: sums, rest }
}

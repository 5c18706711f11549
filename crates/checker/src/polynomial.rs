//! Polynomials in sines, cosines, rates, loads and errors, with a bound of what was left out.
//!
//! Every variable is at most one in magnitude over the box: cos φ and sin φ of a joint
//! that turns, where sin² is replaced by 1 − cos²; of a joint that slides, its position
//! as the cosine of an angle that goes round; q̇, q̈ and the load in units of a power of
//! two; and errors of sines in units of their largest. So a monomial is at most one, and
//! whatever is not written down — what rounding a coefficient costs, terms that all but
//! cancelled, products of two errors, two loads or two q̈ — adds its magnitude to `rest`.

use crate::fault::Fault;
use crate::interval::UNIT;
use crate::work::Work;

/// Nanoseconds for a product of two terms.
const PRODUCT: u64 = 20;

/// The most joints that a key has room for.
pub const MAX_JOINTS: usize = 22;
/// The most entries of a load that a key has room for.
pub const MAX_LOADS: usize = 31;
const MOST_TERMS: usize = 1 << 18;
/// The factor that summing up `rest` in floating point may cost: far fewer than 2³⁰
/// additions, each rounded by at most one part in 2⁵³.
pub const SLACK: f64 = 1.000_001;
/// The least double, at least what a product is off where it underflows.
const LEAST: f64 = f64::from_bits(1);
const SMALL: f64 = 1e-290;

/// The variables: each but a load's entry is of a joint.
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
    /// The error of an odd one.
    OddError,
    /// An entry of the load.
    Load,
}

/// The exponents of a monomial. Sin, cos and q̇ of a joint have 2, 4 and 3 bits, the highest of which
/// must stay zero (but for sin, whose square is replaced). A monomial has of q̈, of errors and of loads
/// one at most, by its place; the last word has these behind its joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Powers([u64; WORDS]);

const WORDS: usize = 4;
const WIDTH: usize = 9;
/// The joints of a word.
const JOINTS: usize = 7;
/// The first bit of the exponents of sin, cos and q̇, and their largest values.
const FIELDS: [(usize, u64); 3] = [(0, 3), (2, 15), (6, 7)];
/// The first bit of every joint: a geometric series.
const EACH: u64 = ((1 << (WIDTH * JOINTS)) - 1) / ((1 << WIDTH) - 1);
/// Bits that are only set by a power that there is no room for.
const GUARD: [u64; WORDS] = of_joints(1 << 5 | 1 << 8);
const SINE_SQUARED: [u64; WORDS] = of_joints(1 << 1);
const ANGLES: [u64; WORDS] = of_joints((1 << 6) - 1);
/// The bits of the one q̈, of the one error and of the one load.
const ONES: [(usize, u64); 3] = [(32, 31), (37, 63), (43, 31)];
const ODD: u64 = 1 << 5;
/// A bit that no monomial has.
const MARK: u64 = 1 << 63;

const fn of_joints(bits: u64) -> [u64; WORDS] {
    let last = (1 << (WIDTH * (MAX_JOINTS - JOINTS * (WORDS - 1)))) - 1;
    [EACH * bits, EACH * bits, EACH * bits, (EACH * bits) & last]
}

/// Returns the monomial that is a variable of a joint, or of an entry of the load.
pub fn key(variable: Variable, index: usize) -> Powers {
    let mut key = Powers::default();
    let place = index as u64 + 1;
    key.0[WORDS - 1] = match variable {
        Variable::Acceleration => place << ONES[0].0,
        Variable::EvenError => place << ONES[1].0,
        Variable::OddError => (place | ODD) << ONES[1].0,
        Variable::Load => place << ONES[2].0,
        Variable::Sin | Variable::Cos | Variable::Velocity => {
            let bit = index % JOINTS * WIDTH + FIELDS[variable as usize].0;
            key.0[index / JOINTS] = 1 << bit;
            return key;
        }
    };
    key
}

/// Returns the exponent of a variable in a monomial.
pub fn exponent(key: Powers, variable: Variable, index: usize) -> u32 {
    let one = |which: usize| key.0[WORDS - 1] >> ONES[which].0 & ONES[which].1;
    let place = index as u64 + 1;
    match variable {
        Variable::Acceleration => u32::from(one(0) == place),
        Variable::EvenError => u32::from(one(1) == place),
        Variable::OddError => u32::from(one(1) == place | ODD),
        Variable::Load => u32::from(one(2) == place),
        Variable::Sin | Variable::Cos | Variable::Velocity => {
            let (start, bits) = FIELDS[variable as usize];
            (key.0[index / JOINTS] >> (index % JOINTS * WIDTH + start) & bits) as u32
        }
    }
}

impl Powers {
    /// Returns the product; none if both have a q̈, an error or a load.
    fn times(self, other: Powers) -> Option<Powers> {
        let [a, b] = [self, other].map(|key| key.0[WORDS - 1]);
        let are_both = |(start, bits): &(usize, u64)| {
            let mask = bits << start;
            a & mask != 0 && b & mask != 0
        };
        if a >> ONES[0].0 != 0 && b >> ONES[0].0 != 0 && ONES.iter().any(are_both) {
            return None;
        }
        Some(Powers(std::array::from_fn(|k| self.0[k] + other.0[k])))
    }

    fn and(self, mask: [u64; WORDS]) -> [u64; WORDS] {
        std::array::from_fn(|k| self.0[k] & mask[k])
    }

    pub(crate) fn without_angles(self) -> Powers {
        Powers(std::array::from_fn(|k| self.0[k] & !ANGLES[k]))
    }

    /// Returns a key that is no monomial's.
    pub(crate) fn marked(mut self) -> Powers {
        self.0[WORDS - 1] |= MARK;
        self
    }

    pub(crate) fn unmarked(mut self) -> Powers {
        self.0[WORDS - 1] &= !MARK;
        self
    }
}

/// A function of the state: the sum of its terms, and at most `rest` more or less.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial {
    /// In the order of their keys, each key once.
    pub terms: Vec<(Powers, f64)>,
    /// The largest magnitude of all that is left out.
    pub rest: f64,
}

impl Polynomial {
    /// Returns a variable times a power of two, or any double.
    pub fn variable(variable: Variable, joint: usize, factor: f64) -> Polynomial {
        Polynomial::term(key(variable, joint), factor, 0.0)
    }

    fn term(key: Powers, factor: f64, rest: f64) -> Polynomial {
        let term = Some((key, factor)).filter(|_| factor != 0.0);
        let terms = term.into_iter().collect();
        Polynomial { terms, rest }
    }

    fn norm(&self) -> f64 {
        let sum: f64 = self.terms.iter().map(|(_, c)| c.abs()).sum();
        (sum + self.rest) * SLACK
    }

    /// Returns a number that is at most so far from a double.
    pub fn constant(value: f64, radius: f64) -> Polynomial {
        Polynomial::term(Powers::default(), value, radius)
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
                let Some(key) = left.times(*right) else {
                    rest += product.abs() * SLACK + LEAST;
                    continue;
                };
                let exact = a.abs() == 1.0 || b.abs() == 1.0;
                rest += if exact { 0.0 } else { product.abs() * UNIT };
                rest += if product.abs() < SMALL { LEAST } else { 0.0 };
                reduce(key, product, &mut terms)?;
            }
            if terms.len() > 8 * MOST_TERMS {
                Polynomial { terms, rest } = merged(terms, rest).short()?;
            }
        }
        merged(terms, rest).short()
    }
}

/// Pushes a term, every sin² in it replaced by 1 − cos².
fn reduce(key: Powers, coefficient: f64, terms: &mut Vec<(Powers, f64)>) -> Result<(), Fault> {
    if key.and(GUARD) != [0; WORDS] {
        return Err(Fault::Large);
    }
    let squares = key.and(SINE_SQUARED);
    let Some(word) = squares.iter().position(|square| *square != 0) else {
        terms.push((key, coefficient));
        return Ok(());
    };
    let first = squares[word] & squares[word].wrapping_neg();
    let (mut one, mut cosines) = (key, key);
    one.0[word] &= !first;
    // The bit of sin² is two below that of cos².
    cosines.0[word] = one.0[word] + (first << 2);
    reduce(one, coefficient, terms)?;
    reduce(cosines, -coefficient, terms)
}

/// Sums up terms of the same key; what all but cancelled goes into the rest.
fn merged(mut terms: Vec<(Powers, f64)>, mut rest: f64) -> Polynomial {
    // Stable: sums are taken in the order of the products on every machine.
    terms.sort_by_key(|(key, _)| *key);
    let mut sums: Vec<(Powers, f64)> = Vec::with_capacity(terms.len());
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

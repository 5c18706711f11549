//! Polynomials in the sines and cosines of joint angles, the positions of slides, and symbols.
//!
//! A monomial is two words of 128 bits, so that a product of monomials is a sum of words:
//! - 6 bits a joint: 4 for the power of the cosine (or of the slide), 2 for that of the sine. A
//!   squared sine becomes 1 − cos² at once.
//! - 10 bits for one inertial parameter, in which all forms are linear, and 2 bits for the power of
//!   each of 59 lengths: forces and moments are of degree 2 in them at most.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use dalembert_model::scalar::{Scalar, SinCosPair};

use crate::number::Number;

/// The most joints that have a place in a monomial.
pub const MAX_JOINTS: usize = 21;
/// The most symbols of lengths that have a place in a monomial.
pub const MAX_LENGTHS: usize = 59;
/// The most symbols of inertial parameters.
const MAX_PARAMETERS: usize = 1023;
/// The most terms of a polynomial: D_11 of seven general joints has 15 625.
pub const MAX_TERMS: usize = 50_000;
/// The most products of terms that are formed before they are added up.
const MAX_PRODUCTS: usize = 1 << 20;

/// The highest power of a cosine.
pub const MAX_POWER: usize = 15;

const JOINT_BITS: usize = 6;
const COS_BITS: usize = 4;
const PARAMETER: usize = 2 * MAX_LENGTHS;

/// The bits that are set where a sine is squared.
const SQUARES: u128 = {
    let (mut mask, mut joint) = (0, 0);
    while joint < MAX_JOINTS {
        mask |= 1 << (joint * JOINT_BITS + COS_BITS + 1);
        joint += 1;
    }
    mask
};

/// A product of powers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Monomial {
    /// One inertial parameter and lengths.
    pub symbols: Symbols,
    /// Sines, cosines and slides.
    pub motion: u128,
}

/// The powers of symbols in a monomial.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbols(u128);

impl Symbols {
    /// Returns a length, counted from zero, if there is a place for it.
    pub fn length(index: usize) -> Option<Symbols> {
        (index < MAX_LENGTHS).then(|| Symbols(1 << (2 * index)))
    }

    /// Returns an inertial parameter, counted from zero, if there is a place for it.
    pub fn parameter(index: usize) -> Option<Symbols> {
        (index < MAX_PARAMETERS).then(|| Symbols((index as u128 + 1) << PARAMETER))
    }

    /// Returns the place of the inertial parameter, if there is one.
    pub fn parameter_index(self) -> Option<usize> {
        ((self.0 >> PARAMETER) as usize).checked_sub(1)
    }

    /// Lists the lengths that occur, with their powers.
    pub fn lengths(self) -> impl Iterator<Item = (usize, u32)> {
        let power = move |index: usize| ((self.0 >> (2 * index)) & 3) as u32;
        let powers = (0..MAX_LENGTHS).map(move |index| (index, power(index)));
        powers.filter(|(_, power)| *power > 0)
    }

    /// Returns the power of one symbol, and the product of the others.
    pub fn without(self, symbol: Symbols) -> (usize, Symbols) {
        match symbol.parameter_index() {
            Some(index) if self.parameter_index() == Some(index) => (1, Symbols(self.0 - symbol.0)),
            Some(_) => (0, self),
            None => {
                let power = (self.0 / symbol.0) & 3;
                (power as usize, Symbols(self.0 - power * symbol.0))
            }
        }
    }

    #[must_use]
    pub fn times(self, other: Symbols) -> Symbols {
        Symbols(self.0 + other.0)
    }
}

/// Returns the powers of the cosine (or of the slide) and of the sine of a joint.
pub fn powers(motion: u128, joint: usize) -> [usize; 2] {
    let bits = (motion >> (joint * JOINT_BITS)) as usize;
    [bits & MAX_POWER, (bits >> COS_BITS) & 3]
}

/// Returns the part of a word that belongs to a joint.
pub fn part(motion: u128, joint: usize) -> u128 {
    motion & (((1 << JOINT_BITS) - 1) << (joint * JOINT_BITS))
}

/// A sum of monomials with coefficients, sorted, none of them zero. One that would have more than
/// [`MAX_TERMS`] of them is lost, and so is what is made of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial {
    terms: Vec<(Monomial, Number)>,
    is_lost: bool,
}

impl Polynomial {
    pub fn constant(value: Number) -> Polynomial {
        Polynomial::term(Monomial::default(), value)
    }

    pub fn symbol(symbols: Symbols) -> Polynomial {
        let motion = 0;
        Polynomial::term(Monomial { symbols, motion }, Number::one())
    }

    /// Makes the position of a slide.
    pub fn slide(joint: usize) -> Polynomial {
        Polynomial::motion(1 << (joint * JOINT_BITS))
    }

    /// Makes sine and cosine of a joint's angle.
    pub fn turn(joint: usize) -> SinCosPair<Polynomial> {
        SinCosPair {
            sin: Polynomial::motion(1 << (joint * JOINT_BITS + COS_BITS)),
            cos: Polynomial::motion(1 << (joint * JOINT_BITS)),
        }
    }

    fn motion(motion: u128) -> Polynomial {
        let symbols = Symbols::default();
        Polynomial::term(Monomial { symbols, motion }, Number::one())
    }

    fn term(monomial: Monomial, value: Number) -> Polynomial {
        match value.is_zero() {
            true => Polynomial::default(),
            false => Polynomial::of(vec![(monomial, value)]),
        }
    }

    fn of(terms: Vec<(Monomial, Number)>) -> Polynomial {
        let is_lost = false;
        match terms.len() > MAX_TERMS {
            true => Polynomial::lost(),
            false => Polynomial { terms, is_lost },
        }
    }

    fn lost() -> Polynomial {
        let (terms, is_lost) = (Vec::new(), true);
        Polynomial { terms, is_lost }
    }

    /// True if it has too many terms.
    pub fn is_lost(&self) -> bool {
        self.is_lost
    }

    /// Lists the terms; empty for a lost polynomial.
    pub fn terms(&self) -> &[(Monomial, Number)] {
        &self.terms
    }

    /// Counts the products of sines, cosines and slides, whatever symbols they stand with.
    pub fn motions(&self) -> usize {
        let motions = self.terms.iter().map(|(monomial, _)| monomial.motion);
        motions.collect::<BTreeSet<u128>>().len()
    }

    /// Returns the constant that it is, if it is one.
    pub fn to_constant(&self) -> Option<Number> {
        match self.terms.as_slice() {
            _ if self.is_lost => None,
            [] => Some(Number::zero()),
            [(monomial, value)] => (*monomial == Monomial::default()).then_some(*value),
            _ => None,
        }
    }

    /// Returns each coefficient times a factor.
    #[must_use]
    pub fn scaled(&self, factor: &Number) -> Polynomial {
        match factor.is_zero() {
            true => Polynomial::default(),
            false => self.each(|x| x.mul(factor)),
        }
    }

    fn each(&self, change: impl Fn(&Number) -> Number) -> Polynomial {
        let terms = self.terms.iter();
        Polynomial {
            terms: terms.map(|(monomial, x)| (*monomial, change(x))).collect(),
            is_lost: self.is_lost,
        }
    }

    /// True for the same polynomial, or for its opposite: then the sign is −1.
    pub fn sign_against(&self, other: &Polynomial) -> Option<i8> {
        let both = || self.terms.iter().zip(&other.terms);
        if self.terms.len() != other.terms.len() || both().any(|((m, _), (n, _))| m != n) {
            return None;
        }
        let equal = both().all(|((_, x), (_, y))| x.residue() == y.residue());
        let opposite = || both().all(|((_, x), (_, y))| x.residue() == y.residue().neg());
        match equal {
            true => Some(1),
            false => opposite().then_some(-1),
        }
    }
}

/// Sorts terms and adds up those of one monomial.
fn merged(mut terms: Vec<(Monomial, Number)>) -> Vec<(Monomial, Number)> {
    terms.sort_unstable_by_key(|(monomial, _)| *monomial);
    let mut sums: Vec<(Monomial, Number)> = Vec::with_capacity(terms.len());
    for (monomial, x) in terms {
        match sums.last_mut() {
            Some((last, sum)) if *last == monomial => *sum = sum.add(&x),
            _ => sums.push((monomial, x)),
        }
    }
    sums.retain(|(_, x)| !x.is_zero());
    sums
}

/// Enters a term with squared sines as terms without them.
fn enter(terms: &mut Vec<(Monomial, Number)>, monomial: Monomial, x: Number) {
    let squares = monomial.motion & SQUARES;
    if squares == 0 {
        terms.push((monomial, x));
        return;
    }
    let square = squares & squares.wrapping_neg();
    let motion = monomial.motion - square;
    enter(terms, Monomial { motion, ..monomial }, x);
    let cosines = 2 * (square >> (COS_BITS + 1));
    let motion = motion + cosines;
    enter(terms, Monomial { motion, ..monomial }, x.neg());
}

impl Scalar for Polynomial {
    fn zero() -> Self {
        Polynomial::default()
    }
    fn one() -> Self {
        Polynomial::constant(Number::one())
    }
    fn add(&self, other: &Self) -> Self {
        if self.is_lost || other.is_lost {
            return Polynomial::lost();
        }
        let (mut a, mut b) = (self.terms.as_slice(), other.terms.as_slice());
        let mut sums = Vec::with_capacity(a.len() + b.len());
        while let ([(m, x), rest @ ..], [(n, y), others @ ..]) = (a, b) {
            match m.cmp(n) {
                Ordering::Less => {
                    sums.push((*m, *x));
                    a = rest;
                }
                Ordering::Greater => {
                    sums.push((*n, *y));
                    b = others;
                }
                Ordering::Equal => {
                    let sum = x.add(y);
                    if !sum.is_zero() {
                        sums.push((*m, sum));
                    }
                    (a, b) = (rest, others);
                }
            }
        }
        sums.extend_from_slice(a);
        sums.extend_from_slice(b);
        Polynomial::of(sums)
    }
    fn mul(&self, other: &Self) -> Self {
        for (polynomial, other) in [(self, other), (other, self)] {
            if let Some(factor) = other.to_constant() {
                return polynomial.scaled(&factor);
            }
        }
        let products = self.terms.len() * other.terms.len();
        if self.is_lost || other.is_lost || products > MAX_PRODUCTS {
            return Polynomial::lost();
        }
        let mut terms = Vec::with_capacity(products);
        for (m, x) in &self.terms {
            for (n, y) in &other.terms {
                let monomial = Monomial {
                    symbols: m.symbols.times(n.symbols),
                    motion: m.motion + n.motion,
                };
                enter(&mut terms, monomial, x.mul(y));
            }
        }
        Polynomial::of(merged(terms))
    }
    fn neg(&self) -> Self {
        self.each(Number::neg)
    }
    fn half(&self) -> Self {
        self.each(Number::half)
    }
    fn is_zero(&self) -> bool {
        self.terms.is_empty() && !self.is_lost
    }
    fn is_one(&self) -> bool {
        self.to_constant().is_some_and(|x| x.is_one())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_are_reduced_in_all_joints() {
        let [a, b] = [3, 20].map(Polynomial::turn);
        let circle = |p: &SinCosPair<Polynomial>| p.sin.mul(&p.sin).add(&p.cos.mul(&p.cos));
        assert!(circle(&a).is_one() && circle(&b).is_one());
        assert!(circle(&a.compose(&b)).is_one());
        let both = a.sin.mul(&b.sin);
        let [c, d] = [&a, &b].map(|p| Polynomial::one().sub(&p.cos.mul(&p.cos)));
        assert_eq!(both.mul(&both), c.mul(&d));
    }

    #[test]
    fn what_grows_too_large_is_lost() {
        let one = Polynomial::one();
        let factor = |joint: usize| {
            let SinCosPair { sin, cos } = Polynomial::turn(joint);
            one.add(&sin).add(&cos)
        };
        let product = |joints: usize| {
            let factors = (0..joints).map(factor);
            factors.fold(one.clone(), |product, factor| product.mul(&factor))
        };
        assert_eq!(product(9).terms().len(), 3usize.pow(9));
        let lost = product(10);
        assert!(lost.is_lost() && !lost.is_zero() && lost.to_constant().is_none());
        assert!(lost.add(&one).is_lost() && lost.neg().mul(&factor(0)).is_lost());
        assert!(lost.mul(&Polynomial::zero()).is_zero());
    }

    #[test]
    fn symbols_keep_their_powers() {
        let a = Polynomial::symbol(Symbols::length(58).unwrap());
        let m = Polynomial::symbol(Symbols::parameter(1022).unwrap());
        let product = a.mul(&m).mul(&a);
        let [(monomial, _)] = product.terms() else {
            panic!("one term")
        };
        assert_eq!(monomial.symbols.parameter_index(), Some(1022));
        assert_eq!(monomial.symbols.lengths().collect::<Vec<_>>(), [(58, 2)]);
    }
}

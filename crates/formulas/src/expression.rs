//! Sums and products as they are printed, whatever the format.

use std::collections::BTreeMap;

use dalembert_model::scalar::Scalar;

use crate::canonical::{Form, Runs, Shape, Terms};
use crate::number::Number;
use crate::ring::Symbols;
use crate::symbol::Symbol;

/// A sum of terms; without terms it is zero.
pub type Sum = Vec<Term>;

/// A product.
#[derive(Clone, Debug)]
pub struct Term {
    /// True if it is subtracted.
    pub is_negative: bool,
    /// True if it is below a thousandth of the largest term of the line.
    pub is_small: bool,
    /// The factors; without any it is one.
    pub factors: Vec<Factor>,
}

/// A factor of a product.
#[derive(Clone, Debug)]
pub enum Factor {
    /// A positive number that was measured, rounded for reading.
    Number(Number),
    /// A positive number of the formula itself, such as ½.
    Exact(Number),
    /// A power of a symbol.
    Symbol(Symbol, u32),
    /// A power of a sine or a cosine.
    Wave(Trig, u32),
    /// A sum in parentheses.
    Sum(Sum),
}

/// The sine or the cosine of a combination of angles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trig {
    /// A sine, or else a cosine.
    pub is_sine: bool,
    /// The multiple and the number of each joint, counted from one; the first multiple is positive.
    pub angle: Vec<(i32, usize)>,
}

impl Term {
    /// Makes a product.
    pub fn new(is_negative: bool, factors: Vec<Factor>) -> Term {
        Term {
            is_negative,
            is_small: false,
            factors,
        }
    }

    /// Makes a product with a number in front, unless that is 1 or −1.
    pub(crate) fn times(number: &Number, mut factors: Vec<Factor>) -> Term {
        if !size_is_one(number) {
            factors.insert(0, Factor::Exact(number.abs()));
        }
        Term::new(number.is_negative(), factors)
    }
}

/// Counts the products of a sum, those inside of parentheses each.
pub fn products(sum: &[Term]) -> usize {
    let of_term = |term: &Term| {
        let inner = term.factors.iter().filter_map(|factor| match factor {
            Factor::Sum(sum) => Some(products(sum)),
            _ => None,
        });
        inner.product::<usize>()
    };
    sum.iter().map(of_term).sum()
}

/// Writes the factors of a shape.
pub fn shaped(shape: &Shape, runs: &Runs) -> Vec<Factor> {
    let mut factors = Vec::new();
    for (power, symbol) in shape.slides.iter().zip(&runs.slide_symbols) {
        if *power > 0 {
            factors.push(Factor::Symbol(symbol.clone(), *power as u32));
        }
    }
    for (waves, run) in shape.waves.iter().zip(&runs.runs) {
        let mut waves: Vec<_> = waves.iter().collect();
        waves.sort_by_key(|wave| (!wave.is_sine, &wave.multiples));
        for group in waves.chunk_by(|a, b| a == b) {
            let multiples = group[0].multiples.iter().zip(run);
            let numbered = multiples.map(|(multiple, joint)| (*multiple, joint + 1));
            let trig = Trig {
                is_sine: group[0].is_sine,
                angle: numbered.filter(|(multiple, _)| *multiple != 0).collect(),
            };
            factors.push(Factor::Wave(trig, group.len() as u32));
        }
    }
    factors
}

/// Writes an entry whose coefficients are numbers.
pub fn with_numbers(terms: &Terms, runs: &Runs) -> Sum {
    let sizes = terms.values().flat_map(Form::values).map(Number::magnitude);
    let largest = sizes.fold(0.0, f64::max);
    let term = |(shape, form): (&Shape, &Form)| {
        let value = form.values().fold(Number::zero(), |sum, x| sum.add(x));
        if value.is_zero() {
            return None;
        }
        let mut factors = shaped(shape, runs);
        if !size_is_one(&value) {
            factors.insert(0, Factor::Number(value.abs()));
        }
        Some(Term {
            is_small: value.magnitude() < largest / 1000.0,
            ..Term::new(value.is_negative(), factors)
        })
    };
    let mut sum: Sum = terms.iter().filter_map(term).collect();
    sum.sort_by_key(|term| term.is_small);
    sum
}

/// Writes an entry by the products of symbols in it: each times a sum, a common number outside.
pub fn by_symbols(terms: &Terms, runs: &Runs, name: impl Fn(Symbols) -> Vec<Factor>) -> Sum {
    let mut groups: BTreeMap<_, Vec<(&Shape, Number)>> = BTreeMap::new();
    for (shape, form) in terms {
        for (symbols, x) in form {
            let group = groups.entry((symbols.parameter_index(), *symbols));
            group.or_default().push((shape, *x));
        }
    }
    let mut sum = Sum::new();
    for ((_, symbols), group) in groups {
        let common = name(symbols);
        match common.is_empty() {
            true => sum.extend(group.chunks(1).map(|one| grouped(Vec::new(), one, runs))),
            false => sum.push(grouped(common, &group, runs)),
        }
    }
    sum
}

/// Adds up terms of the same symbols.
pub fn collected(sum: Sum) -> Sum {
    let mut sums: Vec<(Vec<(Symbol, u32)>, Number)> = Vec::new();
    for term in sum {
        let mut symbols: Vec<(Symbol, u32)> = Vec::new();
        let mut number = Number::one();
        for factor in term.factors {
            match factor {
                Factor::Symbol(symbol, power) => symbols.push((symbol, power)),
                Factor::Number(x) | Factor::Exact(x) => number = number.mul(&x),
                Factor::Wave(..) | Factor::Sum(_) => {}
            }
        }
        symbols.sort();
        if term.is_negative {
            number = number.neg();
        }
        match sums.iter_mut().find(|(known, _)| *known == symbols) {
            Some((_, sum)) => *sum = sum.add(&number),
            None => sums.push((symbols, number)),
        }
    }
    sums.retain(|(_, x)| !x.is_zero());
    let term = |(symbols, x): (Vec<(Symbol, u32)>, Number)| {
        let factor = |(symbol, power)| Factor::Symbol(symbol, power);
        Term::times(&x, symbols.into_iter().map(factor).collect())
    };
    sums.into_iter().map(term).collect()
}

/// Writes common factors times a sum of shapes with coefficients.
pub fn grouped(common: Vec<Factor>, group: &[(&Shape, Number)], runs: &Runs) -> Term {
    let first = group[0].1;
    let is_negative = first.is_negative();
    let size = |x: &Number| x.abs().residue();
    let same = group.iter().all(|(_, x)| size(x) == size(&first));
    let mut inner: Vec<Term> = group
        .iter()
        .map(|(shape, x)| {
            let mut factors = shaped(shape, runs);
            if !same && !size_is_one(x) {
                factors.insert(0, Factor::Exact(x.abs()));
            }
            Term::new(x.is_negative() != is_negative, factors)
        })
        .collect();
    let mut factors = common;
    match inner.len() {
        1 => factors.extend(inner.remove(0).factors),
        _ => factors.push(Factor::Sum(inner)),
    }
    match same {
        true => Term::times(&first, factors),
        false => Term::new(is_negative, factors),
    }
}

fn size_is_one(x: &Number) -> bool {
    x.abs().is_one()
}

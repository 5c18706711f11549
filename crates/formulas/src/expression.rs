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
    let mut factors: Vec<Factor> = shape
        .slides
        .iter()
        .zip(&runs.slide_symbols)
        .filter(|(power, _)| **power > 0)
        .map(|(power, symbol)| Factor::Symbol(symbol.clone(), *power as u32))
        .collect();
    for (waves, run) in shape.waves.iter().zip(&runs.runs) {
        let mut waves: Vec<_> = waves.iter().collect();
        waves.sort_by_key(|wave| (!wave.is_sine, &wave.multiples));
        for group in waves.chunk_by(|a, b| a == b) {
            let multiples = group[0].multiples.iter().zip(run);
            let trig = Trig {
                is_sine: group[0].is_sine,
                angle: multiples
                    .filter(|(multiple, _)| **multiple != 0)
                    .map(|(multiple, joint)| (*multiple, joint + 1))
                    .collect(),
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
    let (large, small): (Vec<Term>, Vec<Term>) = terms
        .iter()
        .filter_map(term)
        .partition(|term| !term.is_small);
    large.into_iter().chain(small).collect()
}

/// Terms with the same symbols.
type LikeTerms<'a> = Vec<(&'a Shape, Number)>;

/// Writes an entry by the products of symbols in it: each times a sum, a common number outside.
pub fn by_symbols(terms: &Terms, runs: &Runs, name: impl Fn(Symbols) -> Vec<Factor>) -> Sum {
    let mut groups: BTreeMap<(Option<usize>, Symbols), LikeTerms<'_>> = BTreeMap::new();
    for (shape, form) in terms {
        for (symbols, x) in form {
            let group = groups.entry((symbols.parameter_index(), *symbols));
            group.or_default().push((shape, *x));
        }
    }
    let terms = |(symbols, group): (Symbols, LikeTerms<'_>)| {
        let common = name(symbols);
        match common.is_empty() {
            true => group
                .chunks(1)
                .map(|one| grouped(Vec::new(), one, runs))
                .collect(),
            false => vec![grouped(common, &group, runs)],
        }
    };
    let groups = groups
        .into_iter()
        .map(|((_, symbols), group)| (symbols, group));
    groups.flat_map(terms).collect()
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
        let number = if term.is_negative {
            number.neg()
        } else {
            number
        };
        match sums.iter_mut().find(|(known, _)| *known == symbols) {
            Some((_, sum)) => *sum = sum.add(&number),
            None => sums.push((symbols, number)),
        }
    }
    sums.retain(|(_, x)| !x.is_zero());
    let term = |(symbols, x): (Vec<(Symbol, u32)>, Number)| {
        let factor = |(symbol, power)| Factor::Symbol(symbol, power);
        let mut factors: Vec<Factor> = symbols.into_iter().map(factor).collect();
        if !size_is_one(&x) {
            factors.insert(0, Factor::Exact(x.abs()));
        }
        Term::new(x.is_negative(), factors)
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
    let mut factors = Vec::new();
    if same && !size_is_one(&first) {
        factors.push(Factor::Exact(first.abs()));
    }
    factors.extend(common);
    match inner.len() {
        1 => factors.extend(inner.remove(0).factors),
        _ => factors.push(Factor::Sum(inner)),
    }
    Term::new(is_negative, factors)
}

fn size_is_one(x: &Number) -> bool {
    x.abs().is_one()
}

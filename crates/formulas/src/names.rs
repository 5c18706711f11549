//! Symbols of an entry's coefficients: by themselves, or as constants that several entries share.

use std::collections::BTreeMap;

use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use crate::arm::SymbolicArm;
use crate::canonical::{Form, Runs, Shape, Terms};
use crate::expression::{Factor, Sum, Term, grouped};
use crate::number::Number;
use crate::ring::{Polynomial, Symbols};
use crate::symbol::Symbol;

/// The symbols that coefficients of some entries are written in.
pub struct Names<'a> {
    /// The arm, which has the lengths.
    pub arm: &'a SymbolicArm,
    /// The inertial parameters: symbols and values.
    pub parameters: Vec<(Symbol, Number)>,
}

impl Names<'_> {
    /// Writes a product of symbols.
    pub fn factors(&self, symbols: Symbols) -> Vec<Factor> {
        // Gravity is read before lengths, and lengths before masses.
        let mut factors = Vec::new();
        for (index, power) in symbols.lengths() {
            factors.push(Factor::Symbol(
                self.arm.symbols.lengths[index].symbol.clone(),
                power,
            ));
        }
        if let Some(index) = symbols.parameter_index() {
            factors.push(Factor::Symbol(self.parameters[index].0.clone(), 1));
        }
        factors
    }

    /// Writes a form as a sum of products.
    pub fn form(&self, form: &Form) -> Sum {
        let mut terms: Vec<(&Symbols, &Number)> = form.iter().collect();
        terms.sort_by_key(|(symbols, _)| (symbols.parameter_index(), **symbols));
        let term = |(symbols, x): (&Symbols, &Number)| Term::times(x, self.factors(*symbols));
        terms.into_iter().map(term).collect()
    }

    pub fn value(&self, form: &Form) -> Number {
        let parameter = |index: usize| self.parameters[index].1;
        form.iter().fold(Number::zero(), |sum, (symbols, x)| {
            sum.add(&self.arm.value_of(*symbols, parameter).mul(x))
        })
    }
}

/// Returns a polynomial without motion as a form.
pub fn form_of(polynomial: &Polynomial) -> Form {
    let terms = polynomial.terms().iter();
    terms.map(|(monomial, x)| (monomial.symbols, *x)).collect()
}

/// Coefficients that are equal but for a factor, under one name each: K1, K2, …
#[derive(Default)]
pub struct SharedConstants {
    index: BTreeMap<Vec<(Symbols, Field)>, usize>,
    /// Each constant: its first coefficient is one.
    pub forms: Vec<Form>,
}

impl SharedConstants {
    /// Returns the place of the constant of a form, and the form's factor.
    fn place(&mut self, form: &Form) -> (usize, Number) {
        let lead = form.values().next().copied().unwrap_or_else(Number::one);
        let mut normal = form.clone();
        for x in normal.values_mut() {
            *x = x.over(&lead).unwrap_or_else(Number::zero);
        }
        let key = normal.iter().map(|(symbols, x)| (*symbols, x.residue()));
        let next = self.forms.len();
        let place = *self.index.entry(key.collect()).or_insert(next);
        if place == next {
            self.forms.push(normal);
        }
        (place, lead)
    }

    /// Writes an entry in constants.
    pub fn sum(&mut self, terms: &Terms, runs: &Runs) -> Sum {
        let mut groups: BTreeMap<usize, Vec<(&Shape, Number)>> = BTreeMap::new();
        for (shape, form) in terms {
            let (place, lead) = self.place(form);
            groups.entry(place).or_default().push((shape, lead));
        }
        let term = |(place, group): (usize, Vec<_>)| {
            let constant = Factor::Symbol(SharedConstants::symbol(place), 1);
            grouped(vec![constant], &group, runs)
        };
        groups.into_iter().map(term).collect()
    }

    pub fn symbol(place: usize) -> Symbol {
        Symbol::indexed("K", place + 1)
    }
}

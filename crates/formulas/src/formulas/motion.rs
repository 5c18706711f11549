//! Energies and torques: products of coefficients and rates.

use dalembert_model::outputs::Argument;
use dalembert_model::scalar::Scalar;

use super::{Builder, FEW_JOINTS};
use crate::expression::{Factor, Sum, Term};
use crate::line::{Line, Section, list, pairs};
use crate::number::Number;
use crate::quantity::Quantity;
use crate::symbol::Symbol;

/// Sums of so many products or less stand for an entry inside of an energy or a torque.
const SHORT: usize = 24;

impl Builder<'_> {
    /// Returns an entry as a factor: its sum, if that is short, else its name; `None` if it is zero.
    fn entry(&mut self, quantity: Quantity, indices: &[usize], table: usize) -> Option<Factor> {
        let polynomial = match *indices {
            [i] => &self.coefficients.gravity[i],
            [i, k] => &self.coefficients.inertia[i][k],
            [i, k, m] => &self.coefficients.christoffel[i][k][m],
            _ => return None,
        };
        if polynomial.is_zero() {
            return None;
        }
        let name = Factor::Symbol(quantity.entry(indices), 1);
        if polynomial.terms().len() > SHORT || self.arm.variables.len() > FEW_JOINTS {
            return Some(name);
        }
        let polynomial = polynomial.clone();
        let sum = self.sums(&[polynomial], table).pop()?;
        Some(Factor::Sum(sum))
    }

    /// Returns an entry times a number and rates; `None` if it is zero.
    fn term(
        &mut self,
        quantity: Quantity,
        indices: &[usize],
        table: usize,
        number: f64,
        rates: Vec<Factor>,
    ) -> Option<Term> {
        let entry = self.entry(quantity, indices, table)?;
        let mut factors = vec![Factor::Exact(Number::of_dyadic(number)), entry];
        factors.extend(rates);
        Some(flat(Term::new(false, factors)))
    }

    pub(super) fn kinetic_energy(&mut self, table: usize) -> Section {
        let mut sum = Sum::new();
        let is_moving = !self.setup.has_zero(Argument::Velocity);
        for (i, k) in pairs(self.setup.rows().len()).filter(|_| is_moving) {
            let number = if i == k { 0.5 } else { 1.0 };
            let rates = self.rates([i, k]);
            sum.extend(self.term(Quantity::Inertia, &[i, k], table, number, rates));
        }
        let name = Quantity::KineticEnergy.entry(&[]);
        self.single(Quantity::KineticEnergy, vec![(name, sum)])
    }

    pub(super) fn torques(&mut self, table: usize) -> Section {
        let n = self.setup.rows().len();
        let [is_moving, is_accelerating] =
            [Argument::Velocity, Argument::Acceleration].map(|rate| !self.setup.has_zero(rate));
        let mut lines = Vec::new();
        for i in 0..n {
            let mut sum = Sum::new();
            for k in (0..n).filter(|_| is_accelerating) {
                let indices = [i.min(k), i.max(k)];
                let rate = Factor::Symbol(Symbol::rate(2, self.joint(k)), 1);
                sum.extend(self.term(Quantity::Inertia, &indices, table, 1.0, vec![rate]));
            }
            for (k, m) in pairs(n).filter(|_| is_moving) {
                let number = if k == m { 1.0 } else { 2.0 };
                let (indices, rates) = ([i, k, m], self.rates([k, m]));
                sum.extend(self.term(Quantity::Christoffel, &indices, table, number, rates));
            }
            match self.entry(Quantity::Gravity, &[i], table) {
                Some(Factor::Sum(terms)) => sum.extend(terms),
                Some(factor) => sum.push(Term::new(false, vec![factor])),
                None => {}
            }
            lines.push((Quantity::Torque.entry(&[i]), sum));
        }
        self.single(Quantity::Torque, lines)
    }

    /// The number of a joint of the results, counted from one.
    fn joint(&self, place: usize) -> usize {
        self.setup.rows()[place] + 1
    }

    fn rates(&self, [k, m]: [usize; 2]) -> Vec<Factor> {
        let rate = |place: usize| Symbol::rate(1, self.joint(place));
        match k == m {
            true => vec![Factor::Symbol(rate(k), 2)],
            false => vec![Factor::Symbol(rate(k), 1), Factor::Symbol(rate(m), 1)],
        }
    }

    fn single(&self, quantity: Quantity, lines: Vec<(Symbol, Sum)>) -> Section {
        let mut section = Section {
            title: quantity.title().to_owned(),
            lines: Vec::new(),
            zeros: Vec::new(),
            list: list(quantity, self.setup.rows().len()),
        };
        for (name, sum) in lines {
            match sum.is_empty() {
                true => section.zeros.push(name),
                false => section.lines.push(Line::new(name, sum)),
            }
        }
        section
    }
}

/// Puts a sum of one term beside its factors, and makes one number of all numbers.
fn flat(mut term: Term) -> Term {
    let is_single = |factor: &Factor| matches!(factor, Factor::Sum(sum) if sum.len() == 1);
    if let Some(place) = term.factors.iter().position(is_single)
        && let Factor::Sum(mut sum) = term.factors.remove(place)
        && let Some(inner) = sum.pop()
    {
        term.is_negative ^= inner.is_negative;
        term.factors.splice(place..place, inner.factors);
    }
    let (mut number, mut is_measured) = (Number::one(), false);
    term.factors.retain(|factor| {
        let (Factor::Number(x) | Factor::Exact(x)) = factor else {
            return true;
        };
        is_measured |= matches!(factor, Factor::Number(_));
        number = number.mul(x);
        false
    });
    if !number.is_one() {
        let factor = match is_measured {
            true => Factor::Number(number),
            false => Factor::Exact(number),
        };
        term.factors.insert(0, factor);
    }
    term
}

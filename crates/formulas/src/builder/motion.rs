//! Energies and torques: products of coefficients and rates.

use dalembert_model::outputs::Argument;
use dalembert_model::scalar::Scalar;

use super::{Builder, FEW_JOINTS};
use crate::expression::{Factor, Sum, Term};
use crate::line::{Line, Section};
use crate::lists::{list, pairs};
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

    pub(super) fn kinetic_energy(&mut self, table: usize) -> Section {
        let mut sum = Sum::new();
        let is_moving = !self.setup.has_zero(Argument::Velocity);
        for (i, k) in pairs(self.setup.rows().len()).filter(|_| is_moving) {
            let Some(factor) = self.entry(Quantity::Inertia, &[i, k], table) else {
                continue;
            };
            let mut factors = Vec::new();
            if i == k {
                factors.push(Factor::Exact(Number::one().half()));
            }
            factors.push(factor);
            factors.extend(self.rates([i, k]));
            sum.push(flat(Term::new(false, factors)));
        }
        self.single(
            Quantity::KineticEnergy,
            vec![(Quantity::KineticEnergy.entry(&[]), sum)],
        )
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
                if let Some(factor) = self.entry(Quantity::Inertia, &indices, table) {
                    let rate = Symbol::rate(2, self.joint(k));
                    let factors = vec![factor, Factor::Symbol(rate, 1)];
                    sum.push(flat(Term::new(false, factors)));
                }
            }
            for (k, m) in pairs(n).filter(|_| is_moving) {
                let Some(factor) = self.entry(Quantity::Christoffel, &[i, k, m], table) else {
                    continue;
                };
                let mut factors = vec![factor];
                if k != m {
                    factors.insert(0, Factor::Exact(Number::of_dyadic(2.0)));
                }
                factors.extend(self.rates([k, m]));
                sum.push(flat(Term::new(false, factors)));
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
        let (zeros, lines): (Vec<_>, Vec<_>) =
            lines.into_iter().partition(|(_, sum)| sum.is_empty());
        let line = |(name, sum)| Line {
            name,
            others: Vec::new(),
            sum,
        };
        Section {
            title: quantity.title().to_owned(),
            lines: lines.into_iter().map(line).collect(),
            zeros: zeros.into_iter().map(|(name, _)| name).collect(),
            list: list(quantity, self.setup.rows().len()),
        }
    }
}

/// Puts a sum of one term beside its factors, and makes one number of all numbers.
fn flat(term: Term) -> Term {
    let mut term = spliced(term);
    let mut measured = false;
    let mut number = Number::one();
    term.factors.retain(|factor| match factor {
        Factor::Number(x) => {
            measured = true;
            number = number.mul(x);
            false
        }
        Factor::Exact(x) => {
            number = number.mul(x);
            false
        }
        _ => true,
    });
    if !number.is_one() {
        let number = if measured {
            Factor::Number(number)
        } else {
            Factor::Exact(number)
        };
        term.factors.insert(0, number);
    }
    term
}

fn spliced(mut term: Term) -> Term {
    let place = term
        .factors
        .iter()
        .position(|factor| matches!(factor, Factor::Sum(sum) if sum.len() == 1));
    let Some(place) = place else { return term };
    let Factor::Sum(mut sum) = term.factors.remove(place) else {
        return term;
    };
    if let Some(inner) = sum.pop() {
        term.is_negative ^= inner.is_negative;
        term.factors.splice(place..place, inner.factors);
    }
    term
}

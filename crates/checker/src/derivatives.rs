//! The cost of rounding in a result, as a sum over all roundings: each times the largest derivative
//! of the result by it, both bounded by polynomials.
//!
//! Let e be how far a float is from the exact value. A sum has e₁ + e₂ and its own rounding; a
//! product e₁·ỹ + x·e₂, where ỹ is the float. So the error of a result is exactly the sum of all
//! roundings, each times a product of values along the ways to the result. A polynomial A of exact
//! values is that sum of products but for a difference of at most D, since some of the values are
//! floats. The bound is Σ (A + D)·r.

use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::maximum::length;
use crate::polynomial::Polynomial;
use crate::program::{Operand, Program};
use crate::ring::Ring;
use crate::rounding::Rounding;
use crate::work::Work;
use crate::written::PolynomialProgram;

/// The text of a function, the same program with exact constants, and its steps as polynomials.
pub(crate) struct Derivatives<'d> {
    pub(crate) text: &'d Program<f64>,
    pub(crate) program: &'d Program<Exact>,
    pub(crate) written: &'d PolynomialProgram<'d>,
    pub(crate) ring: &'d Ring,
    pub(crate) rounding: &'d Rounding<'d>,
    /// A bound of the magnitude of each step.
    pub(crate) sizes: &'d [f64],
    pub(crate) work: &'d Work,
}

/// Bounds of an operand: its magnitude, and how far the float is from it.
#[derive(Clone, Copy)]
struct OperandBound {
    size: f64,
    error: f64,
}

fn half_ulp(unit: f64, size: f64) -> f64 {
    match size.is_normal() {
        true => unit * f64::from_bits(size.to_bits() & !((1 << 52) - 1)),
        false => size,
    }
}

fn is_power(operand: &Operand<f64>) -> bool {
    let is_power = |number: f64| number.is_normal() && number.to_bits() & ((1 << 52) - 1) == 0;
    matches!(operand, Operand::Constant(literal) if is_power(*literal))
}

impl Derivatives<'_> {
    pub(crate) fn bounds(&self, results: &[usize]) -> Result<Vec<f64>, Fault> {
        let mut known: Vec<OperandBound> = Vec::new();
        let mut rounded = Vec::new();
        let steps = self.text.steps.iter().zip(&self.program.steps);
        for (step, ((operation, [a, b]), (_, [one, other]))) in steps.enumerate() {
            let [x, y] = [(a, one), (b, other)]
                .map(|(text, operand)| self.operand_bound(text, operand, &known));
            let inherited = match operation {
                '+' | '-' => x.error + y.error,
                _ => x.size * y.error + y.size * x.error + x.error * y.error,
            };
            let size = self.sizes[step];
            let is_exact = match operation {
                '×' => true,
                '*' => is_power(a) || is_power(b),
                '+' => a == b,
                _ => false,
            };
            let scalar = self.rounding.scalar;
            let rounding_error = match is_exact {
                true => scalar.least,
                false => half_ulp(scalar.unit, size + inherited) + scalar.least,
            };
            rounded.push(rounding_error);
            let error = (inherited + rounding_error) * (1.0 + 1e-12);
            known.push(OperandBound { size, error });
        }
        let bound = |result: &usize| self.bound(*result, &known, &rounded);
        results.iter().map(bound).collect()
    }

    fn operand_bound(
        &self,
        text: &Operand<f64>,
        operand: &Operand<Exact>,
        steps: &[OperandBound],
    ) -> OperandBound {
        let unit = self.rounding.scalar.unit;
        match (text, operand) {
            (Operand::Step(step), _) => steps[*step],
            (Operand::Constant(literal), Operand::Constant(exact)) => {
                let [value, radius] = exact.double().unwrap_or([f64::NAN; 2]);
                let off = (value - literal).abs();
                let rounded_up = (off + radius) * (1.0 + 1e-12);
                let error = if off == 0.0 { radius } else { rounded_up };
                let size = literal.abs() + error;
                OperandBound { size, error }
            }
            (Operand::Sine(joint, is_sine), _) => {
                let (size, error) = match self.rounding.polynomial(*joint, *is_sine) {
                    Some(deviation) => (1.0 + deviation, 0.0),
                    None => (1.0, 2.0 * unit),
                };
                OperandBound { size, error }
            }
            _ => {
                let value = self.written.leaf(operand);
                let size = value.map_or(f64::INFINITY, |value| self.ring.size(&value));
                let error = self.rounding.load_error(text);
                OperandBound { size, error }
            }
        }
    }

    fn bound(&self, result: usize, known: &[OperandBound], rounded: &[f64]) -> Result<f64, Fault> {
        let (_, output) = &self.text.outputs[result];
        let (_, exact) = &self.program.outputs[result];
        let Operand::Step(top) = output else {
            return Ok(self.operand_bound(output, exact, known).error);
        };
        let mut slopes = vec![Polynomial::default(); top + 1];
        let mut offs = vec![0.0; top + 1];
        slopes[*top] = Polynomial::constant(1.0, 0.0);
        let mut sum = 0.0;
        let mut leaves: Vec<(&Operand<f64>, Polynomial, f64)> = Vec::new();
        for step in (0..=*top).rev() {
            let (slope, off) = (std::mem::take(&mut slopes[step]), offs[step]);
            let most = match slope.terms.is_empty() {
                true => slope.rest,
                false => self.size(&slope)?,
            };
            if most + off == 0.0 {
                continue;
            }
            sum += (most + off) * rounded[step];
            let (operation, [a, b]) = &self.text.steps[step];
            let [one, other] = &self.program.steps[step].1;
            let [x, y] = [(a, one), (b, other)]
                .map(|(text, operand)| self.operand_bound(text, operand, known));
            // The other factor of the left operand is the float, of the right one the exact value.
            let sides = [(a, x, other, y, y.error), (b, y, one, x, 0.0)];
            for (side, (text, bound, factor, other, error)) in sides.into_iter().enumerate() {
                let (part, part_off) = match operation {
                    '-' if side == 1 => (slope.negated(), off),
                    '+' | '-' => (slope.clone(), off),
                    _ => {
                        let value = self.written.value(factor)?;
                        let part = slope.times(&value, self.work)?;
                        (part, (most + off) * error + off * other.size)
                    }
                };
                match text {
                    Operand::Step(to) => {
                        slopes[*to] = slopes[*to].sum(&part, self.work)?;
                        offs[*to] += part_off;
                    }
                    Operand::Constant(_) if bound.error > 0.0 => {
                        sum += (self.size(&part)? + part_off) * bound.error;
                    }
                    // All places where a sine or an entry of the load is read have the same error.
                    Operand::Sine(..) | Operand::Entry(..) if bound.error > 0.0 => {
                        match leaves.iter_mut().find(|known| known.0 == text) {
                            Some((_, total, off)) => {
                                *total = total.sum(&part, self.work)?;
                                *off += part_off;
                            }
                            None => leaves.push((text, part, part_off)),
                        }
                    }
                    _ => {}
                }
            }
        }
        for (leaf, slope, off) in &leaves {
            let error = self.operand_bound(leaf, exact, known).error;
            sum += (self.size(slope)? + off) * error;
        }
        let sum = sum * (1.0 + 1e-9);
        Ok(if sum.is_nan() { f64::INFINITY } else { sum })
    }

    fn size(&self, polynomial: &Polynomial) -> Result<f64, Fault> {
        self.work.spend(polynomial.terms.len(), 300)?;
        Ok(length(polynomial, self.ring).min(self.ring.size(polynomial)))
    }
}

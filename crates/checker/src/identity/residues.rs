//! The residues of a program's results, and their degree.

use super::exact::{Exact, Point};
use super::number::Number;
use super::state::State;
use crate::program::{Operand, Program};

/// Returns the residue of an operand that is not a step.
pub(crate) fn leaf(operand: &Operand<Exact>, point: &Point, state: &State) -> Option<Number> {
    match operand {
        Operand::Constant(constant) => Some(point.constant(constant)),
        Operand::Entry(argument, index) => state.arguments.get(*argument)?.get(*index).copied(),
        Operand::Sine(joint, is_sine) => Some(state.pairs.get(*joint)?[usize::from(!is_sine)]),
        Operand::Speed(joint) => state.speeds.get(*joint).copied(),
        Operand::Step(_) => None,
    }
}

fn apply(operation: char, a: Number, b: Number) -> Number {
    match operation {
        '+' => a + b,
        '-' => a - b,
        '*' | '×' => a * b,
        _ => a / b,
    }
}

impl Program<Exact> {
    /// Returns its results at a point.
    pub fn residues(&self, point: &Point, state: &State) -> Option<Vec<Number>> {
        let value = |operand: &Operand<Exact>| leaf(operand, point, state);
        self.run(value, apply, |number: Number| -number)
    }

    /// Returns its results at a point with another value in the place of a step's.
    pub(crate) fn residues_but(
        &self,
        step: usize,
        other: Number,
        point: &Point,
        state: &State,
    ) -> Option<Vec<Number>> {
        let mut count = 0;
        let apply = |operation: char, a: Number, b: Number| {
            count += 1;
            match count - 1 == step {
                true => other,
                false => apply(operation, a, b),
            }
        };
        let value = |operand: &Operand<Exact>| leaf(operand, point, state);
        self.run(value, apply, |number: Number| -number)
    }

    pub(crate) fn step_residues(&self, point: &Point, state: &State) -> Option<Vec<Number>> {
        self.values(|operand| leaf(operand, point, state), apply)
    }

    /// Returns at least the degrees of numerator and denominator of its results, in inputs, sines
    /// and constants; infinite beyond a double's range.
    ///
    /// A value is a polynomial in these and in 1/d of each divisor d, which is one in those before
    /// it: a list of degrees. Multiplied by each divisor as often as it occurs, the last first, it
    /// has none.
    pub fn degree(&self) -> f64 {
        if !self.steps.iter().any(|step| step.0 == '/') {
            let apply = |operation: char, a: f64, b: f64| match operation {
                '+' | '-' => a.max(b),
                _ => a + b,
            };
            let degrees = self.run(|_| Some(1.0), apply, |degree| degree);
            return degrees.unwrap_or_default().into_iter().fold(0.0, f64::max);
        }
        let mut divisors = Vec::<Vec<f64>>::new();
        let zip = |a: Vec<f64>, b: Vec<f64>, pick: fn(f64, f64) -> f64| {
            let at = |list: &[f64], k: usize| list.get(k).copied().unwrap_or(0.0);
            let both = (0..a.len().max(b.len())).map(|k| pick(at(&a, k), at(&b, k)));
            both.collect::<Vec<f64>>()
        };
        let leaf = |_: &Operand<Exact>| Some(vec![1.0]);
        let apply = |operation: char, a: Vec<f64>, b: Vec<f64>| match operation {
            '+' | '-' => zip(a, b, f64::max),
            '*' | '×' => zip(a, b, |a, b| a + b),
            _ => {
                divisors.push(b);
                let mut inverse = vec![0.0; divisors.len()];
                inverse.push(1.0);
                zip(a, inverse, |a, b| a + b)
            }
        };
        let results = self.run(leaf, apply, |degrees| degrees).unwrap_or_default();
        let largest = |mut degrees: Vec<f64>| {
            let mut under = 0.0;
            for (index, divisor) in divisors.iter().enumerate().rev() {
                let times = degrees.get(index + 1).copied().unwrap_or(0.0);
                // Beyond a double's range nothing times infinity is nothing, too.
                let product = |x: &f64| match *x == 0.0 || times == 0.0 {
                    true => 0.0,
                    false => x * times,
                };
                under += product(&divisor[0]);
                degrees = zip(degrees, divisor.iter().map(product).collect(), |a, b| a + b);
            }
            degrees[0].max(under)
        };
        results.into_iter().map(largest).fold(0.0, f64::max)
    }
}

//! Coefficients over a sub-box.

use super::{Forms, Scratch, Work};
use crate::bound::input_box::InputBox;
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::Input;

impl Forms {
    /// Evaluates over a sub-box.
    pub(crate) fn evaluate(&self, sub: &InputBox, scratch: &mut Scratch) {
        let Scratch { values, factors } = scratch;
        values.clear();
        values.resize(self.coefficients, Interval::ZERO);
        factors.clear();
        factors.extend(self.factors.iter().map(|rest| range(rest, sub)));
        for work in &self.work {
            match *work {
                Work::Add(out, x) => {
                    let x = values[x as usize];
                    accumulate(&mut values[out as usize], x);
                }
                Work::Sub(out, x) => {
                    let x = -values[x as usize];
                    accumulate(&mut values[out as usize], x);
                }
                Work::Mul(out, x, y, factor) => {
                    let mut product = if x == y {
                        values[x as usize].square()
                    } else {
                        values[x as usize] * values[y as usize]
                    };
                    if factor != 0 {
                        product = product * factors[factor as usize];
                    }
                    accumulate(&mut values[out as usize], product);
                }
                Work::Constant(out, value) => values[out as usize] = value,
                Work::Leaf(out, input) => {
                    values[out as usize] = match input {
                        // As a variable its coefficient is one.
                        Input::Entry(Argument::Velocity | Argument::Acceleration, _)
                            if self.rates =>
                        {
                            Interval::ONE
                        }
                        _ => sub.input(input),
                    }
                }
            }
        }
    }

    /// Returns the range of each output over the sub-box evaluated last.
    pub(crate) fn outputs(&self, sub: &InputBox, scratch: &Scratch) -> Vec<Interval> {
        self.outputs
            .iter()
            .map(|(negative, terms)| {
                let mut sum = Interval::ZERO;
                for &(rates, x) in terms {
                    let mut term = scratch.values[x as usize];
                    if rates[1] != 0 {
                        term = term * range(&rates, sub);
                    }
                    accumulate(&mut sum, term);
                }
                if *negative { -sum } else { sum }
            })
            .collect()
    }
}

/// Returns the range of a product of variables, sorted.
fn range(variables: &[u8], sub: &InputBox) -> Interval {
    let mut product = Interval::ONE;
    for power in variables.chunk_by(|a, b| a == b) {
        let x = sub.rate(power[0]);
        for _ in 0..power.len() / 2 {
            product = product * x.square();
        }
        if power.len() % 2 == 1 {
            product = product * x;
        }
    }
    product
}

/// Adds to a sum; one that starts from zero stays exact.
#[inline]
fn accumulate(sum: &mut Interval, term: Interval) {
    *sum = if *sum == Interval::ZERO {
        term
    } else {
        *sum + term
    };
}

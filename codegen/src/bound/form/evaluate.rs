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
        factors.extend(self.factors.iter().map(|rest| self.range(rest, sub)));
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
                Work::Leaf(out, input) => self.evaluate_leaf(out as usize, input, sub, values),
            }
        }
    }

    fn evaluate_leaf(&self, out: usize, input: Input, sub: &InputBox, values: &mut [Interval]) {
        match input {
            Input::Entry(Argument::Velocity | Argument::Acceleration, _) => {
                // As a variable its coefficient is one.
                values[out] = if self.rates {
                    Interval::ONE
                } else {
                    sub.input(input)
                };
            }
            _ => values[out] = sub.input(input),
        }
    }

    /// Returns the range of a product of variables.
    fn range(&self, variables: &[u8], sub: &InputBox) -> Interval {
        let mut product = Interval::ONE;
        let mut at = 0;
        while at < variables.len() {
            let variable = variables[at];
            let power = variables[at..]
                .iter()
                .take_while(|&&v| v == variable)
                .count();
            let x = self.variable(variable, sub);
            for _ in 0..power / 2 {
                product = product * x.square();
            }
            if power % 2 == 1 {
                product = product * x;
            }
            at += power;
        }
        product
    }

    fn variable(&self, variable: u8, sub: &InputBox) -> Interval {
        let (n, index) = (self.joints, usize::from(variable));
        match index {
            0 => Interval::ONE,
            _ if index <= n => sub.velocity[index - 1],
            _ => sub.acceleration[index - 1 - n],
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
                        term = term * self.range(&rates, sub);
                    }
                    accumulate(&mut sum, term);
                }
                if *negative { -sum } else { sum }
            })
            .collect()
    }
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

//! Bounds of rounding over a box: of each value an interval, and how far the float is from the
//! exact program's value at most, by one pass over the text. A second pass, from a result back,
//! multiplies each rounding by the largest derivative of the result: the smaller bound counts.

use std::collections::HashMap;

use crate::interval::Interval;
use crate::polynomial::SLACK;
use crate::program::{GRAVITY, LOAD, Operand, Program, argument};
use crate::read::{ReadFunction, Source};
use crate::sines::{self, Scalar};

pub type Ranges = Vec<Vec<[f64; 2]>>;

/// All numbers that an exact value may be, and how far the float is from it at most.
#[derive(Clone, Copy, Debug)]
pub struct Value {
    pub exact: Interval,
    pub error: f64,
    /// The part of the error that is the value's rounding alone.
    rounded: f64,
}

pub struct Bounds {
    pub steps: Vec<Value>,
    pub results: Vec<Value>,
}

impl Value {
    fn new(exact: Interval, error: f64) -> Value {
        Value {
            exact,
            error,
            rounded: 0.0,
        }
    }

    /// Returns all numbers that the exact value, the float and those between may be.
    fn hull(self) -> Interval {
        self.exact + Interval::around(0.0, self.error)
    }
}

pub struct Rounding<'f> {
    function: &'f ReadFunction,
    pub(crate) scalar: Scalar,
    polynomials: HashMap<(usize, bool), f64>,
    pub(crate) load: Vec<Value>,
}

impl<'f> Rounding<'f> {
    pub fn new(function: &'f ReadFunction, is_single: bool, ranges: &Ranges) -> Rounding<'f> {
        let scalar = Scalar::new(is_single);
        let mut polynomials = HashMap::new();
        // Angles of one range mostly have the same polynomials.
        let mut known: Vec<(&Program<f64>, Interval, usize, f64)> = Vec::new();
        for pair in &function.sines {
            let Source::Polynomial(program) = &pair.source else {
                continue;
            };
            let angle = entry(ranges, 0, pair.joint).unwrap_or(Interval::NOTHING_KNOWN);
            let both = [true, false].into_iter().zip(pair.needs);
            for (result, (is_sine, _)) in both.filter(|need| need.1).enumerate() {
                let place = 2 * result + usize::from(is_sine);
                let is_same = |entry: &&(&Program<f64>, Interval, usize, f64)| {
                    (entry.1, entry.2) == (angle, place) && entry.0 == program
                };
                let error = match known.iter().find(is_same) {
                    Some(known) => known.3,
                    None => sines::error(program, result, is_sine, angle, scalar),
                };
                known.push((program, angle, place, error));
                polynomials.insert((pair.joint, is_sine), error);
            }
        }
        Rounding {
            function,
            scalar,
            polynomials,
            load: Vec::new(),
        }
    }

    pub(crate) fn load_error<C>(&self, operand: &Operand<C>) -> f64 {
        match operand {
            Operand::Entry(place, index) if argument(LOAD) == Some(*place) => {
                self.load.get(*index).map_or(0.0, |entry| entry.error)
            }
            _ => 0.0,
        }
    }

    /// None where a library computes it.
    pub fn polynomial(&self, joint: usize, is_sine: bool) -> Option<f64> {
        self.polynomials.get(&(joint, is_sine)).copied()
    }

    /// If sizes of all values are known, one a step, the exact value is that of polynomials for
    /// sines, whose error is none of rounding.
    pub fn bounds(&self, ranges: &Ranges, sizes: Option<&[f64]>) -> Bounds {
        let steps = &self.function.program.steps;
        let is_exact = sizes.is_none();
        let pair =
            |joint: usize| [true, false].map(|is_sine| self.sine(joint, ranges, is_sine, is_exact));
        let mut inputs = Inputs {
            ranges,
            sines: (0..ranges[0].len()).map(pair).collect(),
            is_exact,
            values: Vec::with_capacity(steps.len()),
        };
        for (index, (operation, operands)) in steps.iter().enumerate() {
            let value = |operand: &Operand<f64>| self.operand(operand, &inputs);
            let [a, b] = operands.each_ref().map(value);
            let (mut exact, error) = match operation {
                '+' => (a.exact + b.exact, a.error + b.error),
                '-' => (a.exact + -b.exact, a.error + b.error),
                '/' => quotient(a, b),
                _ if operands[0] == operands[1] => (square(a.exact), inherited(a, b)),
                _ => (a.exact * b.exact, inherited(a, b)),
            };
            if ['+', '-'].contains(operation)
                && let Some(most) = self.turned(operands, &inputs)
            {
                exact = exact.within(most);
            }
            if let Some(most) = sizes.and_then(|sizes| sizes.get(index)) {
                exact = exact.within(*most);
            }
            let rounded = match operation {
                '×' => 0.0,
                _ => self.scalar.rounding(exact.magnitude() + error),
            };
            inputs.values.push(Value {
                exact,
                error: self.scalar.sum(exact.magnitude(), error, rounded),
                rounded,
            });
        }
        let outputs = self.function.program.outputs.iter();
        let result = |(negative, operand): &(bool, Operand<f64>)| {
            let mut value = self.operand(operand, &inputs);
            if *negative {
                value.exact = -value.exact;
            }
            if let Operand::Step(step) = operand
                && value.error.is_finite()
            {
                value.error = value.error.min(self.by_derivatives(*step, &inputs));
            }
            value
        };
        let results = outputs.map(result).collect();
        let steps = inputs.values;
        Bounds { steps, results }
    }

    /// Bounds the error of a step by the mean value theorem: each rounding times the largest
    /// derivative by it, whatever the others are.
    fn by_derivatives(&self, top: usize, inputs: &Inputs) -> f64 {
        let zero = Interval::point(0.0);
        let mut slopes = vec![zero; top + 1];
        slopes[top] = Interval::point(1.0);
        let mut leaves: Vec<(&Operand<f64>, Interval)> = Vec::new();
        let mut sum = 0.0;
        for step in (0..=top).rev() {
            let slope = slopes[step];
            if slope == zero {
                continue;
            }
            sum += slope.magnitude() * inputs.values[step].rounded;
            let (operation, operands) = &self.function.program.steps[step];
            let interval = |operand: &Operand<f64>| self.operand(operand, inputs).hull();
            let [a, b] = operands.each_ref().map(interval);
            let parts = match operation {
                '+' => [slope, slope],
                '-' => [slope, -slope],
                '/' => return f64::INFINITY,
                _ => [slope * b, slope * a],
            };
            for (operand, part) in operands.iter().zip(parts) {
                match operand {
                    Operand::Step(step) => slopes[*step] = slopes[*step] + part,
                    Operand::Constant(_) => {
                        sum += part.magnitude() * self.operand(operand, inputs).error;
                    }
                    // All places where a sine is read have the same error.
                    leaf => match leaves.iter_mut().find(|(other, _)| *other == leaf) {
                        Some((_, slope)) => *slope = *slope + part,
                        None => leaves.push((leaf, part)),
                    },
                }
            }
        }
        for (leaf, slope) in leaves {
            let error = self.operand(leaf, inputs).error;
            // Zero times an unknown number counts as zero.
            if error != 0.0 {
                sum += slope.magnitude() * error;
            }
        }
        let sum = sum * SLACK;
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    fn operand(&self, operand: &Operand<f64>, inputs: &Inputs) -> Value {
        let known = match operand {
            Operand::Step(step) => inputs.values.get(*step).copied(),
            Operand::Constant(literal) if *literal == 0.0 => {
                Some(Value::new(Interval::point(0.0), 0.0))
            }
            Operand::Constant(literal) => {
                let error = self.scalar.rounded(literal.abs(), 0.0);
                let exact = Interval::around(*literal, error);
                Some(Value::new(exact, error))
            }
            Operand::Entry(place, index) => {
                let error = self.load_error(operand);
                entry(inputs.ranges, *place, *index).map(|exact| Value::new(exact, error))
            }
            Operand::Sine(joint, is_sine) => {
                let pair = inputs.sines.get(*joint);
                pair.map(|pair| pair[usize::from(!is_sine)])
            }
            Operand::Speed(joint) => self.speed(*joint, inputs.ranges),
        };
        known.unwrap_or(Value::new(Interval::NOTHING_KNOWN, f64::INFINITY))
    }

    fn sine(&self, joint: usize, ranges: &Ranges, is_sine: bool, is_exact: bool) -> Value {
        let angle = entry(ranges, 0, joint).unwrap_or(Interval::NOTHING_KNOWN);
        let exact = angle.sine(is_sine);
        match self.polynomial(joint, is_sine) {
            // The library's is within an ulp of at most one.
            None => Value::new(exact, 2.0 * self.scalar.unit),
            Some(error) if is_exact => Value::new(exact, error),
            Some(error) => Value::new(exact + Interval::around(0.0, error), 0.0),
        }
    }

    /// Returns 1/√(q̇² + w²): four operations, and w² is rounded.
    fn speed(&self, joint: usize, ranges: &Ranges) -> Option<Value> {
        let mut speeds = self.function.speeds.iter();
        let square = speeds.find(|speed| speed.0 == joint)?.1;
        let rate = entry(ranges, 1, joint)?;
        let per = |rate: f64| 1.0 / (rate * rate + square).sqrt();
        let slack = 1.0 + 8.0 * self.scalar.unit;
        let exact = Interval::new(per(rate.magnitude()) / slack, per(rate.least()) * slack);
        let error = 5.0 * self.scalar.unit * exact.high;
        Some(Value::new(exact, error))
    }

    /// |c x ± s y| is at most √(x² + y²), c and s being of one angle. For two entries of gravity that is
    /// its length.
    fn turned(&self, operands: &[Operand<f64>; 2], inputs: &Inputs) -> Option<f64> {
        let steps = &self.function.program.steps;
        let product = |operand: &Operand<f64>| match operand {
            Operand::Step(step) => match &steps[*step] {
                ('*' | '×', [Operand::Sine(joint, is_sine), other])
                | ('*' | '×', [other, Operand::Sine(joint, is_sine)]) => {
                    let size = self.operand(other, inputs).exact.magnitude();
                    let entry = match other {
                        Operand::Entry(place, entry) if argument(GRAVITY) == Some(*place) => {
                            Some(*entry)
                        }
                        _ => None,
                    };
                    Some((*joint, *is_sine, size, entry))
                }
                _ => None,
            },
            _ => None,
        };
        let (joint, is_sine, x, one) = product(&operands[0])?;
        let (other, is_other, y, two) = product(&operands[1])?;
        // Results of polynomials are not points of the circle.
        let is_off = [true, false].map(|is_sine| self.polynomial(joint, is_sine).is_some());
        let is_pair = joint == other && is_sine != is_other;
        let is_circle = inputs.is_exact || is_off == [false; 2];
        let length = match one.is_some() && two.is_some() && one != two {
            true => x.max(y),
            false => x.hypot(y),
        };
        (is_pair && is_circle).then_some(length * (1.0 + 1e-12))
    }
}

struct Inputs<'g> {
    ranges: &'g Ranges,
    sines: Vec<[Value; 2]>,
    /// `false` if what polynomials return stands for the sine.
    is_exact: bool,
    values: Vec<Value>,
}

fn entry(ranges: &Ranges, place: usize, index: usize) -> Option<Interval> {
    let [low, high] = *ranges.get(place)?.get(index)?;
    Some(Interval::new(low, high))
}

fn inherited(a: Value, b: Value) -> f64 {
    // Zero times an unknown number counts as zero, as in products with zero.
    let part = |error: f64, size: f64| if error == 0.0 { 0.0 } else { error * size };
    let [x, y] = [a, b].map(|factor| factor.exact.magnitude());
    part(a.error, y) + part(b.error, x) + part(a.error, b.error)
}

/// Returns the squares: of an interval around zero the product begins below.
fn square(interval: Interval) -> Interval {
    let product = interval * interval;
    Interval::new(product.low.max(0.0), product.high)
}

/// Returns a quotient; nothing is known of one whose divisor may be zero.
fn quotient(a: Value, b: Value) -> (Interval, f64) {
    let least = b.exact.least() - b.error;
    if !(least > 0.0) {
        return (Interval::NOTHING_KNOWN, f64::INFINITY);
    }
    let inverse = Interval::outward(1.0 / b.exact.high, 1.0 / b.exact.low);
    let exact = a.exact * inverse;
    (exact, (a.error + b.error * exact.magnitude()) / least)
}

//! A function at a state: its values, and a bound of how far the float is from each (a running
//! error analysis after Wilkinson).
//!
//! Values are computed in doubles, whatever the scalar. The exact value is within `off` of the
//! double, and the float of the text within `error` of the exact value: what operands bring along,
//! and one rounding.

use std::array::from_fn;

use crate::interval::{SINE_ERROR, UNIT, sin_cos};
use crate::program::{Operand, argument};
use crate::read::ReadFunction;
use crate::rounding::Rounding;
use crate::sines::Scalar;

/// A double, how far the exact value is from it, and how far the float is from the exact value.
#[derive(Clone, Copy, Debug, Default)]
pub struct Near {
    pub value: f64,
    pub off: f64,
    pub error: f64,
}

/// The states that are run at once, in vectors: a third of the time.
pub const LANES: usize = 4;

#[derive(Clone, Copy, Debug)]
pub struct Lanes {
    value: [f64; LANES],
    off: [f64; LANES],
    error: [f64; LANES],
}

impl Lanes {
    pub fn new(lanes: [Near; LANES]) -> Lanes {
        Lanes {
            value: lanes.map(|near| near.value),
            off: lanes.map(|near| near.off),
            error: lanes.map(|near| near.error),
        }
    }

    pub fn at(&self, lane: usize) -> Near {
        Near {
            value: self.value[lane],
            off: self.off[lane],
            error: self.error[lane],
        }
    }
}

/// The entries of each argument.
pub type FloatState = Vec<Vec<f64>>;

pub struct Sampler<'f> {
    leaves: Vec<Operand<f64>>,
    /// Each step's operation and the places of its operands: leaves first, then steps.
    code: Vec<(char, [usize; 2])>,
    /// For each result: true if it is negated, and its place.
    outputs: Vec<(bool, usize)>,
    speeds: &'f [(usize, f64)],
    /// The errors of sines and cosines by polynomials.
    polynomials: Vec<[Option<f64>; 2]>,
    pub scalar: Scalar,
}

impl<'f> Sampler<'f> {
    pub fn new(function: &'f ReadFunction, rounding: &Rounding, joints: usize) -> Sampler<'f> {
        let program = &function.program;
        let mut leaves: Vec<Operand<f64>> = Vec::new();
        let mut known = std::collections::HashMap::new();
        // Steps are behind all leaves, whose number is not known yet.
        let mut place = |operand: &Operand<f64>| match operand {
            Operand::Step(step) => Err(*step),
            leaf => {
                let key = match leaf {
                    Operand::Constant(literal) => (0, 0, literal.to_bits()),
                    Operand::Entry(place, index) => (1, *place, *index as u64),
                    Operand::Sine(joint, is_sine) => (2, *joint, u64::from(*is_sine)),
                    Operand::Speed(joint) => (3, *joint, 0),
                    Operand::Step(_) => (4, 0, 0),
                };
                Ok(*known.entry(key).or_insert_with(|| {
                    leaves.push(leaf.clone());
                    leaves.len() - 1
                }))
            }
        };
        let steps = program.steps.iter();
        let code: Vec<_> = steps
            .map(|(operation, both)| (*operation, both.each_ref().map(&mut place)))
            .collect();
        let output = |(negative, operand): &(bool, Operand<f64>)| (*negative, place(operand));
        let outputs: Vec<_> = program.outputs.iter().map(output).collect();
        let first = leaves.len();
        let index = |slot: Result<usize, usize>| slot.unwrap_or_else(|step| first + step);
        let pair = |joint| [true, false].map(|is_sine| rounding.polynomial(joint, is_sine));
        let step = |(operation, both): (char, [_; 2])| (operation, both.map(index));
        let result = |(negative, slot)| (negative, index(slot));
        Sampler {
            code: code.into_iter().map(step).collect(),
            leaves,
            outputs: outputs.into_iter().map(result).collect(),
            speeds: &function.speeds,
            polynomials: (0..joints).map(pair).collect(),
            scalar: rounding.scalar,
        }
    }

    /// The nanoseconds that a state takes at most.
    pub fn work(&self) -> u64 {
        30 * self.leaves.len() as u64 + 8 * self.code.len() as u64 + 100
    }

    pub fn run(&self, states: [&FloatState; LANES], load: &[Lanes]) -> Vec<Lanes> {
        let leaf = |operand| Lanes::new(from_fn(|k| self.leaf(operand, states[k], load, k)));
        let mut values = Vec::with_capacity(self.leaves.len() + self.code.len());
        values.extend(self.leaves.iter().map(leaf));
        for (operation, [a, b]) in &self.code {
            let (a, b) = (values[*a], values[*b]);
            values.push(match operation {
                '+' => self.rounded(a, b, |a, b| sum(a, b, 1.0)),
                '-' => self.rounded(a, b, |a, b| sum(a, b, -1.0)),
                '/' => self.rounded(a, b, quotient),
                _ => self.rounded(a, b, product),
            });
        }
        values
    }

    /// Combines operands by value, off and inherited error, and rounds.
    fn rounded(&self, a: Lanes, b: Lanes, combine: impl Fn(Near, Near) -> [f64; 3]) -> Lanes {
        let (unit, least, most) = (self.scalar.unit, self.scalar.least, self.scalar.most);
        let mut lanes = a;
        for k in 0..LANES {
            let [value, off, inherited] = combine(a.at(k), b.at(k));
            // The slack is what these sums lose in doubles.
            let off = (off + UNIT * value.abs()) * (1.0 + 1e-14) + least;
            let size = value.abs() + off + inherited;
            let error = (inherited + unit * size + least) * (1.0 + 1e-14);
            let is_known = size + error < most;
            lanes.value[k] = value;
            lanes.off[k] = off;
            lanes.error[k] = if is_known { error } else { f64::INFINITY };
        }
        lanes
    }

    pub fn results<'v>(&'v self, values: &'v [Lanes]) -> impl Iterator<Item = Lanes> + 'v {
        self.outputs.iter().map(|&(is_negative, place)| {
            let lanes = values[place];
            let value = lanes.value.map(|x| if is_negative { -x } else { x });
            Lanes { value, ..lanes }
        })
    }

    pub fn magnitudes<'v>(&self, values: &'v [Lanes]) -> impl Iterator<Item = f64> + 'v {
        let steps = values[self.leaves.len()..].iter();
        steps.map(|step| step.value.iter().fold(0.0, |most, x| x.abs().max(most)))
    }

    fn leaf(
        &self,
        operand: &Operand<f64>,
        state: &FloatState,
        load: &[Lanes],
        lane: usize,
    ) -> Near {
        let unit = self.scalar.unit;
        let entry = |place: usize, index: usize| state.get(place)?.get(index).copied();
        let near = |value, off, error| Near { value, off, error };
        let exactly = |value| near(value, 0.0, 0.0);
        let estimate = match operand {
            Operand::Constant(literal) if *literal == 0.0 => Some(Near::default()),
            Operand::Constant(literal) => {
                let error = self.scalar.rounded(literal.abs(), 0.0);
                Some(near(*literal, error, error))
            }
            Operand::Entry(place, index) if argument("load") == Some(*place) => {
                load.get(*index).map(|entry| entry.at(lane))
            }
            Operand::Entry(place, index) => entry(*place, *index).map(exactly),
            Operand::Sine(joint, is_sine) => entry(0, *joint).map(|angle| {
                let (sin, cos) = sin_cos(angle);
                let errors = self.polynomials.get(*joint);
                let polynomial = errors.and_then(|errors| errors[usize::from(!is_sine)]);
                // The library's is within an ulp of at most one.
                let error = polynomial.unwrap_or(2.0 * unit);
                near(if *is_sine { sin } else { cos }, SINE_ERROR, error)
            }),
            Operand::Speed(joint) => {
                let square = self.speeds.iter().find(|speed| speed.0 == *joint);
                let both = square.zip(entry(1, *joint));
                // Four operations, and w² is rounded.
                both.map(|((_, square), rate)| {
                    let value = 1.0 / (rate * rate + square).sqrt();
                    let error = 6.0 * unit * value;
                    near(value, error, error)
                })
            }
            Operand::Step(_) => None,
        };
        estimate.unwrap_or(near(f64::NAN, f64::INFINITY, f64::INFINITY))
    }
}

fn sum(a: Near, b: Near, sign: f64) -> [f64; 3] {
    [a.value + sign * b.value, a.off + b.off, a.error + b.error]
}

fn product(a: Near, b: Near) -> [f64; 3] {
    let [x, y] = [a, b].map(|near| near.value.abs() + near.off);
    let off = a.off * y + b.off * a.value.abs();
    let error = a.error * (y + b.error) + b.error * x;
    [a.value * b.value, off, error]
}

fn quotient(a: Near, b: Near) -> [f64; 3] {
    let value = a.value / b.value;
    let divisor = b.value.abs() - b.off;
    let off = (a.off + b.off * value.abs()) / divisor;
    let error = (a.error + b.error * (value.abs() + off)) / (divisor - b.error);
    let is_apart = divisor > b.error;
    [value, off, if is_apart { error } else { f64::INFINITY }]
}

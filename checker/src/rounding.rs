//! Bounds of rounding: of each value an interval, and how far the float is from the exact
//! program's value at most, by one pass over the text. Over the whole box that is a bound; at a
//! point, the bound at that state.

use std::collections::HashMap;

use crate::identity::program::Operand;
use crate::interval::{FARTHEST, Interval, SINE_ERROR, sin_cos};
use crate::read::{Function, Source};
use crate::sines::{self, Scalar};

/// The ranges of the entries of every argument.
pub type Ranges = Vec<Vec<[f64; 2]>>;

/// All numbers that an exact value may be, and how far the float is from it at most.
#[derive(Clone, Copy, Debug)]
pub struct Value {
    /// The exact value.
    pub exact: Interval,
    /// The largest distance of the float from it.
    pub error: f64,
}

impl Value {
    fn size(self) -> f64 {
        self.exact.magnitude()
    }
}

/// A function in a scalar, whose bounds are asked for.
pub struct Rounding<'f> {
    function: &'f Function,
    scalar: Scalar,
    /// The largest errors of the polynomials for a joint's sine and cosine over the box.
    polynomials: HashMap<(usize, bool), f64>,
}

impl<'f> Rounding<'f> {
    /// Begins with a function, whose polynomials of sines are bounded over a box.
    pub fn new(function: &'f Function, is_single: bool, ranges: &Ranges) -> Rounding<'f> {
        let scalar = Scalar::new(is_single);
        let mut polynomials = HashMap::new();
        for own in &function.sines {
            let Source::Polynomial(program) = &own.source else {
                continue;
            };
            let range = ranges[0].get(own.joint).copied().unwrap_or([f64::NAN; 2]);
            let needed = [true, false].into_iter().zip(own.needs).filter(|own| own.1);
            for (result, (is_sine, _)) in needed.enumerate() {
                let range = Interval::new(range[0], range[1]);
                let error = sines::error(program, result, is_sine, range, scalar);
                polynomials.insert((own.joint, is_sine), error);
            }
        }
        Rounding {
            function,
            scalar,
            polynomials,
        }
    }

    /// Returns half an ulp of one.
    pub fn unit(&self) -> f64 {
        self.scalar.unit
    }

    /// Returns the largest error of the polynomial for the sine, or the cosine, of a joint's angle
    /// over the box; none where a library gives it.
    pub fn polynomial(&self, joint: usize, is_sine: bool) -> Option<f64> {
        self.polynomials.get(&(joint, is_sine)).copied()
    }

    /// Returns bounds of the results over ranges: a box, or a state.
    pub fn bounds(&self, ranges: &Ranges) -> Vec<Value> {
        self.bounds_within(ranges, None)
    }

    /// Returns bounds of the results over a box where sizes of all values are known, one a step. The
    /// exact value is then that of polynomials for sines, whose error is none of rounding.
    pub fn bounds_within(&self, ranges: &Ranges, sizes: Option<&[f64]>) -> Vec<Value> {
        let steps = &self.function.program.steps;
        let mut values: Vec<Value> = Vec::with_capacity(steps.len());
        let given = &Given::new(self, ranges, sizes.is_none());
        for (index, (operation, operands)) in steps.iter().enumerate() {
            let [a, b] = operands
                .each_ref()
                .map(|own| self.operand(own, &values, given));
            let (mut exact, error) = match operation {
                '+' => (a.exact + b.exact, a.error + b.error),
                '-' => (a.exact + -b.exact, a.error + b.error),
                '/' => quotient(a, b),
                _ if operands[0] == operands[1] => (square(a.exact), inherited(a, b)),
                _ => (a.exact * b.exact, inherited(a, b)),
            };
            if ['+', '-'].contains(operation)
                && let Some(most) = self.turned(index, &values, given)
            {
                exact = exact.within(most);
            }
            if let Some(most) = sizes.and_then(|sizes| sizes.get(index)) {
                exact = exact.within(*most);
            }
            let is_rounded = *operation != '×';
            let error = match is_rounded {
                true => self.scalar.rounded(exact.magnitude(), error),
                false => error,
            };
            values.push(Value { exact, error });
        }
        let outputs = self.function.program.outputs.iter();
        let result = |(negative, own): &(bool, Operand<f64>)| {
            let own = self.operand(own, &values, given);
            let exact = if *negative { -own.exact } else { own.exact };
            Value { exact, ..own }
        };
        outputs.map(result).collect()
    }

    fn operand(&self, own: &Operand<f64>, values: &[Value], given: &Given) -> Value {
        let nothing = Value {
            exact: Interval::NOTHING_KNOWN,
            error: f64::INFINITY,
        };
        let known = match own {
            Operand::Step(step) => values.get(*step).copied(),
            Operand::Constant(literal) if *literal == 0.0 => Some(Value {
                exact: Interval::point(0.0),
                error: 0.0,
            }),
            Operand::Constant(literal) => {
                let error = self.scalar.rounded(literal.abs(), 0.0);
                let exact = Interval::around(*literal, error);
                Some(Value { exact, error })
            }
            Operand::Entry(place, index) => {
                let own = entry(given.ranges, *place, *index);
                own.map(|exact| Value { exact, error: 0.0 })
            }
            Operand::Sine(angle, is_sine) => {
                let own = angle.first().and_then(|own| given.sines.get(own.0));
                own.map(|own| own[usize::from(!is_sine)])
            }
            Operand::Speed(joint) => self.speed(*joint, given.ranges),
        };
        known.unwrap_or(nothing)
    }

    /// Returns the sine, or the cosine, of a joint's angle, or else what polynomials return for it.
    fn sine(&self, joint: usize, range: [f64; 2], is_sine: bool, is_exact: bool) -> Value {
        let exact = sine(Interval::new(range[0], range[1]), is_sine);
        match self.polynomial(joint, is_sine) {
            // The library's is within an ulp of at most one.
            None => Value {
                exact,
                error: 2.0 * self.scalar.unit,
            },
            Some(error) if is_exact => Value { exact, error },
            Some(error) => Value {
                exact: exact + Interval::around(0.0, error),
                error: 0.0,
            },
        }
    }

    /// Returns 1/√(q̇² + w²): four operations, and w² is rounded.
    fn speed(&self, joint: usize, ranges: &Ranges) -> Option<Value> {
        let mut speeds = self.function.speeds.iter();
        let square = speeds.find(|own| own.0 == joint)?.1;
        let rate = entry(ranges, 1, joint)?;
        let most = rate.magnitude();
        let least = match rate.low <= 0.0 && rate.high >= 0.0 {
            true => 0.0,
            false => rate.low.abs().min(rate.high.abs()),
        };
        let per = |rate: f64| 1.0 / (rate * rate + square).sqrt();
        let slack = 1.0 + 8.0 * self.scalar.unit;
        let exact = Interval::new(per(most) / slack, per(least) * slack);
        let error = 5.0 * self.scalar.unit * exact.high;
        Some(Value { exact, error })
    }

    /// Returns the largest sum of two products of one angle's cosine and sine: |c x ± s y| is at
    /// most √(x² + y²).
    fn turned(&self, index: usize, values: &[Value], given: &Given) -> Option<f64> {
        let steps = &self.function.program.steps;
        let mut found = Vec::new();
        for own in &steps[index].1 {
            let Operand::Step(step) = own else {
                return None;
            };
            let ('*' | '×', factors) = &steps[*step] else {
                return None;
            };
            let is_sine = |own: &Operand<f64>| matches!(own, Operand::Sine(..));
            let place = factors.iter().position(is_sine)?;
            let other = self.operand(&factors[1 - place], values, given);
            found.push((&factors[place], other.size()));
        }
        let [
            (Operand::Sine(one, is_sine), x),
            (Operand::Sine(other, is_other), y),
        ] = found[..]
        else {
            return None;
        };
        // What polynomials return is no point of the circle.
        let joint = one.first().map_or(0, |own| own.0);
        let is_off = [true, false].map(|own| self.polynomial(joint, own).is_some());
        let is_pair = one == other && is_sine != is_other;
        let is_circle = given.is_exact || is_off == [false; 2];
        (is_pair && is_circle).then(|| x.hypot(y) * (1.0 + 1e-12))
    }
}

/// The sines and arguments that a function is given over ranges.
struct Given<'g> {
    ranges: &'g Ranges,
    /// Sine and cosine of each joint.
    sines: Vec<[Value; 2]>,
    /// `false` if what polynomials return stands for the sine.
    is_exact: bool,
}

impl<'g> Given<'g> {
    fn new(own: &Rounding, ranges: &'g Ranges, is_exact: bool) -> Given<'g> {
        let joints = ranges[0].iter().enumerate();
        let pair = |(joint, range): (usize, &[f64; 2])| {
            [true, false].map(|is_sine| own.sine(joint, *range, is_sine, is_exact))
        };
        let sines = joints.map(pair).collect();
        Given {
            ranges,
            sines,
            is_exact,
        }
    }
}

fn entry(ranges: &Ranges, place: usize, index: usize) -> Option<Interval> {
    let [low, high] = *ranges.get(place)?.get(index)?;
    Some(Interval::new(low, high))
}

/// Returns what a product is off by its factors.
fn inherited(a: Value, b: Value) -> f64 {
    // Nothing times what is not known is nothing: so it is in products of zero.
    let part = |error: f64, size: f64| if error == 0.0 { 0.0 } else { error * size };
    part(a.error, b.size()) + part(b.error, a.size()) + part(a.error, b.error)
}

fn square(own: Interval) -> Interval {
    let all = own * own;
    match own.low <= 0.0 && own.high >= 0.0 {
        true => Interval::new(0.0, all.high),
        false => Interval::new(all.low.max(0.0), all.high),
    }
}

/// Returns a quotient; nothing is known of one whose divisor may be zero.
fn quotient(a: Value, b: Value) -> (Interval, f64) {
    let nothing = (Interval::NOTHING_KNOWN, f64::INFINITY);
    let (low, high) = (b.exact.low, b.exact.high);
    let least = low.abs().min(high.abs()) - b.error;
    if !(least > 0.0) || low <= 0.0 && high >= 0.0 {
        return nothing;
    }
    let inverse = Interval::new((1.0 / high).next_down(), (1.0 / low).next_up());
    let exact = a.exact * inverse;
    (exact, (a.error + b.error * exact.magnitude()) / least)
}

/// Returns the values of a sine, or a cosine, over a range: of a point its own.
fn sine(angle: Interval, is_sine: bool) -> Interval {
    if angle.low == angle.high && angle.magnitude() < FARTHEST {
        let (sin, cos) = sin_cos(angle.low);
        return Interval::around(if is_sine { sin } else { cos }, SINE_ERROR);
    }
    Interval::new(-1.0, 1.0)
}

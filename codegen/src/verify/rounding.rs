//! What rounding costs a program: an estimate that no single digit decides.
//!
//! Every rounded operation and every rounded constant is an independent error
//! of at most u of its value; its effect on an output is the derivative of the
//! output by that value, found by one backward pass. The root of the sum of
//! squares is what the sum of such errors is of the size of. It depends
//! smoothly on the robot, whereas errors that are observed at some states
//! depend on how the last digits of its parameters happen to fall.

use std::collections::BTreeMap;

use dalembert_model::number::{Exact, Rounded};
use dalembert_model::robot::Robot;
use num_traits::Signed;

use crate::program::{Input, Operand, Operation, Program};
use crate::states::{self, JointState};

/// How many states are looked at.
const STATES: usize = 64;

/// A seed of its own.
const SEED: u64 = 0xacc;

/// The largest estimated errors over the states, in units of u, one a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounding {
    /// max_i error_i / max_i |result_i|.
    pub normwise: Vec<f64>,
    /// error_i / the largest |result_i| over the states, the worst i.
    pub per_output: Vec<f64>,
}

impl Rounding {
    /// Of a program inside the robot's limits.
    pub fn estimate(robot: &Robot, program: &Program) -> Rounding {
        let network = Network::new(program);
        let runs: Vec<Vec<(f64, f64)>> = states::seeded(robot, STATES, SEED)
            .iter()
            .map(|state| network.errors(state))
            .collect();
        let mut rounding = Rounding {
            normwise: Vec::new(),
            per_output: Vec::new(),
        };
        let ratio = |error: f64, size: f64| if size > 0.0 { error / size } else { 0.0 };
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let mut start = 0;
        for quantity in program.function.quantities() {
            let range = start..start + quantity.len(program.rows.len());
            start = range.end;
            let normwise = largest(&mut runs.iter().map(|run| {
                let size = largest(&mut run[range.clone()].iter().map(|(value, _)| value.abs()));
                let error = largest(&mut run[range.clone()].iter().map(|(_, error)| *error));
                ratio(error, size)
            }));
            let per_output = largest(&mut range.clone().map(|i| {
                let size = largest(&mut runs.iter().map(|run| run[i].0.abs()));
                let error = largest(&mut runs.iter().map(|run| run[i].1));
                ratio(error, size)
            }));
            rounding.normwise.push(normwise);
            rounding.per_output.push(per_output);
        }
        rounding
    }

    /// The largest factor by which a quantity is worse than another program's,
    /// where an error of `floor` units is as good as none.
    pub fn factor(&self, than: &Rounding, floor: f64) -> f64 {
        let worst = |own: &[f64], other: &[f64]| {
            let pairs = own.iter().zip(other);
            pairs.fold(0.0, |worst: f64, (own, other)| {
                worst.max(own / other.max(floor))
            })
        };
        worst(&self.normwise, &than.normwise).max(worst(&self.per_output, &than.per_output))
    }

    /// The largest normwise error of a quantity.
    pub fn worst(&self) -> f64 {
        self.normwise.iter().copied().fold(0.0, f64::max)
    }
}

/// Where a value comes from.
#[derive(Clone, Copy, Debug)]
enum Source {
    Input(Input),
    Constant(usize),
    Step(usize),
}

/// A program whose constants are shared: one rounding each, wherever it is used.
struct Network<'a> {
    program: &'a Program,
    /// The rounded constants; whether each is a power of two, which costs no
    /// digit as it stands and none as a factor.
    constants: Vec<(f64, bool)>,
    steps: Vec<(Operation, Source, Source)>,
    outputs: Vec<Source>,
}

impl<'a> Network<'a> {
    fn new(program: &'a Program) -> Self {
        let mut known: BTreeMap<&'a Exact, usize> = BTreeMap::new();
        let mut constants = Vec::new();
        let mut source = |operand: &'a Operand| match operand {
            Operand::Input(input) => Source::Input(*input),
            Operand::Step(step) => Source::Step(*step),
            Operand::Constant(value) => {
                Source::Constant(*known.entry(value).or_insert_with(|| {
                    constants.push((f64::nearest(value), is_power_of_two(value)));
                    constants.len() - 1
                }))
            }
        };
        let steps = program.steps.iter();
        let steps = steps.map(|step| (step.operation, source(&step.left), source(&step.right)));
        let steps = steps.collect();
        let outputs = program.outputs.iter();
        let outputs = outputs.map(|output| source(&output.value)).collect();
        Network {
            program,
            constants,
            steps,
            outputs,
        }
    }

    /// Each output with its error, in units of u.
    fn errors(&self, state: &JointState) -> Vec<(f64, f64)> {
        // The sine and the cosine of each angle, in the order of `trig`.
        let pairs: Vec<(f64, f64)> = self
            .program
            .trig
            .iter()
            .map(|trig| {
                let signed = |(joint, negative): (usize, bool)| match negative {
                    true => -state.q[joint],
                    false => state.q[joint],
                };
                libm::sincos(trig.angle.terms().map(signed).sum())
            })
            .collect();
        let place = |angle| {
            let found = self
                .program
                .trig
                .iter()
                .position(|trig| trig.angle == angle);
            found.unwrap_or(usize::MAX)
        };
        let input = |input: Input| match input {
            Input::Entry(argument, joint) => state.entry(argument, joint),
            Input::Sin(angle) => pairs.get(place(angle)).map_or(0.0, |pair| pair.0),
            Input::Cos(angle) => pairs.get(place(angle)).map_or(1.0, |pair| pair.1),
        };
        let mut values: Vec<f64> = Vec::with_capacity(self.steps.len());
        let read = |source: &Source, values: &[f64]| match *source {
            Source::Input(of) => input(of),
            Source::Constant(index) => self.constants[index].0,
            Source::Step(step) => values[step],
        };
        let mut operands = Vec::with_capacity(self.steps.len());
        for (operation, left, right) in &self.steps {
            let (x, y) = (read(left, &values), read(right, &values));
            operands.push((x, y));
            values.push(match operation {
                Operation::Add => x + y,
                Operation::Sub => x - y,
                Operation::Mul => x * y,
                Operation::Div => x / y,
            });
        }
        let mut slopes = Slopes {
            steps: vec![0.0; values.len()],
            constants: vec![0.0; self.constants.len()],
            pairs: vec![(0.0, 0.0); pairs.len()],
        };
        let add = |slopes: &mut Slopes, source: &Source, slope: f64| match *source {
            Source::Step(step) => slopes.steps[step] += slope,
            Source::Constant(index) => slopes.constants[index] += slope,
            Source::Input(Input::Sin(angle)) => slopes.sin(place(angle), slope),
            Source::Input(Input::Cos(angle)) => slopes.cos(place(angle), slope),
            Source::Input(_) => {}
        };
        let mut results = Vec::with_capacity(self.outputs.len());
        for output in &self.outputs {
            slopes.clear();
            add(&mut slopes, output, 1.0);
            let mut squares = 0.0;
            for (index, (operation, left, right)) in self.steps.iter().enumerate().rev() {
                let slope = slopes.steps[index];
                if slope == 0.0 {
                    continue;
                }
                let (x, y) = operands[index];
                let (to_left, to_right) = match operation {
                    Operation::Add => (slope, slope),
                    Operation::Sub => (slope, -slope),
                    Operation::Mul => (slope * y, slope * x),
                    Operation::Div => (slope / y, -slope * values[index] / y),
                };
                add(&mut slopes, left, to_left);
                add(&mut slopes, right, to_right);
                let is_exact = *operation == Operation::Mul
                    && [left, right].into_iter().any(|source| match *source {
                        Source::Constant(index) => self.constants[index].1,
                        _ => false,
                    });
                if !is_exact {
                    squares += square(slope * values[index]);
                }
            }
            for ((value, is_exact), slope) in self.constants.iter().zip(&slopes.constants) {
                if !is_exact {
                    squares += square(slope * value);
                }
            }
            for ((sin, cos), slope) in pairs.iter().zip(&slopes.pairs) {
                squares += square(slope.0 * sin) + square(slope.1 * cos);
            }
            results.push((read(output, &values), squares.sqrt()));
        }
        results
    }
}

/// The derivatives of one output.
struct Slopes {
    steps: Vec<f64>,
    constants: Vec<f64>,
    /// By each sine and cosine.
    pairs: Vec<(f64, f64)>,
}

impl Slopes {
    fn clear(&mut self) {
        self.steps.fill(0.0);
        self.constants.fill(0.0);
        self.pairs.fill((0.0, 0.0));
    }

    fn sin(&mut self, place: usize, slope: f64) {
        if let Some(pair) = self.pairs.get_mut(place) {
            pair.0 += slope;
        }
    }

    fn cos(&mut self, place: usize, slope: f64) {
        if let Some(pair) = self.pairs.get_mut(place) {
            pair.1 += slope;
        }
    }
}

fn square(x: f64) -> f64 {
    x * x
}

fn is_power_of_two(value: &Exact) -> bool {
    let Some(value) = value.as_rational() else {
        return false;
    };
    [value.numer(), value.denom()].into_iter().all(|part| {
        let part = part.abs();
        part.bits() > 0 && part.trailing_zeros() == Some(part.bits() - 1)
    })
}

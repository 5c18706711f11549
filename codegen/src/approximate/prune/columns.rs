//! A program and its edits run at many sampled states at once.
//!
//! Samples only rank candidates; what is admitted is certified.

use std::collections::BTreeMap;

use crate::edits::{Edit, EditSite};
use crate::program::{Input, Operand, Operation, Program};
use crate::states::JointState;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Exact, Rational, Rounded};

/// A node: an input or a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Value {
    /// ±node
    Node(u32, bool),
    /// A constant.
    Known(f64),
}

impl Value {
    /// Whether it is the same node, zero too, or another constant too.
    pub(super) fn is_like(&self, other: &Value) -> bool {
        match (self, other) {
            (Value::Known(a), Value::Known(b)) => (*a == 0.0) == (*b == 0.0),
            _ => self == other,
        }
    }
}

/// One operation on nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Op {
    pub operation: Operation,
    pub left: Value,
    pub right: Value,
}

/// A program with its inputs as the first nodes.
#[derive(Clone, Debug)]
pub(super) struct Nodes {
    pub inputs: Vec<Input>,
    pub ops: Vec<Op>,
    pub outputs: Vec<Value>,
    pub samples: usize,
    /// Values of the inputs, node after node.
    pub columns: Vec<f64>,
}

impl Nodes {
    pub(super) fn new(program: &Program, states: &[JointState]) -> Nodes {
        let mut inputs: BTreeMap<Input, u32> = BTreeMap::new();
        let operands = program.steps.iter().flat_map(|s| [&s.left, &s.right]);
        for operand in operands.chain(program.outputs.iter().map(|o| &o.value)) {
            if let Operand::Input(input) = operand {
                inputs.insert(*input, 0);
            }
        }
        for (index, place) in inputs.values_mut().enumerate() {
            *place = index as u32;
        }
        let count = inputs.len() as u32;
        let value = |operand: &Operand, negative: bool| match operand {
            Operand::Input(input) => Value::Node(inputs[input], negative),
            Operand::Step(index) => Value::Node(count + *index as u32, negative),
            Operand::Constant(c) => {
                let c = f64::nearest(c);
                Value::Known(if negative { -c } else { c })
            }
        };
        let ops = program.steps.iter().map(|step| Op {
            operation: step.operation,
            left: value(&step.left, false),
            right: value(&step.right, false),
        });
        let ops = ops.collect();
        let outputs = program.outputs.iter();
        let outputs = outputs.map(|o| value(&o.value, o.negative)).collect();
        let inputs: Vec<Input> = inputs.into_keys().collect();
        let mut nodes = Nodes {
            inputs,
            ops,
            outputs,
            samples: 0,
            columns: Vec::new(),
        };
        nodes.move_to(states);
        nodes
    }

    /// The same program at other states.
    pub(super) fn move_to(&mut self, states: &[JointState]) {
        let inputs = self.inputs.iter();
        let columns = inputs.flat_map(|&input| states.iter().map(move |state| at(input, state)));
        self.columns = columns.collect();
        self.samples = states.len();
    }

    /// The outputs, output after output.
    pub(super) fn values(&self, columns: &[f64]) -> Vec<f64> {
        let m = self.samples;
        let mut values = Vec::with_capacity(self.outputs.len() * m);
        for value in &self.outputs {
            match *value {
                Value::Known(c) => values.extend(std::iter::repeat_n(c, m)),
                Value::Node(node, negative) => {
                    let sign = if negative { -1.0 } else { 1.0 };
                    let column = &columns[node as usize * m..][..m];
                    values.extend(column.iter().map(|x| sign * x));
                }
            }
        }
        values
    }

    pub(super) fn len(&self) -> usize {
        self.inputs.len() + self.ops.len()
    }

    /// The columns of every node under edits (one slot a node).
    pub(super) fn run(&self, edits: &[Option<Value>]) -> Vec<f64> {
        let m = self.samples;
        let mut columns = vec![0.0; self.len() * m];
        for (node, &edit) in edits.iter().enumerate() {
            let (before, rest) = columns.split_at_mut(node * m);
            self.node(node, edit, before, &mut rest[..m]);
        }
        columns
    }

    /// One node's column from those before it.
    pub(super) fn node(&self, node: usize, edit: Option<Value>, before: &[f64], out: &mut [f64]) {
        let m = self.samples;
        match edit {
            Some(Value::Known(c)) => out.fill(c),
            Some(Value::Node(other, negative)) => {
                let from = &before[other as usize * m..][..m];
                let sign = if negative { -1.0 } else { 1.0 };
                for (out, x) in out.iter_mut().zip(from) {
                    *out = sign * x;
                }
            }
            None if node < self.inputs.len() => {
                out.copy_from_slice(&self.columns[node * m..][..m]);
            }
            None => {
                let op = self.ops[node - self.inputs.len()];
                operate(op, before, m, out);
            }
        }
    }

    /// Constants that were changed, as short decimals.
    pub(super) fn shorten(&mut self, original: &Nodes) {
        for (op, original) in self.ops.iter_mut().zip(&original.ops) {
            for (now, was) in [
                (&mut op.left, original.left),
                (&mut op.right, original.right),
            ] {
                if let (Value::Known(c), Value::Known(was)) = (now, was) {
                    *c = if (*c - was).abs() <= 1e-9 * was.abs() {
                        was
                    } else {
                        short(*c)
                    };
                }
            }
        }
    }

    /// The edits as the program knows them; constants are those that differ
    /// from the original.
    pub(super) fn edits(&self, original: &Nodes, edits: &[Option<Value>]) -> Vec<Edit> {
        let inputs = self.inputs.len();
        let pairs = edits.iter().enumerate();
        let mut all: Vec<Edit> = pairs
            .filter_map(|(node, edit)| {
                let place = if node < inputs {
                    EditSite::Input(self.inputs[node])
                } else {
                    EditSite::Step(node - inputs)
                };
                Some(match (*edit)? {
                    Value::Known(c) => Edit::constant(place, decimal(c)),
                    Value::Node(other, negative) => Edit {
                        place,
                        negative,
                        value: match (other as usize).checked_sub(inputs) {
                            Some(step) => Operand::Step(step),
                            None => Operand::Input(self.inputs[other as usize]),
                        },
                    },
                })
            })
            .collect();
        for (step, (op, was)) in self.ops.iter().zip(&original.ops).enumerate() {
            if edits[inputs + step].is_some() {
                continue;
            }
            for (place, now, was) in [
                (EditSite::Left(step), op.left, was.left),
                (EditSite::Right(step), op.right, was.right),
            ] {
                if let Value::Known(c) = now
                    && now != was
                {
                    all.push(Edit::constant(place, decimal(c)));
                }
            }
        }
        all
    }
}

/// The number with seven digits.
pub(super) fn short(x: f64) -> f64 {
    f64::nearest_rational(&digits(x))
}

fn digits(x: f64) -> Rational {
    parse_decimal(&format!("{x:.6e}")).unwrap_or_default()
}

/// The decimal with seven digits if it is the number, or the number.
fn decimal(x: f64) -> Exact {
    let short = digits(x);
    Exact::from(if f64::nearest_rational(&short) == x {
        short
    } else {
        Rational::from_float(x).unwrap_or_default()
    })
}

fn operate(op: Op, before: &[f64], m: usize, out: &mut [f64]) {
    let column = |node: u32| &before[node as usize * m..][..m];
    let f = |x: f64, y: f64| match op.operation {
        Operation::Add => x + y,
        Operation::Sub => x - y,
        Operation::Mul => x * y,
        Operation::Div => x / y,
    };
    match (op.left, op.right) {
        (Value::Node(a, _), Value::Node(b, _)) => {
            let (a, b) = (column(a), column(b));
            match op.operation {
                Operation::Add => zip(out, a, b, |x, y| x + y),
                Operation::Sub => zip(out, a, b, |x, y| x - y),
                Operation::Mul => zip(out, a, b, |x, y| x * y),
                Operation::Div => zip(out, a, b, |x, y| x / y),
            }
        }
        (Value::Node(a, _), Value::Known(c)) => {
            for (out, &x) in out.iter_mut().zip(column(a)) {
                *out = f(x, c);
            }
        }
        (Value::Known(c), Value::Node(b, _)) => {
            for (out, &y) in out.iter_mut().zip(column(b)) {
                *out = f(c, y);
            }
        }
        (Value::Known(c), Value::Known(d)) => out.fill(f(c, d)),
    }
}

#[inline]
fn zip(out: &mut [f64], a: &[f64], b: &[f64], f: impl Fn(f64, f64) -> f64) {
    for ((out, &x), &y) in out.iter_mut().zip(a).zip(b) {
        *out = f(x, y);
    }
}

fn at(input: Input, state: &JointState) -> f64 {
    let angle = |angle: crate::program::AngleSum| {
        angle.terms().fold(0.0, |sum, (joint, negative)| {
            if negative {
                sum - state.q[joint]
            } else {
                sum + state.q[joint]
            }
        })
    };
    match input {
        Input::Sin(sum) => libm::sin(angle(sum)),
        Input::Cos(sum) => libm::cos(angle(sum)),
        // What reads it has no bounds and is not pruned.
        Input::PerSpeed(_) => f64::NAN,
        Input::Entry(argument, joint) => state.entry(argument, joint),
    }
}

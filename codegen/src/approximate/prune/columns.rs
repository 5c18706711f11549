//! A program and its edits run at many sampled states at once.
//!
//! Samples only rank candidates; what is admitted is certified.
//!
//! Over the operations lie the edits: so a candidate is tried by running again what depends
//! on one node, and nothing else, and is taken back as quickly.

use std::collections::BTreeSet;

use super::side_by_side::Column;
use crate::edits::{Edit, EditSite};
use crate::function::Argument;
use crate::program::{Input, Operand, Operation, Program, Steps};
use crate::states::JointState;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Exact, Rational, Rounded};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Value {
    /// ±node
    Node(usize, bool),
    Known(f64),
}

impl Value {
    /// True for the same node, for two zeros, and for two other constants, equal or not.
    pub(super) fn is_like(&self, other: &Value) -> bool {
        match (self, other) {
            (Value::Known(a), Value::Known(b)) => (*a == 0.0) == (*b == 0.0),
            _ => self == other,
        }
    }

    pub(super) fn negated_if(self, negative: bool) -> Value {
        match self {
            Value::Known(c) => Value::Known(if negative { -c } else { c }),
            Value::Node(node, sign) => Value::Node(node, sign != negative),
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct NodeStep {
    pub operation: Operation,
    pub operands: [Value; 2],
}

/// The nodes are the inputs, by which steps name them, then the steps. Constants may change.
#[derive(Clone, Debug)]
pub(super) struct Nodes {
    pub inputs: Vec<Input>,
    pub steps: Vec<NodeStep>,
    pub outputs: Vec<Value>,
    pub samples: usize,
    pub columns: Vec<f64>,
}

impl Nodes {
    pub(super) fn new(program: &Program, states: &[JointState]) -> Nodes {
        let inputs: BTreeSet<Input> = program.dag.inputs().copied().collect();
        let inputs = Vec::from_iter(inputs);
        let place = |input: &Input| inputs.binary_search(input).unwrap_or_default();
        let Steps { steps, outputs } = Steps::new(&program.dag, f64::nearest, place);
        let value = |operand: &Operand<f64, usize>| match operand {
            Operand::Input(place) => Value::Node(*place, false),
            Operand::Step(step) => Value::Node(inputs.len() + step, false),
            Operand::Constant(c) => Value::Known(*c),
        };
        let steps = steps.iter().map(|step| NodeStep {
            operation: step.operation,
            operands: [&step.left, &step.right].map(value),
        });
        let outputs = outputs
            .iter()
            .map(|output| value(&output.value).negated_if(output.negative));
        let mut nodes = Nodes {
            steps: steps.collect(),
            outputs: outputs.collect(),
            inputs,
            samples: 0,
            columns: Vec::new(),
        };
        nodes.move_to(states);
        nodes
    }

    pub(super) fn move_to(&mut self, states: &[JointState]) {
        let inputs = self.inputs.iter();
        let columns = inputs.flat_map(|&input| states.iter().map(move |state| at(input, state)));
        self.columns = columns.collect();
        self.samples = states.len();
    }

    pub(super) fn turn_to(&mut self, position: &JointState) {
        for (column, &input) in self
            .columns
            .chunks_exact_mut(self.samples)
            .zip(&self.inputs)
        {
            if let Input::Sin(_) | Input::Cos(_) | Input::Entry(Argument::Position, _) = input {
                column.fill(at(input, position));
            }
        }
    }

    pub(super) fn values(&self, columns: &[f64]) -> Vec<f64> {
        let outputs = 0..self.outputs.len();
        outputs
            .flat_map(|output| self.output(output, columns))
            .collect()
    }

    pub(super) fn output(&self, output: usize, columns: &[f64]) -> Vec<f64> {
        let m = self.samples;
        match self.outputs[output] {
            Value::Known(c) => vec![c; m],
            Value::Node(node, negative) => {
                let sign = if negative { -1.0 } else { 1.0 };
                let column = &columns[node * m..][..m];
                column.iter().map(|x| sign * x).collect()
            }
        }
    }

    pub(super) fn len(&self) -> usize {
        self.inputs.len() + self.steps.len()
    }

    pub(super) fn run(&self, edits: &[Option<Value>]) -> Vec<f64> {
        let m = self.samples;
        let mut columns = vec![0.0; self.len() * m];
        for (node, &edit) in edits.iter().enumerate() {
            let (before, rest) = columns.split_at_mut(node * m);
            self.node(node, edit, before, &mut rest[..m]);
        }
        columns
    }

    pub(super) fn node(&self, node: usize, edit: Option<Value>, before: &[f64], out: &mut [f64]) {
        let m = self.samples;
        match edit {
            Some(Value::Known(c)) => out.fill(c),
            Some(Value::Node(other, negative)) => {
                let from = &before[other * m..][..m];
                let sign = if negative { -1.0 } else { 1.0 };
                for (out, x) in out.iter_mut().zip(from) {
                    *out = sign * x;
                }
            }
            None if node < self.inputs.len() => {
                out.copy_from_slice(&self.columns[node * m..][..m]);
            }
            None => {
                let step = &self.steps[node - self.inputs.len()];
                let read = step.operands.map(|operand| self.column(operand, before));
                step.operation.at_each(read, out);
            }
        }
    }

    pub(super) fn column<'c>(&self, operand: Value, before: &'c [f64]) -> Column<'c> {
        match operand {
            Value::Node(node, _) => Column::Each(&before[node * self.samples..][..self.samples]),
            Value::Known(c) => Column::All(c),
        }
    }

    /// The pass is of its own, since edits stand in the places of inputs as well as of steps, and
    /// since all samples go through an operation together.
    pub(super) fn adjoints(
        &self,
        edits: &[Option<Value>],
        columns: &[f64],
        output: Value,
        of: &mut Vec<f64>,
    ) {
        let (m, inputs) = (self.samples, self.inputs.len());
        of.clear();
        of.resize(self.len() * m, 0.0);
        let Value::Node(top, negative) = output else {
            return;
        };
        of[top * m..][..m].fill(if negative { -1.0 } else { 1.0 });
        for node in (0..=top).rev() {
            let (before, rest) = of.split_at_mut(node * m);
            let adjoint = &rest[..m];
            if adjoint.iter().all(|x| *x == 0.0) {
                continue;
            }
            match edits[node] {
                Some(Value::Known(_)) => {}
                Some(Value::Node(other, negative)) => {
                    let sign = if negative { -1.0 } else { 1.0 };
                    let out = &mut before[other * m..][..m];
                    for (out, adjoint) in out.iter_mut().zip(adjoint) {
                        *out += sign * adjoint;
                    }
                }
                None if node < inputs => {}
                None => {
                    let step = &self.steps[node - inputs];
                    let read = step.operands.map(|operand| self.column(operand, columns));
                    for (side, operand) in step.operands.into_iter().enumerate() {
                        if let Value::Node(to, _) = operand {
                            let sums = &mut before[to * m..][..m];
                            step.operation.add_parts(side, adjoint, read, sums);
                        }
                    }
                }
            }
        }
    }

    pub(super) fn shorten(&mut self, original: &Nodes) {
        for (step, original) in self.steps.iter_mut().zip(&original.steps) {
            for (now, was) in step.operands.iter_mut().zip(original.operands) {
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
                        value: match other.checked_sub(inputs) {
                            Some(step) => Operand::Step(step),
                            None => Operand::Input(self.inputs[other]),
                        },
                    },
                })
            })
            .collect();
        for (step, (new, was)) in self.steps.iter().zip(&original.steps).enumerate() {
            if edits[inputs + step].is_some() {
                continue;
            }
            let places = [EditSite::Left(step), EditSite::Right(step)];
            for (place, (now, was)) in places
                .into_iter()
                .zip(new.operands.into_iter().zip(was.operands))
            {
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

pub(super) fn short(x: f64) -> f64 {
    f64::nearest_rational(&digits(x))
}

fn digits(x: f64) -> Rational {
    parse_decimal(&format!("{x:.6e}")).unwrap_or_default()
}

fn decimal(x: f64) -> Exact {
    let short = digits(x);
    Exact::from(if f64::nearest_rational(&short) == x {
        short
    } else {
        Rational::from_float(x).unwrap_or_default()
    })
}

fn at(input: Input, state: &JointState) -> f64 {
    match input {
        Input::Sin(joint) => libm::sin(state.q[joint]),
        Input::Cos(joint) => libm::cos(state.q[joint]),
        // What reads it has no bounds and is not pruned.
        Input::PerSpeed(_) => f64::NAN,
        Input::Entry(argument, joint) => state.entry(argument, joint),
    }
}

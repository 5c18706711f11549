//! A program with values in other values' places, run at many samples.

use std::collections::BTreeSet;

use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Exact, Rational, Rounded};

use super::samples::Samples;
use super::work;
use crate::dag::{Builder, Edge, Folding};
use crate::program::{Input, Operand, Operation, Output, Program, Steps};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Arg {
    Node(usize),
    Constant(f64),
}

/// The value in a node's place: a constant, or a multiple of an earlier node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NodeValue {
    Constant(f64),
    Times(f64, usize),
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Op {
    pub(super) operation: Operation,
    pub(super) args: [Arg; 2],
}

/// The nodes of a program: its inputs, then its steps.
pub(super) struct Net {
    program: Program,
    steps: Steps,
    pub(super) inputs: Vec<Input>,
    pub(super) ops: Vec<Op>,
    /// The results, each with its sign.
    pub(super) outputs: Vec<(Arg, f64)>,
}

/// The changes of a program: values in nodes' places, and constants of steps.
#[derive(Clone)]
pub(super) struct Edits {
    pub(super) edits: Vec<Option<NodeValue>>,
    pub(super) ops: Vec<Op>,
}

/// A sine with its cosine weighs as much as this many operations.
const SINCOS: u32 = 8;

/// Returns the operations of a program, sines and cosines weighed.
pub(super) fn cost(program: &Program) -> usize {
    let counts = program.counts();
    counts.operations() + SINCOS as usize * counts.sincos
}

fn apply(operation: Operation, x: f64, y: f64) -> f64 {
    match operation {
        Operation::Add => x + y,
        Operation::Sub => x - y,
        Operation::Mul | Operation::Fused => x * y,
        Operation::Div => x / y,
    }
}

impl Net {
    pub(super) fn new(program: &Program) -> Net {
        let inputs: BTreeSet<Input> = program.dag.inputs().copied().collect();
        let inputs = Vec::from_iter(inputs);
        let steps = program.dag.steps();
        let arg = |operand: &Operand| match operand {
            Operand::Input(input) => Arg::Node(inputs.binary_search(input).unwrap_or_default()),
            Operand::Step(step) => Arg::Node(inputs.len() + step),
            Operand::Constant(constant) => Arg::Constant(f64::nearest(constant)),
        };
        let ops = steps.steps.iter().map(|step| Op {
            operation: step.operation,
            args: [arg(&step.left), arg(&step.right)],
        });
        let sign = |negative: bool| if negative { -1.0 } else { 1.0 };
        let output = |output: &Output| (arg(&output.value), sign(output.negative));
        Net {
            ops: ops.collect(),
            outputs: steps.outputs.iter().map(output).collect(),
            program: program.clone(),
            steps,
            inputs,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.inputs.len() + self.ops.len()
    }

    pub(super) fn unedited(&self) -> Edits {
        Edits {
            edits: vec![None; self.len()],
            ops: self.ops.clone(),
        }
    }

    /// Returns the inputs at all samples, node after node.
    pub(super) fn columns(&self, samples: &Samples) -> Vec<f64> {
        let inputs = self.inputs.iter();
        inputs.flat_map(|input| samples.column(*input)).collect()
    }

    /// Returns the results of the program as it is at all samples.
    pub(super) fn at(program: &Program, samples: &Samples) -> Vec<f64> {
        let net = Net::new(program);
        let m = samples.len();
        net.results(&net.run(&net.unedited(), &net.columns(samples), m), m)
    }

    /// Returns the values of all nodes at m samples, node after node.
    pub(super) fn run(&self, state: &Edits, inputs: &[f64], m: usize) -> Vec<f64> {
        work::count(self.len() * m / work::UNIT);
        let mut values = vec![0.0; self.len() * m];
        for node in 0..self.len() {
            let (before, rest) = values.split_at_mut(node * m);
            let out = &mut rest[..m];
            let column = |n: usize| &before[n * m..][..m];
            match state.edits[node] {
                Some(NodeValue::Constant(c)) => out.fill(c),
                Some(NodeValue::Times(c, other)) => {
                    let from = out.iter_mut().zip(column(other));
                    from.for_each(|(out, x)| *out = c * x);
                }
                None if node < self.inputs.len() => out.copy_from_slice(&inputs[node * m..][..m]),
                None => {
                    let Op { operation, args } = state.ops[node - self.inputs.len()];
                    let slots = out.iter_mut();
                    match args {
                        [Arg::Node(a), Arg::Node(b)] => slots
                            .zip(column(a).iter().zip(column(b)))
                            .for_each(|(out, (x, y))| *out = apply(operation, *x, *y)),
                        [Arg::Node(a), Arg::Constant(c)] => slots
                            .zip(column(a))
                            .for_each(|(out, x)| *out = apply(operation, *x, c)),
                        [Arg::Constant(c), Arg::Node(b)] => slots
                            .zip(column(b))
                            .for_each(|(out, y)| *out = apply(operation, c, *y)),
                        [Arg::Constant(c), Arg::Constant(d)] => out.fill(apply(operation, c, d)),
                    }
                }
            }
        }
        values
    }

    /// Returns the results, one after the other.
    pub(super) fn results(&self, values: &[f64], m: usize) -> Vec<f64> {
        let mut results = Vec::with_capacity(self.outputs.len() * m);
        for &(arg, sign) in &self.outputs {
            match arg {
                Arg::Node(node) => results.extend(values[node * m..][..m].iter().map(|x| sign * x)),
                Arg::Constant(c) => results.resize(results.len() + m, sign * c),
            }
        }
        results
    }

    /// Puts the derivatives of a result by every node into `adjoints`, node after node.
    pub(super) fn adjoints(
        &self,
        state: &Edits,
        values: &[f64],
        (output, m): (usize, usize),
        adjoints: &mut Vec<f64>,
    ) {
        adjoints.clear();
        adjoints.resize(self.len() * m, 0.0);
        let (Arg::Node(top), sign) = self.outputs[output] else {
            return;
        };
        work::count(top * m / work::UNIT);
        adjoints[top * m..][..m].fill(sign);
        for node in (0..=top).rev() {
            let (before, rest) = adjoints.split_at_mut(node * m);
            let adjoint = &rest[..m];
            if adjoint.iter().all(|x| *x == 0.0) {
                continue;
            }
            let add = |before: &mut [f64], to: usize, factor: f64| {
                let targets = before[to * m..][..m].iter_mut().zip(adjoint);
                targets.for_each(|(to, derivative)| *to += factor * derivative);
            };
            let op = match state.edits[node] {
                Some(NodeValue::Constant(_)) => continue,
                Some(NodeValue::Times(c, other)) => {
                    add(before, other, c);
                    continue;
                }
                None if node < self.inputs.len() => continue,
                None => state.ops[node - self.inputs.len()],
            };
            for side in 0..2 {
                let Arg::Node(to) = op.args[side] else {
                    continue;
                };
                match (op.operation, op.args[1 - side]) {
                    (Operation::Add, _) => add(before, to, 1.0),
                    (Operation::Sub, _) => add(before, to, if side == 0 { 1.0 } else { -1.0 }),
                    (_, Arg::Constant(c)) => add(before, to, c),
                    (_, Arg::Node(other)) => {
                        let factors = &values[other * m..][..m];
                        let triples = before[to * m..][..m].iter_mut().zip(adjoint).zip(factors);
                        triples.for_each(|((to, derivative), factor)| *to += derivative * factor);
                    }
                }
            }
        }
    }

    /// Counts the operations that stay, sines and cosines weighed; `live` gets which nodes are computed.
    pub(super) fn price(&self, state: &Edits, live: &mut Vec<bool>) -> u32 {
        let count = self.inputs.len();
        let mut folded: Vec<(Fold, Option<[Fold; 2]>)> = Vec::with_capacity(self.len());
        for node in 0..self.len() {
            let fold = Fold::Node(node, false);
            let scaled = |c: f64, x: Fold| match x {
                Fold::Constant(d) => (Fold::Constant(c * d), None),
                _ if c == 0.0 => (Fold::Constant(0.0), None),
                _ if c.abs() == 1.0 => (x.negated_if(c < 0.0), None),
                _ => (fold, Some([Fold::Constant(c), x])),
            };
            let value = match state.edits[node] {
                Some(NodeValue::Constant(c)) => (Fold::Constant(c), None),
                Some(NodeValue::Times(c, other)) => scaled(c, folded[other].0),
                None if node < count => (fold, None),
                None => {
                    let op = &state.ops[node - count];
                    let [x, y] = op.args.map(|arg| match arg {
                        Arg::Node(node) => folded[node].0,
                        Arg::Constant(c) => Fold::Constant(c),
                    });
                    let minus = op.operation == Operation::Sub;
                    match (op.operation, x, y) {
                        (Operation::Mul, Fold::Constant(c), x)
                        | (Operation::Mul, x, Fold::Constant(c)) => scaled(c, x),
                        (Operation::Mul, ..) => (fold, Some([x, y])),
                        (operation, Fold::Constant(a), Fold::Constant(b)) => {
                            (Fold::Constant(apply(operation, a, b)), None)
                        }
                        (_, Fold::Constant(0.0), y) => (y.negated_if(minus), None),
                        (_, x, Fold::Constant(0.0)) => (x, None),
                        (_, Fold::Node(a, s), Fold::Node(b, t)) if a == b && (s == t) == minus => {
                            (Fold::Constant(0.0), None)
                        }
                        _ => (fold, Some([x, y])),
                    }
                }
            };
            folded.push(value);
        }
        live.clear();
        live.resize(self.len(), false);
        for (arg, _) in &self.outputs {
            if let Arg::Node(node) = arg
                && let Fold::Node(node, _) = folded[*node].0
            {
                live[node] = true;
            }
        }
        let mut total = 0;
        for node in (count..self.len()).rev() {
            if live[node]
                && let Some(args) = folded[node].1
            {
                total += 1;
                for arg in args {
                    if let Fold::Node(node, _) = arg {
                        live[node] = true;
                    }
                }
            }
        }
        let read = self.inputs.iter().zip(&*live).filter(|pair| *pair.1);
        let angles: BTreeSet<usize> = read.filter_map(|(input, _)| input.angle()).collect();
        total + SINCOS * angles.len() as u32
    }

    /// Returns the edited program, folded.
    pub(super) fn rebuilt(&self, state: &Edits) -> Program {
        let mut builder = Builder::new(Folding::Semantic);
        let count = self.inputs.len();
        let mut edges: Vec<Edge> = Vec::with_capacity(self.len());
        for node in 0..self.len() {
            let edge = match state.edits[node] {
                Some(NodeValue::Constant(c)) => builder.constant(&decimal(c)),
                Some(NodeValue::Times(c, other)) => {
                    let factor = builder.constant(&decimal(c));
                    builder.mul(factor, edges[other])
                }
                None if node < count => builder.input(self.inputs[node]),
                None => {
                    let step = node - count;
                    let (old, new, was) =
                        (&self.steps.steps[step], &state.ops[step], &self.ops[step]);
                    let [left, right] = [(&old.left, 0), (&old.right, 1)].map(|(operand, side)| {
                        match (operand, new.args[side]) {
                            (_, Arg::Node(node)) => edges[node],
                            (_, Arg::Constant(c)) if new.args[side] != was.args[side] => {
                                builder.constant(&decimal(c))
                            }
                            (Operand::Constant(constant), _) => builder.constant(constant),
                            (_, Arg::Constant(c)) => builder.constant(&decimal(c)),
                        }
                    });
                    builder.apply(new.operation, left, right)
                }
            };
            edges.push(edge);
        }
        let pairs = self.steps.outputs.iter().zip(&self.outputs);
        let outputs = pairs
            .map(|(output, (arg, _))| {
                let edge = match (&output.value, arg) {
                    (Operand::Constant(constant), _) => builder.constant(constant),
                    (_, Arg::Node(node)) => edges[*node],
                    (_, Arg::Constant(c)) => builder.constant(&decimal(*c)),
                };
                edge.negated_if(output.negative)
            })
            .collect();
        self.program.with_graph(&builder.finish(outputs))
    }
}

#[derive(Clone, Copy)]
enum Fold {
    Constant(f64),
    Node(usize, bool),
}

impl Fold {
    fn negated_if(self, minus: bool) -> Fold {
        match self {
            Fold::Constant(c) => Fold::Constant(if minus { -c } else { c }),
            Fold::Node(node, sign) => Fold::Node(node, sign != minus),
        }
    }
}

/// Rounds to seven digits, as an edited constant is printed; the program then rounds it to its scalar.
pub(super) fn seven_digits(x: f64) -> f64 {
    f64::nearest_rational(&digits(x))
}

fn digits(x: f64) -> Rational {
    parse_decimal(&format!("{x:.6e}")).unwrap_or_default()
}

fn decimal(x: f64) -> Exact {
    let short = digits(x);
    Exact::from(match f64::nearest_rational(&short) == x {
        true => short,
        false => Rational::from_float(x).unwrap_or_default(),
    })
}

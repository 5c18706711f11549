//! The program of all adjoints of a program.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use crate::dag::symbol::Symbol;
use crate::dag::{Builder, Dag, Edge, Folding};
use crate::program::adjoint::{Leaf, backward};
use crate::program::{Input, Operand, Program};

/// A graph with the value of each step and, output by output, the derivatives
/// of the output with respect to them: all of them its outputs.
pub(super) struct Gradient {
    pub graph: Dag,
    /// Of each step, in the graph.
    pub values: Vec<Edge>,
    /// Of each output.
    pub adjoints: Vec<Adjoints>,
}

/// The derivatives of one output.
pub(super) struct Adjoints {
    /// With respect to each step that it depends on.
    pub steps: Vec<(usize, Edge)>,
    /// With respect to each sine and cosine.
    pub sines: Vec<(Input, Edge)>,
}

impl Gradient {
    pub(super) fn of(program: &Program) -> Gradient {
        let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
        let read = |operand: &Operand, values: &[Symbol]| match operand {
            Operand::Step(index) => values[*index].clone(),
            Operand::Constant(constant) => Symbol::from(constant.clone()),
            Operand::Input(input) => Symbol::input(&builder, *input),
        };
        let mut values: Vec<Symbol> = Vec::with_capacity(program.steps.len());
        for step in &program.steps {
            let (x, y) = (read(&step.left, &values), read(&step.right, &values));
            values.push(step.operation.apply(&x, &y));
        }
        let operands = |index: usize| {
            let step = &program.steps[index];
            [&step.left, &step.right].map(|operand| read(operand, &values))
        };
        let outputs = program.outputs.iter();
        let adjoints: Vec<_> = outputs
            .map(|output| adjoints(program, &output.value, operands))
            .collect();
        let edge = |value: &Symbol| value.edge(&mut builder.borrow_mut());
        let values: Vec<Edge> = values.iter().map(edge).collect();
        let adjoints = adjoints.iter().map(|(steps, sines)| Adjoints {
            steps: steps.iter().map(|(step, x)| (*step, edge(x))).collect(),
            sines: sines.iter().map(|(input, x)| (*input, edge(x))).collect(),
        });
        let adjoints: Vec<Adjoints> = adjoints.collect();
        let mut graph = builder
            .replace(Builder::new(Folding::Syntactic))
            .finish(Vec::new());
        graph.outputs.clone_from(&values);
        for Adjoints { steps, sines } in &adjoints {
            graph.outputs.extend(steps.iter().map(|(_, edge)| *edge));
            graph.outputs.extend(sines.iter().map(|(_, edge)| *edge));
        }
        Gradient {
            graph,
            values,
            adjoints,
        }
    }
}

type Parts<T> = Vec<(T, Symbol)>;

/// Returns the derivatives of an output with respect to steps, last to first, and to
/// sines and cosines.
fn adjoints(
    program: &Program,
    output: &Operand,
    operands: impl Fn(usize) -> [Symbol; 2],
) -> (Parts<usize>, Parts<Input>) {
    let (mut steps, mut sines) = (Vec::new(), Vec::new());
    let mut note = |input: Input, part: Symbol| {
        if input.angle().is_none() {
            return;
        }
        match sines.iter_mut().find(|(known, _)| *known == input) {
            None => sines.push((input, part)),
            Some((_, sum)) => *sum = sum.add(&part),
        }
    };
    match output {
        Operand::Step(top) => {
            let visit = |index: usize, adjoint: &Symbol| {
                let counts = !adjoint.is_zero();
                if counts {
                    steps.push((index, adjoint.clone()));
                }
                counts
            };
            let leaf = |leaf: Leaf<'_, Exact, Input>, part: Symbol| {
                if let Operand::Input(input) = leaf.operand {
                    note(*input, part);
                }
            };
            backward(&program.steps, *top, operands, visit, leaf);
        }
        Operand::Input(input) => note(*input, Symbol::one()),
        Operand::Constant(_) => {}
    }
    (steps, sines)
}

//! Straight-line code as a list of steps whose operands are inputs, constants or steps: for what
//! edits single uses of values, and as claims write it.

use std::hash::Hash;

use dalembert_model::number::Exact;

use super::{Input, Operation};
use crate::dag::{Dag, Edge, Id, Node, Writer};

/// The steps of a graph, operands before users, and its results.
#[derive(Clone, Debug, PartialEq)]
pub struct Steps<C = Exact, I = Input> {
    pub steps: Vec<Step<C, I>>,
    pub outputs: Vec<Output<C, I>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<C = Exact, I = Input> {
    pub operation: Operation,
    pub left: Operand<C, I>,
    pub right: Operand<C, I>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand<C = Exact, I = Input> {
    Input(I),
    Constant(C),
    Step(usize),
}

/// A result, negated or not: negation is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output<C = Exact, I = Input> {
    pub negative: bool,
    pub value: Operand<C, I>,
}

impl<C: Clone, I: Clone> Steps<C, I> {
    /// Lists the operations of a graph whose operands come before their users.
    pub fn new<D, J>(dag: &Dag<D, J>, constant: impl Fn(&D) -> C, input: impl Fn(&J) -> I) -> Self {
        let numbers = dag.numbers();
        let operand = |id: Id| match dag.node(id) {
            Node::Constant(leaf) => Operand::Constant(constant(leaf)),
            Node::Input(leaf) => Operand::Input(input(leaf)),
            // An operation has a number, from one.
            Node::Apply(..) => Operand::Step(numbers[id as usize].unwrap_or(1) - 1),
        };
        let steps = dag.operations().map(|(_, operation, [left, right])| Step {
            operation,
            left: operand(left),
            right: operand(right),
        });
        let outputs = dag.outputs.iter().map(|edge| Output {
            negative: edge.negative,
            value: operand(edge.node),
        });
        let (steps, outputs) = (steps.collect(), outputs.collect());
        Steps { steps, outputs }
    }

    /// Returns the graph of the steps, each leaf before the first of them that reads it.
    ///
    /// # Panics
    /// If a step or a result reads a step that is not before it.
    pub fn dag(&self) -> Dag<C, I>
    where
        C: Eq + Hash,
        I: Eq + Hash,
    {
        let mut writer = Writer::default();
        let mut places: Vec<Id> = Vec::with_capacity(self.steps.len());
        let place =
            |operand: &Operand<C, I>, places: &[Id], writer: &mut Writer<C, I>| match operand {
                Operand::Step(step) => places[*step],
                Operand::Constant(constant) => writer.leaf(Node::Constant(constant.clone())),
                Operand::Input(input) => writer.leaf(Node::Input(input.clone())),
            };
        for step in &self.steps {
            let operands =
                [&step.left, &step.right].map(|operand| place(operand, &places, &mut writer));
            places.push(writer.apply(step.operation, operands));
        }
        let mut outputs = Vec::with_capacity(self.outputs.len());
        for output in &self.outputs {
            let edge = Edge::from(place(&output.value, &places, &mut writer));
            outputs.push(edge.negated_if(output.negative));
        }
        writer.finish(outputs)
    }
}

impl Dag {
    pub fn steps(&self) -> Steps {
        Steps::new(self, Exact::clone, |input| *input)
    }
}

//! Straight-line code as a graph: from the traced formula to the program.
//!
//! - this file: [`Dag`], its nodes and edges
//! - [`builder`]: folds and shares as a graph grows
//! - [`print`]: fingerprints, values at random points of a prime field
//! - [`symbol`]: the scalar that traces the equations into a builder
//! - [`schedule`](Dag::scheduled): the order in which code is printed
//!
//! A [`Dag`] is a list of nodes, operands before users, and what it returns. Leaves are nodes as
//! operations are, so that a constant is one wherever it is read. Negation is free, so it is no
//! node: outputs and operands of a builder carry signs.

pub(crate) mod builder;
#[cfg(test)]
pub(crate) mod pattern;
pub(crate) mod print;
mod schedule;
pub(crate) mod symbol;
#[cfg(test)]
pub(crate) mod tests;

use std::collections::BTreeSet;

use dalembert_model::number::Exact;
use dalembert_model::scalar::{Divide, Scalar};

pub(crate) use builder::Builder;
pub use builder::Folding;
pub use print::{Fingerprint, Points};

use crate::program::{AngleSum, Counts, Input, Operation};

/// The index of a node.
pub(crate) type Id = u32;

/// A leaf, or an operation on earlier nodes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node<C = Exact, I = Input> {
    /// A constant. Of an exact one the sign is the edge's (see [`Exact::leads_negative`]).
    Constant(C),
    /// An input.
    Input(I),
    /// The result of an operation.
    Apply(Operation, [Id; 2]),
}

/// A node or its negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Edge {
    /// The index of the node.
    pub node: Id,
    /// `true` if its value is negated.
    pub negative: bool,
}

/// Nodes in topological order, and what they return.
#[derive(Clone, Debug, PartialEq)]
pub struct Dag<C = Exact, I = Input> {
    /// Operands before users.
    pub nodes: Vec<Node<C, I>>,
    /// The results, in the order of the function's layout.
    pub outputs: Vec<Edge>,
}

/// The values of constants and inputs in a scalar: at a state, at a point of a field, as symbols.
pub(crate) trait Leaves<C = Exact, I = Input> {
    /// The scalar.
    type Value: Divide;
    /// Returns the value of a constant; none if the scalar has none.
    fn constant(&self, constant: &C) -> Option<Self::Value>;
    /// Returns the value of an input; none if there is none.
    fn input(&self, input: &I) -> Option<Self::Value>;
}

impl<C, I> Node<C, I> {
    /// Returns the operands, if it is an operation.
    pub fn operands(&self) -> Option<[Id; 2]> {
        match self {
            Node::Apply(_, operands) => Some(*operands),
            Node::Constant(_) | Node::Input(_) => None,
        }
    }
}

impl Edge {
    /// Returns the edge to the same node, reversed if `negative`.
    #[must_use]
    pub fn negated_if(self, negative: bool) -> Edge {
        Edge {
            negative: self.negative != negative,
            ..self
        }
    }

    /// Returns the index of its node.
    pub fn index(self) -> usize {
        self.node as usize
    }
}

impl<C, I> Dag<C, I> {
    /// Returns a node.
    pub fn node(&self, id: Id) -> &Node<C, I> {
        &self.nodes[id as usize]
    }

    /// Evaluates every node; none if a leaf has no value.
    pub(crate) fn values<L: Leaves<C, I>>(&self, leaves: &L) -> Option<Vec<L::Value>> {
        let mut values: Vec<L::Value> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let value = match node {
                Node::Constant(constant) => leaves.constant(constant)?,
                Node::Input(input) => leaves.input(input)?,
                Node::Apply(operation, [a, b]) => {
                    operation.apply(&values[*a as usize], &values[*b as usize])
                }
            };
            values.push(value);
        }
        Some(values)
    }

    /// Computes the derivative of a node by itself and by each node before it, given the values of
    /// the nodes.
    pub(crate) fn adjoints<S: Divide>(&self, top: Id, values: &[S], adjoints: &mut Vec<S>) {
        adjoints.clear();
        adjoints.resize(top as usize, S::zero());
        adjoints.push(S::one());
        for index in (0..adjoints.len()).rev() {
            let Node::Apply(operation, operands) = &self.nodes[index] else {
                continue;
            };
            if adjoints[index].is_zero() {
                continue;
            }
            let [a, b] = operands.map(|id| &values[id as usize]);
            let parts = operation.parts(&adjoints[index], a, b);
            for (id, part) in operands.iter().zip(&parts) {
                adjoints[*id as usize] = adjoints[*id as usize].add(part);
            }
        }
    }

    /// Counts how often each node is read, by outputs too, where the outputs need it.
    pub fn reads(&self) -> Vec<u32> {
        let mut reads = vec![0; self.nodes.len()];
        for edge in &self.outputs {
            reads[edge.index()] += 1;
        }
        for index in (0..self.nodes.len()).rev() {
            if let (1.., Node::Apply(_, operands)) = (reads[index], &self.nodes[index]) {
                operands.iter().for_each(|id| reads[*id as usize] += 1);
            }
        }
        reads
    }

    /// Returns the nodes that the outputs need, with their indices.
    pub fn live(&self) -> impl Iterator<Item = (usize, &Node<C, I>)> {
        let nodes = self.nodes.iter().enumerate().zip(self.reads());
        nodes.filter_map(|(node, reads)| (reads > 0).then_some(node))
    }
}

impl Node {
    /// Returns the fingerprint of a leaf. A constant that has none, since the prime divides a
    /// denominator, counts as zero, as operations do: the proof refuses what comes of it.
    pub(crate) fn leaf_print(&self) -> Fingerprint {
        let print = match self {
            Node::Constant(constant) => Points::SEARCH.constant(constant),
            Node::Input(input) => Some(Points::SEARCH.input(*input)),
            Node::Apply(..) => None,
        };
        print.unwrap_or_else(Fingerprint::zero)
    }
}

impl Dag {
    /// Returns whether an output is identically zero.
    pub fn is_zero(&self, output: Edge) -> bool {
        matches!(self.node(output.node), Node::Constant(c) if c.is_zero())
    }

    /// Returns the angles whose sine or cosine the outputs need.
    pub fn angles(&self) -> BTreeSet<AngleSum> {
        let angle = |(_, node): (usize, &Node)| match node {
            Node::Input(input) => input.angle(),
            _ => None,
        };
        self.live().filter_map(angle).collect()
    }

    /// Counts the operations that the outputs need.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for (_, node) in self.live() {
            if let Node::Apply(operation, _) = node {
                match operation {
                    Operation::Add | Operation::Sub => counts.add += 1,
                    Operation::Mul | Operation::Fused => counts.mul += 1,
                    Operation::Div => counts.div += 1,
                }
            }
        }
        let angles = self.angles();
        counts.sincos = angles.len();
        counts.add += angles.iter().map(|angle| angle.additions()).sum::<usize>();
        counts
    }

    /// Returns the same outputs through another builder: folded, and merged by fingerprint if the
    /// builder does that. What no output needs is left behind.
    #[must_use]
    pub fn rebuild(&self, folding: Folding) -> Dag {
        let mut builder = Builder::new(folding);
        let edges = builder.copy(self);
        let outputs = self.outputs.iter();
        let outputs = outputs.map(|edge| edges[edge.index()].negated_if(edge.negative));
        let outputs = outputs.collect();
        builder.finish(outputs)
    }
}

//! Straight-line code as a graph: from the traced formula to the program.
//!
//! A [`Dag`] is a list of nodes, operands before users, and what it returns. Leaves are nodes as
//! operations are, so that a constant is one wherever it is read. Negation is free, so it is no
//! node: outputs and operands of a builder carry signs.
//!
//! Takes a formula over `Symbol`s; returns a [`Dag`]. `Builder` makes its nodes, [`Folding`] says
//! what it simplifies on the way.

pub(crate) mod builder;
pub(crate) mod fusion;
pub(crate) mod lanes;
mod operation;
#[cfg(test)]
pub(crate) mod pattern;
pub(crate) mod print;
mod schedule;
pub(crate) mod symbol;
#[cfg(test)]
pub(crate) mod tests;
mod vain;
pub(crate) mod writer;

use std::collections::BTreeSet;

use dalembert_model::number::Exact;
use dalembert_model::scalar::{Divide, Scalar};

pub(crate) use builder::Builder;
pub use builder::Folding;
pub(crate) use lanes::Lanes;
pub use operation::{Counts, Input, Operation};
pub(crate) use print::Fingerprint;
pub use print::Points;
pub(crate) use writer::Writer;

pub type Id = u32;

/// A leaf, or an operation on earlier nodes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node<C = Exact, I = Input> {
    /// A constant. The sign of an exact one is the edge's (see [`Exact::leads_negative`]).
    Constant(C),
    Input(I),
    Apply(Operation, [Id; 2]),
}

/// A node or its negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Edge {
    pub node: Id,
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

impl<C, I> Default for Dag<C, I> {
    fn default() -> Self {
        Dag {
            nodes: Vec::new(),
            outputs: Vec::new(),
        }
    }
}

/// The values of constants and inputs in a scalar: at a state, at a point of a field, as symbols.
/// An input that a state lacks is not a number.
pub trait Leaves<C = Exact, I = Input> {
    type Value: Divide;
    fn constant(&self, constant: &C) -> Self::Value;
    fn input(&self, input: I) -> Self::Value;
}

impl<C, I, S: Divide, F: Fn(&C) -> S, G: Fn(I) -> S> Leaves<C, I> for (F, G) {
    type Value = S;

    fn constant(&self, constant: &C) -> S {
        self.0(constant)
    }

    fn input(&self, input: I) -> S {
        self.1(input)
    }
}

impl<C, I> Node<C, I> {
    pub fn operands(&self) -> Option<[Id; 2]> {
        match self {
            Node::Apply(_, operands) => Some(*operands),
            Node::Constant(_) | Node::Input(_) => None,
        }
    }
}

impl From<Id> for Edge {
    fn from(node: Id) -> Edge {
        let negative = false;
        Edge { node, negative }
    }
}

impl Edge {
    #[must_use]
    pub fn negated_if(self, negative: bool) -> Edge {
        Edge {
            negative: self.negative != negative,
            ..self
        }
    }

    pub fn index(self) -> usize {
        self.node as usize
    }

    pub(crate) fn at(self, node: Id) -> Edge {
        Edge { node, ..self }
    }
}

#[inline]
pub(crate) fn signed<S: Scalar>(value: &S, negative: bool) -> S {
    if negative { value.neg() } else { value.clone() }
}

impl<C, I> Dag<C, I> {
    pub fn node(&self, id: Id) -> &Node<C, I> {
        &self.nodes[id as usize]
    }

    pub fn values<L: Leaves<C, I>>(&self, leaves: &L) -> Vec<L::Value>
    where
        I: Copy,
    {
        let mut values: Vec<L::Value> = Vec::with_capacity(self.nodes.len());
        for (node, id) in self.nodes.iter().zip(0..) {
            let value = match node {
                Node::Constant(constant) => leaves.constant(constant),
                Node::Input(input) => leaves.input(*input),
                Node::Apply(operation, operands) => {
                    let at = |id: Id| &values[id as usize];
                    match self.fusion(id) {
                        None => operation.apply(at(operands[0]), at(operands[1])),
                        Some(fusion) => fusion.apply(fusion.factors.map(at), at(fusion.addend)),
                    }
                }
            };
            values.push(value);
        }
        values
    }

    pub fn run<L: Leaves<C, I>>(&self, leaves: &L) -> Vec<L::Value>
    where
        I: Copy,
    {
        self.results(&self.values(leaves))
    }

    pub(crate) fn results<S: Scalar>(&self, values: &[S]) -> Vec<S> {
        let result = |edge: &Edge| signed(&values[edge.index()], edge.negative);
        self.outputs.iter().map(result).collect()
    }

    /// Computes the derivative of a node by itself and by each node before it.
    pub fn adjoints<S: Divide>(&self, top: Id, values: &[S], adjoints: &mut Vec<S>) {
        adjoints.clear();
        adjoints.resize(top as usize, S::zero());
        adjoints.push(S::one());
        self.pass_back(values, adjoints);
    }

    /// Adds to each node's derivative those that come through its users.
    pub(crate) fn pass_back<S: Divide>(&self, values: &[S], adjoints: &mut [S]) {
        for index in (0..adjoints.len()).rev() {
            self.pass_back_from(index, values, adjoints);
        }
    }

    fn pass_back_from<S: Divide>(&self, index: usize, values: &[S], adjoints: &mut [S]) {
        let Node::Apply(operation, operands) = &self.nodes[index] else {
            return;
        };
        if adjoints[index].is_zero() {
            return;
        }
        let [a, b] = operands.map(|id| &values[id as usize]);
        let parts = operation.parts(&adjoints[index], a, b);
        for (id, part) in operands.iter().zip(&parts) {
            adjoints[*id as usize] = adjoints[*id as usize].add(part);
        }
    }

    /// Returns the nodes that a node needs, in order, itself the last.
    pub(crate) fn needed(&self, top: Id) -> Vec<Id> {
        let mut is_needed = vec![false; top as usize];
        is_needed.push(true);
        let mut needed = Vec::new();
        for id in (0..=top).rev() {
            if is_needed[id as usize] {
                needed.push(id);
                let operands = self.node(id).operands().into_iter().flatten();
                operands.for_each(|id| is_needed[id as usize] = true);
            }
        }
        needed.reverse();
        needed
    }

    /// Computes the derivative of the last of some nodes by each of them: all that it needs.
    pub(crate) fn adjoints_of<S: Divide>(&self, needed: &[Id], values: &[S], adjoints: &mut [S]) {
        for id in needed {
            adjoints[*id as usize] = S::zero();
        }
        if let Some(top) = needed.last() {
            adjoints[*top as usize] = S::one();
        }
        for id in needed.iter().rev() {
            self.pass_back_from(*id as usize, values, adjoints);
        }
    }

    /// Lists the inputs, each once if the graph has it once.
    pub fn inputs(&self) -> impl Iterator<Item = &I> {
        self.nodes.iter().filter_map(|node| match node {
            Node::Input(input) => Some(input),
            _ => None,
        })
    }

    /// True if every operation comes after its operands, and every output is a node.
    pub fn is_straight(&self) -> bool {
        let count = self.nodes.len();
        let mut nodes = self.nodes.iter().zip(0..);
        nodes.all(|(node, id)| node.operands().into_iter().flatten().all(|read| read < id))
            && self.outputs.iter().all(|edge| edge.index() < count)
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
    /// A constant without a print, since the prime divides a denominator, counts as zero, as
    /// operations do: the proof refuses what comes of it.
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
    pub fn is_zero(&self, output: Edge) -> bool {
        matches!(self.node(output.node), Node::Constant(c) if c.is_zero())
    }

    /// Returns the joints whose sine or cosine the outputs need.
    pub fn angles(&self) -> BTreeSet<usize> {
        let angle = |(_, node): (usize, &Node)| match node {
            Node::Input(input) => input.angle(),
            _ => None,
        };
        self.live().filter_map(angle).collect()
    }

    pub fn counts(&self) -> Counts {
        let operation = |(_, node): (usize, &Node)| match node {
            Node::Apply(operation, _) => Some(*operation),
            _ => None,
        };
        Counts {
            sincos: self.angles().len(),
            ..Counts::of_operations(self.live().filter_map(operation))
        }
    }

    /// Rebuilds the outputs through another builder: folded, and merged by fingerprint if the
    /// builder does that. Nodes that no output needs are left behind.
    #[must_use]
    pub fn rebuild(&self, folding: Folding) -> Dag {
        let mut builder = Builder::new(folding);
        let outputs = builder.results(self);
        builder.finish(outputs)
    }
}

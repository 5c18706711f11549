//! The formulas as one hash-consed graph with exact constants.
//!
//! - this file: [`Graph`], its nodes and edges
//! - [`fingerprint`]: semantic fingerprints: values at random points of a prime field
//! - [`builder`]: the smart constructors: folding and sharing
//! - [`symbol`]: the scalar that traces the equations into a builder
//! - `counts`: operation counts
//!
//! A graph is a directed acyclic graph in topological order: operands come
//! before their users. Negation is free, so it is no node: edges carry signs.

pub(crate) mod builder;
mod counts;
pub(crate) mod fingerprint;
#[cfg(test)]
pub(crate) mod pattern;
pub(crate) mod symbol;
#[cfg(test)]
pub(crate) mod tests;

use dalembert_model::number::Exact;

use crate::program::Input;

pub use builder::Folding;
pub(crate) use builder::{Builder, Value};
pub use fingerprint::{Fingerprint, Points};

/// The index of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(u32);

impl NodeId {
    pub(crate) fn new(index: usize) -> Self {
        debug_assert!(index < (u32::MAX / 2) as usize);
        NodeId(index as u32)
    }
    /// Returns its place in [`Graph::nodes`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
    /// Returns the edge to it, with a sign.
    pub fn signed(self, negative: bool) -> Edge {
        Edge(self.0 << 1 | u32::from(negative))
    }
}

/// A node with a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Edge(u32);

impl Edge {
    /// Returns the node.
    pub fn node(self) -> NodeId {
        NodeId(self.0 >> 1)
    }
    /// Returns whether the node's value is negated.
    pub fn is_negative(self) -> bool {
        self.0 & 1 == 1
    }
    /// Returns the same node, negated if `negative`.
    pub fn negated_if(self, negative: bool) -> Edge {
        Edge(self.0 ^ u32::from(negative))
    }
}

/// One operation or leaf. Operands are ordered, the smaller node first, but
/// for those of a quotient.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Node {
    /// An exact constant: an index into [`Graph::constants`]. Never negative
    /// (see [`Exact::leads_negative`]): the sign is the edge's.
    Constant(u32),
    /// An input of the program.
    Input(Input),
    /// a + b
    Sum(NodeId, NodeId),
    /// a − b
    Difference(NodeId, NodeId),
    /// a · b
    Product(NodeId, NodeId),
    /// a / b
    Quotient(NodeId, NodeId),
}

impl Node {
    /// Returns the operands, if it is an operation.
    pub fn operands(&self) -> Option<[NodeId; 2]> {
        match *self {
            Node::Sum(a, b)
            | Node::Difference(a, b)
            | Node::Product(a, b)
            | Node::Quotient(a, b) => Some([a, b]),
            Node::Constant(_) | Node::Input(_) => None,
        }
    }
}

/// A program: nodes in topological order, and what it returns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// Operands before users.
    pub nodes: Vec<Node>,
    /// The constants of [`Node::Constant`].
    pub constants: Vec<Exact>,
    /// The results, in the order of the function's layout.
    pub outputs: Vec<Edge>,
}

impl Graph {
    /// Returns the node behind an index.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id.index()]
    }

    /// Returns which nodes the outputs need.
    pub fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.nodes.len()];
        for output in &self.outputs {
            live[output.node().index()] = true;
        }
        for index in (0..self.nodes.len()).rev() {
            if live[index]
                && let Some(operands) = self.nodes[index].operands()
            {
                for operand in operands {
                    live[operand.index()] = true;
                }
            }
        }
        live
    }

    /// Returns whether an output is identically zero.
    pub fn is_zero(&self, output: Edge) -> bool {
        use dalembert_model::scalar::Scalar;
        matches!(self.node(output.node()), Node::Constant(c) if self.constants[c as usize].is_zero())
    }

    /// Returns the same outputs through another builder: folded, and merged by
    /// fingerprint if the builder does that. Dead nodes are left behind.
    pub fn rebuild(&self, folding: Folding) -> Graph {
        let mut builder = Builder::new(folding);
        let values = self.replay(&mut builder);
        let outputs = self
            .outputs
            .iter()
            .map(|edge| builder.negate_if(&values[edge.node().index()], edge.is_negative()))
            .collect::<Vec<_>>();
        builder.finish(&outputs)
    }

    /// Returns every live node as a value of a builder; dead ones are zero.
    pub fn replay(&self, builder: &mut Builder) -> Vec<Value> {
        let live = self.live();
        let mut values: Vec<Value> = Vec::with_capacity(self.nodes.len());
        for (node, live) in self.nodes.iter().zip(live) {
            let value = match *node {
                _ if !live => Value::zero(),
                Node::Constant(c) => Value::Constant(self.constants[c as usize].clone()),
                Node::Input(input) => builder.input(input),
                Node::Sum(a, b) => builder.add(&values[a.index()], &values[b.index()]),
                Node::Difference(a, b) => builder.sub(&values[a.index()], &values[b.index()]),
                Node::Product(a, b) => builder.mul(&values[a.index()], &values[b.index()]),
                Node::Quotient(a, b) => builder.div(&values[a.index()], &values[b.index()]),
            };
            values.push(value);
        }
        values
    }
}

//! Code written node by node, each leaf once.

use std::hash::Hash;

use rustc_hash::FxHashMap;

use super::{Dag, Edge, Id, Node};
use crate::dag::Operation;

/// A leaf stands before the first operation that reads it.
#[derive(Clone, Debug)]
pub(crate) struct Writer<C, I> {
    nodes: Vec<Node<C, I>>,
    leaves: FxHashMap<Node<C, I>, Id>,
}

impl<C, I> Default for Writer<C, I> {
    fn default() -> Self {
        Writer {
            nodes: Vec::new(),
            leaves: FxHashMap::default(),
        }
    }
}

impl<C: Clone + Eq + Hash, I: Clone + Eq + Hash> Writer<C, I> {
    pub(crate) fn leaf(&mut self, leaf: Node<C, I>) -> Id {
        let nodes = &mut self.nodes;
        *self.leaves.entry(leaf).or_insert_with_key(|leaf| {
            nodes.push(leaf.clone());
            nodes.len() as Id - 1
        })
    }

    pub(crate) fn apply(&mut self, operation: Operation, operands: [Id; 2]) -> Id {
        self.nodes.push(Node::Apply(operation, operands));
        self.nodes.len() as Id - 1
    }

    pub(crate) fn node(&self, id: Id) -> &Node<C, I> {
        &self.nodes[id as usize]
    }

    pub(crate) fn finish(self, outputs: Vec<Edge>) -> Dag<C, I> {
        let nodes = self.nodes;
        Dag { nodes, outputs }
    }
}

impl<C, I> Dag<C, I> {
    /// Returns the operations that the outputs need, over other constants and inputs.
    #[must_use]
    pub fn map<D, J>(&self, constant: impl Fn(&C) -> D, input: impl Fn(&I) -> J) -> Dag<D, J>
    where
        D: Clone + Eq + Hash,
        J: Clone + Eq + Hash,
    {
        let mut writer = Writer::default();
        let mut places: Vec<Id> = vec![0; self.nodes.len()];
        let place = |id: Id, places: &[Id], writer: &mut Writer<D, J>| match self.node(id) {
            Node::Constant(leaf) => writer.leaf(Node::Constant(constant(leaf))),
            Node::Input(leaf) => writer.leaf(Node::Input(input(leaf))),
            Node::Apply(..) => places[id as usize],
        };
        for (index, node) in self.live() {
            if let Node::Apply(operation, operands) = node {
                let operands = operands.map(|id| place(id, &places, &mut writer));
                places[index] = writer.apply(*operation, operands);
            }
        }
        let moved = |edge: &Edge| edge.at(place(edge.node, &places, &mut writer));
        let outputs = self.outputs.iter().map(moved).collect();
        writer.finish(outputs)
    }

    /// Numbers the operations from one, in their order; leaves have no number.
    pub fn numbers(&self) -> Vec<Option<usize>> {
        let mut numbers = 1..;
        let number = |node: &Node<C, I>| node.operands().and_then(|_| numbers.next());
        self.nodes.iter().map(number).collect()
    }

    pub fn operations(&self) -> impl Iterator<Item = (Id, Operation, [Id; 2])> + '_ {
        let nodes = self.nodes.iter().zip(0..);
        nodes.filter_map(|(node, id)| match node {
            Node::Apply(operation, operands) => Some((id, *operation, *operands)),
            Node::Constant(_) | Node::Input(_) => None,
        })
    }
}

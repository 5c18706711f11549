//! What the fingerprints alone find in a graph.

use std::collections::HashSet;

use dalembert_codegen::workspace::{Edge, Fingerprint, Graph, Node, Points};

/// The operations of a graph that need not be done, by what they turn out
/// to be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Merged {
    /// All operations that the outputs need.
    pub operations: usize,
    /// Those that vanish in every state.
    pub vanish: usize,
    /// Those that are the same in every state.
    pub constant: usize,
    /// Those that are equal or opposite to an input or to another operation.
    pub repeat: usize,
}

impl Merged {
    /// Counts in a graph; `None` if a constant has no place in the field.
    pub fn of(graph: &Graph) -> Option<Merged> {
        let prints = prints(graph)?;
        let mut merged = Merged::default();
        let mut seen = HashSet::new();
        for ((node, live), print) in graph.nodes.iter().zip(graph.live()).zip(&prints) {
            let (class, _) = print.canonical();
            if node.operands().is_none() {
                seen.insert(class);
            } else if live {
                merged.operations += 1;
                if *print == Fingerprint::zero() {
                    merged.vanish += 1;
                } else if print.is_constant() {
                    merged.constant += 1;
                } else if !seen.insert(class) {
                    merged.repeat += 1;
                }
            }
        }
        Some(merged)
    }
}

/// Returns the fingerprint of every node.
fn prints(graph: &Graph) -> Option<Vec<Fingerprint>> {
    let points = Points::SEARCH;
    let mut prints: Vec<Fingerprint> = Vec::with_capacity(graph.nodes.len());
    for node in &graph.nodes {
        let print = match *node {
            Node::Constant(c) => points.constant(&graph.constants[c as usize])?,
            Node::Input(input) => points.input(input),
            Node::Sum(a, b) => prints[a.index()].add(&prints[b.index()]),
            Node::Difference(a, b) => prints[a.index()].sub(&prints[b.index()]),
            Node::Product(a, b) => prints[a.index()].mul(&prints[b.index()]),
            Node::Quotient(a, b) => prints[a.index()].div(&prints[b.index()]),
        };
        prints.push(print);
    }
    Some(prints)
}

/// Returns the fingerprints of a graph's results.
pub(super) fn results(graph: &Graph) -> Option<Vec<Fingerprint>> {
    let prints = prints(graph)?;
    let of = |edge: &Edge| prints[edge.node().index()].negate_if(edge.is_negative());
    Some(graph.outputs.iter().map(of).collect())
}

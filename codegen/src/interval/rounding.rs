//! What rounding costs straight-line code over intervals.
//!
//! **Soundness.** Every operation gives (x ∘ y)(1 + δ) + η. Each is widened by that, so the
//! intervals hold what is computed *and* what is exact. The error of a result is exactly Σ own
//! error of a node · adjoint of the node, with adjoints that mix computed and exact operands; both
//! are in the intervals here, so the sum bounds the whole error, not only its first order.

use super::Interval;
use crate::dag::{Dag, Id, Node, Operation};

/// Intervals that hold what is exact and what is computed, and each node's own rounding.
pub(crate) struct Forward {
    pub values: Vec<Interval>,
    /// The distance between the two that a node itself may add.
    pub own: Vec<f64>,
}

/// `leaf` gives the value of a constant or an input, and its error.
pub(crate) fn forward<C, I>(
    dag: &Dag<C, I>,
    leaf: impl Fn(Id, &Node<C, I>) -> (Interval, f64),
    rounding: impl Fn(Id, Operation, Interval) -> f64,
) -> Forward {
    let mut values: Vec<Interval> = Vec::with_capacity(dag.nodes.len());
    let mut own = Vec::with_capacity(dag.nodes.len());
    for (node, id) in dag.nodes.iter().zip(0..) {
        let (value, error) = match node {
            Node::Constant(_) | Node::Input(_) => leaf(id, node),
            Node::Apply(operation, operands) => {
                let [x, y] = operands.map(|id| values[id as usize]);
                let exact = match operation {
                    Operation::Mul | Operation::Fused if operands[0] == operands[1] => x.square(),
                    operation => operation.apply(&x, &y),
                };
                let rounding = rounding(id, *operation, exact);
                (exact.widened(rounding), rounding)
            }
        };
        values.push(value);
        own.push(error);
    }
    Forward { values, own }
}

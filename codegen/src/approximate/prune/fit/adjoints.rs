//! What a change of each value does to the outputs.
//!
//! The derivatives of an operation are those of [`Operation`](crate::dag::Operation); the pass is
//! of its own, since edits stand in the places of inputs as well as of steps, and since all samples
//! go through an operation together.

use crate::approximate::prune::columns::{Nodes, Value};

/// Computes ∂output/∂node at every sample, node after node; `of` is where it is written: what
/// many outputs share need not be had from the system for each.
pub(super) fn adjoints(
    nodes: &Nodes,
    edits: &[Option<Value>],
    columns: &[f64],
    output: Value,
    of: &mut Vec<f64>,
) {
    let (m, inputs) = (nodes.samples, nodes.inputs.len());
    of.clear();
    of.resize(nodes.len() * m, 0.0);
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
                let step = &nodes.steps[node - inputs];
                let read = step.operands.map(|operand| nodes.column(operand, columns));
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

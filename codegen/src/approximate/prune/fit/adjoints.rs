//! What a change of each value does to the outputs.
//!
//! The derivatives of an operation are those of
//! [`adjoint`](crate::program::adjoint); the pass is of its own, since edits
//! stand in the places of inputs as well as of steps, and since all samples go
//! through an operation together.

use crate::approximate::prune::columns::{Nodes, Value};

/// ∂output/∂node at every sample: output after output, node after node.
pub(super) fn adjoints(nodes: &Nodes, edits: &[Option<Value>], columns: &[f64]) -> Vec<f64> {
    let (m, inputs) = (nodes.samples, nodes.inputs.len());
    let stride = nodes.len() * m;
    let mut adjoints = vec![0.0; stride * nodes.outputs.len()];
    for (index, output) in nodes.outputs.iter().enumerate() {
        let of = &mut adjoints[index * stride..][..stride];
        let Some(top) = nodes.node_of(&output.value) else {
            continue;
        };
        of[top * m..][..m].fill(if output.negative { -1.0 } else { 1.0 });
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
                    let out = &mut before[other as usize * m..][..m];
                    for (out, adjoint) in out.iter_mut().zip(adjoint) {
                        *out += sign * adjoint;
                    }
                }
                None if node < inputs => {}
                None => {
                    let step = &nodes.steps[node - inputs];
                    let operands = [&step.left, &step.right];
                    let read = operands.map(|operand| nodes.column(operand, columns));
                    for (side, operand) in operands.into_iter().enumerate() {
                        if let Some(to) = nodes.node_of(operand) {
                            let sums = &mut before[to * m..][..m];
                            step.operation.add_parts(side, adjoint, read, sums);
                        }
                    }
                }
            }
        }
    }
    adjoints
}

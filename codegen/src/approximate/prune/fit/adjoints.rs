//! What a change of each value does to the outputs.

use crate::approximate::prune::columns::{Nodes, Value};
use crate::program::Operation;

/// ∂output/∂node at every sample: output after output, node after node.
pub(super) fn adjoints(nodes: &Nodes, edits: &[Option<Value>], columns: &[f64]) -> Vec<f64> {
    let (m, inputs) = (nodes.samples, nodes.inputs.len());
    let stride = nodes.len() * m;
    let mut adjoints = vec![0.0; stride * nodes.outputs.len()];
    for (output, &value) in nodes.outputs.iter().enumerate() {
        let of = &mut adjoints[output * stride..][..stride];
        let Value::Node(top, negative) = value else {
            continue;
        };
        of[top as usize * m..][..m].fill(if negative { -1.0 } else { 1.0 });
        for node in (0..=top as usize).rev() {
            let (before, rest) = of.split_at_mut(node * m);
            let adjoint = &rest[..m];
            if adjoint.iter().all(|x| *x == 0.0) {
                continue;
            }
            let mut pass = |to: Value, by: &dyn Fn(usize) -> f64| {
                if let Value::Node(to, negative) = to {
                    let sign = if negative { -1.0 } else { 1.0 };
                    let out = &mut before[to as usize * m..][..m];
                    for (k, (out, adjoint)) in out.iter_mut().zip(adjoint).enumerate() {
                        *out += sign * adjoint * by(k);
                    }
                }
            };
            match edits[node] {
                Some(value) => pass(value, &|_| 1.0),
                None if node < inputs => {}
                None => {
                    let op = nodes.ops[node - inputs];
                    let read = |value: Value, k: usize| match value {
                        Value::Known(c) => c,
                        Value::Node(n, negative) => {
                            let x = columns[n as usize * m + k];
                            if negative { -x } else { x }
                        }
                    };
                    match op.operation {
                        Operation::Mul => {
                            pass(op.left, &|k| read(op.right, k));
                            pass(op.right, &|k| read(op.left, k));
                        }
                        operation => {
                            let sign = if operation == Operation::Sub {
                                -1.0
                            } else {
                                1.0
                            };
                            pass(op.left, &|_| 1.0);
                            pass(op.right, &|_| sign);
                        }
                    }
                }
            }
        }
    }
    adjoints
}

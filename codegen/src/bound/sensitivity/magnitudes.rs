//! Largest values times largest adjoints.
//!
//! **Soundness.** For each node let V ≥ |x|, A ≥ |a| over the box, a the adjoint at exact values.
//! Forwards, E ≥ |x̂ − x| follows node by node: |x̂ ∘ ŷ| ≤ V + δ with δ = E_x + E_y for a sum and δ
//! = V_x·E_y + V_y·E_x + E_x·E_y for a product x·y, so the node's own rounding is r ≤ u·(V + δ) +
//! η, or half an ulp of V + δ, and E = δ + r; a product that a sum takes has none. Backwards, D ≥
//! |ā − a|: a product's ā passes on ā·y to x and ā·x̂ to y, so with |ā| ≤ A + D
//!
//! - D_x grows by D·V_y
//! - D_y grows by D·V_x + (A + D)·E_x
//!
//! and a sum passes D on. The error of an output is at most Σ (A + D)·r. Sums here have no negative
//! terms: a few thousand roundings are made up for by a factor.

use super::Rounding;
use super::extremes::Extremes;
use super::intervals::Constants;
use crate::bound::input_box::InputBox;
use crate::dag::{Node, Operation};

/// For the roundings of this bound itself.
const ROUNDINGS: f64 = 1.0 + 1e-10;

/// V and E of a node, and r.
#[derive(Clone, Copy)]
struct Known {
    value: f64,
    error: f64,
    own: f64,
}

pub(super) fn rounding(
    constants: &Constants<'_>,
    limits: &InputBox,
    extremes: &Extremes,
) -> Vec<Rounding> {
    let dag = &constants.program.dag;
    let mut known: Vec<Known> = Vec::with_capacity(dag.nodes.len());
    for (node, id) in dag.nodes.iter().zip(0..) {
        let Node::Apply(operation, operands) = node else {
            let (range, error) = constants.leaf(id, node, limits);
            let value = range.magnitude();
            known.push(Known {
                value,
                error,
                own: error,
            });
            continue;
        };
        let [x, y] = operands.map(|id| known[id as usize]);
        let moved = match operation {
            Operation::Add | Operation::Sub => x.error + y.error,
            Operation::Mul | Operation::Fused => {
                x.value * y.error + y.value * x.error + x.error * y.error
            }
            Operation::Div => f64::INFINITY,
        };
        let value = extremes.values[id as usize];
        let own = constants.rounding(id, (value + moved) * ROUNDINGS);
        known.push(Known {
            value,
            error: (moved + own) * ROUNDINGS,
            own: own * ROUNDINGS,
        });
    }
    let mut bounds = Vec::with_capacity(dag.outputs.len());
    for (output, adjoints) in dag.outputs.iter().zip(&extremes.adjoints) {
        let mut bound = Rounding::default();
        let mut off = vec![0.0; dag.nodes.len()];
        if let (node @ Node::Constant(_), index) = (dag.node(output.node), output.index()) {
            bound.note(node, known[index].own);
        }
        for (index, node) in dag.nodes.iter().enumerate().rev() {
            let (exact, off_here) = (adjoints[index], off[index]);
            let mixed = exact + off_here;
            if mixed == 0.0 {
                continue;
            }
            let own = known[index].own;
            if own != 0.0 {
                bound.note(node, mixed * own);
            }
            let Node::Apply(operation, operands) = node else {
                continue;
            };
            let [x, y] = operands.map(|id| known[id as usize]);
            let (parts, offs) = match operation {
                Operation::Add | Operation::Sub => ([mixed; 2], [off_here; 2]),
                Operation::Mul | Operation::Fused => (
                    [mixed * y.value, mixed * (x.value + x.error)],
                    [off_here * y.value, off_here * x.value + mixed * x.error],
                ),
                Operation::Div => ([f64::INFINITY; 2], [f64::INFINITY; 2]),
            };
            for (id, (part, off_there)) in operands.iter().zip(parts.into_iter().zip(offs)) {
                match dag.node(*id) {
                    // Of a constant's adjoint no bound is at hand: use by use.
                    own @ Node::Constant(_) => bound.note(own, part * known[*id as usize].own),
                    _ => off[*id as usize] += off_there,
                }
            }
        }
        bound.arithmetic *= ROUNDINGS;
        bound.sincos *= ROUNDINGS;
        bounds.push(bound);
    }
    bounds
}

//! Constants corrected for what was left out: least squares.
//!
//! A constant may take any value at no cost. To first order the outputs'
//! errors at the samples are E + J·δ with δ the changes of the constants and
//! J from [`adjoints`]. With an orthonormal basis Q of J's columns, what no
//! change of constants takes away from E is E − Q Qᵀ E: quick enough to rank
//! every candidate by.

use super::columns::{Nodes, Value};
use super::motions::Motions;
use crate::schedule::Operation;

/// What a change of a constant by itself weighs, against errors in units of
/// their allowance: changes that are large and undo each other go wrong
/// where J changes with them.
const INERTIA: f64 = 3.0;

/// What the constants can change.
pub(super) struct Fit {
    /// Which constant each column of J belongs to: op, and whether it is the
    /// right operand.
    places: Vec<(usize, bool)>,
    /// Orthonormal, of length outputs·samples.
    basis: Vec<Vec<f64>>,
    /// R of J = Q R, column by column.
    triangle: Vec<Vec<f64>>,
    /// W = Q R⁻ᵀ, so that Jᵀ W = 1: a change is −w·E.
    duals: Vec<Vec<f64>>,
}

impl Fit {
    /// From the columns of a program under edits; `weights` of rows.
    pub(super) fn new(
        nodes: &Nodes,
        edits: &[Option<Value>],
        live: &[bool],
        columns: &[f64],
        motions: &Motions,
        weights: &[f64],
    ) -> Fit {
        let mut fit = Fit {
            places: Vec::new(),
            basis: Vec::new(),
            triangle: Vec::new(),
            duals: Vec::new(),
        };
        let adjoints = adjoints(nodes, edits, columns);
        let (m, inputs) = (nodes.samples, nodes.inputs.len());
        let (stride, outputs) = (nodes.len() * m, nodes.outputs.len());
        let count = nodes.ops.len();
        for (index, op) in nodes.ops.iter().enumerate() {
            let node = inputs + index;
            if !live[node] || edits[node].is_some() {
                continue;
            }
            let (right, other, constant) = match (op.left, op.right) {
                (Value::Known(c), Value::Node(other, _)) => (false, other as usize, c),
                (Value::Node(other, _), Value::Known(c)) => (true, other as usize, c),
                _ => continue,
            };
            let minus = op.operation == Operation::Sub && right;
            let mut column = vec![0.0; outputs * m];
            for output in 0..outputs {
                let adjoint = &adjoints[output * stride + node * m..][..m];
                let out = &mut column[output * m..][..m];
                let factor = &columns[other * m..][..m];
                for ((out, adjoint), factor) in out.iter_mut().zip(adjoint).zip(factor) {
                    *out = match op.operation {
                        Operation::Mul => adjoint * factor,
                        _ if minus => -adjoint,
                        _ => *adjoint,
                    };
                }
            }
            motions.monomials(&mut column);
            for (x, w) in column.iter_mut().zip(weights) {
                *x *= w;
            }
            column.resize(outputs * m + count, 0.0);
            column[outputs * m + index] = INERTIA / constant.abs().max(1e-9);
            fit.push((index, right), column);
        }
        fit.dualize();
        fit
    }

    fn push(&mut self, place: (usize, bool), mut column: Vec<f64>) {
        let mut entries: Vec<f64> = Vec::with_capacity(self.basis.len() + 1);
        for q in &self.basis {
            let part = dot(q, &column);
            subtract(&mut column, part, q);
            entries.push(part);
        }
        // Once more: the first time leaves rounding behind.
        for (q, entry) in self.basis.iter().zip(&mut entries) {
            let part = dot(q, &column);
            subtract(&mut column, part, q);
            *entry += part;
        }
        let left = dot(&column, &column).sqrt();
        if left > 1e-9 {
            for x in &mut column {
                *x /= left;
            }
            entries.push(left);
            self.basis.push(column);
            self.triangle.push(entries);
            self.places.push(place);
        }
    }

    fn dualize(&mut self) {
        let count = self.basis.len();
        let mut duals: Vec<Vec<f64>> = Vec::new();
        for k in (0..count).rev() {
            // Q = W Rᵀ: q_k = Σ_j≥k R_kj w_j.
            let mut dual = self.basis[k].clone();
            for (later, column) in duals.iter().rev().zip(&self.triangle[k + 1..]) {
                subtract(&mut dual, column[k], later);
            }
            let own = self.triangle[k][k];
            for x in &mut dual {
                *x /= own;
            }
            duals.push(dual);
        }
        duals.reverse();
        self.duals = duals;
    }

    /// Takes away from weighted errors what constants can take away, those
    /// constants aside whose operations are not `live`.
    pub(super) fn project(&self, errors: &mut Vec<f64>, gone: impl Fn(usize) -> bool) {
        let rows = errors.len();
        errors.resize(self.basis.first().map_or(rows, Vec::len), 0.0);
        let mut lost: Vec<Vec<f64>> = Vec::new();
        for ((op, _), dual) in self.places.iter().zip(&self.duals) {
            if gone(*op) {
                let mut dual = dual.clone();
                for before in &lost {
                    let part = dot(before, &dual);
                    subtract(&mut dual, part, before);
                }
                let size = dot(&dual, &dual).sqrt();
                if size > 0.0 {
                    for x in &mut dual {
                        *x /= size;
                    }
                    lost.push(dual);
                }
            }
        }
        let parts: Vec<f64> = lost.iter().map(|w| dot(w, errors)).collect();
        for q in &self.basis {
            let part = dot(q, errors);
            subtract(errors, part, q);
        }
        for (w, part) in lost.iter().zip(parts) {
            subtract(errors, -part, w);
        }
        errors.truncate(rows);
    }

    /// The changes of constants that do so, none gone.
    pub(super) fn changes(&self, errors: &[f64]) -> Vec<((usize, bool), f64)> {
        let places = self.places.iter().copied();
        places
            .zip(self.duals.iter().map(|dual| -dot(dual, errors)))
            .collect()
    }
}

/// ∂output/∂node at every sample: output after output, node after node.
fn adjoints(nodes: &Nodes, edits: &[Option<Value>], columns: &[f64]) -> Vec<f64> {
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

/// Eight sums side by side, in a fixed order: quick, and the same on every
/// machine.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a
        .remainder()
        .iter()
        .zip(b.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a.zip(b) {
        for k in 0..8 {
            sums[k] += x[k] * y[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}

fn subtract(a: &mut [f64], by: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a -= by * b;
    }
}

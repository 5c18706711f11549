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
            duals: Vec::new(),
        };
        let mut all = Vec::new();
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
            all.push(((index, right), column));
        }
        fit.factor(all);
        fit
    }

    /// Q and W from J's columns. Cholesky's factor of JᵀJ instead of an
    /// orthogonalisation: J's own rows of changes keep it far from singular, and
    /// it is four times as quick.
    fn factor(&mut self, columns: Vec<((usize, bool), Vec<f64>)>) {
        let gram = gram(&columns);
        let mut kept: Vec<usize> = Vec::new();
        // R, column by column.
        let mut triangle: Vec<Vec<f64>> = Vec::new();
        for (index, row) in gram.iter().enumerate() {
            let mut entries: Vec<f64> = Vec::with_capacity(kept.len() + 1);
            for (column, &other) in triangle.iter().zip(&kept) {
                let known: f64 = entries.iter().zip(column).map(|(x, y)| x * y).sum();
                entries.push((row[other] - known) / column[entries.len()]);
            }
            let left = row[index] - entries.iter().map(|x| x * x).sum::<f64>();
            // What the others can do by themselves is left out.
            if left > 1e-12 * row[index] {
                entries.push(left.sqrt());
                triangle.push(entries);
                kept.push(index);
            }
        }
        let mut columns: Vec<Option<_>> = columns.into_iter().map(Some).collect();
        for index in kept {
            if let Some((place, column)) = columns[index].take() {
                self.places.push(place);
                self.basis.push(column);
            }
        }
        // J = Q R, block by block of rows: those of all columns stay at hand.
        let rows = self.basis.first().map_or(0, Vec::len);
        self.duals = vec![vec![0.0; rows]; self.basis.len()];
        for from in (0..rows).step_by(BLOCK) {
            let block = from..(from + BLOCK).min(rows);
            for (k, entries) in triangle.iter().enumerate() {
                let (before, rest) = self.basis.split_at_mut(k);
                let own = &mut rest[0][block.clone()];
                for (q, &entry) in before.iter().zip(entries) {
                    subtract(own, entry, &q[block.clone()]);
                }
                own.iter_mut().for_each(|x| *x /= entries[k]);
            }
            // Q = W Rᵀ: q_k = Σ_j≥k R_kj w_j.
            for k in (0..triangle.len()).rev() {
                let (before, after) = self.duals.split_at_mut(k + 1);
                let own = &mut before[k][block.clone()];
                own.copy_from_slice(&self.basis[k][block.clone()]);
                for (later, entries) in after.iter().zip(&triangle[k + 1..]) {
                    subtract(own, entries[k], &later[block.clone()]);
                }
                own.iter_mut().for_each(|x| *x /= triangle[k][k]);
            }
        }
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

/// Rows that are taken together: of a hundred columns they fit a cache.
const BLOCK: usize = 512;

/// JᵀJ, the lower triangle.
fn gram(columns: &[((usize, bool), Vec<f64>)]) -> Vec<Vec<f64>> {
    let rows = columns.first().map_or(0, |(_, column)| column.len());
    let mut gram: Vec<Vec<f64>> = (0..columns.len()).map(|k| vec![0.0; k + 1]).collect();
    for from in (0..rows).step_by(BLOCK) {
        let block = from..(from + BLOCK).min(rows);
        for (row, (_, a)) in gram.iter_mut().zip(columns) {
            for (sum, (_, b)) in row.iter_mut().zip(columns) {
                *sum += dot(&a[block.clone()], &b[block.clone()]);
            }
        }
    }
    gram
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

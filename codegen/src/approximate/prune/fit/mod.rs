//! Constants corrected for what was left out: least squares.
//!
//! A constant may take any value at no cost. To first order the outputs' errors at the samples are
//! E + J·δ with δ the changes of the constants and J from [`Nodes::adjoints`]. With Cholesky's
//! factor of JᵀJ, what no change of constants takes away from E costs two products with J: quick
//! enough to rank every candidate by, above all if candidates share them.
//!
//! - this file: J, and what the constants leave
//! - `products`: J with many errors side by side

mod products;

use super::columns::{Nodes, Value};
use crate::approximate::motions::Motions;
pub(super) use products::LANES;
pub(in crate::approximate) use products::dot;
use products::{Columns, gram};

pub(super) fn sized(column: &[f64], motions: &Motions) -> (Vec<f64>, f64) {
    let mut column = column.to_vec();
    motions.monomials(&mut column);
    let size = dot(&column, &column).sqrt();
    (column, size)
}

/// What a change of a constant by itself weighs, against errors in units of
/// their allowance: changes that are large and undo each other go wrong
/// where J changes with them. It also keeps JᵀJ far from singular.
const INERTIA: f64 = 3.0;

pub(super) struct Fit {
    /// The constant of each column of J: its operation, and which operand it is.
    places: Vec<(usize, usize)>,
    /// J, weighted, without what the other columns can do by themselves.
    columns: Columns,
    /// R of JᵀJ + inertia = RᵀR, column by column.
    factor: Vec<Vec<f64>>,
}

pub(super) struct Trial {
    pub errors: Vec<f64>,
    pub gone: Vec<usize>,
}

impl Fit {
    pub(super) fn new(
        nodes: &Nodes,
        edits: &[Option<Value>],
        live: &[bool],
        columns: &[f64],
        motions: &Motions,
        weights: &[f64],
    ) -> Fit {
        let (m, inputs) = (nodes.samples, nodes.inputs.len());
        let rows = nodes.outputs.len() * m;
        let mut all = Vec::new();
        for (index, step) in nodes.steps.iter().enumerate() {
            let node = inputs + index;
            if !live[node] || edits[node].is_some() {
                continue;
            }
            let (side, constant) = match step.operands {
                [Value::Known(c), Value::Node(..)] => (0, c),
                [Value::Node(..), Value::Known(c)] => (1, c),
                _ => continue,
            };
            let inertia = INERTIA / constant.abs().max(1e-9);
            all.push(((index, side), vec![0.0; rows], inertia));
        }
        let mut adjoint = Vec::new();
        for (output, &top) in nodes.outputs.iter().enumerate() {
            nodes.adjoints(edits, columns, top, &mut adjoint);
            for ((index, side), column, _) in &mut all {
                let step = &nodes.steps[*index];
                let read = step.operands.map(|operand| nodes.column(operand, columns));
                let of = &adjoint[(inputs + *index) * m..][..m];
                let out = &mut column[output * m..][..m];
                step.operation.add_parts(*side, of, read, out);
            }
        }
        for (_, column, _) in &mut all {
            motions.monomials(column);
            for (x, w) in column.iter_mut().zip(weights) {
                *x *= w;
            }
        }
        Fit::of(all)
    }

    fn of(all: Vec<((usize, usize), Vec<f64>, f64)>) -> Fit {
        let mut fit = Fit {
            places: Vec::new(),
            columns: Columns::default(),
            factor: Vec::new(),
        };
        let mut kept: Vec<usize> = Vec::new();
        let columns: Vec<&[f64]> = all.iter().map(|(_, column, _)| &column[..]).collect();
        let mut gram = gram(&columns);
        for (row, (_, _, inertia)) in gram.iter_mut().zip(&all) {
            if let Some(diagonal) = row.last_mut() {
                *diagonal += inertia * inertia;
            }
        }
        for (index, row) in gram.iter().enumerate() {
            let mut entries: Vec<f64> = Vec::with_capacity(kept.len() + 1);
            for (column, &other) in fit.factor.iter().zip(&kept) {
                let known = dot(&entries, &column[..entries.len()]);
                entries.push((row[other] - known) / column[entries.len()]);
            }
            let left = row[index] - dot(&entries, &entries);
            if left > 1e-12 * row[index] {
                entries.push(left.sqrt());
                fit.factor.push(entries);
                kept.push(index);
            }
        }
        let mut left = Vec::with_capacity(kept.len());
        for (index, (place, column, _)) in all.into_iter().enumerate() {
            if kept.binary_search(&index).is_ok() {
                fit.places.push(place);
                left.push(column);
            }
        }
        fit.columns = Columns::of(left);
        fit
    }

    pub(super) fn of_ops(&self, which: impl Fn(usize) -> bool) -> Vec<usize> {
        let places = self.places.iter().enumerate();
        let of = places.filter(|(_, (op, _))| which(*op));
        of.map(|(column, _)| column).collect()
    }

    pub(super) fn settle(&self, trials: &mut [&mut Trial]) {
        for trials in trials.chunks_mut(LANES) {
            let rows = trials.first().map_or(0, |trial| trial.errors.len());
            let mut errors = vec![[0.0; LANES]; rows];
            for (lane, trial) in trials.iter().enumerate() {
                for (row, x) in errors.iter_mut().zip(&trial.errors) {
                    row[lane] = *x;
                }
            }
            let products = self.columns.transposed(&errors);
            let mut changes = vec![[0.0; LANES]; products.len()];
            for (lane, trial) in trials.iter().enumerate() {
                let products = products.iter().map(|y| y[lane]).collect();
                let least = self.without(self.solve(products), &trial.gone);
                for (row, x) in changes.iter_mut().zip(least) {
                    row[lane] = x;
                }
            }
            self.columns.subtract(&changes, &mut errors);
            for (lane, trial) in trials.iter_mut().enumerate() {
                for (x, row) in trial.errors.iter_mut().zip(&errors) {
                    *x = row[lane];
                }
            }
        }
    }

    pub(super) fn changes(&self, errors: &[f64], gone: &[usize]) -> Vec<((usize, usize), f64)> {
        let products = self
            .columns
            .columns
            .iter()
            .map(|column| dot(column, errors));
        let least = self.without(self.solve(products.collect()), gone);
        let places = self.places.iter().copied();
        places.zip(least.iter().map(|x| -x)).collect()
    }

    /// Returns (JᵀJ + inertia)⁻¹ y.
    fn solve(&self, mut y: Vec<f64>) -> Vec<f64> {
        // Rᵀ z = y, then R x = z.
        for (k, column) in self.factor.iter().enumerate() {
            y[k] = (y[k] - dot(&column[..k], &y[..k])) / column[k];
        }
        for (k, column) in self.factor.iter().enumerate().rev() {
            let x = y[k] / column[k];
            add(&mut y[..k], -x, column);
            y[k] = x;
        }
        y
    }

    /// Returns the least squares if some changes are zero, from those if none is: with S
    /// the inverse of JᵀJ + inertia and G what is gone, x − S_G (S_GG)⁻¹ x_G.
    fn without(&self, mut x: Vec<f64>, gone: &[usize]) -> Vec<f64> {
        // Gauss's elimination: a pivot is one at its own column, and zero at those before.
        let mut pivots: Vec<(usize, Vec<f64>)> = Vec::new();
        for &column in gone {
            let mut unit = vec![0.0; self.places.len()];
            unit[column] = 1.0;
            let mut pivot = self.solve(unit);
            for (other, before) in &pivots {
                let part = pivot[*other];
                add(&mut pivot, -part, before);
                pivot[*other] = 0.0;
            }
            let size = pivot[column];
            if size > 0.0 {
                pivot.iter_mut().for_each(|x| *x /= size);
                let part = x[column];
                add(&mut x, -part, &pivot);
                pivots.push((column, pivot));
            }
            x[column] = 0.0;
        }
        x
    }
}

fn add(a: &mut [f64], by: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += by * b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn what_is_gone_cannot_help() {
        let mut random = Random::new(7);
        let rows = 40 * LANES;
        let mut column = || (0..rows).map(|_| random.unit() - 0.5).collect::<Vec<f64>>();
        let mut errors = column();
        let mut columns: Vec<_> = (0..6).map(|k| ((k, 0), column(), 0.1)).collect();
        for (_, column, _) in &columns {
            add(&mut errors, 0.5, column);
        }
        columns[5].1 = columns[2].1.iter().map(|x| x + 1e-3).collect();
        let left = |fit: &Fit, gone: &[usize]| {
            let (errors, gone) = (errors.clone(), gone.to_vec());
            let mut trial = Trial { errors, gone };
            fit.settle(&mut [&mut trial]);
            trial.errors
        };
        let all = Fit::of(columns.clone());
        let gone = all.of_ops(|op| op == 1 || op == 2);
        columns.retain(|((op, _), ..)| *op != 1 && *op != 2);
        let fewer = left(&Fit::of(columns), &[]);
        for (x, y) in left(&all, &gone).iter().zip(&fewer) {
            assert!((x - y).abs() < 1e-9, "{x} {y}");
        }
        let size = |errors: &[f64]| dot(errors, errors);
        let none = size(&left(&all, &[]));
        assert!(none < 0.9 * size(&fewer) && size(&fewer) < 0.9 * size(&errors));
    }
}

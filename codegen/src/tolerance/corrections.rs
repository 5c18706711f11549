//! Constants corrected for what is left out: least squares over the errors at the samples.
//!
//! To first order a small change of each constant changes the errors by a column. Sums of squares of
//! all rows put together, with random signs, into few (a count sketch) are what they are but for some
//! per cent, if there are so many of these for each constant.

use super::greedy::{Greedy, is_zero};
use super::linear::{Factor, dot};
use super::net::{Arg, Edits, NodeValue};
use crate::program::Operation;

/// The rows of a sketch for ranking, which is also the least for corrections; and those for each
/// constant: with fewer, corrections are too far off.
const SKETCH: usize = 512;
const SKETCH_EACH: usize = 40;
/// A change of a constant by itself weighs as much as so many allowed errors.
const INERTIA: f64 = 3.0;

/// A constant that may change: of a step, or in a node's place.
#[derive(Clone, Copy)]
enum ConstantPlace {
    Arg(usize, usize),
    Edit(usize),
}

/// A constant that may change: how it enters, and how much a change weighs by itself.
pub(super) struct Unknown {
    place: ConstantPlace,
    node: usize,
    sign: f64,
    other: Option<usize>,
    inertia: f64,
}

/// A state, and what a small change of each of its constants does.
pub(super) struct Frame {
    pub(super) values: Vec<f64>,
    pub(super) errors: Vec<f64>,
    /// The derivatives of each result by every node.
    pub(super) adjoints: Vec<Vec<f64>>,
    pub(super) unknowns: Vec<Unknown>,
    columns: Vec<Vec<f64>>,
    /// The results that each constant changes.
    reached: Vec<Vec<usize>>,
    pub(super) weights: Vec<f64>,
    /// For ranking, and for corrections.
    pub(super) coarse: ColumnSketch,
    pub(super) fine: ColumnSketch,
}

/// Columns put together into so many rows, and the normal equations of their least squares.
pub(super) struct ColumnSketch {
    pub(super) size: usize,
    columns: Vec<Vec<f64>>,
    factor: Factor,
    inverse: Vec<Vec<f64>>,
}

/// The errors that are left once constants are corrected.
pub(super) struct Remainder {
    pub(super) sum: f64,
    pub(super) worst: f64,
    pub(super) change: Vec<f64>,
}

impl Greedy<'_> {
    fn sketch_size(&self, unknowns: usize) -> usize {
        (SKETCH_EACH * unknowns).clamp(SKETCH, self.truth.len().max(SKETCH))
    }

    fn unknowns(&self, state: &Edits, live: &[bool]) -> Vec<Unknown> {
        let count = self.net.inputs.len();
        let unknown_at = |node: usize| {
            // A node's value, the sign of its derivative, and the node that it multiplies.
            let (place, constant, sign, other) = match state.edits[node] {
                Some(NodeValue::Constant(c)) if c != 0.0 => {
                    (ConstantPlace::Edit(node), c, 1.0, None)
                }
                Some(NodeValue::Times(c, other)) if c.abs() != 1.0 => {
                    (ConstantPlace::Edit(node), c, 1.0, Some(other))
                }
                Some(_) => return None,
                None if node < count => return None,
                None => {
                    let op = &state.ops[node - count];
                    let (side, c, other) = match op.args {
                        [Arg::Constant(c), Arg::Node(other)] => (0, c, other),
                        [Arg::Node(other), Arg::Constant(c)] => (1, c, other),
                        _ => return None,
                    };
                    let is_taken_off = op.operation == Operation::Sub && side == 1;
                    let sign = if is_taken_off { -1.0 } else { 1.0 };
                    let other = (op.operation == Operation::Mul).then_some(other);
                    (ConstantPlace::Arg(node - count, side), c, sign, other)
                }
            };
            let inertia = INERTIA / constant.abs().max(1e-9);
            Some(Unknown {
                place,
                node,
                sign,
                other,
                inertia,
            })
        };
        let live = (0..self.net.len()).filter(|&node| live[node]);
        live.filter_map(unknown_at).collect()
    }

    /// Returns the change of the errors by each constant, and keeps the derivatives by all nodes
    /// if they are asked for. Constants that change nothing leave the list.
    fn jacobian(
        &self,
        state: &Edits,
        values: &[f64],
        unknowns: &mut Vec<Unknown>,
        mut kept: Option<&mut Vec<Vec<f64>>>,
    ) -> Vec<Vec<f64>> {
        let m = self.samples.len();
        let mut columns = vec![Vec::new(); unknowns.len()];
        let mut adjoints = Vec::new();
        for output in 0..self.net.outputs.len() {
            self.net.adjoints(state, values, (output, m), &mut adjoints);
            for (column, unknown) in columns.iter_mut().zip(&*unknowns) {
                let adjoint = &adjoints[unknown.node * m..][..m];
                match unknown.other {
                    None => column.extend(adjoint.iter().map(|a| unknown.sign * a)),
                    Some(other) => {
                        let factors = &values[other * m..][..m];
                        column.extend(adjoint.iter().zip(factors).map(|(a, x)| a * x));
                    }
                }
            }
            if let Some(kept) = &mut kept {
                kept.push(std::mem::take(&mut adjoints));
            }
        }
        let mut iter = columns.iter();
        unknowns.retain(|_| iter.next().is_some_and(|column| !is_zero(column)));
        columns.retain(|column| !is_zero(column));
        columns.iter_mut().for_each(|column| self.scale(column));
        columns
    }

    pub(super) fn frame(&self, state: &Edits, live: &[bool]) -> Frame {
        let values = self.run(state);
        let errors = self.errors(&values);
        let (mut unknowns, mut adjoints) = (self.unknowns(state, live), Vec::new());
        let columns = self.jacobian(state, &values, &mut unknowns, Some(&mut adjoints));
        // Where an error is large already, more counts more.
        let blocks = self.samples.blocks(&errors);
        let weights: Vec<f64> = blocks.iter().map(|error| 0.3 + error).collect();
        let sketched = |size: usize| {
            let sketch = |column: &Vec<f64>| self.sketch(column, &weights, size);
            let columns: Vec<Vec<f64>> = columns.iter().map(sketch).collect();
            let factor = normal(&columns, &unknowns);
            ColumnSketch {
                size,
                inverse: factor.inverse(),
                columns,
                factor,
            }
        };
        let reached = |column: &Vec<f64>| {
            let results = column.chunks_exact(self.samples.len()).enumerate();
            let changed = results.filter(|(_, rows)| !is_zero(rows));
            changed.map(|(result, _)| result).collect()
        };
        Frame {
            reached: columns.iter().map(reached).collect(),
            coarse: sketched(SKETCH),
            fine: sketched(self.sketch_size(unknowns.len())),
            values,
            errors,
            adjoints,
            unknowns,
            columns,
            weights,
        }
    }

    /// Returns the constants that nothing reads, or that an edit at a node replaces.
    pub(super) fn gone(frame: &Frame, live: &[bool], at: Option<usize>) -> Vec<usize> {
        let is_gone = |place: &usize| {
            let node = frame.unknowns[*place].node;
            !live[node] || at == Some(node)
        };
        (0..frame.unknowns.len()).filter(is_gone).collect()
    }

    /// Returns the sum of squares of sketched errors that constants leave.
    pub(super) fn squares(sketch: &ColumnSketch, rows: &[f64], gone: &[usize]) -> f64 {
        let columns = sketch.columns.iter();
        let right: Vec<f64> = columns.map(|column| dot(column, rows)).collect();
        let change = |&k: &usize| dot(&sketch.inverse[k], &right);
        let small = Factor::new(gone.len(), |a, b| sketch.inverse[gone[a]][gone[b]]);
        let lost = small.forward(gone.iter().map(change).collect());
        let taken = sketch.factor.forward(right);
        dot(rows, rows) - dot(&taken, &taken) + dot(&lost, &lost)
    }

    /// Returns the errors that constants leave to first order, and their changes.
    pub(super) fn left(&self, frame: &Frame, mut rows: Vec<f64>, gone: &[usize]) -> Remainder {
        let fine = &frame.fine;
        let sketch = self.sketch(&rows, &frame.weights, fine.size);
        let right = fine.columns.iter().map(|column| dot(column, &sketch));
        let mut change = fine.factor.solve(right.collect());
        let small = Factor::new(gone.len(), |a, b| fine.inverse[gone[a]][gone[b]]);
        let lost = small.solve(gone.iter().map(|&k| change[k]).collect());
        for (&k, x) in gone.iter().zip(&lost) {
            let pairs = change.iter_mut().zip(&fine.inverse[k]);
            pairs.for_each(|(change, entry)| *change -= x * entry);
        }
        gone.iter().for_each(|&k| change[k] = 0.0);
        let m = self.samples.len();
        for ((column, reached), x) in frame.columns.iter().zip(&frame.reached).zip(&change) {
            if *x != 0.0 {
                for &result in reached {
                    let rows = rows[result * m..][..m].iter_mut();
                    let pairs = rows.zip(&column[result * m..][..m]);
                    pairs.for_each(|(row, derivative)| *row -= x * derivative);
                }
            }
        }
        let (sum, worst) = self.summed(&self.samples.blocks(&rows));
        Remainder { sum, worst, change }
    }

    /// Corrects constants so that the largest error is small: least squares again and again, weighed by
    /// the errors (Lawson), by exact gradients and sketched squares. Returns the largest error.
    pub(super) fn polish(&self, state: &mut Edits, rounds: usize) -> f64 {
        let (mut live, block) = (Vec::new(), self.samples.block());
        self.net.price(state, &mut live);
        let mut best = (f64::INFINITY, state.clone());
        let mut levels = vec![1.0; self.truth.len() / block];
        for round in 0..=rounds {
            let values = self.run(state);
            let errors = self.errors(&values);
            let blocks = self.samples.blocks(&errors);
            let worst = blocks.iter().copied().fold(1e-300, f64::max);
            if worst < best.0 {
                best = (worst, state.clone());
            }
            if round == rounds {
                break;
            }
            let pairs = levels.iter_mut().zip(&blocks);
            pairs.for_each(|(level, error)| *level *= error / worst + 0.02);
            let scale = levels.len() as f64 / levels.iter().sum::<f64>();
            let levels_mut = levels.iter_mut();
            levels_mut.for_each(|level| *level = (*level * scale).max(1e-4));
            // Squares over sizes make a sum of squares a sum of sizes.
            let weight = |row: usize| {
                let share = errors[row].abs() / blocks[row / block].max(1e-12) + 0.05;
                (levels[row / block] / share).sqrt()
            };
            let weights: Vec<f64> = (0..errors.len()).map(weight).collect();
            let mut unknowns = self.unknowns(state, &live);
            let mut columns = self.jacobian(state, &values, &mut unknowns, None);
            for column in &mut columns {
                let pairs = column.iter_mut().zip(&weights);
                pairs.for_each(|(x, weight)| *x *= weight);
            }
            let rows: Vec<f64> = errors.iter().zip(&weights).map(|(e, w)| e * w).collect();
            let right = columns.iter().map(|column| dot(column, &rows)).collect();
            let ones = vec![1.0; levels.len()];
            let size = self.sketch_size(unknowns.len());
            let sketch = |column: &Vec<f64>| self.sketch(column, &ones, size);
            let sketched: Vec<Vec<f64>> = columns.iter().map(sketch).collect();
            change(state, &unknowns, &normal(&sketched, &unknowns).solve(right));
        }
        *state = best.1;
        best.0
    }
}

/// Returns the factor of the normal equations of least squares, with a prior for each unknown.
fn normal(columns: &[Vec<f64>], unknowns: &[Unknown]) -> Factor {
    Factor::new(columns.len(), |a, b| {
        let square = unknowns[a].inertia.powi(2);
        dot(&columns[a], &columns[b]) + if a == b { square } else { 0.0 }
    })
}

pub(super) fn change(state: &mut Edits, unknowns: &[Unknown], change: &[f64]) {
    for (unknown, by) in unknowns.iter().zip(change) {
        match unknown.place {
            ConstantPlace::Arg(step, side) => {
                if let Arg::Constant(c) = &mut state.ops[step].args[side] {
                    *c -= by;
                }
            }
            ConstantPlace::Edit(node) => {
                if let Some(NodeValue::Constant(c) | NodeValue::Times(c, _)) =
                    &mut state.edits[node]
                {
                    *c -= by;
                }
            }
        }
    }
}

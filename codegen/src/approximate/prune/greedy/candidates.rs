//! What may stand in a value's place.

use crate::approximate::motions::Motions;
use crate::approximate::prune::columns::{Nodes, Value};
use crate::approximate::prune::fit::{dot, sized};
use crate::program::Operation;

pub(super) fn candidates(nodes: &Nodes, node: usize, columns: &[f64]) -> Vec<Value> {
    let m = nodes.samples;
    let mut values = vec![Value::Known(0.0)];
    let column = &columns[node * m..][..m];
    let (low, high) = column
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &x| {
            (l.min(x), h.max(x))
        });
    let mid = 0.5 * (low + high);
    if mid.abs() > 0.2 * (high - low) {
        // Few bits: a literal that can be read.
        values.push(Value::Known(f64::from(mid as f32)));
    }
    if let Some(index) = node.checked_sub(nodes.inputs.len()) {
        let step = &nodes.steps[index];
        if step.operation != Operation::Mul {
            let minus = step.operation == Operation::Sub;
            let [left, right] = step.operands;
            values.extend([left, right.negated_if(minus)]);
        }
    }
    values
}

const LEAST: f64 = 0.5;

/// Values that run alike: a place can take another value whose own work is
/// done anyway, constants that scale it are corrected.
pub(super) struct Alike {
    directions: Vec<Option<Vec<f64>>>,
    most: usize,
}

impl Alike {
    pub(super) fn new(
        nodes: &Nodes,
        columns: &[f64],
        live: &[bool],
        motions: &Motions,
        most: usize,
    ) -> Alike {
        let m = nodes.samples;
        let direction = |node: usize| {
            let (mut column, size) = sized(&columns[node * m..][..m], motions);
            column.iter_mut().for_each(|x| *x /= size);
            (size > 0.0).then_some(column)
        };
        let directions = (0..nodes.len()).map(|node| match most > 0 && live[node] {
            true => direction(node),
            false => None,
        });
        Alike {
            directions: directions.collect(),
            most,
        }
    }

    pub(super) fn of(&self, node: usize) -> Vec<Value> {
        let Some(mine) = &self.directions[node] else {
            return Vec::new();
        };
        let before = self.directions[..node].iter().enumerate();
        let mut alike: Vec<(f64, Value)> = before
            .filter_map(|(other, theirs)| {
                let cosine = dot(mine, theirs.as_ref()?);
                let value = Value::Node(other, cosine < 0.0);
                (cosine.abs() > LEAST).then_some((cosine.abs(), value))
            })
            .collect();
        alike.sort_by(|a, b| b.0.total_cmp(&a.0));
        alike.truncate(self.most);
        alike.into_iter().map(|(_, value)| value).collect()
    }
}

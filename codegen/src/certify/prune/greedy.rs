//! Dropping by rank: the least error an operation saved goes first.

use super::columns::{Nodes, Value};
use super::price::{Scratch, price};
use crate::schedule::Operation;
use crate::simplify::random::Random;

/// A search at sampled states.
pub(super) struct Greedy<'a> {
    nodes: &'a Nodes,
    /// The full model's outputs, output after output.
    truth: &'a [f64],
    /// The largest admissible error of each output.
    allowances: Vec<f64>,
    scratch: Scratch,
    trial: Vec<f64>,
    dirty: Vec<bool>,
    /// Of the errors in the ranking: 1 adds them, more spreads them.
    power: i32,
}

/// A candidate and how it ranked.
#[derive(Clone, Copy)]
struct Ranked {
    node: usize,
    value: Value,
    score: f64,
}

/// The candidates that are ranked again before one is taken.
const AGAIN: usize = 24;

/// How many are taken before all are ranked again.
const FRESH: usize = 10;

impl<'a> Greedy<'a> {
    pub(super) fn new(
        nodes: &'a Nodes,
        truth: &'a [f64],
        allowances: Vec<f64>,
        power: i32,
    ) -> Self {
        Greedy {
            nodes,
            truth,
            allowances,
            scratch: Scratch::default(),
            trial: vec![0.0; nodes.len() * nodes.samples],
            dirty: Vec::new(),
            power,
        }
    }

    pub(super) fn price(&mut self, edits: &[Option<Value>]) -> u32 {
        price(self.nodes, edits, &mut self.scratch)
    }

    /// The worst sampled error against its allowance.
    pub(super) fn worst(&self, edits: &[Option<Value>]) -> f64 {
        self.potential(&self.nodes.run(edits)).1
    }

    /// Edits until nothing admissible saves anything. `noise` blurs the
    /// ranking.
    pub(super) fn drop_all(
        &mut self,
        edits: &mut [Option<Value>],
        noise: f64,
        random: &mut Random,
    ) {
        loop {
            let columns = self.nodes.run(edits);
            let mut ranked = self.rank_all(edits, &columns, noise, random);
            if ranked.is_empty() {
                return;
            }
            ranked.sort_by(|a, b| a.score.total_cmp(&b.score));
            let mut columns = columns;
            let mut taken = 0;
            while taken < FRESH {
                let before = self.potential(&columns).0;
                let paid = self.price(edits);
                let live = self.scratch.live().to_vec();
                ranked.retain(|c| edits[c.node].is_none() && live[c.node]);
                let mut best: Option<usize> = None;
                for k in 0..ranked.len().min(AGAIN) {
                    let (node, value) = (ranked[k].node, ranked[k].value);
                    let score = self.score(edits, &columns, node, value, before, paid);
                    ranked[k].score =
                        score.unwrap_or(f64::INFINITY) * (1.0 + noise * random.unit());
                    if ranked[k].score < best.map_or(f64::INFINITY, |b| ranked[b].score) {
                        best = Some(k);
                    }
                }
                let Some(best) = best else { break };
                edits[ranked[best].node] = Some(ranked[best].value);
                columns = self.nodes.run(edits);
                taken += 1;
                ranked.retain(|c| c.score.is_finite());
                ranked.sort_by(|a, b| a.score.total_cmp(&b.score));
            }
            if taken == 0 {
                return;
            }
        }
    }

    /// Takes back what saves nothing.
    pub(super) fn restore_idle(&mut self, edits: &mut [Option<Value>]) {
        let mut paid = self.price(edits);
        for node in (0..edits.len()).rev() {
            if edits[node].is_some() {
                let kept = edits[node].take();
                let price = self.price(edits);
                if price > paid {
                    edits[node] = kept;
                } else {
                    paid = price;
                }
            }
        }
    }

    fn rank_all(
        &mut self,
        edits: &mut [Option<Value>],
        columns: &[f64],
        noise: f64,
        random: &mut Random,
    ) -> Vec<Ranked> {
        let before = self.potential(columns).0;
        let paid = self.price(edits);
        let live = self.scratch.live().to_vec();
        let mut ranked = Vec::new();
        for node in 0..self.nodes.len() {
            if edits[node].is_some() || !live[node] {
                continue;
            }
            for value in self.candidates(node, columns) {
                if let Some(score) = self.score(edits, columns, node, value, before, paid) {
                    let score = score * (1.0 + noise * random.unit());
                    ranked.push(Ranked { node, value, score });
                }
            }
        }
        ranked
    }

    fn candidates(&self, node: usize, columns: &[f64]) -> Vec<Value> {
        let m = self.nodes.samples;
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
        if let Some(index) = node.checked_sub(self.nodes.inputs.len()) {
            let op = self.nodes.ops[index];
            if op.operation != Operation::Mul {
                values.push(op.left);
                values.push(match (op.operation, op.right) {
                    (Operation::Sub, Value::Node(right, _)) => Value::Node(right, true),
                    (Operation::Sub, Value::Known(c)) => Value::Known(-c),
                    (_, right) => right,
                });
            }
        }
        values
    }

    /// The growth of the error an operation saved; `None` if it saves
    /// nothing or goes too far.
    fn score(
        &mut self,
        edits: &mut [Option<Value>],
        columns: &[f64],
        node: usize,
        value: Value,
        before: f64,
        paid: u32,
    ) -> Option<f64> {
        edits[node] = Some(value);
        let price = self.price(edits);
        let score = (price < paid)
            .then(|| self.retry(edits, columns, node))
            .filter(|&(_, worst)| worst <= 1.0)
            .map(|(after, _)| {
                // Never free, so that more saved ranks first among equals.
                ((after - before).max(0.0) + 1e-9) / f64::from(paid - price)
            });
        edits[node] = None;
        score
    }

    /// The potential if a node's edit is new and the columns are not.
    fn retry(&mut self, edits: &[Option<Value>], columns: &[f64], node: usize) -> (f64, f64) {
        let (m, inputs) = (self.nodes.samples, self.nodes.inputs.len());
        self.dirty.clear();
        self.dirty.resize(self.nodes.len(), false);
        self.dirty[node] = true;
        let mut trial = std::mem::take(&mut self.trial);
        trial[..node * m].copy_from_slice(&columns[..node * m]);
        for k in node..self.nodes.len() {
            let is_dirty =
                |value: Value| matches!(value, Value::Node(n, _) if self.dirty[n as usize]);
            let dirty = k == node
                || match edits[k] {
                    Some(value) => is_dirty(value),
                    None if k < inputs => false,
                    None => {
                        let op = self.nodes.ops[k - inputs];
                        is_dirty(op.left) || is_dirty(op.right)
                    }
                };
            let (before, rest) = trial.split_at_mut(k * m);
            if dirty {
                self.dirty[k] = true;
                self.nodes.node(k, edits[k], before, &mut rest[..m]);
            } else {
                rest[..m].copy_from_slice(&columns[k * m..][..m]);
            }
        }
        let result = self.potential(&trial);
        self.trial = trial;
        result
    }

    /// Σ (error/allowance)^power, and the worst error/allowance.
    fn potential(&self, columns: &[f64]) -> (f64, f64) {
        let m = self.nodes.samples;
        let (mut sum, mut worst) = (0.0, 0.0f64);
        for (output, (&value, allowance)) in
            self.nodes.outputs.iter().zip(&self.allowances).enumerate()
        {
            let truth = &self.truth[output * m..][..m];
            let error = match value {
                Value::Known(c) => truth.iter().fold(0.0f64, |e, t| e.max((c - t).abs())),
                Value::Node(node, negative) => {
                    let column = &columns[node as usize * m..][..m];
                    let sign = if negative { -1.0 } else { 1.0 };
                    let pairs = column.iter().zip(truth);
                    pairs.fold(0.0f64, |e, (x, t)| e.max((sign * x - t).abs()))
                }
            };
            let relative = if error <= 1e-13 {
                0.0
            } else {
                error / allowance
            };
            sum += relative.powi(self.power);
            worst = worst.max(relative);
        }
        (sum, worst)
    }
}

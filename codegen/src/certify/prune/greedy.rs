//! Dropping by rank: the least error an operation saved goes first.

use super::columns::{Nodes, Value};
use super::fit::Fit;
use super::motions::Motions;
use super::price::{Scratch, price};
use crate::certify::edits::Edit;
use crate::schedule::Operation;
use crate::simplify::random::Random;

/// A program with its edits and its constants as they are now.
#[derive(Clone)]
pub(super) struct State {
    pub nodes: Nodes,
    pub edits: Vec<Option<Value>>,
}

/// A search at sampled states.
pub(super) struct Greedy<'a> {
    motions: &'a Motions,
    /// The full model's outputs, output after output.
    truth: &'a [f64],
    /// The largest admissible error of each output.
    allowances: Vec<f64>,
    /// Of the least squares, row by row: 1/allowance, and more where errors
    /// are largest.
    weights: Vec<f64>,
    /// Of each output at each position.
    levels: Vec<f64>,
    scratch: Scratch,
    trial: Vec<f64>,
    dirty: Vec<bool>,
    /// What an output's error weighs in the ranking.
    prices: Vec<f64>,
    /// Whether constants are corrected.
    refit: bool,
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

/// In place of an allowance of zero, where nothing may go.
const TINY: f64 = 1e-12;

/// How many are taken before all are ranked again.
const FRESH: usize = 10;

impl<'a> Greedy<'a> {
    pub(super) fn new(
        nodes: &Nodes,
        motions: &'a Motions,
        truth: &'a [f64],
        allowances: Vec<f64>,
        prices: Vec<f64>,
        refit: bool,
    ) -> Self {
        let m = nodes.samples;
        let weights: Vec<f64> = allowances
            .iter()
            .flat_map(|a| vec![1.0 / a.max(TINY); m])
            .collect();
        Greedy {
            motions,
            truth,
            allowances,
            levels: vec![1.0; weights.len() / motions.len()],
            weights,
            scratch: Scratch::default(),
            trial: vec![0.0; nodes.len() * m],
            dirty: Vec::new(),
            prices,
            refit,
        }
    }

    pub(super) fn price(&mut self, state: &State) -> u32 {
        price(&state.nodes, &state.edits, &mut self.scratch)
    }

    /// The worst sampled error against its allowance.
    pub(super) fn worst(&self, state: &State) -> f64 {
        let columns = state.nodes.run(&state.edits);
        self.potential(&self.errors(&state.nodes, &columns)).1
    }

    /// The worst sampled error of each output against its allowance.
    pub(super) fn relative(&self, state: &State) -> Vec<f64> {
        let errors = self.errors(&state.nodes, &state.nodes.run(&state.edits));
        let outputs = errors
            .chunks_exact(state.nodes.samples)
            .zip(&self.allowances);
        outputs
            .map(|(errors, allowance)| {
                let blocks = errors.chunks_exact(self.motions.len());
                let most = blocks.fold(0.0, |e, block| f64::max(e, self.motions.largest(block)));
                (most / allowance.max(TINY)).min(4.0)
            })
            .collect()
    }

    /// Edits until nothing admissible saves anything. `noise` blurs the
    /// ranking.
    pub(super) fn drop_all(&mut self, state: &mut State, noise: f64, random: &mut Random) {
        let mut columns = state.nodes.run(&state.edits);
        let mut fit = self.fit(state, &columns);
        let mut refused = vec![false; state.nodes.len()];
        loop {
            let mut ranked = self.rank_all(state, &columns, &fit, &refused, noise, random);
            if ranked.is_empty() {
                return;
            }
            ranked.sort_by(|a, b| a.score.total_cmp(&b.score));
            let mut taken = 0;
            while taken < FRESH {
                let before = self.settled(state, &columns, &fit);
                let paid = self.price(state);
                let live = self.scratch.live().to_vec();
                ranked
                    .retain(|c| state.edits[c.node].is_none() && live[c.node] && !refused[c.node]);
                let mut best: Option<usize> = None;
                for k in 0..ranked.len().min(AGAIN) {
                    let (node, value) = (ranked[k].node, ranked[k].value);
                    let score = self.score(state, &columns, &fit, (node, value), (before, paid));
                    ranked[k].score =
                        score.unwrap_or(f64::INFINITY) * (1.0 + noise * random.unit());
                    if ranked[k].score < best.map_or(f64::INFINITY, |b| ranked[b].score) {
                        best = Some(k);
                    }
                }
                let Some(best) = best else { break };
                let node = ranked[best].node;
                let kept = state.nodes.ops.clone();
                state.edits[node] = Some(ranked[best].value);
                let fresh = self.fit(state, &state.nodes.run(&state.edits));
                columns = self.correct(state, &fresh);
                if self.potential(&self.errors(&state.nodes, &columns)).1 > 1.0 {
                    // Constants cannot make up for it as hoped.
                    state.edits[node] = None;
                    state.nodes.ops = kept;
                    columns = state.nodes.run(&state.edits);
                    refused[node] = true;
                } else {
                    fit = self.fit(state, &columns);
                }
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
    pub(super) fn restore_idle(&mut self, state: &mut State) {
        let mut paid = self.price(state);
        for node in (0..state.edits.len()).rev() {
            if state.edits[node].is_some() {
                let kept = state.edits[node].take();
                let price = self.price(state);
                if price > paid {
                    state.edits[node] = kept;
                } else {
                    paid = price;
                }
            }
        }
    }

    /// The last steps: idle edits go, constants are corrected and shortened.
    pub(super) fn settle(&mut self, state: &mut State, original: &Nodes, rounds: usize) {
        self.restore_idle(state);
        self.polish(state, rounds);
        state.nodes.shorten(original);
    }

    /// The edits as the program knows them; constants that nothing reads any
    /// more are not among them.
    pub(super) fn edits(&mut self, original: &Nodes, state: &State) -> Vec<Edit> {
        let mut state = state.clone();
        self.price(&state);
        let inputs = state.nodes.inputs.len();
        for (index, was) in original.ops.iter().enumerate() {
            if !self.scratch.live()[inputs + index] {
                state.nodes.ops[index] = *was;
            }
        }
        state.nodes.edits(original, &state.edits)
    }

    /// Corrects constants until the worst error shrinks no more.
    pub(super) fn polish(&mut self, state: &mut State, rounds: usize) {
        if !self.refit {
            return;
        }
        self.price(state);
        let mut best = (self.worst(state), state.nodes.ops.clone());
        for _ in 0..rounds {
            let columns = state.nodes.run(&state.edits);
            let fit = self.fit(state, &columns);
            self.correct(state, &fit);
            let worst = self.worst(state);
            if worst < best.0 {
                best = (worst, state.nodes.ops.clone());
            }
            self.reweigh(state);
        }
        state.nodes.ops = best.1;
    }

    /// Rows with large errors count more next time (Lawson).
    fn reweigh(&mut self, state: &State) {
        let columns = state.nodes.run(&state.edits);
        let errors = self.errors(&state.nodes, &columns);
        let (_, worst) = self.potential(&errors);
        if worst <= 0.0 {
            return;
        }
        let (m, block) = (state.nodes.samples, self.motions.len());
        let mut total = 0.0;
        for (index, errors) in errors.chunks_exact(block).enumerate() {
            let allowance = self.allowances[index * block / m].max(TINY);
            let largest = self.motions.largest(errors);
            let level = &mut self.levels[index];
            *level *= largest / allowance / worst + 0.02;
            total += *level;
        }
        let scale = self.levels.len() as f64 / total;
        for (index, errors) in errors.chunks_exact(block).enumerate() {
            let allowance = self.allowances[index * block / m].max(TINY);
            let largest = self.motions.largest(errors);
            let level = &mut self.levels[index];
            *level = (*level * scale).max(1e-4);
            for (weight, error) in self.weights[index * block..].iter_mut().zip(errors) {
                // Squares over sizes make a sum of squares a sum of sizes.
                let share = error.abs() / largest.max(1e-12 * allowance) + 0.05;
                *weight = (*level / share).sqrt() / allowance;
            }
        }
    }

    fn fit(&mut self, state: &State, columns: &[f64]) -> Option<Fit> {
        self.price(state);
        let live = self.scratch.live();
        self.refit.then(|| {
            Fit::new(
                &state.nodes,
                &state.edits,
                live,
                columns,
                self.motions,
                &self.weights,
            )
        })
    }

    /// Changes constants against the errors of the edits; the new columns.
    fn correct(&self, state: &mut State, fit: &Option<Fit>) -> Vec<f64> {
        let columns = state.nodes.run(&state.edits);
        let Some(fit) = fit else { return columns };
        let mut errors = self.errors(&state.nodes, &columns);
        let before = self.potential(&errors).1;
        for (error, weight) in errors.iter_mut().zip(&self.weights) {
            *error *= weight;
        }
        let kept = state.nodes.ops.clone();
        for ((op, right), change) in fit.changes(&errors) {
            let op = &mut state.nodes.ops[op];
            let operand = if right { &mut op.right } else { &mut op.left };
            if let Value::Known(c) = operand {
                *c += change;
            }
        }
        let after = state.nodes.run(&state.edits);
        let worst = self.potential(&self.errors(&state.nodes, &after)).1;
        if worst < before || worst <= 1.0 && before <= 1.0 {
            return after;
        }
        state.nodes.ops = kept;
        columns
    }

    fn rank_all(
        &mut self,
        state: &mut State,
        columns: &[f64],
        fit: &Option<Fit>,
        refused: &[bool],
        noise: f64,
        random: &mut Random,
    ) -> Vec<Ranked> {
        let before = self.settled(state, columns, fit);
        let paid = self.price(state);
        let live = self.scratch.live().to_vec();
        let mut ranked = Vec::new();
        for node in 0..state.nodes.len() {
            if state.edits[node].is_some() || !live[node] || refused[node] {
                continue;
            }
            for value in candidates(&state.nodes, node, columns) {
                if let Some(score) = self.score(state, columns, fit, (node, value), (before, paid))
                {
                    let score = score * (1.0 + noise * random.unit());
                    ranked.push(Ranked { node, value, score });
                }
            }
        }
        ranked
    }

    /// The growth of the error an operation saved; `None` if it saves
    /// nothing or goes too far.
    fn score(
        &mut self,
        state: &mut State,
        columns: &[f64],
        fit: &Option<Fit>,
        (node, value): (usize, Value),
        (before, paid): (f64, u32),
    ) -> Option<f64> {
        state.edits[node] = Some(value);
        let price = self.price(state);
        let score = (price < paid)
            .then(|| self.retry(state, columns, fit, node))
            .filter(|&(_, worst)| worst <= 1.0)
            .map(|(after, _)| {
                // Never free, so that more saved ranks first among equals.
                ((after - before).max(0.0) + 1e-9) / f64::from(paid - price)
            });
        state.edits[node] = None;
        score
    }

    /// The potential if a node's edit is new and the columns are not.
    fn retry(
        &mut self,
        state: &State,
        columns: &[f64],
        fit: &Option<Fit>,
        node: usize,
    ) -> (f64, f64) {
        let nodes = &state.nodes;
        let (m, inputs) = (nodes.samples, nodes.inputs.len());
        self.dirty.clear();
        self.dirty.resize(nodes.len(), false);
        self.dirty[node] = true;
        let mut trial = std::mem::take(&mut self.trial);
        trial[..node * m].copy_from_slice(&columns[..node * m]);
        for k in node..nodes.len() {
            let is_dirty =
                |value: Value| matches!(value, Value::Node(n, _) if self.dirty[n as usize]);
            let dirty = k == node
                || match state.edits[k] {
                    Some(value) => is_dirty(value),
                    None if k < inputs => false,
                    None => {
                        let op = nodes.ops[k - inputs];
                        is_dirty(op.left) || is_dirty(op.right)
                    }
                };
            let (before, rest) = trial.split_at_mut(k * m);
            if dirty {
                self.dirty[k] = true;
                nodes.node(k, state.edits[k], before, &mut rest[..m]);
            } else {
                rest[..m].copy_from_slice(&columns[k * m..][..m]);
            }
        }
        let result = self.settled_both(state, &trial, fit);
        self.trial = trial;
        result
    }

    fn settled(&self, state: &State, columns: &[f64], fit: &Option<Fit>) -> f64 {
        self.settled_both(state, columns, fit).0
    }

    /// The potential after constants are corrected.
    fn settled_both(&self, state: &State, columns: &[f64], fit: &Option<Fit>) -> (f64, f64) {
        let mut errors = self.errors(&state.nodes, columns);
        if let Some(fit) = fit {
            let plain = self.potential(&errors);
            for (error, weight) in errors.iter_mut().zip(&self.weights) {
                *error *= weight;
            }
            let live = self.scratch.live();
            let inputs = state.nodes.inputs.len();
            fit.project(&mut errors, |op| !live[inputs + op]);
            for (error, weight) in errors.iter_mut().zip(&self.weights) {
                *error /= weight;
            }
            let settled = self.potential(&errors);
            return if plain.1 < settled.1 { plain } else { settled };
        }
        self.potential(&errors)
    }

    /// Output after output, position after position: monomials.
    fn errors(&self, nodes: &Nodes, columns: &[f64]) -> Vec<f64> {
        let mut errors = nodes.values(columns);
        for (error, truth) in errors.iter_mut().zip(self.truth) {
            *error -= truth;
        }
        self.motions.monomials(&mut errors);
        errors
    }

    /// Σ price·error/allowance, and the worst error/allowance.
    fn potential(&self, errors: &[f64]) -> (f64, f64) {
        let m = errors.len() / self.allowances.len();
        let (mut sum, mut worst) = (0.0, 0.0f64);
        let outputs = self.allowances.iter().zip(&self.prices);
        for (errors, (allowance, price)) in errors.chunks_exact(m).zip(outputs) {
            let blocks = errors.chunks_exact(self.motions.len());
            let error = blocks.fold(0.0f64, |e, block| e.max(self.motions.largest(block)));
            let relative = if error <= 1e-13 {
                0.0
            } else {
                error / allowance
            };
            sum += price * relative;
            worst = worst.max(relative);
        }
        (sum, worst)
    }
}

fn candidates(nodes: &Nodes, node: usize, columns: &[f64]) -> Vec<Value> {
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
        let op = nodes.ops[index];
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

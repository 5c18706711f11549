//! Candidates ranked by the error that an operation saved costs.

use super::candidates::{Alike, candidates};
use super::measure::Attempt;
use super::{Greedy, Ranked, State};
use crate::approximate::prune::columns::Value;
use crate::approximate::prune::fit::{Fit, LANES};
use crate::approximate::prune::spares::MOST;
use crate::random::Random;

/// Errors in units of the allowance at which a candidate is not looked at any
/// more: the other edits' are at most one, and cannot make up for it.
const HOPELESS: f64 = 5.0;

/// Shares of the allowances grow from one guess to the next by less than this.
const MARGIN: f64 = 2.0;

impl Greedy<'_> {
    pub(super) fn rank_all(
        &mut self,
        state: &mut State,
        columns: &[f64],
        fit: &Fit,
        refused: &[bool],
        noise: f64,
        random: &mut Random,
    ) -> Vec<Ranked> {
        let before = self.settled(state, columns, fit).sum;
        let paid = self.price(state);
        let live = self.scratch.live.clone();
        let alike = Alike::new(&state.nodes, columns, &live, self.motions, self.alike);
        let mut all = Vec::new();
        let inputs = state.nodes.inputs.len();
        for node in 0..state.nodes.len() {
            if state.edits[node].is_some() || !live[node] || refused[node] {
                continue;
            }
            let mut values = candidates(&state.nodes, node, columns);
            for value in alike.of(node) {
                if !values.contains(&value) {
                    values.push(value);
                }
            }
            // Right before a value stand its spares, which nothing reads yet.
            let spares = (inputs..node).rev().take_while(|&spare| !live[spare]);
            values.extend(spares.take(MOST).map(|n| Value::Node(n, false)));
            let hopeless = &self.hopeless[node];
            values.retain(|value| !hopeless.iter().any(|other| value.is_like(other)));
            all.extend(values.into_iter().map(|value| (node, value)));
        }
        let scores = self.scores(state, columns, fit, &all, (before, paid));
        let pairs = all.into_iter().zip(scores);
        let ranked = pairs.filter_map(|((node, value), score)| {
            let score = score? * (1.0 + noise * random.unit());
            // An edit puts no input in an input's place: over narrow ranges they are alike.
            let is_edit = node >= inputs || matches!(value, Value::Known(_));
            is_edit.then_some(Ranked { node, value, score })
        });
        ranked.collect()
    }

    pub(super) fn scores(
        &mut self,
        state: &mut State,
        columns: &[f64],
        fit: &Fit,
        candidates: &[(usize, Value)],
        (before, paid): (f64, u32),
    ) -> Vec<Option<f64>> {
        let mut scores = vec![None; candidates.len()];
        self.trial.clear();
        self.trial.extend_from_slice(columns);
        for (candidates, scores) in candidates.chunks(LANES).zip(scores.chunks_mut(LANES)) {
            let mut attempts = Vec::new();
            let mut saved = Vec::new();
            for (index, &(node, value)) in candidates.iter().enumerate() {
                state.edits[node] = Some(value);
                let price = self.price(state);
                if price < paid {
                    attempts.push(self.retry(state, columns, fit, node));
                    saved.push((index, f64::from(paid - price)));
                }
                state.edits[node] = None;
            }
            self.make_up(fit, &mut attempts);
            for (Attempt { potential, .. }, (index, saved)) in attempts.iter().zip(saved) {
                let (node, value) = candidates[index];
                if potential.worst <= 1.0 {
                    // Never free, so that more saved ranks first among equals.
                    let growth = (potential.sum - before).max(0.0) + 1e-9;
                    scores[index] = Some(growth / saved);
                } else if potential.worst > HOPELESS {
                    self.hopeless[node].push(value);
                    if potential.worst > MARGIN * HOPELESS {
                        self.never[node].push(value);
                    }
                }
            }
        }
        scores
    }

    /// Expects `trial` to be a copy of `columns`, which are from before the edit.
    fn retry(&mut self, state: &State, columns: &[f64], fit: &Fit, node: usize) -> Attempt {
        let nodes = &state.nodes;
        let (m, inputs) = (nodes.samples, nodes.inputs.len());
        self.dirty.clear();
        self.dirty.resize(nodes.len(), false);
        let mut trial = std::mem::take(&mut self.trial);
        for k in node..nodes.len() {
            let is_dirty = |value: Value| matches!(value, Value::Node(n, _) if self.dirty[n]);
            let dirty = k == node
                || match state.edits[k] {
                    Some(value) => is_dirty(value),
                    None if k < inputs => false,
                    None => nodes.steps[k - inputs].operands.into_iter().any(is_dirty),
                };
            if dirty {
                self.dirty[k] = true;
                let (before, rest) = trial.split_at_mut(k * m);
                nodes.node(k, state.edits[k], before, &mut rest[..m]);
            }
        }
        let attempt = self.attempt(state, &trial, fit);
        for k in (node..nodes.len()).filter(|&k| self.dirty[k]) {
            trial[k * m..][..m].copy_from_slice(&columns[k * m..][..m]);
        }
        self.trial = trial;
        attempt
    }
}

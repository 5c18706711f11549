//! Candidates ranked by the error that an operation saved costs.

use super::candidates::{Alike, candidates};
use super::{Greedy, Ranked, State};
use crate::certify::prune::columns::Value;
use crate::certify::prune::fit::Fit;
use crate::simplify::random::Random;

impl Greedy<'_> {
    /// Every admissible candidate.
    pub(super) fn rank_all(
        &mut self,
        state: &mut State,
        columns: &[f64],
        fit: &Option<Fit>,
        refused: &[bool],
        noise: f64,
        random: &mut Random,
    ) -> Vec<Ranked> {
        self.mirror(columns);
        let before = self.settled(state, columns, fit);
        let paid = self.price(state);
        let live = self.scratch.live().to_vec();
        let alike = Alike::new(&state.nodes, columns, &live, self.motions, self.alike);
        let mut ranked = Vec::new();
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
            for value in values {
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
    pub(super) fn score(
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

    /// Takes the columns that candidates are tried on.
    pub(super) fn mirror(&mut self, columns: &[f64]) {
        self.trial.clear();
        self.trial.extend_from_slice(columns);
    }

    /// The potential if a node's edit is new and the columns, which are
    /// [mirrored](Self::mirror), are not.
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
        let mut trial = std::mem::take(&mut self.trial);
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
            if dirty {
                self.dirty[k] = true;
                let (before, rest) = trial.split_at_mut(k * m);
                nodes.node(k, state.edits[k], before, &mut rest[..m]);
            }
        }
        let result = self.settled_both(state, &trial, fit);
        for k in (node..nodes.len()).filter(|&k| self.dirty[k]) {
            trial[k * m..][..m].copy_from_slice(&columns[k * m..][..m]);
        }
        self.trial = trial;
        result
    }
}

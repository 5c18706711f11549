//! Constants corrected for what is left out.

use super::{Greedy, State, TINY};
use crate::approximate::prune::columns::Value;
use crate::approximate::prune::fit::Fit;

impl Greedy<'_> {
    pub(in crate::approximate::prune) fn polish(&mut self, state: &mut State, rounds: usize) {
        self.price(state);
        let mut columns = state.nodes.run(&state.edits);
        let worst = self.potential(&self.errors(&state.nodes, &columns)).worst;
        let mut best = (worst, state.nodes.steps.clone());
        for _ in 0..rounds {
            let fit = self.fit(state, &columns);
            columns = self.correct(state, columns, &fit);
            let errors = self.errors(&state.nodes, &columns);
            let worst = self.potential(&errors).worst;
            if worst < best.0 {
                best = (worst, state.nodes.steps.clone());
            }
            self.reweigh(state, &errors, worst);
        }
        state.nodes.steps = best.1;
    }

    /// Makes rows with large errors count more next time (Lawson).
    fn reweigh(&mut self, state: &State, errors: &[f64], worst: f64) {
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

    pub(super) fn fit(&mut self, state: &State, columns: &[f64]) -> Fit {
        self.price(state);
        let (live, weights) = (&self.scratch.live, &self.weights);
        let State { nodes, edits } = state;
        Fit::new(nodes, edits, live, columns, self.motions, weights)
    }

    /// `None`, with the constants as they were, if they cannot make up for the edits.
    pub(super) fn corrected(
        &mut self,
        state: &mut State,
        edited: Vec<f64>,
        fit: &Fit,
    ) -> Option<Vec<f64>> {
        self.price(state);
        let kept = state.nodes.steps.clone();
        let columns = self.correct(state, edited, fit);
        if self.potential(&self.errors(&state.nodes, &columns)).worst <= 1.0 {
            return Some(columns);
        }
        state.nodes.steps = kept;
        None
    }

    fn correct(&self, state: &mut State, columns: Vec<f64>, fit: &Fit) -> Vec<f64> {
        let gone = self.gone(state, fit);
        let mut errors = self.errors(&state.nodes, &columns);
        let before = self.potential(&errors).worst;
        for (error, weight) in errors.iter_mut().zip(&self.weights) {
            *error *= weight;
        }
        let kept = state.nodes.steps.clone();
        for ((step, side), change) in fit.changes(&errors, &gone) {
            if let Value::Known(c) = &mut state.nodes.steps[step].operands[side] {
                *c += change;
            }
        }
        let after = state.nodes.run(&state.edits);
        let worst = self.potential(&self.errors(&state.nodes, &after)).worst;
        if worst < before || worst <= 1.0 && before <= 1.0 {
            return after;
        }
        state.nodes.steps = kept;
        columns
    }
}

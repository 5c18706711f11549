//! How large errors are at the samples, and how large once constants are
//! corrected.

use super::{Greedy, State, TINY};
use crate::certify::prune::columns::Nodes;
use crate::certify::prune::fit::Fit;

impl Greedy<'_> {
    /// The worst sampled error of each output against its allowance.
    pub(in crate::certify::prune) fn relative(&self, state: &State) -> Vec<f64> {
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

    pub(super) fn settled(&self, state: &State, columns: &[f64], fit: &Option<Fit>) -> f64 {
        self.settled_both(state, columns, fit).0
    }

    /// The potential after constants are corrected.
    pub(super) fn settled_both(
        &self,
        state: &State,
        columns: &[f64],
        fit: &Option<Fit>,
    ) -> (f64, f64) {
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
    pub(super) fn errors(&self, nodes: &Nodes, columns: &[f64]) -> Vec<f64> {
        let mut errors = nodes.values(columns);
        for (error, truth) in errors.iter_mut().zip(self.truth) {
            *error -= truth;
        }
        self.motions.monomials(&mut errors);
        errors
    }

    /// Σ price·error/allowance, and the worst error/allowance.
    pub(super) fn potential(&self, errors: &[f64]) -> (f64, f64) {
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

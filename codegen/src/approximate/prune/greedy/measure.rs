//! How large errors are at the samples, and how large once constants are
//! corrected.

use super::{Greedy, State, TINY};
use crate::approximate::prune::columns::Nodes;
use crate::approximate::prune::fit::{Fit, Trial};
use crate::bound::work;

/// Errors of a variant at states that take about a unit of work, with the run that they are from.
const MEASURED: usize = 8;

#[derive(Clone, Copy, Debug)]
pub(super) struct Potential {
    /// Σ price·error/allowance.
    pub sum: f64,
    pub worst: f64,
}

pub(super) struct Attempt {
    pub potential: Potential,
    trial: Trial,
}

impl Greedy<'_> {
    pub(in crate::approximate::prune) fn relative(&self, state: &State) -> Vec<f64> {
        let errors = self.errors(&state.nodes, &state.nodes.run(&state.edits));
        let outputs = errors
            .chunks_exact(state.nodes.samples)
            .zip(&self.allowances);
        outputs
            .map(|(errors, allowance)| {
                let most = self.motions.largest_of(errors);
                (most / allowance.max(TINY)).min(4.0)
            })
            .collect()
    }

    pub(super) fn settled(&self, state: &State, columns: &[f64], fit: &Fit) -> Potential {
        let mut attempts = [self.attempt(state, columns, fit)];
        self.make_up(fit, &mut attempts);
        attempts[0].potential
    }

    pub(super) fn attempt(&self, state: &State, columns: &[f64], fit: &Fit) -> Attempt {
        let mut errors = self.errors(&state.nodes, columns);
        let potential = self.potential(&errors);
        for (error, weight) in errors.iter_mut().zip(&self.weights) {
            *error *= weight;
        }
        let gone = self.gone(state, fit);
        let trial = Trial { errors, gone };
        Attempt { potential, trial }
    }

    pub(super) fn gone(&self, state: &State, fit: &Fit) -> Vec<usize> {
        let (live, inputs) = (&self.scratch.live, state.nodes.inputs.len());
        fit.of_ops(|op| !live[inputs + op])
    }

    pub(super) fn make_up(&self, fit: &Fit, attempts: &mut [Attempt]) {
        let mut trials: Vec<&mut Trial> = attempts.iter_mut().map(|a| &mut a.trial).collect();
        fit.settle(&mut trials);
        for Attempt { potential, trial } in attempts {
            for (error, weight) in trial.errors.iter_mut().zip(&self.weights) {
                *error /= weight;
            }
            let settled = self.potential(&trial.errors);
            if settled.worst <= potential.worst {
                *potential = settled;
            }
        }
    }

    pub(super) fn errors(&self, nodes: &Nodes, columns: &[f64]) -> Vec<f64> {
        let mut errors = nodes.values(columns);
        for (error, truth) in errors.iter_mut().zip(self.truth) {
            *error -= truth;
        }
        self.motions.monomials(&mut errors);
        errors
    }

    pub(super) fn potential(&self, errors: &[f64]) -> Potential {
        work::count(1 + errors.len() / MEASURED);
        let m = errors.len() / self.allowances.len();
        let (mut sum, mut worst) = (0.0, 0.0f64);
        let outputs = self.allowances.iter().zip(&self.prices);
        for (errors, (allowance, price)) in errors.chunks_exact(m).zip(outputs) {
            let error = self.motions.largest_of(errors);
            let relative = if error <= 1e-13 {
                0.0
            } else {
                error / allowance
            };
            sum += price * relative;
            worst = worst.max(relative);
        }
        Potential { sum, worst }
    }
}

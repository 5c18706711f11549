//! Backward elimination: from all terms to the fewest that can be fitted.

use super::build::ReducedModel;
use super::fit::{Solution, TermFit};
use crate::parallel;

const MOST: f64 = 0.95;

/// Fits that are no worse than this may be made good enough.
const NEARLY: f64 = 1.25;

const ENOUGH: f64 = 0.2;

const COUNTED: usize = 8;
const TRIED: usize = 5;

pub(super) fn eliminate(
    builder: &ReducedModel<'_>,
    fit: &TermFit<'_>,
    is_over: &dyn Fn() -> bool,
) -> Vec<Solution> {
    let terms = &fit.terms.all;
    let is_single = |&term: &usize| terms[term].stands_for.is_none() && fit.is_something(term);
    let now: Vec<usize> = (0..terms.len()).filter(is_single).collect();
    let mut solution = fit.solve(&now, ENOUGH);
    let mut models = Vec::new();
    while !is_over() {
        let mut candidates = candidates(fit, &solution);
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        candidates.truncate(COUNTED);
        let paid = builder.price(&solution.terms);
        let prices = parallel::each(&candidates, |(_, other)| builder.price(other));
        for ((loss, _), price) in candidates.iter_mut().zip(prices) {
            let saved = paid.saturating_sub(price) as f64;
            *loss = (*loss + 1e-18) / (0.3 + saved).powi(2);
        }
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        candidates.truncate(TRIED);
        let next = candidates.into_iter().find_map(|(_, other)| {
            let trial = fit.solve(&other, ENOUGH);
            let model = match trial.error > MOST && trial.error < NEARLY {
                true => fit.refine(trial, MOST),
                false => trial,
            };
            (model.error <= MOST).then_some(model)
        });
        let Some(next) = next else { break };
        models.push(next.clone());
        solution = next;
    }
    models
}

fn candidates(fit: &TermFit<'_>, solution: &Solution) -> Vec<(f64, Vec<usize>)> {
    let now = &solution.terms;
    let mut candidates: Vec<(f64, Vec<usize>)> = Vec::new();
    for (place, &loss) in solution.saliency.iter().enumerate() {
        let mut other = now.to_vec();
        other.remove(place);
        candidates.push((loss, other));
    }
    for (tied, term) in fit.terms.all.iter().enumerate() {
        let Some(of) = term.stands_for.filter(|_| fit.is_something(tied)) else {
            continue;
        };
        let places = of.map(|single| now.iter().position(|&term| term == single));
        let [Some(a), Some(b)] = places else { continue };
        // The one that is left is the sum or the difference of both.
        let is_sum = tied == of[0] + 2;
        let sign = if is_sum { -1.0 } else { 1.0 };
        let gap = solution.factors[a] + sign * solution.factors[b];
        let inverse = |i: usize, j: usize| solution.inverse[i][j];
        let stiff = inverse(a, a) + inverse(b, b) + 2.0 * sign * inverse(a, b);
        let mut other = now.to_vec();
        other[a] = tied;
        other.remove(b);
        candidates.push((gap * gap / stiff, other));
    }
    candidates
}

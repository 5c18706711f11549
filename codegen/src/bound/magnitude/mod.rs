//! The largest magnitude of a graph's outputs over a box: written out as
//! trigonometric polynomials and at a grid (`grid`); if they are too large for that,
//! by branch and bound.
//!
//! - `boxes`: branch and bound; `forms`: over polynomials in the rates

mod boxes;
mod forms;

use crate::bound::distinct::Distinct;
use crate::bound::expand::{Polynomial, expand};
use crate::bound::grid::{self, Aim, GridEffort};
use crate::bound::input_box::InputBox;
use crate::dag::Dag;
use crate::parallel;
use boxes::branch_and_bound;

/// How much work a bound may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoxEffort {
    /// Sub-boxes evaluated at most.
    pub boxes: usize,
    /// Points of a grid at most; 0 for none.
    pub points: usize,
}

impl BoxEffort {
    /// For certificates.
    pub const CERTIFY: BoxEffort = BoxEffort {
        boxes: 300_000,
        points: 1 << 24,
    };
    /// For a search that asks often.
    pub const QUICK: BoxEffort = BoxEffort {
        boxes: 20_000,
        points: 1 << 22,
    };
}

/// Bounds of |output| over the box, one an output. `scales` say what a unit
/// of each output is worth: the largest |output|/scale is tightened.
pub fn magnitudes(graph: &Dag, whole: &InputBox, scales: &[f64], budget: BoxEffort) -> Vec<f64> {
    bounds(graph, whole, scales, budget, 0.0, |_| Aim::Least)
}

/// For a search only: stops as soon as a limit is proved. Above its limit a value is an estimate,
/// not a bound.
pub(crate) fn judged(graph: &Dag, whole: &InputBox, limits: &[f64], budget: BoxEffort) -> Vec<f64> {
    bounds(graph, whole, limits, budget, 1.0, Aim::Judged)
}

/// At a grid, the first output that is not shown to be at most its limit ends the search.
pub(crate) fn magnitudes_within(
    graph: &Dag,
    whole: &InputBox,
    limits: &[f64],
    budget: BoxEffort,
) -> Option<Vec<f64>> {
    let most = bounds(graph, whole, limits, budget, 1.0, Aim::Within);
    let within = most.iter().zip(limits).all(|(x, limit)| x <= limit);
    within.then_some(most)
}

fn bounds(
    graph: &Dag,
    whole: &InputBox,
    scales: &[f64],
    budget: BoxEffort,
    goal: f64,
    aim: fn(f64) -> Aim,
) -> Vec<f64> {
    // Equal outputs once: a sign does not matter to a magnitude; a scale does to the search.
    let pairs = graph.outputs.iter().zip(scales);
    let keys = pairs.map(|(edge, scale)| Some((edge.node, scale.to_bits())));
    let distinct = Distinct::by(keys);
    let scales = distinct.pick(scales);
    let graph = Dag {
        outputs: distinct.pick(&graph.outputs),
        ..graph.clone()
    };
    let aims = scales.iter().map(|&scale| aim(scale));
    let most = written_out(&graph, whole, aims, budget);
    let most = most.unwrap_or_else(|| branch_and_bound(&graph, whole, &scales, goal, budget));
    distinct.scatter(&most)
}

fn written_out(
    graph: &Dag,
    whole: &InputBox,
    aims: impl Iterator<Item = Aim>,
    budget: BoxEffort,
) -> Option<Vec<f64>> {
    if budget.points == 0 {
        return None;
    }
    let polynomials = expand(graph, whole)?;
    let sliding = grid::sliding(graph, whole.joints());
    let closeness = GridEffort::fine(budget.points);
    let bound = |(polynomial, aim): (&Polynomial, Aim)| {
        let polynomial = grid::harmonics(polynomial, whole.joints())?;
        Some(grid::magnitude(polynomial, whole, &sliding, aim, closeness))
    };
    let all: Vec<_> = polynomials.iter().zip(aims).collect();
    if all.iter().all(|(_, aim)| *aim == Aim::Least) {
        return parallel::each(&all, |one| bound(*one))
            .into_iter()
            .collect();
    }
    let mut most = Vec::new();
    for &one in &all {
        let found = bound(one)?;
        most.push(found);
        if matches!(one.1, Aim::Within(limit) if found > limit) {
            most.resize(all.len(), f64::INFINITY);
            break;
        }
    }
    Some(most)
}

/// Returns x/scale, rounded up, but to no more than 1 where x is at most its scale; 0/0 is no
/// error.
pub(crate) fn relative(x: f64, scale: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else if scale > 0.0 {
        let ratio = (x / scale).next_up();
        if x <= scale { ratio.min(1.0) } else { ratio }
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::{Builder, Folding};
    use crate::function::Argument;
    use crate::interval::Interval;
    use crate::program::Input;
    use dalembert_model::number::{Exact, Rational};

    #[test]
    fn what_never_moves_is_bounded_by_nothing() {
        let mut builder = Builder::new(Folding::Syntactic);
        let rate = builder.input(Input::Entry(Argument::Velocity, 0));
        let cosine = builder.input(Input::Cos(0));
        let load = builder.mul(rate, cosine);
        let graph = builder.finish(vec![load]);
        let mut limits = InputBox::symmetric(&[1.0], &[0.0], &[30.0]);
        let bound = |limits: &InputBox| magnitudes(&graph, limits, &[1.0], BoxEffort::QUICK)[0];
        assert_eq!(bound(&limits), 0.0);
        let mut builder = Builder::new(Folding::Syntactic);
        let zero = builder.zero();
        let zero = builder.finish(vec![zero]);
        assert_eq!(magnitudes(&zero, &limits, &[0.0], BoxEffort::QUICK), [0.0]);
        limits.velocity = vec![Interval::symmetric(5e-324)];
        assert!(bound(&limits) < 1e-150);
    }

    #[test]
    fn what_is_just_within_is_within() {
        for limit in [0.3, 7.0, 1e-12, 97.6] {
            assert_eq!(relative(limit, limit), 1.0);
            assert!(relative(limit.next_up(), limit) > 1.0);
            assert!(relative(limit.next_down(), limit) <= 1.0);
        }
    }

    #[test]
    fn an_error_without_angles_is_bounded() {
        let mut builder = Builder::new(Folding::Syntactic);
        let rate = builder.input(Input::Entry(Argument::Acceleration, 0));
        let small = Rational::new(4.into(), 100_000.into());
        let small = builder.constant(&Exact::from(small));
        let error = builder.mul(rate, small);
        let graph = builder.finish(vec![error]);
        let limits = InputBox::symmetric(&[3.0], &[0.0], &[30.0]);
        for budget in [BoxEffort::QUICK, BoxEffort::CERTIFY] {
            let bound = magnitudes(&graph, &limits, &[1.0], budget)[0];
            assert!((1.2e-3..1.3e-3).contains(&bound), "{bound:e}");
        }
    }
}

//! The largest magnitude of a graph's outputs over a box: written out as
//! trigonometric polynomials and at a grid (`grid`); if they are too large for that,
//! by branch and bound.
//!
//! - `boxes`: branch and bound

mod boxes;

use crate::bound::distinct::Distinct;
use crate::bound::expand::expand;
use crate::bound::grid::{self, Aim, GridEffort};
use crate::bound::input_box::InputBox;
use crate::graph::Graph;
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
pub fn magnitudes(graph: &Graph, whole: &InputBox, scales: &[f64], budget: BoxEffort) -> Vec<f64> {
    let (graph, scales, distinct) = distinct_outputs(graph, scales);
    let aims = scales.iter().map(|_| Aim::Least(0.0));
    let most = written_out(&graph, whole, aims, budget);
    let most = most.unwrap_or_else(|| branch_and_bound(&graph, whole, &scales, 0.0, budget));
    distinct.scatter(&most)
}

/// What is seen of errors.
pub(crate) struct Seen {
    /// About the largest value of each output that is taken, against its limit; or, where such
    /// values are not known, a bound.
    pub used: Vec<f64>,
    /// Angles at which outputs are large, of those joints that these depend on, where known.
    pub worst: Vec<Vec<Option<f64>>>,
}

/// Returns how large outputs are seen to be, which shows nothing.
pub(crate) fn seen(graph: &Graph, whole: &InputBox, limits: &[f64], budget: BoxEffort) -> Seen {
    let (graph, limits, distinct) = distinct_outputs(graph, limits);
    let taken = largest_taken(&graph, whole, budget);
    let Seen { used: most, worst } = taken.unwrap_or_else(|| Seen {
        used: branch_and_bound(&graph, whole, &limits, 1.0, budget),
        worst: Vec::new(),
    });
    let used = most.iter().zip(&limits);
    let used: Vec<f64> = used.map(|(&x, &limit)| relative(x, limit)).collect();
    Seen {
        used: distinct.scatter(&used),
        worst,
    }
}

/// Returns bounds, if every output is shown to be at most its limit.
///
/// # Errors
/// Which outputs are not: at a grid, the first one ends the search.
pub(crate) fn shown_within(
    graph: &Graph,
    whole: &InputBox,
    limits: &[f64],
    budget: BoxEffort,
) -> Result<Vec<f64>, Vec<bool>> {
    let (graph, limits, distinct) = distinct_outputs(graph, limits);
    let aims = limits.iter().map(|&limit| Aim::Within(limit));
    let most = written_out(&graph, whole, aims, budget);
    let mut most = most.unwrap_or_else(|| branch_and_bound(&graph, whole, &limits, 1.0, budget));
    most.resize(limits.len(), 0.0);
    let beyond: Vec<bool> = most
        .iter()
        .zip(&limits)
        .map(|(x, limit)| x > limit)
        .collect();
    match beyond.contains(&true) {
        true => Err(distinct.scatter(&beyond)),
        false => Ok(distinct.scatter(&most)),
    }
}

/// Returns about the largest value of each output that is taken, in its unit; none if they
/// cannot be written out.
fn largest_taken(graph: &Graph, whole: &InputBox, budget: BoxEffort) -> Option<Seen> {
    if budget.points == 0 {
        return None;
    }
    let sliding = grid::sliding(graph, whole.joints());
    let closeness = GridEffort::fine(budget.points);
    let (mut used, mut worst) = (Vec::new(), Vec::new());
    for polynomial in expand(graph, whole)? {
        let polynomial = grid::harmonics(&polynomial, whole.joints())?;
        let (most, angles) = grid::taken(polynomial, whole, &sliding, closeness);
        used.push(most);
        worst.extend(angles);
    }
    Some(Seen { used, worst })
}

/// Returns equal outputs once: a sign does not matter to a magnitude; a scale does to the search.
fn distinct_outputs(graph: &Graph, scales: &[f64]) -> (Graph, Vec<f64>, Distinct) {
    let pairs = graph.outputs.iter().zip(scales);
    let keys = pairs.map(|(edge, scale)| Some((edge.node(), scale.to_bits())));
    let distinct = Distinct::by(keys);
    let graph = Graph {
        outputs: distinct.pick(&graph.outputs),
        ..graph.clone()
    };
    (graph, distinct.pick(scales), distinct)
}

/// Bounds at a grid, if there is one: of all outputs, or up to the first that is
/// not within what it is to be.
fn written_out(
    graph: &Graph,
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
    let mut most = Vec::new();
    for (polynomial, aim) in polynomials.iter().zip(aims) {
        let polynomial = grid::harmonics(polynomial, whole.joints())?;
        let found = grid::magnitude(polynomial, whole, &sliding, aim, closeness);
        most.push(found);
        if matches!(aim, Aim::Within(limit) if found > limit) {
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
    use crate::function::Argument;
    use crate::graph::builder::Value;
    use crate::graph::{Builder, Folding};
    use crate::interval::Interval;
    use crate::program::{AngleSum, Input};
    use dalembert_model::number::{Exact, Rational};

    /// A rate that is always zero: its terms are nothing, not the least double.
    #[test]
    fn what_never_moves_is_bounded_by_nothing() {
        let mut builder = Builder::new(Folding::Syntactic);
        let rate = builder.input(Input::Entry(Argument::Velocity, 0));
        let cosine = builder.input(Input::Cos(AngleSum::joint(0)));
        let load = builder.mul(&rate, &cosine);
        let graph = builder.finish(&[load]);
        let mut limits = InputBox {
            position: vec![Interval::symmetric(1.0)],
            velocity: vec![Interval::ZERO],
            acceleration: vec![Interval::symmetric(30.0)],
        };
        let bound = |limits: &InputBox| magnitudes(&graph, limits, &[1.0], BoxEffort::QUICK)[0];
        assert_eq!(bound(&limits), 0.0);
        let zero = Builder::new(Folding::Syntactic).finish(&[Value::Constant(Exact::from(
            Rational::from_integer(0.into()),
        ))]);
        assert_eq!(magnitudes(&zero, &limits, &[0.0], BoxEffort::QUICK), [0.0]);
        // Nor is there a step from one subnormal to the next.
        limits.velocity = vec![Interval::symmetric(5e-324)];
        assert!(bound(&limits) < 1e-150);
    }

    /// A bound that is the limit itself is within it.
    #[test]
    fn what_is_just_within_is_within() {
        for limit in [0.3, 7.0, 1e-12, 97.6] {
            assert_eq!(relative(limit, limit), 1.0);
            assert!(relative(limit.next_up(), limit) > 1.0);
            assert!(relative(limit.next_down(), limit) <= 1.0);
        }
    }

    /// What is left out may be a rate alone, with no angle to cut: 4e-5·q̈₁.
    #[test]
    fn an_error_without_angles_is_bounded() {
        let mut builder = Builder::new(Folding::Syntactic);
        let rate = builder.input(Input::Entry(Argument::Acceleration, 0));
        let small = Rational::new(4.into(), 100_000.into());
        let error = builder.mul(&rate, &Value::Constant(Exact::from(small)));
        let graph = builder.finish(&[error]);
        let limits = InputBox {
            position: vec![Interval::symmetric(3.0)],
            velocity: vec![Interval::ZERO],
            acceleration: vec![Interval::symmetric(30.0)],
        };
        for budget in [BoxEffort::QUICK, BoxEffort::CERTIFY] {
            let bound = magnitudes(&graph, &limits, &[1.0], budget)[0];
            assert!((1.2e-3..1.3e-3).contains(&bound), "{bound:e}");
        }
    }
}

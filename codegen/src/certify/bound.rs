//! The largest magnitude of a graph's outputs over a box: branch and bound.
//!
//! **Soundness.** The sub-boxes always cover the box, and a bound over each
//! of them holds by [`Forms`]; their largest is a bound over the box. The
//! search only decides which sub-box to halve next.
//!
//! Deterministic: sub-boxes are counted, never timed, and ties go to the one
//! made first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::expand::expand;
use super::form::{Forms, Scratch};
use super::grid::{self, Aim, Closeness};
use super::input_box::InputBox;
use crate::graph::Graph;

/// How much work a bound may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Sub-boxes evaluated at most.
    pub boxes: usize,
    /// First-order terms in the positions: dearer and tighter.
    pub linear: bool,
    /// Points of a grid at most; 0 for none.
    pub points: usize,
}

impl Budget {
    /// For certificates.
    pub const CERTIFY: Budget = Budget {
        boxes: 300_000,
        linear: false,
        points: 1 << 26,
    };
    /// For a search that asks often.
    pub const GLANCE: Budget = Budget {
        boxes: 20_000,
        linear: false,
        points: 1 << 22,
    };
}

/// A sub-box that is not halved yet.
struct Leaf {
    /// The output that is worst here relative to its weight.
    priority: f64,
    serial: usize,
    sub: InputBox,
    magnitudes: Vec<f64>,
    axis: usize,
}

impl PartialEq for Leaf {
    fn eq(&self, other: &Leaf) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Leaf {}
impl PartialOrd for Leaf {
    fn partial_cmp(&self, other: &Leaf) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Leaf {
    fn cmp(&self, other: &Leaf) -> Ordering {
        let first = self.priority.total_cmp(&other.priority);
        first.then(other.serial.cmp(&self.serial))
    }
}

/// Bounds of |output| over the box, one an output. `scales` say what a unit
/// of each output is worth: the largest |output|/scale is tightened.
/// `goal`: stop as soon as every |output|/scale is at most that.
pub fn magnitudes(
    graph: &Graph,
    whole: &InputBox,
    scales: &[f64],
    goal: f64,
    budget: Budget,
) -> Vec<f64> {
    // Close enough to the goal to tell how far from it.
    let aims = scales.iter().map(|scale| Aim::Least(0.85 * goal * scale));
    if let Some(most) = written_out(graph, whole, aims, budget) {
        return most;
    }
    let forms = Forms::new(graph, whole.joints(), budget.linear);
    let mut search = Search {
        forms: &forms,
        scales,
        scratch: Scratch::default(),
        serial: 0,
    };
    let mut heap = BinaryHeap::new();
    heap.push(search.leaf(whole.clone()));
    while search.serial < budget.boxes {
        let Some(leaf) = heap.peek() else { break };
        if leaf.priority <= goal || leaf.axis == usize::MAX {
            break;
        }
        let Some(leaf) = heap.pop() else { break };
        for half in leaf.sub.position[leaf.axis].split() {
            let mut sub = leaf.sub.clone();
            sub.position[leaf.axis] = half;
            let mut child = search.leaf(sub);
            // What holds over the parent holds over its half.
            for (mine, parents) in child.magnitudes.iter_mut().zip(&leaf.magnitudes) {
                *mine = mine.min(*parents);
            }
            child.priority = priority(&child.magnitudes, scales);
            heap.push(child);
        }
    }
    let mut most = vec![0.0f64; graph.outputs.len()];
    for leaf in heap {
        for (most, magnitude) in most.iter_mut().zip(&leaf.magnitudes) {
            *most = most.max(*magnitude);
        }
    }
    most
}

/// The same, if every output is shown to be at most its limit; the first for
/// which it is not ends the search.
pub fn magnitudes_within(
    graph: &Graph,
    whole: &InputBox,
    limits: &[f64],
    budget: Budget,
) -> Option<Vec<f64>> {
    let aims = limits.iter().map(|&limit| Aim::Within(limit));
    let most = written_out(graph, whole, aims, budget);
    let most = most.unwrap_or_else(|| magnitudes(graph, whole, limits, 1.0, budget));
    let within = most.len() == limits.len() && most.iter().zip(limits).all(|(x, limit)| x <= limit);
    within.then_some(most)
}

/// Bounds at a grid, if there is one: of all outputs, or up to the first that is
/// not within what it is to be.
fn written_out(
    graph: &Graph,
    whole: &InputBox,
    aims: impl Iterator<Item = Aim>,
    budget: Budget,
) -> Option<Vec<f64>> {
    if budget.points == 0 {
        return None;
    }
    let polynomials = expand(graph, whole)?;
    let sliding = grid::sliding(graph, whole.joints());
    let closeness = Closeness::fine(budget.points);
    let mut most = Vec::new();
    for (polynomial, aim) in polynomials.iter().zip(aims) {
        let found = grid::magnitude(polynomial, whole, &sliding, aim, closeness)?;
        most.push(found);
        if matches!(aim, Aim::Within(limit) if found > limit) {
            break;
        }
    }
    Some(most)
}

struct Search<'a> {
    forms: &'a Forms,
    scales: &'a [f64],
    scratch: Scratch,
    serial: usize,
}

impl Search<'_> {
    fn leaf(&mut self, sub: InputBox) -> Leaf {
        self.forms.evaluate(&sub, &mut self.scratch);
        let outputs = self.forms.outputs(&sub, &self.scratch);
        let magnitudes: Vec<f64> = outputs.iter().map(|x| x.magnitude()).collect();
        self.serial += 1;
        Leaf {
            priority: priority(&magnitudes, self.scales),
            serial: self.serial,
            axis: self.axis(&sub),
            sub,
            magnitudes,
        }
    }

    /// The widest position that matters.
    fn axis(&self, sub: &InputBox) -> usize {
        let positions = self.forms.positions.iter().copied();
        positions
            .filter(|&joint| sub.position[joint].width() > 1e-9)
            .fold((usize::MAX, 0.0), |(best, width), joint| {
                let mine = sub.position[joint].width();
                if mine > width {
                    (joint, mine)
                } else {
                    (best, width)
                }
            })
            .0
    }
}

/// The worst output against its scale. A scale of zero demands an exact
/// output.
fn priority(magnitudes: &[f64], scales: &[f64]) -> f64 {
    let pairs = magnitudes.iter().zip(scales);
    pairs.fold(0.0, |worst, (&x, &scale)| worst.max(relative(x, scale)))
}

/// x/scale, rounded up; 0/0 is no error.
pub fn relative(x: f64, scale: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else if scale > 0.0 {
        (x / scale).next_up()
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::interval::Interval;
    use crate::graph::builder::Value;
    use crate::graph::{Builder, Folding, Input};
    use dalembert_model::number::{Exact, Rational};

    /// What is left out may be a rate alone, with no angle to cut: 4e-5·q̈₁.
    #[test]
    fn an_error_without_angles_is_bounded() {
        let mut builder = Builder::new(Folding::Syntactic);
        let rate = builder.input(Input::Acceleration(0));
        let small = Rational::new(4.into(), 100_000.into());
        let error = builder.mul(&rate, &Value::Constant(Exact::from(small)));
        let graph = builder.finish(&[error]);
        let limits = InputBox {
            position: vec![Interval::symmetric(3.0)],
            velocity: vec![Interval::ZERO],
            acceleration: vec![Interval::symmetric(30.0)],
        };
        for budget in [Budget::GLANCE, Budget::CERTIFY] {
            let bound = magnitudes(&graph, &limits, &[1.0], 0.0, budget)[0];
            assert!((1.2e-3..1.3e-3).contains(&bound), "{bound:e}");
        }
    }
}

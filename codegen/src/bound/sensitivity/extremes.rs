//! The largest value and the largest adjoints of every step over a box.
//!
//! Each is a trigonometric polynomial of its own and bounded as such: what
//! cancels is gone, which intervals would not see.

use super::gradient::Gradient;
use super::together::{Together, Written};
use crate::bound::expand::visit;
use crate::bound::grid::{self, Aim, GridEffort};
use crate::bound::input_box::InputBox;
use crate::graph::Edge;
use crate::program::{Input, Program};

/// How close a bound is to come to a value that is taken: sums of products of
/// two of them are what counts.
const CLOSE: f64 = 0.1;

/// Polynomials that may have all their points; more share what these have, until
/// it is too little to look at angles at all.
const TOGETHER: usize = 2048;
const FEWEST: usize = 64;

/// Points of what counts in the second order.
const ASIDE: usize = 256;

/// Places to climb from.
const STARTS: usize = 2;

/// Bounds of magnitudes over a box.
#[derive(Clone, Debug)]
pub(super) struct Extremes {
    /// Of each step's value.
    pub values: Vec<f64>,
    /// Of each output.
    pub adjoints: Vec<Adjoints>,
    /// Of each output: its nodes' products together.
    pub together: Vec<Together>,
}

/// Bounds of one output's derivatives.
#[derive(Clone, Debug)]
pub(super) struct Adjoints {
    /// With respect to each step; zero where it does not depend on it.
    pub steps: Vec<f64>,
    /// With respect to each sine and cosine that it depends on.
    pub sines: Vec<(Input, f64)>,
}

impl Extremes {
    /// Returns `points` of a grid at most for each; with none, no angle is looked at.
    /// `together` for each output's sum. `None` if the polynomials are too large.
    pub(super) fn of(
        program: &Program,
        limits: &InputBox,
        points: usize,
        together: usize,
    ) -> Option<Extremes> {
        let gradient = Gradient::of(program);
        let graph = &gradient.graph;
        let sliding = grid::sliding(graph, limits.joints());
        let each = points.min(TOGETHER * points / graph.outputs.len().max(1));
        let closeness = GridEffort {
            points: if each < FEWEST { 0 } else { each },
            close: CLOSE,
            starts: STARTS,
        };
        let mut most = vec![Some(0.0); graph.nodes.len()];
        let mut is_value = vec![false; graph.nodes.len()];
        for edge in &gradient.values {
            is_value[edge.node().index()] = true;
        }
        let mut written = Written::new(program, graph.nodes.len(), limits, &sliding, together);
        visit(graph, limits, &mut |node, polynomial| {
            let harmonics = grid::harmonics(polynomial, limits.joints());
            most[node] = harmonics.map(|harmonics| {
                written.keep(node, &harmonics);
                // Where sums are bounded together, adjoints count by themselves in the
                // second order alone.
                let most = match is_value[node] || !written.is_wanted() {
                    true => usize::MAX,
                    false => ASIDE,
                };
                let closeness = GridEffort {
                    points: closeness.points.min(most),
                    ..closeness
                };
                grid::magnitude(harmonics, limits, &sliding, Aim::Least(0.0), closeness)
            });
        })?;
        let most: Vec<f64> = most.into_iter().collect::<Option<_>>()?;
        let of = |edge: &Edge| most[edge.node().index()];
        let adjoints = gradient.adjoints.iter().map(|adjoints| {
            let mut steps = vec![0.0; program.steps.len()];
            for (step, edge) in &adjoints.steps {
                steps[*step] = of(edge);
            }
            let sines = adjoints.sines.iter();
            Adjoints {
                steps,
                sines: sines.map(|(input, edge)| (*input, of(edge))).collect(),
            }
        });
        let together = written.together(program, &gradient, &most);
        Some(Extremes {
            together,
            values: gradient.values.iter().map(of).collect(),
            adjoints: adjoints.collect(),
        })
    }
}

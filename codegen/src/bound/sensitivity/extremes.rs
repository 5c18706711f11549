//! The largest value and the largest adjoints of every operation over a box.
//!
//! Each is a trigonometric polynomial of its own and bounded as such: what
//! cancels is gone, which intervals would not see.

use super::gradient::Gradient;
use crate::bound::expand::visit;
use crate::bound::grid::{self, Aim, GridEffort};
use crate::bound::input_box::InputBox;
use crate::dag::{Edge, Id};
use crate::program::Program;

/// How close a bound is to come to a value that is taken: sums of products of
/// two of them are what counts.
const CLOSE: f64 = 0.1;

/// Polynomials that may have all their points; more share what these have, until
/// it is too little to look at angles at all.
const FULL: usize = 2048;
const FEWEST: usize = 64;

/// Places to climb from.
const STARTS: usize = 2;

/// Bounds of magnitudes over a box, node by node.
#[derive(Clone, Debug)]
pub(super) struct Extremes {
    /// Bounds of each operation's value.
    pub values: Vec<f64>,
    /// Bounds of the derivatives of each output with respect to each operation, sine and cosine;
    /// zero where it does not depend on it.
    pub adjoints: Vec<Vec<f64>>,
}

impl Extremes {
    /// Bounds the values and adjoints of a program over a box, each with at most `points` points
    /// of a grid; with none, no angle is looked at. `None` if the polynomials are too large.
    pub(super) fn new(program: &Program, limits: &InputBox, points: usize) -> Option<Extremes> {
        let gradient = Gradient::new(program);
        let graph = &gradient.graph;
        let sliding = grid::sliding(graph, limits.joints());
        let each = points.min(FULL * points / graph.outputs.len().max(1));
        let closeness = GridEffort {
            points: if each < FEWEST { 0 } else { each },
            close: CLOSE,
            starts: STARTS,
        };
        let mut most = vec![Some(0.0); graph.nodes.len()];
        visit(graph, limits, &mut |node, polynomial| {
            let harmonics = grid::harmonics(polynomial, limits.joints());
            most[node] = harmonics.map(|harmonics| {
                grid::magnitude(harmonics, limits, &sliding, Aim::Least, closeness)
            });
        })?;
        let most: Vec<f64> = most.into_iter().collect::<Option<_>>()?;
        let by_node = |own: &[(Id, Edge)]| {
            let mut all = vec![0.0; program.dag.nodes.len()];
            for (id, edge) in own {
                all[*id as usize] = most[edge.index()];
            }
            all
        };
        Some(Extremes {
            values: by_node(&gradient.values),
            adjoints: gradient.adjoints.iter().map(|own| by_node(own)).collect(),
        })
    }
}

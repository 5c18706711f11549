//! Fewer operations, same function.
//!
//! - [`classes`]: values up to sign by fingerprint, and the ways to compute each
//! - [`rules`], [`egraph`]: equality saturation with rules as data
//! - [`extract`]: the cheapest program that the ways allow
//! - [`random`]: the deterministic generator of the search

pub mod classes;
pub mod egraph;
pub mod extract;
pub mod random;
pub mod rules;

use std::fmt;

use crate::graph::{Counts, Folding, Graph};
use classes::{Classes, Way};
use egraph::Budget;
use extract::{CostModel, Extraction, Schedule};
use random::Random;

/// How much work the simplifier may do. Work is counted in e-nodes and moves,
/// never in time, so the result is the same on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Effort {
    /// Well below a second for a six-joint arm, in a release build.
    #[default]
    Quick,
    /// Up to two minutes a function.
    Thorough,
}

impl Effort {
    /// Both, least first.
    pub const ALL: [Effort; 2] = [Effort::Quick, Effort::Thorough];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Effort::Quick => "quick",
            Effort::Thorough => "thorough",
        }
    }

    fn budget(self) -> Budget {
        match self {
            Effort::Quick => Budget {
                nodes: 20_000,
                iterations: 2,
                rounds: 1,
            },
            Effort::Thorough => Budget {
                nodes: 100_000,
                iterations: 4,
                rounds: 2,
            },
        }
    }

    fn schedule(self) -> Schedule {
        Schedule {
            moves: match self {
                Effort::Quick => 100_000,
                Effort::Thorough => 5_000_000,
            },
            hot: 0.15,
            cold: 0.04,
        }
    }
}

/// What one step left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stage {
    /// The step.
    pub name: &'static str,
    /// The counts after it.
    pub counts: Counts,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.name, self.counts)
    }
}

/// A simplified function.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The program's graph.
    pub graph: Graph,
    /// The index of the variant that the search started from.
    pub seed: usize,
    /// Counts after each step.
    pub stages: Vec<Stage>,
}

/// The cheapest program found for a function from the graphs of one or more
/// formulations; never dearer than the cheapest of them merged by fingerprint.
///
/// Returns `None` if there is no variant.
pub fn simplify(variants: &[Graph], effort: Effort) -> Option<Simplified> {
    let merged: Vec<Graph> = variants
        .iter()
        .map(|graph| graph.rebuild(Folding::Semantic))
        .collect();
    let (seed, start) = merged
        .iter()
        .enumerate()
        .min_by_key(|(_, graph)| cost(graph))?;
    let mut stages = vec![
        stage("folded", &variants[seed]),
        stage("fingerprints", start),
    ];

    let mut classes = Classes::new(start);
    // A merged graph computes each class once, so its ways are its program.
    let program: Vec<Option<Way>> = (0..classes.len() as u32)
        .map(|id| classes.get(id).ways.first().copied())
        .collect();
    egraph::saturate(&mut classes, &program, effort.budget());
    for graph in variants {
        classes.absorb(graph);
    }
    let mut search = Extraction::new(&classes, &program, CostModel::OPERATIONS);
    search.climb();
    search.anneal(effort.schedule(), &mut Random::new(1));
    search.climb();
    let graph = classes.graph(&search.choice());
    let graph = if cost(&graph) <= cost(start) {
        graph
    } else {
        start.clone()
    };
    stages.push(stage("e-graph", &graph));
    Some(Simplified {
        graph,
        seed,
        stages,
    })
}

fn stage(name: &'static str, graph: &Graph) -> Stage {
    Stage {
        name,
        counts: graph.counts(),
    }
}

/// Sines and cosines weigh as in the search, so that the choice of the seed
/// and the search agree.
pub fn cost(graph: &Graph) -> u64 {
    let (counts, model) = (graph.counts(), CostModel::OPERATIONS);
    counts.mul as u64 * model.mul
        + counts.add as u64 * model.add
        + counts.sincos as u64 * model.sincos
}

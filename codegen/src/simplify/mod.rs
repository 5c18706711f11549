//! Fewer operations, same function.
//!
//! - [`effort`]: how much work a search may do, in moves and nodes
//! - [`classes`]: the e-graph: values up to sign by fingerprint, and the ways to compute each
//! - [`rules`]: identities of algebra, applied by pattern
//! - [`discover`]: ways that only the fingerprints show; `sieve`: whether a value may be
//!   among others
//! - [`source`]: the names of all that adds ways
//! - [`extract`]: the cheapest program that the ways allow
//! - [`search`]: discovery and extraction in turns, to a plateau

pub(crate) mod classes;
pub(crate) mod discover;
pub(crate) mod effort;
pub(crate) mod extract;
pub(crate) mod rules;
pub(crate) mod search;
mod sieve;
pub(crate) mod source;

use std::fmt;

use crate::graph::{Folding, Graph};
use crate::program::Counts;
use crate::random::Random;
use crate::watch::{FunctionWatch, Part};
use classes::Classes;
pub use effort::Effort;
pub(crate) use extract::CostModel;
use search::SearchLimits;
pub use source::WaySource;

/// What one step left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// The step.
    pub name: &'static str,
    /// The counts after it.
    pub counts: Counts,
}

impl Pass {
    /// Every step's name, in order.
    pub const NAMES: [&'static str; 6] = [
        "traced",
        "folded",
        "fingerprints",
        "e-graph",
        "search",
        "final",
    ];

    fn of(name: &'static str, graph: &Graph) -> Self {
        Pass {
            name,
            counts: graph.counts(),
        }
    }
}

impl fmt::Display for Pass {
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
    pub passes: Vec<Pass>,
    /// What the search started from: the seed merged by fingerprint.
    pub start: Graph,
    /// What the e-graph left.
    pub saturated: Graph,
}

/// Returns the cheapest program found for a function from one or more graphs of it;
/// never dearer than the cheapest of them merged by fingerprint.
///
/// `helpers` are graphs of other values that may serve, such as the sines of
/// angle sums. A program that `accept` refuses is not taken, unless it refuses
/// every variant. Returns `None` if there is no variant.
pub(crate) fn simplify(
    variants: &[Graph],
    helpers: &[Graph],
    effort: Effort,
    accept: &dyn Fn(&Graph) -> bool,
) -> Option<Simplified> {
    watched(variants, helpers, effort, None, accept, None)
}

/// Returns `simplify` under a watch: where it is over, the search ends with its
/// round. A source of ways may be left out, to see what it earns.
pub fn watched(
    variants: &[Graph],
    helpers: &[Graph],
    effort: Effort,
    without: Option<WaySource>,
    accept: &dyn Fn(&Graph) -> bool,
    watch: Option<FunctionWatch<'_>>,
) -> Option<Simplified> {
    let tell = |part, rounds, best: &Graph| {
        if let Some(watch) = watch {
            watch.step(part, rounds, Some(best.counts()));
        }
    };
    let mut merged: Vec<(usize, Graph)> = variants
        .iter()
        .map(|graph| graph.rebuild(Folding::Semantic))
        .enumerate()
        .collect();
    merged.sort_by_key(|(index, graph)| (cost(graph), *index));
    let (seed, start, strict) = match merged.iter().find(|(_, graph)| accept(graph)) {
        Some((seed, start)) => (*seed, start, true),
        None => merged.first().map(|(seed, start)| (*seed, start, false))?,
    };
    let mut passes = vec![
        Pass::of("folded", &variants[seed]),
        Pass::of("fingerprints", start),
    ];
    let take = |found: Graph, best: &Graph| {
        let better = cost(&found) <= cost(best) && (!strict || accept(&found));
        if better { found } else { best.clone() }
    };
    let mut random = Random::new(1);
    tell(Part::EGraph, [0, 1], start);

    let mut classes = Classes::default();
    let (_, program) = classes.begin(start);
    if without != Some(WaySource::Rules) {
        rules::saturate(&mut classes, effort.rules());
    }
    let found = search::extract(&classes, &program, effort.first_schedule(), &mut random);
    let mut best = take(found, start);
    passes.push(Pass::of("e-graph", &best));
    let saturated = best.clone();

    let settings = SearchLimits {
        without,
        ..effort.search(best.counts().operations())
    };
    let mut idle = 0;
    for round in 0..settings.rounds {
        if watch.is_some_and(|watch| watch.is_over()) {
            break;
        }
        tell(Part::Search, [round, settings.rounds], &best);
        let found = search::round(&best, variants, helpers, &settings, &mut random);
        let before = cost(&best);
        best = take(found, &best);
        idle = if cost(&best) < before { 0 } else { idle + 1 };
        if idle > settings.patience {
            break;
        }
    }
    passes.push(Pass::of("search", &best));
    Some(Simplified {
        graph: best,
        seed,
        passes,
        start: start.clone(),
        saturated,
    })
}

/// Returns the price that the search minimises, in hundredths of an operation.
pub fn cost(graph: &Graph) -> u64 {
    CostModel::OPERATIONS.price(&graph.counts(), graph.angles().into_iter())
}

//! Discovery and extraction in turns.

use super::classes::{ClassId, Classes, ENode};
use super::cost;
use super::discover;
use super::extract::{CostModel, Extraction, Schedule};
use crate::graph::Graph;
use crate::random::Random;

/// The limits of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SearchLimits {
    /// Rounds at most.
    pub rounds: usize,
    /// Rounds without a gain before it stops.
    pub patience: usize,
    /// The most classes among which all pairs are tried, if the program's own
    /// are not more.
    pub pairs: usize,
    /// The most classes among which two-operation substitutes are tried.
    pub substitutes: usize,
    /// Annealing of a round.
    pub schedule: Schedule,
}

/// A program with more values than this is not paired whole in any search.
const MAX_OWN: usize = 1_500;

/// Returns one round from a program: what other graphs and the fingerprints offer,
/// then extraction. Never returns a dearer program.
pub(crate) fn round(
    program: &Graph,
    variants: &[Graph],
    helpers: &[Graph],
    limits: &SearchLimits,
    random: &mut Random,
) -> Graph {
    let mut classes = Classes::new(program);
    let choice = classes.program();
    let own: Vec<ClassId> = (0..classes.len() as ClassId).collect();
    for graph in variants.iter().chain(helpers) {
        classes.absorb(graph);
    }
    discover::multiples(&mut classes, &own, &choice);
    // The program's own classes come first, then the other graphs' in turn.
    let most = limits.pairs.max(own.len().min(MAX_OWN));
    let pool: Vec<ClassId> = (0..classes.len().min(most) as ClassId).collect();
    discover::pairs(&mut classes, &pool);
    if own.len() <= limits.substitutes {
        discover::resubstitute(&mut classes, &own);
    }
    let found = extract(&classes, &choice, limits.schedule, random);
    if cost(&found) <= cost(program) {
        found
    } else {
        program.clone()
    }
}

/// Returns a round without annealing: what a program is about worth.
pub(crate) fn quick_round(program: &Graph, helpers: &[Graph]) -> Graph {
    let limits = SearchLimits {
        rounds: 1,
        patience: 0,
        pairs: 500,
        substitutes: 1_000,
        schedule: Schedule::COOLING,
    };
    round(program, &[], helpers, &limits, &mut Random::new(1))
}

/// Climbs, anneals and climbs again from a choice.
pub(crate) fn extract(
    classes: &Classes,
    choice: &[Option<ENode>],
    schedule: Schedule,
    random: &mut Random,
) -> Graph {
    let mut search = Extraction::new(classes, choice, CostModel::OPERATIONS);
    search.climb();
    if schedule.moves > 0 {
        search.anneal(schedule, random);
        search.climb();
    }
    classes.graph(&search.choice())
}

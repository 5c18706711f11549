//! Discovery and extraction in turns.

use rustc_hash::FxHashSet;

use super::classes::{ClassId, Classes, Way};
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

/// One round from a program: what the formulations, whose e-graph this is, and the
/// fingerprints offer, then extraction. Never returns a dearer program.
pub(crate) fn round(
    program: &Graph,
    formulations: &Classes,
    limits: &SearchLimits,
    random: &mut Random,
) -> Graph {
    let mut classes = formulations.clone();
    let (own, choice) = classes.begin(program);
    discover::multiples(&mut classes, &own, &choice);
    // The program's own classes come first, then the others in turn.
    let most = limits.pairs.max(own.len().min(MAX_OWN));
    let is_own: FxHashSet<ClassId> = own.iter().copied().collect();
    let others = classes.ids().iter().filter(|id| !is_own.contains(id));
    let pool = own.iter().chain(others).take(most);
    let pool: Vec<ClassId> = pool.copied().collect();
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

/// A round without annealing: what a program is about worth.
pub(crate) fn quick_round(program: &Graph, helpers: &[Graph]) -> Graph {
    let limits = SearchLimits {
        rounds: 1,
        patience: 0,
        pairs: 500,
        substitutes: 1_000,
        schedule: Schedule::COOLING,
    };
    let formulations = Classes::of(helpers);
    round(program, &formulations, &limits, &mut Random::new(1))
}

/// Climbs, anneals and climbs again from a choice.
pub(crate) fn extract(
    classes: &Classes,
    choice: &[Option<Way>],
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

//! Discovery and extraction in turns.

use super::classes::{ClassId, Classes, Way};
use super::cost;
use super::discover;
use super::extract::{CostModel, Extraction, Schedule};
use super::rules::{self, RuleLimits};
use super::source::WaySource;
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
    /// Limits of the rules that are applied to the program.
    pub rules: RuleLimits,
    /// Annealing of a round.
    pub schedule: Schedule,
    /// The source that is left out, to see what it earns.
    pub without: Option<WaySource>,
}

/// A program with more values than this is not paired whole in any search.
const MAX_OWN: usize = 1_500;

/// Returns one round from a program: what rules, other graphs and the fingerprints offer,
/// then extraction. Never returns a dearer program.
pub(crate) fn round(
    program: &Graph,
    variants: &[Graph],
    helpers: &[Graph],
    limits: &SearchLimits,
    random: &mut Random,
) -> Graph {
    let has = |source| limits.without != Some(source);
    let mut classes = Classes::default();
    let (own, choice) = classes.begin(program);
    if has(WaySource::Rules) {
        rules::saturate(&mut classes, limits.rules);
    }
    if has(WaySource::Formulations) {
        for graph in variants.iter().chain(helpers) {
            classes.absorb(graph);
        }
    }
    if has(WaySource::Multiples) {
        discover::multiples(&mut classes, &own, &choice);
    }
    // The program's own classes come first, then those of the rules, then the other graphs'.
    let most = limits.pairs.max(own.len().min(MAX_OWN));
    let pool: Vec<ClassId> = classes.ids().iter().take(most).copied().collect();
    if has(WaySource::Pairs) {
        discover::pairs(&mut classes, &pool);
    }
    if has(WaySource::Resubstitution) && own.len() <= limits.substitutes {
        discover::resubstitute(&mut classes, &own);
    }
    let mut schedule = limits.schedule;
    if !has(WaySource::Annealing) {
        schedule.moves = 0;
    }
    let found = extract(&classes, &choice, schedule, random);
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
        rules: RuleLimits::NONE,
        schedule: Schedule::COOLING,
        without: None,
    };
    round(program, &[], helpers, &limits, &mut Random::new(1))
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

//! The search for the fewest operations: discovery and extraction in turns, to a plateau; where
//! there is time, from the start again, by other random numbers.
//!
//! Takes graphs of one function and an [`Effort`]; returns a cheaper graph, [`Searched`]. `Classes`
//! is the e-graph, `Extraction` chooses a node of each class.

mod discover;
mod effort;
mod egraph;
mod extract;
mod order;
mod rules;
#[cfg(test)]
mod tests;

use egg::Id as Class;

use crate::dag::{Dag, Folding};
use crate::program::{Counts, Operation};
use crate::random::Random;
pub use effort::{Effort, Limits};
use egraph::{Classes, LeafPrints};
use extract::Extraction;
#[cfg(feature = "testing")]
pub use extract::Schedule;

/// The most values of a program that are paired with each other in every search.
const MAX_OWN: usize = 1_500;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    pub name: &'static str,
    pub counts: Counts,
}

impl Pass {
    pub const NAMES: [&'static str; 4] = ["traced", "folded", "fingerprints", "search"];
}

#[derive(Clone, Debug)]
pub struct Searched {
    /// The cheapest program.
    pub graph: Dag,
    /// The index of the seed that it started from.
    pub seed: usize,
    /// That seed, merged by fingerprint.
    pub start: Dag,
}

/// Searches for the cheapest program of a function from one or more graphs of it; never returns a
/// dearer one than the cheapest of them. `helpers` offer their values only. A program that `accept`
/// refuses is not taken, unless it refuses every seed. `goes_on` hears of each round, of how many,
/// and of the best program so far, and may end the search; `limits` follow from the operations of
/// the first program. Returns none if there is no seed.
pub fn search(
    seeds: &[Dag],
    helpers: &[Dag],
    limits: &dyn Fn(usize) -> Limits,
    accept: &dyn Fn(&Dag) -> bool,
    goes_on: &dyn Fn([usize; 2], &Dag) -> bool,
) -> Option<Searched> {
    let rebuilt = seeds.iter().map(|seed| seed.rebuild(Folding::Semantic));
    let mut merged: Vec<(usize, Dag)> = rebuilt.enumerate().collect();
    merged.sort_by_key(|(_, dag)| cost(dag));
    let accepted = merged.iter().position(|(_, dag)| accept(dag));
    let is_strict = accepted.is_some();
    let (seed, start) = match accepted {
        None if merged.is_empty() => return None,
        place => merged.swap_remove(place.unwrap_or(0)),
    };
    let limits = limits(start.counts().operations());
    // Nodes that no output needs would only be in the way.
    let graphs = seeds.iter().chain(helpers);
    let others: Vec<Dag> = graphs.map(|dag| dag.rebuild(Folding::Syntactic)).collect();
    let offers: Vec<LeafPrints> = others.iter().map(LeafPrints::new).collect();
    let mut best = start.clone();
    let rounds = limits.walks * limits.rounds;
    'walks: for walk in 0..limits.walks {
        let mut current = start.clone();
        let (mut random, mut idle) = (Random::new(1 + walk as u64), 0);
        for number in 0..limits.rounds {
            if idle > limits.patience {
                break;
            }
            if !goes_on([walk * limits.rounds + number, rounds], &best) {
                break 'walks;
            }
            let candidate = round(number, &current, &offers, &limits, &mut random);
            let (before, after) = (cost(&current), cost(&candidate));
            let is_taken = after <= before && (!is_strict || accept(&candidate));
            let is_less = is_taken && after < before;
            idle = if is_less { 0 } else { idle + 1 };
            if is_taken {
                current = candidate;
                // Between equal programs the first walk keeps the later one.
                if walk == 0 || after < cost(&best) {
                    best = current.clone();
                }
            }
        }
    }
    let graph = best;
    Some(Searched { graph, seed, start })
}

pub(crate) fn glance(program: &Dag) -> Dag {
    round(0, program, &[], &Limits::GLANCE, &mut Random::new(1))
}

fn round(
    number: usize,
    program: &Dag,
    offers: &[LeafPrints],
    limits: &Limits,
    random: &mut Random,
) -> Dag {
    let mut classes = Classes::default();
    let (program_classes, choice) = classes.begin(program);
    rules::saturate(&mut classes, limits.rules);
    for graph in offers {
        classes.absorb(graph);
    }
    // The program's own classes come first, then those of the rules, then the other graphs'.
    let most = limits.pairs.max(program_classes.len().min(MAX_OWN));
    let pool: Vec<Class> = classes.ids().iter().take(most).copied().collect();
    if limits.pairs > 0 {
        discover::pairs(&mut classes, &pool);
    }
    if program_classes.len() <= limits.substitutes {
        discover::resubstitute(&mut classes, &program_classes);
    }
    let mut extraction = Extraction::new(&classes, &choice);
    extraction.climb();
    extraction.anneal(limits.schedules[number % 2], random);
    extraction.climb();
    classes.graph(&extraction.choice())
}

/// Between equal sums the one with fewer multiplications is cheaper; a division costs as much as
/// five operations, sine and cosine of an angle as much as twenty.
const MUL: u64 = 101;
const ADD: u64 = 100;
const DIV: u64 = 500;
const SINCOS: u64 = 2000;

fn price_of(operation: Operation) -> u64 {
    match operation {
        Operation::Mul | Operation::Fused => MUL,
        Operation::Add | Operation::Sub => ADD,
        Operation::Div => DIV,
    }
}

/// Returns the price of counts; a fused operation costs as much as its product and its sum.
pub fn price(counts: &Counts) -> u64 {
    let [mul, add] = [counts.mul, counts.add].map(|n| (n + counts.fma) as u64);
    MUL * mul + ADD * add + DIV * counts.div as u64 + SINCOS * counts.sincos as u64
}

pub fn cost(dag: &Dag) -> u64 {
    price(&dag.counts())
}

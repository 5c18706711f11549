//! The search for the cheapest program within what is allowed.
//!
//! From each start values leave the program as long as its errors at the samples are allowed
//! ([`Greedy`]); then the engine decides over the box ([`Reference::judge`]). Where it refutes, the
//! state joins the samples, and the search goes back to where those are within as well. At first a
//! part of the allowances may be used, so that what goes in any case is gone before it gets tight;
//! between the parts the program is simplified.
//!
//! The starts are the exact program, those that smaller tolerances led to, and those of smaller models
//! ([`reduce`](super::reduce)). The best of them are tried again with other samples and a blurred ranking.

use super::greedy::Greedy;
use super::input_box::InputBox;
use super::net::{Edits, cost};
use super::reduce;
use super::reference::Engine;
use super::samples::Samples;
use super::work::Meter;
use crate::parallel;
use crate::program::Program;
use crate::random::Random;
use crate::search::{Effort, search};
use crate::setup::Setup;
use crate::watch::{FunctionWatch, Part};

/// The sampled positions, to begin with.
const POSITIONS: usize = 24;
/// The parts of the allowances, one after the other.
pub(super) const PARTS: [f64; 6] = [0.5, 0.8, 1.0, 1.0, 1.0, 1.0];
/// The times that the engine decides about a part.
const ROUNDS: usize = 10;
/// In so many rounds all may be used at the samples; then with this power of the excess, which counts
/// from and up to a factor, the share gets smaller, down to the least.
const BOLD: usize = 5;
const LEAST_RATIO: f64 = 1.1;
const MOST_RATIO: f64 = 2.0;
const CAUTION: f64 = 0.4;
const LEAST_SHARE: f64 = 0.4;
/// States that refuted a program stay among the samples, but only the last ones.
const REFUTING: usize = 12;
/// A start that ends so much above the best one is worse; after so many of them no other is tried.
const WORSE: f64 = 1.02;
const MOST_WORSE: usize = 2;
/// Starts are not tried again beyond so much work.
const MOST_AGAIN: u64 = 100_000_000;
const NOISE: f64 = 0.3;
const RETRY_NOISE: f64 = 0.6;
const RETRIES: usize = 4;
/// Programs of so many operations are tried again twice as often as long ones, shorter ones more often.
const RETRIED: usize = 150;
/// Corrections of all constants of a program before the engine decides.
const POLISH: usize = 8;

/// The effort of a search: counted, never timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchEffort {
    /// `true` if smaller models are started from, too; not where work is limited.
    pub has_models: bool,
    /// The times that parts of what went are taken back and chosen anew.
    pub retries: usize,
    /// The times that the best starts are tried again.
    pub again: u64,
    /// The effort of simplifying between the parts.
    pub simplify: Effort,
    /// Units of work at most, if there is a limit: what was found by then counts.
    pub work: Option<u64>,
}

impl SearchEffort {
    /// For an interactive use: seconds for a six-joint arm.
    pub const QUICK: SearchEffort = SearchEffort {
        has_models: false,
        retries: 0,
        again: 0,
        simplify: Effort::Quick,
        work: None,
    };
    /// For a report on several tolerances.
    pub const REPORT: SearchEffort = SearchEffort {
        has_models: true,
        retries: RETRIES,
        ..SearchEffort::QUICK
    };
    /// The most: minutes for a six-joint arm.
    pub const THOROUGH: SearchEffort = SearchEffort {
        again: 10,
        simplify: Effort::Thorough,
        ..SearchEffort::REPORT
    };

    /// Returns the effort of a command that reports on variants.
    pub fn of(effort: Effort) -> SearchEffort {
        match effort {
            Effort::Quick => SearchEffort::REPORT,
            Effort::Thorough => SearchEffort::THOROUGH,
        }
    }
}

/// The function, and how far each result may be off.
#[derive(Clone, Copy)]
pub(super) struct Target<'a> {
    pub(super) setup: &'a Setup,
    pub(super) exact: &'a Program,
    pub(super) reference: &'a Engine,
    pub(super) limits: &'a InputBox,
    /// In the results' units.
    pub(super) allowances: &'a [f64],
    pub(super) effort: &'a SearchEffort,
    pub(super) watch: FunctionWatch<'a>,
    pub(super) meter: Meter,
}

impl Target<'_> {
    pub(super) fn is_over(&self) -> bool {
        self.meter.is_over() || self.watch.is_over()
    }
}

/// Returns programs within the allowances that are cheaper than the exact one, the cheapest first.
pub(super) fn programs(target: Target<'_>, from: &[Program]) -> Vec<Program> {
    let effort = target.effort;
    let mut starts = match effort.has_models {
        true => reduce::programs(target),
        false => Vec::new(),
    };
    starts.push(target.exact.clone());
    starts.sort_by_key(cost);
    // The programs of smaller tolerances are starts as near as any.
    starts.splice(0..0, from.iter().cloned());
    let rounds = starts.len().div_ceil(SIDE_BY_SIDE) + effort.again as usize;
    let mut run = ProgramSearch {
        target,
        programs: Vec::new(),
        rounds: [0, rounds],
        spent: 0,
    };
    let mut ranked: Vec<(usize, usize)> = Vec::new();
    let mut worse = 0;
    let places: Vec<usize> = (0..starts.len()).collect();
    for places in places.chunks(SIDE_BY_SIDE) {
        if target.is_over() || worse >= MOST_WORSE {
            break;
        }
        let trials: Vec<(&Program, u64)> =
            places.iter().map(|&place| (&starts[place], 0)).collect();
        for (price, place) in run.tried(&trials).into_iter().zip(places) {
            let least = run.least();
            ranked.push((price, *place));
            let is_worse = price as f64 > WORSE * least as f64;
            worse = if is_worse { worse + 1 } else { 0 };
        }
    }
    ranked.sort_unstable();
    for seed in 1..=effort.again {
        if target.is_over() || run.programs.is_empty() || run.spent > MOST_AGAIN {
            break;
        }
        let best = ranked.iter().take(SIDE_BY_SIDE);
        let trials: Vec<(&Program, u64)> = best.map(|rank| (&starts[rank.1], seed)).collect();
        run.tried(&trials);
    }
    run.programs
}

/// Starts that are tried beside each other, on any machine.
const SIDE_BY_SIDE: usize = 2;

struct ProgramSearch<'a> {
    target: Target<'a>,
    /// The programs within the allowances, the cheapest first.
    programs: Vec<Program>,
    rounds: [usize; 2],
    /// The work of all starts.
    spent: u64,
}

impl ProgramSearch<'_> {
    fn least(&self) -> usize {
        self.programs.first().map_or(usize::MAX, cost)
    }

    fn tried(&mut self, starts: &[(&Program, u64)]) -> Vec<usize> {
        let best = self.programs.first().map(Program::counts);
        let rounds = [self.rounds[0], self.rounds[1].max(self.rounds[0] + 1)];
        self.target.watch.step(Part::Omissions, rounds, best);
        self.rounds[0] += 1;
        let target = self.target;
        let prune = |(start, seed): &(&Program, u64)| {
            // A thread counts its work for itself.
            let meter = Meter::new(None);
            (pruned(target, start, *seed), meter.done())
        };
        let outcomes: Vec<(Vec<Program>, u64)> = match target.effort.work {
            Some(_) => starts.iter().map(prune).collect(),
            None => parallel::each(starts, prune),
        };
        self.spent += outcomes.iter().map(|outcome| outcome.1).sum::<u64>();
        let least = |outcome: &(Vec<Program>, u64)| outcome.0.iter().map(cost).min();
        let costs = outcomes.iter().map(least);
        let prices = costs.map(|cost| cost.unwrap_or(usize::MAX)).collect();
        for program in outcomes.into_iter().flat_map(|outcome| outcome.0) {
            if !self.programs.contains(&program) {
                self.programs.push(program);
            }
        }
        self.programs.sort_by_key(cost);
        prices
    }
}

/// Returns the programs within the allowances that one start leads to.
fn pruned(target: Target<'_>, start: &Program, seed: u64) -> Vec<Program> {
    let exact = target.exact;
    let mut samples = Samples::new(exact, target.limits, POSITIONS, 7 + seed);
    let mut descent = ConstantDescent {
        target,
        random: Random::new(0xabcd ^ seed),
        noise: if seed == 0 { 0.0 } else { NOISE },
        share: 1.0,
    };
    let (mut now, mut programs) = (start.clone(), Vec::new());
    if cost(start) < cost(exact) && descent.judge(start, 1.0).is_within {
        programs.push(start.clone());
    }
    for part in PARTS {
        if target.is_over() {
            break;
        }
        let is_exact = now == *exact;
        if part < 1.0 && !is_exact && !descent.judge(&now, part).is_within {
            continue;
        }
        let positions = &mut samples.positions;
        let old = positions.len().saturating_sub(2 * POSITIONS + REFUTING);
        positions.drain(POSITIONS..POSITIONS + old);
        match descent.descend(&now, &mut samples, part) {
            Some(program) => {
                let next = simplified(&program, target.effort.simplify);
                if cost(&next) >= cost(&now) {
                    break;
                }
                if cost(&next) < cost(exact) {
                    programs.push(next.clone());
                }
                now = next;
            }
            None if part < 1.0 => {}
            None => break,
        }
    }
    programs
}

struct ConstantDescent<'a> {
    target: Target<'a>,
    random: Random,
    noise: f64,
    /// The share of what is allowed that errors may use at the samples.
    share: f64,
}

impl ConstantDescent<'_> {
    fn allowances(&self, part: f64) -> Vec<f64> {
        let iter = self.target.allowances.iter();
        iter.map(|allowance| part * allowance).collect()
    }

    fn judge(&self, program: &Program, part: f64) -> super::reference::Verdict {
        let allowances = self.allowances(part);
        self.target.reference.judge(program, &allowances)
    }

    /// Edits a program until it is as cheap as the engine admits with a part of the allowances; none if
    /// nothing goes, or nothing that is within.
    fn descend(&mut self, start: &Program, samples: &mut Samples, part: f64) -> Option<Program> {
        let (exact, is_exact) = (self.target.exact, *start == *self.target.exact);
        let allowances = self.allowances(part * self.share);
        let mut greedy = Greedy::new(exact, start, allowances, samples.clone(), self.noise);
        let mut history = vec![greedy.net.unedited()];
        for round in 0..ROUNDS {
            greedy.drop_all(&mut history, &mut self.random, &self.target);
            if history.len() == 1 && is_exact {
                return None;
            }
            let mut state = history[history.len() - 1].clone();
            greedy.finish(&mut state, POLISH);
            let program = greedy.net.rebuilt(&state);
            let verdict = self.judge(&program, part);
            if verdict.is_within {
                let best = match part < 1.0 {
                    true => program,
                    false => self.tried_again(&mut greedy, state, program),
                };
                return (cost(&best) < cost(start)).then_some(best);
            }
            if self.target.is_over() {
                return None;
            }
            // Samples miss errors that the engine finds: the more they miss, the less may be used there.
            // If the engine can neither refute nor show, more samples do not help.
            if round >= BOLD || verdict.is_open {
                let ratio = libm::pow(verdict.ratio.clamp(LEAST_RATIO, MOST_RATIO), CAUTION);
                self.share = (self.share / ratio).max(LEAST_SHARE);
            }
            greedy.samples.add(verdict.positions);
            *samples = greedy.samples.clone();
            greedy.allowances = self.allowances(part * self.share);
            greedy.resample();
            // Back to the last state that is within at the new samples as well.
            let (mut low, mut high) = (0, history.len());
            while high - low > 1 {
                let middle = (low + high) / 2;
                let mut trial = history[middle].clone();
                if greedy.polish(&mut trial, 1) <= 1.0 {
                    history[middle] = trial;
                    low = middle;
                } else {
                    high = middle;
                }
            }
            history.truncate(low + 1);
            if low == 0 && !is_exact && greedy.polish(&mut history[0], POLISH) > 1.0 {
                return None;
            }
        }
        None
    }

    /// Takes parts of the edits back at random, and chooses anew.
    fn tried_again(
        &mut self,
        greedy: &mut Greedy<'_>,
        mut state: Edits,
        mut program: Program,
    ) -> Program {
        let mut live = Vec::new();
        let least = self.target.effort.retries;
        let more = least * RETRIED / (1 + cost(&program));
        for round in 0..least + more {
            if self.target.is_over() {
                break;
            }
            let mut trial = state.clone();
            let part = 0.05 + 0.3 * self.random.unit();
            for edit in &mut trial.edits {
                if self.random.unit() < part {
                    *edit = None;
                }
            }
            greedy.noise = if round % 3 == 0 { 0.0 } else { RETRY_NOISE };
            greedy.polish(&mut trial, 1);
            let mut history = vec![trial];
            greedy.drop_all(&mut history, &mut self.random, &self.target);
            let Some(mut trial) = history.pop() else {
                break;
            };
            greedy.finish(&mut trial, POLISH / 2);
            let [price, least] =
                [&trial, &state].map(|candidate| greedy.net.price(candidate, &mut live));
            if price > least || trial.edits == state.edits {
                continue;
            }
            let other = greedy.net.rebuilt(&trial);
            if self.judge(&other, 1.0).is_within {
                (state, program) = (trial, other);
            }
        }
        program
    }
}

fn simplified(program: &Program, effort: Effort) -> Program {
    let seeds = [program.dag.clone()];
    match search(&seeds, &[], &|n| effort.limits(n), &|_| true, &|_, _| true) {
        Some(best) => program.with_graph(&best.graph.without_vain_steps()),
        None => program.clone(),
    }
}

//! Guesses of what may go, each certified.

use super::columns::Nodes;
use super::greedy::{Greedy, State};
use super::price::SINCOS;
use super::tally::Tally;
use super::{Pruned, Target};
use crate::approximate::motions::Motions;
use crate::bound::definite::is_definite;
use crate::bound::input_box::InputBox;
use crate::bound::{magnitude, sample};
use crate::dag::{Dag, Folding};
use crate::edits::{Stage, deviation, difference, has_edits};
use crate::interval::Interval;
use crate::program::{Program, ScalarType, has_inertia};
use crate::random::Random;
use crate::search::{Effort, search};
use crate::states::JointState;

const POLISH: usize = 12;

/// How much of the allowance sampled errors may use at first.
pub(super) const SHARE: f64 = 0.8;

/// [`SHARE`] where most of the error is a model's, which was fitted.
pub(super) const CLOSE: f64 = 0.95;

/// An output whose certified error is less than this part of its allowance
/// may use more of it; the bound is not tight there.
const USED_ENOUGH: f64 = 0.88;

const MORE: usize = 4;
const CAUTION: f64 = 0.8;

/// In place of the ratio of errors where D may be singular.
const SINGULAR: f64 = 4.0;

pub(super) struct Search<'a> {
    pub target: Target<'a>,
    pub base: Pruned,
    pub paid: usize,
    pub motions: &'a Motions,
    pub tally: &'a Tally<'a>,
    pub guesses: usize,
    pub retries: usize,
    pub is_direct: bool,
}

struct Found {
    pruned: Pruned,
    state: State,
    shares: Vec<f64>,
}

impl Search<'_> {
    pub(super) fn run(
        &self,
        positions: &mut Vec<Vec<f64>>,
        share: &mut f64,
        random: &mut Random,
    ) -> Option<Pruned> {
        if self.tally.is_over() && has_edits(&self.base.stages) {
            return None;
        }
        let mut prices = vec![1.0; self.target.allowances.len()];
        let found = self.guess(positions, *share, &mut prices, random)?;
        if self.hurries() {
            let used = found.pruned.errors.iter().zip(self.target.allowances);
            let used = used.fold(0.0, |most, (&e, &a)| {
                f64::max(most, magnitude::relative(e, a))
            });
            let least = found.shares.iter().copied().fold(SHARE, f64::min);
            *share = (least / used.clamp(0.1, 1.0).sqrt()).min(SHARE);
        }
        let mut best = self.again(found, positions, &prices, random);
        best.program = finish(&best.stages, Some(self.target.settings.effort));
        (cost(&best.program) < self.paid).then_some(best)
    }

    fn guess(
        &self,
        positions: &mut Vec<Vec<f64>>,
        share: f64,
        prices: &mut [f64],
        random: &mut Random,
    ) -> Option<Found> {
        let mut shares = vec![share; self.target.allowances.len()];
        let mut best: Option<Found> = None;
        // The first guess at a long program tries most of what cannot be, and the others need not.
        let mut never = Vec::new();
        for round in 0..self.guesses + MORE {
            let enough = round >= self.guesses || self.tally.is_over();
            let over = round > 0 && self.tally.is_over();
            if over || best.is_some() && enough {
                break;
            }
            let so_far = best.as_ref().map(|found| &found.pruned.program);
            self.tally.round(so_far.unwrap_or(&self.base.program));
            let (original, truth) = self.sampled(&self.motions.states(positions));
            let greedy = self.greedy(&original, &truth, &shares, prices);
            never.resize(original.len(), Vec::new());
            let mut greedy = greedy.knowing(std::mem::take(&mut never));
            let mut state = State::unedited(original.clone());
            greedy.drop_all(&mut state, 0.0, random);
            greedy.settle(&mut state, &original, POLISH);
            if self.hurries() {
                never = std::mem::take(&mut greedy.never);
            }
            for (price, used) in prices.iter_mut().zip(greedy.relative(&state)) {
                *price *= 0.3 + used;
            }
            let (pruned, ratios) = self.certify(&original, &state, &mut greedy);
            self.adversaries(&pruned.stages, positions, random);
            let settings = self.target.settings;
            let most = settings.positions(self.target.steps(), self.target.allowances.len());
            let old = positions.len().saturating_sub(most);
            positions.drain(settings.samples..settings.samples + old);
            let cheaper = best
                .as_ref()
                .is_none_or(|b| cost(&pruned.program) < cost(&b.pruned.program));
            if within(&ratios) && cheaper {
                best = Some(Found {
                    pruned,
                    state,
                    shares: shares.clone(),
                });
            }
            // Until something is certified the worst output decides for all:
            // what is left out for one moves the others.
            let worst = ratios.iter().copied().fold(0.0, f64::max);
            for (share, ratio) in shares.iter_mut().zip(ratios) {
                let ratio = if best.is_none() { worst } else { ratio };
                *share = match ratio < USED_ENOUGH {
                    true => (1.1 * *share).min(1.0),
                    false => (*share / libm::pow(ratio.min(5.0), 0.9) * 0.99).min(1.5),
                };
                if best.is_none() && round + 1 >= self.guesses {
                    *share *= CAUTION;
                }
            }
        }
        best
    }

    fn again(
        &self,
        found: Found,
        positions: &[Vec<f64>],
        prices: &[f64],
        random: &mut Random,
    ) -> Pruned {
        let Found {
            mut pruned,
            mut state,
            mut shares,
        } = found;
        let states = self.motions.states(positions);
        let (original, truth) = self.sampled(&states);
        state.nodes.move_to(&states);
        // The samples have grown since: what is certified must rank as within.
        let whole = vec![1.0; shares.len()];
        let used = self.greedy(&original, &truth, &whole, prices);
        for (share, used) in shares.iter_mut().zip(used.relative(&state)) {
            *share = share.max(1.001 * used);
        }
        let mut greedy = self.greedy(&original, &truth, &shares, prices);
        let mut paid = greedy.price(&state);
        for round in 0..self.retries {
            if self.tally.is_over() {
                break;
            }
            self.tally.round(&pruned.program);
            let mut trial = state.clone();
            let part = 0.05 + 0.3 * random.unit();
            for edit in &mut trial.edits {
                if random.unit() < part {
                    *edit = None;
                }
            }
            let noise = if round % 3 == 0 { 0.0 } else { 0.6 };
            greedy.polish(&mut trial, 1);
            greedy.drop_all(&mut trial, noise, random);
            greedy.settle(&mut trial, &original, POLISH / 3);
            let price = greedy.price(&trial);
            if price <= paid
                && trial.edits != state.edits
                && let Some(certified) = self.certified(&original, &trial, &mut greedy)
            {
                (state, paid, pruned) = (trial, price, certified);
            }
        }
        pruned
    }

    fn sampled(&self, states: &[JointState]) -> (Nodes, Vec<f64>) {
        let truth = self.target.exact.in_doubles().run_at_many(states);
        (Nodes::new(&self.base.program, states), truth.concat())
    }

    fn hurries(&self) -> bool {
        self.target.settings.hurries(self.target.steps())
    }

    fn greedy<'t>(
        &'t self,
        nodes: &Nodes,
        truth: &'t [f64],
        shares: &[f64],
        prices: &[f64],
    ) -> Greedy<'t> {
        let pairs = self.target.allowances.iter().zip(shares);
        let allowances = pairs.map(|(allowance, share)| allowance * share).collect();
        let (prices, settings) = (prices.to_vec(), self.target.settings);
        Greedy::new(nodes, self.motions, truth, allowances, prices, settings)
    }

    fn certify(
        &self,
        original: &Nodes,
        state: &State,
        greedy: &mut Greedy<'_>,
    ) -> (Pruned, Vec<f64>) {
        let (mut pruned, error) = self.variant(original, state, greedy);
        let Target {
            limits, allowances, ..
        } = self.target;
        pruned.errors = magnitude::judged(&error, limits, allowances, self.target.settings.budget);
        let pairs = pruned.errors.iter().zip(allowances);
        let mut ratios: Vec<f64> = pairs.map(|(&e, &a)| magnitude::relative(e, a)).collect();
        // Too much went as well if D may become singular: the next guess leaves out less.
        if within(&ratios) && !self.is_definite(&pruned.program) {
            ratios.fill(SINGULAR);
        }
        (pruned, ratios)
    }

    fn certified(
        &self,
        original: &Nodes,
        state: &State,
        greedy: &mut Greedy<'_>,
    ) -> Option<Pruned> {
        let (mut pruned, error) = self.variant(original, state, greedy);
        let (limits, budget) = (self.target.limits, self.target.settings.budget);
        let allowances = self.target.allowances;
        pruned.errors = magnitude::magnitudes_within(&error, limits, allowances, budget)?;
        self.is_definite(&pruned.program).then_some(pruned)
    }

    fn variant(&self, original: &Nodes, state: &State, greedy: &mut Greedy<'_>) -> (Pruned, Dag) {
        let mut stages = self.base.stages.clone();
        stages.push(Stage {
            program: self.base.program.clone(),
            edits: greedy.edits(original, state),
        });
        let program = finish(&stages, None);
        let error = match self.is_direct {
            true => deviation(self.target.exact, &program),
            false => difference(&stages),
        };
        let pruned = Pruned {
            program,
            stages,
            errors: Vec::new(),
        };
        (pruned, error)
    }

    fn is_definite(&self, program: &Program) -> bool {
        !has_inertia(program) || is_definite(program, ScalarType::F64, &[], self.target.limits)
    }

    fn adversaries(&self, stages: &[Stage], positions: &mut Vec<Vec<f64>>, random: &mut Random) {
        let Some(last) = stages.last() else { return };
        let edited = last.program(Folding::Syntactic);
        let limits = self.target.limits;
        let middle: Vec<f64> = limits.position.iter().map(|range| range.mid()).collect();
        let motions = self.motions.states(&[middle]);
        let mut both = [self.target.exact, &edited].map(|program| Nodes::new(program, &motions));
        let unedited = both.each_ref().map(|nodes| vec![None; nodes.len()]);
        for output in 0..self.target.allowances.len() {
            let mut error = |state: &JointState| {
                let [x, y] = [0, 1].map(|which| {
                    both[which].turn_to(state);
                    both[which].run(&unedited[which])
                });
                let [x, y] = [both[0].output(output, &x), both[1].output(output, &y)];
                let mut error: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x - y).collect();
                self.motions.monomials(&mut error);
                self.motions.largest(&error)
            };
            let from = sample::draw(limits, random);
            let still = vec![Interval::ZERO; from.q.len()];
            let still = InputBox {
                position: limits.position.clone(),
                velocity: still.clone(),
                acceleration: still,
            };
            let (state, _) = sample::climb(&still, from, 300, random, &mut error);
            positions.push(state.q);
        }
    }
}

fn within(ratios: &[f64]) -> bool {
    ratios.iter().all(|ratio| *ratio <= 1.0)
}

fn finish(stages: &[Stage], effort: Option<Effort>) -> Program {
    let last = &stages[stages.len() - 1];
    let graph = [last.edited(Folding::Semantic)];
    let found = effort.and_then(|effort| {
        let limits = |operations| effort.limits(operations);
        search(&graph, &[], &limits, &|_| true, &|_, _| true)
    });
    let graph = found.as_ref().map_or(&graph[0], |found| &found.graph);
    last.program.with_graph(graph)
}

pub(crate) fn cost(program: &Program) -> usize {
    let counts = program.counts();
    counts.operations() + SINCOS as usize * counts.sincos
}

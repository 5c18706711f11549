//! Dropping by rank: the least error an operation saved goes first.
//!
//! - this file: what goes, one by one
//! - `candidates`: what may stand in a value's place; `rank`: which is best
//! - `measure`: errors at the samples; `polish`: constants against them

mod candidates;
mod measure;
mod polish;
mod rank;

use super::PruneSettings;
use super::columns::{Nodes, Value};
use super::fit::LANES;
use super::price::{Scratch, price};
use crate::approximate::motions::Motions;
use crate::edits::Edit;
use crate::random::Random;

#[derive(Clone)]
pub(super) struct State {
    pub nodes: Nodes,
    pub edits: Vec<Option<Value>>,
}

impl State {
    pub(super) fn unedited(nodes: Nodes) -> State {
        State {
            edits: vec![None; nodes.len()],
            nodes,
        }
    }
}

pub(super) struct Greedy<'a> {
    motions: &'a Motions,
    truth: &'a [f64],
    allowances: Vec<f64>,
    /// Weights of the least squares, row by row: 1/allowance, and more where errors are largest.
    weights: Vec<f64>,
    levels: Vec<f64>,
    scratch: Scratch,
    trial: Vec<f64>,
    dirty: Vec<bool>,
    /// Values that cannot stand in each node's place.
    hopeless: Vec<Vec<Value>>,
    /// Those that could not even if errors counted half.
    pub(super) never: Vec<Vec<Value>>,
    prices: Vec<f64>,
    reuses: usize,
    ranked_again: usize,
    alike: usize,
}

#[derive(Clone, Copy)]
struct Ranked {
    node: usize,
    value: Value,
    score: f64,
}

/// The candidates that are ranked again before one is taken; of long programs, as many as
/// are corrected side by side.
const RANKED_AGAIN: usize = 24;

/// In place of an allowance of zero, where nothing may go.
const TINY: f64 = 1e-12;

/// How many are taken before all are ranked again: of long programs, a part of their
/// values, since each changes the less about the others.
const FRESH: usize = 10;
const FRESH_PART: usize = 32;

/// Of long programs, each edit changes little about what constants can do: their
/// derivatives, of which one set takes as long as a choice, serve for so many more
/// edits, as long as constants corrected by them make up for these.
const REUSES: usize = 3;

impl<'a> Greedy<'a> {
    pub(super) fn new(
        nodes: &Nodes,
        motions: &'a Motions,
        truth: &'a [f64],
        allowances: Vec<f64>,
        prices: Vec<f64>,
        settings: &PruneSettings,
    ) -> Self {
        let m = nodes.samples;
        let hurries = settings.hurries(nodes.steps.len());
        let weights: Vec<f64> = allowances
            .iter()
            .flat_map(|a| vec![1.0 / a.max(TINY); m])
            .collect();
        Greedy {
            motions,
            truth,
            allowances,
            levels: vec![1.0; weights.len() / motions.len()],
            weights,
            scratch: Scratch::default(),
            trial: Vec::new(),
            dirty: Vec::new(),
            hopeless: vec![Vec::new(); nodes.len()],
            never: vec![Vec::new(); nodes.len()],
            prices,
            reuses: if hurries { REUSES } else { 0 },
            ranked_again: if hurries { LANES } else { RANKED_AGAIN },
            alike: settings.alike,
        }
    }

    /// Takes over from a search on the same nodes what no larger shares of the allowances would
    /// change.
    pub(super) fn knowing(mut self, never: Vec<Vec<Value>>) -> Self {
        self.hopeless.clone_from(&never);
        self.never = never;
        self
    }

    pub(super) fn price(&mut self, state: &State) -> u32 {
        price(&state.nodes, &state.edits, &mut self.scratch)
    }

    /// `noise` blurs the ranking.
    pub(super) fn drop_all(&mut self, state: &mut State, noise: f64, random: &mut Random) {
        let mut columns = state.nodes.run(&state.edits);
        let mut fit = self.fit(state, &columns);
        let mut refused = vec![false; state.nodes.len()];
        let fresh = FRESH.max(state.nodes.len() / FRESH_PART);
        let mut reused = 0;
        loop {
            let mut ranked = self.rank_all(state, &columns, &fit, &refused, noise, random);
            if ranked.is_empty() {
                return;
            }
            ranked.sort_by(|a, b| a.score.total_cmp(&b.score));
            let mut taken = 0;
            while taken < fresh {
                let before = self.settled(state, &columns, &fit).sum;
                let paid = self.price(state);
                let live = self.scratch.live.clone();
                ranked
                    .retain(|c| state.edits[c.node].is_none() && live[c.node] && !refused[c.node]);
                let count = self.ranked_again.min(ranked.len());
                let first = &mut ranked[..count];
                let again: Vec<_> = first.iter().map(|c| (c.node, c.value)).collect();
                let scores = self.scores(state, &columns, &fit, &again, (before, paid));
                let mut best: Option<Ranked> = None;
                for (candidate, score) in first.iter_mut().zip(scores) {
                    candidate.score =
                        score.unwrap_or(f64::INFINITY) * (1.0 + noise * random.unit());
                    if candidate.score < best.map_or(f64::INFINITY, |best| best.score) {
                        best = Some(*candidate);
                    }
                }
                let Some(Ranked { node, value, .. }) = best else {
                    break;
                };
                taken += 1;
                ranked.retain(|c| c.score.is_finite());
                ranked.sort_by(|a, b| a.score.total_cmp(&b.score));
                state.edits[node] = Some(value);
                let edited = state.nodes.run(&state.edits);
                if reused < self.reuses
                    && let Some(corrected) = self.corrected(state, edited.clone(), &fit)
                {
                    (columns, reused) = (corrected, reused + 1);
                    continue;
                }
                reused = 0;
                let refitted = self.fit(state, &edited);
                if let Some(corrected) = self.corrected(state, edited, &refitted) {
                    (columns, fit) = (corrected, refitted);
                } else {
                    // Constants cannot make up for it as hoped.
                    state.edits[node] = None;
                    columns = state.nodes.run(&state.edits);
                    refused[node] = true;
                }
            }
            if taken == 0 {
                return;
            }
        }
    }

    pub(super) fn restore_idle(&mut self, state: &mut State) {
        let mut paid = self.price(state);
        for node in (0..state.edits.len()).rev() {
            if state.edits[node].is_some() {
                let kept = state.edits[node].take();
                let price = self.price(state);
                if price > paid {
                    state.edits[node] = kept;
                } else {
                    paid = price;
                }
            }
        }
    }

    pub(super) fn settle(&mut self, state: &mut State, original: &Nodes, rounds: usize) {
        self.restore_idle(state);
        self.polish(state, rounds);
        state.nodes.shorten(original);
    }

    pub(super) fn edits(&mut self, original: &Nodes, state: &State) -> Vec<Edit> {
        let mut state = state.clone();
        self.price(&state);
        let inputs = state.nodes.inputs.len();
        for (index, was) in original.steps.iter().enumerate() {
            if !self.scratch.live[inputs + index] {
                state.nodes.steps[index] = *was;
            }
        }
        state.nodes.edits(original, &state.edits)
    }
}

//! One program edited: values leave it, the least error for each operation saved first.
//!
//! An edit puts a constant, or a multiple of an earlier value, in a value's place. To first order it
//! changes the results by the derivative by that value, and a small change of each constant of the
//! program by the derivative by that constant: so least squares (`corrections`) tell what is left of the
//! errors once the constants are corrected for it. Sums of squares rank all edits; the first ones are
//! run, and their largest errors decide.
//!
//! Rows of errors are coefficients at the largest rates ([`Samples`]), in units of what is allowed.

use super::corrections::{Frame, change};
use super::linear::dot;
use super::net::{Arg, Edits, Net, NodeValue, seven_digits};
use super::samples::Samples;
use super::search::Target;
use crate::program::{Operation, Program};
use crate::random::Random;

/// The rows of a sketch by which values are told that run alike.
const ALIKE: usize = 96;
/// The cosine of two values that run alike, and how many of them are tried.
const ALIKE_AT_LEAST: f64 = 0.5;
const MOST_ALIKE: usize = 3;
/// The edits that are run, those that are kept for the next ones, and the edits until all are ranked
/// anew.
const LOOKED_AT: usize = 16;
const POOL: usize = 80;
const FRESH: usize = 12;
/// An error so little above what is allowed is worth a correction of all constants.
const NEARLY: f64 = 1.1;

pub(super) struct Greedy<'a> {
    exact: &'a Program,
    /// The error that each result may have.
    pub(super) allowances: Vec<f64>,
    pub(super) net: Net,
    pub(super) samples: Samples,
    inputs: Vec<f64>,
    pub(super) truth: Vec<f64>,
    buckets: Vec<(usize, f64)>,
    /// The share by which the ranking is blurred.
    pub(super) noise: f64,
}

impl<'a> Greedy<'a> {
    pub(super) fn new(
        exact: &'a Program,
        start: &Program,
        allowances: Vec<f64>,
        samples: Samples,
        noise: f64,
    ) -> Greedy<'a> {
        let mut greedy = Greedy {
            exact,
            allowances,
            net: Net::new(start),
            samples,
            inputs: Vec::new(),
            truth: Vec::new(),
            buckets: Vec::new(),
            noise,
        };
        greedy.resample();
        greedy
    }

    /// Runs the exact program at the samples.
    pub(super) fn resample(&mut self) {
        self.inputs = self.net.columns(&self.samples);
        self.truth = Net::at(self.exact, &self.samples);
        let mut random = Random::new(0x5ce7);
        let mut bucket = || {
            let sign = if random.below(2) == 0 { -1.0 } else { 1.0 };
            (random.bits() as u32 as usize, sign)
        };
        self.buckets = self.truth.iter().map(|_| bucket()).collect();
    }

    pub(super) fn run(&self, state: &Edits) -> Vec<f64> {
        self.net.run(state, &self.inputs, self.samples.len())
    }

    pub(super) fn errors(&self, values: &[f64]) -> Vec<f64> {
        let mut errors = self.net.results(values, self.samples.len());
        let pairs = errors.iter_mut().zip(&self.truth);
        pairs.for_each(|(error, truth)| *error -= truth);
        self.scale(&mut errors);
        errors
    }

    /// Turns differences at the samples into rows.
    pub(super) fn scale(&self, rows: &mut [f64]) {
        let results = rows.chunks_exact_mut(self.samples.len()).enumerate();
        results.for_each(|(result, rows)| self.scale_result(result, rows));
    }

    fn scale_result(&self, result: usize, rows: &mut [f64]) {
        self.samples.coefficients(rows);
        let by = 1.0 / self.allowances[result].max(1e-30);
        rows.iter_mut().for_each(|x| *x *= by);
    }

    pub(super) fn worst(&self, state: &Edits) -> f64 {
        let blocks = self.samples.blocks(&self.errors(&self.run(state)));
        blocks.into_iter().fold(0.0, f64::max)
    }

    /// Returns the sum over the results of their largest errors, and the largest of all.
    pub(super) fn summed(&self, blocks: &[f64]) -> (f64, f64) {
        let results = blocks.chunks_exact(self.samples.positions.len());
        let most = results.map(|errors| errors.iter().copied().fold(0.0, f64::max));
        most.fold((0.0, 0.0), |(sum, worst): (f64, f64), error| {
            (sum + error, worst.max(error))
        })
    }

    pub(super) fn sketch(&self, rows: &[f64], weights: &[f64], size: usize) -> Vec<f64> {
        let mut out = vec![0.0; size];
        let results = rows.chunks_exact(self.samples.len()).enumerate();
        results.for_each(|(result, rows)| self.sketch_result(result, rows, weights, &mut out));
        out
    }

    /// Adds the rows of one result to a sketch. Most values reach few results: the other rows are zero.
    fn sketch_result(&self, result: usize, rows: &[f64], weights: &[f64], out: &mut [f64]) {
        if is_zero(rows) {
            return;
        }
        let (block, size) = (self.samples.block(), out.len());
        let weights = &weights[result * self.samples.positions.len()..];
        let buckets = &self.buckets[result * rows.len()..][..rows.len()];
        for ((rows, buckets), weight) in rows.chunks(block).zip(buckets.chunks(block)).zip(weights)
        {
            for (x, (bucket, sign)) in rows.iter().zip(buckets) {
                // The upper bits of a product of 32 by 32.
                out[(bucket * size) >> 32] += weight * sign * x;
            }
        }
    }

    fn blur(&self, random: &mut Random) -> f64 {
        1.0 + self.noise * random.unit()
    }

    /// Ranks edits by the growth of squares for each operation saved, to first order.
    fn rank(
        &self,
        frame: &Frame,
        state: &mut Edits,
        paid: u32,
        edits: &[(usize, NodeValue)],
        random: &mut Random,
    ) -> Vec<(f64, usize, NodeValue)> {
        let m = self.samples.len();
        let coarse = &frame.coarse;
        let base = self.sketch(&frame.errors, &frame.weights, coarse.size);
        let before = Self::squares(coarse, &base, &[]);
        // The squares of errors that are allowed come to no more than this.
        let most = dot(&frame.weights, &frame.weights);
        let (mut ranked, mut live, mut part) = (Vec::new(), Vec::new(), Vec::new());
        for &(node, value) in edits {
            let kept = state.edits[node].replace(value);
            let price = self.net.price(state, &mut live);
            state.edits[node] = kept;
            if price >= paid {
                continue;
            }
            let values = &frame.values[node * m..][..m];
            let mut rows = vec![0.0; coarse.size];
            for (result, adjoint) in frame.adjoints.iter().enumerate() {
                let adjoint = &adjoint[node * m..][..m];
                if is_zero(adjoint) {
                    continue;
                }
                let pairs = adjoint.iter().zip(values);
                part.clear();
                match value {
                    NodeValue::Constant(c) => part.extend(pairs.map(|(a, x)| a * (c - x))),
                    NodeValue::Times(c, other) => {
                        let others = &frame.values[other * m..];
                        part.extend(pairs.zip(others).map(|((a, x), y)| a * (c * y - x)));
                    }
                }
                self.scale_result(result, &mut part);
                self.sketch_result(result, &part, &frame.weights, &mut rows);
            }
            let sums = rows.iter_mut().zip(&base);
            sums.for_each(|(x, entry)| *x += entry);
            let gone = Self::gone(frame, &live, Some(node));
            let growth = Self::squares(coarse, &rows, &gone) - before;
            if growth <= most {
                let score = growth.max(1e-9) / f64::from(paid - price);
                ranked.push((score * self.blur(random), node, value));
            }
        }
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        ranked
    }

    /// Edits until nothing that saves an operation is allowed at the samples; returns the states on the
    /// way behind those that are there.
    pub(super) fn drop_all(&self, path: &mut Vec<Edits>, random: &mut Random, target: &Target<'_>) {
        let mut state = path[path.len() - 1].clone();
        let mut refused: Vec<(usize, NodeValue)> = Vec::new();
        let mut pool: Vec<(usize, NodeValue)> = Vec::new();
        let mut live = Vec::new();
        for edits in 0.. {
            if target.is_over() {
                return;
            }
            let paid = self.net.price(&state, &mut live);
            let mut frame = self.frame(&state, &live);
            // Constants as they are best now: then what the frame says of changes is nearly true.
            let corrected = self.left(&frame, frame.errors.clone(), &[]);
            let mut next = state.clone();
            change(&mut next, &frame.unknowns, &corrected.change);
            let values = self.run(&next);
            let errors = self.errors(&values);
            let [old, new] =
                [&frame.errors, &errors].map(|errors| self.summed(&self.samples.blocks(errors)));
            if new.0 < old.0 && new.1 <= 1.0 {
                (state, frame.values, frame.errors) = (next, values, errors);
                if let Some(last) = path.last_mut() {
                    last.clone_from(&state);
                }
            }
            let now = self.left(&frame, frame.errors.clone(), &[]).sum;
            let is_open =
                |edit: &(usize, NodeValue), state: &Edits, refused: &[(usize, NodeValue)]| {
                    state.edits[edit.0].is_none() && live[edit.0] && !refused.contains(edit)
                };
            let mut is_fresh = false;
            let next = loop {
                pool.retain(|edit| is_open(edit, &state, &refused));
                if pool.is_empty() && is_fresh {
                    return;
                }
                if !is_fresh && (pool.is_empty() || edits % FRESH == 0) {
                    pool = self.candidates(&state, &frame.values, &live);
                    pool.retain(|edit| is_open(edit, &state, &refused));
                    is_fresh = true;
                }
                let ranked = self.rank(&frame, &mut state, paid, &pool, random);
                pool = ranked.into_iter().map(|edit| (edit.1, edit.2)).collect();
                pool.truncate(POOL);
                let look: Vec<(usize, NodeValue)> = pool.iter().copied().take(LOOKED_AT).collect();
                if let Some(next) =
                    self.next_edit(&frame, &mut state, (paid, now), &look, &mut refused, random)
                {
                    break next;
                }
                refused.extend(look);
            };
            state = next;
            path.push(state.clone());
        }
    }

    fn next_edit(
        &self,
        frame: &Frame,
        state: &mut Edits,
        (paid, now): (u32, f64),
        look: &[(usize, NodeValue)],
        refused: &mut Vec<(usize, NodeValue)>,
        random: &mut Random,
    ) -> Option<Edits> {
        let mut near: Vec<(f64, usize, NodeValue, Vec<f64>)> = Vec::new();
        let mut live = Vec::new();
        for &(node, value) in look {
            let kept = state.edits[node].replace(value);
            let price = self.net.price(state, &mut live);
            let rows = self.errors(&self.run(state));
            state.edits[node] = kept;
            let left = self.left(frame, rows, &Self::gone(frame, &live, Some(node)));
            if left.worst <= 1.0 && price < paid {
                let growth = (left.sum - now).max(0.0) + 1e-9;
                let score = growth / f64::from(paid - price) * self.blur(random);
                near.push((score, node, value, left.change));
            }
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, node, value, corrections) in near {
            let mut trial = state.clone();
            change(&mut trial, &frame.unknowns, &corrections);
            trial.edits[node] = Some(value);
            let mut worst = self.worst(&trial);
            if worst > 1.0 && worst < NEARLY {
                worst = self.polish(&mut trial, 2);
            }
            if worst <= 1.0 {
                return Some(trial);
            }
            refused.push((node, value));
        }
        None
    }

    /// Returns the values that may stand in the nodes' places: a constant, an operand of a sum, a value
    /// that runs alike.
    fn candidates(&self, state: &Edits, values: &[f64], live: &[bool]) -> Vec<(usize, NodeValue)> {
        let (m, count) = (self.samples.len(), self.net.inputs.len());
        let direction = |node: usize| {
            if !live[node] {
                return None;
            }
            let mut column = values[node * m..][..m].to_vec();
            self.samples.coefficients(&mut column);
            let mut out = vec![0.0; ALIKE];
            for (x, (bucket, sign)) in column.iter().zip(&self.buckets) {
                out[(bucket * ALIKE) >> 32] += sign * x;
            }
            let size = dot(&out, &out).sqrt();
            (size > 0.0).then_some((out, size))
        };
        let directions: Vec<_> = (0..self.net.len()).map(direction).collect();
        let mut candidates = Vec::new();
        let is_open = |node: &usize| live[*node] && state.edits[*node].is_none();
        for node in (0..self.net.len()).filter(is_open) {
            let column = &values[node * m..][..m];
            let low = column.iter().copied().fold(f64::INFINITY, f64::min);
            let high = column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let middle = 0.5 * (low + high);
            let mut replacements = vec![NodeValue::Constant(0.0)];
            if middle.abs() > 0.2 * (high - low) {
                replacements.push(NodeValue::Constant(seven_digits(middle)));
            }
            if node >= count {
                let op = &state.ops[node - count];
                if op.operation != Operation::Mul {
                    let is_difference = op.operation == Operation::Sub;
                    let sign = if is_difference { -1.0 } else { 1.0 };
                    for (arg, sign) in op.args.iter().zip([1.0, sign]) {
                        if let Arg::Node(node) = arg {
                            replacements.push(NodeValue::Times(sign, *node));
                        }
                    }
                }
                let mut alike: Vec<(f64, usize, f64)> = Vec::new();
                for (other, theirs) in directions[..node].iter().enumerate() {
                    if let (Some((mine, size)), Some((theirs, length))) =
                        (&directions[node], theirs)
                    {
                        let product = dot(mine, theirs);
                        let cosine = product.abs() / (size * length);
                        if cosine > ALIKE_AT_LEAST {
                            alike.push((cosine, other, product / (length * length)));
                        }
                    }
                }
                alike.sort_by(|a, b| b.0.total_cmp(&a.0));
                let is_constant = |arg: &Arg| matches!(arg, Arg::Constant(_));
                let is_multiple = op.operation == Operation::Mul && op.args.iter().any(is_constant);
                for &(_, other, factor) in alike.iter().take(MOST_ALIKE) {
                    replacements.push(NodeValue::Times(factor.signum(), other));
                    if !is_multiple {
                        replacements.push(NodeValue::Times(seven_digits(factor), other));
                    }
                }
            }
            replacements.dedup();
            candidates.extend(replacements.into_iter().map(|value| (node, value)));
        }
        candidates
    }

    /// Takes back what saves nothing, corrects constants and rounds them to seven digits.
    pub(super) fn finish(&self, state: &mut Edits, rounds: usize) {
        let mut without = state.clone();
        let mut live = Vec::new();
        let paid = self.net.price(&without, &mut live);
        for node in (0..without.edits.len()).rev() {
            let edit = without.edits[node].take();
            if edit.is_some() && self.net.price(&without, &mut live) > paid {
                without.edits[node] = edit;
            }
        }
        if self.worst(&without) <= 1.001 * self.worst(state) {
            *state = without;
        }
        self.polish(state, rounds);
        for (op, was) in state.ops.iter_mut().zip(&self.net.ops) {
            for (arg, was) in op.args.iter_mut().zip(&was.args) {
                if let (Arg::Constant(c), Arg::Constant(was)) = (arg, was) {
                    *c = match (*c - was).abs() <= 1e-7 * was.abs() {
                        true => *was,
                        false => seven_digits(*c),
                    };
                }
            }
        }
        for edit in state.edits.iter_mut().flatten() {
            match edit {
                NodeValue::Constant(c) | NodeValue::Times(c, _) => *c = seven_digits(*c),
            }
        }
    }
}

pub(super) fn is_zero(rows: &[f64]) -> bool {
    rows.iter().all(|x| *x == 0.0)
}

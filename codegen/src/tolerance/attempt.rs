//! An attempt to refute a bound: the emitted text is run at corners and random states of the box, and
//! climbs to where it errs most.
//!
//! The text runs in its scalar, polynomials for sines and all. Doubles of the exact program say where
//! errors are large; how large they are there is found in 256 bits, so a violation is one.

use dalembert_checker::Fault;

use super::input_box::InputBox;
use super::sample::climb;
use super::variant::Variant;
use crate::language::read::Signature;
use crate::program::{Code, ScalarType};
use crate::random::Random;
use crate::setup::Setup;
use crate::states::JointState;
use crate::verify::truth::Reference;

/// States that are run at once: their columns stay in a processor's cache.
const BLOCK: usize = 128;
const MOVES: usize = 600;
/// The climbs to where rounding may cost most go on in the last bits of the state: moves, how
/// many at once, and how far they go.
const TOPS: usize = 6;
const LAST_MOVES: usize = 1024;
const NEIGHBOURS: usize = 16;
const LAST: [f64; 4] = [1e-3, 1e-4, 1e-5, 3e-6];

/// The largest errors that were seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attempt {
    /// One a result, relative to its T; none at no state.
    pub observed: Option<Vec<f64>>,
    /// The first result that errs by more than its bound, and where.
    pub violation: Option<(usize, JointState)>,
}

/// Runs a variant at so many states, and climbs so often for each result.
pub fn attempt(
    setup: &Setup,
    variant: &Variant,
    samples: usize,
    climbs: usize,
    seed: u64,
) -> Result<Attempt, Fault> {
    let signature = Signature::of(&variant.emitted, variant.scalar);
    let run = VariantCode {
        variant,
        emitted: Code::parse(&variant.text, &signature)?,
        exact: variant.exact.in_doubles(),
    };
    let loading = variant.loading()?;
    let draw = |random: &mut Random| variant.draw(loading.as_ref(), random);
    let limits = &variant.limits;
    let mut random = Random::new(seed);
    let mut tops = vec![Vec::new(); variant.exact.dag.outputs.len()];
    for first in (0..samples).step_by(BLOCK) {
        let count = BLOCK.min(samples - first);
        let states: Vec<JointState> = (0..count).map(|_| draw(&mut random)).collect();
        for (top, errors) in tops.iter_mut().zip(run.errors(&states)) {
            let pairs = errors.into_iter().zip(states.iter().cloned());
            let worst = pairs.max_by(|a, b| a.0.total_cmp(&b.0));
            top.extend(worst);
            top.sort_by(|a: &(f64, JointState), b| b.0.total_cmp(&a.0));
            top.truncate(1);
        }
    }
    for (output, top) in tops.iter_mut().enumerate() {
        let mut climbed: Vec<(JointState, f64)> = Vec::new();
        for round in 0..climbs {
            let from = match (round, top.first()) {
                (0, Some((_, state))) => state.clone(),
                _ => draw(&mut random),
            };
            let mut error = |state: &JointState| run.error(output, state);
            let (state, _) = climb(limits, from, MOVES, &mut random, &mut error);
            let mut cost = |state: &JointState| rounding_estimate(&run.emitted, output, state);
            climbed.push(climb(limits, state.clone(), MOVES, &mut random, &mut cost));
            top.push((run.error(output, &state), state));
        }
        climbed.sort_by(|a, b| b.1.total_cmp(&a.1));
        climbed.truncate(TOPS);
        let last = |(state, _)| run.last_bits(output, state, &mut random);
        top.extend(climbed.into_iter().map(last));
    }
    let reference = Reference::new(setup);
    let mut attempt = Attempt::default();
    for (output, top) in tops.iter().enumerate() {
        let [scale, bound] = [variant.scales[output], variant.bounds[output].total()];
        for (_, state) in top {
            let state = held(state, variant.scalar, limits);
            let result = run.emitted.run_at(&state).get(output).copied();
            let truths = reference.run_program(&variant.exact, &state);
            let truth = truths.as_ref().and_then(|truths| truths.get(output));
            let distance = truth.map_or(f64::INFINITY, |x| x.error(result.unwrap_or(f64::NAN)));
            let error = if distance == 0.0 {
                0.0
            } else {
                distance / scale
            };
            let observed = &mut attempt.observed;
            let largest = observed.get_or_insert_with(|| vec![0.0; tops.len()]);
            largest[output] = largest[output].max(error);
            if error > bound && attempt.violation.is_none() {
                attempt.violation = Some((output, state));
            }
        }
    }
    Ok(attempt)
}

struct VariantCode<'v> {
    variant: &'v Variant,
    emitted: Code,
    exact: Code,
}

impl VariantCode<'_> {
    fn error(&self, output: usize, state: &JointState) -> f64 {
        self.errors(std::slice::from_ref(state))[output][0]
    }

    fn errors(&self, states: &[JointState]) -> Vec<Vec<f64>> {
        let Variant { scalar, limits, .. } = self.variant;
        let states: Vec<JointState> = states.iter().map(|s| held(s, *scalar, limits)).collect();
        let exact = self.exact.run_at_many(&states);
        let mut emitted = self.emitted.run_at_many(&states);
        if emitted.len() != exact.len() {
            // A text that reads what is not there, or returns too little.
            emitted = vec![vec![f64::NAN; states.len()]; exact.len()];
        }
        let error = |(x, y): (&f64, &f64)| match x.is_finite() {
            true => (x - y).abs(),
            false => f64::INFINITY,
        };
        let column = |(x, y): (&Vec<f64>, &Vec<f64>)| x.iter().zip(y).map(error).collect();
        emitted.iter().zip(&exact).map(column).collect()
    }

    /// Climbs by steps so small that what roundings have in common is all that changes.
    fn last_bits(&self, output: usize, from: JointState, random: &mut Random) -> (f64, JointState) {
        let limits = &self.variant.limits;
        let mut best = (0.0, from);
        for step in 0..LAST_MOVES {
            let reach = LAST[step % LAST.len()];
            let near = |k: usize| nudged(limits, &best.1, reach, 1 + k % 3, random);
            let states: Vec<JointState> = (0..NEIGHBOURS).map(near).collect();
            let errors = self.errors(&states);
            for (error, state) in errors[output].iter().zip(states) {
                if *error > best.0 {
                    best = (*error, state);
                }
            }
        }
        best
    }
}

/// First order, in units of u: the sum of |value·adjoint| over all operations.
fn rounding_estimate(code: &Code, output: usize, state: &JointState) -> f64 {
    let (values, mut adjoints) = (code.values_at(state), Vec::new());
    let top = code.dag.outputs[output].node;
    code.dag.adjoints(top, &values, &mut adjoints);
    let operations = code.dag.operations().map(|(id, ..)| id as usize);
    let errors = operations.take_while(|id| *id <= top as usize);
    errors.map(|id| (values[id] * adjoints[id]).abs()).sum()
}

fn nudged(
    limits: &InputBox,
    state: &JointState,
    reach: f64,
    coordinates: usize,
    random: &mut Random,
) -> JointState {
    let mut next = state.clone();
    let entries = limits.entries();
    for _ in 0..coordinates {
        let (argument, index) = entries[random.below(entries.len())];
        let range = limits.of_argument(argument)[index];
        let x = &mut next.entries_mut(argument)[index];
        *x = (*x + reach * range.width() * (random.unit() - 0.5)).clamp(range.low(), range.high());
    }
    limits.hold(&mut next);
    next
}

pub(crate) fn held(state: &JointState, scalar: ScalarType, limits: &InputBox) -> JointState {
    let mut held = state.clone();
    if scalar == ScalarType::F64 {
        return held;
    }
    for (argument, index) in limits.entries() {
        let range = limits.of_argument(argument)[index];
        let x = &mut held.entries_mut(argument)[index];
        let near = *x as f32;
        *x = f64::from(match f64::from(near) {
            read if read > range.high() => near.next_down(),
            read if read < range.low() => near.next_up(),
            _ => near,
        });
    }
    held
}

//! An attempt to refute a certificate: the emitted text is run at corners and
//! random states of the box, and climbs to where it errs most.
//!
//! The reference is the certificate's exact program in double precision; what that costs by
//! rounding is bounded as well and granted, so a violation found here is one.

use crate::bound::input_box::InputBox;
use crate::bound::magnitude::relative;
use crate::bound::sample::{climb, draw};
use crate::bound::sensitivity::{Rounding, rounding};
use crate::certificate::Certificate;
use crate::function::Argument;
use crate::interval::Interval;
use crate::language::read::{Signature, TextError};
use crate::program::{Code, ScalarType};
use crate::random::Random;
use crate::states::JointState;

/// The largest errors that were seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Falsification {
    /// Of each output, relative to its T.
    pub observed: Vec<f64>,
    /// The first output that errs more than is claimed, and where.
    pub violation: Option<(usize, JointState)>,
    /// States at which the text was run.
    pub states: usize,
}

/// Samples, then climbs from the worst of them, output by output.
///
/// # Errors
/// A text of the certificate cannot be read.
pub fn falsify(
    certificate: &Certificate,
    samples: usize,
    climbs: usize,
    seed: u64,
) -> Result<Falsification, TextError> {
    let mut falsifier = Falsifier::new(certificate)?;
    let limits = &certificate.limits;
    let outputs = certificate.scales.len();
    let mut random = Random::new(seed);
    let mut worst: Vec<(f64, JointState)> = vec![(-1.0, JointState::default()); outputs];
    let mut left = samples;
    while left > 0 {
        let count = left.min(BLOCK);
        left -= count;
        let states: Vec<JointState> = (0..count).map(|_| draw(limits, &mut random)).collect();
        let errors = falsifier.errors(&states);
        for (worst, errors) in worst.iter_mut().zip(errors) {
            for (error, state) in errors.into_iter().zip(&states) {
                if error > worst.0 {
                    *worst = (error, state.clone());
                }
            }
        }
    }
    for (output, (_, state)) in worst.into_iter().enumerate() {
        if state.q.is_empty() {
            continue;
        }
        let mut tops: Vec<(JointState, f64)> = Vec::new();
        for round in 0..climbs {
            let from = match round {
                0 => state.clone(),
                _ => draw(limits, &mut random),
            };
            let mut climbing = random.clone();
            let (edited, _) = climb(limits, from, MOVES, &mut climbing, &mut |state| {
                let errors = falsifier.errors(std::slice::from_ref(state));
                errors[output][0]
            });
            tops.push(climb(limits, edited, MOVES, &mut climbing, &mut |state| {
                rounded(&falsifier.emitted, output, state)
            }));
            random.bits();
        }
        tops.sort_by(|a, b| b.1.total_cmp(&a.1));
        for (top, _) in tops.into_iter().take(TOPS) {
            falsifier.in_last_bits(output, top, &mut random);
        }
    }
    Ok(falsifier.falsification)
}

/// States that are run at once: their columns stay in a processor's cache.
const BLOCK: usize = 128;

const MOVES: usize = 600;

/// Of the climbs, those where rounding may cost most go on in the last bits.
const TOPS: usize = 6;

/// Moves in the last bits, and how far they go.
const LAST_MOVES: usize = 1024;
const NEIGHBOURS: usize = 16;
const LAST: [f64; 4] = [1e-3, 1e-4, 1e-5, 3e-6];

struct Falsifier<'c> {
    certificate: &'c Certificate,
    emitted: Code,
    exact: Code,
    granted: Vec<Rounding>,
    falsification: Falsification,
}

impl<'c> Falsifier<'c> {
    fn new(certificate: &'c Certificate) -> Result<Falsifier<'c>, TextError> {
        let (program, limits) = (&certificate.exact, &certificate.limits);
        let signature = Signature::of(&certificate.emitted, certificate.scalar);
        Ok(Falsifier {
            certificate,
            emitted: Code::parse(&certificate.text, &signature)?,
            exact: program.in_doubles(),
            granted: rounding(program, ScalarType::F64, &[], limits),
            falsification: Falsification {
                observed: vec![0.0; certificate.scales.len()],
                violation: None,
                states: 0,
            },
        })
    }

    /// Climbs by steps so small that what roundings have in common is all that changes.
    fn in_last_bits(&mut self, output: usize, from: JointState, random: &mut Random) {
        let limits = &self.certificate.limits;
        let (mut best, mut most) = (from, 0.0);
        for step in 0..LAST_MOVES {
            let reach = LAST[step % LAST.len()];
            let each = (0..NEIGHBOURS).map(|k| nudged(limits, &best, reach, 1 + k % 3, random));
            let states: Vec<JointState> = each.collect();
            let errors = self.errors(&states);
            for (error, state) in errors[output].iter().zip(states) {
                if *error > most {
                    (best, most) = (state, *error);
                }
            }
        }
    }

    fn errors(&mut self, states: &[JointState]) -> Vec<Vec<f64>> {
        let Certificate { scalar, limits, .. } = self.certificate;
        let states: Vec<JointState> = states.iter().map(|s| held(s, *scalar, limits)).collect();
        let exact = self.exact.run_at_many(&states);
        let mut emitted = self.emitted.run_at_many(&states);
        if emitted.len() != exact.len() {
            // A text that reads what is not there, or returns too little.
            emitted = vec![vec![f64::NAN; states.len()]; exact.len()];
        }
        self.falsification.states += states.len();
        let mut all = Vec::with_capacity(emitted.len());
        for (i, (emitted, exact)) in emitted.iter().zip(&exact).enumerate() {
            let granted = self.granted[i].total();
            let bound = self.certificate.bounds[i].total();
            let mut errors = Vec::with_capacity(states.len());
            for ((x, y), state) in emitted.iter().zip(exact).zip(&states) {
                // What is no number at all is no small error either.
                let error = match x.is_finite() {
                    true => ((x - y).abs() - granted).max(0.0),
                    false => f64::INFINITY,
                };
                let error = relative(error, self.certificate.scales[i]);
                self.falsification.observed[i] = self.falsification.observed[i].max(error);
                if error > bound && self.falsification.violation.is_none() {
                    self.falsification.violation = Some((i, state.clone()));
                }
                errors.push(error);
            }
            all.push(errors);
        }
        all
    }
}

/// First order, in units of u: the sum of |value·adjoint| over all operations.
fn rounded(code: &Code, output: usize, state: &JointState) -> f64 {
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
    let n = state.q.len();
    for _ in 0..coordinates {
        let coordinate = random.below(3 * n);
        let (argument, joint) = (Argument::STATE[coordinate / n], coordinate % n);
        let range = limits.of_argument(argument)[joint];
        let x = &mut next.entries_mut(argument)[joint];
        *x = (*x + reach * range.width() * (random.unit() - 0.5)).clamp(range.low(), range.high());
    }
    next
}

pub(crate) fn held(state: &JointState, scalar: ScalarType, limits: &InputBox) -> JointState {
    if scalar == ScalarType::F64 {
        return state.clone();
    }
    let inside = |(&x, range): (&f64, &Interval)| {
        let near = x as f32;
        f64::from(match f64::from(near) {
            read if read > range.high() => near.next_down(),
            read if read < range.low() => near.next_up(),
            _ => near,
        })
    };
    JointState::new(|argument| {
        let ranges = limits.of_argument(argument);
        let entries = state.entries(argument).iter();
        entries.zip(ranges).map(inside).collect()
    })
}

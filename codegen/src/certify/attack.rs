//! An attempt to refute a certificate: the emitted text is run at corners and
//! random states of the box, and climbs to where it errs most.
//!
//! The yardstick is the certificate's exact program in double precision; what
//! that costs by rounding is bounded as well and granted, so a violation
//! found here is one.

use super::certificate::Certificate;
use super::input_box::InputBox;
use super::sample::{climb, draw};
use super::sensitivity::rounding;
use crate::emit::{MathPath, ScalarType, function};
use crate::schedule::Program;
use crate::simplify::random::Random;
use crate::verify::interpret::State;
use crate::verify::states::JointState;
use crate::verify::text::{TextError, TextProgram};

/// The largest errors that were seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Attack {
    /// Of each output, relative to its T.
    pub observed: Vec<f64>,
    /// The first output that errs more than is claimed, and where.
    pub violation: Option<(usize, JointState)>,
    /// States at which the text was run.
    pub states: usize,
}

/// Runs a text at a state of the scalar's own numbers.
pub fn run(text: &TextProgram, scalar: ScalarType, state: &JointState) -> Vec<f64> {
    match scalar {
        ScalarType::F64 => text.run(State {
            q: &state.q,
            qd: &state.qd,
            qdd: &state.qdd,
        }),
        ScalarType::F32 => {
            let single = |x: &[f64]| x.iter().map(|&x| x as f32).collect::<Vec<f32>>();
            let (q, qd, qdd) = (single(&state.q), single(&state.qd), single(&state.qdd));
            let out = text.run(State {
                q: &q,
                qd: &qd,
                qdd: &qdd,
            });
            out.into_iter().map(f64::from).collect()
        }
    }
}

/// A program as the text that would be printed of it.
///
/// # Errors
/// The text cannot be read back: a defect of this library.
pub fn text(program: &Program, scalar: ScalarType) -> Result<TextProgram, TextError> {
    let text = function::write(program, scalar, &MathPath::default(), &[]);
    TextProgram::parse(&text, program.function, scalar)
}

/// Samples, then climbs from the worst of them, output by output.
///
/// # Errors
/// A text of the certificate cannot be read.
pub fn attack(
    certificate: &Certificate,
    samples: usize,
    climbs: usize,
    seed: u64,
) -> Result<Attack, TextError> {
    let scalar = certificate.scalar;
    let emitted = TextProgram::parse(&certificate.text, certificate.emitted.function, scalar)?;
    let exact = text(&certificate.stages[0].program, ScalarType::F64)?;
    let program = &certificate.stages[0].program;
    let granted = rounding(program, ScalarType::F64, &certificate.limits, 64);
    let limits = &certificate.limits;
    let outputs = certificate.scales.len();
    let mut attack = Attack {
        observed: vec![0.0; outputs],
        violation: None,
        states: 0,
    };
    let mut random = Random::new(seed);
    let mut errors = |state: &JointState| {
        let state = held(state, scalar, limits);
        let (x, y) = (
            run(&emitted, scalar, &state),
            run(&exact, ScalarType::F64, &state),
        );
        attack.states += 1;
        let errors: Vec<f64> = (0..outputs)
            .map(|i| {
                let error = (x[i] - y[i]).abs() - granted[i].arithmetic - granted[i].sincos;
                super::bound::relative(error.max(0.0), certificate.scales[i])
            })
            .collect();
        for (i, &error) in errors.iter().enumerate() {
            attack.observed[i] = attack.observed[i].max(error);
            if error > certificate.bounds[i].total() && attack.violation.is_none() {
                attack.violation = Some((i, state.clone()));
            }
        }
        errors
    };
    let mut worst: Vec<(f64, JointState)> = vec![(-1.0, JointState::default()); outputs];
    for _ in 0..samples {
        let state = draw(limits, &mut random);
        for (worst, error) in worst.iter_mut().zip(errors(&state)) {
            if error > worst.0 {
                *worst = (error, state.clone());
            }
        }
    }
    for (output, (_, state)) in worst.into_iter().enumerate() {
        if state.q.is_empty() {
            continue;
        }
        for round in 0..climbs {
            let from = if round == 0 {
                state.clone()
            } else {
                draw(limits, &mut random)
            };
            let mut climbing = random.clone();
            climb(limits, from, 600, &mut climbing, &mut |s| errors(s)[output]);
            random.bits();
        }
    }
    Ok(attack)
}

/// The nearest state of the scalar's numbers inside the box.
fn held(state: &JointState, scalar: ScalarType, limits: &InputBox) -> JointState {
    if scalar == ScalarType::F64 {
        return state.clone();
    }
    let hold = |values: &[f64], ranges: &[super::interval::Interval]| {
        let pairs = values.iter().zip(ranges);
        pairs
            .map(|(&x, range)| {
                let near = x as f32;
                let inside = if f64::from(near) > range.high() {
                    near.next_down()
                } else if f64::from(near) < range.low() {
                    near.next_up()
                } else {
                    near
                };
                f64::from(inside)
            })
            .collect()
    };
    JointState {
        q: hold(&state.q, &limits.position),
        qd: hold(&state.qd, &limits.velocity),
        qdd: hold(&state.qdd, &limits.acceleration),
    }
}

//! The matrix run on one robot.

use std::fmt;

use dalembert_model::robot::Robot;

use super::category::{Category, Criterion};
use super::deviation::{Deviation, Measure};
use super::scale;
use super::subject::{Code, Subject};
use super::truth::Truth;
use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::{GenerateError, Request};
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::states::JointState;
use dalembert_codegen::workspace::verify::condition::Condition;

/// How thorough a run is.
#[derive(Clone, Debug)]
pub struct Options {
    /// States of each category.
    pub states: usize,
    /// The seed of the states.
    pub seed: u64,
    /// How the code is generated; functions and scalars are the run's own.
    pub request: Request,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            states: 50,
            seed: 0x57e5,
            request: Request::default(),
        }
    }
}

/// How a category ends for one code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The criterion is met.
    Pass,
    /// It is not.
    Fail,
    /// A constant or a result is beyond the scalar's range, and says so:
    /// nothing is generated, or the result is not finite.
    OutOfRange,
}

/// One category for one code.
#[derive(Clone, Debug)]
pub struct Row {
    /// The category.
    pub category: &'static str,
    /// What it is held to.
    pub criterion: Criterion,
    /// The scalar.
    pub scalar: ScalarType,
    /// Which code.
    pub subject: Subject,
    /// The worst errors of τ, each over all states.
    pub worst: Deviation,
    /// Where the error is worst against the criterion.
    pub state: JointState,
    /// Of D there.
    pub condition: Condition,
    /// Pass or fail.
    pub verdict: Verdict,
    /// Why a verdict is [`Verdict::OutOfRange`].
    pub reason: Option<RangeFault>,
}

/// What a scalar cannot hold.
#[derive(Clone, Debug, PartialEq)]
pub enum RangeFault {
    /// A constant, for which nothing is generated.
    Constant(GenerateError),
    /// A result.
    Result(ScalarType),
}

impl fmt::Display for RangeFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RangeFault::Constant(error) => error.fmt(f),
            RangeFault::Result(scalar) => write!(f, "a result is beyond the range of {scalar}"),
        }
    }
}

/// A robot and its programs.
struct Programs {
    robot: Robot,
    truth: Truth,
    /// By scalar, then by subject; the reason where there is none.
    codes: Vec<(ScalarType, [Result<Code, GenerateError>; 2])>,
}

impl Programs {
    fn new(robot: Robot, options: &Options) -> Result<Programs, GenerateError> {
        let mut codes = Vec::new();
        for scalar in ScalarType::ALL {
            let request = Request {
                functions: vec![Function::InverseDynamics],
                scalars: vec![scalar],
                ..options.request.clone()
            };
            let emitted = match Code::emitted(&robot, &request) {
                Ok(mut codes) => codes.pop().ok_or(GenerateError::Empty),
                Err(error @ GenerateError::Constant { .. }) => Err(error),
                Err(error) => return Err(error),
            };
            codes.push((scalar, [Ok(Code::runtime(&robot, scalar)), emitted]));
        }
        Ok(Programs {
            truth: Truth::new(&robot),
            robot,
            codes,
        })
    }
}

/// Runs every category; `progress` hears each name before its run.
pub fn run(
    robot: &Robot,
    options: &Options,
    mut progress: impl FnMut(&str),
) -> Result<Vec<Row>, GenerateError> {
    let own = Programs::new(robot.clone(), options)?;
    let mut rows = Vec::new();
    for category in Category::all() {
        progress(category.name);
        if category.same_robot() {
            one(&category, &own, options, &mut rows);
        } else if let Some(changed) = category.robot(robot) {
            let programs = Programs::new(changed, options)?;
            one(&category, &programs, options, &mut rows);
        }
    }
    Ok(rows)
}

fn one(category: &Category, programs: &Programs, options: &Options, rows: &mut Vec<Row>) {
    let robot = &programs.robot;
    let states = category.states(robot, options.states, options.seed);
    let scale_states = category.scale_states(robot, scale::STATES, scale::SEED);
    let scales = scale::torques(robot, &scale_states);
    for (scalar, codes) in &programs.codes {
        let states: Vec<JointState> = match scalar {
            ScalarType::F64 => states.clone(),
            ScalarType::F32 => states.iter().map(JointState::in_single).collect(),
        };
        let truth = |state| programs.truth.run(Function::InverseDynamics, state);
        let truths: Vec<_> = states.iter().map(truth).collect();
        let measure = Measure::new(robot, *scalar, scales.clone());
        for (subject, code) in Subject::ALL.into_iter().zip(codes) {
            let mut row = Row {
                category: category.name,
                criterion: category.criterion,
                scalar: *scalar,
                subject,
                worst: Deviation::default(),
                state: JointState::default(),
                condition: condition(programs, states.first(), *scalar),
                verdict: Verdict::Pass,
                reason: code.as_ref().err().cloned().map(RangeFault::Constant),
            };
            match code {
                Ok(code) => {
                    let results = states.iter().zip(&truths);
                    let results = results.filter_map(|(state, truth)| {
                        let found = code.run(Function::InverseDynamics, state)?;
                        Some((state, measure.of(&found, truth.as_deref()?), found))
                    });
                    fill(&mut row, results);
                    row.condition = condition(programs, Some(&row.state), *scalar);
                }
                Err(_) => row.verdict = Verdict::OutOfRange,
            }
            rows.push(row);
        }
    }
}

fn fill<'a>(row: &mut Row, results: impl Iterator<Item = (&'a JointState, Deviation, Vec<f64>)>) {
    let mut most = -1.0;
    for (state, deviation, found) in results {
        let excess = row.criterion.excess(&deviation);
        if excess > most {
            most = excess;
            row.state = state.clone();
        }
        row.worst.normwise = row.worst.normwise.max(deviation.normwise);
        if deviation.per_joint > row.worst.per_joint {
            row.worst.per_joint = deviation.per_joint;
            row.worst.joint = deviation.joint;
        }
        if found.iter().any(|x| !x.is_finite()) {
            row.verdict = Verdict::OutOfRange;
            row.reason = Some(RangeFault::Result(row.scalar));
        } else if row.verdict == Verdict::Pass && excess > 1.0 {
            row.verdict = Verdict::Fail;
        }
    }
}

/// Of D at a state, each entry the nearest double.
fn condition(programs: &Programs, state: Option<&JointState>, scalar: ScalarType) -> Condition {
    let d = state.and_then(|state| programs.truth.run(Function::Inertia, state));
    let d: Vec<f64> = d.unwrap_or_default().iter().map(|x| x.to_f64()).collect();
    Condition::of(&d, scalar.unit_roundoff())
}

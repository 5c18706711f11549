//! What rounding costs: each row, and what is emitted, against the true values.

use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::{Exact, Rounded};

use super::Explanation;
use super::steps::Code;
use dalembert_codegen::workspace::{
    Argument, Input, JointState, Reference, SceneRobot, Sizes, TrueValue,
};
use dalembert_codegen::{Function, Program, ScalarType};

/// The most states that are measured.
pub const MAX_STATES: usize = 10_000;

/// A seed of its own.
const SEED: u64 = 0xe7_91a1;

/// The worst errors over the states, in units of u: 2⁻⁵³ for f64, 2⁻²⁴ for f32.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Errors {
    /// max_i |error_i| / max_i |truth_i|, each quantity by itself.
    pub normwise: f64,
    /// max_i |error_i| / the largest |truth_i| over the states.
    pub per_joint: f64,
}

/// Returns the errors of every row over the same states, inside the limits of the
/// robot, or of its scene; those of what is emitted in f32 are rounded to it
/// first.
pub fn measure(explanation: &Explanation, states: usize) -> Vec<Errors> {
    let (scene_robot, function) = (&explanation.scene_robot, explanation.function);
    let robot = scene_robot.robot();
    let drawn = scene_robot.states(states.min(MAX_STATES), SEED);
    let reference = Reference::new(scene_robot);
    let runs = at(&reference, function, &drawn, ScalarType::F64);
    let exact: Arm<Exact> = Arm::from_robot(robot, &mut Exact::clone);
    let arm = exact.map(f64::nearest);
    let sizes = scene_robot.sizes(function);
    let errors = |code: &Code| match code {
        Code::Formula(formulation) => worst(function, sizes, &runs, ScalarType::F64, |state| {
            formula(scene_robot, &arm, *formulation, function, state)
        }),
        Code::Program(program) => {
            let text = program.lower(ScalarType::F64, |_| None);
            worst(function, sizes, &runs, ScalarType::F64, |state| {
                text.run_at(state)
            })
        }
        Code::Emitted(text, scalar) => {
            let own = match scalar {
                ScalarType::F64 => None,
                ScalarType::F32 => Some(at(&reference, function, &drawn, *scalar)),
            };
            let runs = own.as_ref().unwrap_or(&runs);
            worst(function, sizes, runs, *scalar, |state| text.run_at(state))
        }
    };
    explanation
        .rows
        .iter()
        .map(|row| errors(&row.code))
        .collect()
}

/// Returns the errors of a program in each scalar, inside the limits of the robot, or
/// of its scene; states of f32 are rounded to it first. Programs of one robot and scene are
/// compared at the same states: one reference for all is quickest.
pub fn of_program(
    reference: &Reference,
    program: &Program,
    scalars: &[ScalarType],
    states: usize,
) -> Vec<Errors> {
    let function = program.function;
    let scene_robot = reference.scene_robot();
    let drawn = scene_robot.states(states.min(MAX_STATES), SEED);
    let sizes = scene_robot.sizes(function);
    let errors = |&scalar: &ScalarType| {
        let text = program.lower(scalar, |_| None);
        let runs = at(reference, function, &drawn, scalar);
        worst(function, sizes, &runs, scalar, |state| text.run_at(state))
    };
    scalars.iter().map(errors).collect()
}

/// Returns how many states take seconds at most, whatever the robot: the reference's
/// work grows with the cube of the number of joints where it returns D.
pub fn affordable_states(joints: usize) -> usize {
    const STATES: usize = 100;
    const JOINTS: usize = 10;
    match joints {
        0..=JOINTS => STATES,
        _ => (STATES * JOINTS.pow(3) / joints.pow(3)).max(1),
    }
}

/// Returns the states in a scalar and the true values there, without those that are not finite.
fn at(
    reference: &Reference,
    function: Function,
    states: &[JointState],
    scalar: ScalarType,
) -> Vec<(JointState, Vec<TrueValue>)> {
    let states = states.iter().map(|state| state.in_scalar(scalar));
    let with_truth = |state: JointState| {
        let truth = reference.run(function, &state);
        (state, truth)
    };
    states
        .filter(JointState::is_finite)
        .map(with_truth)
        .collect()
}

/// Returns a formulation over f64, its constants rounded once.
fn formula(
    scene_robot: &SceneRobot,
    arm: &Arm<f64>,
    formulation: Formulation,
    function: Function,
    state: &JointState,
) -> Vec<f64> {
    let pair = |angle: dalembert_codegen::workspace::AngleSum| {
        // A motion reads the angles of single joints only.
        libm::sincos(angle.terms().map(|(joint, _)| state.q[joint]).sum())
    };
    let input = |input| match input {
        Input::Sin(angle) => pair(angle).0,
        Input::Cos(angle) => pair(angle).1,
        Input::PerSpeed(joint) => {
            let qd = state.entry(Argument::Velocity, joint);
            scene_robot.per_speed(joint, &qd, f64::nearest, |x| libm::sqrt(*x))
        }
        Input::Entry(argument, joint) => state.entry(argument, joint),
    };
    let posed = scene_robot.posed(function, arm.clone(), input, f64::nearest);
    posed.results(scene_robot, function, formulation)
}

fn worst(
    function: Function,
    sizes: Sizes,
    runs: &[(JointState, Vec<TrueValue>)],
    scalar: ScalarType,
    run: impl Fn(&JointState) -> Vec<f64>,
) -> Errors {
    let outputs = function.outputs(sizes);
    let mut largest = vec![0.0f64; outputs];
    let mut errors = vec![0.0f64; outputs];
    let mut normwise = 0.0f64;
    for (state, truth) in runs {
        let found = run(state);
        let mut start = 0;
        for quantity in function.quantities() {
            let range = start..start + quantity.len(sizes);
            start = range.end;
            let (mut error, mut size) = (0.0f64, 0.0f64);
            for i in range {
                let (difference, value) = (truth[i].error(found[i]), truth[i].size());
                (error, size) = (error.max(difference), size.max(value));
                errors[i] = errors[i].max(difference);
                largest[i] = largest[i].max(value);
            }
            normwise = normwise.max(ratio(error, size));
        }
    }
    let per_joint = errors
        .iter()
        .zip(&largest)
        .map(|(e, size)| ratio(*e, *size));
    let u = scalar.unit_roundoff();
    Errors {
        normwise: normwise / u,
        per_joint: per_joint.fold(0.0, f64::max) / u,
    }
}

/// Returns error / size; where the truth vanishes there is nothing to relate it to.
fn ratio(error: f64, size: f64) -> f64 {
    if size > 0.0 { error / size } else { 0.0 }
}

//! A plan's variant fits the scene: the function, arguments and results of the robot in its
//! scene, and nothing read that they do not have.
//!
//! Everything after this may take for granted that there are as many results as the function has,
//! so as many as scales, and that every input is an argument's entry that the function may read.

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::robot::JointKind;

use crate::function::Argument;
use crate::program::{Input, Program};
use crate::setup::Setup;

pub(super) fn check(setup: &Setup, program: &Program, emitted: &Program) -> Result<(), Diagnostic> {
    let function = emitted.function;
    let arguments = setup.arguments(function);
    let results = function.outputs(setup.sizes(function));
    let signature = [
        ("function", program.function == function),
        ("number of joints", program.joints == setup.joints()),
        ("list of rows", program.rows == setup.rows()),
        ("list of arguments", program.arguments == arguments),
        ("number of results", program.dag.outputs.len() == results),
    ];
    if let Some((what, _)) = signature.into_iter().find(|(_, same)| !same) {
        let why = "of the plan's variant is not that of the function in this scene";
        return Err(Diagnostic::error(format!("the {what} {why}")));
    }
    for input in program.dag.inputs() {
        if let Some(why) = wrong(setup, emitted, *input) {
            let message = format!("the plan's variant reads `{}`: {why}", input.name());
            return Err(Diagnostic::error(message));
        }
    }
    Ok(())
}

fn wrong(setup: &Setup, emitted: &Program, input: Input) -> Option<&'static str> {
    let of_joint = |joint: usize, kind: Option<JointKind>| match setup.robot().joints.get(joint) {
        None => Some("the robot has no such joint"),
        Some(_) if setup.lock(joint).is_some() => {
            Some("the joint is locked: its entries may not be read")
        }
        Some(row) => match (kind, row.kind) {
            (Some(JointKind::Revolute), JointKind::Prismatic) => {
                Some("the joint slides: it has no sine or cosine")
            }
            (Some(JointKind::Prismatic), JointKind::Revolute) => {
                Some("the joint turns: only its sine and cosine may be read")
            }
            _ => None,
        },
    };
    let load_length = Argument::Load.length(setup.sizes(emitted.function));
    let problem = match input {
        Input::Sin(joint) | Input::Cos(joint) => of_joint(joint, Some(JointKind::Revolute)),
        // It rounds more than is bounded.
        Input::PerSpeed(_) => Some("no bound is known of what Coulomb friction reads of speeds"),
        Input::Entry(Argument::Load, index) => {
            (index >= load_length).then_some("the load has no such number")
        }
        Input::Entry(Argument::Gravity, index) => {
            (index >= 3).then_some("gravity has three entries")
        }
        Input::Entry(Argument::Position, joint) => of_joint(joint, Some(JointKind::Prismatic)),
        Input::Entry(_, coordinate) => {
            let joint = setup.robot().joint_of(coordinate);
            joint.and_then(|joint| of_joint(joint, None))
        }
    };
    let is_missing = !emitted.arguments.contains(&input.argument());
    problem.or(is_missing.then_some("the function has no such argument in this scene"))
}

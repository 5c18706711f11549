//! The document about a variant, with which the checker compares its text.

use dalembert_checker::claim::{Claim, FunctionClaim, ToleranceClaim};
use dalembert_model::robot::{Placement, Robot, write};
use dalembert_model::scene::{self, Scene};

use super::variant::Variant;
use crate::claim::{ConstantTable, code, of_setup};
use crate::function::Argument;
use crate::setup::Setup;

/// Returns the claim about one text that a tolerance admitted.
pub fn claim_of(robot: &Robot, source: &str, setup: &Setup, variant: &Variant) -> Claim {
    claim_in(robot, source, setup, setup.scene(), variant)
}

/// Returns the claim in a scene of the source.
pub(super) fn claim_in(
    robot: &Robot,
    source: &str,
    setup: &Setup,
    scene: Option<&Scene>,
    variant: &Variant,
) -> Claim {
    let mut constants = ConstantTable::default();
    let load = |program| of_setup(program, setup, &mut constants);
    let mut functions: Vec<FunctionClaim> = variant.load.iter().map(load).collect();
    functions.push(FunctionClaim {
        tolerated: tolerated(variant, &mut constants),
        ..of_setup(&variant.emitted, setup, &mut constants)
    });
    document(robot, source, scene, functions, constants)
}

pub(crate) fn document(
    robot: &Robot,
    source: &str,
    scene: Option<&Scene>,
    functions: Vec<FunctionClaim>,
    constants: ConstantTable,
) -> Claim {
    let is_tilted = |placement: &Placement| {
        let mut angles = placement.rpy.iter();
        angles.any(|angle| angle.quarter_turns().is_none())
    };
    let scene = scene.filter(|_| robot.payload_frame.as_ref().is_some_and(is_tilted));
    let payload = scene.and_then(|scene| {
        let carried = Scene {
            name: scene.name.clone(),
            payload: Some(scene.carried(robot)?),
            ..Scene::default()
        };
        Some(format!("\n{}", scene::write(&carried)))
    });
    let is_rounded = source.contains("placement") || payload.is_some();
    Claim {
        aligned: is_rounded.then(|| write(robot) + &payload.unwrap_or_default()),
        notes: robot.notes.clone(),
        ..constants.document(functions)
    }
}

pub(crate) fn tolerated(first: &Variant, constants: &mut ConstantTable) -> Option<ToleranceClaim> {
    let program = &first.emitted;
    let exact = Some(&first.exact).filter(|exact| *exact != program);
    let [steps, returns] = exact.map_or_else(Default::default, |exact| code(exact, constants));
    let reached = first.reached.iter().map(|at| {
        let state = Argument::STATE.iter().chain(&[Argument::Gravity]);
        let arguments = state.filter(|argument| program.arguments.contains(argument));
        let entries = arguments.flat_map(|argument| at.entries(*argument));
        // A payload is a point there.
        let point = at.payload.iter().skip(1).take(3);
        entries.chain(point).copied().collect()
    });
    Some(ToleranceClaim {
        steps,
        returns,
        relative_to: first.relative_to.word().to_owned(),
        reached: reached.collect(),
    })
}

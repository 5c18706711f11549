//! The document about generated functions, with which the checker compares their text.

use dalembert_checker::claim::{Claim, Claimed, Tolerated};
use dalembert_model::robot::{Placement, Robot, write};
use dalembert_model::scene::{self, Scene};

use super::{Generated, language};
use crate::certificate::Certificate;
use crate::claim::{Written, code, of_setup};
use crate::function::Argument;
use crate::language::Language;
use crate::language::names::Names;
use crate::program::ScalarType;
use crate::setup::Setup;
use crate::task::Request;
use crate::words::Complaint;

/// Returns the claim about the functions that were generated for the robot of a file.
///
/// # Errors
/// As of [`Request::setup`].
pub fn claim(
    robot: &Robot,
    source: &str,
    request: &Request,
    generated: &Generated,
) -> Result<Claim, Complaint> {
    let request = &*language::with_short_name(robot, request);
    let setup = &request.setup(robot)?;
    let name = request.module_name(robot);
    let mut constants = Written::default();
    let functions = generated.functions.iter().map(|own| {
        // A header of the same functions has the same claim.
        let symbol = |&scalar| Names::new(&name, Language::C, scalar).of(own.function.name());
        Claimed {
            symbols: ScalarType::ALL.iter().map(symbol).collect(),
            tolerated: (own.admitted.as_ref())
                .and_then(|own| tolerated(own.certificates.first()?, &mut constants)),
            ..of_setup(&own.program, setup, &mut constants)
        }
    });
    let functions = functions.collect();
    Ok(document(robot, source, setup, functions, constants))
}

/// Returns the claim about one text that a tolerance admitted.
pub fn claim_of(robot: &Robot, source: &str, setup: &Setup, own: &Certificate) -> Claim {
    let mut constants = Written::default();
    let function = Claimed {
        tolerated: tolerated(own, &mut constants),
        ..of_setup(&own.emitted, setup, &mut constants)
    };
    document(robot, source, setup, vec![function], constants)
}

fn document(
    robot: &Robot,
    source: &str,
    setup: &Setup,
    functions: Vec<Claimed>,
    constants: Written,
) -> Claim {
    let is_tilted = |own: &Placement| own.rpy.iter().any(|own| own.quarter_turns().is_none());
    let scene = setup
        .scene()
        .filter(|_| robot.payload_frame.as_ref().is_some_and(is_tilted));
    let payload = scene.and_then(|scene| {
        Some(Scene {
            name: scene.name.clone(),
            payload: Some(scene.carried(robot)?),
            ..Scene::default()
        })
    });
    let is_rounded = source.contains("placement") || payload.is_some();
    let payload = payload.map_or_else(String::new, |own| format!("\n{}", scene::write(&own)));
    Claim {
        aligned: is_rounded.then(|| write(robot) + &payload),
        notes: robot.notes.clone(),
        ..constants.document(functions)
    }
}

fn tolerated(first: &Certificate, constants: &mut Written) -> Option<Tolerated> {
    let program = &first.emitted;
    let exact = Some(&first.exact).filter(|exact| *exact != program);
    let [steps, returns] = exact.map_or_else(Default::default, |own| code(own, constants));
    let is_given = |own: &Argument| program.arguments.contains(own);
    let reached = first.reached.iter().map(|at| {
        let given = Argument::STATE.iter().filter(|own| is_given(own));
        given.flat_map(|own| at.entries(*own)).copied().collect()
    });
    Some(Tolerated {
        steps,
        returns,
        relative_to: (first.relative_to).map_or_else(String::new, |own| own.word().to_owned()),
        reached: reached.collect(),
    })
}

//! The programs of a run in a plan, for later runs, and the claim about them, with
//! which the checker compares their text.

use dalembert_checker::claim::{Claim, FunctionClaim};
use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::robot::Robot;

use super::{GeneratedCode, Request, language};
use crate::claim::{ConstantTable, of_setup};
use crate::function::Function;
use crate::language::Language;
use crate::language::names::Names;
use crate::plan::{Entry, Plan};
use crate::program::{Program, ScalarType};
use crate::search::price;
use crate::setup::{SceneKey, input_hash};
use crate::tolerance::claim::{document, tolerated};

#[derive(Clone, Debug)]
pub struct PlanUpdate {
    pub plan: Plan,
    /// Functions whose program the plan keeps: a search that was ended early has no cheaper one.
    pub functions: Vec<(Function, ScalarType)>,
}

/// Returns the plan with the programs of a run in it. Those of other requests for the same robot
/// stay, and after a search that was ended early those that are no dearer than what it found.
pub fn keep(
    robot: &Robot,
    request: &Request,
    generated: &GeneratedCode,
    plan: Option<Plan>,
) -> PlanUpdate {
    let input = input_hash(robot);
    let mut plan = plan.filter(|plan| plan.input == input).unwrap_or(Plan {
        robot: robot.name.clone(),
        input,
        entries: Vec::new(),
    });
    let mut functions = Vec::new();
    let programs = generated.functions.iter();
    // A load is its definition: nobody searches for that.
    for function in programs.filter(|generated| generated.function != Function::Load) {
        let admitted = function.admitted.as_ref();
        // The proved program: what a tolerance was applied to.
        let program = function.found.as_ref().unwrap_or(&function.program);
        for &scalar in &generated.scalars {
            let entry = Entry {
                start: request.start,
                scalar,
                source: function.source,
                passes: function.passes.clone(),
                scene: request.scene.as_ref().map(SceneKey::new),
                parameters: function.parameters.clone(),
                program: admitted.map_or(program, |admitted| &admitted.exact).clone(),
                edited: admitted.map(|admitted| admitted.program.clone()),
            };
            let (name, scene) = (function.function, request.scene.as_ref());
            let parameters = function.parameters.as_ref();
            let other = plan.find(name, request.start, scalar, scene, parameters);
            let as_good = |other: &Entry| {
                other.scene == entry.scene
                    && other.parameters == entry.parameters
                    && price(&emitted(other).counts()) <= price(&emitted(&entry).counts())
            };
            if generated.ended && other.as_ref().is_some_and(as_good) {
                functions.push((name, scalar));
            } else if other.as_ref() != Some(&entry) {
                // A bundle may be there by another name.
                plan.insert(entry);
            }
        }
    }
    PlanUpdate { plan, functions }
}

fn emitted(entry: &Entry) -> &Program {
    entry.edited.as_ref().unwrap_or(&entry.program)
}

/// Returns the claim about the functions that were generated for the robot of a file.
pub fn claim(
    robot: &Robot,
    source: &str,
    request: &Request,
    generated: &GeneratedCode,
) -> Result<Claim, Diagnostic> {
    let request = &*language::with_short_name(robot, request);
    let setup = &request.prepare(robot)?;
    let name = request.module_name(robot);
    let mut constants = ConstantTable::default();
    let functions = generated.functions.iter().map(|function| {
        // A header of the same functions has the same claim.
        let symbol = |&scalar| Names::new(&name, Language::C, scalar).of(function.function.name());
        FunctionClaim {
            symbols: ScalarType::ALL.iter().map(symbol).collect(),
            tolerated: (function.admitted.as_ref())
                .and_then(|variant_set| tolerated(variant_set.variants.first()?, &mut constants)),
            ..of_setup(&function.program, setup, &mut constants)
        }
    });
    let functions = functions.collect();
    Ok(document(robot, source, setup.scene(), functions, constants))
}

//! The plan with the programs of a run in it, for later runs.

use dalembert_model::robot::Robot;

use super::{Generated, Request};
use crate::function::Function;
use crate::plan::{Entry, Plan};
use crate::program::{Program, ScalarType};
use crate::search::price;
use crate::setup::{SceneKey, input_hash};

/// A plan with what was generated in it.
#[derive(Clone, Debug)]
pub struct Kept {
    /// The plan.
    pub plan: Plan,
    /// Where the plan keeps its own program: a search that was ended early had
    /// found none that is cheaper.
    pub own: Vec<(Function, ScalarType)>,
}

/// Returns the plan with the programs of a run in it. Those of other requests for the same robot
/// stay, and after a search that was ended early those that are no dearer than what it found.
pub fn keep(robot: &Robot, request: &Request, generated: &Generated, plan: Option<Plan>) -> Kept {
    let input = input_hash(robot);
    let mut plan = plan.filter(|plan| plan.input == input).unwrap_or(Plan {
        robot: robot.name.clone(),
        input,
        entries: Vec::new(),
    });
    let mut own = Vec::new();
    let functions = generated.functions.iter();
    // A load is its definition: nobody searches for that.
    for function in functions.filter(|generated| generated.function != Function::Load) {
        let admitted = function.admitted.as_ref();
        // The proved program: what a tolerance was applied to.
        let found = function.found.as_ref().unwrap_or(&function.program);
        for &scalar in &generated.scalars {
            let entry = Entry {
                start: request.start,
                scalar,
                source: function.source,
                passes: function.passes.clone(),
                scene: request.scene.as_ref().map(SceneKey::new),
                parameters: function.parameters.clone(),
                program: admitted.map_or(found, |admitted| &admitted.exact).clone(),
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
                own.push((name, scalar));
            } else if other.as_ref() != Some(&entry) {
                // A bundle may be there by another name.
                plan.insert(entry);
            }
        }
    }
    Kept { plan, own }
}

fn emitted(entry: &Entry) -> &Program {
    let edited = entry.edited.as_ref();
    edited.unwrap_or(&entry.program)
}

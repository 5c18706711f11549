//! Checks that parameters can be arguments of the functions asked for.

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::outputs::{PayloadDependence, RuntimeParameter};

use super::GenerateError;
use crate::function::Function;
use crate::seeds::Start;
use crate::task::Job;
use crate::tolerance::refusals::{is_bounded, without_range};

pub(super) fn check(job: &Job<'_>) -> Result<(), GenerateError> {
    let Job { setup, request, .. } = *job;
    let refused = |function: Option<Function>, message: String, help: &str| {
        GenerateError::Parameter(function, Diagnostic::error(message).with_help(help))
    };
    let Some(&first) = request.parameters.first() else {
        return Ok(());
    };
    let scene = request.scene.as_ref();
    let floats = job.setup.robot().floating.is_some();
    if job.tolerance().is_some() {
        let mut parameters = request.parameters.iter();
        let is_other = |parameter: &&RuntimeParameter| {
            parameter.given().is_some() && **parameter != RuntimeParameter::Payload
        };
        if let Some(other) = parameters.find(is_other) {
            let message = format!(
                "a tolerance bounds functions over a box, and `{}` has none",
                other.name()
            );
            let help = "leave it out of the parameters, or the tolerance out of the scene";
            return Err(refused(None, message, help));
        }
        let mut functions = request.functions.iter();
        let taking = functions.find_map(|&function| {
            let mut taken = request
                .parameters
                .iter()
                .filter(|parameter| function.depends_on(**parameter));
            let argument = taken.find_map(|parameter| {
                Some(parameter.argument()).filter(|argument| !is_bounded(*argument, floats))
            });
            Some((function, argument?))
        });
        if let Some((function, argument)) = taking {
            let why = without_range(argument);
            return Err(refused(Some(function), format!("`{function}`: {why}"), ""));
        }
    }
    if let Some(scene) = scene.filter(|scene| scene.gravity.is_some())
        && setup.has(RuntimeParameter::Gravity)
    {
        let message = format!(
            "the scene `{}` sets gravity, so it cannot be an argument",
            scene.name
        );
        let help = "leave it out of the scene or of the parameters";
        return Err(refused(None, message, help));
    }
    if !setup.has_load() {
        return Ok(());
    }
    if request.start != Start::Auto {
        let message = format!(
            "the formulation `{}` has no regrouped parameters, and bodies and drives are arguments by these",
            request.start.name()
        );
        let help = "leave `formulation` out";
        return Err(refused(None, message, help));
    }
    let mut of_bodies = [RuntimeParameter::Payload, RuntimeParameter::Bodies]
        .into_iter()
        .filter(|parameter| setup.has(*parameter));
    let mut functions = request.functions.iter();
    if let (Some(&function), Some(parameter)) = (
        functions.find(|function| function.payload_dependence() == PayloadDependence::Full),
        of_bodies.next(),
    ) {
        let name = parameter.name();
        let message = format!(
            "`{function}` depends on numbers of bodies that have no effect on joint torques, and `load` \
             does not have these"
        );
        let help = format!("generate `{function}` without `{name}`");
        return Err(refused(Some(function), message, &help));
    }
    if let Some(scene) = scene.filter(|scene| scene.payload.is_some())
        && setup.has(RuntimeParameter::Bodies)
    {
        let message = format!(
            "the scene `{}` has a payload, which is part of a link, and bodies of links are arguments",
            scene.name
        );
        let help = "leave it out of the scene, and add `payload` to the parameters";
        return Err(refused(None, message, help));
    }
    if setup.load().is_none_or(|load| load.rows.is_empty()) {
        let name = first.name();
        let message = format!("`{name}` has no effect on any moving joint");
        let help = format!("leave `{name}` out of the parameters");
        return Err(refused(None, message, &help));
    }
    Ok(())
}

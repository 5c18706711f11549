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
        for other in &request.parameters {
            if other.given().is_some() && *other != RuntimeParameter::Payload {
                let name = other.name();
                let message =
                    format!("a tolerance bounds functions over a box, and `{name}` has none");
                let help = "leave it out of the parameters, or the tolerance out of the scene";
                return Err(refused(None, message, help));
            }
        }
        for &function in &request.functions {
            for parameter in &request.parameters {
                let argument = parameter.argument();
                if function.depends_on(*parameter) && !is_bounded(argument, floats) {
                    let why = without_range(argument);
                    return Err(refused(Some(function), format!("`{function}`: {why}"), ""));
                }
            }
        }
    }
    if let Some(scene) = scene.filter(|scene| scene.gravity.is_some())
        && setup.has(RuntimeParameter::Gravity)
    {
        let name = &scene.name;
        let message = format!("the scene `{name}` sets gravity, so it cannot be an argument");
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
        return Err(refused(None, message, "leave `formulation` out"));
    }
    let is_full = |function: &&Function| function.payload_dependence() == PayloadDependence::Full;
    let mut body_parameters = [RuntimeParameter::Payload, RuntimeParameter::Bodies].into_iter();
    if let Some(&function) = request.functions.iter().find(is_full)
        && let Some(parameter) = body_parameters.find(|parameter| setup.has(*parameter))
    {
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

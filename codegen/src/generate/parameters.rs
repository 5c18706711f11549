//! Which parameters can be arguments, and of what.

use dalembert_model::outputs::{PayloadDependence, RuntimeParameter};

use super::GenerateError;
use crate::function::Function;
use crate::language::Language;
use crate::seeds::Start;
use crate::task::Job;
use crate::tolerance::refusals::{is_bounded, reads};
use crate::words::Complaint;

pub(super) fn check(job: &Job<'_>) -> Result<(), GenerateError> {
    let Job { setup, request, .. } = *job;
    let refused = |function: Option<Function>, message: String, help: &str| {
        GenerateError::Parameter(function, Complaint::new(message, help))
    };
    let Some(&first) = request.parameters.first() else {
        return Ok(());
    };
    let scene = request.scene.as_ref();
    let floats = job.setup.robot().floating.is_some();
    if job.tolerance().is_some() {
        let mut functions = request.functions.iter();
        let taking = functions.find_map(|&function| {
            let taken = request.parameters.iter();
            let mut taken = taken.filter(|parameter| function.depends_on(**parameter));
            let argument =
                taken.find_map(|own| Some(own.argument()).filter(|own| !is_bounded(*own, floats)));
            Some((function, argument?))
        });
        if let Some((function, argument)) = taking {
            let why = reads(argument);
            return Err(refused(Some(function), format!("`{function}`: {why}"), ""));
        }
    }
    // In other languages a batch has columns of any argument.
    if request.language == Language::Rust && request.batch {
        let message = format!(
            "batches in Rust take arguments with an entry a joint, and {} is none",
            first.name()
        );
        return Err(refused(None, message, "leave `batch` out"));
    }
    if let Some(scene) = scene.filter(|scene| scene.gravity.is_some())
        && setup.has(RuntimeParameter::Gravity)
    {
        let message = format!(
            "the scene `{}` says what gravity is, so it is no argument",
            scene.name
        );
        let help = "leave it out of the scene or of the parameters";
        return Err(refused(None, message, help));
    }
    if !setup.has(RuntimeParameter::Payload) {
        return Ok(());
    }
    if request.start != Start::Auto {
        let message = format!(
            "the formulation `{}` has no regrouped parameters, and a payload is an argument by these",
            request.start.name()
        );
        let help = "leave `formulation` out, or give the payload in a scene";
        return Err(refused(None, message, help));
    }
    let mut functions = request.functions.iter();
    if let Some(&function) =
        functions.find(|function| function.payload_dependence() == PayloadDependence::Full)
    {
        let message = format!(
            "`{function}` depends on parameters of the payload that have no effect on joint torques, \
             and `load` does not have these"
        );
        let help =
            format!("generate `{function}` without `payload`, or give the payload in a scene");
        return Err(refused(Some(function), message, &help));
    }
    if setup.load().is_none_or(|load| load.rows.is_empty()) {
        let message = "the payload has no effect on any moving joint".to_owned();
        let help = "leave `payload` out of the parameters";
        return Err(refused(None, message, help));
    }
    Ok(())
}

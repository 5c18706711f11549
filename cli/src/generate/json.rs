//! What a program wants to know about generated code.

use crate::explained::errors::Errors;
use dalembert_codegen::workspace::{Admitted, Certificate, Proof, omissions};
use dalembert_codegen::{Generated, GeneratedFunction, Request};
use dalembert_model::robot::Robot;
use serde_json::{Map, Value, json};

use super::report;
use crate::output;

/// Counts, errors, what a tolerance admitted, proofs.
pub fn json(robot: &Robot, request: &Request, generated: &Generated, states: usize) -> Value {
    let measured = report::measured(robot, request, generated, states);
    let functions = generated.functions.iter().enumerate().map(|(i, function)| {
        let errors = measured.as_ref().and_then(|all| all.get(i));
        let errors = errors.map(|errors| by_scalar(request, errors));
        (function.function.to_string(), one(function, errors))
    });
    json!({
        "robot": robot.name,
        "input": robot.short_hash(),
        "joints": robot.joints.len(),
        "scene": request.scene.as_ref().map(|scene| &scene.name),
        "states": measured.as_ref().map(|_| states),
        "functions": functions.collect::<Map<_, _>>(),
        "warnings": generated.warnings,
        "ended_early": generated.ended,
    })
}

fn one(function: &GeneratedFunction, errors: Option<Value>) -> Value {
    let stages = function.passes.iter().map(|stage| {
        let counts = output::counts(&stage.counts);
        json!({ "stage": stage.name, "counts": counts })
    });
    json!({
        "counts": output::counts(&function.counts()),
        "from": function.source.name(),
        "planned": function.planned,
        "proof": proof(),
        "errors_in_u": errors,
        "stages": stages.collect::<Vec<_>>(),
        "tolerance": function.admitted.as_ref().map(tolerance),
    })
}

fn by_scalar(request: &Request, errors: &[Errors]) -> Value {
    let pairs = request.scalars.iter().zip(errors).map(|(scalar, errors)| {
        let errors = json!({ "normwise": errors.normwise, "per_joint": errors.per_joint });
        (scalar.to_string(), errors)
    });
    Value::Object(pairs.collect())
}

/// Returns what was proved, and how surely.
pub fn proof() -> Value {
    json!({ "points": Proof::POINTS, "failure_exponent": Proof::FAILURE_EXPONENT })
}

fn tolerance(admitted: &Admitted) -> Value {
    let certificates = admitted.certificates.iter().map(
        |certificate| json!({ "scalar": certificate.scalar.name(), "bounds": bounds(certificate) }),
    );
    let left_out = omissions(&admitted.stages).into_iter().map(|omission| {
        json!({
            "what": omission.words,
            "operations": omission.operations,
            "sincos": omission.sincos,
        })
    });
    json!({
        "certificates": certificates.collect::<Vec<_>>(),
        "left_out": left_out.collect::<Vec<_>>(),
    })
}

/// Returns the bounds of a certificate, output by output.
pub fn bounds(certificate: &Certificate) -> Vec<Value> {
    let pairs = certificate.bounds.iter().zip(&certificate.scales);
    let bounds = pairs.enumerate().map(|(index, (bound, scale))| {
        json!({
            "output": certificate.emitted.entry(index),
            "T": scale,
            "model": bound.model,
            "sincos": bound.sincos,
            "rounding": bound.rounding,
            "E": bound.total(),
        })
    });
    bounds.collect()
}

//! A certificate that holds, as JSON.

use dalembert_codegen::workspace::interval::Interval;
use dalembert_model::robot::Robot;
use serde_json::{Value, json};

use super::Check;
use crate::args::CertifyArgs;
use crate::generate::json as generated;

/// What was checked, found and seen.
pub(super) fn json(args: &CertifyArgs, robot: &Robot, check: &Check) -> Value {
    let (certificate, checked) = (check.certificate, &check.checked);
    let findings = checked.findings.iter().map(ToString::to_string);
    let observed = check.seen.as_ref();
    json!({
        "file": args.certificate.display().to_string(),
        "function": certificate.emitted.function.name(),
        "scalar": certificate.scalar.name(),
        "scene": check.scene.map(|scene| &scene.name),
        "proof": generated::proof(&checked.proof),
        "box": joints(robot, check),
        "bounds": generated::bounds(certificate),
        "seen": checked.ran.observed,
        "observed": observed.map(|seen| &seen.observed),
        "states": observed.map(|seen| seen.states),
        "warnings": findings.collect::<Vec<_>>(),
        "passed": observed.is_none_or(|seen| seen.violation.is_none()),
    })
}

/// The box that the bounds are over, joint by joint; of one that is locked nothing.
fn joints(robot: &Robot, check: &Check) -> Vec<Value> {
    let limits = &check.certificate.limits;
    let range = |x: &Interval| json!([x.low(), x.high()]);
    let joints = limits.position.iter().zip(&limits.velocity);
    let joints = joints.zip(&limits.acceleration).enumerate();
    joints
        .map(|(joint, ((q, qd), qdd))| {
            let name = robot.joint_label(joint);
            match check.scene.and_then(|scene| scene.locked(joint)) {
                Some(_) => json!({ "joint": name, "locked": true }),
                None => json!({
                    "joint": name,
                    "q": range(q),
                    "qd": range(qd),
                    "qdd": range(qdd),
                }),
            }
        })
        .collect()
}

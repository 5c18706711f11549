//! Plans of a robot or a scene that was edited since.

use dalembert_model::robot::Robot;

use super::{GenerateError, Generated, Request, generate};

/// Generates as [`generate`] does; where the plan is of the robot or the scene before an
/// edit, searches without it, and warns with the command that renews it. Messages call the
/// robot file `shown`.
///
/// # Errors
/// Those of [`generate`], except for a plan that no longer fits.
pub fn generate_anew(
    robot: &Robot,
    request: &Request,
    shown: &str,
) -> Result<Generated, GenerateError> {
    let what = match generate(robot, request) {
        Err(GenerateError::Stale(what, _)) => what,
        other => return other,
    };
    let without = Request {
        plan: None,
        ..request.clone()
    };
    let mut generated = generate(robot, &without)?;
    let scene = request.scene.as_ref();
    let scene = scene.map(|scene| format!("--scene {} ", scene.name));
    generated.warnings.push(format!(
        "the plan beside {shown} no longer fits {what}, which was edited since: a search took its \
         place; `dalembert generate {shown} {}--effort thorough --save-plan` renews it",
        scene.unwrap_or_default()
    ));
    Ok(generated)
}

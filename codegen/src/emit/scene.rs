//! What a scene is, in the words of a module's header.

use dalembert_model::robot::{Position, Robot};
use dalembert_model::scene::Scene;

use crate::emit::figures::decimal;

/// Returns a line each.
pub(super) fn describe(scene: &Scene, robot: &Robot) -> Vec<String> {
    let mut lines = vec![format!(
        "Scene `{}` {}. Its functions are the full model's at:",
        scene.name,
        scene.short_hash()
    )];
    for (joint, at) in &scene.lock {
        let at = match at {
            Position::Angle(angle) => format!("{angle} rad"),
            Position::Length(length) => format!("{} m", decimal(length)),
        };
        lines.push(format!("- q{0} = {at}, q̇{0} = q̈{0} = 0;", joint + 1));
    }
    for (zero, rate) in [(scene.velocity_zero, "q̇"), (scene.acceleration_zero, "q̈")] {
        if zero {
            lines.push(format!("- {rate} = 0;"));
        }
    }
    if let Some(gravity) = &scene.gravity {
        let gravity: Vec<String> = gravity.iter().map(decimal).collect();
        lines.push(format!(
            "- gravity ({}) m/s², instead of the robot's;",
            gravity.join(", ")
        ));
    }
    if let Some(payload) = &scene.payload {
        let com: Vec<String> = payload.com.iter().map(decimal).collect();
        lines.push(format!(
            "- a payload of {} kg at ({}) m in the frame of the last link;",
            decimal(&payload.mass),
            com.join(", ")
        ));
    }
    let rows: Vec<String> = scene
        .rows(robot.joints.len())
        .iter()
        .map(|row| (row + 1).to_string())
        .collect();
    lines.push(format!(
        "- results over the joints {}: every index of a result counts these.",
        rows.join(", ")
    ));
    lines.push(String::new());
    lines.push(
        "Arguments have an entry for every joint; those of locked joints are not read.".into(),
    );
    lines
}

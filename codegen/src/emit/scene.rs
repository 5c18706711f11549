//! What a scene is, in the words of a module's header.

use dalembert_model::robot::{Position, Robot};
use dalembert_model::scene::Scene;

use super::say;
use crate::figures::decimal;
use crate::language::list;

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
        let gravity = list(gravity.iter().map(decimal));
        lines.push(format!(
            "- gravity ({gravity}) m/s², instead of the robot's;"
        ));
    }
    if let Some(payload) = &scene.payload {
        let (mass, com) = (
            decimal(&payload.mass),
            list(payload.com.iter().map(decimal)),
        );
        lines.push(format!(
            "- a payload of {mass} kg at ({com}) m in the frame of the last link;"
        ));
    }
    let rows = scene.rows(robot.joints.len());
    let rows = list(rows.iter().map(|row| (row + 1).to_string()));
    lines.push(format!(
        "- results over the joints {rows}: every index of a result counts these."
    ));
    let read = "Arguments have an entry for every joint; those of locked joints are not read.";
    say(&mut lines, ["", read]);
    lines
}

//! What a function says of Coulomb friction.

use super::figures::decimal;
use super::generated::GeneratedFunction;
use crate::function::Argument;
use crate::setup::Setup;

/// Returns the equation of the friction that is in it, joint by joint; nothing of functions
/// that have none in them.
pub(super) fn doc(generated: &GeneratedFunction, setup: &Setup) -> Vec<String> {
    let program = &generated.program;
    if program.speeds.is_empty() {
        return Vec::new();
    }
    let arguments = generated.function.arguments();
    let wished = arguments.contains(&Argument::ReferenceVelocity);
    let speed = if wished { "v_i" } else { "q̇_i" };
    let friction =
        format!("friction is F_i {speed}/√(q̇_i² + w_i²). In the proof each r_i is a variable.");
    let head = [
        "",
        "With Coulomb friction: b_i stands for b_i + F_i r_i, r_i = 1/√(q̇_i² + w_i²), so that the",
        &friction,
        "",
        "| joint | F | w |",
        "|---|---|---|",
    ];
    let mut lines = head.map(String::from).to_vec();
    for speed in &program.speeds {
        let joint = &setup.robot().joints[speed.joint];
        let (force, width) = (decimal(&joint.coulomb), decimal(&joint.coulomb_width));
        lines.push(format!("| {} | {force} | {width} |", speed.joint + 1));
    }
    lines
}

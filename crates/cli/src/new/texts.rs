//! The contents of the files of a new crate.

pub(super) const ROBOT: &str = "\
# Two links of a metre and a kilogram in a vertical plane: put your arm here.

name = \"planar\"
convention = \"standard\"
gravity = [0, -9.81, 0]

[[joint]]
name = \"shoulder\"
kind = \"revolute\"
a = 1
mass = 1
com = [-0.5, 0, 0]
inertia = [0, \"1/12\", \"1/12\", 0, 0, 0]
limits = { position = [\"-pi\", \"pi\"], velocity = 3, acceleration = 10, torque = 60 }

[[joint]]
name = \"elbow\"
kind = \"revolute\"
a = 1
mass = 1
com = [-0.5, 0, 0]
inertia = [0, \"1/12\", \"1/12\", 0, 0, 0]
limits = { position = [\"-pi\", \"pi\"], velocity = 3, acceleration = 10, torque = 30 }
";

pub(super) const ASKED: &str = "outputs: inverse_dynamics, gravity; scalar: f64; sincos: together";

/// q, q̇, q̈ and the torques there.
pub(super) type State = [Vec<f64>; 4];

/// Returns Cargo.toml, which makes the crate its own workspace, wherever it is put.
pub(super) fn manifest(name: &str, dependency: &str) -> String {
    format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n\
         [dependencies]\n\
         # Without the default feature `search`, the macro takes checked-in code and compiles in seconds.\n\
         dalembert = {{ {dependency}, default-features = false, features = [\"macros\", \"sines\"] }}\n\n\
         [workspace]\n"
    )
}

pub(super) const STATES: usize = 3;

pub(super) fn expected(states: &[State]) -> String {
    let row = |vectors: &State| {
        let line = |vector: &Vec<f64>| format!("        {vector:?},\n");
        format!("    [\n{}    ],\n", vectors.each_ref().map(line).concat())
    };
    let rows: String = states.iter().map(row).collect();
    format!(
        "// q, its rates and accelerations, and the torques there by a recursion that serves any arm.\n[\n{rows}]\n"
    )
}

pub(super) fn source(robot: &str, joints: usize) -> String {
    SOURCE
        .replace("STATES", &STATES.to_string())
        .replace("ROBOT", robot)
        .replace("JOINTS", &joints.to_string())
}

const SOURCE: &str = "\
//! The torques of ROBOT.

dalembert::dynamics! {
    /// Generated in robots/ROBOT.rs: after an edit of the robot run `dalembert renew`.
    pub mod ROBOT = \"robots/ROBOT.toml\";
    outputs: inverse_dynamics, gravity;
    scalar: f64;
    sincos: together;
}

fn main() {
    let q = [0.1; JOINTS];
    let hold = ROBOT::gravity(&q);
    let start = ROBOT::inverse_dynamics(&q, &[0.0; JOINTS], &[1.0; JOINTS]);
    println!(\"to hold still at q = {q:?}: {hold:.3?}\");
    println!(\"to speed up by 1 per second squared: {start:.3?}\");
}

#[cfg(test)]
mod tests {
    use super::ROBOT;

    /// q, its rates and accelerations, and the torques there by a recursion that serves any arm:
    /// `dalembert renew` computes them again.
    const EXPECTED: [[[f64; JOINTS]; 4]; STATES] = include!(\"../robots/ROBOT.expected\");

    #[test]
    fn the_code_agrees_with_the_recursion() {
        for [q, qd, qdd, expected] in EXPECTED {
            let torques = ROBOT::inverse_dynamics(&q, &qd, &qdd);
            let largest = expected.iter().fold(1.0f64, |most, x| most.max(x.abs()));
            for (joint, (torque, expected)) in (1..).zip(torques.iter().zip(expected)) {
                assert!(
                    (torque - expected).abs() < 1e-12 * largest,
                    \"inverse_dynamics, joint {joint}: {torque} by the code, {expected} by the recursion. \\
                     If the robot was edited, run `dalembert renew`: it renews both\"
                );
            }
        }
    }
}
";

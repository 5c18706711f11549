//! Robots with a base and a tool: what is generated is proved, close to the
//! runtime, and says where both are; without them nothing changes.

use crate::support::{self, read_robot, reading_with};
use dalembert_codegen::workspace::{Runtime, SEED, seeded};
use dalembert_codegen::{Function, Generated, Request, generate};
use dalembert_model::robot::Robot;

const ARM: &str = "\
name = \"arm\"
convention = \"standard\"
gravity = [0.1, 0, -9.81]
base = { xyz = [0.2, -0.3, 1.1], rpy = [0.4, \"pi/2\", \"30deg\"] }
tool = { xyz = [0.01, 0, 0.12], rpy = [\"pi\", -0.2, 0] }
[[joint]]
kind = \"revolute\"
alpha = \"pi/2\"
d = 0.4
mass = 2
com = [0.01, -0.2, 0.03]
inertia = [0.02, 0.03, 0.04, 0, 0, 0.001]
[[joint]]
kind = \"prismatic\"
alpha = \"-pi/2\"
mass = 1.5
com = [0.02, 0.1, 0.03]
inertia = [0.01, 0.02, 0.02, 0, 0.001, 0]
[[joint]]
kind = \"revolute\"
a = 0.3
mass = 1
com = [-0.1, 0.02, 0.05]
inertia = [0.02, 0.03, 0.04, 0, 0, 0]
";

/// What depends on where the base and the hand are, and the torques.
const FUNCTIONS: [Function; 7] = [
    Function::InverseDynamics,
    Function::ForwardKinematics,
    Function::LinkPoses,
    Function::Jacobian,
    Function::JacobianRate,
    Function::ReactionWrenches,
    Function::PotentialEnergy,
];

fn generated(robot: &Robot, functions: &[Function]) -> Generated {
    let request = Request::of(functions);
    // No proof, no code.
    generate(robot, &request).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn proved_and_accurate() {
    for convention in ["standard", "modified"] {
        let robot = read_robot(&ARM.replace("standard", convention));
        let generated = generated(&robot, &FUNCTIONS);
        let (runtime, states) = (Runtime::new(&robot), seeded(&robot, 50, SEED));
        support::rounds_well(&generated.emitted, &runtime, &states, convention);
        for line in [
            "gravity (0.1, 0, -9.81) m/s² in base axes",
            "frame 0 is at xyz (0.2, -0.3, 1.1) m, rpy (0.4, pi/2, pi/6)",
            "the tool, in the last link's at xyz (0.01, 0, 0.12) m, rpy (pi, -0.2, 0)",
        ] {
            assert!(generated.text().contains(line), "{line}");
        }
    }
}

/// A base that stands elsewhere and a tool cost the torques nothing.
#[test]
fn torques_do_not_feel_them() {
    let text = |more: &str| {
        let robot = reading_with("planar2r", "").robot;
        let file = dalembert_model::robot::write(&robot);
        let robot = read_robot(&file.replacen("[[joint]]", &format!("{more}\n[[joint]]"), 1));
        let all = generated(&robot, &[Function::InverseDynamics]);
        let code = |line: &&str| !line.trim_start().starts_with("//");
        let source = all.text();
        let source = source.lines().filter(code);
        source.collect::<Vec<_>>().join("\n")
    };
    let placed = text("base = { xyz = [0, 0, 2] }\ntool = { xyz = [0.1, 0, 0] }");
    assert_eq!(placed, text(""));
}

/// Nearly parallel axes, and a base and tool that follow from placements: proved
/// and accurate like any other.
#[test]
fn joints_that_are_placed() {
    let robot = read_robot(PLACED);
    assert!(!robot.joints[0].beta.is_zero() && robot.base.is_some());
    let functions = [
        Function::InverseDynamics,
        Function::Coriolis,
        Function::ForwardKinematics,
        Function::JacobianRate,
    ];
    let generated = generated(&robot, &functions);
    let (runtime, states) = (Runtime::new(&robot), seeded(&robot, 50, SEED));
    support::rounds_well(&generated.emitted, &runtime, &states, "");
    let line = "After its twist each of these turns about y: joint 1 by 0.00";
    assert!(generated.text().contains(line));
}

const PLACED: &str = "\
name = \"arm\"
gravity = [0, 0, -9.81]
[[joint]]
kind = \"revolute\"
placement = { xyz = [0.1, 0, 0.3], rpy = [0.3, 0, 0] }
axis = [0, 0, 1]
mass = 2
com = [0.2, -0.1, 0.03]
inertia = [0.02, 0.03, 0.04, 0, 0, 0.001]
[[joint]]
kind = \"revolute\"
placement = { xyz = [0.4, 0, 0.1], rpy = [0.002, 0.003, 0] }
axis = [0, 0, 1]
mass = 1.5
com = [0.2, 0.1, 0.03]
inertia = [0.01, 0.02, 0.02, 0, 0.001, 0]
[[joint]]
kind = \"prismatic\"
placement = { xyz = [0.3, 0, 0.1], rpy = [0, \"pi/2\", 0] }
axis = [0, 1, 0]
mass = 1
com = [-0.1, 0.02, 0.05]
inertia = [0.02, 0.03, 0.04, 0, 0, 0]
";

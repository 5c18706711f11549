//! Robots with a base and a tool: what is generated is proved, close to the
//! runtime, and says where both are; without them nothing changes.

mod support;

use dalembert_codegen::function::Function;
use dalembert_codegen::generate::{Generated, Request, generate};
use dalembert_codegen::states::{SEED, seeded};
use dalembert_codegen::verify::floating::{BOUND, Runtime};
use dalembert_model::robot::Robot;
use support::{read_robot, reading_with};

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
    let request = Request {
        functions: functions.to_vec(),
        ..Request::default()
    };
    // No proof, no code.
    generate(robot, &request).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn proved_and_accurate() {
    for convention in ["standard", "modified"] {
        let robot = read_robot(&ARM.replace("standard", convention));
        let generated = generated(&robot, &FUNCTIONS);
        let (runtime, states) = (Runtime::new(&robot), seeded(&robot, 50, SEED));
        for emitted in &generated.emitted {
            for measure in emitted.against_runtime(&runtime, &states) {
                let (quantity, error) = (measure.quantity.symbol(), measure.in_units());
                assert!(error <= BOUND, "{convention}, {quantity}: {error} u");
            }
        }
        for line in [
            "gravity (0.1, 0, -9.81) m/s² in base axes",
            "frame 0 is at xyz (0.2, -0.3, 1.1) m, rpy (0.4, pi/2, pi/6)",
            "the tool, in the last link's at xyz (0.01, 0, 0.12) m, rpy (pi, -0.2, 0)",
        ] {
            assert!(generated.text.contains(line), "{line}");
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
        let source = all.text.lines().filter(code);
        source.collect::<Vec<_>>().join("\n")
    };
    let placed = text("base = { xyz = [0, 0, 2] }\ntool = { xyz = [0.1, 0, 0] }");
    assert_eq!(placed, text(""));
}

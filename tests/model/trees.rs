//! Robots whose links branch: what their files say, and their values.

use crate::equations_support::golden::numbers;
use crate::support::{agree, are_said_at_their_lines, data, positions, reading, replaced, written};
use dalembert_model::equations::frames::{Axes, Rows, View};
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::{Parent, Robot};
use serde_json::Value;

fn two_arms() -> String {
    data("two_arms.toml")
}

#[test]
fn parents_are_read_and_written() {
    let robot = reading(&two_arms()).robot;
    let carriers: Vec<Option<usize>> = (0..5).map(|row| robot.carrier(row)).collect();
    assert_eq!(carriers, [None, Some(0), Some(1), Some(0), Some(3)]);
    assert!(robot.branches());
    assert_eq!(robot.tips(), [2, 4]);
    let text = written(&robot);
    assert_eq!(text.matches("parent = ").count(), 1, "{text}");
    assert!(!text.contains("convention"), "{text}");
    // By its number, the same robot.
    let by_number = reading(&replaced(&two_arms(), "parent = \"torso\"", "parent = 1"));
    assert_eq!(by_number.robot, robot);
    // A parent that is the link before says nothing.
    let name = "name = \"left_elbow\"\n";
    let text = two_arms().replace(name, &format!("{name}parent = 2\n"));
    assert_eq!(reading(&text).robot.input_hash(), robot.input_hash());
    // Two arms may stand on the ground beside each other.
    let beside = two_arms().replace("parent = \"torso\"", "parent = \"base\"");
    let joints = reading(&beside).robot.joints;
    assert_eq!(joints[3].parent, Some(Parent::Base));
    // A chain with its parents named has rows, and the hash that it has without.
    let chain = data("puma560_placed.toml");
    let named = chain.replacen("[[joint]]", "[[joint]]\nparent = \"base\"", 1);
    let [chain, named] = [chain, named].map(|text| reading(&text).robot);
    assert_eq!(chain, named);
}

#[test]
fn axes_have_length_one_exactly() {
    let one = |robot: &Robot, row: usize| {
        let axis = &robot.joints[row].place.as_ref().unwrap().axis;
        let square: Rational = axis.iter().map(|x| x * x).sum();
        assert_eq!(square, Rational::from_integer(1.into()));
        axis.clone()
    };
    let robot = reading(&two_arms()).robot;
    let tenth = |n: i64| Rational::new(n.into(), 10.into());
    assert_eq!(one(&robot, 1), [tenth(6), tenth(0), tenth(8)]);
    // (1, 1, 0)/√2 is no fraction: a point of the sphere beside it, of few digits.
    let [x, y, z] = one(&robot, 4);
    assert!(z == tenth(0) && x.denom().bits() < 120);
    for part in [&x, &y] {
        let off = f64::nearest_rational(part) - core::f64::consts::FRAC_1_SQRT_2;
        assert!(off.abs() < 2e-16, "{off}");
    }
    for axis in ["[0, 0, -3]", "[1e-9, 0, -1]", "[-2, 3, 5]", "[-1, 0, 0]"] {
        let text = two_arms().replace("axis = [1, 1, 0]", &format!("axis = {axis}"));
        one(&reading(&text).robot, 4);
    }
}

#[rustfmt::skip]
const ROWS: &[(&str, &str, usize, &str, &str)] = &[
    ("parent = \"torso\"", "parent = \"right_wrist\"", 36, "joint 5 (right_wrist), which carries this joint, comes later", "put the [[joint]] table of joint 5 (right_wrist) before this one"),
    ("parent = \"torso\"", "parent = 4", 36, "joint 4 (right_slide) carries itself", "\"base\" for the base"),
    ("parent = \"torso\"", "parent = \"trunk\"", 36, "there is no link `trunk`", "counted from 1 to 5: torso"),
    ("parent = \"torso\"", "parent = true", 36, "expected a link", "\"base\""),
    ("name = \"right_wrist\"", "name = \"left_elbow\"", 45, "joint 3 is called \"left_elbow\" already", "a name of its own"),
    ("placement = { xyz = [0, 0, 0.2] }\naxis = [1, 1, 0]", "d = 0.2", 44, "joint 5 is not placed, and links branch", "rows of a table cannot say where a branch begins"),
    ("axis = [1, 1, 0]", "axis = [0, 0, 0]", 48, "an axis of length zero", "axis = [0, 0, 1]"),
    ("gravity = [0, 0, -9.81]", "gravity = [0, 0, -9.81]\ntool = { xyz = [0, 0, 0.1] }", 4, "`tool` of a robot whose links have 2 ends", "a [[frame]]"),
    ("link = \"left_elbow\", mass", "mass", 61, "no link that holds it", "link = \"left_hand\""),
    ("link = \"left_elbow\", mass", "link = \"left_elbo\", mass", 61, "there is no link `left_elbo`", "did you mean `left_elbow`"),
];

#[test]
fn mistakes_are_said_at_their_lines() {
    are_said_at_their_lines(&two_arms(), ROWS);
}

/// τ, c, D, ∂τ/∂q, ∂τ/∂q̇ and the pose of a frame are those of Pinocchio, by every formulation.
#[test]
fn values_are_those_of_another_library() {
    let robot = reading(&two_arms()).robot;
    let golden: Value = serde_json::from_str(&data("golden/two_arms.json")).unwrap();
    let arm = Arm::from_robot(&robot, &mut f64::nearest);
    let view = View {
        frame: "left_hand",
        axes: Axes::Mixed,
        rows: Rows::ALL,
    };
    let frame_arm = arm.seen(&view).unwrap();
    for state in golden["states"].as_array().unwrap() {
        let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| numbers(&state[key]));
        let at = arm.at(&positions(&robot, &q).collect::<Vec<_>>());
        for by in Formulation::ALL {
            let by_position = by.torque_by_position(&arm, &at, &qd, &qdd);
            let results = [
                ("tau", by.inverse_dynamics(&arm, &at, &qd, &qdd)),
                ("gravity", by.gravity(&arm, &at)),
                ("inertia", by.inertia(&arm, &at).concat()),
                ("dtau_dq", by_position.concat()),
                ("dtau_dqd", by.torque_by_velocity(&arm, &at, &qd).concat()),
                ("frame", by.hand(&frame_arm, &at).rows()),
            ];
            agree(&results, state, 4e-15, by);
        }
    }
}

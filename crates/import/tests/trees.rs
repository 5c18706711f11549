//! Robots whose links branch: everything that moves, the ways to several tips, grippers whose
//! fingers follow one joint on other limbs. Values are Pinocchio's.

use std::fs;

use dalembert_import::{Import, Options, import};
use dalembert_model::equations::Arm;
use dalembert_model::equations::frames::{Axes, Rows, View};
use dalembert_model::number::{Angle, Rounded};
use dalembert_model::reference::Reference;
use dalembert_model::robot::Robot;
use nalgebra::{DMatrix, DVector};
use serde_json::Value;

use crate::support::{data, flat, golden, path, relative, states, taken, to, vector, words};

fn tree() -> Options {
    Options {
        tree: true,
        ..Options::default()
    }
}

fn exact_tree() -> Options {
    Options {
        exact: true,
        ..tree()
    }
}

fn tips(tips: &[&str]) -> Options {
    Options {
        tips: tips.iter().map(|tip| (*tip).to_owned()).collect(),
        ..Options::default()
    }
}

fn baxter() -> String {
    fs::read_to_string(path("../../../../gallery/urdf/baxter.urdf")).unwrap()
}

/// An arm with a gripper on a link: five of its six joints follow the first.
fn with_gripper(arm: &str, link: &str) -> String {
    let gripper = data("gripper.urdf");
    let inside = gripper.split_once("-->").unwrap().1;
    let joint = format!(
        r#"<joint name="mount" type="fixed"><parent link="{link}"/><child link="gripper_base"/></joint>"#
    );
    data(arm).replace("</robot>", &format!("{joint}{inside}"))
}

/// The joints that follow none.
fn coordinates(robot: &Robot) -> Vec<&str> {
    let joints = robot.joints.iter();
    joints.map(|joint| joint.name.as_deref().unwrap()).collect()
}

/// Returns the largest difference from Pinocchio's values, which are of joints in another order.
fn worst(robot: &Robot, frame: &'static str, golden: &Value) -> f64 {
    let names = words(&golden["joints"]);
    let place = |name: &&str| names.iter().position(|other| other == name).unwrap();
    let places: Vec<usize> = coordinates(robot).iter().map(place).collect();
    assert_eq!(places.len(), names.len());
    let view = View {
        frame,
        axes: Axes::Mixed,
        rows: Rows::ALL,
    };
    let view_arm = Arm::from_robot(robot, &mut f64::nearest).seen(&view);
    let view_runtime = Reference::new(view_arm.unwrap());
    let runtime = Reference::from_robot(robot);
    let mut worst = 0.0f64;
    for state in states(golden) {
        let of = |key: &str| {
            let values = flat(&state[key]);
            DVector::from_iterator(places.len(), places.iter().map(|place| values[*place]))
        };
        let [q, qd, qdd] = ["q", "qd", "qdd"].map(of);
        let inertia = flat(&state["inertia"]);
        let entry = |i: usize, k: usize| inertia[places[i] * places.len() + places[k]];
        let expected = DMatrix::from_fn(places.len(), places.len(), |k, i| entry(i, k));
        let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let gravity = runtime.gravity(&q).unwrap();
        let inertia = runtime.inertia(&q).unwrap();
        let frame = view_runtime.hand(&q).unwrap().rows();
        for (found, expected) in [
            (tau.as_slice(), of("tau").as_slice()),
            (gravity.as_slice(), of("gravity").as_slice()),
            (inertia.as_slice(), expected.as_slice()),
            (&frame, &flat(&state["frame"])),
        ] {
            worst = worst.max(relative(found, expected));
        }
    }
    worst
}

/// Both arms of Baxter with its grippers, a Panda with its hand, and a UR5 whose gripper has five
/// followers on four limbs.
#[test]
fn all_that_moves_has_the_torques_of_the_model() {
    let golden = golden("trees");
    let gripper = with_gripper("ur5.urdf", "tool0");
    for (name, frame, text, joints, followers) in [
        ("baxter", "left_gripper", baxter(), 19, 2),
        ("panda", "panda_leftfinger", data("panda.urdf"), 9, 1),
        ("ur5_gripper", "right_finger_tip", gripper, 12, 5),
    ] {
        let as_written = taken(&text, &exact_tree()).robot;
        assert!(as_written.branches());
        assert_eq!(as_written.rows().len(), joints);
        assert_eq!(coordinates(&as_written).len(), joints - followers);
        let off = worst(&as_written, frame, &golden[name]);
        assert!(off < 4e-15, "{name}: {off:e}");
        // Angles are points of the circle with rational coordinates, and parts of π are exact.
        let off = worst(&taken(&text, &tree()).robot, frame, &golden[name]);
        assert!(off < 2e-11, "{name}: {off:e}");
    }
}

/// Constants in the sines of more odd angles would be polynomials of too many terms.
#[test]
fn many_odd_angles_are_points_of_the_circle_even_if_exact() {
    for (count, are_points) in [(6, false), (7, true)] {
        let joint = |k: usize| {
            format!(
                r#"<link name="l{k}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"
                ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="j{k}" type="continuous">
                <parent link="base"/><child link="l{k}"/><origin rpy="0 0 0.{k}3"/>
                <axis xyz="1 0 0"/></joint>"#
            )
        };
        let joints: String = (1..=count).map(joint).collect();
        let text = format!(r#"<robot name="star"><link name="base"/>{joints}</robot>"#);
        let import = taken(&text, &exact_tree());
        assert_eq!(import.text.contains("odd angles are within"), are_points);
        for joint in &import.robot.joints {
            let place = joint.place.as_ref().unwrap();
            let is_point = matches!(place.placement.rpy[2], Angle::TwiceAtan(_));
            assert_eq!(is_point, are_points, "{count}");
        }
    }
}

fn lines(import: &Import) -> Vec<&str> {
    let is_said = |line: &&str| !line.starts_with('#');
    import.text.lines().filter(is_said).collect()
}

/// Without branches, `tree` gives the file of an arm.
#[test]
fn a_chain_gives_the_file_of_an_arm() {
    for file in ["ur5.urdf", "xarm7.urdf", "twodofs.urdf"] {
        let [arm, tree] = [Options::default(), tree()].map(|options| taken(&data(file), &options));
        assert_eq!(lines(&arm), lines(&tree), "{file}");
    }
    let held = [("panda_finger_joint1", "0")];
    let without_fingers = Options {
        lock: to("", &held).lock,
        ..tree()
    };
    let tree = taken(&data("panda.urdf"), &without_fingers);
    let arm = taken(&data("panda.urdf"), &to("panda_link8", &held));
    assert_eq!(tree.robot.joints, arm.robot.joints);
}

/// The limits of both fingers of PR2's grippers have zero alone in common, by the sign of one of them.
#[test]
fn a_follower_that_would_hold_its_leader_has_no_limits() {
    let right = r#"lower="-0.8" upper="0" effort="50" velocity="0.5"/><dynamics damping="0.01"/><mimic joint="knuckle" multiplier="-1"/></joint>
</robot>"#;
    let text = with_gripper("ur5.urdf", "tool0");
    assert!(text.contains(right));
    let turned = right.replacen("-0.8\" upper=\"0", "0\" upper=\"0.8", 1);
    let wrong = text.replace(right, &turned);
    let [plain, import] = [&text, &wrong].map(|text| taken(text, &tree()));
    let said = "the limits of joint `right_inner` would hold `knuckle`, which it follows: they are left out";
    assert!(import.robot.notes.iter().any(|note| note == said));
    assert_eq!(import.robot.joints, plain.robot.joints);
}

#[test]
fn several_tips_take_the_ways_to_them() {
    let options = Options {
        lock: to("", &[("*", "0"), ("left_w2", "90deg")]).lock,
        ..tips(&["left_gripper", "right_gripper"])
    };
    let arms = taken(&baxter(), &options);
    let names = coordinates(&arms.robot);
    assert_eq!((names.len(), arms.robot.tips().len()), (13, 2));
    assert!(!names.contains(&"head_pan") && !names.contains(&"left_w2"));
    let text = &arms.text;
    assert!(
        text.contains("the links left_gripper, right_gripper"),
        "{text}"
    );
    // Tips on one chain are that chain, and the hand is at the last.
    let one = taken(&data("ur5.urdf"), &to("tool0", &[]));
    let both = taken(&data("ur5.urdf"), &tips(&["forearm_link", "tool0"]));
    assert_eq!(one.robot, both.robot);
}

#[test]
fn what_cannot_be_a_tree_is_said() {
    let says = |text: &str, options: &Options, words: &str| {
        let refusal = import(text, options).unwrap_err();
        let errors = refusal.in_file("robot.urdf").render();
        assert!(errors.contains(words), "{errors}");
    };
    let both = Options {
        tree: true,
        ..tips(&["tool0"])
    };
    says(&data("ur5.urdf"), &both, "both are given: --tip, --tree");
    let two = data("ur5.urdf").replace("</robot>", "<link name=\"other\"/></robot>");
    says(&two, &tree(), "2 root links");
    let mjcf = |more: &str| {
        format!(
            r#"<mujoco><worldbody>
            <body name="left"><joint name="turn"/><inertial pos="0 0 1" mass="1" diaginertia="1 1 1"/></body>
            <body name="right"><joint name="lift"/><inertial pos="0 0 1" mass="1" diaginertia="1 1 1"/>{more}</body>
            </worldbody><equality><connect body1="left" body2="right" anchor="0 0 1"/></equality></mujoco>"#
        )
    };
    says(&mjcf(""), &tree(), "a loop over the joints `turn`, `lift`");
    let ball = r#"<body name="wrist"><joint name="any" type="ball"/><inertial pos="0 0 1" mass="1" diaginertia="1 1 1"/></body>"#;
    says(&mjcf(ball), &tree(), "joint `any` is a ball and hangs");
}

/// A quadruped that floats: its torques, D, accelerations and slopes are Pinocchio's.
#[test]
fn a_base_floats() {
    let text = data("solo12.urdf");
    let golden = golden("solo12");
    let options = Options {
        floating: true,
        ..Options::default()
    };
    let robot = taken(&text, &options).robot;
    let base = robot.floating.as_ref().unwrap();
    assert_eq!(base.name.as_deref(), Some("base_link"));
    assert_eq!((robot.joints.len(), robot.coordinates()), (12, 18));
    assert_eq!(robot.tips().len(), 4);
    // Feet are fixed to shins, and what is fixed to the base is a part of it.
    let foot = robot.frames.iter().find(|frame| frame.name == "fl_foot");
    assert_eq!(foot.unwrap().row, Some(2));
    assert!(robot.frames.iter().any(|frame| frame.row.is_none()));
    // With one tip it is a leg on a base that floats, too.
    let leg = Options {
        tips: vec!["FL_FOOT".to_owned()],
        lock: vec![("*".to_owned(), "0".to_owned())],
        ..options
    };
    assert_eq!(taken(&text, &leg).robot.coordinates(), 9);
    assert_eq!(coordinates(&robot), words(&golden["joints"]));
    let arm = Arm::from_robot(&robot, &mut f64::nearest);
    for state in states(&golden) {
        let of = |key: &str| vector(state, key);
        let g = flat(&state["g"]);
        let runtime = Reference::new(arm.clone().with_gravity(&[g[0], g[1], g[2]]));
        let [q, qd, qdd, effort] = ["q", "qd", "qdd", "effort"].map(of);
        let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let gravity = runtime.gravity(&q).unwrap();
        let bias = runtime.coriolis(&q, &qd).unwrap() + &gravity;
        let acc = runtime.forward_dynamics(&q, &qd, &effort).unwrap();
        let d = runtime.inertia(&q).unwrap();
        for (key, vector) in [("tau", tau), ("gravity", gravity), ("bias", bias)] {
            let off = relative(vector.as_slice(), of(key).as_slice());
            assert!(off < 2e-15, "{key}: {off:e}");
        }
        let off = relative(d.as_slice(), &flat(&state["D"]));
        assert!(off < 2e-15, "D: {off:e}");
        let off = relative(acc.as_slice(), of("acc").as_slice());
        assert!(off < 1e-12, "q̈: {off:e}");
    }
}

/// A free joint floats where everything that moves is asked for, and not where one arm is.
#[test]
fn a_free_joint_floats() {
    let body = |name: &str, at: &str, inside: &str| {
        format!(
            r#"<body name="{name}" pos="{at}"><inertial pos="0 0 0.1" mass="2" diaginertia="0.1 0.1 0.1"/>{inside}</body>"#
        )
    };
    let hinge = |name: &str| format!(r#"<joint name="{name}" type="hinge" axis="0 1 0"/>"#);
    let foot = body("foot", "0 0 -0.3", &hinge("ankle"));
    let left = body("left", "0 0.1 0", &(hinge("hip") + &foot));
    let text = |free: &str| {
        let trunk = body("trunk", "0 0 0.5", &(free.to_owned() + &left));
        format!(r#"<mujoco><worldbody>{trunk}</worldbody></mujoco>"#)
    };
    for free in ["<freejoint/>", r#"<joint type="free"/>"#] {
        let robot = taken(&text(free), &tree()).robot;
        let base = robot.floating.as_ref().unwrap();
        assert_eq!(base.name.as_deref(), Some("trunk"));
        assert_eq!(f64::nearest_rational(&base.mass), 2.0);
        let fixed = taken(&text(free), &Options::default());
        assert!(fixed.robot.floating.is_none() && !fixed.text.contains("convention"));
        assert_eq!(fixed.robot.joints.len(), 2);
    }
    // Several limbs on a free joint are a robot that walks: that need not be said.
    let right = body("right", "0 -0.1 0", &hinge("other"));
    let both = text(&("<freejoint/>".to_owned() + &right));
    let walks = taken(&both, &Options::default());
    assert!(walks.robot.floating.is_some());
    assert_eq!(walks.robot.joints.len(), 3);
    assert!(taken(&both, &tips(&["foot"])).robot.floating.is_none());
    assert!(taken(&text(""), &tree()).robot.floating.is_none());
    let floating = Options {
        floating: true,
        base: Some("trunk".to_owned()),
        ..Options::default()
    };
    assert!(taken(&text(""), &floating).robot.floating.is_some());
}

//! Robots whose base floats: what their files say, and their values.

use crate::equations_support::golden::numbers;
use crate::support::{
    agree, are_said_at_their_lines, data, errors, has, only, positions, reading, rows, written,
};
use dalembert_model::equations::frames::{Axes, Rows, View};
use dalembert_model::equations::{Arm, Formulation, base_position};
use dalembert_model::number::Rounded;
use dalembert_model::outputs::{Quantity, Sizes};
use dalembert_model::read::Reading;
use dalembert_model::reference::Reference;
use dalembert_model::robot::Parent;
use dalembert_model::scene;
use nalgebra::DVector;
use serde_json::Value;

fn two_legs() -> String {
    data("two_legs.toml")
}

#[test]
fn a_base_is_read_and_written() {
    let robot = reading(&two_legs()).robot;
    let base = robot.floating.as_ref().unwrap();
    assert_eq!(base.name.as_deref(), Some("trunk"));
    assert_eq!((robot.joints.len(), robot.coordinates()), (4, 10));
    let carriers: Vec<Option<usize>> = (0..4).map(|row| robot.carrier(row)).collect();
    assert_eq!(carriers, [None, Some(0), None, Some(2)]);
    assert!(robot.is_tree() && robot.branches());
    assert_eq!(robot.depth(), 8);
    let rows: Vec<Option<usize>> = robot.frames.iter().map(|frame| frame.row).collect();
    assert_eq!(rows, [Some(1), Some(3), None]);
    let text = written(&robot);
    assert_eq!(text.matches("kind = \"floating\"").count(), 1, "{text}");
    assert_eq!(text.matches("\"base\"").count(), 2, "{text}");
    assert_eq!(reading(&text).robot.input_hash(), robot.input_hash());
    // The base by its name, by the word for it, or unsaid for the first joint.
    let by_word = two_legs().replace("parent = \"trunk\"", "parent = \"base\"");
    assert_eq!(reading(&by_word).robot, robot);
    assert_eq!(robot.joints[2].parent, Some(Parent::Base));
    // A base that floats is another robot than one that stands still.
    let still = two_legs().replace("parent = \"trunk\"", "parent = \"base\"");
    let (_, limbs) = still.split_once("[[joint]]\nname = \"left_hip\"").unwrap();
    let limbs = limbs.replace("link = \"trunk\"", "link = \"left_hip\"");
    let head = "name = \"two_legs\"\ngravity = [0, 0, -9.81]\n[[joint]]\nname = \"left_hip\"";
    let fixed = reading(&format!("{head}{limbs}")).robot;
    assert_ne!(fixed.input_hash(), robot.input_hash());
    assert_eq!(fixed.joints.len(), robot.joints.len());
    // One leg is no branch, and placed all the same.
    let text = two_legs();
    let leg = "\n[[joint]]\nname = \"right_hip\"";
    let (body, _) = text.split_once(leg).unwrap();
    let hopper = reading(body).robot;
    assert!(!hopper.branches() && hopper.is_tree());
    assert!(hopper.joints.iter().all(|joint| joint.place.is_some()));
}

#[rustfmt::skip]
const ROWS: &[(&str, &str, usize, &str, &str)] = &[
    ("kind = \"floating\"\n", "kind = \"floating\"\naxis = [0, 0, 1]\n", 8, "`axis` of a base that floats", "leave it out"),
    ("kind = \"floating\"\n", "kind = \"floating\"\nviscous = 1\n", 8, "`viscous` of a base that floats", "no friction holds it"),
    ("kind = \"floating\"\n", "kind = \"floating\"\nparent = \"base\"\n", 8, "`parent` of a base that floats", "leave it out"),
    ("kind = \"prismatic\"", "kind = \"floating\"", 45, "only the first joint can float", "before the others"),
    ("velocity = [2, 2, 1, 4, 4, 4]", "velocity = 2", 11, "expected an array of 6", "of (v, ω) in the base's axes"),
    ("velocity = [2, 2, 1, 4, 4, 4]", "velocity = [2, 2, 1, 4, 4, -4]", 11, "velocity is negative", "zero or more"),
    ("velocity = [2, 2, 1, 4, 4, 4]", "position = [0, 1]", 11, "`position` of a base that floats", "has no effect"),
    ("com = [0.03, -0.01, 0.12]\n", "", 5, "the base has no `com`", "the base's frame"),
    ("mass = 9\n", "mass = -9\n", 8, "mass is negative", "in kg"),
    ("inertia = [0.2, 0.15, 0.09, 0.004, -0.003, 0.01]", "inertia = [-0.2, 0.15, 0.09, 0, 0, 0]", 10, "moment", "Ixx"),
    ("name = \"left_hip\"", "name = \"trunk\"", 14, "the base is called \"trunk\" already", "a name of its own"),
    ("gravity = [0, 0, -9.81]", "gravity = [0, 0, -9.81]\nbase = { xyz = [0, 0, 0.1] }", 4, "`base` of a robot whose base floats", "a [[frame]]"),
    ("gravity = [0, 0, -9.81]", "gravity = [0, 0, -9.81]\nconvention = \"modified\"", 4, "joints that are placed", "leave `convention` out"),
    ("placement = { xyz = [0, 0, 0.2] }\naxis = [1, 1, 0]", "offset = 0.2", 43, "joint 4 is not placed, and the base floats", "a base that is fixed"),
    ("parent = \"trunk\"", "parent = \"torso\"", 35, "there is no link `torso`", "counted from 1 to 4"),
];

#[test]
fn mistakes_are_said_at_their_lines() {
    are_said_at_their_lines(&two_legs(), ROWS);
}

/// All values are those of Pinocchio, by every formulation.
#[test]
fn values_are_those_of_another_library() {
    let robot = reading(&two_legs()).robot;
    let golden: Value = serde_json::from_str(&data("golden/two_legs.json")).unwrap();
    let arm = Arm::from_robot(&robot, &mut f64::nearest);
    let view = View {
        frame: "left_foot",
        axes: Axes::Mixed,
        rows: Rows::ALL,
    };
    let feet = View {
        frame: "left_foot,right_foot",
        ..view
    };
    for state in golden["states"].as_array().unwrap() {
        let [q, qd, qdd, effort, g] =
            ["q", "qd", "qdd", "effort", "g"].map(|key| numbers(&state[key]));
        let arm = arm.clone().with_gravity(&[g[0], g[1], g[2]]);
        let frame_arm = arm.seen(&view).unwrap();
        let held = arm.seen(&feet).unwrap();
        let position = base_position().into_iter().chain(positions(&robot, &q));
        let at = arm.at(&position.collect::<Vec<_>>());
        let moves = vec![true; qd.len()];
        for by in Formulation::ALL {
            let inputs = [&qd[..], &effort, &[0.01]];
            let space = by.contact_space(&held, &at, inputs, &moves);
            let accelerations = by.forward_dynamics(&arm, &at, &qd, &effort, &moves);
            let by_position = by.torque_by_position(&arm, &at, &qd, &qdd);
            let centroidal = by.centroidal_momentum_matrix(&arm, &at);
            let bias = by.centroidal_bias(&arm, &at, &qd);
            let jacobians = by.contact_jacobians(&held, &at);
            let results = [
                ("tau", by.inverse_dynamics(&arm, &at, &qd, &qdd)),
                ("gravity", by.gravity(&arm, &at)),
                ("bias", by.velocity_terms(&arm, &at, &qd)),
                ("inertia", by.inertia(&arm, &at).concat()),
                ("accelerations", accelerations),
                ("dtau_dq", by_position.concat()),
                ("dtau_dqd", by.torque_by_velocity(&arm, &at, &qd).concat()),
                ("kinetic", vec![by.kinetic_energy(&arm, &at, &qd)]),
                ("jacobian", by.jacobian(&frame_arm, &at).concat()),
                ("drift", by.jacobian_rate(&frame_arm, &at, &qd).concat()),
                ("frame", by.hand(&frame_arm, &at).rows()),
                ("com", by.centre_of_mass(&arm, &at).to_vec()),
                ("centroidal", centroidal.concat()),
                ("centroidal_bias", bias.to_vec()),
                ("base_free", by.free_base(&arm, &at, [&qd, &qdd])),
                ("contact_jacobians", jacobians.concat()),
                ("contact_bias", by.contact_bias(&held, &at, &qd)),
                ("qdd_held", space.accelerations()),
                ("forces", space.forces()),
            ];
            agree(&results, state, 1e-14, by);
        }
        // C of Pinocchio has another skew part where links turn; both give h.
        let c = Formulation::LagrangeEuler.coriolis_matrix(&arm, &at, &qd);
        let [terms, other] = [c.concat(), numbers(&state["coriolis"])].map(|c| {
            let product = |row: &[f64]| row.iter().zip(&qd).map(|(c, v)| c * v).sum();
            c.chunks(qd.len()).map(product).collect::<Vec<f64>>()
        });
        for (term, other) in terms.iter().zip(&other) {
            assert!((term - other).abs() < 1e-12, "{term} {other}");
        }
    }
}

#[test]
fn the_runtime_has_six_coordinates_more() {
    let robot = reading(&two_legs()).robot;
    let runtime = Reference::from_robot(&robot);
    assert_eq!((runtime.joints(), runtime.coordinates()), (4, 10));
    let vector = |n: usize| DVector::from_fn(n, |i, _| 0.1 + 0.2 * i as f64);
    let (q, qd) = (vector(4), vector(10));
    let tau = runtime.inverse_dynamics(&q, &qd, &qd).unwrap();
    assert_eq!(tau.len(), 10);
    let back = runtime.forward_dynamics(&q, &qd, &tau).unwrap();
    assert!((back - &qd).amax() < 1e-12);
    let error = runtime.inverse_dynamics(&q, &q, &qd).unwrap_err();
    assert_eq!(error.message, "`qd` has 4 values, the arm has 10 joints");
    // The base in free fall feels nothing of gravity.
    let sizes = Sizes::of(&robot);
    let rows: Vec<usize> = (0..10).collect();
    let unit = |index| Quantity::Torque.unit(index, &rows, sizes, &robot);
    assert_eq!([0, 3, 6, 9].map(unit), ["N", "N·m", "N·m", "N"]);
    assert_eq!(Quantity::LinkPoses.len(sizes), 4 * 12);
    assert_eq!(Quantity::LinkRegressor.len(sizes), 10 * 50);
    assert_eq!(Quantity::Wrench.entry(6, &rows, sizes), "w_2,1");
}

fn in_scene(lines: &str) -> String {
    let text = two_legs();
    let (robot, _) = text.split_once("[scene.").unwrap();
    format!("{robot}[scene.stand]\n{lines}\n")
}

/// Returns the text of the one scene, which says the same behind that of the robot.
#[track_caller]
fn scene_written(Reading { robot, scenes, .. }: &Reading) -> String {
    let text = scene::write(only(scenes));
    let again = reading(&format!("{}{text}", written(robot)));
    assert_eq!(again.scenes, *scenes);
    text
}

/// A base that is locked is that of a fixed tree; gravity is the file's, or the scene's.
#[test]
fn a_scene_locks_the_base() {
    let lock = "lock = { trunk = \"level\", right_slide = 0.05 }";
    let reading = reading(&in_scene(lock));
    let scene = &reading.scenes[0];
    assert!(scene.lock_base && scene.lock.len() == 1);
    let held = scene.apply(&reading.robot);
    assert!(held.floating.is_none() && held.is_tree());
    assert_eq!((held.coordinates(), held.depth()), (4, 2));
    let frames = held.frames.iter().map(|frame| frame.name.as_str());
    assert!(frames.eq(["left_foot", "right_foot"]), "{:?}", held.frames);
    let text = scene_written(&reading);
    let lock = "lock = { base = \"level\", 4 = 0.05 }";
    assert!(text.contains(lock), "{text}");
    // The same torques as of a base that floats and is at rest.
    let [fixed, floating] = [&held, &reading.robot].map(Reference::from_robot);
    let vector = |n: usize| DVector::from_fn(n, |i, _| 0.3 - 0.2 * i as f64);
    let (q, qd) = (vector(4), vector(4) * 2.0);
    let found = fixed.inverse_dynamics(&q, &qd, &qd).unwrap();
    let wide = DVector::from_fn(10, |i, _| if i < 6 { 0.0 } else { qd[i - 6] });
    let expected = floating.inverse_dynamics(&q, &wide, &wide).unwrap();
    assert!((found - expected.rows(6, 4)).amax() < 1e-14);
}

/// A payload on the base is felt by the base alone while no joint moves: F = m (a - g), and r x F.
#[test]
fn a_base_carries_a_payload() {
    let payload = "payload = { link = \"trunk\", mass = 2, com = [0.1, -0.2, 0.3] }";
    let reading = reading(&in_scene(payload));
    let scene = &reading.scenes[0];
    assert_eq!(scene.payload_link, Some(Parent::Base));
    let text = scene_written(&reading);
    assert!(text.contains("link = \"base\""), "{text}");
    let [loaded, bare] = [&scene.apply(&reading.robot), &reading.robot].map(Reference::from_robot);
    let zero = DVector::zeros(10);
    let a = [0.5, -1.5, 2.0];
    let qdd = DVector::from_fn(10, |i, _| a.get(i).copied().unwrap_or(0.0));
    let q = DVector::from_fn(4, |i, _| 0.2 * i as f64);
    let [loaded, bare] =
        [loaded, bare].map(|robot| robot.inverse_dynamics(&q, &zero, &qdd).unwrap());
    let more = loaded - bare;
    let force = [2.0 * a[0], 2.0 * a[1], 2.0 * (a[2] + 9.81)];
    let r = [0.1, -0.2, 0.3];
    let moment = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        r[j] * force[k] - r[k] * force[j]
    };
    for i in 0..3 {
        assert!((more[i] - force[i]).abs() < 1e-12, "{more}");
        assert!((more[3 + i] - moment(i)).abs() < 1e-12, "{more}");
    }
    assert!(more.rows(6, 4).amax() < 1e-12);
}

/// Lines of a scene, and of its error: the message and the help.
const SCENES: &str = r#"
lock = { trunk = 0 } | expected "level" | trunk = "level"
lock = { trunk = "tilted" } | tilted | trunk = "level"
lock = { torso = "level" } | there is no joint `torso` |
lock = { base = "level" }\npayload = { link = "trunk", mass = 1, com = [0, 0, 0] } | on the base, which does not move |
lock = { base = "level" }\nbox = { velocity = [1, 1, 1, 1, 1, 1, 1, 1, 1, 1] } | 10 entries, but the robot has 4 joints | one entry a joint
payload = { mass = 1, com = [0, 0, 0] } | no link that holds it | link =
"#;

#[test]
fn scenes_of_a_base_are_refused_with_the_reason() {
    for [lines, message, help] in rows(SCENES) {
        let errors = errors(&in_scene(&lines));
        has(only(&errors), &message, &help);
    }
    let level = "lock = { base = \"level\" }\nbox = { velocity = [1, 1, 1, 1] }";
    assert_eq!(reading(&in_scene(level)).scenes.len(), 1);
}

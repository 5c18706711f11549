//! `base` and `tool` of a robot file: what is read is written, what is wrong is
//! said, and which axes gravity and poses are in.

use dalembert_model::number::{Angle, Rational};
use dalembert_model::read::{Options, parse};
use dalembert_model::reference::Reference;
use dalembert_model::robot::{Placement, Robot, write};
use nalgebra::DVector;

/// Two joints, nothing of them zero, with more of the robot's own keys.
fn file(more: &str) -> String {
    format!(
        "name = \"arm\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n{more}\n\
         [[joint]]\nkind = \"revolute\"\nalpha = \"pi/2\"\na = 0.1\nd = 0.4\nmass = 2\n\
         com = [0.01, -0.2, 0.03]\ninertia = [0.02, 0.03, 0.04, 0, 0, 0]\n\
         [[joint]]\nkind = \"revolute\"\na = 0.3\nmass = 1\n\
         com = [-0.1, 0.02, 0.05]\ninertia = [0.02, 0.03, 0.04, 0, 0, 0]\n"
    )
}

fn robot(more: &str) -> Robot {
    let text = file(more);
    match parse(&text, &Options::default()) {
        Ok(reading) => reading.robot,
        Err(errors) => panic!("{}", errors.render("arm.toml", &text)),
    }
}

fn errors(more: &str) -> String {
    let text = file(more);
    match parse(&text, &Options::default()) {
        Ok(_) => panic!("{more} was read"),
        Err(errors) => errors.render("arm.toml", &text),
    }
}

fn ratio(numer: i64, denom: i64) -> Rational {
    Rational::new(numer.into(), denom.into())
}

#[test]
fn read_and_written_back() {
    let placed = robot(
        "base = { xyz = [0, 0.1, \"1/3\"], rpy = [\"pi\", 0.5, \"-45deg\"] }\n\
         [tool]\nxyz = [0, 0, 0.107]\n",
    );
    let base = Placement {
        xyz: [ratio(0, 1), ratio(1, 10), ratio(1, 3)],
        rpy: [
            Angle::right_angles(2),
            Angle::Radians(ratio(1, 2)),
            Angle::PiTimes(ratio(-1, 4)),
        ],
    };
    assert_eq!(placed.base, Some(base));
    let again = parse(&write(&placed), &Options::default()).unwrap().robot;
    assert_eq!(again, placed);
    assert_ne!(placed.input_hash(), robot("").input_hash());
    assert_ne!(
        placed.input_hash(),
        robot("tool = { xyz = [0, 0, 0.107] }").input_hash()
    );
}

/// A placement that moves nothing says what leaving it out says: one hash,
/// one plan, one text.
#[test]
fn what_moves_nothing_is_none() {
    let said = robot("base = { xyz = [0, 0, 0], rpy = [0, 0, 0] }\ntool = {}");
    assert_eq!(said, robot(""));
    assert_eq!(write(&said), write(&robot("")));
}

/// A scene's payload is given in the frame that the file says, moved and turned: by
/// Rz(π/2), x′ = −y and y′ = x.
#[test]
fn payloads_have_a_frame() {
    let read = |frame: &str, payload: &str| {
        let scene = format!("[scene.pick]\npayload = {{ mass = 2, {payload} }}\n");
        let text = format!("{}{scene}", file(frame));
        let reading = parse(&text, &Options::default()).unwrap();
        let robot = reading.scenes[0].apply(&reading.robot);
        (reading, robot)
    };
    let frame = "payload_frame = { xyz = [1, 2, 3], rpy = [0, 0, \"pi/2\"] }";
    let own = "com = [0.1, 0.2, 0.3], inertia = [0.02, 0.03, 0.04, 0.001, 0.002, 0.003]";
    let (reading, carrying) = read(frame, own);
    let moved = "com = [0.8, 2.1, 3.3], inertia = [0.03, 0.02, 0.04, -0.001, 0.003, -0.002]";
    let (plain, expected) = read("", moved);
    assert_eq!(carrying.joints, expected.joints);
    // The file that says the same keeps both, and is another robot's.
    assert!(write(&reading.robot).contains(frame));
    let again = parse(&write(&reading.robot), &Options::default()).unwrap();
    assert_eq!(again.robot, reading.robot);
    assert_ne!(reading.robot.input_hash(), plain.robot.input_hash());
}

#[test]
fn errors_say_where_and_what() {
    let text = errors(
        "base = { xyz = [0, 0], rpy = [0, 0, \"pi/two\"] }\ntool = { xyz = [0, 0, 1e301], rot = 1 }",
    );
    for part in [
        "arm.toml:4:16",
        "xyz = [x, y, z], in m",
        "arm.toml:4:38",
        "arm.toml:5:23",
        "unknown key `rot`",
    ] {
        assert!(text.contains(part), "{part} is missing:\n{text}");
    }
    assert!(errors("base = [0, 0, 1]").contains("base = { xyz = ["));
    let odd = parse(&file("tool = { xyz = [0, 0, 107] }"), &Options::default()).unwrap();
    assert!(odd.notes[0].message.contains("longer than 10 m"));
    assert_eq!(odd.notes[0].line, 4);
}

/// The pose of the hand is base · (pose without either) · tool, entry by entry,
/// for placements whose matrices are known.
#[test]
fn poses_are_in_base_axes_and_of_the_tool() {
    let q = DVector::from_vec(vec![0.3, -0.7]);
    let hand = |more: &str| {
        let runtime = Reference::<f64>::from_robot(&robot(more));
        runtime.hand(&q).unwrap()
    };
    let plain = hand("");
    // Rz(π/2): x′ = −y, y′ = x.
    let turned = hand("base = { xyz = [1, 2, 3], rpy = [0, 0, \"pi/2\"] }");
    let expected = [
        1.0 - plain.origin[1],
        2.0 + plain.origin[0],
        3.0 + plain.origin[2],
    ];
    assert_eq!(turned.origin, expected);
    // Rx(π/2) of the hand: its y is what was z.
    let tool = hand("tool = { xyz = [0, 0, 0.5], rpy = [\"pi/2\", 0, 0] }");
    let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    assert!(close(tool.axes[1], plain.axes[2]));
    let reach = [0, 1, 2].map(|i| plain.origin[i] + 0.5 * plain.axes[2][i]);
    assert!(close(tool.origin, reach));
    // Roll first, yaw last: Rz(π/2) Rx(π/2) takes y over z to z.
    let both = hand("base = { rpy = [\"pi/2\", 0, \"pi/2\"] }");
    assert!(close(
        both.origin,
        [plain.origin[2], plain.origin[0], plain.origin[1]]
    ));
}

/// Gravity is in base axes: an arm that hangs from the ceiling feels it from
/// above, and a base that only stands elsewhere changes nothing.
#[test]
fn gravity_is_in_base_axes() {
    let q = DVector::from_vec(vec![0.3, -0.7]);
    let load = |robot: &Robot| Reference::<f64>::from_robot(robot).gravity(&q).unwrap();
    let hanging = robot("base = { xyz = [0, 0, 2], rpy = [\"pi\", 0, 0] }");
    let mut up = robot("");
    up.gravity[2] = ratio(981, 100);
    assert_eq!(load(&hanging), load(&up));
    assert_ne!(load(&hanging), load(&robot("")));
    assert_eq!(load(&robot("base = { xyz = [1, 2, 3] }")), load(&robot("")));
    // The potential energy is from the base's origin: m g z more of it.
    let energy = |more: &str| {
        let runtime = Reference::<f64>::from_robot(&robot(more));
        runtime.potential_energy(&q).unwrap()
    };
    let lifted = energy("base = { xyz = [1, 2, 3] }") - energy("");
    assert!((lifted - 3.0 * 9.81 * 3.0).abs() < 1e-13, "{lifted}");
}

//! `base` and `tool` of a robot file: what is read is written, what is wrong is
//! said, and which axes gravity and poses are in.

use dalembert_model::number::{Angle, Rational};
use dalembert_model::read::{Options, parse};
use dalembert_model::reference::Reference;
use dalembert_model::robot::{Placement, Robot, write};
use nalgebra::DVector;

/// Returns two joints, nothing of them zero, with more of the robot's own keys.
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

/// Returns a file with tables behind its joints.
fn behind(more: &str) -> Result<Robot, String> {
    let text = file("") + more;
    let read = parse(&text, &Options::default());
    let robot = read.map(|reading| reading.robot);
    robot.map_err(|errors| errors.render("arm.toml", &text))
}

#[test]
fn frames_are_read_and_written_back() {
    let more = "frame = { xyz = [0, 0, 0.1] }\n\n[[frame]]\nname = \"camera\"\nlink = 2\n\
                xyz = [0.1, 0, 0]\nrpy = [0, \"pi/2\", 0]\n[[frame]]\nname = \"base_1\"\nlink = \"1\"\n";
    let robot = behind(more).unwrap();
    assert_eq!(robot.frames.len(), 2);
    assert_eq!((robot.frames[0].joint, robot.frames[1].joint), (1, 0));
    assert_eq!(robot.frames[0].placement.rpy[1], Angle::right_angles(1));
    let own = robot.joints[1].frame.as_ref().unwrap();
    assert_eq!(own.xyz[2], ratio(1, 10));
    let again = parse(&write(&robot), &Options::default()).unwrap().robot;
    assert_eq!(again, robot);
    // A file without frames has the text, and the hash, that it always had.
    assert!(!write(&behind("").unwrap()).contains("frame"));
}

/// Tables of frames, and below each words of what is said of it.
const REFUSED: &str = r#"
[[frame]]\nname = "camera"\nlink = 3
there is no link `3` | joints are counted from 1 to 2
[[frame]]\nname = "camera"\nlink = "wrist"
there is no link `wrist` | count them from 1 to 2
[[frame]]\nname = "camera"\nlink = [1]
expected a link | or the name of its joint
[[frame]]\nname = "Tool-0"\nlink = 1
"Tool-0" cannot name a frame | write "tool_0"
[[frame]]\nname = "tip_batch"\nlink = 1
"tip_batch" cannot name a frame | small letters
[[frame]]\nname = "hand"\nlink = 1
`hand` is the name of the robot's own hand | otherwise
[[frame]]\nname = "a"\nlink = 1\n[[frame]]\nname = "a"\nlink = 2
frame 1 is called "a" already | a name of its own
[[frame]]\nname = "a"
frame 1 has no `link` | link = 3
[[frame]]\nlink = 1
frame 1 has no `name` | jacobian_camera
[[frame]]\nname = "a"\nlink = 1\nxzy = [0, 0, 0]
unknown key `xzy` | did you mean `xyz`?
[frame]\nname = "a"
expected [[frame]] tables | two brackets
"#;

#[test]
fn frames_that_cannot_be_are_refused_where_they_stand() {
    let lines: Vec<&str> = REFUSED.trim().lines().collect();
    for [table, words] in lines.as_chunks::<2>().0 {
        let said = behind(&format!("{}\n", table.replace("\\n", "\n"))).unwrap_err();
        for part in words.split(" | ") {
            assert!(said.contains(part), "{table}\n{said}");
        }
        assert_eq!(said.matches("error: ").count(), 1, "{said}");
    }
}

/// A frame in the link's own frame is where it was before rows were derived.
#[test]
fn frames_move_over_with_their_links() {
    let text = "name = \"arm\"\ngravity = [0, 0, -9.81]\n\
         [[joint]]\nkind = \"revolute\"\nplacement = { xyz = [0.1, 0.2, 0.3], rpy = [0.3, 0, 0.5] }\n\
         axis = [0, 1, 0]\nmass = 1\ncom = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n\
         [[joint]]\nkind = \"revolute\"\nplacement = { xyz = [0, 0.2, 0.3], rpy = [0, 1, 0] }\n\
         axis = [1, 0, 0]\nmass = 1\ncom = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n\
         [[frame]]\nname = \"one\"\nlink = 1\n[[frame]]\nname = \"two\"\nlink = 2\nxyz = [0, 0.5, 0]\n";
    let robot = parse(text, &Options::default()).unwrap().robot;
    let reference = Reference::<f64>::from_robot(&robot);
    let still = DVector::from_vec(vec![0.0; 2]);
    let at = |text: &str| {
        let function = dalembert_model::outputs::Function::parse(text).unwrap();
        let at = dalembert_model::reference::JointVectors::new(
            [(); 6].map(|()| DVector::from_vec(Vec::new())),
        );
        let at = dalembert_model::reference::JointVectors {
            q: still.clone(),
            ..at
        };
        reference.entries(function.quantities()[0], &at).unwrap()
    };
    // At q = 0 the placements are the poses.
    let one = at("forward_kinematics@one");
    for (entry, expected) in [3, 7, 11].map(|i| one[i]).iter().zip([0.1, 0.2, 0.3]) {
        assert!((entry - expected).abs() < 1e-15, "{one:?}");
    }
    let links = at("link_poses");
    assert!(
        links[..12]
            .iter()
            .zip(&one)
            .all(|(a, b)| (a - b).abs() < 1e-15)
    );
    let two = at("forward_kinematics@two");
    // The second link's own frame, and half a metre along its y.
    for i in 0..3 {
        let expected = links[12 + 4 * i + 3] + 0.5 * links[12 + 4 * i + 1];
        assert!((two[4 * i + 3] - expected).abs() < 1e-15, "{two:?}");
    }
}

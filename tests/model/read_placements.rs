//! `base`, `tool` and frames of a robot file: what is read is written, and what is wrong is said.

use crate::support::{errors, has, only, ratio, reading, refused, rows, vector, written};
use dalembert_model::number::Angle;
use dalembert_model::outputs::{Argument, Function};
use dalembert_model::reference::{JointVectors, Reference};
use dalembert_model::robot::{Placement, Robot};

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
    reading(&file(more)).robot
}

#[test]
fn read_and_written_back() {
    let placed = robot(
        "base = { xyz = [0, 0.1, \"1/3\"], rpy = [\"pi\", 0.5, \"-45deg\"] }\n\
         [tool]\nxyz = [0, 0, 0.107]\n",
    );
    let (half, eighth) = (Angle::Radians(ratio(1, 2)), Angle::PiTimes(ratio(-1, 4)));
    let xyz = [ratio(0, 1), ratio(1, 10), ratio(1, 3)];
    let rpy = [Angle::right_angles(2), half, eighth];
    assert_eq!(placed.base, Some(Placement { xyz, rpy }));
    written(&placed);
    for other in ["", "tool = { xyz = [0, 0, 0.107] }"] {
        assert_ne!(placed.input_hash(), robot(other).input_hash());
    }
}

#[test]
fn what_moves_nothing_is_none() {
    let said = robot("base = { xyz = [0, 0, 0], rpy = [0, 0, 0] }\ntool = {}");
    assert_eq!(said, robot(""));
    assert_eq!(written(&said), written(&robot("")));
}

/// By Rz(π/2), x′ = −y and y′ = x.
#[test]
fn payloads_have_a_frame() {
    let read = |frame: &str, payload: &str| {
        let scene = format!("[scene.pick]\npayload = {{ mass = 2, {payload} }}\n");
        let reading = reading(&format!("{}{scene}", file(frame)));
        let robot = reading.scenes[0].apply(&reading.robot);
        (reading, robot)
    };
    let frame = "payload_frame = { xyz = [1, 2, 3], rpy = [0, 0, \"pi/2\"] }";
    let payload = "com = [0.1, 0.2, 0.3], inertia = [0.02, 0.03, 0.04, 0.001, 0.002, 0.003]";
    let (reading, carrying) = read(frame, payload);
    let moved = "com = [0.8, 2.1, 3.3], inertia = [0.03, 0.02, 0.04, -0.001, 0.003, -0.002]";
    let (plain, expected) = read("", moved);
    assert_eq!(carrying.joints, expected.joints);
    assert!(written(&reading.robot).contains(frame));
    assert_ne!(reading.robot.input_hash(), plain.robot.input_hash());
}

#[test]
fn errors_say_where_and_what() {
    let bad = "base = { xyz = [0, 0], rpy = [0, 0, \"pi/two\"] }\n\
        tool = { xyz = [0, 0, 1e301], rot = 1 }";
    let text = refused(&file(bad));
    let words = "arm.toml:4:16|xyz = [x, y, z], in m|arm.toml:4:38|arm.toml:5:23|unknown key `rot`";
    for words in words.split('|') {
        assert!(text.contains(words), "{words} is missing:\n{text}");
    }
    assert!(refused(&file("base = [0, 0, 1]")).contains("base = { xyz = ["));
    let odd = reading(&file("tool = { xyz = [0, 0, 107] }")).notes;
    assert!(odd[0].message.contains("longer than 10 m"));
    assert_eq!(odd[0].line().unwrap(), 4);
}

#[test]
fn energy_is_in_base_axes() {
    let energy = |more: &str| {
        let runtime = Reference::<f64>::from_robot(&robot(more));
        runtime.potential_energy(&vector(&[0.3, -0.7])).unwrap()
    };
    let lifted = energy("base = { xyz = [1, 2, 3] }") - energy("");
    assert!((lifted - 3.0 * 9.81 * 3.0).abs() < 1e-13, "{lifted}");
}

#[test]
fn frames_are_read_and_written_back() {
    let more = "frame = { xyz = [0, 0, 0.1] }\n\n[[frame]]\nname = \"camera\"\nlink = 2\n\
                xyz = [0.1, 0, 0]\nrpy = [0, \"pi/2\", 0]\n[[frame]]\nname = \"base_1\"\nlink = \"1\"\n";
    let robot = reading(&(file("") + more)).robot;
    let rows: Vec<_> = robot.frames.iter().map(|frame| frame.row).collect();
    assert_eq!(rows, [Some(1), Some(0)]);
    assert_eq!(robot.frames[0].placement.rpy[1], Angle::right_angles(1));
    let placement = robot.joints[1].frame.as_ref().unwrap();
    assert_eq!(placement.xyz[2], ratio(1, 10));
    written(&robot);
    // A file without frames has the text, and the hash, that it always had.
    assert!(!written(&self::robot("")).contains("frame"));
}

/// Tables of frames, of which one is named, and words of what is said of each.
const REFUSED: &str = r#"
[[frame]]\nname = "camera"\nlink = 3 | there is no link `3` | joints are counted from 1 to 2
[[frame]]\nname = "camera"\nlink = "wrist" | there is no link `wrist` | count them from 1 to 2
[[frame]]\nname = "camera"\nlink = [1] | expected a link | or the name of its joint
[[frame]]\nname = "Tool-0"\nlink = 1 | "Tool-0" cannot name a frame | write "tool_0"
[[frame]]\nname = "tip_batch"\nlink = 1 | "tip_batch" cannot name a frame | small letters
[[frame]]\nname = "hand"\nlink = 1 | `hand` is the name of the robot's own hand | another name
NAMED\nlink = 1\nNAMED\nlink = 2 | frame 1 is called "a" already | a name of its own
NAMED | frame 1 has no `link` | link = 3
[[frame]]\nlink = 1 | frame 1 has no `name` | jacobian_camera
NAMED\nlink = 1\nxzy = [0, 0, 0] | unknown key `xzy` | did you mean `xyz`?
[frame]\nname = "a" | expected [[frame]] tables | two brackets
"#;

#[test]
fn frames_that_cannot_be_are_refused_where_they_stand() {
    for [table, message, help] in rows(REFUSED) {
        let table = table.replace("NAMED", "[[frame]]\nname = \"a\"");
        let errors = errors(&format!("{}{table}\n", file("")));
        has(only(&errors), &message, &help);
    }
}

#[test]
fn frames_move_over_with_their_links() {
    let text = "name = \"arm\"\ngravity = [0, 0, -9.81]\n\
         [[joint]]\nkind = \"revolute\"\nplacement = { xyz = [0.1, 0.2, 0.3], rpy = [0.3, 0, 0.5] }\n\
         axis = [0, 1, 0]\nmass = 1\ncom = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n\
         [[joint]]\nkind = \"revolute\"\nplacement = { xyz = [0, 0.2, 0.3], rpy = [0, 1, 0] }\n\
         axis = [1, 0, 0]\nmass = 1\ncom = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n\
         [[frame]]\nname = \"one\"\nlink = 1\n[[frame]]\nname = \"two\"\nlink = 2\nxyz = [0, 0.5, 0]\n";
    let reference = Reference::<f64>::from_robot(&reading(text).robot);
    let still = JointVectors::new([(Argument::Position, vector(&[0.0; 2]))]);
    let at = |text: &str| {
        let quantity = Function::parse(text).unwrap().quantities()[0];
        reference.entries(quantity, &still).unwrap()
    };
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-15);
    let (one, two) = (at("forward_kinematics@one"), at("forward_kinematics@two"));
    let links = at("link_poses");
    for i in 0..3 {
        close(one[4 * i + 3], [0.1, 0.2, 0.3][i]);
        let [along, origin] = [1, 3].map(|column| links[12 + 4 * i + column]);
        close(two[4 * i + 3], origin + 0.5 * along);
    }
    let pairs = one.iter().zip(&links);
    pairs.for_each(|(found, expected)| close(*found, *expected));
}

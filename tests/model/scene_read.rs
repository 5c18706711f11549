//! Scenes of robot files: every key, and the text that says the same.

use crate::support::{errors, has, only, ratio, reading, replaced, rows};
use dalembert_model::number::Angle;
use dalembert_model::outputs::Function;
use dalembert_model::read::Severity;
use dalembert_model::read::{Diagnostic, RobotWarning};
use dalembert_model::robot::Position;
use dalembert_model::scene::{Scale, Scene, SceneScalar, write};

const ROBOT: &str = r#"
name = "arm"
convention = "standard"
gravity = [0, 0, -9.81]
[[joint]]
name = "waist"
kind = "revolute"
mass = 1
com = [0, 0, 0]
inertia = [0, 0, 1, 0, 0, 0]
limits = { position = ["-pi", "pi"], velocity = 2, acceleration = 10, torque = 50 }
[[joint]]
name = "boom"
kind = "prismatic"
mass = 2
com = [0, 0, 0]
inertia = [1, 1, 1, 0, 0, 0]
limits = { position = [-0.5, 0.5], velocity = 1, acceleration = 5, torque = 80 }
[[joint]]
name = "wrist"
kind = "revolute"
mass = 0.5
com = [0.1, 0, 0]
inertia = [1, 1, 1, 0, 0, 0]
limits = { position = [-2, 2], velocity = 3, acceleration = 10, torque = 5 }
"#;

fn scenes(text: &str) -> Vec<Scene> {
    reading(&format!("{ROBOT}{text}")).scenes
}

fn scene(text: &str) -> String {
    format!("[scene.a]\n{text}\n")
}

fn with(text: &str) -> String {
    ROBOT.to_owned() + &scene(text)
}

fn notes(text: &str, begin: &str) -> Vec<(usize, Diagnostic)> {
    let reading = reading(&with(text));
    assert_eq!(reading.scenes.len(), 1);
    let before = ROBOT.lines().count() + 1;
    let notes = reading.notes.into_iter();
    let matches = notes.filter(|note| note.message.starts_with(begin));
    let lines = matches.map(|note| (note.line().unwrap().wrapping_sub(before), note));
    lines.collect()
}

#[test]
fn every_key() {
    let originals = scenes(
        r#"
[scene.pick]
outputs = ["inverse_dynamics", "gravity"]
joints = ["wrist", 1]
lock = { 2 = "1/3" }
gravity = [0, 0, -1.62]
velocity = "zero"
payload = { mass = "1/3", com = [0, 0, 0.05], inertia = [0.01, 0.01, 0.01, 0, 0, 0] }
box = { position = [[-1, 1], [0, 0.5], ["-pi/2", "90deg"]], velocity = [2, 1, 3], payload = { mass = [0, "1/3"], radius = 0.1 } }
tolerance = { value = [1e-3, 1, 0.1], relative_to = "actuator" }
scalar = "f32"

[scene.hold]
lock = { waist = 1, wrist = "pi/6" }
acceleration = "zero"
payload = { mass = 1, com = [0, 0, 0.05] }
box = { acceleration = [2, 1, 3] }
tolerance = { value = 1e-3, relative_to = "range" }
scalar = "f64"
"#,
    );
    let [pick, hold] = originals.as_slice() else {
        panic!("{originals:?}")
    };
    assert_eq!(pick.name, "pick");
    assert_eq!(pick.outputs, [Function::InverseDynamics, Function::Gravity]);
    assert_eq!(pick.joints.as_deref(), Some(&[2, 0][..]));
    assert_eq!(pick.lock, [(1, Position::Length(ratio(1, 3)))]);
    assert!(pick.gravity.is_some() && pick.velocity_zero && !pick.acceleration_zero);
    let load = pick.payload.as_ref().map(|load| load.mass.clone());
    assert_eq!(load, Some(ratio(1, 3)));
    let tolerance = pick.tolerance.as_ref().expect("has one");
    assert_eq!(tolerance.relative_to, Scale::Actuator);
    assert_eq!(tolerance.of(2), Some(&ratio(1, 10)));
    assert_eq!(pick.scalar, Some(SceneScalar::F32));
    assert_eq!(pick.bounds.velocity.as_ref().map(Vec::len), Some(3));
    assert_eq!(pick.bounds.acceleration, None);
    let payloads = pick.bounds.payload.as_ref().expect("has a range");
    assert_eq!(payloads.mass, [ratio(0, 1), ratio(1, 3)]);
    assert_eq!(payloads.radius, ratio(1, 10));

    let angle = Position::Angle(Angle::PiTimes(ratio(1, 6)));
    assert_eq!(hold.locked(2), Some(&angle));
    assert_eq!(hold.rows(3), [1]);
    assert!(hold.acceleration_zero && hold.joints.is_none());

    for scene in &originals {
        let again = scenes(&write(scene)).remove(0);
        assert_eq!(*scene, again);
        assert_eq!(scene.short_hash(), again.short_hash());
    }
    let mut other = pick.clone();
    other.velocity_zero = false;
    assert_ne!(pick.short_hash(), other.short_hash());
}

const MISTAKES: &str = r#"
joints = [1, 4] | counted from 1 to 3
joints = ["wirst"] | did you mean `wrist`?
joints = [0] | there is no joint `0`
joints = [1, "waist"] | in the list already
joints = [] | at least one joint
lock = { 1 = 0 }\nbox = { position = [[1, 2], [0, 0.1], [0, 1]] } | is locked outside its
lock = { 9 = 0 } | there is no joint `9`
lock = { tree = 0 } | joints are counted from 1 to 3: waist, boom, wrist
lock = { 3 = 0, wrist = 0 } | joint 3 (wrist) is locked already
lock = { 3 = 2.5 } | locked outside its limits, -2 to 2
lock = { boom = "pi/2" } | expected a number
lock = { 1 = 0, 2 = 0, 3 = 0 } | every joint is locked
box = { position = [[1, 1], [0, 0.1], [0, 1]] } | the range is empty
box = { velocity = [1, -1, 1] } | the range is empty
box = { position = [[-1, 1], [0, 0.1], [5, 6]] } | joint 3 (wrist) is never in
box = { position = [[-1, 1], [0, 0.1], [5, 6]] } | is never in this range: its limits are -2 to 2
box = { position = [[-1, 1], [-2, -0.6], [0, 1]] } | joint 2 (boom) is never in
box = { position = [[-1, 1], [-2, -0.6], [0, 1]] } | this range: its limits are -0.5 to 0.5
box = { velocity = [1, 1] } | 2 entries, but the robot has 3 joints
box = { speed = [1, 1, 1] } | unknown key `speed`
box = { payload = { mass = [2, 1], radius = 0.1 } } | the range of its mass is empty or negative
box = { payload = { mass = [0, 1], radius = -0.1 } } | its radius is negative
box = { payload = { mass = [0, 1] } } | payload has no `radius`
box = { payload = { mass = 1, radius = 1 } } | expected an array of 2
tolerance = { value = 0, relative_to = "range" } | above zero
tolerance = { value = [1, 1], relative_to = "range" } | 2 tolerances
tolerance = { value = 1e-3 } | has no `relative_to`
tolerance = { value = 1, relative_to = "actuators" } | did you mean "actuator"?
outputs = ["gravty"] | did you mean "gravity"?
outputs = ["gravity", "gravity"] | in the list already
outputs = ["hold = gravty + jacobian"] | did you mean `gravity`?
outputs = ["gravity + jacobian"] | needs a name
outputs = ["a=gravity+inertia", "a=gravity+jacobian"] | `a` is in the list already
velocity = 0 | velocity = "zero" for an arm without any
acceleration = [1, 1, 1] | box = { acceleration = [1, …] }
lock = "wrist" | lock = { wrist = 0 }
lock = 3 | lock = { wrist = 0 }
box = { velocity = ["120deg", 1, 1] } | in rad/s, as a number: write 2.0944
outputs = ["hold = inertia + gravity", "servo = hold + jacobian"] | `hold` is a bundle itself: bundles do not nest: write its parts, inertia + gravity
payload = { mass = -1, com = [0, 0, 0] } | mass is negative
payload = { mass = 1 } | has no `com`
scalar = "f46" | did you mean "f64"?
locks = { 1 = 0 } | did you mean `lock`?
gravity = [0, 0] | an array of 3
tolerance = { value = "1%", relative_to = "range" } | 0.01 for 1%
tolerance = { value = [0.1, "a", 0.1], relative_to = "range" } | 0.01 for 1%
lock = { boom = "0.1m" } | write metres as a number
lock = { wrist = "0.1rad" } | write radians
payload = { mass = "1kg", com = [0, 0, 0] } | in SI units
"#;

#[test]
fn mistakes() {
    for [text, words] in rows(MISTAKES) {
        let errors = errors(&with(&text));
        let shown = only(&errors).to_string();
        assert!(shown.contains(&words), "{text}: {shown}");
        let line = ROBOT.lines().count() + 2;
        assert_eq!(errors[0].line(), Some(line), "{text}: {shown}");
    }
}

const ACTUATOR: &str = "tolerance = { value = 1e-3, relative_to = \"actuator\" }";
const RANGE: &str = "tolerance = { value = 1e-3, relative_to = \"range\" }";

#[test]
fn a_bound_needs_a_box() {
    let bare = replaced(&replaced(ROBOT, "velocity = 1, ", ""), ", torque = 5 ", " ");
    let with = |text: &str| bare.clone() + &scene(text);
    let diagnostics = errors(&with(ACTUATOR));
    assert_eq!(diagnostics.len(), 2, "{diagnostics:?}");
    let range = "the range of the velocity of joint 2 (boom)";
    has(&diagnostics[0], range, "");
    has(&diagnostics[1], "the torque limit of joint 3 (wrist)", "");
    for good in [
        format!("box = {{ velocity = [1, 1, 1] }}\n{RANGE}"),
        format!("velocity = \"zero\"\n{RANGE}"),
        format!("lock = {{ 2 = 0 }}\njoints = [1]\n{ACTUATOR}"),
        format!("outputs = [\"gravity\"]\n{RANGE}"),
    ] {
        assert_eq!(errors(&with(&good)), [], "{good}");
    }
}

#[test]
fn a_limit_of_zero() {
    let slow = "acceleration = 0, torque = 5 }";
    let still = replaced(ROBOT, "acceleration = 10, torque = 5 }", slow);
    let still = replaced(&still, "torque = 80", "torque = 0");
    let head = "[[joint]]\nname = \"boom\"";
    let elbow = "[[joint]]\nname = \"elbow\"\nkind = \"revolute\"\nmass = 0\n\
                 mimic = { joint = 1 }\nlimits = { torque = 7 }\n";
    let following = replaced(&still, head, &format!("{elbow}{head}"));
    let with = |text: &str| still.clone() + &scene(text);
    let inertia = format!("outputs = [\"inertia\"]\n{ACTUATOR}\n");
    let zero = "box = { acceleration = [0, 1, 1] }";
    let two = format!("{inertia}joints = [1, 3]");
    let boom = "the torque limit of joint 2 (boom) is 0";
    let waist = "the acceleration limit of joint 1 (waist) is 0";
    for (source, at, message) in [
        (with(ACTUATOR), "torque = 0", boom),
        (following + &scene(ACTUATOR), "torque = 0", "(boom) is 0"),
        (with(&two), "acceleration = 0", ""),
        (with(&format!("{two}\n{zero}")), zero, waist),
    ] {
        let errors = errors(&source);
        let line = 1 + source.lines().position(|line| line.contains(at)).unwrap();
        assert_eq!(only(&errors).line().unwrap(), line, "{source}");
        has(&errors[0], message, "");
    }
    for good in [
        format!("{inertia}joints = [1]"),
        format!("{ACTUATOR}\njoints = [1, 3]"),
        format!("{ACTUATOR}\nlock = {{ 2 = 0 }}\nbox = {{ velocity = [0, 0, 0] }}"),
        RANGE.to_owned(),
    ] {
        assert_eq!(errors(&with(&good)), [], "{good}");
    }
    let unread = self::with(ACTUATOR).replace("torque = 80", "torque = \"much\"");
    only(&errors(&unread));
}

/// A scene, and what is said of its box.
const BEYOND: &str = r#"
box = { position = [[-1, 1], [0, 0.1], [-2.5, 2]] } | limits of joint 3 (wrist), -2 to 2
box = { position = [[-1, 1], [-0.5, 0.75], [-2, 2]] } | limits of joint 2 (boom), -0.5 to 0.5
box = { velocity = [2.5, 1, 3] } | velocity limit of joint 1 (waist), 2
box = { acceleration = [10, 5, 11] } | acceleration limit of joint 3 (wrist), 10
box = { position = [["-pi", "pi"], [-0.5, 0.5], [-2, 2]], velocity = [2, 1, 3] } |
box = { velocity = [2, 1, 9] }\nlock = { 3 = 0 } |
"#;

#[test]
fn a_box_beyond_the_limits() {
    for [text, limit] in rows(BEYOND) {
        let notes = notes(&text, "the box of").into_iter();
        let warnings = notes.map(|(line, note)| (note.severity, line, note.message));
        let said = format!("the box of scene `a` goes beyond the {limit}");
        let expected = match limit.is_empty() {
            true => Vec::new(),
            false => vec![(Severity::Warning, 1, said)],
        };
        assert_eq!(warnings.collect::<Vec<_>>(), expected, "{text}");
    }
}

#[test]
fn a_tolerance_of_one_or_more() {
    for (value, said) in [("1", 1), ("5", 1), ("[0.1, 0.1, 2]", 1), ("0.999", 0)] {
        let tolerance = ACTUATOR.replace("1e-3", value);
        let text = format!("outputs = [\"gravity\"]\n{tolerance}");
        let notes = notes(&text, "a tolerance of 1 or more").into_iter();
        let warnings = notes.map(|(line, note)| (note.severity, line));
        let expected = vec![(Severity::Warning, 2); said];
        assert_eq!(warnings.collect::<Vec<_>>(), expected, "{value}");
    }
}

#[test]
fn a_payload_in_other_units() {
    let load = "payload = { mass = 2, com = [0, 0, 0.1], inertia = [4e4, 4e4, 4e4, 0, 0, 0] }";
    let mut notes = notes(load, "").into_iter();
    let warning = notes.find(|(_, note)| note.warning == Some(RobotWarning::LargeInertia));
    let (line, note) = warning.expect("a warning");
    assert_eq!(line, 1);
    has(&note, "", "write 0.04 for 40000");
}

#[test]
fn all_mistakes_of_all_scenes() {
    let bad = "joints = [7]\nlock = { 3 = 5 }\n[scene.B]\n\
        tolerance = { value = -1, relative_to = \"range\" }";
    let errors = errors(&with(bad));
    assert_eq!(errors.len(), 4, "{errors:?}");
}

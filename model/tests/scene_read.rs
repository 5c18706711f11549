//! Scenes of robot files: every key, and the text that says the same.

use dalembert_model::number::{Angle, Rational};
use dalembert_model::outputs::Function;
use dalembert_model::read::{Options, RobotWarning, parse};
use dalembert_model::robot::{Position, Severity};
use dalembert_model::scene::{Float, Scale, Scene, write};

use crate::read_errors::rows;

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
    let source = format!("{ROBOT}{text}");
    let reading = parse(&source, &Options::default());
    reading
        .unwrap_or_else(|errors| panic!("{}", errors.render("arm.toml", &source)))
        .scenes
}

fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

#[test]
fn every_key() {
    let scenes = scenes(
        r#"
[scene.pick]
outputs = ["inverse_dynamics", "gravity"]
joints = ["wrist", 1]
lock = { 2 = 0.25 }
gravity = [0, 0, 0]
velocity = "zero"
payload = { mass = 2.5, com = [0, 0, 0.05], inertia = [0.01, 0.01, 0.01, 0, 0, 0] }
box = { position = [[-1, 1], [0, 0.5], ["-pi/2", "90deg"]], velocity = [2, 1, 3] }
tolerance = { value = [1e-3, 1, 0.1], relative_to = "actuator" }
scalar = "f32"

[scene.hold]
lock = { wrist = "pi/6", waist = 1 }
acceleration = "zero"
"#,
    );
    let [pick, hold] = scenes.as_slice() else {
        panic!("{scenes:?}")
    };
    assert_eq!(pick.name, "pick");
    assert_eq!(pick.outputs, [Function::InverseDynamics, Function::Gravity]);
    assert_eq!(pick.joints.as_deref(), Some(&[2, 0][..]));
    assert_eq!(pick.lock, [(1, Position::Length(ratio(1, 4)))]);
    assert!(pick.gravity.is_some() && pick.velocity_zero && !pick.acceleration_zero);
    assert_eq!(
        pick.payload.as_ref().map(|p| p.mass.clone()),
        Some(ratio(5, 2))
    );
    let tolerance = pick.tolerance.as_ref().expect("has one");
    assert_eq!(tolerance.relative_to, Scale::Actuator);
    assert_eq!(tolerance.of(2), Some(&ratio(1, 10)));
    assert_eq!(pick.scalar, Some(Float::F32));
    assert_eq!(pick.bounds.velocity.as_ref().map(Vec::len), Some(3));
    assert_eq!(pick.bounds.acceleration, None);

    let angle = Position::Angle(Angle::PiTimes(ratio(1, 6)));
    assert_eq!(hold.locked(2), Some(&angle));
    assert_eq!(hold.rows(3), [1]);
    assert!(hold.acceleration_zero && hold.joints.is_none());
}

#[test]
fn what_is_written_is_read_back() {
    let text = r#"
[scene.pick]
outputs = ["gravity"]
joints = [3, 1]
lock = { 2 = "1/3" }
gravity = [0, 0, -1.62]
velocity = "zero"
payload = { mass = "1/3", com = [0, 0, 0.05] }
box = { position = [[-1, 1], [0, 0.5], ["-pi/2", 1]], acceleration = [2, 1, 3] }
tolerance = { value = 1e-3, relative_to = "range" }
scalar = "f64"
"#;
    let first = scenes(text).remove(0);
    let second = scenes(&write(&first)).remove(0);
    assert_eq!(first, second);
    assert_eq!(first.short_hash(), second.short_hash());
    let other = Scene {
        velocity_zero: false,
        ..first.clone()
    };
    assert_ne!(first.short_hash(), other.short_hash());
}

/// The payload and the last link are one body: the same total mass, centre of
/// mass, and inertia about any point.
#[test]
fn a_payload_is_part_of_the_last_link() {
    let source = format!(
        "{ROBOT}[scene.a]\npayload = {{ mass = 1.5, com = [0.1, 0.2, 0.4], inertia = [1, 2, 2, 0, 0, 0.5] }}\n"
    );
    let reading = parse(&source, &Options::default()).expect("reads");
    let (bare, loaded) = (&reading.robot, reading.scenes[0].apply(&reading.robot));
    assert_eq!(bare.joints[..2], loaded.joints[..2]);
    let (link, both) = (&bare.joints[2], &loaded.joints[2]);
    assert_eq!(both.mass, ratio(2, 1));
    // (0.5·(0.1, 0, 0) + 1.5·(0.1, 0.2, 0.4))/2
    assert_eq!(both.com, [ratio(1, 10), ratio(3, 20), ratio(3, 10)]);
    // Steiner by hand, about the origin of the frame.
    let about_origin = |mass: &Rational, com: &[Rational; 3], xx: &Rational, xz: &Rational| {
        let [x, y, z] = com;
        (xx + mass * (y * y + z * z), xz - mass * x * z)
    };
    let own = about_origin(&link.mass, &link.com, &link.inertia.xx, &link.inertia.xz);
    let com = [ratio(1, 10), ratio(1, 5), ratio(2, 5)];
    let load = about_origin(&ratio(3, 2), &com, &ratio(1, 1), &ratio(1, 2));
    let all = about_origin(&both.mass, &both.com, &both.inertia.xx, &both.inertia.xz);
    assert_eq!((own.0 + load.0, own.1 + load.1), all);
}

/// One mistake each, and words of the message or the help.
const MISTAKES: &str = r#"
joints = [1, 4] | counted from 1 to 3
joints = ["wirst"] | did you mean `wrist`?
joints = [0] | there is no joint `0`
joints = [1, "waist"] | in the list already
joints = [] | one joint at least
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
tolerance = { value = 0, relative_to = "range" } | above zero
tolerance = { value = [1, 1], relative_to = "range" } | 2 tolerances
tolerance = { value = 1e-3 } | has no `relative_to`
tolerance = { value = 1, relative_to = "actuators" } | did you mean "actuator"?
outputs = ["gravty"] | did you mean "gravity"?
outputs = ["gravity", "gravity"] | in the list already
outputs = ["hold = gravty + jacobian"] | did you mean `gravity`?
outputs = ["gravity + jacobian"] | has no name
outputs = ["a=gravity+inertia", "a=gravity+jacobian"] | `a` is in the list already
velocity = 0 | velocity = "zero" for an arm without any
acceleration = [1, 1, 1] | box = { acceleration = [1, …] }
lock = "wrist" | lock = { wrist = 0 }
lock = 3 | lock = { wrist = 0 }
box = { velocity = ["120deg", 1, 1] } | in rad/s, as a number: write 2.0944
outputs = ["hold = inertia + gravity", "servo = hold + jacobian"] | `hold` is a bundle itself (
outputs = ["hold = inertia + gravity", "servo = hold + jacobian"] | itself (bundles do not nest:
outputs = ["hold = inertia + gravity", "servo = hold + jacobian"] | nest: write its parts, inertia
outputs = ["hold = inertia + gravity", "servo = hold + jacobian"] | inertia + gravity)
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
        let text = text.replace("\\n", "\n");
        let source = format!("{ROBOT}[scene.bad]\n{text}\n");
        let errors = parse(&source, &Options::default()).expect_err(&text).0;
        assert_eq!(errors.len(), 1, "{text}: {errors:?}");
        let shown = errors[0].to_string();
        assert!(shown.contains(words), "{text}: {shown}");
        assert_eq!(errors[0].line, ROBOT.lines().count() + 2, "{text}: {shown}");
    }
}

#[test]
fn a_bound_needs_a_box() {
    let bare = ROBOT
        .replace("velocity = 1, ", "")
        .replace(", torque = 5 ", " ");
    let parse = |text: &str| parse(&format!("{bare}[scene.a]\n{text}"), &Options::default());
    let errors = parse("tolerance = { value = 1e-3, relative_to = \"actuator\" }\n").unwrap_err();
    let shown = errors.to_string();
    assert_eq!(errors.0.len(), 2, "{shown}");
    assert!(
        shown.contains("the range of the velocity of joint 2 (boom)"),
        "{shown}"
    );
    assert!(
        shown.contains("the torque limit of joint 3 (wrist)"),
        "{shown}"
    );
    for good in [
        "box = { velocity = [1, 1, 1] }\ntolerance = { value = 1e-3, relative_to = \"range\" }\n",
        "velocity = \"zero\"\ntolerance = { value = 1e-3, relative_to = \"range\" }\n",
        "lock = { 2 = 0 }\njoints = [1]\ntolerance = { value = 1e-3, relative_to = \"actuator\" }\n",
        "outputs = [\"gravity\"]\ntolerance = { value = 1e-3, relative_to = \"range\" }\n",
    ] {
        assert!(parse(good).is_ok(), "{good}");
    }
}

/// A limit of zero is one, but nothing can be relative to it: said where it
/// stands. To be at rest is a range.
#[test]
fn a_limit_of_zero() {
    let still = ROBOT.replace("torque = 80", "torque = 0").replace(
        "acceleration = 10, torque = 5 }",
        "acceleration = 0, torque = 5 }",
    );
    let read = |text: &str| {
        let source = format!("{still}[scene.a]\n{text}\n");
        parse(&source, &Options::default()).map_err(|errors| {
            let lines: Vec<usize> = errors.0.iter().map(|error| error.line).collect();
            (lines, errors.to_string())
        })
    };
    let actuator = "tolerance = { value = 1e-3, relative_to = \"actuator\" }";
    let line = |words: &str| 1 + still.lines().position(|l| l.contains(words)).unwrap();
    let (lines, shown) = read(actuator).unwrap_err();
    assert_eq!(lines, [line("torque = 0")], "{shown}");
    assert!(
        shown.contains("the torque limit of joint 2 (boom) is 0"),
        "{shown}"
    );
    // T of D divides by the acceleration, unless nothing of that joint is asked for.
    let inertia = format!("outputs = [\"inertia\"]\n{actuator}\n");
    let (lines, shown) = read(&format!("{inertia}joints = [1, 3]")).unwrap_err();
    assert_eq!(lines, [line("acceleration = 0")], "{shown}");
    let zero = "box = { acceleration = [0, 1, 1] }";
    let (lines, shown) = read(&format!("{inertia}joints = [1, 3]\n{zero}")).unwrap_err();
    assert_eq!(lines, [still.lines().count() + 5], "{shown}");
    assert!(
        shown.contains("the acceleration limit of joint 1 (waist) is 0"),
        "{shown}"
    );
    for good in [
        format!("{inertia}joints = [1]"),
        format!("{actuator}\njoints = [1, 3]"),
        format!("{actuator}\nlock = {{ 2 = 0 }}\nbox = {{ velocity = [0, 0, 0] }}"),
        "tolerance = { value = 1e-3, relative_to = \"range\" }".to_owned(),
    ] {
        assert!(read(&good).is_ok(), "{good}");
    }
    // A limit that could not be read is not zero.
    let unread = ROBOT.replace("torque = 80", "torque = \"much\"");
    let errors = parse(
        &format!("{unread}[scene.a]\n{actuator}\n"),
        &Options::default(),
    )
    .unwrap_err();
    assert_eq!(errors.0.len(), 1, "{errors}");
}

/// A limit is shown at its own row, also behind a row that follows another.
#[test]
fn a_limit_of_zero_behind_a_follower() {
    const BOOM: &str = "[[joint]]\nname = \"boom\"";
    let elbow = "[[joint]]\nname = \"elbow\"\nkind = \"revolute\"\nmass = 0\n\
                 mimic = { joint = 1 }\nlimits = { torque = 7 }\n";
    let robot = ROBOT.replace(BOOM, &format!("{elbow}{BOOM}"));
    let robot = robot.replace("torque = 80", "torque = 0");
    let scene = "[scene.a]\ntolerance = { value = 1e-3, relative_to = \"actuator\" }\n";
    let errors = parse(&format!("{robot}{scene}"), &Options::default()).unwrap_err();
    let line = 1 + robot
        .lines()
        .position(|l| l.contains("torque = 0"))
        .unwrap();
    assert_eq!((errors.0.len(), errors.0[0].line), (1, line), "{errors}");
}

/// A box may be larger than the limits, on purpose: a warning, and the scene as
/// it stands.
#[test]
fn a_box_beyond_the_limits() {
    let read = |text: &str| {
        let source = format!("{ROBOT}[scene.a]\n{text}\n");
        let reading = parse(&source, &Options::default());
        let reading = reading.unwrap_or_else(|errors| panic!("{text}: {errors}"));
        assert_eq!(reading.scenes.len(), 1);
        let notes = reading.notes.into_iter();
        // The robot has notes of its own.
        notes
            .filter(|note| note.message.starts_with("the box of"))
            .map(|note| (note.severity, note.line, note.message))
            .collect::<Vec<_>>()
    };
    let line = ROBOT.lines().count() + 2;
    for (text, words) in [
        (
            "box = { position = [[-1, 1], [0, 0.1], [-2.5, 2]] }",
            "the box of scene `a` goes beyond the limits of joint 3 (wrist), -2 to 2",
        ),
        (
            "box = { position = [[-1, 1], [-0.5, 0.75], [-2, 2]] }",
            "the box of scene `a` goes beyond the limits of joint 2 (boom), -0.5 to 0.5",
        ),
        (
            "box = { velocity = [2.5, 1, 3] }",
            "the box of scene `a` goes beyond the velocity limit of joint 1 (waist), 2",
        ),
        (
            "box = { acceleration = [10, 5, 11] }",
            "the box of scene `a` goes beyond the acceleration limit of joint 3 (wrist), 10",
        ),
    ] {
        let expected = (Severity::Warning, line, words.to_owned());
        assert_eq!(read(text), [expected], "{text}");
    }
    for inside in [
        "box = { position = [[\"-pi\", \"pi\"], [-0.5, 0.5], [-2, 2]], velocity = [2, 1, 3] }",
        // Of a locked joint the box says nothing.
        "box = { velocity = [2, 1, 9] }\nlock = { 3 = 0 }",
    ] {
        assert_eq!(read(inside), [], "{inside}");
    }
}

/// A tolerance of everything is probably meant in percent.
#[test]
fn a_tolerance_of_one_or_more() {
    let read = |value: &str| {
        let scene = format!("tolerance = {{ value = {value}, relative_to = \"actuator\" }}");
        let source = format!("{ROBOT}[scene.a]\noutputs = [\"gravity\"]\n{scene}\n");
        let reading = parse(&source, &Options::default());
        let reading = reading.unwrap_or_else(|errors| panic!("{value}: {errors}"));
        let notes = reading.notes.into_iter();
        let mut notes = notes.filter(|note| note.message.starts_with("a tolerance of 1 or more"));
        notes.next().map(|note| (note.severity, note.line))
    };
    let line = ROBOT.lines().count() + 3;
    for value in ["1", "5", "[0.1, 0.1, 2]"] {
        assert_eq!(read(value), Some((Severity::Warning, line)), "{value}");
    }
    assert_eq!(read("0.999"), None);
}

/// A payload's inertia in kg·mm² is far beyond the arm.
#[test]
fn a_payload_in_other_units() {
    let scene = "payload = { mass = 2, com = [0, 0, 0.1], inertia = [4e4, 4e4, 4e4, 0, 0, 0] }";
    let source = format!("{ROBOT}[scene.a]\n{scene}\n");
    let notes = parse(&source, &Options::default()).unwrap().notes;
    let note = notes
        .iter()
        .find(|note| note.warning == Some(RobotWarning::LargeInertia));
    let note = note.expect("a warning");
    assert_eq!(note.line, ROBOT.lines().count() + 2);
    let help = note.help.as_deref().unwrap_or_default();
    assert!(help.contains("write 0.04 for 40000"), "{help}");
}

/// Everything at once.
#[test]
fn all_mistakes_of_all_scenes() {
    let source = format!(
        "{ROBOT}[scene.a]\njoints = [7]\nlock = {{ 3 = 5 }}\n[scene.B]\ntolerance = {{ value = -1, relative_to = \"range\" }}\n"
    );
    let errors = parse(&source, &Options::default()).unwrap_err().0;
    assert_eq!(errors.len(), 4, "{errors:?}");
}

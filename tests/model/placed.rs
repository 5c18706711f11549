//! Joints by placements: the same arm as by its DH rows, whatever the frames;
//! and the same torques and poses as a recursion that knows nothing of DH.

use crate::placed_support::{Arm, Drawn, compare, file};
use crate::support::{data, generated, has, only, reading, replaced, rows, said, written};
use dalembert_model::number::{Angle, Rounded};
use dalembert_model::robot::Robot;

#[test]
fn the_same_arm_is_the_same_robot() {
    for (placed, rows) in [
        ("puma560_placed.toml", generated("puma560")),
        ("scara_placed.toml", data("scara.toml")),
    ] {
        let (mut placed, rows) = (reading(&data(placed)).robot, reading(&rows).robot);
        // Poses of links are of the frames that the file has, which no torque depends on.
        for joint in &mut placed.joints {
            joint.frame = None;
        }
        assert_eq!(placed, rows);
        assert_eq!(placed.short_hash(), rows.short_hash());
    }
}

fn check(arm: &Arm, drawn: &mut Drawn, what: &str) -> Robot {
    let text = file(arm);
    let robot = reading(&text).robot;
    let worst = compare(arm, &robot, drawn);
    assert!(worst < 1e-12, "{what}: {worst:e}\n{text}");
    robot
}

#[test]
fn torques_and_poses_are_those_of_the_frames() {
    for seed in 0..60 {
        let mut drawn = Drawn::new(seed);
        let arm = drawn.arm(1 + seed as usize % 7);
        let robot = check(&arm, &mut drawn, &format!("seed {seed}"));
        assert!(written(&robot).contains("convention = \"standard\""));
    }
}

#[test]
fn payloads_move_with_the_frame() {
    for seed in 0..8 {
        let mut drawn = Drawn::new(seed);
        let mut arm = drawn.arm(3);
        let body =
            "{ mass = 2.5, com = [0.1, -0.2, 0.05], inertia = [0.02, 0.03, 0.04, 0.001, 0, 0] }";
        let text = format!("{}\n[scene.pick]\npayload = {body}\n", file(&arm));
        let reading = reading(&text);
        let robot = reading.scenes[0].apply(&reading.robot);
        arm.payload();
        let worst = compare(&arm, &robot, &mut drawn);
        assert!(worst < 1e-12, "seed {seed}: {worst:e}");
    }
}

/// The axes are 0.4 m apart, the second tilted towards the first in the plane of both, or across.
fn tilted(radians: &str, about: usize) -> Robot {
    let mut rpy = ["0", "0", "0"];
    rpy[about] = radians;
    let rpy = rpy.join(", ");
    let body = "axis = [0, 0, 1]\nmass = 2\ncom = [0.2, 0.01, 0.03]\n\
                inertia = [0.02, 0.03, 0.04, 0, 0, 0]\nkind = \"revolute\"\n";
    let placed = |xyz: &str, rpy: &str| {
        format!("[[joint]]\nplacement = {{ xyz = {xyz}, rpy = [{rpy}] }}\n{body}")
    };
    let text = format!(
        "name = \"tilted\"\ngravity = [0, 0.5, -9.81]\n{}{}{}",
        placed("[0, 0, 0.3]", "0, 0, 0"),
        placed("[0.4, 0, 0.1]", &rpy),
        placed("[0.3, 0.1, 0.05]", "0.4, 0.2, 0.1"),
    );
    reading(&text).robot
}

#[test]
fn nearly_parallel_axes_stay_near() {
    let largest = |robot: &Robot| {
        let lengths = robot.joints.iter().flat_map(|joint| [&joint.a, &joint.d]);
        let sizes = lengths.map(|x| f64::nearest_rational(x).abs());
        sizes.fold(0.0, f64::max)
    };
    for radians in "1e-2 1e-3 1e-4 1e-8 1e-16 1e-30 -1e-3 -1e-12".split(' ') {
        for about in [0, 1] {
            let robot = tilted(radians, about);
            assert!(!robot.joints[0].beta.is_zero() || about == 0);
            let length = largest(&robot);
            assert!(length < 0.6, "{radians}: {length} m");
            let apart = f64::nearest_rational(&robot.joints[0].a);
            assert!((apart - 0.4).abs() < 0.002, "{apart}");
        }
    }
    // Beyond 1/64 the common normal is taken, at most 64 times as far away as the axes are apart.
    let robot = tilted("0.016", 1);
    assert!(robot.joints[0].beta.is_zero());
    let far = largest(&robot);
    assert!((20.0..30.0).contains(&far), "{far} m");
    let robot = tilted("1e-60", 1);
    assert_eq!(robot.joints[0].alpha, Angle::default());
    assert!(robot.joints[0].beta.is_zero());
}

#[test]
fn nearly_parallel_axes_have_the_torques_of_the_frames() {
    for exponent in 0..20 {
        let mut drawn = Drawn::new(900 + exponent);
        let arm = drawn.nearly_parallel(5, 0.03 * 10f64.powi(-(exponent as i32)));
        check(&arm, &mut drawn, &format!("1e-{exponent}"));
    }
}

/// Words of a file, those in their place, the line, and words of message and help.
const MISTAKES: &str = r#"
axis = [0, 0, 1] | | 6 | has no `axis` | axis = [0, 0, 1]
axis = [0, 0, 1] | axis = [0, 0, 0] | 9 | no direction | axis = [0, 0, 1]
mass | alpha = 1\nmass | 10 | `alpha` of a joint that is placed | the one or the other
mass | offset = 0\nmass | 10 | `offset` of a joint that is placed | leave
PLACED\naxis = [0, 0, 1] | a = 1 | 6 | joint 1 is not placed | give all joints
gravity | convention = "modified"\ngravity | 4 | rows of the standard | leave `convention` out
xyz = [0, 0, 0.387] | xyz = [0, 0, 387] | 8 | xyz is 387 m | millimetres, write 0.387
rpy = [0, 0, "pi/2"] | rpy = [0, 0, 90] | 8 | rpy is 90 rad | "90deg"
xyz = [0, 0, 0.387] | xzy = [0, 0, 0.387] | 8 | unknown key `xzy` | did you mean `xyz`?
"#;

#[test]
fn errors_say_where_and_what() {
    let placed = data("scara_placed.toml");
    let first = "placement = { xyz = [0, 0, 0.387], rpy = [0, 0, \"pi/2\"] }";
    for [from, to, line, message, help] in rows(MISTAKES) {
        let diagnostics = said(&replaced(&placed, &from.replace("PLACED", first), &to));
        let known = diagnostics.iter().find(|d| d.message.contains(&message));
        let diagnostic = known.unwrap_or_else(|| panic!("{to}: nothing says {message}"));
        assert_eq!(diagnostic.line().unwrap().to_string(), line, "{to}");
        has(diagnostic, &message, &help);
    }
    let far = placed.replace("xyz = [0, 0, 0.387]", "xyz = [0, 0, 387]");
    only(&reading(&far).notes);
    let said = placed.replacen("gravity", "convention = \"standard\"\ngravity", 1);
    assert_eq!(reading(&said).robot, reading(&placed).robot);
}

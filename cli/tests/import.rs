//! `dalembert import`: the robot file of a URDF, and what is said about it.

use std::fs;

use crate::support::{run, temporary};

fn urdf(name: &str) -> String {
    format!(
        "{}/../import/tests/data/{name}.urdf",
        env!("CARGO_MANIFEST_DIR")
    )
}

#[test]
fn a_chain_becomes_a_robot_file_that_counts() {
    let folder = temporary("import");
    let file = folder.join("ur5.toml");
    let name = file.to_str().unwrap();
    let ran = run(&["import", &urdf("ur5"), "--tip", "tool0", "-o", name]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.is_empty());
    let text = fs::read_to_string(&file).unwrap();
    assert!(
        text.starts_with("# From link world to link tool0 of ur5.urdf"),
        "{text}"
    );
    for part in [
        "ur5.urdf:",
        "is taken for pi/2",
        "the torques change by: ≤ ",
        "of the effort limits",
        "wrist_3_joint: ≤ ",
        "--exact takes every digit as it stands",
    ] {
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
    // To standard output the same bytes.
    let again = run(&["import", &urdf("ur5"), "--tip", "tool0"]);
    assert_eq!((again.code, again.out == text), (0, true));
    // Snapped, the structure is back: this arm is the UR10's size in operations.
    let counted = run(&["count", name, "--outputs", "gravity"]);
    assert_eq!(counted.code, 0, "{}", counted.err);
    assert!(counted.out.contains("gravity"), "{}", counted.out);
}

/// A limit that was rounded moves nothing: that is said once, without a line of zeros
/// for every joint.
#[test]
fn what_changes_nothing_is_one_line() {
    let folder = temporary("import_nothing");
    let file = folder.join("arm.urdf");
    let link = |name: &str| {
        format!(
            "<link name=\"{name}\"><inertial><mass value=\"1\"/><inertia ixx=\"0.1\" iyy=\"0.1\" \
             izz=\"0.1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
        )
    };
    let text = format!(
        "<robot name=\"arm\">{}{}<joint name=\"turn\" type=\"revolute\"><parent link=\"foot\"/>\
         <child link=\"upper\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1.5707963\" \
         upper=\"1.5707963\" effort=\"5\" velocity=\"1\"/></joint></robot>",
        link("foot"),
        link("upper")
    );
    fs::write(&file, text).unwrap();
    let ran = run(&["import", file.to_str().unwrap()]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.err.contains("torques change by: nothing"),
        "{}",
        ran.err
    );
    assert!(!ran.err.contains("≤ 0"), "{}", ran.err);
}

#[test]
fn refusals_are_bad_input() {
    let folder = temporary("import_refused");
    let output = folder.join("panda.toml");
    let output = output.to_str().unwrap();
    let panda = urdf("panda");
    for (arguments, part) in [
        (
            &["--tip", "panda_hand_tcp"][..],
            "add --lock panda_finger_joint1=0, or leave its link away: --without panda_leftfinger",
        ),
        (&["--tip", "nowhere"], "--tip: there is no link `nowhere`"),
        (&["--lock", "panda_joint1"], "a joint and its position"),
        (&[], "choose the end by --tip"),
    ] {
        let ran = run(&[&["import", &panda, "-o", output], arguments].concat());
        assert_eq!(ran.code, 2, "{}", ran.err);
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
        assert!(!fs::exists(output).unwrap());
    }
    let over = folder.join("arm.urdf");
    fs::copy(&panda, &over).unwrap();
    let over = over.to_str().unwrap();
    let ran = run(&["import", over, "-o", over, "--tip", "panda_link8"]);
    assert_eq!(ran.code, 2);
    assert!(
        ran.err.contains("would be written over the URDF"),
        "{}",
        ran.err
    );
    fs::write(over, b"\xff\xfe").unwrap();
    assert!(run(&["import", over]).err.contains("is not UTF-8 text"));
    // The way out that was named is one.
    let ran = run(&[
        "import",
        &panda,
        "--tip",
        "panda_hand_tcp",
        "--lock",
        "panda_finger_joint1=0",
        "--without",
        "panda_rightfinger",
        "-o",
        output,
    ]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(fs::exists(output).unwrap());
    let file = |options: &[&str]| {
        let ran = run(&[&["import", &panda, "--tip", "panda_hand"], options].concat());
        assert_eq!(ran.code, 0, "{}", ran.err);
        assert!(
            ran.err.contains("is held: `panda_finger_joint1` at 0"),
            "{}",
            ran.err
        );
        ran.out
    };
    assert_eq!(file(&["--lock-others", "0"]), file(&["--lock", "*=0"]));
}

//! `dalembert import`: the robot file of a URDF, and what is said about it.

use std::fs;

use crate::support::{good, run, temporary};

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
    let ran = good(&["import", &urdf("ur5"), "--tip", "tool0", "-o", name]);
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
    let counted = good(&["count", name, "--outputs", "gravity"]);
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
    let ran = good(&["import", file.to_str().unwrap()]);
    ran.says(&["torques change by: nothing"]);
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
    ran.says(&["would be written over the URDF"]);
    fs::write(over, b"\xff\xfe").unwrap();
    assert!(run(&["import", over]).err.contains("is not UTF-8 text"));
    // The way out that was named is one.
    good(&[
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
    assert!(fs::exists(output).unwrap());
    let file = |options: &[&str]| {
        let ran = good(&[&["import", &panda, "--tip", "panda_hand"], options].concat());
        ran.says(&["is held: `panda_finger_joint1` at 0"]);
        ran.out
    };
    assert_eq!(file(&["--lock-others", "0"]), file(&["--lock", "*=0"]));
}

/// Every arm of a robot, each in a file of its own, all or none.
#[test]
fn all_arms_of_a_robot() {
    let folder = temporary("import_all");
    let arms = folder.join("arms");
    let name = arms.to_str().unwrap();
    let gallery = concat!(env!("CARGO_MANIFEST_DIR"), "/../gallery/urdf/baxter.urdf");
    let ran = good(&["import", gallery, "--all", "-o", name]);
    for side in ["left", "right"] {
        let file = arms.join(format!("baxter_{side}_gripper_base_link.toml"));
        good(&["count", file.to_str().unwrap(), "--outputs", "gravity"]);
    }
    assert_eq!(fs::read_dir(&arms).unwrap().count(), 2);
    assert!(!ran.err.contains("move each other"), "{}", ran.err);
    // Two arms on a torso that turns.
    let link = |name: &str, on: &str| {
        format!(
            "<joint name='j_{name}' type='continuous'><parent link='{on}'/><child link='{name}'/>\
             <axis xyz='1 0 0'/></joint><link name='{name}'><inertial><mass value='1'/>\
             <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
        )
    };
    let chain = [
        "torso base",
        "l1 torso",
        "l2 l1",
        "l3 l2",
        "r1 torso",
        "r2 r1",
        "r3 r2",
        "head torso",
    ];
    let links = chain.iter().filter_map(|pair| pair.split_once(' '));
    let links: String = links.map(|(name, on)| link(name, on)).collect();
    let robot = |links: &str| format!("<robot name='two'><link name='base'/>{links}</robot>");
    let urdf = folder.join("two.urdf");
    fs::write(&urdf, robot(&links)).unwrap();
    let both = folder.join("both");
    let arguments = [
        "import",
        urdf.to_str().unwrap(),
        "--all",
        "-o",
        both.to_str().unwrap(),
    ];
    let ran = good(&arguments);
    let said = "two_l3 and two_r3 move each other through j_torso";
    ran.says(&[said]);
    let left = fs::read_to_string(both.join("two_l3.toml")).unwrap();
    assert!(
        left.contains("name = \"two_l3\"") && left.contains("# Held: j_r1 = 0"),
        "{left}"
    );
    let json = run(&[&arguments[..], &["--json"]].concat());
    assert!(json.out.contains("\"shared\""), "{}", json.out);
    // Somebody else's file stays, and nothing is written beside it.
    fs::remove_file(both.join("two_r3.toml")).unwrap();
    fs::write(both.join("two_l3.toml"), "mine").unwrap();
    let ran = run(&arguments);
    ran.says(&["dalembert did not write it"]);
    assert!(!both.join("two_r3.toml").exists());
    // An arm that cannot be read leaves none.
    fs::write(
        &urdf,
        robot(&links.replacen("mass value='1'", "mass value='-1'", 1)),
    )
    .unwrap();
    let none = folder.join("none");
    let ran = run(&[
        "import",
        urdf.to_str().unwrap(),
        "--all",
        "-o",
        none.to_str().unwrap(),
    ]);
    assert_eq!((ran.code, none.exists()), (2, false), "{}", ran.err);
}

/// A xacro is expanded by the program of that name, whatever that does.
#[cfg(unix)]
#[test]
fn xacros_are_expanded_by_xacro() {
    use std::os::unix::fs::PermissionsExt;
    use std::process::Command;

    let folder = temporary("import_xacro");
    let file = folder.join("ur5.urdf.xacro");
    fs::write(&file, "<robot/>").unwrap();
    let program = folder.join("xacro");
    let import = |body: &str, more: &[&str]| {
        fs::write(&program, format!("#!/bin/sh\n{body}\n")).unwrap();
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
        let path = format!("{}:/usr/bin:/bin", folder.display());
        let ran = Command::new(env!("CARGO_BIN_EXE_dalembert"))
            .args(["import", file.to_str().unwrap(), "--tip", "tool0"])
            .args(more)
            .env("PATH", path)
            .output()
            .unwrap();
        let [out, err] = [ran.stdout, ran.stderr].map(|text| String::from_utf8(text).unwrap());
        (ran.status.code().unwrap(), out, err)
    };
    let cat = format!("echo \"saw $2\" >&2; cat {}", urdf("ur5"));
    let (code, out, err) = import(&cat, &["--", "name:=x"]);
    assert_eq!(code, 0, "{err}");
    assert!(
        out.starts_with("# From link world to link tool0 of ur5.urdf.xacro"),
        "{out}"
    );
    assert!(
        err.contains("saw name:=x") && err.contains("ur5.urdf.xacro, expanded:"),
        "{err}"
    );
    for (body, says) in [
        (
            "echo 'no macro arm' >&2; exit 3",
            "no macro arm\nerror: `xacro` ended with exit status: 3",
        ),
        ("yes", "made more than 16 MiB"),
        (
            "head -c 1000000 /dev/zero >&2; yes",
            "made more than 16 MiB",
        ),
        ("echo no", "no XML"),
        ("printf '\\377'", "is not UTF-8 text"),
    ] {
        let (code, out, err) = import(body, &[]);
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(says), "{says}: {err}");
    }
    fs::remove_file(&program).unwrap();
    let ran = Command::new(env!("CARGO_BIN_EXE_dalembert"))
        .args(["import", file.to_str().unwrap()])
        .env("PATH", &folder)
        .output()
        .unwrap();
    let err = String::from_utf8(ran.stderr).unwrap();
    assert!(
        err.contains("not on PATH") && err.contains("pip install xacro"),
        "{err}"
    );
    let ran = run(&["import", &urdf("ur5"), "--", "a:=1"]);
    ran.says(&["is an argument for a xacro"]);
}

/// An MJCF with what it includes; what is wrong there is said of that file.
#[test]
fn an_mjcf_with_its_includes() {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../import/tests/data/mjcf");
    let folder = temporary("import_mjcf");
    let output = folder.join("features.toml");
    let model = format!("{data}/features.xml");
    let arguments = [
        "import",
        &model,
        "--tip",
        "tool",
        "--lock-others",
        "0",
        "-o",
    ];
    let ran = good(&[&arguments[..], &[output.to_str().unwrap()]].concat());
    ran.says(&["features_defaults.xml:"]);
    let text = fs::read_to_string(&output).unwrap();
    assert!(
        text.contains("features_defaults.xml, line 12: joint to tool"),
        "{text}"
    );
    // Without the file that it includes.
    let alone = folder.join("features.xml");
    fs::copy(&model, &alone).unwrap();
    let ran = run(&["import", alone.to_str().unwrap()]);
    assert_eq!(ran.code, 2);
    ran.says(&["`features_defaults.xml` cannot be read"]);
}

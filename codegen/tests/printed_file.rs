//! Generated files as modules of somebody's crate: the formatter leaves them alone, the compiler and the documentation have
//! nothing to warn of, whatever the joints are called and whatever is called.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use dalembert_codegen::{Function, Request, SinCos, generate};
use dalembert_model::robot::Robot;

use crate::support;

/// Joints named as nobody should, and one that turns without end.
fn robot() -> Robot {
    let mut robot = support::robot("planar3r");
    let names = ["`a` | <b>", "[N](http://x.y) \\ *_&lt;", "~~wrist~~ #1"];
    for (joint, name) in robot.joints.iter_mut().zip(names) {
        joint.name = Some(name.to_owned());
    }
    robot.joints[2].limits.position = None;
    assert!(robot.validate().is_empty());
    robot
}

/// Arrays, structs and blocks of polynomials.
fn texts() -> Vec<String> {
    let request = Request {
        sincos: SinCos::Polynomial { error: Some(1e-4) },
        ..Request::of(&[Function::InverseDynamics, Function::DynamicCoefficients])
    };
    generate(&robot(), &request).unwrap().texts
}

/// Returns a crate that has the files as modules and calls none of their dynamics.
fn files() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("printed_file");
    fs::create_dir_all(&folder).unwrap();
    for (name, text) in ["arm.rs", "arm_f32.rs"].iter().zip(texts()) {
        assert!(text.contains("\npub const N: usize = 3;\n") && !text.contains("pub mod"));
        fs::write(folder.join(name), text).unwrap();
    }
    let main = "//! A program.\n\n/// Its module.\npub mod arm;\nmod arm_f32;\n\nfn main() {\n    \
                assert!(arm::in_box(&[0.5, -0.5, 700.0]));\n    \
                assert!(!arm::in_box(&[0.5, 3.5, 0.0]));\n    \
                assert!(!arm::in_box(&[f64::NAN, 0.0, 0.0]));\n    \
                let high = arm_f32::BOX.q[0][1];\n    \
                assert!(arm_f32::in_box(&[high, 0.0, 0.0]));\n    \
                assert!(!arm_f32::in_box(&[high.next_up(), 0.0, 0.0]));\n}\n";
    fs::write(folder.join("main.rs"), main).unwrap();
    folder
}

fn run(program: &str, arguments: &[&str], folder: &Path) {
    let output = Command::new(program)
        .args(["--edition", "2024"])
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    let said = [output.stderr, output.stdout].concat();
    let said = String::from_utf8_lossy(&said);
    assert!(output.status.success(), "{program}:\n{said}");
    assert!(said.is_empty(), "{program}:\n{said}");
}

#[test]
fn nobody_has_anything_to_say() {
    let folder = files();
    run("rustfmt", &["--check", "main.rs"], &folder);
    let strict = [
        "-Dwarnings",
        "-Dmissing_docs",
        "-Dunreachable_pub",
        "main.rs",
    ];
    run("rustc", &strict, &folder);
    run(
        "rustdoc",
        &["-Dwarnings", "--document-private-items", "main.rs"],
        &folder,
    );
    let ran = Command::new(folder.join("main")).status().unwrap();
    assert!(ran.success(), "`in_box`");
}

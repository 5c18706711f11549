//! A generated file in somebody's crate, both as modules and as the contents of
//! one: the formatter leaves it alone, the compiler and the documentation have
//! nothing to warn of, whatever the joints are called and whatever is called.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::generate;
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_codegen::workspace::task::Layout;
use dalembert_codegen::workspace::task::Request;
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
fn text(layout: Layout, scalars: &[ScalarType]) -> String {
    let request = Request {
        scalars: scalars.to_vec(),
        sincos: SinCos::Polynomial { error: Some(1e-4) },
        module: Some("arm".into()),
        layout,
        ..Request::of(&[Function::InverseDynamics, Function::DynamicCoefficients])
    };
    generate(&robot(), &request).unwrap().text
}

/// Returns a crate that has the file in both ways and calls none of it.
fn files() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("printed_file");
    fs::create_dir_all(&folder).unwrap();
    let modules = text(Layout::Modules, &ScalarType::ALL);
    let contents = text(Layout::Contents, &[ScalarType::F64]);
    assert!(contents.contains("\npub const N: usize = 3;\n") && !contents.contains("pub mod"));
    fs::write(folder.join("modules.rs"), modules).unwrap();
    fs::write(folder.join("contents.rs"), contents).unwrap();
    let main = "//! A program.\n\n/// Its module.\npub mod contents;\nmod modules;\n\nfn main() {\n    \
                assert!(contents::in_box(&[0.5, -0.5, 700.0]));\n    \
                assert!(!contents::in_box(&[0.5, 3.5, 0.0]));\n    \
                assert!(!contents::in_box(&[f64::NAN, 0.0, 0.0]));\n    \
                let high = modules::arm_f32::BOX.q[0][1];\n    \
                assert!(modules::arm_f32::in_box(&[high, 0.0, 0.0]));\n    \
                assert!(!modules::arm_f32::in_box(&[high.next_up(), 0.0, 0.0]));\n}\n";
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

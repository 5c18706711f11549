//! `dalembert new`: the crate that it makes builds, passes and prints torques.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::{good, robot, run, temporary};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Built as a user would build it, outside this workspace and its target directory: with
/// the checkout that the command comes from, since no registry has this version.
#[test]
fn it_builds_and_passes_at_once() {
    let folder = temporary("new").join("my-arm");
    let name = folder.to_str().unwrap();
    good(&["new", name]);
    // The versions that everything else here is tested with.
    fs::copy(format!("{ROOT}/Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    // One for all crates that tests build.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("crates");
    let cargo = |argument: &str| {
        let output = Command::new(env!("CARGO"))
            .args([argument, "--offline"])
            .current_dir(&folder)
            .env("CARGO_TARGET_DIR", &target)
            // What this test was built with is none of its.
            .env_remove("RUSTFLAGS")
            .env_remove("CARGO_ENCODED_RUSTFLAGS")
            .env_remove("RUSTC_WORKSPACE_WRAPPER")
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{argument}:\n{errors}");
        assert!(!errors.contains("warning"), "{errors}");
        String::from_utf8(output.stdout).unwrap()
    };
    let tested = cargo("test");
    assert!(
        tested.contains("the_code_agrees_with_the_recursion ... ok"),
        "{tested}"
    );
    let printed = cargo("run");
    assert!(
        printed.contains("to hold still at q = [0.1, 0.1]: [19.4"),
        "{printed}"
    );
}

#[test]
fn from_robot_files_and_urdfs() {
    let folder = temporary("new_from");
    let made = |name: &str| folder.join(name);
    let text = |name: &str| made(name).to_str().unwrap().to_owned();
    good(&["new", &text("puma"), "--from", &robot("puma560")]);
    let source = fs::read_to_string(made("puma").join("src/main.rs")).unwrap();
    assert!(source.contains("pub mod puma560 = \"robots/puma560.toml\";"));
    assert!(source.contains("[0.1; 6]") && !source.contains("JOINTS"));
    let manifest = fs::read_to_string(made("puma").join("Cargo.toml")).unwrap();
    let checkout = fs::canonicalize(ROOT).unwrap();
    let own = format!(
        "dalembert = {{ path = {:?}, default-features = false, features = [\"macros\", \"sines\"] }}",
        checkout.to_str().unwrap()
    );
    assert!(manifest.contains("name = \"puma\"") && manifest.contains(&own));
    let named = [
        "new",
        &text("named"),
        "--path",
        ROOT,
        "--from",
        &robot("puma560"),
    ];
    assert_eq!(run(&named).code, 0);
    let named = fs::read_to_string(made("named").join("Cargo.toml")).unwrap();
    assert!(named.contains(&own), "{named}");

    let urdf = format!("{ROOT}/import/tests/data/twodofs.urdf");
    good(&["new", &text("two"), "--from", &urdf]);
    let robots = fs::read_dir(made("two").join("robots")).unwrap().count();
    assert_eq!(robots, 2);

    let panda = format!("{ROOT}/import/tests/data/panda.urdf");
    for (arguments, part) in [
        (vec![text("puma")], "is there already"),
        (vec![text("My-Arm")], "write \"my_arm\""),
        (vec![text("fn")], "write \"fn_robot\""),
        (
            vec![text("dalembert")],
            "depends on the crate `dalembert`: write \"my_dalembert\"",
        ),
        (
            vec![text("hand"), "--from".into(), panda.clone()],
            "choose the end by --tip: panda_hand, panda_hand_tcp; --lock-others 0",
        ),
        (
            vec![
                text("hand"),
                "--from".into(),
                robot("puma560"),
                "--tip".into(),
                "hand".into(),
            ],
            "has one chain",
        ),
        (
            vec![text("hand"), "--lock-others".into(), "0".into()],
            "has one chain",
        ),
        (
            vec![text("far"), "--path".into(), text("nowhere")],
            "there is no dalembert in",
        ),
        (
            vec![text("lost"), "--from".into(), text("lost.toml")],
            "there is no file `",
        ),
    ] {
        let arguments: Vec<&str> = ["new"]
            .into_iter()
            .chain(arguments.iter().map(String::as_str))
            .collect();
        let ran = run(&arguments);
        assert_eq!(ran.code, 2, "{}", ran.err);
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
    // Nothing is left of what was refused.
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 3);
    // What the errors say works.
    let hand = text("hand");
    good(&[
        "new",
        &hand,
        "--from",
        &panda,
        "--tip",
        "panda_hand",
        "--lock-others",
        "0",
    ]);
    let source = fs::read_to_string(made("hand").join("src/main.rs")).unwrap();
    assert!(source.contains("[0.1; 7]"), "{source}");
}

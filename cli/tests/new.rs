//! `dalembert new`: the crate that it makes builds, passes and prints torques.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::{good, temporary};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Builds the crate as a user would, outside this workspace and its target directory, with
/// the checkout that the command comes from, since no registry has this version.
#[test]
fn it_builds_and_passes_at_once() {
    let folder = temporary("new").join("my-arm");
    let name = folder.to_str().unwrap();
    good(&["new", name]);
    // The versions of the dependencies that the workspace is tested with.
    fs::copy(format!("{ROOT}/Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    // One target directory for all crates that tests build.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("crates");
    let cargo = |argument: &str| {
        let output = Command::new(env!("CARGO"))
            .args([argument, "--offline"])
            .current_dir(&folder)
            .env("CARGO_TARGET_DIR", &target)
            // The build flags of this test are not for the new crate.
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

//! The example crates that are workspaces of their own: built as a user would
//! build them, outside this workspace's target directory, and run.
//!
//! The others are members, and have tests themselves.

use std::path::Path;
use std::process::{Command, Output};
use std::time::Instant;

fn cargo(arguments: &[&str], example: &str) -> Output {
    // One for all crates that tests build: the generator is compiled once for them.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("crates");
    let folder = Path::new("examples").join(example);
    // The versions that everything else here is tested with.
    std::fs::copy("Cargo.lock", folder.join("Cargo.lock")).unwrap();
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .arg("--offline")
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", target)
        // What this test was built with is none of theirs.
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{example}:\n{errors}");
    output
}

/// No std, no allocator, `panic = "abort"`, f32; its entry is that of the C
/// library on Linux.
#[cfg(target_os = "linux")]
#[test]
fn bare_metal() {
    cargo(&["run"], "bare_metal");
}

/// Prints what the macro costs in a crate with cargo's defaults; nothing is asserted, since
/// time is no property of the code. Its profile is another than that of `bare_metal`, so that
/// all is compiled anew for it.
#[test]
#[ignore = "compiles the generator once more: a step of `.ci/run`"]
fn debug_cost() {
    let start = Instant::now();
    cargo(&["build"], "debug_cost");
    println!("all that there was to build: {:.1?}", start.elapsed());

    let main = Path::new("examples/debug_cost/src/main.rs");
    let now = std::fs::File::options().append(true).open(main).unwrap();
    now.set_modified(std::time::SystemTime::now()).unwrap();
    let start = Instant::now();
    let output = cargo(&["run"], "debug_cost");
    println!("of that the crate with the macro: {:.1?}", start.elapsed());
    assert!(String::from_utf8_lossy(&output.stdout).starts_with('['));
}

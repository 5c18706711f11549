//! The example crate that is a workspace of its own: built as a user would build it, outside
//! this workspace's target directory, and run.

use std::path::Path;
use std::process::Command;

/// No std, no allocator, `panic = "abort"`, f32; its entry is that of the C library on Linux.
#[cfg(target_os = "linux")]
#[test]
fn bare_metal() {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("crates");
    let folder = Path::new("examples/bare_metal");
    // The versions that everything else here is tested with.
    std::fs::copy("Cargo.lock", folder.join("Cargo.lock")).unwrap();
    let output = Command::new(env!("CARGO"))
        .args(["run", "--offline"])
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", target)
        // What this test was built with is none of theirs.
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .env_remove("RUSTC_WORKSPACE_WRAPPER")
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
}

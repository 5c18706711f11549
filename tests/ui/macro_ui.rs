//! What the compiler says to common mistakes in `dynamics!`, word for word,
//! and invocations that are right.
//!
//! `TRYBUILD=overwrite` writes what is said now beside the cases.

use std::fs;
use std::path::Path;

/// The cases are compiled as a crate in the target directory, and robot files
/// are relative to that.
fn provide_robots() -> std::io::Result<()> {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("..");
    let folder = target.join("tests/trybuild/dalembert-ui/robots");
    fs::create_dir_all(&folder)?;
    for entry in fs::read_dir("robots")? {
        let entry = entry?;
        fs::copy(entry.path(), folder.join(entry.file_name()))?;
    }
    Ok(())
}

#[test]
fn mistakes_and_good_invocations() {
    provide_robots().unwrap();
    let cases = trybuild::TestCases::new();
    cases.compile_fail("fail/*.rs");
    cases.pass("pass/*.rs");
}

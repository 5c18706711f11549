//! Lines that a build script prints for cargo: files to watch, and warnings.

use std::env;
use std::fs;
use std::path::Path;

/// A plan that is not there yet cannot be named: cargo would run the script at every build. Then
/// the robot's folder is watched, unless the build itself writes somewhere in it.
pub(crate) fn watch(robot: &Path, output: &Path) {
    tell(&format!("rerun-if-changed={}", robot.display()));
    let plan = robot.with_extension("plan");
    if plan.is_file() {
        tell(&format!("rerun-if-changed={}", plan.display()));
    } else if let Some(folder) = quiet_folder(robot, output) {
        tell(&format!("rerun-if-changed={}", folder.display()));
    }
}

fn quiet_folder<'r>(robot: &'r Path, output: &Path) -> Option<&'r Path> {
    let folder = robot.parent().filter(|folder| folder.is_dir())?;
    let whole = fs::canonicalize(folder).ok()?;
    let written = [
        env::var_os("CARGO_MANIFEST_DIR").map(Into::into),
        env::var_os("OUT_DIR").map(Into::into),
        // The file itself may not be there yet.
        output.parent().map(Path::to_owned),
    ];
    let inside = |path: &Path| fs::canonicalize(path).is_ok_and(|path| path.starts_with(&whole));
    let busy = written.iter().flatten().any(|path| inside(path));
    (!busy).then_some(folder)
}

#[cfg(feature = "search")]
pub(crate) fn warn(message: &str) {
    let lines: Vec<&str> = message.lines().map(str::trim).collect();
    tell(&format!("warning={}", lines.join(" ")));
}

/// Tells cargo; does nothing outside a build script.
fn tell(line: &str) {
    if env::var_os("OUT_DIR").is_some() {
        println!("cargo::{line}");
    }
}

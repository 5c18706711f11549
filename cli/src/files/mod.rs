//! Files that a run writes: found and checked before its work, written after
//! it, all of them or none.
//!
//! - [`target`]: where an output goes
//! - [`folder`]: a folder of outputs
//! - [`distinct`]: no output is an input, or another output
//! - [`mod@write`]: all or none

pub mod distinct;
pub mod folder;
pub mod target;
mod unfinished;
pub mod write;

use std::fmt::Display;
use std::path::Path;

use crate::outcome::Failure;

/// Returns why something cannot be written.
fn unwritable(path: &Path, why: impl Display) -> Failure {
    let path = path.display();
    Failure::Input(format!("error: `{path}` cannot be written: {why}"))
}

/// Returns the folder that a path is in.
fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

//! Models of robots that other programs have: a URDF, or an MJCF with what it includes.

use std::fs;
use std::path::Path;

use dalembert_import::{MAX_BYTES, Text};

use crate::input;
use crate::outcome::Failure;

/// Reads a model, with what it includes.
///
/// # Errors
/// A file cannot be read, is no text, or is included twice.
pub fn text(path: &Path) -> Result<Text, Failure> {
    let name = path.display().to_string();
    let source = String::from_utf8(input::bytes(path, MAX_BYTES as u64)?)
        .map_err(|_| Failure::Input(format!("error: `{name}` is not UTF-8 text")))?;
    Text::of(&name, source)
        .with_includes(path, included)
        .map_err(Failure::Input)
}

/// Returns the text of a file that is included; pipes and devices have no end.
fn included(path: &Path) -> Result<String, String> {
    let found = fs::metadata(path).map_err(|error| error.to_string())?;
    if !found.is_file() {
        return Err("it is no file".to_owned());
    }
    let bytes = input::first(path, MAX_BYTES as u64 + 1).map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".to_owned())
}

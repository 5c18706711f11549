//! Compares charts and printed text with what is checked in and shown in the guide.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Returns a file of the guide in `docs/src`.
pub fn guide(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../docs/src")
        .join(name)
}

/// Returns whether a file holds this text. If not, it is written: so a test that fails has
/// mended the file, and who looks at the difference says whether that is right.
///
/// # Errors
/// The file cannot be written.
pub fn is(path: &Path, text: &str) -> io::Result<bool> {
    if fs::read_to_string(path).is_ok_and(|known| known == text) {
        return Ok(true);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beside = path.with_file_name(format!(".{name}.{}", std::process::id()));
    fs::write(&beside, text)?;
    fs::rename(&beside, path)?;
    Ok(false)
}

//! The written file: whole or not at all, and no more often than needed.

use std::fmt::Write as _;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

use hmac_sha256::Hash;

use dalembert_codegen::workspace::task::Request;

/// Returns the hash of everything that the text depends on.
pub(crate) fn key(source: &str, request: &Request) -> String {
    let version = env!("CARGO_PKG_VERSION");
    // Lengths keep the parts apart; the request prints the same every time.
    hash(&format!(
        "{version}\n{}\n{source}\n{request:?}",
        source.len()
    ))
}

/// Returns whether the file is there, from the same input and as it was written.
pub(crate) fn is_current(path: &Path, key: &str) -> bool {
    fs::read_to_string(path).is_ok_and(|whole| match whole.split_once('\n') {
        Some((first, text)) => first == header(key, text),
        None => false,
    })
}

/// Writes header and text beside the file, then renames: who reads at the same
/// time sees the old file or the new one.
pub(crate) fn write(path: &Path, key: &str, text: &str) -> io::Result<()> {
    if let Some(folder) = path.parent().filter(|p| !p.as_os_str().is_empty()) {
        fs::create_dir_all(folder)?;
    }
    // Two build scripts may write the same file.
    let unfinished = path.with_extension(format!("{}.unfinished", std::process::id()));
    let written = OpenOptions::new()
        .write(true)
        .create(true)
        .truncate(true)
        .open(&unfinished)
        .and_then(|mut file| {
            writeln!(file, "{}", header(key, text))?;
            file.write_all(text.as_bytes())?;
            file.sync_all()
        })
        .and_then(|()| fs::rename(&unfinished, path));
    if written.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&unfinished);
    }
    written
}

/// Returns the first line. It has a hash of the text too, so that an edit by hand does not
/// pass for generated.
fn header(key: &str, text: &str) -> String {
    format!("// input {key}, text {}", hash(text))
}

fn hash(text: &str) -> String {
    let mut digits = String::new();
    for byte in &Hash::hash(text.as_bytes())[..16] {
        // Writing to a string cannot fail.
        let _ = write!(digits, "{byte:02x}");
    }
    digits
}

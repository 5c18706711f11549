//! The hash of the sources that generated code follows from: part of a cache's keys, so
//! that what another generator made is not taken for this one's.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub(crate) const SOURCES: [&str; 7] = [
    "../../Cargo.lock",
    "src",
    "../../codegen/src",
    "../import/src",
    "../../macros/stamp/src",
    "../model/src",
    "../sines/src",
];

/// Returns the SHA-256 of all files in these folders, with their names, as hexadecimal.
pub(crate) fn hash(root: &Path, sources: &[&str]) -> io::Result<String> {
    let mut files = Vec::new();
    for source in sources {
        list(root, Path::new(source), &mut files)?;
    }
    files.sort();
    let mut hash = hmac_sha256::Hash::new();
    for file in files {
        let bytes = fs::read(root.join(&file))?;
        let name = file.to_string_lossy();
        for part in [name.as_bytes(), &bytes] {
            hash.update((part.len() as u64).to_le_bytes());
            hash.update(part);
        }
    }
    let hash = hash.finalize();
    Ok(hash.iter().map(|byte| format!("{byte:02x}")).collect())
}

fn list(root: &Path, path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !root.join(path).is_dir() {
        files.push(path.to_owned());
        return Ok(());
    }
    for entry in fs::read_dir(root.join(path))? {
        list(root, &path.join(entry?.file_name()), files)?;
    }
    Ok(())
}

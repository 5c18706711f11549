//! Writing all outputs, or none.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;

use super::target::{Place, Target};
use super::unwritable;
use crate::outcome::Outcome;
use crate::output;

/// Writes texts to their targets: files under other names in the same folders,
/// then into pipes and devices, and when all of that went well the files get
/// their names.
///
/// # Errors
/// Something cannot be written: then no file has changed, unless the system
/// refused to rename a later one.
pub fn write(outputs: &[(&Target, &str)]) -> Outcome {
    let mut unfinished = Vec::new();
    for (target, text) in outputs {
        if let Place::File(path) = &target.place {
            let part = Unfinished::beside(path).and_then(|mut part| {
                part.file.write_all(text.as_bytes())?;
                Ok(part)
            });
            let part = part.map_err(|error| unwritable(&target.name, error))?;
            unfinished.push((target, path, part));
        }
    }
    for (target, text) in outputs {
        match &target.place {
            Place::Standard => output::print(text)?,
            Place::Stream(path) => {
                // At the end: what is open may be a file with something in it.
                let opened = OpenOptions::new().append(true).open(path);
                let written = opened.and_then(|mut file| file.write_all(text.as_bytes()));
                written.map_err(|error| unwritable(&target.name, error))?;
            }
            Place::File(_) => {}
        }
    }
    for (target, path, part) in unfinished {
        part.finish(path)
            .map_err(|error| unwritable(&target.name, error))?;
    }
    Ok(())
}

/// A file that has not got its name yet; without [`Unfinished::finish`] it
/// goes again.
pub(super) struct Unfinished {
    path: PathBuf,
    file: File,
}

/// Left by runs with the same number that were killed.
const MOST_LEFT: usize = 16;

impl Unfinished {
    /// In the same folder, so that it can be renamed.
    pub(super) fn beside(path: &Path) -> io::Result<Unfinished> {
        let name = path.file_name().ok_or(ErrorKind::IsADirectory)?;
        let mut left = 0;
        loop {
            let mut part = name.to_os_string();
            part.push(format!(".{}.{left}.part", process::id()));
            let path = path.with_file_name(part);
            // New: in a folder that others write in too, a link may lie in wait.
            match File::create_new(&path) {
                Ok(file) => return Ok(Unfinished { path, file }),
                Err(error) if error.kind() == ErrorKind::AlreadyExists && left < MOST_LEFT => {
                    left += 1;
                }
                Err(error) => return Err(error),
            }
        }
    }

    fn finish(self, name: &Path) -> io::Result<()> {
        fs::rename(&self.path, name)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        // Renamed, or there is an error to report already.
        let _ = fs::remove_file(&self.path);
    }
}

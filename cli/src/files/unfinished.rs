//! Files that have not got their names yet.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process;

/// A file that has not got its name yet; without [`Unfinished::finish`] it
/// goes again.
pub(super) struct Unfinished {
    path: PathBuf,
    pub(super) file: File,
}

/// Left by runs with the same number that were killed.
const MAX_LEFT: usize = 16;

impl Unfinished {
    /// Creates it in the same folder, so that it can be renamed.
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
                Err(error) if error.kind() == ErrorKind::AlreadyExists && left < MAX_LEFT => {
                    left += 1;
                }
                Err(error) => return Err(error),
            }
        }
    }

    pub(super) fn finish(self, name: &Path) -> io::Result<()> {
        fs::rename(&self.path, name)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        // Renamed, or there is an error to report already.
        let _ = fs::remove_file(&self.path);
    }
}

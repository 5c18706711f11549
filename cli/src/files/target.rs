//! Where an output goes.

use std::fs::{self, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::unfinished::Unfinished;
use super::{parent, unwritable};
use crate::outcome::{Failure, Outcome};

/// Where an output goes.
#[derive(Debug)]
pub struct Target {
    /// As the user calls it.
    pub name: PathBuf,
    pub(super) place: Destination,
}

/// The kind of place.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Destination {
    /// Standard output.
    Standard,
    /// A file that is there or will be, links followed: replaced as a whole.
    File(PathBuf),
    /// A device or a pipe: written into, so that it stays what it is.
    Stream(PathBuf),
}

/// Where a process finds what it has open.
const OPEN: [&str; 4] = ["/dev/stdout", "/dev/stderr", "/dev/fd", "/proc/self/fd"];

/// The path that stands for standard output.
pub(super) const STANDARD: &str = "-";

/// As much of a file as says who wrote it.
const HEAD: u64 = 4096;

impl Target {
    /// Returns standard output.
    pub fn standard() -> Target {
        Target {
            name: "standard output".into(),
            place: Destination::Standard,
        }
    }

    /// Returns the target of `-o`: standard output without one, which the report cannot have too.
    ///
    /// # Errors
    /// The path is a folder or leads nowhere, or both would go to standard output.
    pub fn output(path: Option<&Path>, is_reported: bool) -> Result<Target, Failure> {
        let target = path.map_or_else(|| Ok(Target::standard()), Target::at)?;
        if path.is_some() && is_reported && target.place == Destination::Standard {
            return Err(Failure::Input(
                "error: the report goes to standard output, and `-o -` sends there what is written\n  \
                 = help: give -o the name of a file"
                    .into(),
            ));
        }
        Ok(target)
    }

    /// Refuses a name that ends as files of another format do.
    ///
    /// # Errors
    /// The name has an ending, and it is another.
    pub fn ends_in(&self, ending: &str) -> Outcome {
        let found = self.file().and(self.name.extension());
        match found.filter(|found| !found.eq_ignore_ascii_case(ending)) {
            None => Ok(()),
            Some(_) => Err(Failure::Input(format!(
                "error: `{}` would hold a .{ending} file\n  \
                 = help: name it `{}`; `-o -` writes to standard output",
                self.name.display(),
                self.name.with_extension(ending).display()
            ))),
        }
    }

    /// Finds out where a path leads; `-` is standard output.
    ///
    /// # Errors
    /// The path is a folder, or leads nowhere.
    pub fn at(path: &Path) -> Result<Target, Failure> {
        if path == Path::new(STANDARD) {
            return Ok(Target::standard());
        }
        let place = place(path).map_err(|error| unwritable(path, said(path, &error)))?;
        let name = path.to_owned();
        Ok(Target { name, place })
    }

    /// Tries whether it can be written, and leaves nothing behind.
    ///
    /// # Errors
    /// It cannot.
    pub fn check(&self) -> Outcome {
        let tried = match &self.place {
            Destination::Standard => Ok(()),
            Destination::File(path) => Unfinished::beside(path).map(drop),
            Destination::Stream(path) => enter(path),
        };
        tried.map_err(|error| unwritable(&self.name, error))
    }

    /// Refuses to write over a file that this program did not write: each of its files says
    /// that it did near its beginning.
    ///
    /// # Errors
    /// The file is somebody else's.
    pub fn ours(&self) -> Outcome {
        let Some(file) = self.file() else {
            return Ok(());
        };
        // What is not there, or cannot be read, is said by whoever writes it.
        let head = crate::input::first(file, HEAD).unwrap_or_default();
        let text = String::from_utf8_lossy(&head);
        let ours = ["dalembert", "\"certificate\": "].map(|mark| text.contains(mark));
        match head.is_empty() || ours.contains(&true) {
            true => Ok(()),
            false => Err(Failure::Input(format!(
                "error: `{}` is there already, and dalembert did not write it\n  \
                 = help: give another name, or --force to write over it",
                self.name.display()
            ))),
        }
    }

    /// Returns the file, unless it is a device or a pipe.
    pub fn file(&self) -> Option<&Path> {
        match &self.place {
            Destination::File(path) => Some(path),
            Destination::Standard | Destination::Stream(_) => None,
        }
    }
}

fn place(path: &Path) -> io::Result<Destination> {
    if path.to_string_lossy().ends_with(std::path::is_separator) {
        return Err(ErrorKind::IsADirectory.into());
    }
    // What is open is written on, not anew, whatever it is.
    let open = OPEN.iter().any(|open| path.starts_with(open));
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(ErrorKind::IsADirectory.into()),
        Ok(found) if found.is_file() && !open => fs::canonicalize(path).map(Destination::File),
        Ok(_) => Ok(Destination::Stream(path.to_owned())),
        Err(error) if error.kind() == ErrorKind::NotFound && !path.is_symlink() => {
            let name = path.file_name().ok_or(ErrorKind::IsADirectory)?;
            Ok(Destination::File(
                fs::canonicalize(parent(path))?.join(name),
            ))
        }
        Err(error) => Err(error),
    }
}

/// Enters a target; a pipe is not opened: that waits for its reader.
fn enter(path: &Path) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if fs::metadata(path)?.file_type().is_fifo() {
            return Ok(());
        }
    }
    OpenOptions::new().append(true).open(path).map(drop)
}

/// Returns what is wrong, and the likely fix.
fn said(path: &Path, error: &io::Error) -> String {
    let folder = parent(path);
    match error.kind() {
        ErrorKind::IsADirectory => {
            "it is a folder\n  = help: give the name of a file in it".to_owned()
        }
        ErrorKind::NotFound if !folder.exists() => format!(
            "there is no folder `{}`\n  = help: make it first",
            folder.display()
        ),
        _ => error.to_string(),
    }
}

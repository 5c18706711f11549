//! Where an output goes.

use std::fs::{self, Metadata, OpenOptions};
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

/// What is there.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Destination {
    /// Standard output.
    Standard,
    /// A file that is there or will be, links followed: replaced as a whole.
    File(PathBuf),
    /// A device or a pipe: written into, so that it stays what it is.
    Stream(PathBuf),
}

/// As much of a file as says who wrote it.
const HEAD: u64 = 4096;

/// Links that are followed.
const MAX_LINKS: usize = 40;

/// Where a process finds what it has open.
const OPEN: [&str; 2] = ["/dev/fd", "/proc/self/fd"];

impl Target {
    /// Standard output.
    pub fn standard() -> Target {
        Target {
            name: "standard output".into(),
            place: Destination::Standard,
        }
    }

    /// Finds out where a path leads.
    ///
    /// # Errors
    /// To a folder, or nowhere.
    pub fn at(path: &Path) -> Result<Target, Failure> {
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

    /// The file, unless it is a device or a pipe.
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
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        // A file that is open may have no name, or is to be written on, not anew.
        if let Some(number) = OPEN.iter().find_map(|open| path.strip_prefix(open).ok()) {
            return match number == Path::new("1") {
                true => Ok(Destination::Standard),
                false => fs::metadata(&path).map(|_| Destination::Stream(path)),
            };
        }
        if let Ok(to) = fs::read_link(&path) {
            path = parent(&path).join(to);
            continue;
        }
        return match fs::metadata(&path) {
            Ok(found) if found.is_file() => fs::canonicalize(&path).map(Destination::File),
            Ok(found) => stream(&found).map(|()| Destination::Stream(path)),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let name = path.file_name().ok_or(ErrorKind::IsADirectory)?;
                Ok(Destination::File(
                    fs::canonicalize(parent(&path))?.join(name),
                ))
            }
            Err(error) => Err(error),
        };
    }
    Err(io::Error::other("its links go round in circles"))
}

/// Whether what is no file can be written into.
fn stream(found: &Metadata) -> io::Result<()> {
    if found.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let kind = found.file_type();
        if kind.is_block_device() {
            return Err(io::Error::other("it is a disk, not a file"));
        }
        if kind.is_socket() {
            return Err(io::Error::other(
                "it is a socket, not a file\n  = help: pipe standard output into what talks to it",
            ));
        }
    }
    Ok(())
}

/// A pipe is not opened: that waits for its reader.
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

/// What is wrong, and the likely fix.
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

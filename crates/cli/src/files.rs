//! Files that a run writes: refused before its work, written after it, all of them or none.

use std::fmt::Display;
use std::fs::{self, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf, is_separator};

use dalembert_import::first_bytes;
use dalembert_stamp::refusal;
use tempfile::{Builder, NamedTempFile};

use crate::terminal::{Context, Failure, print};

const STANDARD: &str = "-";
/// Paths of this process's open files: output is appended to them, whatever they are.
const OPEN: [&str; 4] = ["/dev/stdout", "/dev/stderr", "/dev/fd", "/proc/self/fd"];
pub const MAX_BYTES: u64 = 1 << 28;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    name: PathBuf,
    place: Place,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Place {
    Standard,
    /// A regular file, links followed: replaced as a whole.
    File(PathBuf),
    /// A device or a pipe: written into, so that it stays what it is.
    Stream(PathBuf),
}

impl Target {
    /// Returns the file, unless it is a device or a pipe.
    pub fn file(&self) -> Option<&Path> {
        match &self.place {
            Place::File(path) => Some(path),
            Place::Standard | Place::Stream(_) => None,
        }
    }

    /// Returns the line that reports the written file; `None` for standard output and streams.
    pub fn note(&self) -> Option<String> {
        let name = self.name.display();
        self.file().map(|_| format!("wrote {name}"))
    }
}

/// The outputs and the inputs of a run: no output may overwrite an input.
pub struct Files<'c> {
    context: &'c Context,
    inputs: Vec<Target>,
    targets: Vec<Target>,
}

impl<'c> Files<'c> {
    pub fn new(context: &'c Context, inputs: &[&Path]) -> Files<'c> {
        Files {
            context,
            // An input that does not exist is kept, too: the next run may read it.
            inputs: inputs.iter().filter_map(|path| target(path).ok()).collect(),
            targets: Vec::new(),
        }
    }

    /// Adds the output of `-o`, by default standard output, which `--json` uses for the report.
    pub fn output(&mut self, path: Option<&Path>) -> Result<Target, Failure> {
        let path = path.unwrap_or(Path::new(STANDARD));
        if self.context.json && path == Path::new(STANDARD) {
            let why = "with --json the report goes to standard output, so the file cannot go there\n  \
                 = help: give a file by --output";
            return Err(Failure::input(why));
        }
        self.add(path)
    }

    /// Adds an output; `-` is standard output. Refuses what cannot be written, is an input or another
    /// output, or is not as dalembert wrote it.
    pub fn add(&mut self, path: &Path) -> Result<Target, Failure> {
        let target = target(path).map_err(|why| refused(path, why))?;
        match &target.place {
            Place::Standard => {}
            Place::Stream(stream) => enter(stream).map_err(|error| refused(path, error))?,
            Place::File(file) => {
                let is_in =
                    |targets: &[Target]| targets.iter().any(|other| other.place == target.place);
                let why = if is_in(&self.inputs) {
                    Some("this run reads it\n  = help: give another name")
                } else if is_in(&self.targets) {
                    Some("it is another output of this run\n  = help: give another name")
                } else {
                    foreign(file).filter(|_| !self.context.force)
                };
                if let Some(why) = why {
                    return Err(refused(path, why));
                }
                unfinished(folder(file)).map_err(|error| refused(path, error))?;
            }
        }
        self.targets.push(target.clone());
        Ok(target)
    }

    /// Adds a file in a folder; missing folders are made when the file is written.
    pub fn add_in(&mut self, into: &Path, name: &str) -> Result<Target, Failure> {
        if into == Path::new(STANDARD) {
            let why = "it is standard output; expected a folder";
            return Err(refused(into, why));
        }
        let path = into.join(name);
        let inside = folder(&path);
        let is_there = |folder: &&Path| fs::symlink_metadata(folder).is_ok();
        let there = inside.ancestors().find(is_there).unwrap_or(Path::new("."));
        if !there.is_dir() {
            let why = format!("`{}` is not a folder", there.display());
            return Err(refused(into, why));
        }
        if there == inside {
            return self.add(&path);
        }
        unfinished(there).map_err(|error| refused(into, error))?;
        let place = Place::File(path.clone());
        Ok(Target { name: path, place })
    }
}

/// Writes texts to their targets: first to temporary files beside them, then to streams. If all of
/// that succeeds, the temporary files get their names; else no file has changed, unless the system
/// refused to rename a later one.
pub fn write(outputs: &[(Target, String)]) -> Result<(), Failure> {
    let mut parts = Vec::new();
    for (target, text) in outputs {
        if let Place::File(file) = &target.place {
            let part = fs::create_dir_all(folder(file))
                .and_then(|()| unfinished(folder(file)))
                .and_then(|mut part| part.write_all(text.as_bytes()).map(|()| part))
                .map_err(|error| refused(&target.name, error))?;
            parts.push((target, file, part));
        }
    }
    for (target, text) in outputs {
        match &target.place {
            Place::Standard => print(text)?,
            Place::Stream(path) => {
                // Appends: an open file may already have content.
                let stream = OpenOptions::new().append(true).open(path);
                let written = stream.and_then(|mut stream| stream.write_all(text.as_bytes()));
                written.map_err(|error| refused(&target.name, error))?;
            }
            Place::File(_) => {}
        }
    }
    for (target, file, part) in parts {
        part.persist(file)
            .map_err(|error| refused(&target.name, error.error))?;
    }
    Ok(())
}

/// Refuses a path with the extension of another format.
pub fn ends_in(path: Option<&Path>, ending: &str) -> Result<(), Failure> {
    let other = path.filter(|path| {
        let extension = path.extension();
        extension.is_some_and(|suffix| !suffix.eq_ignore_ascii_case(ending))
    });
    let Some(path) = other else {
        return Ok(());
    };
    Err(Failure::Input(format!(
        "error: the output is a .{ending} file, but `{}` has another extension\n  = help: name it `{}`; `-o -` writes to standard output",
        path.display(),
        path.with_extension(ending).display()
    )))
}

fn refused(path: &Path, why: impl Display) -> Failure {
    Failure::input(format!("`{}` cannot be written: {why}", path.display()))
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

fn unfinished(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

fn target(path: &Path) -> Result<Target, String> {
    const FOLDER: &str = "it is a folder\n  = help: give the name of a file in it";
    let of = |place| {
        let name = path.to_owned();
        Ok(Target { name, place })
    };
    if path == Path::new(STANDARD) {
        return of(Place::Standard);
    }
    if path.to_string_lossy().ends_with(is_separator) {
        return Err(FOLDER.into());
    }
    let is_open = OPEN.iter().any(|open| path.starts_with(open));
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Err(FOLDER.into()),
        Ok(metadata) if metadata.is_file() && !is_open => {
            let file = fs::canonicalize(path).map_err(|error| error.to_string())?;
            of(Place::File(file))
        }
        Ok(_) => of(Place::Stream(path.to_owned())),
        Err(error) if error.kind() == ErrorKind::NotFound && !path.is_symlink() => {
            let name = path.file_name().ok_or(FOLDER)?;
            let folder = folder(path);
            let folder = fs::canonicalize(folder).map_err(|_| {
                let folder = folder.display();
                format!("the folder `{folder}` does not exist\n  = help: create it first")
            })?;
            of(Place::File(folder.join(name)))
        }
        Err(error) => Err(error.to_string()),
    }
}

/// A pipe is not opened, since that waits for its reader.
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

/// Returns why a file may not be replaced: `None` if it is new, empty, or as dalembert wrote it.
fn foreign(file: &Path) -> Option<&'static str> {
    // If the file cannot be read, the write reports why.
    let bytes = first_bytes(file, MAX_BYTES).unwrap_or_default();
    // These formats have no comments, and nobody writes them by hand.
    let is_table = bytes.starts_with(b"tolerance,scalar,sincos_by,");
    if is_table || bytes.starts_with(b"{\"claim\":") {
        return None;
    }
    refusal(
        &bytes,
        "it was edited since dalembert wrote it\n  = help: --force overwrites the edits",
        "the file exists, and dalembert did not write it\n  = help: give another name, or --force to \
         overwrite it",
    )
}

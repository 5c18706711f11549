//! A folder of outputs.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::distinct::distinct;
use super::target::{STANDARD, Target};
use super::unfinished::Unfinished;
use super::write::write;
use super::{parent, unwritable};
use crate::outcome::{Failure, Outcome};

/// A folder of outputs, made when they are written: what ends before leaves
/// none behind.
pub struct Folder(PathBuf);

impl Folder {
    /// Returns a folder that is there or can be made, in which these files can be
    /// written, none of which is the input.
    ///
    /// # Errors
    /// It is something else, or cannot be written in.
    pub fn at(path: &Path, files: &[&str], input: Option<&Path>) -> Result<Folder, Failure> {
        if path == Path::new(STANDARD) {
            return Err(unwritable(
                path,
                "it is standard output, and a folder is needed",
            ));
        }
        let mut there = path;
        // The one that is there already.
        loop {
            match fs::metadata(there) {
                Ok(found) if found.is_dir() => break,
                Ok(_) => {
                    let why = format!("`{}` is no folder", there.display());
                    return Err(unwritable(path, why));
                }
                Err(error)
                    if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) =>
                {
                    if fs::read_link(there).is_ok() {
                        let why = format!("`{}` is a link to nowhere", there.display());
                        return Err(unwritable(path, why));
                    }
                    there = parent(there);
                }
                Err(error) => return Err(unwritable(path, error)),
            }
        }
        let tried = Unfinished::beside(&there.join("dalembert"));
        tried.map_err(|error| unwritable(path, error))?;
        if there == path {
            for file in files {
                let target = Target::at(&path.join(file))?;
                let input = input.map(|input| ("the robot file", input));
                distinct(input.as_slice(), &[("an output", &target)])?;
            }
        }
        Ok(Folder(path.to_owned()))
    }

    /// Returns the path as the user calls it.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Writes files into it, all of them or none; names may have folders.
    ///
    /// # Errors
    /// One of them cannot be written.
    pub fn write(&self, files: &[(String, String)]) -> Outcome {
        let mut targets = Vec::new();
        for (name, _) in files {
            let path = self.0.join(name);
            let folder = parent(&path);
            fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
            targets.push(Target::at(&path)?);
        }
        let texts = files.iter().map(|(_, text)| text.as_str());
        let outputs: Vec<(&Target, &str)> = targets.iter().zip(texts).collect();
        write(&outputs)
    }
}

//! The plan beside a robot file.

use std::fmt;
use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::Plan;
use super::error::PlanError;
use super::parse::MAX_BYTES;

/// Returns where a robot file's plan is: `puma560.plan` beside `puma560.toml`.
pub fn path(robot_file: &Path) -> PathBuf {
    robot_file.with_extension("plan")
}

/// Makes cargo notice a plan that was not there before.
///
/// A macro that was expanded without one could not name it to the compiler: of
/// a file that is not there, nothing can be included. It did name the robot
/// file, so that gets a new time, and everything that was made from it is made
/// anew, with the plan.
///
/// # Errors
/// The robot file's time cannot be set.
pub fn announce(robot_file: &Path) -> std::io::Result<()> {
    let file = File::options().append(true).open(robot_file)?;
    file.set_modified(std::time::SystemTime::now())
}

/// Reads the plan beside a robot file; there need not be one.
///
/// # Errors
/// What is wrong with the file, or with a line of it.
pub fn beside(robot_file: &Path) -> Result<Option<Plan>, PlanFileError> {
    let path = path(robot_file);
    let fail = |fault| PlanFileError {
        path: path.clone(),
        fault,
    };
    // Opening a pipe would wait for somebody who writes into it.
    if fs::metadata(&path).is_ok_and(|found| !found.is_file()) {
        return Err(fail(FileFault::NoFile));
    }
    let mut bytes = Vec::new();
    let read =
        File::open(&path).and_then(|file| file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes));
    match read {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(fail(FileFault::Unreadable(error.to_string()))),
        Ok(_) => {}
    }
    let text = String::from_utf8(bytes).map_err(|_| fail(FileFault::Encoding))?;
    Plan::parse(&text)
        .map(Some)
        .map_err(|error| fail(FileFault::Wrong(error)))
}

/// Why the plan beside a robot file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanFileError {
    /// Where the plan is.
    pub path: PathBuf,
    /// What is wrong with it.
    pub fault: FileFault,
}

/// What is wrong with a plan's file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileFault {
    /// It is a folder, a device or a pipe.
    NoFile,
    /// It cannot be read: what the system says.
    Unreadable(String),
    /// It is no UTF-8 text.
    Encoding,
    /// Its text is no plan.
    Wrong(PlanError),
}

impl fmt::Display for PlanFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = self.path.display();
        match &self.fault {
            FileFault::NoFile => write!(f, "cannot read `{shown}`: a plan is a file"),
            FileFault::Unreadable(error) => write!(f, "cannot read `{shown}`: {error}"),
            FileFault::Encoding => write!(f, "`{shown}` is not UTF-8"),
            FileFault::Wrong(error) => write!(f, "{shown}:{}: {}", error.line, error.fault),
        }
    }
}

impl std::error::Error for PlanFileError {}

//! Why a build script wrote nothing.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::PathBuf;

use dalembert_model::read::for_bundle;

use crate::{BundleError, GenerateError, RobotFileError, UnknownScene};

/// Why nothing was written.
#[non_exhaustive]
pub enum BuildError {
    /// No robot file was named.
    NoRobot,
    /// There is no such bundle.
    Bundle(BundleError),
    /// There is no `OUT_DIR`.
    NoOutDir,
    /// The robot file is missing or wrong.
    Robot(RobotFileError),
    /// The robot in this file has no such scene.
    Scene(PathBuf, UnknownScene),
    /// The robot in this file cannot have what was asked for.
    Generate(PathBuf, GenerateError),
    /// This file cannot be written.
    Write(PathBuf, io::Error),
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BuildError::NoRobot => {
                f.write_str("error: no robot file: call `.robot(\"robots/arm.toml\")`")
            }
            BuildError::Bundle(error) => write!(
                f,
                "error: {}\n  = help: {}",
                error.message(),
                for_bundle(error)
            ),
            BuildError::NoOutDir => f.write_str(
                "error: `OUT_DIR` is not set: call this from a build script, or `write_to`",
            ),
            BuildError::Robot(error) => error.fmt(f),
            BuildError::Scene(path, error) => write!(
                f,
                "error: {}: {}\n  = help: {}",
                path.display(),
                error.message(),
                error.help()
            ),
            BuildError::Generate(path, error) => write!(f, "error: {}: {error}", path.display()),
            BuildError::Write(path, error) => {
                write!(f, "error: cannot write {}: {error}", path.display())
            }
        }
    }
}

/// As [`Display`](fmt::Display): `main` and `unwrap` print errors with this,
/// and that is where a build script's errors end.
impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl Error for BuildError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            BuildError::NoRobot | BuildError::NoOutDir => None,
            BuildError::Robot(error) => Some(error),
            BuildError::Scene(_, error) => Some(error),
            BuildError::Generate(_, error) => Some(error),
            BuildError::Bundle(error) => Some(error),
            BuildError::Write(_, error) => Some(error),
        }
    }
}

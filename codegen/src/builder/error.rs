//! Why a build script wrote nothing.

use std::fmt;
use std::path::PathBuf;

use crate::clauses::RobotFileError;
use crate::generate::GenerateError;
use crate::scene::UnknownScene;

/// Why nothing was written.
#[derive(Clone, PartialEq)]
pub enum BuildError {
    /// No robot file was named.
    NoRobot,
    /// There is no `OUT_DIR`.
    NoOutDir,
    /// The robot file is missing or wrong.
    Robot(RobotFileError),
    /// The robot has no such scene.
    Scene(PathBuf, UnknownScene),
    /// The robot cannot have what was asked for.
    Generate(PathBuf, GenerateError),
    /// The file cannot be written; what the system says.
    Write(PathBuf, String),
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BuildError::NoRobot => {
                f.write_str("error: no robot file: call `.robot(\"robots/arm.toml\")`")
            }
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

impl std::error::Error for BuildError {}

//! Why a rung cannot be used, or not be kept.

use std::fmt;
use std::path::PathBuf;

/// Why a rung cannot be used, or not be kept.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RungError {
    /// One that was kept cannot be used.
    Kept {
        /// Where it is.
        path: PathBuf,
        /// The fault.
        fault: RungFault,
    },
    /// It cannot be written.
    Unwritten {
        /// Where to.
        path: PathBuf,
        /// The message of the system.
        error: String,
    },
}

/// A fault of a rung that was kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RungFault {
    /// It cannot be read: what the system says.
    Unreadable(String),
    /// It is a folder, a device or a pipe.
    NoFile,
    /// It is of another run.
    OtherRun,
    /// It is not as it was written.
    Damaged(Damage),
}

/// A difference of a rung from what was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Damage {
    /// It is no JSON: what the parser says.
    Json(String),
    /// It is of another version.
    Version,
    /// Its hash is that of something else.
    Hash,
    /// It is of another tolerance.
    Tolerance,
    /// It lacks a key.
    Missing(&'static str),
    /// A point's plan is none: what its reader says.
    Plan(String),
    /// A point's variant is none of the exact program.
    Variant,
}

impl fmt::Display for RungError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RungError::Kept { path, fault } => write!(
                f,
                "the rung `{}` of a run that was ended {fault}\n  = help: delete it to search \
                 for it again, or choose another folder",
                path.display()
            ),
            RungError::Unwritten { path, error } => {
                write!(f, "`{}` cannot be written: {error}", path.display())
            }
        }
    }
}

impl fmt::Display for RungFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RungFault::Unreadable(error) => write!(f, "cannot be read: {error}"),
            RungFault::NoFile => f.write_str("is no file"),
            RungFault::OtherRun => {
                f.write_str("is of another robot, scene, plan, version or options")
            }
            RungFault::Damaged(damage) => write!(f, "is damaged: {damage}"),
        }
    }
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Damage::Json(error) => f.write_str(error),
            Damage::Version => f.write_str("this version reads rungs of version 3"),
            Damage::Hash => f.write_str("its hash is not that of what it says"),
            Damage::Tolerance => f.write_str("it is of another tolerance"),
            Damage::Missing(key) => write!(f, "`{key}` is missing"),
            Damage::Plan(error) => f.write_str(error),
            Damage::Variant => f.write_str("a variant is none of the exact program"),
        }
    }
}

impl std::error::Error for RungError {}

impl std::error::Error for RungFault {}

impl std::error::Error for Damage {}

//! Findings about robots and scenes: errors and warnings, each at a place of the robot file.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::RobotWarning;

/// The severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Nothing can be generated.
    Error,
    /// Probably a slip; taken as it stands.
    Warning,
    /// A decision of the reader that the author may want to know.
    Note,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        })
    }
}

/// An error or a warning about a robot or a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The name of a warning; `None` of an error.
    pub warning: Option<RobotWarning>,
    /// The keys of the robot file that lead to the value, from the outermost one:
    /// `joint/#2/limits/velocity`. An entry of a list or a table is named by `#` and its
    /// number, from one.
    pub place: String,
    /// A sentence that says the mistake.
    pub message: String,
    /// The likely fix; may be empty.
    pub help: String,
}

impl Finding {
    /// Returns whether it is an error, not a warning.
    pub fn is_error(&self) -> bool {
        self.warning.is_none()
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match self.help.as_str() {
            "" => Ok(()),
            help => write!(f, " ({help})"),
        }
    }
}

/// Collects findings.
#[derive(Default)]
pub(crate) struct Findings(pub(crate) Vec<Finding>);

impl Findings {
    pub(crate) fn error(
        &mut self,
        place: impl Into<String>,
        message: impl Into<String>,
        help: &str,
    ) {
        self.push(None, place.into(), message.into(), help);
    }

    pub(crate) fn warn(
        &mut self,
        warning: RobotWarning,
        place: impl Into<String>,
        message: impl Into<String>,
        help: &str,
    ) {
        self.push(Some(warning), place.into(), message.into(), help);
    }

    fn push(&mut self, warning: Option<RobotWarning>, place: String, message: String, help: &str) {
        self.0.push(Finding {
            warning,
            place,
            message,
            help: help.to_owned(),
        });
    }
}

/// Returns the place of a key of the joint with this zero-based index.
pub(super) fn of_joint(index: usize, key: &str) -> String {
    format!("joint/#{}/{key}", index + 1)
}

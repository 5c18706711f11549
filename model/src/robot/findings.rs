//! What can be said of a robot, and how much it matters.

use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::{Place, RobotWarning};

/// The severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Nothing can be generated.
    Error,
    /// Probably a slip; taken as it stands.
    Warning,
    /// Said so that nobody has to guess.
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

/// Something wrong, or odd, about a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Error or warning.
    pub severity: Severity,
    /// The name of a warning; `None` of an error.
    pub warning: Option<RobotWarning>,
    /// Which part of the robot.
    pub place: Place,
    /// A sentence that says the mistake.
    pub message: String,
    /// The likely fix.
    pub help: Option<String>,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.severity, self.place, self.message)
    }
}

/// Collects them.
#[derive(Default)]
pub(super) struct Findings(Vec<Finding>);

impl Findings {
    pub(super) fn error(&mut self, place: Place, message: String, help: &str) {
        self.push(None, place, message, help);
    }

    pub(super) fn warn(
        &mut self,
        warning: RobotWarning,
        place: Place,
        message: String,
        help: &str,
    ) {
        self.push(Some(warning), place, message, help);
    }

    fn push(&mut self, warning: Option<RobotWarning>, place: Place, message: String, help: &str) {
        self.0.push(Finding {
            severity: warning.map_or(Severity::Error, |_| Severity::Warning),
            warning,
            place,
            message,
            help: (!help.is_empty()).then(|| help.to_owned()),
        });
    }

    pub(super) fn into_all(self) -> Vec<Finding> {
        self.0
    }
}

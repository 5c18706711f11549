//! Findings about robots and scenes: errors and warnings, each at a place of the robot file.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::values::word;

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

/// The name of a warning about a robot file. List it in the file to silence the warning:
/// `allow = ["large_mass"]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RobotWarning {
    /// No body has this inertia.
    ImpossibleInertia,
    /// Gravity is not that of the Earth, nor of the other planets.
    UnusualGravity,
    /// Gravity points along the base's z, upwards.
    UpwardGravity,
    /// A length looks like millimetres.
    LargeLength,
    /// A mass looks like grams.
    LargeMass,
    /// An inertia looks like kg·mm².
    LargeInertia,
    /// An angle looks like degrees.
    LargeAngle,
    /// A limit of position looks like degrees.
    LargeLimit,
    /// A limit of velocity looks like degrees or millimetres a second.
    LargeVelocity,
    /// A limit of velocity or acceleration is zero.
    ZeroLimit,
    /// Coulomb friction is smoothed over all speeds that a joint reaches.
    LargeWidth,
    /// An angle is near a multiple of π/2, but not near enough to be taken for it.
    NearRightAngle,
    /// A scene's box goes beyond the limits of a joint.
    BoxBeyondLimits,
    /// A tolerance allows an error as large as the output.
    LooseTolerance,
}

impl RobotWarning {
    /// All of them with their names in robot files.
    pub const WORDS: [(&'static str, RobotWarning); 14] = [
        ("impossible_inertia", RobotWarning::ImpossibleInertia),
        ("unusual_gravity", RobotWarning::UnusualGravity),
        ("upward_gravity", RobotWarning::UpwardGravity),
        ("large_length", RobotWarning::LargeLength),
        ("large_mass", RobotWarning::LargeMass),
        ("large_inertia", RobotWarning::LargeInertia),
        ("large_angle", RobotWarning::LargeAngle),
        ("large_limit", RobotWarning::LargeLimit),
        ("large_velocity", RobotWarning::LargeVelocity),
        ("zero_limit", RobotWarning::ZeroLimit),
        ("large_width", RobotWarning::LargeWidth),
        ("near_right_angle", RobotWarning::NearRightAngle),
        ("box_beyond_limits", RobotWarning::BoxBeyondLimits),
        ("loose_tolerance", RobotWarning::LooseTolerance),
    ];

    /// Returns the name in robot files.
    pub fn name(self) -> &'static str {
        word(&RobotWarning::WORDS, &self)
    }
}

impl fmt::Display for RobotWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
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
    /// True if it is an error, not a warning.
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

pub(super) fn of_base(key: &str) -> String {
    format!("joint/#0/{key}")
}

pub(super) fn of_joint(index: usize, key: &str) -> String {
    format!("joint/#{}/{key}", index + 1)
}

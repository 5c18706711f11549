//! Why a text is no certificate.

use std::fmt;

use dalembert_model::robot::Robot;
use serde_json::error::Category;

use super::{MAX_BYTES, MAX_CERTIFICATES, VERSION};
use crate::certificate::work::{MAX_EDITS, MAX_STEPS};
use crate::edits::text::EditFault;
use crate::program::text::LineFault;

/// Why a text is no certificate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormatError {
    /// Line and column, one-based, if the JSON itself is at fault.
    pub at: Option<(usize, usize)>,
    /// What is wrong and what was expected.
    pub fault: FormatFault,
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.fault.fmt(f)
    }
}

impl std::error::Error for FormatError {}

impl From<FormatFault> for FormatError {
    fn from(fault: FormatFault) -> Self {
        FormatError { at: None, fault }
    }
}

impl From<serde_json::Error> for FormatError {
    fn from(error: serde_json::Error) -> Self {
        let words = error.to_string();
        // The place is reported by itself.
        let place = format!(" at line {} column {}", error.line(), error.column());
        let words = words.strip_suffix(&place).unwrap_or(&words).to_owned();
        FormatError {
            at: Some((error.line(), error.column())),
            fault: match error.classify() {
                Category::Data => FormatFault::Fields(words),
                _ => FormatFault::Json(words),
            },
        }
    }
}

/// What is wrong with the text of certificates.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FormatFault {
    /// It is no JSON; what the parser says.
    Json(String),
    /// It has not a certificate's fields; what the parser says.
    Fields(String),
    /// It is longer than what is read.
    TooLong,
    /// There is no certificate in it.
    Empty,
    /// There are so many, more than a file has.
    TooMany(usize),
    /// It is of another version of the format.
    Version(u32),
    /// A field would be written otherwise.
    Field(&'static str),
    /// A field's word is not known.
    Unknown {
        /// The field.
        field: &'static str,
        /// The word.
        word: String,
    },
    /// A scene has no hash, or a hash no scene.
    HalfScene,
    /// There are no ranges, or more than an arm has joints.
    Joints,
    /// The rows are no joints.
    Rows,
    /// This is no argument.
    Argument(String),
    /// The parts of the bounds are not of one length.
    Bounds,
    /// A range, counted from one, ends before it begins.
    Range {
        /// The field that it is in.
        field: &'static str,
        /// Which of them it is.
        number: usize,
    },
    /// A program has so many steps, more than is checked.
    Steps(Listed, usize),
    /// A program has so many edits, more than is checked.
    Edits(Listed, usize),
    /// A step, counted from one, is none.
    Step(Listed, usize, LineFault),
    /// The results are none.
    Results(Listed, LineFault),
    /// An edit is none.
    Edit(Listed, EditFault),
    /// The polynomials of an angle are none.
    Polynomials(String, PolynomialFault),
}

/// Which program of a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listed {
    /// The emitted one.
    Emitted,
    /// That of a stage, from one.
    Stage(usize),
}

/// What is wrong with the polynomials of an angle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PolynomialFault {
    /// There is no such angle.
    Angle,
    /// A step, counted from one, is none.
    Step(usize, String),
    /// This is neither the angle, a step nor a literal.
    Value(String),
    /// The range ends before it begins.
    Range,
}

/// What is at hand for whoever has no certificate.
const HELP: &str =
    "\n  = help: `dalembert generate` in a scene with a tolerance writes certificates";

impl fmt::Display for FormatFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FormatFault::Json(words) => {
                write!(f, "this is no JSON, which a certificate is: {words}{HELP}")
            }
            FormatFault::Fields(words) => write!(
                f,
                "this is no certificate of format {VERSION}: {words}{HELP}"
            ),
            FormatFault::TooLong => {
                let most = MAX_BYTES >> 20;
                write!(
                    f,
                    "the file is longer than {most} MiB, the most that is read"
                )
            }
            FormatFault::Empty => f.write_str("there is no certificate in it"),
            FormatFault::TooMany(count) => {
                write!(
                    f,
                    "{count} certificates in one file; {MAX_CERTIFICATES} at most"
                )
            }
            FormatFault::Version(version) => write!(
                f,
                "certificates of version {VERSION} are read, not of version {version}: make it \
                 again with this version's `generate` or `tradeoff`"
            ),
            FormatFault::Field(field) => write!(
                f,
                "`{field}` is not what this version writes for such a certificate"
            ),
            FormatFault::Unknown { field, word } => write!(f, "`{field}`: `{word}` is not known"),
            FormatFault::HalfScene => f.write_str("`scene` and `scene_hash` belong together"),
            FormatFault::Joints => {
                let most = Robot::MAX_JOINTS;
                write!(f, "`position` needs 1 to {most} ranges, one a joint")
            }
            FormatFault::Rows => f.write_str("`rows`: expected the numbers of joints, from 1"),
            FormatFault::Argument(word) => {
                write!(f, "`arguments`: `{word}` is none of q, qd and qdd")
            }
            FormatFault::Bounds => f.write_str("`model`, `sincos` and `rounding` differ in length"),
            FormatFault::Range { field, number } => {
                write!(f, "`{field}`: range {number} ends before it begins")
            }
            FormatFault::Steps(of, count) => {
                write!(f, "`{of}` has {count} steps; {MAX_STEPS} are the most")
            }
            FormatFault::Edits(of, count) => {
                write!(f, "`{of}` has {count} edits; {MAX_EDITS} are the most")
            }
            FormatFault::Step(of, number, fault) => write!(f, "`{of}`, t{number}: {fault}"),
            FormatFault::Results(of, fault) => write!(f, "`{of}`, results: {fault}"),
            FormatFault::Edit(of, fault) => write!(f, "`{of}`, edits: {fault}"),
            FormatFault::Polynomials(angle, fault) => {
                write!(f, "`polynomials` of `{angle}`: {fault}")
            }
        }
    }
}

impl fmt::Display for Listed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Listed::Emitted => f.write_str("emitted"),
            Listed::Stage(number) => write!(f, "stage {number}"),
        }
    }
}

impl fmt::Display for PolynomialFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PolynomialFault::Angle => f.write_str("this is no angle"),
            PolynomialFault::Step(number, line) => write!(f, "x{number}: `{line}`"),
            PolynomialFault::Value(word) => write!(f, "`{word}` is no value"),
            PolynomialFault::Range => f.write_str("`range` is empty"),
        }
    }
}

impl std::error::Error for FormatFault {}

impl std::error::Error for PolynomialFault {}

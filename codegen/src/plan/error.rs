//! What is wrong with a plan, and with the file that it is in.

use std::fmt;

use crate::edits::text::EditFault;
use crate::function::BundleError;
use crate::program::text::LineFault;

/// What is wrong with a plan's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanError {
    /// One-based line.
    pub line: usize,
    /// What is wrong and what was expected.
    pub fault: PlanFault,
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.fault)
    }
}

impl std::error::Error for PlanError {}

/// What is wrong with a line of a plan, or with its end.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlanFault {
    /// The text is longer than so many bytes, the most that is read.
    TooLong(usize),
    /// The first line does not say that this is a plan.
    NoPlan,
    /// It is a plan of another version.
    Version,
    /// There is no line of this name.
    Missing(&'static str),
    /// A program must begin, and this word begins something else.
    NoProgram(String),
    /// A program does not begin with what it is of.
    Head,
    /// A program is of something that there is not.
    Unknown {
        /// What it should be.
        what: &'static str,
        /// How it is called.
        word: String,
    },
    /// A program is of a bundle that there cannot be.
    Bundle(BundleError),
    /// The last program does not end.
    Unreturned,
    /// A scene is not what a program has of it.
    Scene,
    /// A scene comes after steps of its program.
    LateScene,
    /// Parameters are not what a program has of them.
    Parameters,
    /// Parameters come after steps of their program, or again.
    LateParameters,
    /// A scene's rows are no joints.
    Rows,
    /// A stage lacks its name or its counts.
    Stage,
    /// There is no stage of this name.
    NoStage(String),
    /// A step, a result or an operand is none.
    Line(LineFault),
    /// An edit is none.
    Edit(EditFault),
    /// A line of a variant begins with none of its words.
    NoVariant(String),
    /// A bound of D's least eigenvalue that nobody needs.
    NeedlessEigenvalue,
    /// No bound of D's least eigenvalue, which is needed.
    NoEigenvalue,
    /// D's least eigenvalue is not bounded by a number above zero.
    Eigenvalue,
    /// The bounds of an output are not three numbers.
    Bound,
    /// The last variant does not end.
    Unbounded,
}

impl fmt::Display for PlanFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PlanFault::TooLong(most) => write!(f, "the plan is longer than {most} bytes"),
            PlanFault::NoPlan => f.write_str("expected `plan 1`"),
            PlanFault::Version => f.write_str("this version reads plans of version 1"),
            PlanFault::Missing(line) => write!(f, "there is no line `{line}`"),
            PlanFault::NoProgram(word) => write!(f, "expected `program`, found `{word}`"),
            PlanFault::Head => {
                f.write_str("expected a function, formulation, scalar, source and n")
            }
            PlanFault::Unknown { what, word } => write!(f, "`{word}` is no {what}"),
            // A plan is written by the command: nobody has to be told the fix.
            PlanFault::Bundle(error) => f.write_str(&error.message()),
            PlanFault::Unreturned => f.write_str("the last program has no `return`"),
            PlanFault::Scene => f.write_str("expected a scene's name, hash, rows and arguments"),
            PlanFault::Parameters => {
                f.write_str("expected `payload`, `gravity` or both, the load's length and its hash")
            }
            PlanFault::LateParameters => f.write_str("the parameters come once, before the steps"),
            PlanFault::LateScene => f.write_str("the scene comes before the steps"),
            PlanFault::Rows => f.write_str("expected joints such as `1,2,3`"),
            PlanFault::Stage => f.write_str("expected a stage and four counts"),
            PlanFault::NoStage(name) => write!(f, "`{name}` is no stage"),
            PlanFault::Line(fault) => fault.fmt(f),
            PlanFault::Edit(fault) => fault.fmt(f),
            PlanFault::NoVariant(word) => write!(
                f,
                "expected `edit`, `next`, `eigenvalue` or `bound`, found `{word}`"
            ),
            PlanFault::NeedlessEigenvalue => {
                f.write_str("no `eigenvalue` is needed: D is no output, or as it was")
            }
            PlanFault::NoEigenvalue => {
                f.write_str("expected `eigenvalue`: D is an output and was edited")
            }
            PlanFault::Eigenvalue => f.write_str("expected one number above zero"),
            PlanFault::Bound => f.write_str("expected three numbers of zero or more"),
            PlanFault::Unbounded => {
                f.write_str("the last variant has not a `bound` for every result")
            }
        }
    }
}

impl std::error::Error for PlanFault {}

impl From<LineFault> for PlanFault {
    fn from(fault: LineFault) -> PlanFault {
        PlanFault::Line(fault)
    }
}

impl From<EditFault> for PlanFault {
    fn from(fault: EditFault) -> PlanFault {
        PlanFault::Edit(fault)
    }
}

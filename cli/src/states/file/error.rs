//! Why a file of states cannot be used.

use std::fmt;

use super::words::{TORQUE, results};

/// Why a file of states cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileError {
    /// It is no JSON.
    Syntax {
        /// The message of the parser.
        message: String,
        /// From one.
        line: usize,
        /// From one.
        column: usize,
    },
    /// It is JSON, but not states of this robot.
    Content(ContentFault),
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FileError::Syntax { message, .. } => f.write_str(message),
            FileError::Content(fault) => fault.fmt(f),
        }
    }
}

impl std::error::Error for FileError {}

/// A fault of a file of states.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ContentFault {
    /// There is no list of states; the key that was probably meant for it.
    NoStates(Option<String>),
    /// The list is empty.
    Empty,
    /// A state, counted from one, is none of this robot.
    State(usize, StateFault),
}

impl fmt::Display for ContentFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ContentFault::NoStates(Some(key)) => {
                write!(f, "there is no list `states`; is `{key}` meant?")
            }
            ContentFault::NoStates(None) => f.write_str(
                "there is no list `states`: a file of states is \
                 {\"states\": [{\"q\": […], \"qd\": […], \"qdd\": […], \"tau\": […]}, …]}",
            ),
            ContentFault::Empty => f.write_str("the list `states` is empty"),
            ContentFault::State(number, fault) => write!(f, "state {number}: {fault}"),
        }
    }
}

impl std::error::Error for ContentFault {}

/// A fault of a state.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StateFault {
    /// It is no object.
    NoObject,
    /// A key of a state about itself must be a number.
    Remark(String),
    /// It has a key that no state has.
    Unknown {
        /// The key, fit to show.
        key: String,
        /// The one that was probably meant.
        meant: Option<&'static str>,
    },
    /// It lacks a key.
    Missing(&'static str),
    /// It lacks a key that a result depends on.
    MissingFor {
        /// The missing key.
        missing: &'static str,
        /// The result.
        result: &'static str,
    },
    /// It has torques that drive the arm, and no result that depends on them.
    IdleTorque,
    /// This key must be a list.
    NoList(&'static str),
    /// A list has an entry that is no number.
    NoNumber(&'static str),
    /// A list has not as many numbers as it must have.
    Length {
        /// Its key.
        key: &'static str,
        /// The number that it must have.
        expected: usize,
        /// The number that it has.
        found: usize,
    },
}

impl fmt::Display for StateFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StateFault::NoObject => write!(
                f,
                "a state is an object with `q`, `qd`, `qdd` and any of {}",
                results()
            ),
            StateFault::Remark(key) => write!(f, "`{key}` is a number"),
            StateFault::Unknown { key, meant } => {
                write!(f, "`{key}` is no key of a state\n  = help: ")?;
                if let Some(word) = meant {
                    write!(f, "did you mean `{word}`? ")?;
                }
                write!(f, "a state has `q`, `qd`, `qdd` and any of {}", results())
            }
            StateFault::Missing(key) => write!(f, "`{key}` is missing"),
            StateFault::MissingFor { missing, result } => {
                write!(f, "`{missing}` is missing, which `{result}` depends on")
            }
            StateFault::IdleTorque => write!(
                f,
                "`{TORQUE}` is what `forward_dynamics` reads, and the state does not give that\n  \
                 = help: torques that q, qd and qdd give are `tau`"
            ),
            StateFault::NoList(key) => write!(f, "`{key}` is not a list"),
            StateFault::NoNumber(key) => write!(f, "`{key}` has an entry that is no number"),
            StateFault::Length {
                key,
                expected,
                found,
            } => write!(f, "`{key}` has {found} numbers, not {expected}"),
        }
    }
}

impl std::error::Error for StateFault {}

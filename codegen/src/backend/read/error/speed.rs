//! Lines that do not compute what Coulomb friction reads of speeds.

use std::fmt;

/// Why a line does not give 1/√(q̇² + w²) of its joint.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SpeedFault {
    /// The value is another one.
    Value(String),
    /// Another function than the square root of this scalar is called.
    Call(String),
    /// The name is not that of its joint.
    Name {
        /// The name.
        name: String,
        /// The joint whose velocity is read, zero-based.
        joint: usize,
    },
    /// It stands behind one of a later joint, or twice.
    Order(String),
}

impl fmt::Display for SpeedFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SpeedFault::Value(value) => write!(
                f,
                "`{value}` is not one over the root of a velocity's square and a width's"
            ),
            SpeedFault::Call(path) => write!(f, "`{path}` is not `sqrt` of this scalar"),
            SpeedFault::Name { name, joint } => {
                write!(f, "`{name}` is not of joint {}", joint + 1)
            }
            SpeedFault::Order(name) => write!(f, "`{name}` is not in the order of the joints"),
        }
    }
}

impl std::error::Error for SpeedFault {}

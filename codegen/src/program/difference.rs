//! The first difference between two programs over literals.

use std::fmt;

use super::Lowered;

/// The first part in which two programs differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// The scalars.
    Scalar,
    /// Who computes the sines that are called.
    Library,
    /// The sines and cosines.
    Sines,
    /// The speeds that are read.
    Speeds,
    /// The number of operations.
    Operations,
    /// The number of results.
    Results,
    /// An operation, from zero.
    Operation(usize),
    /// A result, from zero.
    Result(usize),
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Difference::Scalar => f.write_str("the scalars differ"),
            Difference::Library => f.write_str("the libraries of sines differ"),
            Difference::Sines => f.write_str("the sines and cosines differ"),
            Difference::Speeds => f.write_str("what is read of speeds differs"),
            Difference::Operations => f.write_str("the number of operations differs"),
            Difference::Results => f.write_str("the number of results differs"),
            Difference::Operation(index) => write!(f, "operation t{} differs", index + 1),
            Difference::Result(index) => write!(f, "result {index} differs"),
        }
    }
}

impl std::error::Error for Difference {}

impl Lowered {
    /// Returns the first difference between two programs; `None` if they are equal.
    pub fn difference(&self, other: &Lowered) -> Option<Difference> {
        let mut steps = self.steps.iter().zip(&other.steps);
        let mut outputs = self.outputs.iter().zip(&other.outputs);
        match self == other {
            true => None,
            false if self.scalar != other.scalar => Some(Difference::Scalar),
            false if self.library != other.library => Some(Difference::Library),
            false if self.trig != other.trig => Some(Difference::Sines),
            false if self.speeds != other.speeds => Some(Difference::Speeds),
            false if self.steps.len() != other.steps.len() => Some(Difference::Operations),
            false if self.outputs.len() != other.outputs.len() => Some(Difference::Results),
            false => Some(match steps.position(|(a, b)| a != b) {
                Some(index) => Difference::Operation(index),
                None => Difference::Result(outputs.position(|(a, b)| a != b).unwrap_or(0)),
            }),
        }
    }
}

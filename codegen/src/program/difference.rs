//! The first difference between two programs over literals.

use std::fmt;

use super::{Code, Literal};
use crate::dag::{Dag, Id, Node};

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

impl Code {
    /// Returns the first difference between two programs; `None` if they are equal.
    pub fn difference(&self, other: &Code) -> Option<Difference> {
        let counts = [self, other].map(|code| code.dag.operations().count());
        match self == other {
            true => None,
            false if self.scalar != other.scalar => Some(Difference::Scalar),
            false if self.library != other.library => Some(Difference::Library),
            false if self.pairs != other.pairs => Some(Difference::Sines),
            false if self.speeds != other.speeds => Some(Difference::Speeds),
            false if counts[0] != counts[1] => Some(Difference::Operations),
            false if self.dag.outputs.len() != other.dag.outputs.len() => Some(Difference::Results),
            false => Some(self.first_difference(other)),
        }
    }

    /// Compares operations and results one by one: equal operations read equal ones before them.
    fn first_difference(&self, other: &Code) -> Difference {
        let operand = |dag: &Dag<Literal>, numbers: &[Option<usize>], id: Id| match dag.node(id) {
            Node::Apply(..) => Err(numbers[id as usize]),
            leaf => Ok(leaf.clone()),
        };
        let [ours, theirs] = [&self.dag, &other.dag];
        let numbers = [ours.numbers(), theirs.numbers()];
        let same = |a: Id, b: Id| operand(ours, &numbers[0], a) == operand(theirs, &numbers[1], b);
        let mut operations = ours.operations().zip(theirs.operations());
        let operation = operations
            .position(|((_, a, [x, y]), (_, b, [z, w]))| a != b || !same(x, z) || !same(y, w));
        let mut outputs = ours.outputs.iter().zip(&theirs.outputs);
        let result = outputs.position(|(a, b)| a.negative != b.negative || !same(a.node, b.node));
        match operation {
            Some(index) => Difference::Operation(index),
            None => Difference::Result(result.unwrap_or(0)),
        }
    }
}

//! The first difference between two pieces of code.

use std::fmt;

use super::{Code, Literal};
use crate::dag::{Dag, Id, Node};

/// The first part in which two pieces of code differ.
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
    /// Returns the first difference from other code; none if they compute the same, operation by
    /// operation, in whatever order their constants and inputs stand.
    pub fn difference(&self, other: &Code) -> Option<Difference> {
        let counts = [self, other].map(|code| code.dag.operations().count());
        let results = [self, other].map(|code| code.dag.outputs.len());
        let parts = [
            (self.scalar == other.scalar, Difference::Scalar),
            (self.library == other.library, Difference::Library),
            (self.pairs == other.pairs, Difference::Sines),
            (self.speeds == other.speeds, Difference::Speeds),
            (counts[0] == counts[1], Difference::Operations),
            (results[0] == results[1], Difference::Results),
        ];
        let differs = parts.iter().find(|(is_equal, _)| !is_equal);
        match differs {
            Some((_, difference)) => Some(*difference),
            None => self.first_difference(other),
        }
    }

    /// Compares operations and results one by one: equal operations read equal ones before them.
    fn first_difference(&self, other: &Code) -> Option<Difference> {
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
        let operation = operation.map(Difference::Operation);
        operation.or(result.map(Difference::Result))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::{Edge, Input, Operation};
    use crate::function::Argument;
    use crate::program::{Library, ScalarType};

    /// −((q̇₁ − 0) − q̈₂).
    fn code() -> Code {
        let input = |argument, joint| Node::Input(Input::Entry(argument, joint));
        let nodes = vec![
            input(Argument::Velocity, 0),
            Node::Constant(Literal(0.0)),
            Node::Apply(Operation::Sub, [0, 1]),
            input(Argument::Acceleration, 1),
            Node::Apply(Operation::Sub, [2, 3]),
        ];
        let outputs = vec![Edge {
            negative: true,
            node: 4,
        }];
        Code {
            scalar: ScalarType::F64,
            library: Library::Libm,
            pairs: Vec::new(),
            speeds: Vec::new(),
            dag: Dag { nodes, outputs },
        }
    }

    /// Whatever is changed, it is other code, and said where; but not the order of what is read.
    #[test]
    fn other_code_differs() {
        type Change = (fn(&mut Code), &'static str);
        let changes: [Change; 8] = [
            (|c| c.scalar = ScalarType::F32, "the scalars differ"),
            (
                |c| c.library = Library::Together,
                "the libraries of sines differ",
            ),
            (
                |c| c.dag.nodes[1] = Node::Constant(Literal(-0.0)),
                "operation t1 differs",
            ),
            (
                |c| c.dag.nodes[4] = Node::Apply(Operation::Add, [2, 3]),
                "operation t2 differs",
            ),
            (
                |c| c.dag.nodes[4] = Node::Apply(Operation::Sub, [3, 2]),
                "operation t2 differs",
            ),
            (
                |c| c.dag.nodes.push(Node::Apply(Operation::Mul, [4, 4])),
                "the number of operations differs",
            ),
            (|c| c.dag.outputs[0].negative = false, "result 0 differs"),
            (|c| c.dag.outputs.clear(), "the number of results differs"),
        ];
        for (change, words) in changes {
            let mut other = code();
            change(&mut other);
            let found = code().difference(&other).map(|found| found.to_string());
            assert_eq!(found.as_deref(), Some(words));
        }
        let mut other = code();
        other.dag.nodes.swap(0, 1);
        other.dag.nodes[2] = Node::Apply(Operation::Sub, [1, 0]);
        assert!(other != code());
        assert_eq!(code().difference(&other), None);
    }
}

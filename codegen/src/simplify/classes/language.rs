//! E-nodes: operations on classes, and leaves.

use std::fmt;

use dalembert_model::number::Exact;
use egg::{FromOp, Id, Language};

use super::ClassId;
use crate::graph::Fingerprint;
use crate::program::Input;

/// The operator of a [`Way`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Operator {
    /// a + b
    Sum,
    /// a − b
    Difference,
    /// a · b
    Product,
    /// a / b; these come from formulas alone.
    Quotient,
}

/// An operation that computes a class from two others.
///
/// The operands stand for their canonical prints, and the result for the class up to
/// sign: signs are found again when a graph is built. Operands ascend, but for those of
/// a quotient.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Way {
    /// The operator.
    pub operator: Operator,
    /// Returns the operands.
    pub operands: [ClassId; 2],
}

impl Way {
    /// Makes an operation on two classes. Discovery makes one for each pair that it looks at.
    #[inline]
    pub(crate) fn new(operator: Operator, [a, b]: [ClassId; 2]) -> Way {
        let operands = match operator != Operator::Quotient && b < a {
            true => [b, a],
            false => [a, b],
        };
        Way { operator, operands }
    }
}

impl Operator {
    /// Returns the print of the result for operands with these prints.
    pub(crate) fn print(self, [a, b]: [&Fingerprint; 2]) -> Fingerprint {
        match self {
            Operator::Sum => a.add(b),
            Operator::Difference => a.sub(b),
            Operator::Product => a.mul(b),
            Operator::Quotient => a.div(b),
        }
    }
}

/// An e-node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum ENode {
    /// An operation.
    Way(Way),
    /// A value that costs nothing, by its index.
    Leaf(u32),
}

impl ENode {
    /// Returns the operator; none of a leaf.
    pub(crate) fn operator(&self) -> Option<Operator> {
        match self {
            ENode::Way(way) => Some(way.operator),
            ENode::Leaf(_) => None,
        }
    }
}

impl Language for ENode {
    type Discriminant = Option<Operator>;

    /// Up to sign, sums and differences are one kind.
    fn discriminant(&self) -> Option<Operator> {
        match self.operator() {
            Some(Operator::Difference) => Some(Operator::Sum),
            operator => operator,
        }
    }

    fn matches(&self, other: &Self) -> bool {
        self.discriminant() == other.discriminant()
    }

    fn children(&self) -> &[Id] {
        match self {
            ENode::Way(way) => &way.operands,
            ENode::Leaf(_) => &[],
        }
    }

    fn children_mut(&mut self) -> &mut [Id] {
        match self {
            ENode::Way(way) => &mut way.operands,
            ENode::Leaf(_) => &mut [],
        }
    }
}

/// The words of patterns.
const OPERATORS: [(&str, Operator); 3] = [
    ("±", Operator::Sum),
    ("*", Operator::Product),
    ("/", Operator::Quotient),
];

impl fmt::Display for ENode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = |(_, operator): &&(&str, Operator)| self.discriminant() == Some(*operator);
        let found = OPERATORS.iter().find(word);
        f.write_str(found.map_or("leaf", |(word, _)| word))
    }
}

impl FromOp for ENode {
    type Error = String;

    fn from_op(op: &str, children: Vec<Id>) -> Result<Self, String> {
        let operator = OPERATORS.iter().find(|(word, _)| *word == op);
        let operands = <[Id; 2]>::try_from(children);
        let (Some(&(_, operator)), Ok(operands)) = (operator, operands) else {
            return Err(format!("expected ±, * or / of two operands, got `{op}`"));
        };
        Ok(ENode::Way(Way { operator, operands }))
    }
}

/// A value that costs nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Leaf {
    /// An exact constant.
    Constant(Exact),
    /// Returns an input.
    Input(Input),
}

//! The operations, in any scalar, and their derivatives.

use dalembert_model::number::Exact;
use dalembert_model::scalar::{Divide, Scalar};

/// The operations of emitted code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operation {
    /// left + right
    Add,
    /// left − right
    Sub,
    /// left · right
    Mul,
    /// left / right
    Div,
    /// left · right, not rounded: the sum or difference that takes it rounds once (`fusion`).
    Fused,
}

impl Operation {
    /// Every operation.
    pub const ALL: [Operation; 5] = [
        Operation::Add,
        Operation::Sub,
        Operation::Mul,
        Operation::Div,
        Operation::Fused,
    ];

    /// Returns the operation of a symbol.
    pub fn from_symbol(symbol: char) -> Option<Operation> {
        let mut all = Operation::ALL.into_iter();
        all.find(|operation| operation.symbol() == symbol)
    }

    /// Returns its symbol, Rust's but for a fused product, which has none there.
    pub fn symbol(self) -> char {
        match self {
            Operation::Add => '+',
            Operation::Sub => '-',
            Operation::Mul => '*',
            Operation::Div => '/',
            Operation::Fused => '×',
        }
    }

    /// Computes the operation in a scalar.
    #[inline]
    pub fn apply<S: Divide>(self, left: &S, right: &S) -> S {
        match self {
            Operation::Add => left.add(right),
            Operation::Sub => left.sub(right),
            Operation::Mul | Operation::Fused => left.mul(right),
            Operation::Div => left.div(right),
        }
    }

    /// `None` for a quotient by zero, or by what is not a rational number.
    pub(crate) fn exactly(self, left: &Exact, right: &Exact) -> Option<Exact> {
        Some(match self {
            Operation::Add => left.add(right),
            Operation::Sub => left.sub(right),
            Operation::Mul | Operation::Fused => left.mul(right),
            Operation::Div => return left.divide(right.as_rational()?),
        })
    }

    pub(crate) fn commutes(self) -> bool {
        matches!(self, Operation::Add | Operation::Mul | Operation::Fused)
    }

    /// Returns the result's adjoint passed on to the left and to the right operand.
    #[inline]
    pub fn parts<S: Divide>(self, adjoint: &S, left: &S, right: &S) -> [S; 2] {
        match self {
            Operation::Add => [adjoint.clone(), adjoint.clone()],
            Operation::Sub => [adjoint.clone(), adjoint.neg()],
            Operation::Mul | Operation::Fused => [adjoint.mul(right), adjoint.mul(left)],
            // ∂(x/y) = ∂x/y − (x/y)·∂y/y
            Operation::Div => {
                let by_left = adjoint.div(right);
                let by_right = by_left.mul(&left.div(right)).neg();
                [by_left, by_right]
            }
        }
    }
}

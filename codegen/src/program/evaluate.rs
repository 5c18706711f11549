//! The one way to run straight-line code in a scalar.

use dalembert_model::number::Exact;
use dalembert_model::scalar::{Divide, Scalar};

use super::fused::fusion;
use super::{Input, Operand, Operation, Output, Program, Step};

/// Returns the outputs of steps in a scalar, from the values of inputs and constants;
/// `None` if one of these has none, or a step reads what is not computed yet.
pub(crate) fn evaluate<'c, C, I, S: Divide>(
    steps: &'c [Step<C, I>],
    outputs: impl IntoIterator<Item = &'c Output<C, I>>,
    mut input: impl FnMut(&'c I) -> Option<S>,
    mut constant: impl FnMut(&'c C) -> Option<S>,
) -> Option<Vec<S>> {
    let mut values: Vec<S> = Vec::with_capacity(steps.len());
    let mut read = |operand: &'c Operand<C, I>, values: &[S]| match operand {
        Operand::Input(name) => input(name),
        Operand::Constant(value) => constant(value),
        Operand::Step(index) => values.get(*index).cloned(),
    };
    for (index, step) in steps.iter().enumerate() {
        let value = match fusion(steps, index) {
            None => {
                let (left, right) = (read(&step.left, &values)?, read(&step.right, &values)?);
                step.operation.apply(&left, &right)
            }
            Some(fusion) => {
                let (left, right) = (&fusion.product.left, &fusion.product.right);
                let (left, right) = (read(left, &values)?, read(right, &values)?);
                fusion.apply(&left, &right, &read(fusion.addend, &values)?)
            }
        };
        values.push(value);
    }
    let outputs = outputs.into_iter().map(|output| {
        let value = read(&output.value, &values)?;
        Some(if output.negative { value.neg() } else { value })
    });
    outputs.collect()
}

impl Operation {
    /// Returns the operation in a scalar.
    #[inline]
    pub fn apply<S: Divide>(self, left: &S, right: &S) -> S {
        match self {
            Operation::Add => left.add(right),
            Operation::Sub => left.sub(right),
            Operation::Mul | Operation::Fused => left.mul(right),
            Operation::Div => left.div(right),
        }
    }

    /// Returns the operation on constants; none of a quotient by what is no rational number, or
    /// zero.
    pub(crate) fn exactly(self, left: &Exact, right: &Exact) -> Option<Exact> {
        Some(match self {
            Operation::Add => left.add(right),
            Operation::Sub => left.sub(right),
            Operation::Mul | Operation::Fused => left.mul(right),
            Operation::Div => return left.divide(right.as_rational()?),
        })
    }

    /// Returns whether the operands may be exchanged.
    pub(crate) fn commutes(self) -> bool {
        matches!(self, Operation::Add | Operation::Mul | Operation::Fused)
    }
}

impl Program {
    /// Returns the outputs in a scalar; as `evaluate`.
    pub fn evaluate<S: Divide>(
        &self,
        input: impl FnMut(&Input) -> Option<S>,
        constant: impl FnMut(&Exact) -> Option<S>,
    ) -> Option<Vec<S>> {
        evaluate(&self.steps, &self.outputs, input, constant)
    }
}

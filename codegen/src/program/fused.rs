//! Programs with fused products, as [`crate::dag::fusion`] says.

use super::{Operand, Operation, Program, Step};

/// Returns whether a step is a sum or a difference with the fused product before it.
pub(crate) fn takes_product<C, I>(steps: &[Step<C, I>], index: usize) -> bool {
    let before = index.checked_sub(1).and_then(|before| steps.get(before));
    let (Some(product), Some(step)) = (before, steps.get(index)) else {
        return false;
    };
    let reads =
        |operand: &Operand<C, I>| matches!(operand, Operand::Step(read) if *read + 1 == index);
    product.operation == Operation::Fused
        && matches!(step.operation, Operation::Add | Operation::Sub)
        && (reads(&step.left) || reads(&step.right))
}

/// Returns whether a step's rounding can lose what is below the least normal number: that of a
/// product, a quotient, and a sum with a fused product. A sum of two floats cannot.
pub(crate) fn underflows<C, I>(steps: &[Step<C, I>], index: usize) -> bool {
    match steps.get(index).map(|step| step.operation) {
        Some(Operation::Mul | Operation::Div) => true,
        Some(Operation::Add | Operation::Sub) => takes_product(steps, index),
        Some(Operation::Fused) | None => false,
    }
}

impl Program {
    /// Returns the program with its products fused.
    #[must_use]
    pub fn fused(&self) -> Program {
        self.with_code(&self.graph().fused())
    }

    /// Returns whether the program has fused products.
    pub fn fuses(&self) -> bool {
        let mut steps = self.steps.iter();
        steps.any(|step| step.operation == Operation::Fused)
    }
}

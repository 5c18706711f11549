//! Maps programs to other constants and inputs, and renumbers the steps that operands read.

use super::{Operand, Output, Step};

impl<C, I> Operand<C, I> {
    /// Maps the operand's constant or input.
    pub fn map<D, J>(&self, constant: impl Fn(&C) -> D, input: impl Fn(&I) -> J) -> Operand<D, J> {
        match self {
            Operand::Input(name) => Operand::Input(input(name)),
            Operand::Constant(value) => Operand::Constant(constant(value)),
            Operand::Step(index) => Operand::Step(*index),
        }
    }
}

impl<C: Clone, I: Clone> Operand<C, I> {
    /// Returns the operand where steps have moved to these places.
    pub(crate) fn moved(&self, place: &[usize]) -> Self {
        match self {
            Operand::Step(step) => Operand::Step(place.get(*step).copied().unwrap_or(usize::MAX)),
            other => other.clone(),
        }
    }
}

impl<C, I> Step<C, I> {
    /// Maps the operands of a step.
    pub fn map<D, J>(&self, constant: impl Fn(&C) -> D, input: impl Fn(&I) -> J) -> Step<D, J> {
        Step {
            operation: self.operation,
            left: self.left.map(&constant, &input),
            right: self.right.map(&constant, &input),
        }
    }
}

impl<C, I> Output<C, I> {
    /// Maps the value of a result.
    pub fn map<D, J>(&self, constant: impl Fn(&C) -> D, input: impl Fn(&I) -> J) -> Output<D, J> {
        Output {
            negative: self.negative,
            value: self.value.map(constant, input),
        }
    }
}

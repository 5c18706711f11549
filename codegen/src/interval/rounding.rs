//! What rounding costs straight-line code over intervals.
//!
//! **Soundness.** Every operation gives (x ∘ y)(1 + δ) + η. Each is widened by
//! that, so the intervals hold what is computed *and* what is exact. The error of a
//! result is exactly Σ own error of a step · adjoint of the step, with adjoints
//! that mix computed and exact operands; both are in the intervals here, so the
//! sum bounds the whole error, not only its first order.

use super::Interval;
use crate::program::{Operation, Step};

/// Intervals that hold what is exact and what is computed, and each step's own
/// rounding.
pub(crate) struct Forward {
    /// Step by step.
    pub values: Vec<Interval>,
    /// How far the two can be apart at the step itself.
    pub own: Vec<f64>,
}

/// Runs steps with every operation widened by its `rounding`, from what its exact
/// result may be. `operands`: what a step reads, from the values before it.
pub(crate) fn forward<C: PartialEq, I: PartialEq>(
    steps: &[Step<C, I>],
    operands: impl Fn(usize, &[Interval]) -> [Interval; 2],
    rounding: impl Fn(usize, Interval) -> f64,
) -> Forward {
    let mut values: Vec<Interval> = Vec::with_capacity(steps.len());
    let mut own = Vec::with_capacity(steps.len());
    for (index, step) in steps.iter().enumerate() {
        let [x, y] = operands(index, &values);
        let exact = match step.operation {
            // Both are the same number.
            Operation::Mul | Operation::Fused if step.left == step.right => x.square(),
            operation => operation.apply(&x, &y),
        };
        let rounding = rounding(index, exact);
        values.push(exact.widened(rounding));
        own.push(rounding);
    }
    Forward { values, own }
}

/// Returns the largest power of two that is at most x; x if that is no normal number.
/// Rounding a number that is no larger than x moves it by at most this times u.
pub(crate) fn binade(x: f64) -> f64 {
    match x.is_normal() && x > 0.0 {
        true => f64::from_bits(x.to_bits() & !((1 << 52) - 1)),
        false => x,
    }
}

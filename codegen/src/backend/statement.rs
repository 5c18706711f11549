//! One operation as one line.

use crate::program::fused::{Fusion, fusion};
use crate::program::text::input_name;
use crate::program::{Literal, Lowered, Operand, Operation, ScalarType};

/// `let t3 = t1 * s2;`, or `let t5 = t3.mul_add(s2, t1);` for a sum and the product
/// that it takes, which has no line of its own.
pub(super) fn statement(code: &Lowered, index: usize) -> Option<String> {
    let (steps, scalar) = (&code.steps, code.scalar);
    let step = steps.get(index)?;
    if step.operation == Operation::Fused {
        return None;
    }
    let value = match fusion(steps, index) {
        None => {
            let (left, right) = (operand(&step.left, scalar), operand(&step.right, scalar));
            format!("{left} {} {right}", step.operation.symbol())
        }
        Some(Fusion {
            product,
            negative,
            addend,
            minus,
        }) => {
            let left = operand(&product.left, scalar);
            let left = match negative {
                true => format!("(-{left})"),
                false => left,
            };
            let right = operand(&product.right, scalar);
            let sign = if minus { "-" } else { "" };
            format!("{left}.mul_add({right}, {sign}{})", operand(addend, scalar))
        }
    };
    Some(format!("let t{} = {value};", index + 1))
}

/// The last step that reads each step; past the end for results.
pub(super) fn last_uses(code: &Lowered) -> Vec<usize> {
    let mut last = vec![0; code.steps.len()];
    for (index, step) in code.steps.iter().enumerate() {
        for operand in [&step.left, &step.right] {
            if let Operand::Step(read) = operand {
                last[*read] = index;
            }
        }
    }
    for output in &code.outputs {
        if let Operand::Step(read) = output.value {
            last[read] = usize::MAX;
        }
    }
    last
}

/// How a line names what it reads.
pub(super) fn operand(operand: &Operand<Literal>, scalar: ScalarType) -> String {
    match operand {
        Operand::Input(input) => input_name(*input),
        Operand::Constant(value) => value.text(scalar),
        Operand::Step(index) => format!("t{}", index + 1),
    }
}

//! One operation as one line.

use crate::program::text::input_name;
use crate::program::{Operand, Program, ScalarType, Step};

/// `let t3 = t1 * s2;`
pub(super) fn statement(index: usize, step: &Step, scalar: ScalarType) -> String {
    let (left, right) = (operand(&step.left, scalar), operand(&step.right, scalar));
    let symbol = step.operation.symbol();
    format!("let t{} = {left} {symbol} {right};", index + 1)
}

/// The last step that reads each step; past the end for results.
pub(super) fn last_uses(program: &Program) -> Vec<usize> {
    let mut last = vec![0; program.steps.len()];
    for (index, step) in program.steps.iter().enumerate() {
        for operand in [&step.left, &step.right] {
            if let Operand::Step(read) = operand {
                last[*read] = index;
            }
        }
    }
    for output in &program.outputs {
        if let Operand::Step(read) = output.value {
            last[read] = usize::MAX;
        }
    }
    last
}

/// How a line names what it reads.
pub(super) fn operand(operand: &Operand, scalar: ScalarType) -> String {
    match operand {
        Operand::Input(input) => input_name(*input),
        Operand::Constant(value) => scalar.literal(value),
        Operand::Step(index) => format!("t{}", index + 1),
    }
}

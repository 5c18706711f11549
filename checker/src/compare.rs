//! The text is the exact program: operation by operation, each literal the float nearest to its
//! constant.

use crate::identity::exact::Exact;
use crate::identity::program::{Operand, Program};
use crate::read::number;

/// Compares a text with an exact program.
///
/// # Errors
/// The first operation or result that differs.
pub fn compare(text: &Program<f64>, exact: &Program<Exact>, is_single: bool) -> Result<(), String> {
    let counts = |steps: usize, results: usize| format!("{steps} operations and {results} results");
    let own = [text.steps.len(), text.outputs.len()];
    let other = [exact.steps.len(), exact.outputs.len()];
    if own != other {
        let (own, other) = (counts(own[0], own[1]), counts(other[0], other[1]));
        return Err(format!("{own}, not {other} as claimed"));
    }
    for (index, (own, other)) in text.steps.iter().zip(&exact.steps).enumerate() {
        let mut pairs = own.1.iter().zip(&other.1);
        if own.0 != other.0 || !pairs.all(|(own, other)| is_same(own, other, is_single)) {
            return Err(format!(
                "operation {} is not the one that is claimed",
                index + 1
            ));
        }
    }
    for (index, (own, other)) in text.outputs.iter().zip(&exact.outputs).enumerate() {
        if own.0 != other.0 || !is_same(&own.1, &other.1, is_single) {
            return Err(format!(
                "result {} is not the one that is claimed",
                index + 1
            ));
        }
    }
    Ok(())
}

/// Returns true for the text of a literal that is the float nearest to a value.
pub(crate) fn is_literal(text: &str, value: &Exact, is_single: bool) -> bool {
    number(text, is_single).is_some_and(|own| value.is_nearest(own, is_single))
}

fn is_same(own: &Operand<f64>, other: &Operand<Exact>, is_single: bool) -> bool {
    match (own, other) {
        (Operand::Constant(literal), Operand::Constant(constant)) => {
            constant.is_nearest(*literal, is_single)
        }
        (Operand::Step(own), Operand::Step(other)) => own == other,
        (Operand::Entry(own, index), Operand::Entry(other, at)) => (own, index) == (other, at),
        (Operand::Sine(own, is_sine), Operand::Sine(other, is_other)) => {
            (own, is_sine) == (other, is_other)
        }
        (Operand::Speed(own), Operand::Speed(other)) => own == other,
        _ => false,
    }
}

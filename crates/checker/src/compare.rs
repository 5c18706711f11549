//! The text is the exact program: operation by operation, each literal the float nearest to its
//! constant.

use std::cell::RefCell;
use std::collections::HashMap;

use crate::identity::exact::Exact;
use crate::program::{Operand, Program};
use crate::read::number;
use crate::work::Work;

/// Nanoseconds for the comparison of a constant with a literal, whatever their digits are.
const COMPARED: u64 = 20_000;

/// The literals that were compared with each constant: no pair is compared twice.
#[derive(Debug, Default)]
pub(crate) struct Literals(RefCell<HashMap<(usize, u64, bool), bool>>);

impl Literals {
    fn are_same(&self, value: &Exact, literal: f64, is_single: bool, work: &Work) -> bool {
        let key = (value.address(), literal.to_bits(), is_single);
        if let Some(known) = self.0.borrow().get(&key) {
            return *known;
        }
        let cost = if literal == 0.0 { 10 } else { 1 };
        let is_same = work.spend(cost, COMPARED).is_ok() && value.is_nearest(literal, is_single);
        self.0.borrow_mut().insert(key, is_same);
        is_same
    }
}

pub(crate) fn compare(
    text: &Program<f64>,
    exact: &Program<Exact>,
    is_single: bool,
    (literals, work): (&Literals, &Work),
) -> Result<(), String> {
    let counts = |steps: usize, results: usize| format!("{steps} operations and {results} results");
    let text_counts = counts(text.steps.len(), text.outputs.len());
    let exact_counts = counts(exact.steps.len(), exact.outputs.len());
    if text_counts != exact_counts {
        return Err(format!("{text_counts}, not {exact_counts} as claimed"));
    }
    let same = |(operand, other): (&Operand<f64>, &Operand<Exact>)| match (operand, other) {
        (Operand::Constant(literal), Operand::Constant(other)) => {
            literals.are_same(other, *literal, is_single, work)
        }
        _ => is_same(operand, other),
    };
    let mut steps = text.steps.iter().zip(&exact.steps);
    let step =
        steps.position(|(step, other)| step.0 != other.0 || !step.1.iter().zip(&other.1).all(same));
    let mut results = text.outputs.iter().zip(&exact.outputs);
    let result =
        results.position(|(result, other)| result.0 != other.0 || !same((&result.1, &other.1)));
    let (what, index) = match (step, result) {
        (Some(index), _) => ("operation", index),
        (None, Some(index)) => ("result", index),
        (None, None) => return Ok(()),
    };
    let number = index + 1;
    Err(format!(
        "{what} {number} of this function is not the one that is claimed"
    ))
}

pub(crate) fn is_literal(text: &str, value: &Exact, is_single: bool) -> bool {
    number(text, is_single).is_some_and(|literal| value.is_nearest(literal, is_single))
}

fn is_same(operand: &Operand<f64>, other: &Operand<Exact>) -> bool {
    match (operand, other) {
        (Operand::Entry(place, index), Operand::Entry(other, at)) => (place, index) == (other, at),
        (Operand::Sine(joint, is_sine), Operand::Sine(other, is_other)) => {
            (joint, is_sine) == (other, is_other)
        }
        (Operand::Step(number), Operand::Step(other))
        | (Operand::Speed(number), Operand::Speed(other)) => number == other,
        _ => false,
    }
}

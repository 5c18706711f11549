//! Multiples of values that other values could be replaced by.
//!
//! An edit puts a value or a constant in a value's place. For one operation a multiple of a
//! value would do as well, and often runs much more alike. So before each value stands the
//! multiple of an earlier one that is nearest to it. Nothing reads it, and it costs nothing,
//! until an edit puts it in the value's place.

use super::columns::{Nodes, short};
use super::fit::dot;
use crate::approximate::motions::Motions;
use crate::program::{Operand, Operation, Program, Step};
use crate::states::JointState;
use dalembert_model::number::Exact;
use dalembert_model::number::Rational;

/// Values that run less alike are no use.
const LEAST: f64 = 0.6;

/// The places of spares before a step of a program.
pub(super) const MOST: usize = 2;

/// Adds spare products to a program.
pub(super) fn spared(program: &Program, motions: &Motions, states: &[JointState]) -> Program {
    let nodes = Nodes::new(program, states);
    let columns = nodes.run(&vec![None; nodes.len()]);
    let directions: Vec<(Vec<f64>, f64)> = columns
        .chunks_exact(nodes.samples)
        .map(|column| {
            let mut column = column.to_vec();
            motions.monomials(&mut column);
            let size = dot(&column, &column).sqrt();
            (column, size)
        })
        .collect();
    let inputs = nodes.inputs.len();
    let mut place: Vec<usize> = Vec::with_capacity(program.steps.len());
    let mut steps: Vec<Step> = Vec::new();
    for (index, step) in program.steps.iter().enumerate() {
        let node = inputs + index;
        let (mine, size) = &directions[node];
        let mut alike: Vec<(f64, usize, f64)> = Vec::new();
        let is_scaled = step.operation == Operation::Mul
            && [&step.left, &step.right]
                .iter()
                .any(|operand| matches!(operand, Operand::Constant(_)));
        if !is_scaled {
            for (other, (theirs, length)) in directions[..node].iter().enumerate() {
                let product = dot(mine, theirs);
                let cosine = product / (size * length);
                if cosine.abs() > LEAST {
                    alike.push((cosine.abs(), other, product / (length * length)));
                }
            }
        }
        alike.sort_by(|a, b| b.0.total_cmp(&a.0));
        alike.truncate(MOST);
        for (_, other, scale) in alike {
            let right = match other.checked_sub(inputs) {
                Some(step) => Operand::Step(place[step]),
                None => Operand::Input(nodes.inputs[other]),
            };
            let scale = Rational::from_float(short(scale)).unwrap_or_default();
            steps.push(Step {
                operation: Operation::Mul,
                left: Operand::Constant(Exact::from(scale)),
                right,
            });
        }
        place.push(steps.len());
        steps.push(Step {
            operation: step.operation,
            left: step.left.moved(&place),
            right: step.right.moved(&place),
        });
    }
    let outputs = program.outputs.iter().map(|output| {
        let mut output = output.clone();
        output.value = output.value.moved(&place);
        output
    });
    Program {
        outputs: outputs.collect(),
        steps,
        ..program.clone()
    }
}

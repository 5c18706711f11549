//! Largest values times largest adjoints.
//!
//! **Soundness.** For each node let V ≥ |x|, A ≥ |a| over the box, a the
//! adjoint at exact values. Forwards, E ≥ |x̂ − x| follows node by node:
//! |x̂ ∘ ŷ| ≤ V + δ with δ = E_x + E_y for a sum and
//! δ = V_x·E_y + V_y·E_x + E_x·E_y for a product x·y, so the node's own
//! rounding is r ≤ u·(V + δ) + η, or half an ulp of V + δ, and E = δ + r; a product
//! that a sum takes has none. Backwards, D ≥ |ā − a|:
//! a product's ā passes on ā·y to x and ā·x̂ to y, so with |ā| ≤ A + D
//!
//! - D_x grows by D·V_y
//! - D_y grows by D·V_x + (A + D)·E_x
//!
//! and a sum passes D on. The error of an output is at most Σ (A + D)·r.
//! Sums here have no negative terms: a few thousand roundings are made up for
//! by a factor.

use super::extremes::Extremes;
use super::intervals::{Constants, is_exact, read};
use super::{Rounding, note};
use crate::bound::input_box::InputBox;
use crate::interval::Interval;
use crate::interval::rounding::binade;
use crate::program::fused::underflows;
use crate::program::scalar_type::underflow;
use crate::program::{Operand, Operation, Program, ScalarType};

/// For the roundings of this bound itself.
const ROUNDINGS: f64 = 1.0 + 1e-10;

/// V and E of an operand.
#[derive(Clone, Copy)]
struct Known {
    value: f64,
    error: f64,
}

/// Bounds over the box of the extremes, one an output.
pub(super) fn rounding(
    program: &Program,
    scalar: ScalarType,
    constants: &Constants,
    limits: &InputBox,
    extremes: &Extremes,
) -> Vec<Rounding> {
    let u = scalar.unit_roundoff();
    let mut errors: Vec<f64> = Vec::with_capacity(program.steps.len());
    let mut own = Vec::with_capacity(program.steps.len());
    let known = |operand: &Operand, literal: Option<(Interval, f64)>, errors: &[f64]| {
        let (interval, error) = match (operand, literal) {
            (Operand::Step(index), _) => {
                return Known {
                    value: extremes.values[*index],
                    error: errors[*index],
                };
            }
            (_, Some(literal)) => literal,
            (other, None) => read(other, &[], scalar, constants, limits),
        };
        Known {
            value: interval.magnitude(),
            error,
        }
    };
    for (index, (step, [left, right])) in program.steps.iter().zip(constants.steps()).enumerate() {
        let x = known(&step.left, *left, &errors);
        let y = known(&step.right, *right, &errors);
        let moved = match step.operation {
            Operation::Add | Operation::Sub => x.error + y.error,
            Operation::Mul | Operation::Fused => {
                x.value * y.error + y.value * x.error + x.error * y.error
            }
            Operation::Div => f64::INFINITY,
        };
        let eta = match underflows(&program.steps, index) {
            true => underflow(scalar),
            false => 0.0,
        };
        let rounding = match is_exact(step, &constants.steps()[index]) {
            true => eta,
            false => u * binade((extremes.values[index] + moved) * ROUNDINGS) + eta,
        };
        errors.push((moved + rounding) * ROUNDINGS);
        own.push(rounding * ROUNDINGS);
    }
    let mut bounds = Vec::with_capacity(program.outputs.len());
    for (output, adjoints) in program.outputs.iter().zip(&extremes.adjoints) {
        let mut bound = Rounding::default();
        let mut off = vec![0.0; program.steps.len()];
        // What the adjoints of sines can be off.
        let mut inputs = vec![0.0; adjoints.sines.len()];
        if let Operand::Constant(_) = output.value {
            let error = known(&output.value, None, &errors).error;
            note(&mut bound, &output.value, error);
        }
        for index in (0..program.steps.len()).rev() {
            let (exact, off_here) = (adjoints.steps[index], off[index]);
            let mixed = exact + off_here;
            if mixed == 0.0 {
                continue;
            }
            bound.arithmetic += mixed * own[index];
            let step = &program.steps[index];
            let [left, right] = constants.steps()[index];
            let x = known(&step.left, left, &errors);
            let y = known(&step.right, right, &errors);
            // What a constant's error counts with, and what is off.
            let (parts, offs) = match step.operation {
                Operation::Add | Operation::Sub => ([mixed; 2], [off_here; 2]),
                Operation::Mul | Operation::Fused => (
                    [mixed * y.value, mixed * (x.value + x.error)],
                    [off_here * y.value, off_here * x.value + mixed * x.error],
                ),
                Operation::Div => ([f64::INFINITY; 2], [f64::INFINITY; 2]),
            };
            for ((operand, of), (part, off_there)) in [(&step.left, x), (&step.right, y)]
                .into_iter()
                .zip(parts.into_iter().zip(offs))
            {
                match operand {
                    Operand::Step(before) => off[*before] += off_there,
                    Operand::Constant(_) => bound.arithmetic += part * of.error,
                    Operand::Input(input) => {
                        let sines = adjoints.sines.iter().position(|(known, _)| known == input);
                        if let Some(sine) = sines {
                            inputs[sine] += off_there;
                        }
                    }
                }
            }
        }
        for ((input, exact), off) in adjoints.sines.iter().zip(inputs) {
            let (_, error) = read(&Operand::Input(*input), &[], scalar, constants, limits);
            bound.sincos += (exact + off) * error;
        }
        bound.arithmetic *= ROUNDINGS;
        bound.sincos *= ROUNDINGS;
        bounds.push(bound);
    }
    bounds
}

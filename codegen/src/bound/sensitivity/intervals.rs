//! Adjoints in interval arithmetic over sub-boxes.
//!
//! **Soundness.** The intervals contain x̂ *and* x ([`rounding`]), and adjoints
//! computed from them contain the mixed ones of the [model](super): the sum bounds
//! the whole error, not only its first order.
//!
//! The dependency of values on common angles is lost: for programs that were
//! searched, the bound is hundreds of times what is seen unless the box is
//! small. For large errors, as those of coarse polynomials for sines, it is the
//! better one.

use dalembert_model::number::Exact;

use super::{Rounding, note};
use crate::bound::input_box::InputBox;
use crate::bound::subdivide::sub_boxes;
use crate::interval::Interval;
use crate::interval::rounding::{self, Forward, binade};
use crate::program::adjoint::{Leaf, backward};
use crate::program::fused::underflows;
use crate::program::scalar_type::underflow;
use crate::program::{Input, Operand, Operation, Program, ScalarType, Speed, Step};
use crate::sincos::AngleKernel;
use crate::sincos::proof::Errors;

/// Bounds over a box, one an output: the worst of at most `boxes` sub-boxes,
/// which halve the positions in turn.
pub(super) fn rounding(
    program: &Program,
    scalar: ScalarType,
    constants: &Constants,
    limits: &InputBox,
    boxes: usize,
) -> Vec<Rounding> {
    let mut worst = vec![Rounding::default(); program.outputs.len()];
    for sub in sub_boxes(program, limits, boxes) {
        for (worst, here) in worst.iter_mut().zip(over(program, scalar, constants, &sub)) {
            *worst = worst.max(here);
        }
    }
    worst
}

/// The constants that steps read, with what rounding takes from them: exact
/// numbers are slow to bound, so it is done once and not in every sub-box.
/// And the errors of polynomials for sines, which hold in every sub-box.
pub(in crate::bound) struct Constants {
    steps: Vec<[Option<(Interval, f64)>; 2]>,
    sines: Vec<(usize, Errors)>,
    /// What 1/√(q̇² + w²) of a joint may be, as it is computed.
    speeds: Vec<(usize, Interval)>,
}

impl Constants {
    pub(in crate::bound) fn of(
        program: &Program,
        scalar: ScalarType,
        sines: &[AngleKernel],
    ) -> Constants {
        let found = |operand: &Operand| match operand {
            Operand::Constant(constant) => Some(rounded(constant, scalar)),
            _ => None,
        };
        let steps = program.steps.iter();
        Constants {
            steps: steps.map(|s| [found(&s.left), found(&s.right)]).collect(),
            sines: sines.iter().map(|sine| (sine.joint, sine.errors)).collect(),
            speeds: program
                .speeds
                .iter()
                .map(|own| speed(own, scalar))
                .collect(),
        }
    }

    /// Returns, of each step, its operands that are constants.
    pub(super) fn steps(&self) -> &[[Option<(Interval, f64)>; 2]] {
        &self.steps
    }

    /// Returns what is read of a joint's speed.
    fn speed(&self, joint: usize) -> Interval {
        let found = self.speeds.iter().find(|(known, _)| *known == joint);
        found.map_or(Interval::ALL, |(_, range)| *range)
    }

    /// Returns the proved error of a polynomial for a sine or cosine; `None` for a library's.
    fn sine(&self, input: Input) -> Option<f64> {
        let joint = input.angle()?;
        let (_, errors) = self.sines.iter().find(|(known, _)| *known == joint)?;
        Some(match input {
            Input::Sin(_) => errors.sin,
            _ => errors.cos,
        })
    }
}

/// Bounds 1/√(q̇² + w²) from zero, where the velocity has no end, to 1/w at rest, with the 3 u
/// that rounding may add and more.
fn speed(own: &Speed, scalar: ScalarType) -> (usize, Interval) {
    let most = 1.0 / Interval::exact(&own.square).low().sqrt();
    let most = most * (1.0 + 8.0 * scalar.unit_roundoff());
    (own.joint, Interval::new(0.0, most).unwrap_or(Interval::ALL))
}

/// Returns whether an operation does not round, but for underflow: a product with a
/// power of two, a value added to itself, a product that a sum takes.
pub(super) fn is_exact(step: &Step, constants: &[Option<(Interval, f64)>; 2]) -> bool {
    let power = |known: &Option<(Interval, f64)>| {
        known.is_some_and(|(constant, error)| {
            let x = constant.high();
            error == 0.0 && x.is_normal() && binade(x.abs()) == x.abs()
        })
    };
    match step.operation {
        Operation::Fused => true,
        Operation::Mul => constants.iter().any(power),
        Operation::Add => step.left == step.right,
        Operation::Sub | Operation::Div => false,
    }
}

/// Returns a constant with its literal, and how far they are apart.
fn rounded(constant: &Exact, scalar: ScalarType) -> (Interval, f64) {
    let exact = Interval::exact(constant);
    let rounded = Interval::point(scalar.round(constant));
    if exact == rounded {
        // Outward, the difference would be the least subnormal: too much for an
        // output that must be exact.
        return (exact, 0.0);
    }
    (exact.hull(rounded), (exact - rounded).magnitude())
}

/// Runs a program with every operation widened by its rounding.
pub(in crate::bound) fn forward(
    program: &Program,
    scalar: ScalarType,
    constants: &Constants,
    sub: &InputBox,
) -> Forward {
    let u = scalar.unit_roundoff();
    let operands = |index: usize, values: &[Interval]| {
        let value = |operand, known: Option<(Interval, f64)>| match known {
            Some((constant, _)) => constant,
            None => read(operand, values, scalar, constants, sub).0,
        };
        let (step, [left, right]) = (&program.steps[index], constants.steps[index]);
        [value(&step.left, left), value(&step.right, right)]
    };
    rounding::forward(&program.steps, operands, |index, exact| {
        let step = &program.steps[index];
        let eta = match underflows(&program.steps, index) {
            true => underflow(scalar),
            false => 0.0,
        };
        match is_exact(step, &constants.steps[index]) {
            true => eta,
            false => (u * binade(exact.magnitude())).next_up() + eta,
        }
    })
}

/// Returns an operand's interval and its own error.
pub(super) fn read(
    operand: &Operand,
    values: &[Interval],
    scalar: ScalarType,
    constants: &Constants,
    sub: &InputBox,
) -> (Interval, f64) {
    let u = scalar.unit_roundoff();
    match operand {
        Operand::Step(index) => (values[*index], 0.0),
        Operand::Constant(constant) => rounded(constant, scalar),
        Operand::Input(input @ (Input::Sin(_) | Input::Cos(_))) => {
            let exact = sub.input(*input);
            let size = exact.magnitude();
            let one_ulp = u * size.min(0.5) * 2.0;
            let error = match constants.sine(*input) {
                Some(error) => error.next_up(),
                None if size == 0.0 => 0.0,
                None => one_ulp.next_up(),
            };
            (exact.widened(error), error)
        }
        // Nothing is claimed of how far the code is off.
        Operand::Input(Input::PerSpeed(joint)) => (constants.speed(*joint), f64::INFINITY),
        Operand::Input(input) => (sub.input(*input), 0.0),
    }
}

/// Bounds over one sub-box.
fn over<'p>(
    program: &'p Program,
    scalar: ScalarType,
    constants: &Constants,
    sub: &InputBox,
) -> Vec<Rounding> {
    let Forward { values, own } = forward(program, scalar, constants, sub);
    let operands: Vec<[(Interval, f64); 2]> = program
        .steps
        .iter()
        .zip(&constants.steps)
        .map(|(step, [left, right])| {
            [(&step.left, left), (&step.right, right)].map(|(operand, known)| {
                known.unwrap_or_else(|| read(operand, &values, scalar, constants, sub))
            })
        })
        .collect();
    let mut bounds = Vec::with_capacity(program.outputs.len());
    for output in &program.outputs {
        let mut bound = Rounding::default();
        // One way to sum sines and cosines too: an error of an input counts
        // with its whole adjoint, not use by use.
        let mut inputs: Vec<(&'p Operand, f64, Interval)> = Vec::new();
        match &output.value {
            Operand::Step(top) => {
                let visit = |index: usize, adjoint: &Interval| {
                    let counts = *adjoint != Interval::ZERO;
                    if counts {
                        bound.arithmetic += (adjoint.magnitude() * own[index].next_up()).next_up();
                    }
                    counts
                };
                let leaf = |leaf: Leaf<'p, Exact, Input>, part: Interval| {
                    let error = operands[leaf.step][leaf.side].1;
                    let known = inputs.iter_mut().find(|(known, ..)| known == &leaf.operand);
                    match known {
                        Some(known) => known.2 = known.2 + part,
                        None if error > 0.0 => inputs.push((leaf.operand, error, part)),
                        None => {}
                    }
                };
                let values = |index: usize| operands[index].map(|(value, _)| value);
                backward(&program.steps, *top, values, visit, leaf);
            }
            other => {
                let (_, error) = read(other, &values, scalar, constants, sub);
                note(&mut bound, other, error);
            }
        }
        for (operand, error, adjoint) in inputs {
            note(&mut bound, operand, (error * adjoint.magnitude()).next_up());
        }
        // The sums above round up to a few hundred times themselves.
        bound.arithmetic *= 1.0 + 1e-12;
        bound.sincos *= 1.0 + 1e-12;
        bounds.push(bound);
    }
    bounds
}

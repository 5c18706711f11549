//! Adjoints in interval arithmetic over sub-boxes, sound as [`rounding`](crate::interval::rounding)
//! says.
//!
//! The dependency of values on common angles is lost: for programs that were searched, the bound is
//! hundreds of times what is seen unless the box is small. For large errors, as those of coarse
//! polynomials for sines, it is the better one.

use dalembert_model::number::Exact;

use super::Rounding;
use crate::bound::input_box::InputBox;
use crate::dag::{Id, Node};
use crate::interval::Interval;
use crate::interval::rounding::{self, Forward, binade};
use crate::program::scalar_type::underflow;
use crate::program::{Input, Operation, Program, ScalarType, Speed};
use crate::sincos::AngleKernel;
use crate::sincos::proof::Errors;

pub(super) fn rounding(
    constants: &Constants<'_>,
    limits: &InputBox,
    boxes: usize,
) -> Vec<Rounding> {
    let program = constants.program;
    let mut worst = vec![Rounding::default(); program.dag.outputs.len()];
    for sub in limits.sub_boxes(program, boxes) {
        for (worst, here) in worst.iter_mut().zip(over(constants, &sub)) {
            *worst = worst.each(here, f64::max);
        }
    }
    worst
}

/// Sines are libm's where there are no polynomials for them. The intervals contain the computed
/// values, not only the exact ones.
pub(crate) fn overflows(
    program: &Program,
    scalar: ScalarType,
    sines: &[AngleKernel],
    limits: &InputBox,
    boxes: usize,
) -> Vec<String> {
    let ids: Vec<_> = program.dag.operations().map(|(id, ..)| id).collect();
    let mut magnitudes = vec![0.0f64; ids.len()];
    let constants = Constants::new(program, scalar, sines);
    for sub in limits.sub_boxes(program, boxes) {
        let run = forward(&constants, &sub);
        for (most, id) in magnitudes.iter_mut().zip(&ids) {
            *most = most.max(run.values[*id as usize].magnitude());
        }
    }
    let largest = scalar.of(f64::MAX, f32::MAX.into());
    let steps = magnitudes.into_iter().enumerate();
    steps
        .filter(|(_, magnitude)| *magnitude > largest)
        .map(|(step, magnitude)| format!("t{} may reach {magnitude:e}: it may overflow", step + 1))
        .collect()
}

/// Rounded once, not in every sub-box: exact numbers are slow to bound.
pub(super) struct Constants<'p> {
    pub program: &'p Program,
    scalar: ScalarType,
    nodes: Vec<Option<(Interval, f64)>>,
    sines: Vec<(usize, Errors)>,
    /// What 1/√(q̇² + w²) of a joint may be, as it is computed.
    speeds: Vec<(usize, Interval)>,
}

impl<'p> Constants<'p> {
    pub(super) fn new(
        program: &'p Program,
        scalar: ScalarType,
        sines: &[AngleKernel],
    ) -> Constants<'p> {
        let found = |node: &Node| match node {
            Node::Constant(constant) => Some(rounded(constant, scalar)),
            _ => None,
        };
        let speeds = program.speeds.iter();
        Constants {
            program,
            scalar,
            nodes: program.dag.nodes.iter().map(found).collect(),
            sines: sines.iter().map(|sine| (sine.joint, sine.errors)).collect(),
            speeds: speeds.map(|own| speed(own, scalar)).collect(),
        }
    }

    pub(super) fn leaf(&self, id: Id, node: &Node, sub: &InputBox) -> (Interval, f64) {
        let input = match (self.nodes[id as usize], node) {
            (Some(known), _) => return known,
            (None, Node::Input(input)) => *input,
            (None, _) => return (Interval::ALL, f64::INFINITY),
        };
        match input {
            Input::Sin(_) | Input::Cos(_) => {
                let exact = sub.input(input);
                let size = exact.magnitude();
                let one_ulp = self.scalar.unit_roundoff() * size.min(0.5) * 2.0;
                let error = match self.sine(input) {
                    Some(error) => error.next_up(),
                    None if size == 0.0 => 0.0,
                    None => one_ulp.next_up(),
                };
                (exact.widened(error), error)
            }
            // Nothing is claimed of how far the code is off.
            Input::PerSpeed(joint) => (self.speed(joint), f64::INFINITY),
            Input::Entry(..) => (sub.input(input), 0.0),
        }
    }

    pub(super) fn rounding(&self, id: Id, size: f64) -> f64 {
        let dag = &self.program.dag;
        let eta = match dag.underflows(id) {
            true => underflow(self.scalar),
            false => 0.0,
        };
        match *dag.node(id) {
            Node::Apply(operation, operands) if !self.is_exact(operation, operands) => {
                (self.scalar.unit_roundoff() * binade(size)).next_up() + eta
            }
            _ => eta,
        }
    }

    /// Returns whether an operation does not round, but for underflow: a product with a
    /// power of two, a value added to itself, a product that a sum takes.
    fn is_exact(&self, operation: Operation, operands: [Id; 2]) -> bool {
        let power = |id: &Id| {
            self.nodes[*id as usize].is_some_and(|(constant, error)| {
                let x = constant.high();
                error == 0.0 && x.is_normal() && binade(x.abs()) == x.abs()
            })
        };
        match operation {
            Operation::Fused => true,
            Operation::Mul => operands.iter().any(power),
            Operation::Add => operands[0] == operands[1],
            Operation::Sub | Operation::Div => false,
        }
    }

    fn speed(&self, joint: usize) -> Interval {
        let found = self.speeds.iter().find(|(known, _)| *known == joint);
        found.map_or(Interval::ALL, |(_, range)| *range)
    }

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

fn forward(constants: &Constants<'_>, sub: &InputBox) -> Forward {
    let leaf = |id, node: &Node| constants.leaf(id, node, sub);
    rounding::forward(&constants.program.dag, leaf, |id, _, exact| {
        constants.rounding(id, exact.magnitude())
    })
}

/// The error of a leaf counts with its whole adjoint, not use by use.
fn over(constants: &Constants<'_>, sub: &InputBox) -> Vec<Rounding> {
    let Forward { values, own } = forward(constants, sub);
    let dag = &constants.program.dag;
    let mut adjoints = Vec::new();
    let mut bounds = Vec::with_capacity(dag.outputs.len());
    for output in &dag.outputs {
        dag.adjoints(output.node, &values, &mut adjoints);
        let mut bound = Rounding::default();
        for ((adjoint, own), node) in adjoints.iter().zip(&own).zip(&dag.nodes) {
            if *adjoint != Interval::ZERO && *own != 0.0 {
                bound.note(node, (adjoint.magnitude() * own.next_up()).next_up());
            }
        }
        // The sums above round up to a few hundred times themselves.
        bound.arithmetic *= 1.0 + 1e-12;
        bound.sincos *= 1.0 + 1e-12;
        bounds.push(bound);
    }
    bounds
}

//! Steps that may overflow inside the box: intervals over parts of it.

use dalembert_model::number::Exact;

use super::input_box::InputBox;
use crate::dag::Node;
use crate::interval::Interval;
use crate::interval::rounding::{Forward, forward};
use crate::program::{Input, Program, ScalarType};
use crate::sincos::AngleKernel;

/// Returns a sentence on each such step. The intervals contain the computed values, not only the
/// exact ones; sines are libm's where there are no polynomials for them.
pub(crate) fn overflows(
    program: &Program,
    scalar: ScalarType,
    sines: &[AngleKernel],
    limits: &InputBox,
    boxes: usize,
) -> Vec<String> {
    let u = scalar.unit_roundoff();
    // Rounded once, not in every part: exact numbers are slow to bound.
    let constants = program.dag.nodes.iter().map(|node| match node {
        Node::Constant(constant) => rounded(constant, scalar),
        _ => Interval::ALL,
    });
    let constants: Vec<Interval> = constants.collect();
    let sine = |joint: Option<usize>| {
        let own = sines.iter().find(|own| joint == Some(own.joint));
        own.map_or(2.0 * u, |own| own.errors.worst())
    };
    let speed = |joint: usize| {
        let own = program.speeds.iter().find(|own| own.joint == joint);
        own.map_or(Interval::ALL, |own| {
            // 1/√(q̇² + w²) is at most 1/w, at rest, with the 3 u that rounding may add and more.
            let most = 1.0 / Interval::exact(&own.square).low().sqrt() * (1.0 + 8.0 * u);
            Interval::new(0.0, most).unwrap_or(Interval::ALL)
        })
    };
    let ids: Vec<_> = program.dag.operations().map(|(id, ..)| id).collect();
    let mut magnitudes = vec![0.0f64; ids.len()];
    for part in limits.parts(program, boxes) {
        let leaf = |id, node: &Node| match node {
            Node::Input(Input::PerSpeed(joint)) => (speed(*joint), 0.0),
            Node::Input(input @ Input::Entry(..)) => (part.input(*input), 0.0),
            Node::Input(input) => (part.input(*input).widened(sine(input.angle())), 0.0),
            _ => (constants[id as usize], 0.0),
        };
        let rounding = |_, _, exact: Interval| 2.0 * u * exact.magnitude() + f64::MIN_POSITIVE;
        let Forward { values, .. } = forward(&program.dag, leaf, rounding);
        for (most, id) in magnitudes.iter_mut().zip(&ids) {
            *most = most.max(values[*id as usize].magnitude());
        }
    }
    let largest = scalar.of(f64::MAX, f32::MAX.into());
    let steps = magnitudes.into_iter().enumerate();
    steps
        .filter(|(_, magnitude)| *magnitude > largest)
        .map(|(step, magnitude)| format!("t{} may reach {magnitude:e}: it may overflow", step + 1))
        .collect()
}

fn rounded(constant: &Exact, scalar: ScalarType) -> Interval {
    Interval::exact(constant).hull(Interval::point(scalar.round(constant)))
}

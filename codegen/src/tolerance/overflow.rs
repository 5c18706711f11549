//! Steps that may overflow inside the box: every value is as large as its operands allow.

use dalembert_model::number::Rounded;

use super::input_box::InputBox;
use crate::dag::Node;
use crate::program::{Input, Operation, Program, ScalarType};

/// A bound of sines, of polynomials too.
const SINE: f64 = 2.0;
/// A bound of what rounding adds to a size, many times over.
const SLACK: f64 = 1.0 + 1e-6;

/// Returns a sentence on each such step.
pub(crate) fn overflows(program: &Program, scalar: ScalarType, limits: &InputBox) -> Vec<String> {
    let mut sizes: Vec<f64> = Vec::with_capacity(program.dag.nodes.len());
    for node in &program.dag.nodes {
        sizes.push(match node {
            Node::Constant(constant) => f64::nearest(constant).abs() * SLACK,
            Node::Input(Input::Sin(_) | Input::Cos(_)) => SINE,
            Node::Input(Input::PerSpeed(coordinate)) => {
                let mut speeds = program.speeds.iter();
                let speed = speeds.find(|speed| speed.coordinate == *coordinate);
                let width = speed.map(|speed| libm::sqrt(f64::nearest(&speed.square)));
                width.map_or(f64::INFINITY, |width| SLACK / width)
            }
            Node::Input(Input::Entry(argument, index)) => {
                let range = limits.of_argument(*argument).get(*index);
                range.map_or(f64::INFINITY, |range| range.magnitude())
            }
            Node::Apply(operation, operands) => {
                let [a, b] = operands.map(|id| sizes[id as usize]);
                let size = match operation {
                    Operation::Add | Operation::Sub => a + b,
                    // Nothing times what has no bound is nothing.
                    Operation::Mul | Operation::Fused if a == 0.0 || b == 0.0 => 0.0,
                    Operation::Mul | Operation::Fused => a * b,
                    Operation::Div => f64::INFINITY,
                };
                size * SLACK
            }
        });
    }
    let largest = scalar.of(f64::MAX, f32::MAX.into());
    let steps = (1..).zip(program.dag.operations());
    let reached = steps.map(|(step, (id, ..))| (step, sizes[id as usize]));
    let large = reached.filter(|(_, size)| *size > largest);
    let texts = large.map(|(step, size)| format!("t{step} may reach {size:e}: it may overflow"));
    texts.collect()
}

//! Multiples of values that other values could be replaced by.
//!
//! An edit puts a value or a constant in a value's place. For one operation a multiple of a
//! value would do as well, and often runs much more alike. So before each value stands the
//! multiple of an earlier one that is nearest to it. Nothing reads it, and it costs nothing,
//! until an edit puts it in the value's place.

use super::columns::{Nodes, short};
use super::fit::{dot, sized};
use crate::approximate::motions::Motions;
use crate::program::{Operand, Operation, Output, Program, Step, Steps};
use crate::states::JointState;
use dalembert_model::number::{Exact, Rational};

/// Values that run less alike are no use.
const LEAST: f64 = 0.6;

pub(super) const MOST: usize = 2;

pub(super) fn spared(program: &Program, motions: &Motions, states: &[JointState]) -> Program {
    let nodes = Nodes::new(program, states);
    let columns = nodes.run(&vec![None; nodes.len()]);
    let columns = columns.chunks_exact(nodes.samples);
    let directions: Vec<_> = columns.map(|column| sized(column, motions)).collect();
    let inputs = nodes.inputs.len();
    let exact = program.dag.steps();
    let mut places: Vec<usize> = Vec::with_capacity(exact.steps.len());
    let mut steps: Vec<Step> = Vec::new();
    for (index, step) in exact.steps.iter().enumerate() {
        let is_multiple = step.operation == Operation::Mul
            && [&step.left, &step.right]
                .iter()
                .any(|operand| matches!(operand, Operand::Constant(_)));
        // A multiple in place of another saves nothing.
        let (mine, size) = &directions[inputs + index];
        let before = if is_multiple { 0 } else { inputs + index };
        let mut alike: Vec<(f64, usize, f64)> = Vec::new();
        for (other, (theirs, length)) in directions[..before].iter().enumerate() {
            let product = dot(mine, theirs);
            let cosine = product.abs() / (size * length);
            if cosine > LEAST {
                alike.push((cosine, other, product / (length * length)));
            }
        }
        alike.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, other, factor) in alike.into_iter().take(MOST) {
            let factor = Rational::from_float(short(factor)).unwrap_or_default();
            steps.push(Step {
                operation: Operation::Mul,
                left: Operand::Constant(Exact::from(factor)),
                right: match other.checked_sub(inputs) {
                    Some(step) => Operand::Step(places[step]),
                    None => Operand::Input(nodes.inputs[other]),
                },
            });
        }
        places.push(steps.len());
        steps.push(Step {
            operation: step.operation,
            left: step.left.moved(&places),
            right: step.right.moved(&places),
        });
    }
    let outputs = exact.outputs.iter().map(|output| Output {
        negative: output.negative,
        value: output.value.moved(&places),
    });
    let outputs = outputs.collect();
    Program {
        dag: Steps { steps, outputs }.dag(),
        ..program.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::approximate::motions::positions;
    use crate::bound::input_box::InputBox;
    use crate::dag::{Builder, Folding};
    use crate::function::Function;
    use crate::program::Input;
    use crate::random::Random;
    use crate::verify::exact::prove_same;
    use dalembert_model::number::Rounded;

    #[test]
    fn the_nearest_multiple_stands_before_a_sum() {
        let mut builder = Builder::new(Folding::Syntactic);
        let [sine, cosine] = [Input::Sin, Input::Cos].map(|of| of(0));
        let [sine, cosine] = [sine, cosine].map(|input| builder.input(input));
        let numbers = [(3, 1), (1, 8)];
        let [three, eighth] = numbers.map(|(n, d): (i64, i64)| {
            let number = Rational::new(n.into(), d.into());
            builder.constant(&Exact::from(number))
        });
        let large = builder.mul(three, cosine);
        let small = builder.mul(eighth, sine);
        let sum = builder.add(large, small);
        let program = Program::new(Function::Gravity, 1, &builder.finish(vec![sum]));
        let limits = InputBox::symmetric(&[3.0], &[0.0], &[0.0]);
        let motions = Motions::new(&program, &limits);
        let states = motions.states(&positions(&limits, 40, &mut Random::new(1)));
        let spared = spared(&program, &motions, &states);
        assert!(prove_same(&program, &spared).is_ok());
        let steps = spared.dag.steps().steps;
        let last = steps.len() - 1;
        assert_eq!(steps[last].operation, Operation::Add);
        let factors = steps[last - MOST..last].iter().map(|step| {
            assert_eq!(step.operation, Operation::Mul);
            match &step.left {
                Operand::Constant(factor) => f64::nearest(factor),
                other => panic!("{other:?}"),
            }
        });
        let mut factors: Vec<f64> = factors.collect();
        factors.sort_by(f64::total_cmp);
        assert!((factors[0] - 1.0).abs() < 0.1, "{factors:?}");
        assert!((factors[1] - 3.0).abs() < 0.3, "{factors:?}");
    }
}

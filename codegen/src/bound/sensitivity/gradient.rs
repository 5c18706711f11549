//! The program of all adjoints of a program.

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use crate::edits::operate;
use crate::graph::builder::Value;
use crate::graph::{Builder, Edge, Folding, Graph};
use crate::program::{Input, Operand, Operation, Program};

/// A graph with the value of each step and, output by output, the derivatives
/// of the output with respect to them: all of them its outputs.
pub(super) struct Gradient {
    pub graph: Graph,
    /// Of each step, in the graph.
    pub values: Vec<Edge>,
    /// Of each output.
    pub adjoints: Vec<Adjoints>,
}

/// The derivatives of one output.
pub(super) struct Adjoints {
    /// With respect to each step that it depends on.
    pub steps: Vec<(usize, Edge)>,
    /// With respect to each sine and cosine.
    pub sines: Vec<(Input, Edge)>,
}

impl Gradient {
    pub(super) fn of(program: &Program) -> Gradient {
        let mut builder = Builder::new(Folding::Syntactic);
        let mut values: Vec<Value> = Vec::with_capacity(program.steps.len());
        for step in &program.steps {
            let x = read(&mut builder, &values, &step.left);
            let y = read(&mut builder, &values, &step.right);
            values.push(operate(&mut builder, step.operation, &x, &y));
        }
        let outputs = program.outputs.iter();
        let adjoints: Vec<_> = outputs
            .map(|output| adjoints(program, &output.value, &values, &mut builder))
            .collect();
        let values: Vec<Edge> = values.iter().map(|value| builder.edge(value)).collect();
        let mut edges = |steps: Parts<usize>, sines: Parts<Input>| Adjoints {
            steps: (steps.into_iter())
                .map(|(step, value)| (step, builder.edge(&value)))
                .collect(),
            sines: (sines.into_iter())
                .map(|(input, value)| (input, builder.edge(&value)))
                .collect(),
        };
        let adjoints = adjoints.into_iter();
        let adjoints: Vec<Adjoints> = adjoints.map(|(steps, sines)| edges(steps, sines)).collect();
        let mut graph = builder.finish(&[]);
        graph.outputs.clone_from(&values);
        for Adjoints { steps, sines } in &adjoints {
            graph.outputs.extend(steps.iter().map(|(_, edge)| *edge));
            graph.outputs.extend(sines.iter().map(|(_, edge)| *edge));
        }
        Gradient {
            graph,
            values,
            adjoints,
        }
    }
}

fn read(builder: &mut Builder, values: &[Value], operand: &Operand) -> Value {
    match operand {
        Operand::Step(index) => values[*index].clone(),
        Operand::Constant(constant) => Value::Constant(constant.clone()),
        Operand::Input(input) => builder.input(*input),
    }
}

type Parts<T> = Vec<(T, Value)>;

/// From the output backwards.
fn adjoints(
    program: &Program,
    output: &Operand,
    values: &[Value],
    builder: &mut Builder,
) -> (Parts<usize>, Parts<Input>) {
    let mut steps: Vec<Option<Value>> = vec![None; program.steps.len()];
    let mut sines: Parts<Input> = Vec::new();
    let mut found = Vec::new();
    let one = Value::Constant(Exact::one());
    pass(output, one, &mut steps, &mut sines, builder);
    for index in (0..program.steps.len()).rev() {
        let Some(adjoint) = steps[index].take() else {
            continue;
        };
        let step = &program.steps[index];
        let parts = match step.operation {
            Operation::Add => [adjoint.clone(), adjoint.clone()],
            Operation::Sub => [adjoint.clone(), builder.negate_if(&adjoint, true)],
            Operation::Mul => {
                let x = read(builder, values, &step.left);
                let y = read(builder, values, &step.right);
                [builder.mul(&adjoint, &y), builder.mul(&adjoint, &x)]
            }
            Operation::Div => {
                let x = read(builder, values, &step.left);
                let y = read(builder, values, &step.right);
                let by_left = builder.div(&adjoint, &y);
                let quotient = builder.div(&x, &y);
                let by_right = builder.mul(&by_left, &quotient);
                [by_left, builder.negate_if(&by_right, true)]
            }
        };
        for (operand, part) in [&step.left, &step.right].into_iter().zip(parts) {
            pass(operand, part, &mut steps, &mut sines, builder);
        }
        found.push((index, adjoint));
    }
    (found, sines)
}

fn pass(
    to: &Operand,
    part: Value,
    steps: &mut [Option<Value>],
    sines: &mut Parts<Input>,
    builder: &mut Builder,
) {
    match to {
        Operand::Step(index) => {
            steps[*index] = Some(match steps[*index].take() {
                None => part,
                Some(sum) => builder.add(&sum, &part),
            });
        }
        Operand::Input(input @ (Input::Sin(_) | Input::Cos(_))) => {
            match sines.iter_mut().find(|(known, _)| known == input) {
                None => sines.push((*input, part)),
                Some((_, sum)) => *sum = builder.add(sum, &part),
            }
        }
        _ => {}
    }
}

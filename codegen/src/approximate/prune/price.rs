//! What an edited program costs, quickly: folding and liveness without
//! building a graph.

use super::columns::{Nodes, Value};
use crate::program::{Input, Operation};

/// A sine/cosine pair weighs as much as this many operations, which its polynomials take.
pub(super) const SINCOS: u32 = 8;

pub(super) fn price(nodes: &Nodes, edits: &[Option<Value>], scratch: &mut Scratch) -> u32 {
    let inputs = nodes.inputs.len();
    let Scratch { folded, live } = scratch;
    folded.clear();
    for (node, &edit) in edits.iter().enumerate() {
        let value = match edit {
            Some(value) => Folded::alias(resolved(value, folded)),
            None if node < inputs => Folded::alias(Value::Node(node, false)),
            None => fold(nodes, node, folded),
        };
        folded.push(value);
    }
    live.clear();
    live.resize(nodes.len(), false);
    for output in &nodes.outputs {
        if let Value::Node(node, _) = resolved(*output, folded) {
            live[node] = true;
        }
    }
    let mut total = 0;
    for node in (inputs..nodes.len()).rev() {
        if live[node]
            && let Some([a, b]) = folded[node].operands
        {
            total += 1;
            for value in [a, b] {
                if let Value::Node(node, _) = value {
                    live[node] = true;
                }
            }
        }
    }
    let mut angles: Vec<_> = Vec::new();
    for (node, input) in nodes.inputs.iter().enumerate() {
        if live[node]
            && let Input::Sin(angle) | Input::Cos(angle) = input
            && !angles.contains(angle)
        {
            angles.push(*angle);
            total += SINCOS;
        }
    }
    total
}

#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    folded: Vec<Folded>,
    pub live: Vec<bool>,
}

#[derive(Clone, Copy, Debug)]
struct Folded {
    value: Value,
    operands: Option<[Value; 2]>,
    scaled: Option<(f64, Value)>,
}

impl Folded {
    fn alias(value: Value) -> Folded {
        Folded {
            value,
            operands: None,
            scaled: None,
        }
    }
}

fn resolved(value: Value, folded: &[Folded]) -> Value {
    match value {
        Value::Node(node, negative) => folded[node].value.negated_if(negative),
        known => known,
    }
}

fn fold(nodes: &Nodes, node: usize, folded: &[Folded]) -> Folded {
    let step = &nodes.steps[node - nodes.inputs.len()];
    let [a, b] = step.operands.map(|operand| resolved(operand, folded));
    let minus = step.operation == Operation::Sub;
    let own = Value::Node(node, false);
    let operation = Folded {
        value: own,
        operands: Some([a, b]),
        scaled: None,
    };
    match (step.operation, a, b) {
        (Operation::Mul, Value::Known(x), Value::Known(y)) => Folded::alias(Value::Known(x * y)),
        (_, Value::Known(x), Value::Known(y)) => {
            Folded::alias(Value::Known(if minus { x - y } else { x + y }))
        }
        (Operation::Mul, Value::Known(c), x) | (Operation::Mul, x, Value::Known(c)) => {
            if c == 0.0 {
                return Folded::alias(Value::Known(0.0));
            }
            if c.abs() == 1.0 {
                return Folded::alias(x.negated_if(c < 0.0));
            }
            let (mut c, mut x) = (c, x);
            if let Value::Node(inner, negative) = x
                && let Some((d, y)) = folded[inner].scaled
            {
                (c, x) = (if negative { -c * d } else { c * d }, y);
            }
            Folded {
                value: own,
                operands: Some([x, Value::Known(c)]),
                scaled: Some((c, x)),
            }
        }
        (Operation::Mul, ..) => operation,
        (_, Value::Known(0.0), y) => Folded::alias(y.negated_if(minus)),
        (_, x, Value::Known(0.0)) => Folded::alias(x),
        (_, Value::Node(x, s), Value::Node(y, t)) if x == y && (s == t) == minus => {
            Folded::alias(Value::Known(0.0))
        }
        _ => operation,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::pattern::{Leaf, evaluate};
    use crate::dag::tests::BY_SHAPE;
    use crate::dag::{Builder, Folding};
    use crate::function::{Argument, Function};
    use crate::program::Program;

    fn price_of(pattern: &str) -> u32 {
        let mut builder = Builder::new(Folding::Syntactic);
        let mut replaced: Vec<(Input, f64)> = Vec::new();
        let value = evaluate(pattern, &mut builder, |leaf, builder| {
            let value = match leaf {
                Leaf::Number(number) => f64::from(number),
                Leaf::Constant(place) => 3.5 + f64::from(place),
                Leaf::Value(_) => return leaf.edge(builder),
            };
            let input = Input::Entry(Argument::Acceleration, replaced.len());
            replaced.push((input, value));
            builder.input(input)
        });
        let graph = builder.finish(vec![value]);
        let program = Program::new(Function::Gravity, 9, &graph);
        let nodes = Nodes::new(&program, &[]);
        let mut edits = vec![None; nodes.len()];
        for (edit, input) in edits.iter_mut().zip(&nodes.inputs) {
            let known = replaced.iter().find(|(known, _)| known == input);
            *edit = known.map(|&(_, value)| Value::Known(value));
        }
        price(&nodes, &edits, &mut Scratch::default())
    }

    #[test]
    fn folds_whatever_a_builder_folds_by_shape() {
        for (from, to) in BY_SHAPE {
            // What stays is at most one product of a value and a constant.
            let kept = u32::from(to.contains('*') && to.contains("?a"));
            assert_eq!(price_of(from), kept, "{from}");
        }
        assert_eq!(price_of("(+ ?a (* ?b ?k))"), 2);
    }
}

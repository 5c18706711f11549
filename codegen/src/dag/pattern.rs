//! Patterns in a builder: how the tests hold folds and rules against the code that applies them.

use std::collections::{BTreeMap, BTreeSet};

use dalembert_model::number::{Exact, Rational};
use egg::{RecExpr, SymbolLang};

use super::{Builder, Dag, Edge, Folding, Input, Operation};
use crate::function::Argument;

#[derive(Clone, Copy, Debug)]
pub(crate) enum Leaf {
    Number(u32),
    Constant(u32),
    Value(u32),
}

impl Leaf {
    fn read(text: &str) -> Leaf {
        let place = |name: &str| name.chars().next().expect("a name") as u32 - 'a' as u32;
        match text.strip_prefix('?') {
            Some(name @ ("k" | "m")) => Leaf::Constant(place(name)),
            Some(name) => Leaf::Value(place(name)),
            None => Leaf::Number(text.parse().expect("a number")),
        }
    }

    pub(crate) fn edge(self, builder: &mut Builder) -> Edge {
        let number = match self {
            Leaf::Number(number) => Rational::from_integer(number.into()),
            Leaf::Constant(place) => Rational::new((31 + 4 * place).into(), 7.into()),
            Leaf::Value(place) => {
                return builder.input(Input::Entry(Argument::Velocity, place as usize));
            }
        };
        builder.constant(&Exact::from(number))
    }
}

/// Returns the value of a pattern in a builder, from that of its leaves; variables come first, in
/// alphabetical order. Panics on anything but a pattern: tables are the project's own.
pub(crate) fn evaluate(
    pattern: &str,
    builder: &mut Builder,
    mut leaf: impl FnMut(Leaf, &mut Builder) -> Edge,
) -> Edge {
    let pattern: RecExpr<SymbolLang> = pattern.parse().expect("a pattern");
    let symbols = pattern.iter().map(|node| node.op.as_str());
    let names: BTreeSet<&str> = symbols.filter(|name| name.starts_with('?')).collect();
    let mut variables: BTreeMap<&str, Edge> = BTreeMap::new();
    for name in names {
        variables.insert(name, leaf(Leaf::read(name), builder));
    }
    let mut values: Vec<Edge> = Vec::new();
    for node in pattern.iter() {
        let children = node.children.iter();
        let operands: Vec<Edge> = children.map(|id| values[usize::from(*id)]).collect();
        let value = match (node.op.as_str(), operands.as_slice()) {
            (name, []) => match variables.get(name) {
                Some(value) => *value,
                None => leaf(Leaf::read(name), builder),
            },
            ("neg", [a]) => a.negated_if(true),
            (symbol, [a, b]) => {
                let symbol = symbol.parse().expect("a symbol");
                let operation = Operation::from_symbol(symbol).expect("an operation");
                builder.apply(operation, *a, *b)
            }
            other => panic!("{other:?}"),
        };
        values.push(value);
    }
    values.pop().expect("a value")
}

/// `?a` is the first joint's velocity, `?b` the second's, and so on.
pub(crate) fn graph(outputs: &[&str]) -> Dag {
    let mut builder = Builder::new(Folding::Syntactic);
    let value = |output: &&str| evaluate(output, &mut builder, Leaf::edge);
    let values = outputs.iter().map(value).collect();
    builder.finish(values)
}

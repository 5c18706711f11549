//! Patterns read and evaluated over anything that adds and multiplies: how the
//! tests hold every rule against the field, and against the code that applies it.

use std::collections::HashMap;

use dalembert_model::number::{Exact, Rational};

use crate::dag::Input;
use crate::dag::{Builder, Dag, Edge, Folding};
use crate::function::Argument;

/// A pattern.
#[derive(Clone, Debug)]
pub(crate) enum Pattern {
    /// A number.
    Number(u64),
    /// `?a`: any value; `?k` and `?m`: a constant.
    Variable(char),
    /// An operation on patterns.
    Operation(&'static str, Vec<Pattern>),
}

/// The values that patterns are evaluated over.
pub(crate) trait Algebra {
    /// A value.
    type Value: Clone;
    /// Returns a number.
    fn number(&mut self, number: u64) -> Self::Value;
    /// Returns −a
    fn neg(&mut self, a: &Self::Value) -> Self::Value;
    /// Returns a + b, a − b, a · b or a / b.
    fn operate(&mut self, symbol: &str, a: &Self::Value, b: &Self::Value) -> Self::Value;
}

impl Pattern {
    /// Reads a pattern.
    ///
    /// # Panics
    /// On anything but a pattern: tables are the project's own.
    pub(crate) fn parse(text: &str) -> Pattern {
        let spaced = text.replace('(', " ( ").replace(')', " ) ");
        let mut words = spaced.split_whitespace();
        let pattern = Pattern::read(&mut words);
        assert!(words.next().is_none(), "more than one pattern in `{text}`");
        pattern
    }

    fn read<'a>(words: &mut impl Iterator<Item = &'a str>) -> Pattern {
        let word = words.next().expect("a pattern ends too early");
        if word != "(" {
            return match word.strip_prefix('?') {
                Some(name) => Pattern::Variable(name.chars().next().expect("a nameless variable")),
                None => Pattern::Number(word.parse().expect("a number")),
            };
        }
        let name = words.next().expect("an operation");
        let known = ["+", "-", "±", "*", "neg"]
            .into_iter()
            .find(|known| *known == name);
        let name = known.unwrap_or_else(|| panic!("`{name}` is no operation"));
        let count = if name == "neg" { 1 } else { 2 };
        let operands = (0..count).map(|_| Pattern::read(words)).collect();
        assert_eq!(words.next(), Some(")"), "`{name}` has {count} operands");
        Pattern::Operation(name, operands)
    }

    /// Returns the variables, each once, in alphabetical order.
    pub(crate) fn variables(&self) -> Vec<char> {
        let mut found = Vec::new();
        self.collect(&mut found);
        found.sort_unstable();
        found.dedup();
        found
    }

    fn collect(&self, found: &mut Vec<char>) {
        match self {
            Pattern::Number(_) => {}
            Pattern::Variable(name) => found.push(*name),
            Pattern::Operation(_, operands) => operands.iter().for_each(|o| o.collect(found)),
        }
    }

    /// Returns its value.
    pub(crate) fn evaluate<A: Algebra>(
        &self,
        algebra: &mut A,
        variables: &HashMap<char, A::Value>,
    ) -> A::Value {
        match self {
            Pattern::Number(number) => algebra.number(*number),
            Pattern::Variable(name) => variables[name].clone(),
            Pattern::Operation(name, operands) => {
                let values: Vec<A::Value> = operands
                    .iter()
                    .map(|o| o.evaluate(algebra, variables))
                    .collect();
                match values.as_slice() {
                    [a] => algebra.neg(a),
                    [a, b] => algebra.operate(name, a, b),
                    _ => unreachable!("an operation has one or two operands"),
                }
            }
        }
    }
}

/// Returns whether a variable stands for a constant.
pub(crate) fn is_constant(variable: char) -> bool {
    matches!(variable, 'k' | 'm')
}

/// Values of a builder.
pub(crate) struct InBuilder<'a>(pub &'a mut Builder);

impl Algebra for InBuilder<'_> {
    type Value = Edge;
    fn number(&mut self, number: u64) -> Edge {
        let number = Rational::from_integer(number.into());
        self.0.constant(&Exact::from(number))
    }
    fn neg(&mut self, a: &Edge) -> Edge {
        a.negated_if(true)
    }
    fn operate(&mut self, symbol: &str, a: &Edge, b: &Edge) -> Edge {
        match symbol {
            "+" => self.0.add(*a, *b),
            "-" => self.0.sub(*a, *b),
            _ => self.0.mul(*a, *b),
        }
    }
}

/// Returns a graph with these outputs, folded by shape: `?a` is the first joint's
/// velocity, `?b` the second's, and so on.
pub(crate) fn graph(outputs: &[&str]) -> Dag {
    let mut builder = Builder::new(Folding::Syntactic);
    let mut values = Vec::new();
    for output in outputs {
        let pattern = Pattern::parse(output);
        let mut variables = HashMap::new();
        for name in pattern.variables() {
            let joint = name as usize - 'a' as usize;
            variables.insert(name, builder.input(Input::Entry(Argument::Velocity, joint)));
        }
        values.push(pattern.evaluate(&mut InBuilder(&mut builder), &variables));
    }
    builder.finish(values)
}

//! A table by which each language prints the lines of a function.

use std::collections::HashMap;

use super::Language;
use crate::dag::fusion::Fusion;
use crate::dag::{Dag, Edge, Id, Node};
use crate::program::kernel::{Angle, Kernel};
use crate::program::{Code, Input, Literal, Operation, ScalarType};

/// The words of a language for one scalar. In a pattern, `{}` stands for a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dialect {
    pub language: Language,
    pub scalar: ScalarType,
    pub function: &'static str,
    pub declaration: &'static str,
    pub product: &'static str,
    /// A product and the sum that takes it: two factors, addend.
    pub fused: &'static str,
    pub negative: &'static str,
    pub literal: &'static str,
    /// The array of an argument that has a type of its own: its name, twice.
    pub array: &'static str,
}

impl Dialect {
    pub(crate) const fn rust(scalar: ScalarType) -> Dialect {
        Dialect {
            language: Language::Rust,
            scalar,
            function: "pub fn",
            declaration: "let {} = {};",
            product: "{} * {}",
            fused: "{}.mul_add({}, {})",
            negative: "(-{})",
            literal: "{}",
            array: "{}",
        }
    }

    /// Rust over vectors: `of` is one of them, which knows what vectors there are.
    pub(crate) const fn vectors(scalar: ScalarType) -> Dialect {
        Dialect {
            literal: "of.all({})",
            ..Dialect::rust(scalar)
        }
    }

    pub(crate) const fn c99(scalar: ScalarType) -> Dialect {
        Dialect {
            language: Language::C,
            scalar,
            function: "static inline",
            declaration: scalar.of("const double {} = {};", "const float {} = {};"),
            product: "{} * {}",
            fused: scalar.of("fma({}, {}, {})", "fmaf({}, {}, {})"),
            negative: "-{}",
            literal: scalar.of("{}", "{}F"),
            array: "{}->{}",
        }
    }

    /// C, but for the words in front of a function and for products: the device's compiler fuses
    /// them with sums, unless they say that they are rounded.
    pub(crate) const fn cuda(scalar: ScalarType) -> Dialect {
        Dialect {
            language: Language::Cuda,
            function: "static __host__ __device__ inline",
            product: scalar.of("DALEMBERT_MUL({}, {})", "DALEMBERT_MULF({}, {})"),
            ..Dialect::c99(scalar)
        }
    }

    pub(crate) fn declare(&self, name: &str, value: &str) -> String {
        filled(self.declaration, &[name, value])
    }

    pub(crate) fn operation(&self, operation: Operation, left: &str, right: &str) -> String {
        match operation {
            Operation::Mul => filled(self.product, &[left, right]),
            other => format!("{left} {} {right}", other.symbol()),
        }
    }

    pub(super) fn fused_sum(&self, fusion: &Fusion, factors: [String; 2], addend: &str) -> String {
        let [mut left, right] = factors;
        if fusion.negative {
            left = filled(self.negative, &[&left]);
        }
        let sign = if fusion.minus { "-" } else { "" };
        filled(self.fused, &[&left, &right, &format!("{sign}{addend}")])
    }

    pub(crate) fn call(&self, path: &str, function: &str, argument: &str) -> String {
        let separator = if path.is_empty() { "" } else { "::" };
        let suffix = self.scalar.math_suffix();
        format!("{path}{separator}{function}{suffix}({argument})")
    }

    /// Returns a literal, as short as it reads back to the same bits.
    pub(crate) fn literal(&self, value: Literal) -> String {
        self.digits(&value.text(self.scalar))
    }

    pub(crate) fn digits(&self, digits: &str) -> String {
        filled(self.literal, &[digits])
    }
}

pub(crate) struct Lines<'c, I> {
    dialect: Dialect,
    dag: &'c Dag<Literal, I>,
    numbers: Vec<Option<usize>>,
    prefix: String,
    input: Box<dyn Fn(&I) -> String + 'c>,
    /// The names of values of loops outside of these, and if what they name is the negative, which
    /// results alone read.
    names: HashMap<Id, (String, bool)>,
}

impl<'c> Lines<'c, Input> {
    pub(crate) fn new(dialect: Dialect, code: &'c Code) -> Lines<'c, Input> {
        Lines::over(dialect, &code.dag, "t", move |input| match input {
            Input::Entry(argument, index) if argument.has_type() => {
                let array = filled(dialect.array, &[argument.name(); 2]);
                format!("{array}[{index}]")
            }
            other => other.name(),
        })
    }
}

impl<'c> Lines<'c, Angle> {
    pub(crate) fn of_kernel(
        dialect: Dialect,
        kernel: &'c Kernel,
        angle: &'c str,
        prefix: &str,
    ) -> Lines<'c, Angle> {
        Lines::over(dialect, &kernel.dag, prefix, |_| angle.to_owned())
    }
}

impl<'c, I> Lines<'c, I> {
    fn over(
        dialect: Dialect,
        dag: &'c Dag<Literal, I>,
        prefix: &str,
        input: impl Fn(&I) -> String + 'c,
    ) -> Lines<'c, I> {
        Lines {
            dialect,
            dag,
            numbers: dag.numbers(),
            prefix: prefix.to_owned(),
            input: Box::new(input),
            names: HashMap::new(),
        }
    }

    pub(super) fn name(&mut self, id: Id, name: String, is_negative: bool) {
        self.names.insert(id, (name, is_negative));
    }

    pub(crate) fn operand(&self, id: Id) -> String {
        if let Some((name, _)) = self.names.get(&id) {
            return name.clone();
        }
        match self.dag.node(id) {
            Node::Input(input) => (self.input)(input),
            Node::Constant(value) => self.dialect.literal(*value),
            Node::Apply(..) => {
                let number = self.numbers[id as usize].unwrap_or_default();
                format!("{}{number}", self.prefix)
            }
        }
    }

    pub(crate) fn result(&self, output: Edge) -> String {
        let is_stored = self.names.get(&output.node).is_some_and(|name| name.1);
        let is_negative = output.negative != is_stored;
        let sign = if is_negative { "-" } else { "" };
        format!("{sign}{}", self.operand(output.node))
    }

    pub(crate) fn results(&self) -> impl Iterator<Item = String> {
        self.dag.outputs.iter().map(|output| self.result(*output))
    }

    pub(crate) fn statements(&self) -> impl Iterator<Item = String> {
        let operations = self.dag.operations();
        operations.filter_map(|(id, ..)| self.statement(id))
    }

    /// `let t3 = t1 * s2;`, or `let t5 = t3.mul_add(s2, t1);` for a sum and the product that it
    /// takes, which has no line of its own.
    pub(crate) fn statement(&self, id: Id) -> Option<String> {
        let Node::Apply(operation, operands) = self.dag.node(id) else {
            return None;
        };
        if *operation == Operation::Fused {
            return None;
        }
        let dialect = self.dialect;
        let value = match self.dag.fusion(id) {
            None => {
                let [left, right] = operands.map(|id| self.operand(id));
                dialect.operation(*operation, &left, &right)
            }
            Some(fusion) => {
                let factors = fusion.factors.map(|id| self.operand(id));
                dialect.fused_sum(&fusion, factors, &self.operand(fusion.addend))
            }
        };
        Some(dialect.declare(&self.operand(id), &value))
    }
}

fn filled(pattern: &str, parts: &[&str]) -> String {
    let mut pieces = pattern.split("{}");
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for (part, piece) in parts.iter().zip(pieces) {
        text += part;
        text += piece;
    }
    text
}

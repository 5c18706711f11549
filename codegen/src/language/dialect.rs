//! How a language writes the lines of a function: one table, by which they are printed and
//! read back.

use crate::program::fused::{Fusion, fusion};
use crate::program::text::input_name;
use crate::program::{Literal, Lowered, Operand, Operation, ScalarType};

/// The words of a language for one scalar. In a pattern, `{}` stands for a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dialect {
    /// The scalar that literals and calls are of.
    pub scalar: ScalarType,
    /// What a function of the file begins with, before its result.
    pub function: &'static str,
    /// The line that gives a value its name: name, value.
    pub declaration: &'static str,
    /// A product: two factors.
    pub product: &'static str,
    /// A product and the sum that takes it: two factors, addend.
    pub fused: &'static str,
    /// A factor that is negated.
    pub negative: &'static str,
    /// A literal: its digits.
    pub literal: &'static str,
    /// Between the path of a library and its function.
    pub separator: &'static str,
}

impl Dialect {
    /// Returns Rust.
    pub(crate) const fn rust(scalar: ScalarType) -> Dialect {
        Dialect {
            scalar,
            function: "pub fn",
            declaration: "let {} = {};",
            product: "{} * {}",
            fused: "{}.mul_add({}, {})",
            negative: "(-{})",
            literal: "{}",
            separator: "::",
        }
    }

    /// Rust over vectors: `of` is one of them, which knows what vectors there are.
    pub(crate) const fn vectors(scalar: ScalarType) -> Dialect {
        Dialect {
            literal: "of.all({})",
            ..Dialect::rust(scalar)
        }
    }

    /// Returns the line that gives a value its name.
    pub(crate) fn declare(&self, name: &str, value: &str) -> String {
        filled(self.declaration, &[name, value])
    }

    /// Returns an operation on two operands.
    pub(crate) fn operation(&self, operation: Operation, left: &str, right: &str) -> String {
        match operation {
            Operation::Mul => filled(self.product, &[left, right]),
            other => format!("{left} {} {right}", other.symbol()),
        }
    }

    /// Reads an operation on two operands.
    pub(crate) fn read_operation<'t>(&self, value: &'t str) -> Option<(Operation, [&'t str; 2])> {
        let is_word = |words: &[&str; 2]| words.iter().all(|word| !word.contains([' ', '(']));
        if let Some(words) = holes(self.product, value).filter(is_word) {
            return Some((Operation::Mul, words));
        }
        let words: Vec<&str> = value.split(' ').collect();
        let &[left, symbol, right] = words.as_slice() else {
            return None;
        };
        let operation = Operation::from_symbol(symbol)?;
        (operation != Operation::Mul).then_some((operation, [left, right]))
    }

    /// Returns a call of a library's function.
    pub(crate) fn call(&self, path: &str, function: &str, argument: &str) -> String {
        let (separator, suffix) = (self.separator, self.scalar.math_suffix());
        format!("{path}{separator}{function}{suffix}({argument})")
    }

    /// Returns a literal, as short as it reads back to the same bits.
    pub(crate) fn literal(&self, value: Literal) -> String {
        self.digits(&value.text(self.scalar))
    }

    /// Returns a literal of these digits.
    pub(crate) fn digits(&self, digits: &str) -> String {
        filled(self.literal, &[digits])
    }

    /// Reads a literal; an integer would be of another type.
    pub(crate) fn read_literal(&self, word: &str) -> Option<Literal> {
        let [digits] = holes(self.literal, word)?;
        let value = digits
            .contains(['.', 'e'])
            .then(|| self.scalar.parse(digits));
        value.flatten().map(Literal)
    }

    /// Returns the name or literal of an operand.
    pub(crate) fn operand(&self, operand: &Operand<Literal>) -> String {
        match operand {
            Operand::Input(input) => input_name(*input),
            Operand::Constant(value) => self.literal(*value),
            Operand::Step(index) => format!("t{}", index + 1),
        }
    }

    /// Returns one operation as one line: `let t3 = t1 * s2;`, or `let t5 = t3.mul_add(s2,
    /// t1);` for a sum and the product that it takes, which has no line of its own.
    pub(crate) fn statement(&self, code: &Lowered, index: usize) -> Option<String> {
        let step = code.steps.get(index)?;
        if step.operation == Operation::Fused {
            return None;
        }
        let value = match fusion(&code.steps, index) {
            None => {
                let (left, right) = (self.operand(&step.left), self.operand(&step.right));
                self.operation(step.operation, &left, &right)
            }
            Some(Fusion {
                product,
                negative,
                addend,
                minus,
            }) => {
                let left = self.operand(&product.left);
                let left = match negative {
                    true => filled(self.negative, &[&left]),
                    false => left,
                };
                let sign = if minus { "-" } else { "" };
                let addend = format!("{sign}{}", self.operand(addend));
                filled(self.fused, &[&left, &self.operand(&product.right), &addend])
            }
        };
        Some(self.declare(&format!("t{}", index + 1), &value))
    }
}

/// Fills a pattern.
fn filled(pattern: &str, parts: &[&str]) -> String {
    let mut pieces = pattern.split("{}");
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for (part, piece) in parts.iter().zip(pieces) {
        text += part;
        text += piece;
    }
    text
}

/// Returns what fills a pattern to this text: each part ends where the pattern can go on
/// first, the last one with the text.
pub(crate) fn holes<'t, const N: usize>(pattern: &str, text: &'t str) -> Option<[&'t str; N]> {
    let mut pieces = pattern.split("{}");
    let mut rest = text.strip_prefix(pieces.next()?)?;
    let mut parts = [""; N];
    for (index, part) in parts.iter_mut().enumerate() {
        let piece = pieces.next()?;
        (*part, rest) = match index + 1 == N {
            true => (rest.strip_suffix(piece)?, ""),
            false => rest.split_once(piece)?,
        };
    }
    Some(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_give_back_what_fills_them() {
        let rust = Dialect::rust(ScalarType::F64);
        let line = rust.declare("t1", "c1 * 0.5");
        assert_eq!(line, "let t1 = c1 * 0.5;");
        assert_eq!(holes(rust.declaration, &line), Some(["t1", "c1 * 0.5"]));
        assert_eq!(holes::<2>(rust.declaration, "let t1 = c1 * 0.5"), None);
        let fused = filled(rust.fused, &["(-t3)", "s2p3", "-t1"]);
        assert_eq!(fused, "(-t3).mul_add(s2p3, -t1)");
        assert_eq!(holes(rust.fused, &fused), Some(["(-t3)", "s2p3", "-t1"]));
        assert_eq!(holes::<3>(rust.fused, "t3.mul_add(s2p3)"), None);
        assert_eq!(rust.read_literal("5"), None);
        assert_eq!(rust.read_literal("0.5x"), None);
    }
}

//! The blocks that compute sines and cosines by polynomials.

use super::error::{Kind, SineFault, TextFault, WordFault};
use super::{binding, is_next};
use crate::program::kernel::{ANGLE, Kernel, Term, Value, literal};
use crate::program::{AngleSum, LoweredTrig, Operation, ScalarType};

/// An open block.
pub(super) struct Block {
    angle: AngleSum,
    sin: bool,
    cos: bool,
    /// How its lines name the angle.
    argument: String,
    kernel: Kernel,
    /// Whether the result was read.
    done: bool,
}

impl Block {
    /// The block that a line opens, if it is one: `let (s1, c1) = {`. A sum
    /// of angles is the one that the line before formed.
    pub(super) fn begin(line: &str, sums: &mut Vec<AngleSum>) -> Option<Block> {
        let names = line.strip_prefix("let ")?.strip_suffix(" = {")?;
        let pair = names.strip_prefix('(').and_then(|n| n.strip_suffix(')'));
        let (sin, cos) = match pair {
            Some(pair) => {
                let (sin, cos) = pair.split_once(", ")?;
                (Some(sin.strip_prefix('s')?), Some(cos.strip_prefix('c')?))
            }
            None => (names.strip_prefix('s'), names.strip_prefix('c')),
        };
        let name = sin.or(cos)?;
        let angle: AngleSum = name.parse().ok()?;
        if [sin, cos].into_iter().flatten().any(|other| other != name) {
            return None;
        }
        let argument = if angle.additions() == 0 {
            let (joint, _) = angle.terms().next()?;
            format!("q[{joint}]")
        } else {
            sums.pop_if(|sum| *sum == angle)?;
            format!("a{angle}")
        };
        Some(Block {
            angle,
            sin: sin.is_some(),
            cos: cos.is_some(),
            argument,
            kernel: Kernel::default(),
            done: false,
        })
    }

    /// Takes a line; what was read when it closes the block.
    pub(super) fn line(
        &mut self,
        line: &str,
        scalar: ScalarType,
    ) -> Result<Option<LoweredTrig>, TextFault> {
        match (line.strip_prefix("let "), self.done) {
            (Some(statement), false) => {
                self.statement(statement, scalar)?;
                Ok(None)
            }
            (None, false) => {
                self.result(line, scalar)?;
                Ok(None)
            }
            (None, true) if line == "};" => Ok(Some(LoweredTrig {
                angle: self.angle,
                sin: self.sin,
                cos: self.cos,
                kernel: Some(std::mem::take(&mut self.kernel)),
            })),
            _ => Err(SineFault::OpenBlock.into()),
        }
    }

    fn statement(&mut self, line: &str, scalar: ScalarType) -> Result<(), WordFault> {
        let (name, value) = binding(line)?;
        is_next(name, "x", self.kernel.steps.len())?;
        let words: Vec<&str> = value.split(' ').collect();
        let [left, symbol, right] = words.as_slice() else {
            return Err(Kind::OneOperation.not(value));
        };
        // A polynomial does not divide.
        let operation = Operation::from_symbol(symbol)
            .filter(|operation| *operation != Operation::Div)
            .ok_or_else(|| Kind::PolynomialOperation.not(symbol))?;
        let (left, right) = (self.term(left, scalar)?, self.term(right, scalar)?);
        self.kernel.push(operation, left, right);
        Ok(())
    }

    fn result(&mut self, line: &str, scalar: ScalarType) -> Result<(), WordFault> {
        if self.sin && self.cos {
            let pair = line.strip_prefix('(').and_then(|l| l.strip_suffix(')'));
            let (sin, cos) = pair
                .and_then(|pair| pair.split_once(", "))
                .ok_or_else(|| Kind::Pair.not(line))?;
            self.kernel.sin = Some(self.value(sin, scalar)?);
            self.kernel.cos = Some(self.value(cos, scalar)?);
        } else {
            let value = Some(self.value(line, scalar)?);
            if self.sin {
                self.kernel.sin = value;
            } else {
                self.kernel.cos = value;
            }
        }
        self.done = true;
        Ok(())
    }

    fn value(&self, word: &str, scalar: ScalarType) -> Result<Value, WordFault> {
        // A negative literal is a literal; a negated value is negated.
        match word.strip_prefix('-') {
            Some(rest) if !rest.starts_with(|c: char| c.is_ascii_digit()) => Ok(Value {
                negative: true,
                value: self.term(rest, scalar)?,
            }),
            _ => Ok(Value::of(self.term(word, scalar)?)),
        }
    }

    fn term(&self, word: &str, scalar: ScalarType) -> Result<Term, WordFault> {
        if word == self.argument {
            return Ok(ANGLE);
        }
        if let Some(step) = word.strip_prefix('x') {
            let step = step.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
            return match step {
                Some(step) if step < self.kernel.steps.len() => Ok(Term::Step(step)),
                _ => Err(Kind::Computed.not(word)),
            };
        }
        // As in the other lines: an integer would be another type in Rust.
        word.contains(['.', 'e'])
            .then(|| scalar.parse(word))
            .flatten()
            .map(literal)
            .ok_or_else(|| Kind::PolynomialOperand.not(word))
    }
}

//! The block of an angle's polynomials, and what its lines have in common with all others.

use super::expect;
use crate::language::dialect::{Dialect, holes};
use crate::program::kernel::{ANGLE, Kernel, Term};
use crate::program::{AngleSum, Literal, LoweredTrig, Operand, Operation, Output, Step};

/// The open block of an angle's polynomials.
pub(super) struct Block {
    pub(super) trig: LoweredTrig,
    /// The name of the angle in its lines.
    argument: String,
    /// The name of the steps in its lines, before the number.
    prefix: String,
    pub(super) kernel: Kernel,
    /// `true` once the result was read.
    done: bool,
}

impl Block {
    /// Opens the block of an angle by the names in its lines.
    pub(super) fn new(trig: LoweredTrig, argument: String, prefix: String) -> Block {
        Block {
            trig,
            argument,
            prefix,
            kernel: Kernel::default(),
            done: false,
        }
    }

    /// Returns what was read.
    pub(super) fn done(self) -> LoweredTrig {
        LoweredTrig {
            kernel: Some(self.kernel),
            ..self.trig
        }
    }

    /// Returns the block that a line opens: `let (s1, c1) = {`. A sum of angles is the one
    /// that the line before formed.
    pub(super) fn begin(line: &str, sums: &mut Vec<AngleSum>) -> Option<Block> {
        let names = line.strip_prefix("let ")?.strip_suffix(" = {")?;
        let name = list(names)[0];
        let angle: AngleSum = name.strip_prefix(['s', 'c'])?.parse().ok()?;
        let trig = pair(names, angle)?;
        let argument = match angle.additions() {
            0 => format!("q[{}]", angle.terms().next()?.0),
            _ => format!("a{}", sums.pop_if(|sum| *sum == angle)?),
        };
        Some(Block::new(trig, argument, "x".to_owned()))
    }

    /// Takes a line; whether it ends the block.
    pub(super) fn line(&mut self, line: &str, dialect: Dialect) -> Result<bool, String> {
        if self.done {
            expect(line, "};")?;
            return Ok(true);
        }
        match holes(dialect.declaration, line) {
            Some([name, value]) => self.step(name, value, dialect)?,
            None => {
                let mut values = list(line).into_iter();
                let mut next = |taken: bool| match (taken, &mut values) {
                    (false, _) => Ok(None),
                    (true, values) => {
                        let word = values.next().unwrap_or_default();
                        output(word, |word| self.term(word, dialect)).map(Some)
                    }
                };
                let (sin, cos) = (next(self.trig.sin)?, next(self.trig.cos)?);
                if let Some(more) = values.next() {
                    return Err(format!("`{more}` is of no name"));
                }
                (self.kernel.sin, self.kernel.cos) = (sin, cos);
                self.done = true;
            }
        }
        Ok(false)
    }

    /// Takes an operation and its name.
    pub(super) fn step(&mut self, name: &str, value: &str, dialect: Dialect) -> Result<(), String> {
        expect(
            name,
            &format!("{}{}", self.prefix, self.kernel.steps.len() + 1),
        )?;
        let step = one_operation(value, dialect, |word| self.term(word, dialect))?;
        if matches!(step.operation, Operation::Div | Operation::Fused) {
            return Err(format!("`{value}` is no operation of a polynomial"));
        }
        self.kernel.steps.push(step);
        Ok(())
    }

    pub(super) fn term(&self, word: &str, dialect: Dialect) -> Result<Term, String> {
        if word == self.argument {
            return Ok(ANGLE);
        }
        if let Some(step) = word.strip_prefix(self.prefix.as_str()) {
            let step = step.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
            let step = step.filter(|&step| step < self.kernel.steps.len());
            return match step {
                Some(step) => Ok(Term::Step(step)),
                None => Err(format!("`{word}` is not computed yet")),
            };
        }
        let literal = dialect.read_literal(word).map(Term::Constant);
        literal.ok_or_else(|| format!("`{word}` is neither the angle, a value nor a literal"))
    }
}

/// Reads two operands and a symbol.
pub(super) fn one_operation<I>(
    value: &str,
    dialect: Dialect,
    operand: impl Fn(&str) -> Result<Operand<Literal, I>, String>,
) -> Result<Step<Literal, I>, String> {
    let (operation, [left, right]) = dialect
        .read_operation(value)
        .ok_or_else(|| format!("`{value}` is not one operation"))?;
    Ok(Step {
        operation,
        left: operand(left)?,
        right: operand(right)?,
    })
}

/// Reads a result: a negative literal is a literal, a negated value is negated.
pub(super) fn output<I>(
    word: &str,
    operand: impl Fn(&str) -> Result<Operand<Literal, I>, String>,
) -> Result<Output<Literal, I>, String> {
    match word.strip_prefix('-') {
        Some(rest) if !rest.starts_with(|c: char| c.is_ascii_digit()) => Ok(Output {
            negative: true,
            value: operand(rest)?,
        }),
        _ => Ok(Output::of(operand(word)?)),
    }
}

pub(super) fn trig(angle: AngleSum, sin: bool, cos: bool) -> LoweredTrig {
    LoweredTrig {
        angle,
        sin,
        cos,
        kernel: None,
    }
}

/// Returns the entries of `(a, b)`, or `a`.
pub(super) fn list(words: &str) -> Vec<&str> {
    let inner = words.strip_prefix('(').and_then(|w| w.strip_suffix(')'));
    inner.map_or(vec![words], |inner| inner.split(", ").collect())
}

/// Returns the sine, the cosine or both, by these names of an angle.
pub(super) fn pair(names: &str, angle: AngleSum) -> Option<LoweredTrig> {
    let (sine, cosine) = (format!("s{angle}"), format!("c{angle}"));
    let all = [(true, true), (true, false), (false, true)];
    let mut all = all.into_iter().map(|(sin, cos)| trig(angle, sin, cos));
    all.find(|trig| names == shown(trig, &sine, &cosine))
}

/// Returns the sine, the cosine or both, as they are written.
pub(super) fn shown(trig: &LoweredTrig, sine: &str, cosine: &str) -> String {
    match (trig.sin, trig.cos) {
        (true, false) => sine.to_owned(),
        (false, true) => cosine.to_owned(),
        _ => format!("({sine}, {cosine})"),
    }
}

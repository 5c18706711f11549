//! Reads emitted functions back and compares them with their program.

use std::fmt;

use crate::emit::ScalarType;
use crate::emit::function::input_name;
use crate::function::Function;
use crate::graph::{AngleSum, Counts, Input};
use crate::schedule::{Operand, Operation, Program};

/// An emitted function as its text says.
#[derive(Clone, Debug, PartialEq)]
pub struct TextProgram {
    /// Sines and cosines.
    pub trig: Vec<TextTrig>,
    /// The arithmetic.
    pub steps: Vec<TextStep>,
    /// The results, and whether each is negated.
    pub outputs: Vec<(bool, TextOperand)>,
}

/// `let (s1, c1) = …sincos(q[0]);` or one of the two alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextTrig {
    /// The angle.
    pub angle: AngleSum,
    /// Whether the sine is taken.
    pub sin: bool,
    /// Whether the cosine is taken.
    pub cos: bool,
}

/// `let t1 = left · right;`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStep {
    /// The operation.
    pub operation: Operation,
    /// Left operand.
    pub left: TextOperand,
    /// Right operand.
    pub right: TextOperand,
}

/// What a line reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextOperand {
    /// An input.
    Input(Input),
    /// A literal's value in the function's scalar, held exactly.
    Literal(f64),
    /// The result of an earlier line.
    Step(usize),
}

/// Why a text is not the program that it should be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    /// One-based line of the text.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "emitted line {}: {}", self.line, self.message)
    }
}

impl std::error::Error for TextError {}

impl TextProgram {
    /// Reads the function of this name out of a module's text.
    pub fn parse(
        module: &str,
        function: Function,
        scalar: ScalarType,
    ) -> Result<TextProgram, TextError> {
        let head = format!("pub fn {}(", function.name());
        let mut lines = module
            .lines()
            .enumerate()
            .map(|(i, line)| (i + 1, line.trim()));
        if !lines.any(|(_, line)| line.starts_with(&head)) {
            let message = format!("there is no function `{function}`");
            return Err(TextError { line: 1, message });
        }
        let mut reader = Reader {
            scalar,
            program: TextProgram {
                trig: Vec::new(),
                steps: Vec::new(),
                outputs: Vec::new(),
            },
            sum: None,
            block: None,
        };
        let mut tail = String::new();
        for (number, line) in lines {
            let at = |message| TextError {
                line: number,
                message,
            };
            if tail.is_empty() && reader.block(line).map_err(at)? {
                continue;
            }
            match line.strip_prefix("let ") {
                Some(statement) if tail.is_empty() => {
                    reader.statement(statement).map_err(at)?;
                }
                Some(_) => return Err(at("a statement after the result".into())),
                None if line == "}" && balanced(&tail) => {
                    reader.result(&tail).map_err(at)?;
                    return Ok(reader.program);
                }
                None => {
                    tail.push_str(line);
                    tail.push(' ');
                }
            }
        }
        let message = format!("`{function}` does not end");
        Err(TextError { line: 1, message })
    }

    /// Compares with the program: every operation, and every literal with its
    /// exact value rounded once.
    pub fn matches(&self, program: &Program, scalar: ScalarType) -> Result<(), String> {
        let trig = program.trig.iter().map(|t| TextTrig {
            angle: t.angle,
            sin: t.sin,
            cos: t.cos,
        });
        if !trig.eq(self.trig.iter().copied()) {
            return Err("the sines and cosines differ".into());
        }
        if self.steps.len() != program.steps.len() {
            return Err("the number of operations differs".into());
        }
        for (index, (text, step)) in self.steps.iter().zip(&program.steps).enumerate() {
            let same = text.operation == step.operation
                && is(&text.left, &step.left, scalar)
                && is(&text.right, &step.right, scalar);
            if !same {
                return Err(format!("operation t{} differs", index + 1));
            }
        }
        if self.outputs.len() != program.outputs.len() {
            return Err("the number of results differs".into());
        }
        for (index, (text, output)) in self.outputs.iter().zip(&program.outputs).enumerate() {
            if text.0 != output.negative || !is(&text.1, &output.value, scalar) {
                return Err(format!("result {index} differs"));
            }
        }
        Ok(())
    }

    /// The operations of the text.
    pub fn counts(&self) -> Counts {
        let is_mul = |step: &&TextStep| step.operation == Operation::Mul;
        let mul = self.steps.iter().filter(is_mul).count();
        let angles: usize = self.trig.iter().map(|t| t.angle.additions()).sum();
        Counts {
            mul,
            add: self.steps.len() - mul + angles,
            div: 0,
            sincos: self.trig.len(),
        }
    }
}

/// −0.0 and 0.0 differ here: the comparison is of bits.
fn is(text: &TextOperand, operand: &Operand, scalar: ScalarType) -> bool {
    match (text, operand) {
        (TextOperand::Input(a), Operand::Input(b)) => a == b,
        (TextOperand::Literal(a), Operand::Constant(b)) => a.to_bits() == scalar.round(b).to_bits(),
        (TextOperand::Step(a), Operand::Step(b)) => a == b,
        _ => false,
    }
}

fn balanced(text: &str) -> bool {
    let depth = text.chars().fold(0i64, |depth, c| match c {
        '{' | '[' => depth + 1,
        '}' | ']' => depth - 1,
        _ => depth,
    });
    !text.is_empty() && depth == 0
}

struct Reader {
    scalar: ScalarType,
    program: TextProgram,
    /// The sum of angles that the line before formed.
    sum: Option<AngleSum>,
    /// What the block that is open hands on, and whether it has done so.
    block: Option<(String, bool)>,
}

impl Reader {
    /// Whether the line begins or ends a block, which hands on values under
    /// the names that they have inside.
    fn block(&mut self, line: &str) -> Result<bool, String> {
        let begins = line
            .strip_prefix("let ")
            .and_then(|l| l.strip_suffix(" = {"));
        match (begins, self.block.take()) {
            (Some(names), None) => self.block = Some((names.to_owned(), false)),
            (Some(_), Some(_)) => return Err("a block in a block".into()),
            (None, Some((names, false))) if line.starts_with('(') => {
                if line != names {
                    return Err(format!("the block hands on {line} as {names}"));
                }
                self.block = Some((names, true));
            }
            (None, Some((_, true))) if line == "};" => {}
            (None, Some((_, true))) => return Err("the block does not end".into()),
            (None, open) => {
                self.block = open;
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// A line without `let `.
    fn statement(&mut self, line: &str) -> Result<(), String> {
        let line = line.strip_suffix(';').ok_or("no `;` at the end")?;
        let (name, value) = line.split_once(" = ").ok_or("no ` = `")?;
        if let Some(angle) = name.strip_prefix('a') {
            return self.angle_sum(angle, value);
        }
        if value.contains('(') {
            return self.trig(name, value);
        }
        let number = format!("t{}", self.program.steps.len() + 1);
        if name != number {
            return Err(format!("`{number}` is next, not `{name}`"));
        }
        let mut words = value.split(' ');
        let (left, symbol, right) = match (words.next(), words.next(), words.next(), words.next()) {
            (Some(left), Some(symbol), Some(right), None) => (left, symbol, right),
            _ => return Err(format!("`{value}` is not one operation")),
        };
        let operation = [Operation::Add, Operation::Sub, Operation::Mul]
            .into_iter()
            .find(|op| symbol.chars().eq([op.symbol()]))
            .ok_or_else(|| format!("`{symbol}` is no operation"))?;
        let (left, right) = (self.operand(left)?, self.operand(right)?);
        self.program.steps.push(TextStep {
            operation,
            left,
            right,
        });
        Ok(())
    }

    fn angle_sum(&mut self, name: &str, value: &str) -> Result<(), String> {
        let spaced = value
            .replace("-q", "- q")
            .replace("+ q", "+q")
            .replace("- q", "-q");
        let mut sum: Option<AngleSum> = None;
        for term in spaced.split(' ') {
            let (negative, term) = match term.strip_prefix('-') {
                Some(rest) => (true, rest),
                None => (false, term.strip_prefix('+').unwrap_or(term)),
            };
            let joint = index_of(term, "q").ok_or_else(|| format!("`{term}` is no position"))?;
            sum = Some(match sum {
                None if !negative => AngleSum::joint(joint),
                None => return Err("a sum of angles starts with a minus".into()),
                Some(sum) => sum.with(joint, negative).ok_or("a joint twice in a sum")?,
            });
        }
        let sum = sum.ok_or("an empty sum")?;
        if sum.to_string() != name {
            return Err(format!("`a{name}` is the sum {sum}"));
        }
        self.sum = Some(sum);
        Ok(())
    }

    fn trig(&mut self, name: &str, value: &str) -> Result<(), String> {
        let (path, argument) = value.split_once('(').ok_or("no call")?;
        let argument = argument.strip_suffix(')').ok_or("no `)`")?;
        let angle = match index_of(argument, "q") {
            Some(joint) => AngleSum::joint(joint),
            None => self
                .sum
                .take()
                .filter(|sum| argument == format!("a{sum}"))
                .ok_or_else(|| format!("`{argument}` is no angle"))?,
        };
        let call = path.rsplit("::").next().unwrap_or_default();
        let call = call
            .strip_suffix(self.scalar.math_suffix())
            .unwrap_or_default();
        let (sin, cos, expected) = match call {
            "sin" => (true, false, format!("s{angle}")),
            "cos" => (false, true, format!("c{angle}")),
            "sincos" => (true, true, format!("(s{angle}, c{angle})")),
            _ => return Err(format!("`{path}` is no sine or cosine")),
        };
        if name != expected {
            return Err(format!("`{expected}` expected, not `{name}`"));
        }
        self.program.trig.push(TextTrig { angle, sin, cos });
        Ok(())
    }

    fn operand(&self, word: &str) -> Result<TextOperand, String> {
        for (array, input) in [
            ("qdd", Input::Acceleration as fn(usize) -> Input),
            ("qd", Input::Velocity),
            ("q", Input::Position),
        ] {
            if let Some(joint) = index_of(word, array) {
                return Ok(TextOperand::Input(input(joint)));
            }
        }
        if let Some(step) = word.strip_prefix('t').and_then(|n| n.parse::<usize>().ok()) {
            if step == 0 || step > self.program.steps.len() {
                return Err(format!("`{word}` is not computed yet"));
            }
            return Ok(TextOperand::Step(step - 1));
        }
        for trig in &self.program.trig {
            for (taken, input) in [
                (trig.sin, Input::Sin(trig.angle)),
                (trig.cos, Input::Cos(trig.angle)),
            ] {
                if taken && word == input_name(input) {
                    return Ok(TextOperand::Input(input));
                }
            }
        }
        // `{:?}` always prints a point or an exponent: an integer would be
        // another type in Rust.
        word.contains(['.', 'e'])
            .then(|| self.scalar.parse(word))
            .flatten()
            .map(TextOperand::Literal)
            .ok_or_else(|| format!("`{word}` is neither a value nor a literal"))
    }

    fn result(&mut self, tail: &str) -> Result<(), String> {
        if self.block.is_some() {
            return Err("a block does not end".into());
        }
        let words = tail
            .split([' ', ',', '[', ']', '{', '}'])
            .filter(|word| !word.is_empty() && !word.ends_with(':'));
        for (index, word) in words.enumerate() {
            if index == 0 && word.starts_with(|c: char| c.is_ascii_uppercase()) {
                continue;
            }
            // A negative literal is a literal; a negated value is negated.
            let output = match word.strip_prefix('-') {
                Some(rest) if !rest.starts_with(|c: char| c.is_ascii_digit()) => {
                    (true, self.operand(rest)?)
                }
                _ => (false, self.operand(word)?),
            };
            self.program.outputs.push(output);
        }
        Ok(())
    }
}

/// i of `name[i]`.
fn index_of(word: &str, name: &str) -> Option<usize> {
    word.strip_prefix(name)?
        .strip_prefix('[')?
        .strip_suffix(']')?
        .parse()
        .ok()
}

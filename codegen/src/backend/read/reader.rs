//! The statements of an emitted function, line by line.

use crate::backend::entries::angles::Angles;
use crate::backend::read::error::{Kind, Mark, SineFault, TextFault, WordFault};
use crate::backend::read::fused::{self, Words};
use crate::backend::read::given;
use crate::backend::read::part::Wrap;
use crate::backend::read::sines::Block;
use crate::backend::read::speed;
use crate::backend::read::together;
use crate::backend::read::{binding, index_of, is_next};
use crate::function::Argument;
use crate::program::text::input_name;
use crate::program::{
    AngleSum, Input, Library, Literal, Lowered, LoweredTrig, Operand, Operation, Output,
    ScalarType, Step,
};

/// Reads one function.
pub(super) struct Reader<'a> {
    scalar: ScalarType,
    /// Where a caller's sines stand, if none is computed here.
    given: Option<&'a Angles>,
    program: Lowered,
    /// The sums of angles that lines before formed, and that none has read.
    sums: Vec<AngleSum>,
    /// The block or part that is open.
    wrap: Wrap,
    /// The polynomials of an angle that are open.
    sines: Option<Block>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(scalar: ScalarType) -> Reader<'a> {
        Reader {
            scalar,
            given: None,
            program: Lowered {
                scalar,
                library: Library::Libm,
                trig: Vec::new(),
                speeds: Vec::new(),
                steps: Vec::new(),
                outputs: Vec::new(),
            },
            sums: Vec::new(),
            wrap: Wrap::default(),
            sines: None,
        }
    }

    /// Of a function whose sines are its caller's.
    pub(super) fn given(scalar: ScalarType, angles: &'a Angles) -> Reader<'a> {
        Reader {
            given: Some(angles),
            ..Reader::new(scalar)
        }
    }

    /// Whether the line wraps statements and is none.
    pub(super) fn block(&mut self, line: &str) -> Result<bool, TextFault> {
        if let Some(block) = &mut self.sines {
            if let Some(trig) = block.line(line, self.scalar)? {
                self.program.trig.push(trig);
                self.sines = None;
            }
            return Ok(true);
        }
        self.sines = Block::begin(line, &mut self.sums);
        if self.sines.is_some() {
            return Ok(true);
        }
        self.wrap.line(line)
    }

    /// A line without `let `.
    pub(super) fn statement(&mut self, line: &str) -> Result<(), TextFault> {
        let (name, value) = binding(line)?;
        if let Some(angle) = name.strip_prefix('a') {
            return self.angle_sum(angle, value);
        }
        if let Some(angles) = self.given
            && let Some(pair) = given::read(name, value, angles)
        {
            self.program.trig.push(pair?);
            return Ok(());
        }
        if name.starts_with('r') {
            let speed = speed::read(name, value, self.scalar, &self.program.speeds)?;
            self.program.speeds.push(speed);
            return Ok(());
        }
        if let Some(words) = fused::words(value) {
            return self.fused(name, words?);
        }
        if value.contains('(') {
            return self.trig(name, value);
        }
        is_next(name, "t", self.program.steps.len())?;
        let mut words = value.split(' ');
        let (left, symbol, right) = match (words.next(), words.next(), words.next(), words.next()) {
            (Some(left), Some(symbol), Some(right), None) => (left, symbol, right),
            _ => return Err(Kind::OneOperation.not(value).into()),
        };
        let operation =
            Operation::from_symbol(symbol).ok_or_else(|| Kind::Operation.not(symbol))?;
        let (left, right) = (self.operand(left)?, self.operand(right)?);
        self.program.steps.push(Step {
            operation,
            left,
            right,
        });
        Ok(())
    }

    /// A sum and the product that it takes: two steps.
    fn fused(&mut self, name: &str, words: Words<'_>) -> Result<(), TextFault> {
        let product = self.program.steps.len();
        is_next(name, "t", product + 1)?;
        let left = self.operand(words.left)?;
        if matches!(left, Operand::Constant(_)) {
            return Err(Kind::Computed.not(words.left).into());
        }
        let (right, addend) = (self.operand(words.right)?, self.operand(words.addend)?);
        self.program.steps.push(Step {
            operation: Operation::Fused,
            left,
            right,
        });
        let product = Operand::Step(product);
        let (operation, left, right) = match (words.negative, words.minus) {
            (false, false) => (Operation::Add, product, addend),
            (false, true) => (Operation::Sub, product, addend),
            (true, _) => (Operation::Sub, addend, product),
        };
        self.program.steps.push(Step {
            operation,
            left,
            right,
        });
        Ok(())
    }

    fn angle_sum(&mut self, name: &str, value: &str) -> Result<(), TextFault> {
        let mut words = value.split(' ');
        let joint = |word: &str| index_of(word, "q").ok_or_else(|| Kind::Position.not(word));
        let first = words.next().unwrap_or_default();
        let mut sum = AngleSum::joint(joint(first)?);
        while let Some(sign) = words.next() {
            let negative = match sign {
                "+" => false,
                "-" => true,
                other => return Err(Kind::Sign.not(other).into()),
            };
            let term = joint(words.next().unwrap_or_default())?;
            sum = sum.with(term, negative).ok_or(SineFault::JointTwice)?;
        }
        if sum.to_string() != name {
            let name = name.to_owned();
            return Err(SineFault::Misnamed { name, sum }.into());
        }
        self.sums.push(sum);
        Ok(())
    }

    fn trig(&mut self, name: &str, value: &str) -> Result<(), TextFault> {
        if self.given.is_some() {
            return Err(Kind::GivenSine.not(value).into());
        }
        if self.program.library == Library::Together {
            return Err(SineFault::AfterAll.into());
        }
        let together = together::read(name, value, self.scalar, &mut self.sums);
        if let Some(called) = together {
            self.program.trig.extend(called?);
            self.program.library = Library::Together;
            return Ok(());
        }
        let (path, argument) = value.split_once('(').ok_or(WordFault::Lacks(Mark::Call))?;
        let argument = argument
            .strip_suffix(')')
            .ok_or(WordFault::Lacks(Mark::Parenthesis))?;
        let angle = match index_of(argument, "q") {
            Some(joint) => AngleSum::joint(joint),
            None => self
                .sums
                .pop()
                .filter(|sum| argument == format!("a{sum}"))
                .ok_or_else(|| Kind::Angle.not(argument))?,
        };
        let call = path.rsplit("::").next().unwrap_or_default();
        let call = call
            .strip_suffix(self.scalar.math_suffix())
            .unwrap_or_default();
        let (sin, cos, expected) = match call {
            "sin" => (true, false, format!("s{angle}")),
            "cos" => (false, true, format!("c{angle}")),
            "sincos" => (true, true, format!("(s{angle}, c{angle})")),
            _ => return Err(Kind::Sine.not(path).into()),
        };
        if name != expected {
            let found = name.to_owned();
            return Err(WordFault::Instead { expected, found }.into());
        }
        self.program.trig.push(LoweredTrig {
            angle,
            sin,
            cos,
            kernel: None,
        });
        Ok(())
    }

    fn operand(&self, word: &str) -> Result<Operand<Literal>, TextFault> {
        for argument in Argument::ALL {
            if let Some(joint) = index_of(word, argument.name()) {
                return Ok(Operand::Input(Input::Entry(argument, joint)));
            }
        }
        if let Some(step) = word.strip_prefix('t').and_then(|n| n.parse::<usize>().ok()) {
            let read = step
                .checked_sub(1)
                .and_then(|at| self.program.steps.get(at));
            // A product that a sum took has no name.
            return match read.map(|step| step.operation) {
                None | Some(Operation::Fused) => Err(Kind::Computed.not(word).into()),
                Some(_) => Ok(Operand::Step(step - 1)),
            };
        }
        let mut speeds = self.program.speeds.iter();
        let mut speeds = speeds.by_ref().map(|own| Input::PerSpeed(own.joint));
        if let Some(own) = speeds.find(|own| word == input_name(*own)) {
            return Ok(Operand::Input(own));
        }
        for trig in &self.program.trig {
            for (taken, input) in [
                (trig.sin, Input::Sin(trig.angle)),
                (trig.cos, Input::Cos(trig.angle)),
            ] {
                if taken && word == input_name(input) {
                    return Ok(Operand::Input(input));
                }
            }
        }
        // `{:?}` always prints a point or an exponent: an integer would be
        // another type in Rust.
        word.contains(['.', 'e'])
            .then(|| self.scalar.parse(word))
            .flatten()
            .map(|value| Operand::Constant(Literal(value)))
            .ok_or_else(|| Kind::Operand.not(word).into())
    }

    /// The sums of angles that no line has read.
    pub(super) fn take_sums(&mut self) -> Vec<AngleSum> {
        std::mem::take(&mut self.sums)
    }

    /// The program with these results.
    pub(super) fn finish(mut self, items: &[&str]) -> Result<Lowered, TextFault> {
        if !self.wrap.is_none() || self.sines.is_some() {
            return Err(TextFault::OpenBlock);
        }
        if let Some(&sum) = self.sums.first() {
            return Err(SineFault::Unread(sum).into());
        }
        for word in items {
            // A negative literal is a literal; a negated value is negated.
            let output = match word.strip_prefix('-') {
                Some(rest) if !rest.starts_with(|c: char| c.is_ascii_digit()) => Output {
                    negative: true,
                    value: self.operand(rest)?,
                },
                _ => Output::of(self.operand(word)?),
            };
            self.program.outputs.push(output);
        }
        Ok(self.program)
    }
}

//! The statements of an emitted function, line by line.

use super::block::{Block, one_operation, output};
use super::wrap::Wrap;
use super::{expect, index_of};
use crate::function::Argument;
use crate::language::dialect::{Dialect, holes};
use crate::program::text::input_name;
use crate::program::{AngleSum, Input, Library, Literal, Lowered, Operand, Operation, Speed, Step};

/// Reads one function.
pub(super) struct Reader {
    pub(super) dialect: Dialect,
    pub(super) program: Lowered,
    /// The sums of angles that lines before formed, and that none has read.
    pub(super) sums: Vec<AngleSum>,
    /// The block that is open.
    wrap: Wrap,
    /// The polynomials of an angle that are open.
    block: Option<Block>,
}

impl Reader {
    pub(super) fn new(dialect: Dialect) -> Reader {
        Reader {
            dialect,
            program: Lowered {
                scalar: dialect.scalar,
                library: Library::Libm,
                trig: Vec::new(),
                speeds: Vec::new(),
                steps: Vec::new(),
                outputs: Vec::new(),
            },
            sums: Vec::new(),
            wrap: Wrap::default(),
            block: None,
        }
    }

    /// Takes a line, unless it is of the result.
    pub(super) fn line(&mut self, line: &str) -> Result<bool, String> {
        if let Some(mut block) = self.block.take() {
            match block.line(line, self.dialect)? {
                true => self.program.trig.push(block.done()),
                false => self.block = Some(block),
            }
            return Ok(true);
        }
        self.block = Block::begin(line, &mut self.sums);
        if self.block.is_some() || self.wrap.line(line)? {
            return Ok(true);
        }
        if !line.starts_with("let ") {
            return Ok(false);
        }
        let [name, value] = holes(self.dialect.declaration, line)
            .ok_or_else(|| format!("`{line}` gives no value a name"))?;
        self.declaration(name, value)?;
        Ok(true)
    }

    /// Takes a value and its name.
    pub(super) fn declaration(&mut self, name: &str, value: &str) -> Result<(), String> {
        if let Some(angle) = name.strip_prefix('a') {
            return self.angle_sum(angle, value);
        }
        if name.starts_with('r') {
            return self.speed(name, value);
        }
        if let Some(words) = holes(self.dialect.fused, value) {
            return self.fused(name, value, words);
        }
        let is_operation = self.dialect.read_operation(value).is_some();
        if !is_operation && value.contains('(') {
            return self.sines(name, value);
        }
        self.next(name, 1)?;
        let step = one_operation(value, self.dialect, |word| self.operand(word))?;
        self.program.steps.push(step);
        Ok(())
    }

    /// Statements are numbered from one: refuses a name that is not that of the step after
    /// those that there are.
    fn next(&self, name: &str, after: usize) -> Result<(), String> {
        expect(name, &format!("t{}", self.program.steps.len() + after))
    }

    /// Reads a sum and the product that it takes: two steps.
    fn fused(&mut self, name: &str, value: &str, words: [&str; 3]) -> Result<(), String> {
        let [left, right, addend] = words;
        self.next(name, 2)?;
        let factor = holes(self.dialect.negative, left);
        let negated = addend.strip_prefix('-');
        let not = || format!("`{value}` is not one fused multiply-add");
        // No program subtracts both: its result would be negated instead.
        let (left, right) = match (factor, negated) {
            (Some(_), Some(_)) => return Err(not()),
            (Some([factor]), None) => (self.operand(factor)?, self.operand(right)?),
            (None, _) => (self.operand(left)?, self.operand(right)?),
        };
        if matches!(left, Operand::Constant(_)) {
            return Err(not());
        }
        let product = Operand::Step(self.program.steps.len());
        let sum = self.operand(negated.unwrap_or(addend))?;
        self.program.steps.push(Step {
            operation: Operation::Fused,
            left,
            right,
        });
        let (operation, left, right) = match (factor, negated) {
            (None, None) => (Operation::Add, product, sum),
            (None, Some(_)) => (Operation::Sub, product, sum),
            (Some(_), _) => (Operation::Sub, sum, product),
        };
        self.program.steps.push(Step {
            operation,
            left,
            right,
        });
        Ok(())
    }

    fn angle_sum(&mut self, name: &str, value: &str) -> Result<(), String> {
        let mut words = value.split(' ');
        let not = || format!("`{value}` is no sum of positions");
        let joint = |word: Option<&str>| word.and_then(|word| index_of(word, "q")).ok_or_else(not);
        let mut sum = AngleSum::joint(joint(words.next())?);
        while let Some(sign) = words.next() {
            let negative = match sign {
                "+" => false,
                "-" => true,
                _ => return Err(not()),
            };
            sum = sum.with(joint(words.next())?, negative).ok_or_else(not)?;
        }
        expect(name, &sum.to_string())?;
        self.sums.push(sum);
        Ok(())
    }

    /// Returns what Coulomb friction reads: `1.0 / libm::sqrt(qd[1] * qd[1] + 0.0001)`.
    fn speed(&mut self, name: &str, value: &str) -> Result<(), String> {
        let not =
            || format!("`{value}` is not one over the root of a velocity's square and a width's");
        let call = value.strip_prefix(&self.dialect.literal(Literal(1.0)));
        let call = call.and_then(|call| call.strip_prefix(" / "));
        let (function, sum) = call.and_then(|call| self.called(call)).ok_or_else(not)?;
        let words = sum.rsplit_once(" + ");
        let (product, square) = words.ok_or_else(not)?;
        let [left, right] = holes(self.dialect.product, product).ok_or_else(not)?;
        let joint = index_of(left, "qd").filter(|_| left == right && function == "sqrt");
        let square = self.dialect.read_literal(square);
        let (joint, square) = joint.zip(square).ok_or_else(not)?;
        expect(name, &input_name(Input::PerSpeed(joint)))?;
        let last = self.program.speeds.last();
        if last.is_some_and(|last| last.joint >= joint) {
            return Err(format!("`{name}` is not in the order of the joints"));
        }
        self.program.speeds.push(Speed { joint, square });
        Ok(())
    }

    /// Returns the name of a library's function, without its scalar, and what it is called with.
    pub(super) fn called<'t>(&self, value: &'t str) -> Option<(&'t str, &'t str)> {
        let (path, arguments) = value.strip_suffix(')')?.split_once('(')?;
        let function = match self.dialect.separator {
            "" => path,
            separator => path.rsplit_once(separator)?.1,
        };
        let function = function.strip_suffix(self.dialect.scalar.math_suffix())?;
        Some((function, arguments))
    }

    fn operand(&self, word: &str) -> Result<Operand<Literal>, String> {
        for argument in Argument::ALL {
            if let Some(joint) = index_of(word, argument.name()) {
                return Ok(Operand::Input(Input::Entry(argument, joint)));
            }
        }
        if let Some(step) = word.strip_prefix('t').and_then(|n| n.parse::<usize>().ok()) {
            let before = step.checked_sub(1);
            let read = before.and_then(|at| self.program.steps.get(at));
            // A product that a sum took has no name.
            return match read.map(|step| step.operation) {
                None | Some(Operation::Fused) => Err(format!("`{word}` is not computed yet")),
                Some(_) => Ok(Operand::Step(step - 1)),
            };
        }
        let speeds = self.program.speeds.iter();
        let speeds = speeds.map(|own| Input::PerSpeed(own.joint));
        let sines = self.program.trig.iter().flat_map(|trig| {
            let sine = trig.sin.then_some(Input::Sin(trig.angle));
            let cosine = trig.cos.then_some(Input::Cos(trig.angle));
            sine.into_iter().chain(cosine)
        });
        if let Some(input) = speeds.chain(sines).find(|&own| word == input_name(own)) {
            return Ok(Operand::Input(input));
        }
        let literal = self.dialect.read_literal(word).map(Operand::Constant);
        literal.ok_or_else(|| format!("`{word}` is neither a value nor a literal"))
    }

    /// Returns the program with these results.
    pub(super) fn finish(mut self, items: &[&str]) -> Result<Lowered, String> {
        if !self.wrap.is_closed() || self.block.is_some() {
            return Err("a block does not end".into());
        }
        if let Some(sum) = self.sums.first() {
            return Err(format!("nothing reads `a{sum}`"));
        }
        for word in items {
            let output = output(word, |word| self.operand(word))?;
            self.program.outputs.push(output);
        }
        Ok(self.program)
    }
}

//! The statements of an emitted function, line by line.

use super::block::{Block, one_operation, sign};
use super::wrap::Wrap;
use super::{expect, index_of};
use crate::dag::{Edge, Id, Node, Writer};
use crate::function::Argument;
use crate::language::dialect::{Dialect, holes};
use crate::program::text::input_name;
use crate::program::{Code, Input, Library, Literal, Operation, Pair, Speed};

/// Reads one function.
pub(super) struct Reader {
    pub(super) dialect: Dialect,
    pub(super) library: Library,
    pub(super) pairs: Vec<Pair>,
    speeds: Vec<Speed<Literal>>,
    writer: Writer<Literal, Input>,
    /// The operations so far; none of a product that a sum took, which has no name.
    operations: Vec<Option<Id>>,
    /// The block that is open.
    wrap: Wrap,
    /// The polynomials of an angle that are open.
    block: Option<Block>,
}

impl Reader {
    pub(super) fn new(dialect: Dialect) -> Reader {
        Reader {
            dialect,
            library: Library::Libm,
            pairs: Vec::new(),
            speeds: Vec::new(),
            writer: Writer::default(),
            operations: Vec::new(),
            wrap: Wrap::default(),
            block: None,
        }
    }

    /// Takes a line, unless it is of the result.
    pub(super) fn line(&mut self, line: &str) -> Result<bool, String> {
        if let Some(mut block) = self.block.take() {
            match block.line(line, self.dialect)? {
                true => self.pairs.push(block.done()),
                false => self.block = Some(block),
            }
            return Ok(true);
        }
        self.block = Block::begin(line);
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
        let (operation, [left, right]) = one_operation(value, self.dialect)?;
        let operands = [self.operand(left)?, self.operand(right)?];
        self.operations
            .push(Some(self.writer.apply(operation, operands)));
        Ok(())
    }

    /// Statements are numbered from one: refuses a name that is not that of the operation so many
    /// after those that there are.
    fn next(&self, name: &str, after: usize) -> Result<(), String> {
        expect(name, &format!("t{}", self.operations.len() + after))
    }

    /// Reads a sum and the product that it takes: two operations.
    fn fused(&mut self, name: &str, value: &str, words: [&str; 3]) -> Result<(), String> {
        let [left, right, addend] = words;
        self.next(name, 2)?;
        let factor = holes(self.dialect.negative, left);
        let negated = addend.strip_prefix('-');
        let not = || format!("`{value}` is not one fused multiply-add");
        // No program subtracts both: its result would be negated instead.
        let left = match (factor, negated) {
            (Some(_), Some(_)) => return Err(not()),
            (Some([factor]), None) => factor,
            (None, _) => left,
        };
        let factors = [self.operand(left)?, self.operand(right)?];
        if matches!(self.writer.node(factors[0]), Node::Constant(_)) {
            return Err(not());
        }
        let product = self.writer.apply(Operation::Fused, factors);
        let addend = self.operand(negated.unwrap_or(addend))?;
        let (operation, operands) = match (factor, negated) {
            (None, None) => (Operation::Add, [product, addend]),
            (None, Some(_)) => (Operation::Sub, [product, addend]),
            (Some(_), _) => (Operation::Sub, [addend, product]),
        };
        let sum = self.writer.apply(operation, operands);
        self.operations.extend([None, Some(sum)]);
        Ok(())
    }

    /// Returns what Coulomb friction reads: `1.0 / libm::sqrt(qd[1] * qd[1] + 0.0001)`.
    fn speed(&mut self, name: &str, value: &str) -> Result<(), String> {
        let not =
            || format!("`{value}` is not one over the root of a velocity's square and a width's");
        let call = value.strip_prefix(&self.dialect.literal(Literal(1.0)));
        let call = call.and_then(|call| call.strip_prefix(" / "));
        let called = |call| {
            let mut libraries = Library::ALL.into_iter();
            libraries.find_map(|library| self.called(library, call))
        };
        let (function, sum) = call.and_then(called).ok_or_else(not)?;
        let words = sum.rsplit_once(" + ");
        let (product, square) = words.ok_or_else(not)?;
        let [left, right] = holes(self.dialect.product, product).ok_or_else(not)?;
        let joint = index_of(left, "qd").filter(|_| left == right && function == "sqrt");
        let square = self.dialect.read_literal(square);
        let (joint, square) = joint.zip(square).ok_or_else(not)?;
        expect(name, &input_name(Input::PerSpeed(joint)))?;
        let last = self.speeds.last();
        if last.is_some_and(|last| last.joint >= joint) {
            return Err(format!("`{name}` is not in the order of the joints"));
        }
        self.speeds.push(Speed { joint, square });
        Ok(())
    }

    /// Returns the name of a library's function, without its scalar, and what it is called with.
    /// Before the library may stand whoever re-exports it.
    pub(super) fn called<'t>(
        &self,
        library: Library,
        value: &'t str,
    ) -> Option<(&'t str, &'t str)> {
        let (path, arguments) = value.strip_suffix(')')?.split_once('(')?;
        let function = match self.dialect.separator {
            "" => path,
            separator => {
                let (path, function) = path.rsplit_once(separator)?;
                let mut names = path.rsplit(separator);
                let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
                let is_own = names.next() == Some(library.path()) && names.all(is_name);
                is_own.then_some(function)?
            }
        };
        let function = function.strip_suffix(self.dialect.scalar.math_suffix())?;
        Some((function, arguments))
    }

    fn operand(&mut self, word: &str) -> Result<Id, String> {
        if let Some(number) = word.strip_prefix('t').and_then(|n| n.parse::<usize>().ok()) {
            let before = number.checked_sub(1);
            let read = before.and_then(|at| self.operations.get(at).copied().flatten());
            return read.ok_or_else(|| format!("`{word}` is not computed yet"));
        }
        let leaf = match (self.input(word), self.dialect.read_literal(word)) {
            (Some(input), _) => Node::Input(input),
            (None, Some(literal)) => Node::Constant(literal),
            (None, None) => return Err(format!("`{word}` is neither a value nor a literal")),
        };
        Ok(self.writer.leaf(leaf))
    }

    /// Returns the input of a name: an entry of an argument, or what was computed before.
    fn input(&self, word: &str) -> Option<Input> {
        for argument in Argument::ALL {
            if let Some(joint) = index_of(word, argument.name()) {
                return Some(Input::Entry(argument, joint));
            }
        }
        let speeds = self.speeds.iter().map(|own| Input::PerSpeed(own.joint));
        let sines = self.pairs.iter().flat_map(|pair| {
            let sine = pair.need.sin.then_some(Input::Sin(pair.joint));
            let cosine = pair.need.cos.then_some(Input::Cos(pair.joint));
            sine.into_iter().chain(cosine)
        });
        speeds.chain(sines).find(|&own| word == input_name(own))
    }

    /// Returns the program with these results.
    pub(super) fn finish(mut self, items: &[&str]) -> Result<Code, String> {
        if !self.wrap.is_closed() || self.block.is_some() {
            return Err("a block does not end".into());
        }
        let mut outputs = Vec::new();
        for word in items {
            let (negative, word) = sign(word);
            let node = self.operand(word)?;
            outputs.push(Edge { node, negative });
        }
        Ok(Code {
            scalar: self.dialect.scalar,
            library: self.library,
            pairs: self.pairs,
            speeds: self.speeds,
            dag: self.writer.finish(outputs),
        })
    }
}

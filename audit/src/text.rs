//! The text of a function, read into straight-line code. The grammar is small and
//! strict: what is not in it is refused with its line, however harmless.
//!
//! ```text
//! pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2]) -> [f64; 2] {
//!     let (s1, c1) = libm::sincos(q[0]);
//!     let t1 = qd[0] * 0.5;
//!     [-t1, 0.0]
//! }
//! ```

use std::collections::HashMap;
use std::ops::Range;

use crate::fault::Fault;
use crate::lexer::{Token, tokens};

/// The most values of a function.
const MOST_NODES: usize = 20_000;

/// The arguments of a function, one entry a joint each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Argument {
    /// q
    Position,
    /// q̇
    Velocity,
    /// q̈
    Acceleration,
}

/// Where a sine or cosine comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A library that gives both within one ulp: libm, or dalembert-sines.
    Library,
    /// The result of a block of arithmetic, of its index, and which of its steps.
    Block(usize, usize),
}

/// A value; operands are indices of values before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node {
    /// A literal as the scalar holds it.
    Constant(f64),
    /// An entry of an argument.
    Input(Argument, usize),
    /// A sum.
    Add(usize, usize),
    /// A difference.
    Sub(usize, usize),
    /// A product.
    Mul(usize, usize),
    /// The opposite, which is exact.
    Neg(usize),
    /// What stands for the sine of a value.
    Sin(usize, Source),
    /// What stands for the cosine of a value.
    Cos(usize, Source),
}

/// A function.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Its name.
    pub name: String,
    /// Whether it is in f32; else it is in f64.
    pub is_single: bool,
    /// All values, in order.
    pub nodes: Vec<Node>,
    /// Blocks that compute sines; value 0 of each is the angle.
    pub blocks: Vec<Vec<Node>>,
    /// The values returned, of a matrix row by row.
    pub outputs: Vec<usize>,
}

struct Parser<'t> {
    tokens: Vec<Token<'t>>,
    at: usize,
    joints: usize,
    program: Program,
    names: HashMap<&'t str, usize>,
    arguments: HashMap<&'t str, Argument>,
    /// Whether what is read is in a block, and where that first names its angle.
    is_inside: bool,
    angle: Option<Range<usize>>,
}

/// Reads a function of an arm of so many joints that returns an array of the rows, or
/// rows of as many entries.
///
/// # Errors
/// The first thing that is not of the grammar, with its line.
pub fn read(text: &str, joints: usize, rows: usize) -> Result<Program, Fault> {
    let mut parser = Parser {
        tokens: tokens(text)?,
        at: 0,
        joints,
        program: Program::default(),
        names: HashMap::new(),
        arguments: HashMap::new(),
        is_inside: false,
        angle: None,
    };
    parser.function(rows)?;
    Ok(parser.program)
}

impl<'t> Parser<'t> {
    fn peek(&self) -> &'t str {
        self.tokens.get(self.at).map_or("", |token| token.text)
    }

    fn next(&mut self) -> &'t str {
        let text = self.peek();
        self.at += 1;
        text
    }

    fn fail<T>(&self, expected: &str) -> Result<T, Fault> {
        let at = self.at.min(self.tokens.len().saturating_sub(1));
        let line = self.tokens.get(at).map_or(1, |token| token.line);
        Err(Fault::Text(line, format!("expected {expected}, found `{}`", self.peek())))
    }

    /// Takes these tokens, given with spaces between them.
    fn expect(&mut self, words: &str) -> Result<(), Fault> {
        for word in words.split(' ') {
            if self.peek() != word {
                return self.fail(&format!("`{word}`"));
            }
            self.at += 1;
        }
        Ok(())
    }

    fn takes(&mut self, word: &str) -> bool {
        let found = self.peek() == word;
        self.at += usize::from(found);
        found
    }

    fn function(&mut self, rows: usize) -> Result<(), Fault> {
        if self.peek() == "#" {
            self.expect("# [ must_use ]")?;
        }
        self.expect("pub fn")?;
        self.program.name = self.next().to_owned();
        self.expect("(")?;
        let mut scalar = "";
        let known = [Argument::Position, Argument::Velocity, Argument::Acceleration];
        while !self.takes(")") {
            let name = self.next();
            let plain = name.strip_prefix('_').unwrap_or(name);
            let place = ["q", "qd", "qdd"].iter().position(|known| *known == plain);
            let Some(place) = place.filter(|&place| self.arguments.values().all(|a| *a as usize != place)) else {
                self.at -= 1;
                return self.fail("one of q, qd and qdd");
            };
            self.arguments.insert(name, known[place]);
            self.expect(": & [")?;
            let own = self.peek();
            if !["f64", "f32"].contains(&own) || !["", own].contains(&scalar) {
                return self.fail("f64 or f32, the same everywhere");
            }
            scalar = own;
            self.expect(&format!("{own} ; {} ]", self.joints))?;
            if !self.takes(",") && self.peek() != ")" {
                return self.fail("`)`");
            }
        }
        self.program.is_single = scalar == "f32";
        self.expect("-> [")?;
        let is_matrix = self.takes("[");
        self.expect(&format!("{scalar} ; {rows} ]"))?;
        if is_matrix {
            self.expect(&format!("; {rows} ]"))?;
        }
        self.expect("{")?;
        while self.takes("let") {
            self.statement()?;
            self.expect(";")?;
        }
        self.results(rows, is_matrix)?;
        self.expect("}")?;
        if self.at < self.tokens.len() {
            return self.fail("nothing after the function");
        }
        Ok(())
    }

    fn results(&mut self, rows: usize, is_matrix: bool) -> Result<(), Fault> {
        self.expect("[")?;
        for _ in 0..rows {
            if is_matrix {
                self.expect("[")?;
            }
            for entry in 0..if is_matrix { rows } else { 1 } {
                let value = self.operand()?;
                self.program.outputs.push(value);
                if is_matrix && (self.peek() != "]" || entry + 1 < rows) {
                    self.expect(",")?;
                }
            }
            if is_matrix {
                self.expect("]")?;
            }
            if self.peek() != "]" {
                self.expect(",")?;
            }
        }
        self.expect("]")
    }

    fn push(&mut self, node: Node) -> Result<usize, Fault> {
        if self.program.nodes.len() >= MOST_NODES {
            return self.fail(&format!("at most {MOST_NODES} values"));
        }
        self.program.nodes.push(node);
        Ok(self.program.nodes.len() - 1)
    }

    /// What follows `let`.
    fn statement(&mut self) -> Result<(), Fault> {
        if self.takes("(") {
            if self.takes("[") {
                return self.together();
            }
            let sin = self.name()?;
            self.expect(",")?;
            let cos = self.name()?;
            self.expect(") =")?;
            return self.sines(&[(sin, true), (cos, false)], "sincos");
        }
        let name = self.name()?;
        self.expect("=")?;
        let call = if name.starts_with('s') { "sin" } else { "cos" };
        if ["libm", "dalembert_sines", "{"].contains(&self.peek()) {
            return self.sines(&[(name, call == "sin")], call);
        }
        let value = self.operation()?;
        self.names.insert(name, value);
        Ok(())
    }

    /// A name that is not taken.
    fn name(&mut self) -> Result<&'t str, Fault> {
        let name = self.peek();
        let is_word = name.starts_with(|c: char| c.is_ascii_lowercase());
        if !is_word || self.names.contains_key(name) || ["q", "qd", "qdd"].contains(&name) {
            return self.fail("a name that is not taken");
        }
        self.at += 1;
        Ok(name)
    }

    /// One operation on two operands.
    fn operation(&mut self) -> Result<usize, Fault> {
        let left = self.operand()?;
        let operation = self.next();
        let right = self.operand()?;
        match operation {
            "+" => self.push(Node::Add(left, right)),
            "-" => self.push(Node::Sub(left, right)),
            "*" => self.push(Node::Mul(left, right)),
            _ => {
                self.at -= 1;
                self.fail("one `+`, `-` or `*` between two operands")
            }
        }
    }

    fn operand(&mut self) -> Result<usize, Fault> {
        if self.takes("-") {
            let value = self.unsigned()?;
            return self.push(Node::Neg(value));
        }
        self.unsigned()
    }

    fn unsigned(&mut self) -> Result<usize, Fault> {
        let word = self.peek();
        if let Some(&value) = self.names.get(word) {
            self.at += 1;
            return Ok(value);
        }
        if self.is_inside && word.starts_with(|c: char| c.is_ascii_lowercase()) {
            return self.angle();
        }
        if let Some(&argument) = self.arguments.get(word) {
            self.at += 1;
            self.expect("[")?;
            let Some(joint) = self.peek().parse().ok().filter(|joint| *joint < self.joints) else {
                return self.fail("the index of a joint");
            };
            self.at += 1;
            self.expect("]")?;
            return self.push(Node::Input(argument, joint));
        }
        let value = match self.program.is_single {
            true => word.parse::<f32>().ok().map(f64::from),
            false => word.parse::<f64>().ok(),
        };
        let is_literal = word.contains(['.', 'e']) && word.starts_with(|c: char| c.is_ascii_digit());
        match value.filter(|value| is_literal && value.is_finite()) {
            Some(value) => {
                self.at += 1;
                self.push(Node::Constant(value))
            }
            None => self.fail("a value, an argument's entry or a literal"),
        }
    }

    /// A call of a library, or a block, for the sine or the cosine of an angle or both.
    fn sines(&mut self, names: &[(&'t str, bool)], call: &str) -> Result<(), Fault> {
        let (angle, sources) = match self.peek() {
            "{" => self.block(names.len())?,
            _ => {
                self.library(call)?;
                self.expect("(")?;
                let angle = self.operand()?;
                self.expect(")")?;
                (angle, vec![Source::Library; names.len()])
            }
        };
        for (&(name, is_sine), source) in names.iter().zip(sources) {
            self.bind(name, is_sine, angle, source)?;
        }
        Ok(())
    }

    fn bind(&mut self, name: &'t str, is_sine: bool, angle: usize, source: Source) -> Result<(), Fault> {
        let node = if is_sine { Node::Sin(angle, source) } else { Node::Cos(angle, source) };
        let value = self.push(node)?;
        match self.names.insert(name, value) {
            None => Ok(()),
            Some(_) => self.fail("names that differ"),
        }
    }

    /// The name of a library's function, of the scalar.
    fn library(&mut self, call: &str) -> Result<(), Fault> {
        if !self.takes("dalembert_sines") && !self.takes("libm") {
            return self.fail("libm or dalembert_sines");
        }
        let suffix = if self.program.is_single { "f" } else { "" };
        self.expect(&format!(":: {call}{suffix}"))
    }

    /// `([s1, s2], [c1, _]) = dalembert_sines::sincos(&[q[0], q[1]])`, behind its first
    /// two brackets.
    fn together(&mut self) -> Result<(), Fault> {
        let (mut names, mut angles) = ([vec![], vec![]], vec![]);
        for (which, close) in ["] , [", "] ) ="].iter().enumerate() {
            while self.peek() != "]" {
                let name = if self.takes("_") { None } else { Some(self.name()?) };
                names[which].push(name);
                if !self.takes(",") && self.peek() != "]" {
                    return self.fail("`]`");
                }
            }
            self.expect(close)?;
        }
        self.library("sincos")?;
        self.expect("( & [")?;
        while !self.takes("]") {
            angles.push(self.operand()?);
            if !self.takes(",") && self.peek() != "]" {
                return self.fail("`]`");
            }
        }
        self.expect(")")?;
        if names.iter().any(|names| names.len() != angles.len()) {
            return self.fail("as many sines, cosines and angles");
        }
        for (names, is_sine) in names.into_iter().zip([true, false]) {
            for (name, &angle) in names.into_iter().zip(&angles) {
                if let Some(name) = name {
                    self.bind(name, is_sine, angle, Source::Library)?;
                }
            }
        }
        Ok(())
    }

    /// A block: arithmetic on one angle, with names of its own. Returns the angle and
    /// which steps the results are.
    fn block(&mut self, results: usize) -> Result<(usize, Vec<Source>), Fault> {
        self.expect("{")?;
        let nodes = std::mem::replace(&mut self.program.nodes, vec![Node::Constant(0.0)]);
        let names = std::mem::take(&mut self.names);
        self.is_inside = true;
        while self.takes("let") {
            let name = self.name()?;
            self.expect("=")?;
            let value = self.operation()?;
            self.names.insert(name, value);
            self.expect(";")?;
        }
        let (open, close) = if results > 1 { ("(", ")") } else { ("", "") };
        self.takes(open);
        let mut sources = Vec::new();
        for result in 0..results {
            if result > 0 {
                self.expect(",")?;
            }
            let value = self.operand()?;
            sources.push(Source::Block(self.program.blocks.len(), value));
        }
        self.takes(close);
        self.expect("}")?;
        let block = std::mem::replace(&mut self.program.nodes, nodes);
        self.program.blocks.push(block);
        self.names = names;
        self.is_inside = false;
        // The angle, read once more where the block first names it.
        let Some(angle) = self.angle.take() else {
            return self.fail("a block that reads an angle");
        };
        let behind = std::mem::replace(&mut self.at, angle.start);
        let angle = self.operand()?;
        self.at = behind;
        Ok((angle, sources))
    }

    /// What a block reads that is not its own: always the same angle, its value 0.
    fn angle(&mut self) -> Result<usize, Fault> {
        let start = self.at;
        let word = self.next();
        if self.arguments.contains_key(word) {
            self.expect("[")?;
            self.at += 1;
            self.expect("]")?;
        }
        let angle = self.angle.get_or_insert(start..self.at).clone();
        let spelled = |range: Range<usize>| self.tokens.get(range).map(|tokens| tokens.iter().map(|t| t.text));
        match (spelled(angle), spelled(start..self.at)) {
            (Some(one), Some(other)) if one.clone().eq(other.clone()) => Ok(0),
            _ => self.fail("a block that reads one angle only"),
        }
    }
}

//! The text of a function, read into straight-line code, a line at a time. The grammar is
//! what the generator prints; what is not in it is refused with its line, however harmless.
//!
//! ```text
//! #[must_use]
//! pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2]) -> [f64; 2] {
//!     let (s1, c1) = libm::sincos(q[0]);
//!     let t1 = qd[0] * 0.5;
//!     [-t1, 0.0]
//! }
//! ```

use std::collections::HashMap;

use crate::fault::Fault;

/// The most values of a function.
const MOST_NODES: usize = 20_000;

/// Where a sine or cosine comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A library that gives both within one ulp: libm, or dalembert-sines.
    Library,
    /// A block of arithmetic, of its index, and which of its values.
    Block(usize, usize),
}

/// A value; operands are indices of values before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node {
    /// A literal as the scalar holds it.
    Constant(f64),
    /// Of q, q̇ or q̈, counted from zero, the entry of a joint.
    Input(usize, usize),
    /// A sum.
    Add(usize, usize),
    /// A difference.
    Sub(usize, usize),
    /// A product.
    Mul(usize, usize),
    /// The opposite, which is exact.
    Neg(usize),
    /// What stands for the sine of a value, or else for its cosine.
    Sine(usize, bool, Source),
}

/// A function.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// All values, in order.
    pub nodes: Vec<Node>,
    /// Blocks that compute sines; value 0 of each is the angle.
    pub blocks: Vec<Vec<Node>>,
    /// The values returned, of a matrix row by row.
    pub outputs: Vec<usize>,
}

/// What a text must be: a function of this name, in `f64` or `f32`, of an arm of so many
/// joints, that returns so many numbers, or a matrix of so many rows and columns.
#[derive(Clone, Copy, Debug)]
pub struct Kind<'k> {
    /// Its name.
    pub name: &'k str,
    /// Its scalar.
    pub scalar: &'k str,
    /// Its joints.
    pub joints: usize,
    /// Its results, or rows of results.
    pub rows: usize,
    /// Whether it returns a matrix.
    pub is_matrix: bool,
}

struct Parser<'t> {
    kind: Kind<'t>,
    lines: std::iter::Enumerate<std::str::Lines<'t>>,
    line: usize,
    program: Program,
    names: HashMap<&'t str, usize>,
    /// Which of q, qd and qdd the head names.
    arguments: HashMap<&'t str, usize>,
    /// Inside of a block, how it spells its angle, once it has.
    angle: Option<&'t str>,
    is_inside: bool,
}

/// Reads a function.
///
/// # Errors
/// The first thing that is not of the grammar or not of this kind, with its line.
pub fn read(text: &str, kind: Kind) -> Result<Program, Fault> {
    let mut parser = Parser {
        kind,
        lines: text.lines().enumerate(),
        line: 0,
        program: Program::default(),
        names: HashMap::new(),
        arguments: HashMap::new(),
        angle: None,
        is_inside: false,
    };
    match parser.function() {
        Some(()) => Ok(parser.program),
        None => {
            let line = text.lines().nth(parser.line).unwrap_or("").trim();
            Err(Fault::Text(parser.line + 1, format!("not of the grammar or the claim: `{line}`")))
        }
    }
}

impl<'t> Parser<'t> {
    fn next(&mut self) -> Option<&'t str> {
        let (number, line) = self.lines.next()?;
        self.line = number;
        Some(line.trim())
    }

    fn function(&mut self) -> Option<()> {
        let Kind { name, scalar, joints, rows, is_matrix } = self.kind;
        let mut head = self.next()?;
        if head == "#[must_use]" {
            head = self.next()?;
        }
        let returned = if is_matrix {
            format!("[[{scalar}; {rows}]; {rows}]")
        } else {
            format!("[{scalar}; {rows}]")
        };
        let list = head.strip_prefix("pub fn ")?.strip_prefix(name)?.strip_prefix('(')?;
        let list = list.strip_suffix(&format!(") -> {returned} {{"))?;
        let parameter = format!(": &[{scalar}; {joints}]");
        for part in list.split(", ") {
            let argument = part.strip_suffix(&parameter)?;
            let known = argument.strip_prefix('_').unwrap_or(argument);
            let place = ["q", "qd", "qdd"].iter().position(|word| *word == known)?;
            if self.arguments.values().any(|&before| before >= place) {
                return None;
            }
            self.arguments.insert(argument, place);
        }
        let mut line = self.next()?;
        while let Some(statement) = line.strip_prefix("let ") {
            self.statement(statement)?;
            line = self.next()?;
        }
        let mut results = line.to_owned();
        loop {
            line = self.next()?;
            if line == "}" {
                break;
            }
            results = results + " " + line;
        }
        self.results(&results)?;
        self.lines.all(|(_, line)| line.trim().is_empty()).then_some(())
    }

    /// The results, written as an array or a matrix of as many entries as are asked for.
    fn results(&mut self, written: &str) -> Option<()> {
        let Kind { rows, is_matrix, .. } = self.kind;
        let written = written.replace(' ', "");
        let inner = written.strip_prefix('[')?.strip_suffix(']')?;
        let lists: Vec<&str> = match is_matrix {
            true => inner.strip_prefix('[')?.strip_suffix("],")?.split("],[").collect(),
            false => vec![inner],
        };
        for list in &lists {
            let before = self.program.outputs.len();
            for word in list.split(',') {
                let value = self.operand(word)?;
                self.program.outputs.push(value);
            }
            if self.program.outputs.len() - before != rows {
                return None;
            }
        }
        (lists.len() == if is_matrix { rows } else { 1 }).then_some(())
    }

    fn push(&mut self, node: Node) -> Option<usize> {
        self.program.nodes.push(node);
        let count = self.program.nodes.len();
        (count <= MOST_NODES).then(|| count - 1)
    }

    /// What follows `let `.
    fn statement(&mut self, statement: &'t str) -> Option<()> {
        let (names, value) = statement.split_once(" = ")?;
        if value == "{" {
            return self.block(names);
        }
        let value = value.strip_suffix(';')?;
        let suffix = if self.kind.scalar == "f32" { "f" } else { "" };
        if let Some(lists) = names.strip_prefix("([") {
            let (sines, cosines) = lists.strip_suffix("])")?.split_once("], [")?;
            let call = value.strip_prefix("dalembert_sines::sincos")?.strip_prefix(suffix)?;
            let angles = call.strip_prefix("(&[")?.strip_suffix("])")?;
            let [sines, cosines, angles] =
                [sines, cosines, angles].map(|list| list.split(", ").collect::<Vec<_>>());
            if sines.len() != angles.len() || cosines.len() != angles.len() {
                return None;
            }
            for (k, word) in angles.into_iter().enumerate() {
                let angle = self.operand(word)?;
                for (name, is_sine) in [(sines[k], true), (cosines[k], false)] {
                    if name != "_" {
                        self.name(name, Node::Sine(angle, is_sine, Source::Library))?;
                    }
                }
            }
            return Some(());
        }
        if let Some((call, angle)) = value.split_once('(') {
            let called = call.strip_prefix("libm::")?.strip_suffix(suffix)?;
            let angle = self.operand(angle.strip_suffix(')')?)?;
            return match (called, pair(names)) {
                ("sincos", Some([sin, cos])) => {
                    self.name(sin, Node::Sine(angle, true, Source::Library))?;
                    self.name(cos, Node::Sine(angle, false, Source::Library))
                }
                ("sin" | "cos", None) => {
                    self.name(names, Node::Sine(angle, called == "sin", Source::Library))
                }
                _ => None,
            };
        }
        let node = self.operation(value)?;
        self.name(names, node)
    }

    /// Adds a value of a new name: a small letter, then letters and digits.
    fn name(&mut self, name: &'t str, node: Node) -> Option<()> {
        let plain = name.starts_with(|c: char| c.is_ascii_lowercase())
            && name.chars().all(|c| c.is_ascii_alphanumeric())
            && !["q", "qd", "qdd"].contains(&name);
        let value = self.push(node)?;
        (plain && self.names.insert(name, value).is_none()).then_some(())
    }

    /// One operation on two operands.
    fn operation(&mut self, text: &'t str) -> Option<Node> {
        let words: Vec<&str> = text.split(' ').collect();
        let &[left, operation, right] = words.as_slice() else {
            return None;
        };
        let (left, right) = (self.operand(left)?, self.operand(right)?);
        match operation {
            "+" => Some(Node::Add(left, right)),
            "-" => Some(Node::Sub(left, right)),
            "*" => Some(Node::Mul(left, right)),
            _ => None,
        }
    }

    fn operand(&mut self, word: &str) -> Option<usize> {
        if let Some(word) = word.strip_prefix('-') {
            let value = self.unsigned(word)?;
            return self.push(Node::Neg(value));
        }
        self.unsigned(word)
    }

    /// A name, an entry of an argument, or a literal.
    fn unsigned(&mut self, word: &str) -> Option<usize> {
        if let Some(&value) = self.names.get(word) {
            return Some(value);
        }
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            let value = match self.kind.scalar {
                "f32" => f64::from(word.parse::<f32>().ok()?),
                _ => word.parse::<f64>().ok()?,
            };
            return self
                .push(Node::Constant(value))
                .filter(|_| value.is_finite() && word.contains(['.', 'e']));
        }
        if self.is_inside {
            return None;
        }
        let (argument, joint) = word.strip_suffix(']')?.split_once('[')?;
        let (argument, joint) = (*self.arguments.get(argument)?, joint.parse().ok()?);
        self.push(Node::Input(argument, joint)).filter(|_| joint < self.kind.joints)
    }

    /// A block: arithmetic on one angle, with names of its own.
    fn block(&mut self, names: &'t str) -> Option<()> {
        let outside = std::mem::take(&mut self.names);
        let nodes = std::mem::replace(&mut self.program.nodes, vec![Node::Constant(0.0)]);
        self.is_inside = true;
        let mut line = self.next()?;
        while let Some(statement) = line.strip_prefix("let ") {
            let (name, value) = statement.strip_suffix(';')?.split_once(" = ")?;
            // What is no name of the block and no literal is the angle, always the same.
            let own = |word: &&str| {
                !["+", "-", "*"].contains(word)
                    && !self.names.contains_key(word.trim_start_matches('-'))
                    && !word.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit())
            };
            if let Some(word) = value.split(' ').find(own) {
                if *self.angle.get_or_insert(word) != word {
                    return None;
                }
                self.names.insert(word, 0);
            }
            let node = self.operation(value)?;
            self.name(name, node)?;
            line = self.next()?;
        }
        let results = pair(line).map_or(vec![line], Vec::from);
        let values: Option<Vec<usize>> = results.iter().map(|word| self.operand(word)).collect();
        self.program.blocks.push(std::mem::replace(&mut self.program.nodes, nodes));
        self.names = outside;
        self.is_inside = false;
        let word = self.angle.take()?;
        let angle = self.operand(word)?;
        let names = pair(names).map_or(vec![names], Vec::from);
        let values =
            values.filter(|values| values.len() == names.len() && self.next() == Some("};"))?;
        for (name, value) in names.iter().zip(values) {
            let is_sine = name.starts_with('s');
            let source = Source::Block(self.program.blocks.len() - 1, value);
            self.name(name, Node::Sine(angle, is_sine, source))?;
        }
        Some(())
    }
}

/// Both parts of `(one, other)`.
fn pair(text: &str) -> Option<[&str; 2]> {
    let (one, other) = text.strip_prefix('(')?.strip_suffix(')')?.split_once(", ")?;
    Some([one, other])
}

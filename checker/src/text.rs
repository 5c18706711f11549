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
use std::fmt::Debug;
use std::str::FromStr;

use crate::certificate::Claim;
use crate::fault::Fault;
use crate::file::{between, structure};
use crate::interval::FARTHEST;
use crate::program::{Node, Program, Source};
use crate::quantity::{ARGUMENTS, Function, entries};
use crate::scene::Setting;

/// The most values of a function.
const MOST_NODES: usize = 20_000;

/// A function that is being read.
#[derive(Default)]
pub(crate) struct Parser<'t> {
    name: &'t str,
    pub(crate) function: Function,
    pub(crate) scalar: &'t str,
    pub(crate) joints: usize,
    pub(crate) rows: usize,
    lines: Vec<&'t str>,
    /// How many lines are read.
    line: usize,
    pub(crate) program: Program,
    names: HashMap<&'t str, usize>,
    /// Which arguments the head names.
    pub(crate) arguments: HashMap<&'t str, usize>,
    /// Whether a block is read, and how it spells its angle, once it has.
    pub(crate) is_inside: bool,
    /// `true` while a part of a long function is read.
    is_part: bool,
    angle: Option<&'t str>,
    /// What is around the block that is read, and what it results in: names and values.
    outside: (HashMap<&'t str, usize>, Vec<Node>),
    pub(crate) results: Vec<(&'t str, usize)>,
    /// In a header, the list of angles; and what stands for the sine, or else the cosine, of a value
    /// or a joint.
    pub(crate) angles: Vec<usize>,
    pub(crate) sines: HashMap<String, (Result<usize, usize>, bool)>,
    /// The angle in the names of a block of a header.
    pub(crate) block: Option<&'t str>,
    /// What literals end with.
    pub(crate) suffix: &'static str,
}

/// Reads the function of a claim about an arm.
///
/// # Errors
/// The first thing that is not of the grammar or not of this claim, with its line; a sine of
/// something else than a signed sum of joint positions, or of an angle that is far.
pub fn read(claim: &Claim, setting: &Setting) -> Result<Program, Fault> {
    let (text, joints) = (&claim.text, setting.joints.len());
    let mut parser = Parser {
        name: &claim.function,
        function: claim.function()?,
        scalar: &claim.scalar,
        joints,
        rows: claim.rows.len(),
        lines: text.split('\n').collect(),
        ..Parser::default()
    };
    let read = match text.contains("static inline ") {
        true => parser.c_function(text),
        false => parser.rust_function(),
    };
    if read.is_some() {
        return near(claim, &parser.program, setting).map(|()| parser.program);
    }
    let line = parser.lines.get(parser.line.saturating_sub(1));
    let line = line.unwrap_or(&"").trim();
    let why = format!("not of the grammar or the claim: `{line}`");
    Err(Fault::Text(parser.line.max(1), why))
}

/// Refuses a sine of something that is no angle, or of one where the checker's own sine is none.
fn near(claim: &Claim, program: &Program, setting: &Setting) -> Result<(), Fault> {
    let angles = program.angles(|joint| setting.joints[joint].turns);
    let far = |&(joint, _): &(usize, bool)| {
        let range = claim.position.get(joint).into_iter().flatten();
        range.fold(0.0, |most: f64, end| most.max(end.abs()))
    };
    for node in &program.nodes {
        let &Node::Sine(angle, ..) = node else {
            continue;
        };
        let angle = angles[angle].as_ref();
        let angle = angle.ok_or(Fault::certificate("a sine of something that is no angle"))?;
        let why = "the sine of an angle beyond 1000 rad";
        Fault::unless(angle.iter().map(far).sum::<f64>() < FARTHEST, why)?;
    }
    Ok(())
}

impl<'t> Parser<'t> {
    pub(crate) fn next(&mut self) -> Option<&'t str> {
        let left = self.lines.get(self.line..)?;
        self.line += 1 + left.iter().position(|line| !line.is_empty())?;
        let line = self.lines[self.line - 1];
        let is_plain = line.bytes().all(|byte| (b' '..=b'~').contains(&byte));
        is_plain.then(|| line.trim_matches(' '))
    }

    fn rust_function(&mut self) -> Option<()> {
        let (scalar, fields) = (self.scalar, self.function.fields.clone());
        let (joints, rows) = (self.joints, self.rows);
        let mut line = self.next()?;
        if line == "#[must_use]" {
            line = self.next()?;
        }
        let array = |shape: Vec<usize>| {
            let lengths = shape.iter().rev();
            lengths.fold(scalar.to_owned(), |t, length| format!("[{t}; {length}]"))
        };
        let is_struct = fields.len() > 1;
        let returned = match is_struct {
            true => structure(self.name),
            false => array(fields.first()?.1.shape(rows)),
        };
        let head = format!("pub fn {}(", self.name);
        let list = between(line, &head, &format!(") -> {returned} {{"))?;
        for part in list.split(", ") {
            let (argument, kind) = part.split_once(": ")?;
            let length = entries(argument, joints);
            (kind == format!("&[{scalar}; {length}]")).then_some(())?;
            self.argument(argument)?;
        }
        line = self.statements()?;
        match is_struct {
            false => self.array(line, &fields.first()?.1.shape(rows), "")?,
            true => {
                (line.strip_suffix(" {")? == returned).then_some(())?;
                for (field, quantity) in fields {
                    let line = self.next()?.strip_prefix(field)?.strip_prefix(": ")?;
                    self.array(line, &quantity.shape(rows), ",")?;
                }
                (self.next()? == "}").then_some(())?;
            }
        }
        (self.next()? == "}" && self.is_done()).then_some(())
    }

    /// Reads lines that have to be these.
    pub(crate) fn expect(&mut self, lines: &str) -> Option<()> {
        let mut lines = lines.lines();
        lines.all(|line| self.next() == Some(line)).then_some(())
    }

    /// Returns whether no text is left.
    pub(crate) fn is_done(&self) -> bool {
        self.lines[self.line..].iter().all(|line| line.is_empty())
    }

    /// Adds an argument of the head.
    pub(crate) fn argument(&mut self, argument: &'t str) -> Option<()> {
        let known = argument.strip_prefix('_').unwrap_or(argument);
        let place = ARGUMENTS.iter().position(|word| *word == known)?;
        let is_next = self.arguments.values().all(|&before| before < place);
        self.arguments.insert(argument, place);
        is_next.then_some(())
    }

    /// Adds a result.
    pub(crate) fn output(&mut self, word: &'t str) -> Option<()> {
        let value = self.operand(word)?;
        self.program.outputs.push(value);
        Some(())
    }

    /// Adds the entries of an array that begins in a line and ends before some text.
    fn array(&mut self, line: &'t str, shape: &[usize], end: &str) -> Option<()> {
        match shape {
            [] => self.output(line.strip_suffix(end)?)?,
            &[length] => {
                let list = between(line.strip_suffix(end)?, "[", "]")?;
                list.split(", ").try_for_each(|word| self.output(word))?;
                (list.split(", ").count() == length).then_some(())?;
            }
            [length, inner @ ..] => {
                (line == "[").then_some(())?;
                for _ in 0..*length {
                    let line = self.next()?;
                    self.array(line, inner, ",")?;
                }
                (self.next()?.strip_suffix(end)? == "]").then_some(())?;
            }
        }
        Some(())
    }

    /// Reads all statements; returns the line behind them.
    fn statements(&mut self) -> Option<&'t str> {
        let mut line = self.next()?;
        while let Some((names, value)) = line.strip_prefix("let ").and_then(|s| s.split_once(" = "))
        {
            match value.strip_suffix(';') {
                None if value == "{" && names.ends_with(",)") => self.long(names)?,
                None if value == "{" && !self.is_inside => self.block(names)?,
                value => self.statement(names, value?)?,
            }
            line = self.next()?;
        }
        Some(line)
    }

    pub(crate) fn statement(&mut self, names: &'t str, value: &'t str) -> Option<()> {
        let words: Vec<&str> = value.split(' ').collect();
        if let &[left, operation, right] = words.as_slice()
            && !value.contains("::")
        {
            let (left, right) = (self.operand(left)?, self.operand(right)?);
            let node = match operation {
                "+" => Node::Add(left, right),
                "-" => Node::Sub(left, right),
                "*" => Node::Mul(left, right),
                "/" if self.function.is_tried() && !self.is_inside => Node::Div(left, right),
                _ => return None,
            };
            return self.name(names, node);
        }
        if let Some((left, rest)) = value.split_once(".mul_add(") {
            let left = between(left, "(", ")").unwrap_or(left);
            let (right, addend) = rest.strip_suffix(')')?.split_once(", ")?;
            let [left, right] = [self.operand(left)?, self.operand(right)?];
            let addend = self.operand(addend)?;
            return self.name(names, Node::Fused(left, right, addend));
        }
        let (call, angles) = value.strip_suffix(')')?.split_once('(')?;
        let suffix = if self.scalar == "f32" { "f" } else { "" };
        let call = call.strip_suffix(suffix)?;
        // Of one angle, or the lists of all.
        let lists = between(names, "([", "])");
        let (sines, cosines, angles) = match (call, lists, pair(names)) {
            ("dalembert_sines::sincos", Some(lists), _) => {
                let (sines, cosines) = lists.split_once("], [")?;
                (sines, cosines, between(angles, "&[", "]")?)
            }
            ("libm::sincos", None, Some([sin, cos])) => (sin, cos, angles),
            ("libm::sin", None, None) => (names, "_", angles),
            ("libm::cos", None, None) => ("_", names, angles),
            _ => return None,
        };
        let [sines, cosines, angles] = [sines, cosines, angles].map(|list| list.split(", "));
        let mut both = [sines, cosines];
        for word in angles {
            let angle = self.operand(word)?;
            for (names, is_sine) in both.iter_mut().zip([true, false]) {
                let name = names.next()?;
                if name != "_" {
                    self.name(name, Node::Sine(angle, is_sine, Source::Library))?;
                }
            }
        }
        both.iter_mut()
            .all(|names| names.next().is_none())
            .then_some(())
    }

    pub(crate) fn push(&mut self, node: Node) -> Option<usize> {
        self.program.nodes.push(node);
        let count = self.program.nodes.len();
        (count <= MOST_NODES && !(self.is_inside && matches!(node, Node::Sine(..))))
            .then(|| count - 1)
    }

    /// Adds a value of a new name: a letter for its kind, then joints or its number.
    pub(crate) fn name(&mut self, name: &'t str, node: Node) -> Option<()> {
        let behind = name.strip_prefix(['a', 'c', 's', 't', 'x'])?;
        let is_plain = behind.starts_with(|c: char| c.is_ascii_digit() || c == 'm')
            && behind
                .chars()
                .all(|c| c.is_ascii_digit() || ['p', 'm', '_'].contains(&c));
        let value = self.push(node)?;
        (is_plain && self.names.insert(name, value).is_none()).then_some(())
    }

    pub(crate) fn operand(&mut self, word: &'t str) -> Option<usize> {
        if let Some(word) = word.strip_prefix('-') {
            let value = self.unsigned(word)?;
            return self.push(Node::Neg(value));
        }
        self.unsigned(word)
    }

    /// Reads a name, a literal, or an entry of an argument; what a block reads beside its own
    /// is its angle, always the same.
    fn unsigned(&mut self, word: &'t str) -> Option<usize> {
        if let Some(&value) = self.names.get(word) {
            return Some(value);
        }
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            let word = word.strip_suffix(self.suffix)?;
            let value = match self.scalar {
                "f32" => literal::<f32>(word)?,
                _ => literal::<f64>(word)?,
            };
            return self.push(Node::Constant(value));
        }
        if self.is_inside {
            return (*self.angle.get_or_insert(word) == word).then_some(0);
        }
        let (argument, index) = word.strip_suffix(']')?.split_once('[')?;
        let (argument, joint) = (*self.arguments.get(argument)?, index.parse::<usize>().ok()?);
        let length = entries(ARGUMENTS[argument], self.joints);
        let is_entry = joint < length && index == joint.to_string();
        self.push(Node::Input(argument, joint)).filter(|_| is_entry)
    }

    /// Reads a part of a long function: it hands on values by their names, and the others are
    /// no more.
    fn long(&mut self, names: &'t str) -> Option<()> {
        if self.is_inside || std::mem::replace(&mut self.is_part, true) {
            return None;
        }
        let before = self.names.clone();
        (self.statements()? == names && self.next()? == "};").then_some(())?;
        let inside = std::mem::replace(&mut self.names, before);
        for name in between(names, "(", ",)")?.split(", ") {
            let is_old = self.names.insert(name, *inside.get(name)?).is_some();
            (!is_old).then_some(())?;
        }
        self.is_part = false;
        Some(())
    }

    /// Reads a block: arithmetic on one angle, with names of its own.
    fn block(&mut self, names: &'t str) -> Option<()> {
        self.open();
        let line = self.statements()?;
        let words = pair(line).map_or(vec![line], Vec::from);
        let values = words.into_iter().map(|word| self.operand(word));
        let values = values.collect::<Option<Vec<usize>>>()?;
        let names = pair(names).map_or(vec![names], Vec::from);
        (names.len() == values.len()).then_some(())?;
        self.results = names.into_iter().zip(values).collect();
        self.close()?;
        (self.next()? == "};").then_some(())
    }

    pub(crate) fn open(&mut self) {
        self.is_inside = true;
        let nodes = vec![Node::Constant(0.0)];
        let nodes = std::mem::replace(&mut self.program.nodes, nodes);
        self.outside = (std::mem::take(&mut self.names), nodes);
    }

    /// Ends a block, if one is read, and names its results.
    pub(crate) fn close(&mut self) -> Option<()> {
        if !std::mem::take(&mut self.is_inside) {
            return Some(());
        }
        let (names, nodes) = std::mem::take(&mut self.outside);
        let block = std::mem::replace(&mut self.program.nodes, nodes);
        (self.names, self.block) = (names, None);
        self.program.blocks.push(block);
        let word = self.angle.take()?;
        let angle = self.operand(word)?;
        for (name, value) in std::mem::take(&mut self.results) {
            let source = Source::Block(self.program.blocks.len() - 1, value);
            self.name(name, Node::Sine(angle, name.starts_with('s'), source))?;
        }
        Some(())
    }
}

/// Returns a number as it is printed.
fn literal<T: FromStr + Debug + Into<f64>>(word: &str) -> Option<f64> {
    let value: T = word.parse().ok()?;
    let is_printed = format!("{value:?}") == word;
    Some(value.into()).filter(|value| is_printed && value.is_finite())
}

/// Returns both parts of `(one, other)`.
fn pair(text: &str) -> Option<[&str; 2]> {
    let (one, other) = between(text, "(", ")")?.split_once(", ")?;
    Some([one, other])
}

//! The text of a claim's function, as values of straight-line code.

use std::collections::HashMap;

use crate::c99;
use crate::certificate::Claim;
use crate::fault::Fault;
use crate::identity::program::{Operand, Program as Straight};
use crate::interval::FARTHEST;
use crate::program::{Node, Program, Source};
use crate::quantity::{ARGUMENTS, entries};
use crate::read::{self, Argument, Head, Text, TextError, camel};
use crate::scene::Setting;

/// The most values of a function.
const MOST_NODES: usize = 20_000;

/// Reads the function of a claim about an arm.
///
/// # Errors
/// The first thing that is not of the grammar or not of this claim, with its line; a sine of an
/// angle that is far.
pub fn read(claim: &Claim, setting: &Setting) -> Result<Program, Fault> {
    let function = claim.function()?;
    let (text, joints, rows) = (&claim.text, setting.joints.len(), claim.rows.len());
    let is_c = text.contains("static inline ");
    let fields = function.fields.iter();
    let structure = (function.fields.len() > 1).then(|| camel(&claim.function));
    // Which arguments there are, the head says: they have to be in their order.
    let named = |name: &str| match is_c {
        true => [" double ", " float "]
            .iter()
            .any(|kind| text.contains(&format!("const{kind}{name}["))),
        false => {
            let head = text.split(") ->").next().unwrap_or("");
            [
                format!("({name}: "),
                format!(" {name}: "),
                format!("_{name}: "),
            ]
            .iter()
            .any(|word| head.contains(word))
        }
    };
    let arguments = ARGUMENTS.iter().enumerate().filter(|(_, name)| named(name));
    let head = Head {
        name: &claim.function,
        is_single: claim.scalar == "f32",
        arguments: arguments
            .map(|(place, &name)| Argument {
                place,
                name,
                length: entries(name, joints),
            })
            .collect(),
        fields: fields.map(|(name, own)| (*name, own.shape(rows))).collect(),
        structure: structure.as_deref(),
        joints,
    };
    let read = match is_c {
        true => {
            let text = Text::c(text).map_err(fault)?;
            let symbols = c99::symbols(&claim.text, head.is_single);
            text.c_function(&head, &symbols, !symbols.batch.is_empty())
        }
        false => Text::rust(text).and_then(|text| text.rust_function(&head, false)),
    };
    let (read, is_all) = read.map_err(fault)?;
    let is_allowed = function.is_tried() || read.program.steps.iter().all(|step| step.0 != '/');
    if !is_all || !is_allowed || !read.speeds.is_empty() {
        return Err(Fault::Text(1, "more than the claim's function".into()));
    }
    let program = nodes(&read);
    let is_small = program.nodes.len() <= MOST_NODES;
    let why = "a function of more than 20000 values";
    let small = is_small
        .then_some(())
        .ok_or_else(|| Fault::Text(1, why.into()));
    small
        .and_then(|()| near(claim, &read, setting))
        .map(|()| program)
}

/// Returns a fault of a text.
pub(crate) fn fault(own: TextError) -> Fault {
    Fault::Text(own.line, format!("not of the grammar: {}", own.reason))
}

/// Refuses a sine of a joint that slides, or of an angle where the checker's own sine is none.
fn near(claim: &Claim, read: &read::Function, setting: &Setting) -> Result<(), Fault> {
    let mut sines = read.sines.iter();
    let turns = sines.all(|own| setting.joints[own.joint].turns);
    Fault::unless(turns, "a sine of something that is no angle")?;
    let far = |own: &read::Sines| {
        let range = claim.position.get(own.joint).into_iter().flatten();
        range.fold(0.0, |most: f64, end| most.max(end.abs()))
    };
    let most = read.sines.iter().map(far).fold(0.0, f64::max);
    Fault::unless(most < FARTHEST, "the sine of an angle beyond 1000 rad")
}

/// Returns polynomials of an angle as a list of values, and which are the results.
pub(crate) fn block(polynomial: &Straight<f64>) -> (Vec<Node>, Vec<usize>) {
    let mut block = Program::default();
    let angle = block.push(Node::Constant(0.0));
    let leaf = |operand: &Operand<f64>| matches!(operand, Operand::Entry(..)).then_some(angle);
    let values = block.take(&polynomial.steps, &leaf);
    let mut results = Vec::new();
    for (negative, operand) in &polynomial.outputs {
        let value = block.operand(operand, &values, &leaf);
        results.push(match negative {
            true => block.push(Node::Neg(value)),
            false => value,
        });
    }
    (block.nodes, results)
}

/// Returns what was read as a list of values.
fn nodes(read: &read::Function) -> Program {
    let mut program = Program::default();
    let mut sines: HashMap<(usize, bool), usize> = HashMap::new();
    for own in &read.sines {
        let angle = program.push(Node::Input(0, own.joint));
        let mut results = Vec::new();
        if let read::Source::Polynomial(polynomial) = &own.source {
            let (block, own) = block(polynomial);
            results = own;
            program.blocks.push(block);
        }
        let block = program.blocks.len().saturating_sub(1);
        let mut results = results.into_iter();
        for (is_sine, _) in [true, false].into_iter().zip(own.needs).filter(|own| own.1) {
            let source = results
                .next()
                .map_or(Source::Library, |value| Source::Block(block, value));
            let value = program.push(Node::Sine(angle, is_sine, source));
            sines.insert((own.joint, is_sine), value);
        }
    }
    let leaf = |operand: &Operand<f64>| match operand {
        Operand::Sine(angle, is_sine) => sines.get(&(angle.first()?.0, *is_sine)).copied(),
        _ => None,
    };
    let values = program.take(&read.program.steps, &leaf);
    for (negative, operand) in &read.program.outputs {
        let value = program.operand(operand, &values, &leaf);
        let value = match negative {
            true => program.push(Node::Neg(value)),
            false => value,
        };
        program.outputs.push(value);
    }
    program
}

/// What stands for an operand that is not of a list of values.
type Leaf<'l> = dyn Fn(&Operand<f64>) -> Option<usize> + 'l;

impl Program {
    fn push(&mut self, node: Node) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Adds steps; returns the value of each.
    fn take(&mut self, steps: &[(char, [Operand<f64>; 2])], leaf: &Leaf) -> Vec<usize> {
        let mut values: Vec<usize> = Vec::with_capacity(steps.len());
        // Of a product that is not rounded, what its sum is of.
        let mut factors: Option<[usize; 2]> = None;
        for (operation, operands) in steps {
            let [left, right] = operands
                .each_ref()
                .map(|own| self.operand(own, &values, leaf));
            let node = match (factors.take(), operation) {
                (None, '×') => {
                    factors = Some([left, right]);
                    values.push(usize::MAX);
                    continue;
                }
                (Some([a, b]), '+') => Node::Fused(a, b, right),
                (Some([a, b]), _) if left == usize::MAX => {
                    let addend = self.push(Node::Neg(right));
                    Node::Fused(a, b, addend)
                }
                (Some([a, b]), _) => {
                    let factor = self.push(Node::Neg(a));
                    Node::Fused(factor, b, left)
                }
                (None, '+') => Node::Add(left, right),
                (None, '-') => Node::Sub(left, right),
                (None, '*') => Node::Mul(left, right),
                (None, _) => Node::Div(left, right),
            };
            let value = self.push(node);
            values.push(value);
        }
        values
    }

    fn operand(&mut self, operand: &Operand<f64>, values: &[usize], leaf: &Leaf) -> usize {
        match (leaf(operand), operand) {
            (Some(value), _) => value,
            (None, Operand::Step(step)) => values.get(*step).copied().unwrap_or(usize::MAX),
            (None, Operand::Constant(constant)) => self.push(Node::Constant(*constant)),
            (None, Operand::Entry(argument, index)) => self.push(Node::Input(*argument, *index)),
            (None, _) => self.push(Node::Constant(f64::NAN)),
        }
    }
}

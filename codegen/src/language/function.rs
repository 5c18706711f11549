//! One program as one flat function.
//!
//! One operation a line, so that the printed text can be read back and compared with the program
//! operation by operation. Long functions are cut into blocks (see [`BLOCK`]); names stay unique.

use crate::dag::Id;
use crate::function::{Argument, Function, Sizes};
use crate::language::dialect::{Dialect, Lines};
use crate::language::loops::{self, LoopText, Piece};
use crate::language::result::{self, array_type};
use crate::language::{comment, list, trig};
use crate::program::{Code, Input, Library, Program, ScalarType};

pub(crate) const FLAT: usize = 1000;

/// To rustc each `let` opens a scope inside the one before, and its debug information walks them
/// recursively: somewhere above 2 000 it overflows the compiler's stack. A block closes its scopes.
pub(crate) const BLOCK: usize = 500;

pub(crate) const LOAD: &str = "Load";
pub(crate) const PAYLOAD: &str = "Payload";
pub(crate) const BODIES: &str = "Bodies";
pub(crate) const BODY: &str = "Body";
pub(crate) const GRAVITY: &str = "Gravity";

/// Prints the function, whose roots are this library's; `doc` stands above it, one line an item.
pub fn write(program: &Program, code: &Code, library: Library, doc: &[String]) -> String {
    let mut text = comment("///", doc);
    text += &format!("#[must_use]\n{} {{\n", signature(program, code));
    let dialect = Dialect::rust(code.scalar);
    trig::write(&mut text, code);
    trig::write_speeds(&mut text, dialect, code, library.path());
    let lines = write_pieces(&mut text, code, dialect);
    let (function, sizes) = (program.function, program.sizes());
    result::write(&mut text, function, sizes, lines.results());
    text.push_str("}\n");
    text
}

pub(super) fn write_steps(text: &mut String, code: &Code, dialect: Dialect) {
    let ids: Vec<Id> = code.dag.operations().map(|(id, ..)| id).collect();
    let lines = Lines::new(dialect, code);
    write_shared(text, code, &lines, &ids, ids.len() > FLAT, Id::MAX);
}

/// Writes operations outside of loops; `end` is the first one behind them.
fn write_shared(
    text: &mut String,
    code: &Code,
    lines: &Lines<'_, Input>,
    ids: &[Id],
    is_cut: bool,
    end: Id,
) {
    Blocks {
        indent: "    ",
        is_cut,
        last_use: &last_uses(code),
        is_whole: &|id| code.dag.fusion(id).is_none(),
        name: &|id| lines.operand(id),
        lines: &|id| lines.statement(id).into_iter().collect(),
    }
    .write(text, ids, end);
}

/// Writes operations, and returns the names by which results read them.
fn write_pieces<'c>(text: &mut String, code: &'c Code, dialect: Dialect) -> Lines<'c, Input> {
    let (lines, pieces) = loops::pieces(dialect, code);
    let shared = pieces.iter().map(|piece| match piece {
        Piece::Shared(ids) => ids.len(),
        Piece::Lanes(_) => 0,
    });
    let is_cut = shared.sum::<usize>() > FLAT;
    for (place, piece) in pieces.iter().enumerate() {
        match piece {
            Piece::Shared(ids) => {
                let next = pieces[place + 1..].iter().find_map(Piece::first);
                let end = next.unwrap_or(Id::MAX);
                write_shared(text, code, &lines, ids, is_cut, end);
            }
            Piece::Lanes(lanes) => write_loop(text, code, lanes),
        }
    }
    lines
}

fn write_loop(text: &mut String, code: &Code, lanes: &LoopText) {
    for line in &lanes.before {
        *text += &format!("    {line}\n");
    }
    *text += &format!("    {}\n", lanes.head);
    let ids: Vec<Id> = lanes.rows.iter().map(|row| row.0).collect();
    // Nothing outside of the loop reads them but by its array.
    let mut last_use = vec![0; code.dag.nodes.len()];
    for &id in &ids {
        // A fused product stands in the line of its sum.
        let factors = code.dag.fusion(id).map(|fusion| fusion.factors);
        let operands = [code.dag.node(id).operands(), factors];
        for operand in operands.into_iter().flatten().flatten() {
            last_use[operand as usize] = id;
        }
    }
    let lines = |id: Id| {
        let place = ids.binary_search(&id).unwrap_or_default();
        lanes.rows[place].1.clone()
    };
    let name = |id: Id| {
        let declared = lines(id).concat();
        declared.split(' ').nth(1).unwrap_or_default().to_owned()
    };
    Blocks {
        indent: "        ",
        is_cut: ids.len() > FLAT,
        last_use: &last_use,
        is_whole: &|_| true,
        name: &name,
        lines: &lines,
    }
    .write(text, &ids, ids.last().map_or(Id::MAX, |last| last + 1));
    text.push_str("    }\n");
}

/// Operations of one scope, cut into blocks where there are many.
struct Blocks<'a> {
    indent: &'static str,
    is_cut: bool,
    last_use: &'a [Id],
    /// False of a sum that stands with the product before it.
    is_whole: &'a dyn Fn(Id) -> bool,
    name: &'a dyn Fn(Id) -> String,
    lines: &'a dyn Fn(Id) -> Vec<String>,
}

impl Blocks<'_> {
    fn flat(&self, ids: &[Id], indent: &str) -> String {
        let lines = ids.iter().flat_map(|&id| (self.lines)(id));
        lines.map(|line| format!("{indent}{line}\n")).collect()
    }

    /// `end` is the first operation behind them.
    fn write(&self, text: &mut String, ids: &[Id], end: Id) {
        let indent = self.indent;
        if !self.is_cut {
            *text += &self.flat(ids, indent);
            return;
        }
        let mut rest = ids;
        while !rest.is_empty() {
            let mut length = BLOCK.min(rest.len());
            // None ends between a product and the sum that takes it.
            let next = rest.get(length).filter(|&&id| !(self.is_whole)(id));
            length += usize::from(next.is_some());
            let (block, after) = rest.split_at(length);
            let end = after.first().copied().unwrap_or(end);
            rest = after;
            // A block hands on what is read after it: that much is live.
            let is_live = |id: &&Id| self.last_use[**id as usize] >= end;
            let name = |id: &Id| format!("{}, ", (self.name)(*id));
            let live: String = block.iter().filter(is_live).map(name).collect();
            if live.is_empty() {
                // The last one of a loop, whose values are all stored.
                *text += &self.flat(block, indent);
                continue;
            }
            let (names, inner) = (live.trim_end(), format!("{indent}    "));
            let lines = self.flat(block, &inner);
            *text += &format!("{indent}let ({names}) = {{\n{lines}{inner}({names})\n{indent}}};\n");
        }
    }
}

fn last_uses(code: &Code) -> Vec<Id> {
    let mut last = vec![0; code.dag.nodes.len()];
    for (id, _, operands) in code.dag.operations() {
        operands.iter().for_each(|read| last[*read as usize] = id);
    }
    for output in &code.dag.outputs {
        last[output.index()] = Id::MAX;
    }
    last
}

fn signature(program: &Program, code: &Code) -> String {
    let (function, sizes, scalar) = (program.function, program.sizes(), code.scalar);
    let arguments = program.arguments.iter().map(|&argument| {
        let is_read = reads(code, argument);
        let mark = if is_read { "" } else { "_" };
        let kind = argument_type(argument, sizes, scalar);
        format!("{mark}{}: &{kind}", argument.name())
    });
    let (name, arguments) = (function.name(), list(arguments));
    let result = result_type(function, sizes, scalar);
    format!("pub fn {name}({arguments}) -> {result}")
}

/// Returns the name of an argument's type: one that is not a vector of joints has a name, so that
/// none is passed for another.
pub(super) fn named_type(argument: Argument) -> Option<&'static str> {
    match argument {
        Argument::Gravity => Some(GRAVITY),
        Argument::Load => Some(LOAD),
        Argument::Payload => Some(PAYLOAD),
        Argument::Bodies => Some(BODIES),
        _ => None,
    }
}

fn argument_type(argument: Argument, sizes: Sizes, scalar: ScalarType) -> String {
    let array = || format!("[{scalar}; {}]", argument.length(sizes));
    named_type(argument).map_or_else(array, str::to_owned)
}

pub(crate) fn result_type(function: Function, sizes: Sizes, scalar: ScalarType) -> String {
    match function.structure() {
        Some(name) => name.to_owned(),
        None if function == Function::Load => LOAD.to_owned(),
        None => array_type(function.quantities()[0], sizes, scalar),
    }
}

pub(super) fn reads(code: &Code, argument: Argument) -> bool {
    let is = |input: &Input| input.argument() == argument;
    (argument == Argument::Position && !code.pairs.is_empty()) || code.dag.inputs().any(is)
}

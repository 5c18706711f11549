//! One program as one flat function.
//!
//! One operation a line, so that the printed text can be read back and
//! compared with the program operation by operation. Long functions are cut
//! into blocks (see [`BLOCK`]); names stay unique.

use std::fmt::Write;

use crate::function::{Argument, Function, Sizes};
use crate::language::dialect::Dialect;
use crate::language::result::{self, array_type};
use crate::language::{Printed, speed, trig};
use crate::program::fused::pieces;
use crate::program::{Input, Library, Literal, Lowered, Operand, Output, ScalarType};

/// A function of more operations than this is printed in blocks.
pub(crate) const FLAT: usize = 1000;

/// Operations a block.
///
/// To rustc each `let` opens a scope inside the one before, and its debug
/// information walks them recursively: somewhere above 2 000 it overflows the
/// compiler's stack. A block closes its scopes.
pub(crate) const BLOCK: usize = 500;

/// The name of the load's type in a module.
pub(crate) const LOAD: &str = "Load";

/// The name of a payload's type.
pub(crate) const PAYLOAD: &str = "Payload";

/// The name of the type of gravity, where it is an argument.
pub(crate) const GRAVITY: &str = "Gravity";

/// Returns the name of an argument's type, if it has one: a type for each, so that none is passed
/// for another of as many numbers.
pub(crate) fn own_type(argument: Argument) -> Option<&'static str> {
    match argument {
        Argument::Gravity => Some(GRAVITY),
        Argument::Load => Some(LOAD),
        Argument::Payload => Some(PAYLOAD),
        _ => None,
    }
}

/// Prints the function, whose roots are this library's; `doc` stands above it, one line an item.
pub fn write(printed: &Printed<'_>, library: Library, doc: &[String]) -> String {
    let mut text = String::new();
    write_doc(&mut text, doc);
    push(&mut text, format_args!("#[must_use]"));
    push(&mut text, format_args!("{} {{", signature(printed)));
    let dialect = Dialect::rust(printed.code.scalar);
    trig::write(&mut text, printed.code);
    speed::write(&mut text, dialect, printed.code, library.path());
    write_steps(&mut text, printed.code, dialect);
    let (function, sizes) = (printed.function, printed.sizes);
    let items = printed.code.outputs.iter().map(|o| result_item(o, dialect));
    result::write(&mut text, function, function.structure(), sizes, items);
    text.push_str("}\n");
    text
}

/// Writes documentation, one line an item.
fn write_doc(text: &mut String, doc: &[String]) {
    for line in doc {
        let space = if line.is_empty() { "" } else { " " };
        push(text, format_args!("///{space}{line}"));
    }
}

/// Prints the arithmetic, in blocks if it is long.
pub(super) fn write_steps(text: &mut String, code: &Lowered, dialect: Dialect) {
    if code.steps.len() <= FLAT {
        for index in 0..code.steps.len() {
            if let Some(line) = dialect.statement(code, index) {
                push(text, format_args!("    {line}"));
            }
        }
        return;
    }
    let last_use = last_uses(code);
    for block in pieces(&code.steps, BLOCK) {
        let end = block.end;
        // A block hands on what is read after it: that much is live.
        let mut live = String::new();
        for step in block.clone().filter(|&step| last_use[step] >= end) {
            let _ = write!(live, "t{}, ", step + 1);
        }
        push(text, format_args!("    let ({}) = {{", live.trim_end()));
        for line in block.filter_map(|index| dialect.statement(code, index)) {
            push(text, format_args!("        {line}"));
        }
        push(text, format_args!("        ({})", live.trim_end()));
        push(text, format_args!("    }};"));
    }
}

/// Returns the last step that reads each step; past the end for results.
fn last_uses(code: &Lowered) -> Vec<usize> {
    let mut last = vec![0; code.steps.len()];
    for (index, step) in code.steps.iter().enumerate() {
        for operand in [&step.left, &step.right] {
            if let Operand::Step(read) = operand {
                last[*read] = index;
            }
        }
    }
    for output in &code.outputs {
        if let Operand::Step(read) = output.value {
            last[read] = usize::MAX;
        }
    }
    last
}

/// Returns the signature, without a brace.
fn signature(printed: &Printed<'_>) -> String {
    let (function, sizes, scalar) = (printed.function, printed.sizes, printed.code.scalar);
    let arguments: Vec<String> = printed
        .arguments
        .iter()
        .map(|&argument| {
            // An argument that this robot's function does not depend on.
            let mark = if reads(printed.code, argument) {
                ""
            } else {
                "_"
            };
            let kind = argument_type(argument, sizes, scalar);
            format!("{mark}{}: &{kind}", argument.name())
        })
        .collect();
    let result = result_type(function, sizes, scalar);
    format!(
        "pub fn {}({}) -> {result}",
        function.name(),
        arguments.join(", ")
    )
}

/// Returns the type of an argument: an array, which has a name where it is no joint vector
/// of as many numbers as users would count.
fn argument_type(argument: Argument, sizes: Sizes, scalar: ScalarType) -> String {
    match own_type(argument) {
        Some(name) => name.to_owned(),
        None => format!("[{scalar}; {}]", argument.length(sizes)),
    }
}

/// Returns what it returns.
pub(crate) fn result_type(function: Function, sizes: Sizes, scalar: ScalarType) -> String {
    match function.structure() {
        Some(name) => name.to_owned(),
        None if function == Function::Load => LOAD.to_owned(),
        None => array_type(function.quantities()[0], sizes, scalar),
    }
}

pub(super) fn reads(code: &Lowered, argument: Argument) -> bool {
    let is = |operand: &Operand<Literal>| match operand {
        Operand::Input(input) => input.argument() == argument,
        _ => false,
    };
    (argument == Argument::Position && !code.trig.is_empty())
        || code.steps.iter().any(|s| is(&s.left) || is(&s.right))
        || code.outputs.iter().any(|output| is(&output.value))
}

/// Returns whether an entry of the argument is read; a sine is none.
pub(super) fn reads_entry(code: &Lowered, argument: Argument) -> bool {
    let is = |operand: &Operand<Literal>| match operand {
        Operand::Input(Input::Entry(read, _)) => *read == argument,
        Operand::Input(Input::PerSpeed(_)) => argument == Argument::Velocity,
        _ => false,
    };
    code.steps.iter().any(|s| is(&s.left) || is(&s.right))
        || code.outputs.iter().any(|output| is(&output.value))
}

/// Returns a number of the result.
pub(super) fn result_item(output: &Output<Literal>, dialect: Dialect) -> String {
    let sign = if output.negative { "-" } else { "" };
    format!("{sign}{}", dialect.operand(&output.value))
}

/// Appends a line. Writing to a string cannot fail.
fn push(text: &mut String, line: std::fmt::Arguments<'_>) {
    let _ = text.write_fmt(line);
    text.push('\n');
}

//! One program as one flat function.
//!
//! One operation a line, so that the printed text can be read back and
//! compared with the program operation by operation. Long functions are cut
//! into blocks (see [`BLOCK`]), very long ones into functions ([`parts`]);
//! names stay unique.

use std::fmt::Write;

use crate::backend::statement::{last_uses, operand, statement};
use crate::backend::{MathPath, parts, trig};
use crate::function::{Argument, Function, Quantity, Sizes};
use crate::program::{Operand, Output, Program, ScalarType};
use crate::sincos::AngleKernel;

/// A function of more operations than this is printed in blocks.
pub const FLAT: usize = 1000;

/// Operations a block.
///
/// To rustc each `let` opens a scope inside the one before, and its debug
/// information walks them recursively: somewhere above 2 000 it overflows the
/// compiler's stack. A block closes its scopes.
pub const BLOCK: usize = 500;

/// Prints the function with the library's sines; `doc` stands above it, one line an
/// item.
pub fn write(program: &Program, scalar: ScalarType, math: &MathPath, doc: &[String]) -> String {
    with_sines(program, scalar, math, &[], doc)
}

/// Prints the function; angles that are not among `sines` are `math`'s.
pub fn with_sines(
    program: &Program,
    scalar: ScalarType,
    math: &MathPath,
    sines: &[AngleKernel],
    doc: &[String],
) -> String {
    let mut text = String::new();
    for line in doc {
        let space = if line.is_empty() { "" } else { " " };
        push(&mut text, format_args!("///{space}{line}"));
    }
    push(&mut text, format_args!("#[must_use]"));
    push(&mut text, format_args!("{} {{", signature(program, scalar)));
    trig::write(&mut text, program, scalar, math, sines);
    write_steps(&mut text, program, scalar);
    write_result(&mut text, program, scalar);
    text.push_str("}\n");
    text
}

fn write_steps(text: &mut String, program: &Program, scalar: ScalarType) {
    if program.steps.len() <= FLAT {
        for (index, step) in program.steps.iter().enumerate() {
            push(text, format_args!("    {}", statement(index, step, scalar)));
        }
        return;
    }
    if program.steps.len() > parts::LONG {
        parts::write(text, program, scalar);
        return;
    }
    let last_use = last_uses(program);
    for (block, steps) in program.steps.chunks(BLOCK).enumerate() {
        let start = block * BLOCK;
        let end = start + steps.len();
        // A block hands on what is read after it: that much is live.
        let mut live = String::new();
        for step in (start..end).filter(|&step| last_use[step] >= end) {
            let _ = write!(live, "t{}, ", step + 1);
        }
        push(text, format_args!("    let ({}) = {{", live.trim_end()));
        for (index, step) in (start..).zip(steps) {
            push(
                text,
                format_args!("        {}", statement(index, step, scalar)),
            );
        }
        push(text, format_args!("        ({})", live.trim_end()));
        push(text, format_args!("    }};"));
    }
}

/// The signature, without a brace.
fn signature(program: &Program, scalar: ScalarType) -> String {
    let (n, function) = (program.joints, program.function);
    let arguments: Vec<String> = program
        .arguments
        .iter()
        .map(|&argument| {
            // An argument that this robot's function does not depend on.
            let mark = if reads(program, argument) { "" } else { "_" };
            format!("{mark}{}: &[{scalar}; {n}]", argument.name())
        })
        .collect();
    let result = match (function.structure(), function.quantities()) {
        (Some(name), _) => name.to_owned(),
        (None, quantities) => array_type(quantities[0], program.sizes(), scalar),
    };
    format!(
        "pub fn {}({}) -> {result}",
        function.name(),
        arguments.join(", ")
    )
}

/// The array type of a quantity: `[[f64; 6]; 6]` for a matrix over the joints.
pub fn array_type(quantity: Quantity, sizes: Sizes, scalar: ScalarType) -> String {
    let lengths = quantity.shape().lengths(sizes).rev();
    lengths.fold(scalar.to_string(), |inner, length| {
        format!("[{inner}; {length}]")
    })
}

/// The struct that a function returns, if it does.
pub fn structure(function: Function, sizes: Sizes, scalar: ScalarType) -> Option<String> {
    let name = function.structure()?;
    let mut text = format!("/// What [`{function}`] returns.\n");
    text.push_str("#[derive(Clone, Copy, Debug, PartialEq)]\n");
    push(&mut text, format_args!("pub struct {name} {{"));
    for &quantity in function.quantities() {
        let doc = quantity.summary();
        push(&mut text, format_args!("    /// {doc}"));
        let (field, array) = (quantity.field(), array_type(quantity, sizes, scalar));
        push(&mut text, format_args!("    pub {field}: {array},"));
    }
    text.push_str("}\n");
    Some(text)
}

fn reads(program: &Program, argument: Argument) -> bool {
    let is = |operand: &Operand| match operand {
        Operand::Input(input) => input.argument() == argument,
        _ => false,
    };
    (argument == Argument::Position && !program.trig.is_empty())
        || program.steps.iter().any(|s| is(&s.left) || is(&s.right))
        || program.outputs.iter().any(|output| is(&output.value))
}

fn result_item(output: &Output, scalar: ScalarType) -> String {
    let sign = if output.negative { "-" } else { "" };
    format!("{sign}{}", operand(&output.value, scalar))
}

fn write_result(text: &mut String, program: &Program, scalar: ScalarType) {
    let sizes = program.sizes();
    let mut items = program.outputs.iter().map(|o| result_item(o, scalar));
    let function = program.function;
    match function.structure() {
        None => {
            let lengths: Vec<usize> = function.quantities()[0].shape().lengths(sizes).collect();
            text.push_str("    ");
            write_array(text, &mut items, &lengths, 1);
            text.push('\n');
        }
        Some(name) => {
            push(text, format_args!("    {name} {{"));
            for quantity in function.quantities() {
                let _ = write!(text, "        {}: ", quantity.field());
                let lengths: Vec<usize> = quantity.shape().lengths(sizes).collect();
                write_array(text, &mut items, &lengths, 2);
                text.push_str(",\n");
            }
            text.push_str("    }\n");
        }
    }
}

/// An array of these lengths, the outermost first; a number without any.
fn write_array(
    text: &mut String,
    items: &mut impl Iterator<Item = String>,
    lengths: &[usize],
    depth: usize,
) {
    let indent = "    ".repeat(depth);
    match *lengths {
        [] => text.push_str(&items.next().unwrap_or_default()),
        [length] => {
            let row: Vec<String> = items.take(length).collect();
            let _ = write!(text, "[{}]", row.join(", "));
        }
        [length, ref inner @ ..] => {
            push(text, format_args!("["));
            for _ in 0..length {
                let _ = write!(text, "{indent}    ");
                write_array(text, items, inner, depth + 1);
                text.push_str(",\n");
            }
            let _ = write!(text, "{indent}]");
        }
    }
}

/// A line. Writing to a string cannot fail.
fn push(text: &mut String, line: std::fmt::Arguments<'_>) {
    let _ = text.write_fmt(line);
    text.push('\n');
}

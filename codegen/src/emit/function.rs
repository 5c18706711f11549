//! One program as one flat function.
//!
//! One operation a line, so that the printed text can be read back and
//! compared with the program operation by operation. Long functions are cut
//! into blocks (see [`BLOCK`]), very long ones into functions ([`parts`]);
//! names stay unique.

use std::fmt::Write;

use super::{MathPath, ScalarType, parts, sines};
use crate::function::{Argument, Function, Quantity};
use crate::graph::Input;
use crate::schedule::{Operand, Output, Program, Step, Trig};
use crate::sincos::AngleKernel;

/// A function of more operations than this is printed in blocks.
pub const FLAT: usize = 1000;

/// Operations a block.
///
/// To rustc each `let` opens a scope inside the one before, and its debug
/// information walks them recursively: somewhere above 2 000 it overflows the
/// compiler's stack. A block closes its scopes.
pub const BLOCK: usize = 500;

/// Prints the function with libm's sines; `doc` stands above it, one line an
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
    for trig in &program.trig {
        write_trig(&mut text, trig, scalar, math, sines);
    }
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

pub(super) fn statement(index: usize, step: &Step, scalar: ScalarType) -> String {
    let (left, right) = (operand(&step.left, scalar), operand(&step.right, scalar));
    let symbol = step.operation.symbol();
    format!("let t{} = {left} {symbol} {right};", index + 1)
}

/// The last step that reads each step; past the end for results.
pub(super) fn last_uses(program: &Program) -> Vec<usize> {
    let mut last = vec![0; program.steps.len()];
    for (index, step) in program.steps.iter().enumerate() {
        for operand in [&step.left, &step.right] {
            if let Operand::Step(read) = operand {
                last[*read] = index;
            }
        }
    }
    for output in &program.outputs {
        if let Operand::Step(read) = output.value {
            last[read] = usize::MAX;
        }
    }
    last
}

/// The signature, without a brace.
pub fn signature(program: &Program, scalar: ScalarType) -> String {
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
        (None, quantities) => array_type(quantities[0], program.rows.len(), scalar),
    };
    format!(
        "pub fn {}({}) -> {result}",
        function.name(),
        arguments.join(", ")
    )
}

/// The array type of a quantity: `[[f64; 6]; 6]` for rank 2.
pub fn array_type(quantity: Quantity, n: usize, scalar: ScalarType) -> String {
    (0..quantity.rank()).fold(scalar.to_string(), |inner, _| format!("[{inner}; {n}]"))
}

/// The struct that a function returns, if it does.
pub fn structure(function: Function, n: usize, scalar: ScalarType) -> Option<String> {
    let name = function.structure()?;
    let mut text = format!("/// What [`{function}`] returns.\n");
    text.push_str("#[derive(Clone, Copy, Debug, PartialEq)]\n");
    push(&mut text, format_args!("pub struct {name} {{"));
    for &quantity in function.quantities() {
        let doc = match quantity {
            Quantity::Torque => "Torques τ.",
            Quantity::Inertia => "Inertia matrix D.",
            Quantity::Coriolis => "Coriolis and centripetal load h.",
            Quantity::Christoffel => "`h[i][k][m]` = h_ikm, zero-based, symmetric in k and m.",
            Quantity::Gravity => "Gravity load c.",
        };
        push(&mut text, format_args!("    /// {doc}"));
        let (field, array) = (quantity.field(), array_type(quantity, n, scalar));
        push(&mut text, format_args!("    pub {field}: {array},"));
    }
    text.push_str("}\n");
    Some(text)
}

fn reads(program: &Program, argument: Argument) -> bool {
    let is = |operand: &Operand| match operand {
        Operand::Input(Input::Position(_)) => argument == Argument::Position,
        Operand::Input(Input::Velocity(_)) => argument == Argument::Velocity,
        Operand::Input(Input::Acceleration(_)) => argument == Argument::Acceleration,
        _ => false,
    };
    (argument == Argument::Position && !program.trig.is_empty())
        || program.steps.iter().any(|s| is(&s.left) || is(&s.right))
        || program.outputs.iter().any(|output| is(&output.value))
}

fn write_trig(
    text: &mut String,
    trig: &Trig,
    scalar: ScalarType,
    math: &MathPath,
    sines: &[AngleKernel],
) {
    let angle = trig.angle;
    let mut terms = angle.terms();
    let argument = if angle.additions() == 0 {
        terms.next().map(|(joint, _)| format!("q[{joint}]"))
    } else {
        let mut sum = String::new();
        for (index, (joint, negative)) in terms.enumerate() {
            let sign = match (index, negative) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            let _ = write!(sum, "{sign}q[{joint}]");
        }
        push(text, format_args!("    let a{angle} = {sum};"));
        Some(format!("a{angle}"))
    }
    .unwrap_or_default();
    let (names, call) = match (trig.sin, trig.cos) {
        (true, false) => (format!("s{angle}"), "sin"),
        (false, true) => (format!("c{angle}"), "cos"),
        _ => (format!("(s{angle}, c{angle})"), "sincos"),
    };
    if let Some(own) = sines.iter().find(|sine| sine.angle == angle) {
        sines::write(text, &names, &argument, &own.kernel, scalar);
        return;
    }
    let (path, suffix) = (&math.0, scalar.math_suffix());
    push(
        text,
        format_args!("    let {names} = {path}::{call}{suffix}({argument});"),
    );
}

fn operand(operand: &Operand, scalar: ScalarType) -> String {
    match operand {
        Operand::Input(input) => input_name(*input),
        Operand::Constant(value) => scalar.literal(value),
        Operand::Step(index) => format!("t{}", index + 1),
    }
}

/// How emitted code names an input.
pub fn input_name(input: Input) -> String {
    match input {
        Input::Sin(angle) => format!("s{angle}"),
        Input::Cos(angle) => format!("c{angle}"),
        Input::Position(joint) => format!("q[{joint}]"),
        Input::Velocity(joint) => format!("qd[{joint}]"),
        Input::Acceleration(joint) => format!("qdd[{joint}]"),
    }
}

fn result_item(output: &Output, scalar: ScalarType) -> String {
    let sign = if output.negative { "-" } else { "" };
    format!("{sign}{}", operand(&output.value, scalar))
}

fn write_result(text: &mut String, program: &Program, scalar: ScalarType) {
    let n = program.rows.len();
    let mut items = program.outputs.iter().map(|o| result_item(o, scalar));
    let function = program.function;
    match function.structure() {
        None => {
            let rank = function.quantities()[0].rank();
            text.push_str("    ");
            write_array(text, &mut items, rank, n, 1);
            text.push('\n');
        }
        Some(name) => {
            push(text, format_args!("    {name} {{"));
            for quantity in function.quantities() {
                let _ = write!(text, "        {}: ", quantity.field());
                write_array(text, &mut items, quantity.rank(), n, 2);
                text.push_str(",\n");
            }
            text.push_str("    }\n");
        }
    }
}

fn write_array(
    text: &mut String,
    items: &mut impl Iterator<Item = String>,
    rank: u32,
    n: usize,
    depth: usize,
) {
    let indent = "    ".repeat(depth);
    if rank == 1 {
        let row: Vec<String> = items.take(n).collect();
        let _ = write!(text, "[{}]", row.join(", "));
        return;
    }
    push(text, format_args!("["));
    for _ in 0..n {
        let _ = write!(text, "{indent}    ");
        write_array(text, items, rank - 1, n, depth + 1);
        text.push_str(",\n");
    }
    let _ = write!(text, "{indent}]");
}

/// A line. Writing to a string cannot fail.
fn push(text: &mut String, line: std::fmt::Arguments<'_>) {
    let _ = text.write_fmt(line);
    text.push('\n');
}

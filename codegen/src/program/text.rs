//! Operands and steps as plans and certificates write them: inputs as emitted
//! code names them, `t1` for the first step, `#` before a constant, `~` before
//! a negated result.

use std::fmt::Write;

use dalembert_model::number::Exact;

use super::{Input, Operand, Operation, Output, Program, Step, Steps};
use crate::function::Argument;
use crate::words::{Complaint, complaint};

/// Returns the name of an input in emitted code.
pub(crate) fn input_name(input: Input) -> String {
    match input {
        Input::Sin(joint) => format!("s{}", joint + 1),
        Input::Cos(joint) => format!("c{}", joint + 1),
        Input::PerSpeed(joint) => format!("r{}", joint + 1),
        Input::Entry(argument, joint) => format!("{}[{joint}]", argument.name()),
    }
}

/// Returns an operand as text; [`read_operand`] reads it back.
pub(crate) fn write_operand(operand: &Operand) -> String {
    match operand {
        Operand::Input(input) => input_name(*input),
        Operand::Constant(constant) => format!("#{constant}"),
        Operand::Step(index) => format!("t{}", index + 1),
    }
}

/// Writes the steps, a line each, and the line of the results.
pub(crate) fn write_steps(text: &mut String, program: &Program) {
    let Steps { steps, outputs } = program.dag.steps();
    for step in &steps {
        let _ = writeln!(text, "{}", write_step(step));
    }
    text.push_str("return");
    for output in &outputs {
        let _ = write!(text, " {}", write_output(output));
    }
    text.push('\n');
}

/// Returns a step as text.
pub(crate) fn write_step(step: &Step) -> String {
    let (left, right) = (write_operand(&step.left), write_operand(&step.right));
    format!("{left} {} {right}", step.operation.symbol())
}

/// Returns a result as text.
pub(crate) fn write_output(output: &Output) -> String {
    let sign = if output.negative { "~" } else { "" };
    format!("{sign}{}", write_operand(&output.value))
}

/// Reads the results that end a program of these steps.
pub(crate) fn read_results(
    words: &[&str],
    mut steps: Steps,
    program: &mut Program,
) -> Result<(), Complaint> {
    for word in words {
        let (negative, word) = match word.strip_prefix('~') {
            Some(rest) => (true, rest),
            None => (false, *word),
        };
        let value = read_operand(word, program, steps.steps.len())?;
        steps.outputs.push(Output { negative, value });
    }
    program.dag = steps.dag();
    let expected = program.function.outputs(program.sizes());
    let found = steps.outputs.len();
    match found == expected {
        true => Ok(()),
        false => Err(complaint(format!(
            "expected {expected} results, found {found}"
        ))),
    }
}

/// Parses a program's next step; `count` steps stand before it.
pub(crate) fn read_step(
    words: &[&str],
    program: &Program,
    count: usize,
) -> Result<Step, Complaint> {
    let &[left, symbol, right] = words else {
        return Err(complaint("expected an operation such as `t1 + s2`"));
    };
    let operation = Operation::from_symbol(symbol)
        .ok_or_else(|| complaint(format!("`{symbol}` is no operation")))?;
    Ok(Step {
        operation,
        left: read_operand(left, program, count)?,
        right: read_operand(right, program, count)?,
    })
}

/// Returns a step of a program whose errors are bounded.
///
/// # Errors
/// Nothing is certified of a program that divides.
pub(crate) fn without_quotient(step: Step) -> Result<Step, Complaint> {
    match step.operation {
        Operation::Div => Err(complaint("a quotient, of which no bound is known")),
        _ => Ok(step),
    }
}

/// Parses an operand of a program's next step; `count` steps stand before it.
pub(crate) fn read_operand(
    word: &str,
    program: &Program,
    count: usize,
) -> Result<Operand, Complaint> {
    if let Some(constant) = word.strip_prefix('#') {
        return constant
            .parse::<Exact>()
            .map(Operand::Constant)
            .map_err(|error| complaint(error.to_string()));
    }
    if let Some(index) = word.strip_prefix('t').and_then(|n| n.parse::<usize>().ok()) {
        return match index {
            1.. if index <= count => Ok(Operand::Step(index - 1)),
            _ => Err(complaint(format!("`{word}` is not computed yet"))),
        };
    }
    input(word)
        .filter(|input| input_fits(*input, program))
        .map(Operand::Input)
        .ok_or_else(|| {
            complaint(format!(
                "`{word}` is neither an input, a step nor a constant"
            ))
        })
}

fn input(word: &str) -> Option<Input> {
    for argument in Argument::ALL {
        let index = word
            .strip_prefix(argument.name())
            .and_then(|rest| rest.strip_prefix('['));
        if let Some(index) = index {
            let entry = index.strip_suffix(']')?.parse().ok()?;
            return Some(Input::Entry(argument, entry));
        }
    }
    let (kind, number) = word.split_at_checked(1)?;
    let joint = number.parse::<usize>().ok()?.checked_sub(1)?;
    match kind {
        "s" => Some(Input::Sin(joint)),
        "c" => Some(Input::Cos(joint)),
        "r" => Some(Input::PerSpeed(joint)),
        _ => None,
    }
}

fn input_fits(input: Input, program: &Program) -> bool {
    let sizes = program.sizes();
    match input {
        Input::Sin(joint) | Input::Cos(joint) | Input::PerSpeed(joint) => joint < program.joints,
        Input::Entry(argument, index) => index < argument.length(sizes),
    }
}

//! Operands and steps as plans and certificates write them: inputs as emitted
//! code names them, `t1` for the first step, `#` before a constant, `~` before
//! a negated result. `fault` says why a line is none of these.

mod fault;

use std::fmt::Write;

use dalembert_model::number::Exact;

use super::{Input, Operand, Operation, Output, Program, Step};
use crate::function::Argument;
pub(crate) use fault::LineFault;

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
    for step in &program.steps {
        let (left, right) = (write_operand(&step.left), write_operand(&step.right));
        let _ = writeln!(text, "{left} {} {right}", step.operation.symbol());
    }
    text.push_str("return");
    for output in &program.outputs {
        let sign = if output.negative { "~" } else { "" };
        let _ = write!(text, " {sign}{}", write_operand(&output.value));
    }
    text.push('\n');
}

/// Reads the results that end a program.
pub(crate) fn read_results(words: &[&str], program: &mut Program) -> Result<(), LineFault> {
    for word in words {
        let (negative, word) = match word.strip_prefix('~') {
            Some(rest) => (true, rest),
            None => (false, *word),
        };
        let value = read_operand(word, program)?;
        program.outputs.push(Output { negative, value });
    }
    let expected = program.function.outputs(program.sizes());
    if program.outputs.len() != expected {
        let found = program.outputs.len();
        return Err(LineFault::Results { expected, found });
    }
    program.collect_trig();
    Ok(())
}

/// Returns a step from its words.
pub(crate) fn read_step(words: &[&str], program: &Program) -> Result<Step, LineFault> {
    let &[left, symbol, right] = words else {
        return Err(LineFault::Step);
    };
    let operation =
        Operation::from_symbol(symbol).ok_or_else(|| LineFault::Operation((*symbol).to_owned()))?;
    Ok(Step {
        operation,
        left: read_operand(left, program)?,
        right: read_operand(right, program)?,
    })
}

/// Returns a step of a program whose errors are bounded.
///
/// # Errors
/// Nothing is certified of a program that divides.
pub(crate) fn without_quotient(step: Step) -> Result<Step, LineFault> {
    match step.operation {
        Operation::Div => Err(LineFault::Quotient),
        _ => Ok(step),
    }
}

/// Returns an operand of a program's next step.
pub(crate) fn read_operand(word: &str, program: &Program) -> Result<Operand, LineFault> {
    if let Some(constant) = word.strip_prefix('#') {
        return constant
            .parse::<Exact>()
            .map(Operand::Constant)
            .map_err(LineFault::Constant);
    }
    if let Some(index) = word.strip_prefix('t').and_then(|n| n.parse::<usize>().ok()) {
        return match index {
            1.. if index <= program.steps.len() => Ok(Operand::Step(index - 1)),
            _ => Err(LineFault::Later(word.to_owned())),
        };
    }
    input(word)
        .filter(|input| input_fits(*input, program))
        .map(Operand::Input)
        .ok_or_else(|| LineFault::Operand(word.to_owned()))
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

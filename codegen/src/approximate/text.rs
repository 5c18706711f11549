//! Edits as plans and certificates write them.

use crate::approximate::edits::{Edit, Place};
use crate::program::text::{input_name, read_operand, write_operand};
use crate::program::{Operand, Program};

/// An edit as text: `t12 = ~t3`, `qd[5] = #0`.
pub fn write_edit(edit: &Edit) -> String {
    let place = match edit.place {
        Place::Input(input) => input_name(input),
        Place::Step(step) => format!("t{}", step + 1),
        Place::Left(step) => format!("t{}.left", step + 1),
        Place::Right(step) => format!("t{}.right", step + 1),
    };
    let sign = if edit.negative { "~" } else { "" };
    format!("{place} = {sign}{}", write_operand(&edit.value))
}

/// Reads an edit of a program.
///
/// # Errors
/// What is wrong with the text.
pub fn read_edit(text: &str, program: &Program) -> Result<Edit, String> {
    let (place, value) = text
        .split_once(" = ")
        .ok_or_else(|| format!("`{text}` is no edit"))?;
    let (step, side) = place.split_once('.').unwrap_or((place, ""));
    let place = match (read_operand(step, program)?, side) {
        (Operand::Input(input), "") => Place::Input(input),
        (Operand::Step(step), "") => Place::Step(step),
        (Operand::Step(step), "left") => Place::Left(step),
        (Operand::Step(step), "right") => Place::Right(step),
        _ => return Err(format!("`{place}` cannot be replaced")),
    };
    let (negative, value) = match value.strip_prefix('~') {
        Some(rest) => (true, rest),
        None => (false, value),
    };
    Ok(Edit {
        place,
        negative,
        value: read_operand(value, program)?,
    })
}

//! Edits as plans and certificates write them.

use crate::edits::{Edit, EditSite};
use crate::program::text::{input_name, read_operand, write_operand};
use crate::program::{Operand, Program};
use crate::words::{Complaint, complaint};

/// Returns an edit as text: `t12 = ~t3`, `qd[5] = #0`.
pub fn write_edit(edit: &Edit) -> String {
    let place = match edit.place {
        EditSite::Input(input) => input_name(input),
        EditSite::Step(step) => format!("t{}", step + 1),
        EditSite::Left(step) => format!("t{}.left", step + 1),
        EditSite::Right(step) => format!("t{}.right", step + 1),
    };
    let sign = if edit.negative { "~" } else { "" };
    format!("{place} = {sign}{}", write_operand(&edit.value))
}

/// Reads an edit of a program of `count` steps.
///
/// # Errors
/// What is wrong with the text.
pub fn read_edit(text: &str, program: &Program, count: usize) -> Result<Edit, Complaint> {
    let (place, value) = text
        .split_once(" = ")
        .ok_or_else(|| complaint(format!("`{text}` is no edit")))?;
    let read = |word| read_operand(word, program, count);
    let (step, side) = place.split_once('.').unwrap_or((place, ""));
    let place = match (read(step)?, side) {
        (Operand::Input(input), "") => EditSite::Input(input),
        (Operand::Step(step), "") => EditSite::Step(step),
        (Operand::Step(step), "left") => EditSite::Left(step),
        (Operand::Step(step), "right") => EditSite::Right(step),
        _ => return Err(complaint(format!("`{place}` cannot be replaced"))),
    };
    let (negative, value) = match value.strip_prefix('~') {
        Some(rest) => (true, rest),
        None => (false, value),
    };
    Ok(Edit {
        place,
        negative,
        value: read(value)?,
    })
}

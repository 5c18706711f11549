//! Edits as plans and certificates write them.

use std::fmt;

use crate::edits::{Edit, EditSite};
use crate::program::text::{LineFault, input_name, read_operand, write_operand};
use crate::program::{Operand, Program};

/// Why a text is no edit of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum EditFault {
    /// It is none.
    NoEdit(String),
    /// This is no place in a program.
    Place(String),
    /// What is replaced, or by what, is none of the program's.
    Line(LineFault),
}

impl fmt::Display for EditFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EditFault::NoEdit(text) => write!(f, "`{text}` is no edit"),
            EditFault::Place(place) => write!(f, "`{place}` cannot be replaced"),
            EditFault::Line(fault) => fault.fmt(f),
        }
    }
}

impl std::error::Error for EditFault {}

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

/// Reads an edit of a program.
///
/// # Errors
/// What is wrong with the text.
pub fn read_edit(text: &str, program: &Program) -> Result<Edit, EditFault> {
    let (place, value) = text
        .split_once(" = ")
        .ok_or_else(|| EditFault::NoEdit(text.to_owned()))?;
    let (step, side) = place.split_once('.').unwrap_or((place, ""));
    let place = match (read_operand(step, program).map_err(EditFault::Line)?, side) {
        (Operand::Input(input), "") => EditSite::Input(input),
        (Operand::Step(step), "") => EditSite::Step(step),
        (Operand::Step(step), "left") => EditSite::Left(step),
        (Operand::Step(step), "right") => EditSite::Right(step),
        _ => return Err(EditFault::Place(place.to_owned())),
    };
    let (negative, value) = match value.strip_prefix('~') {
        Some(rest) => (true, rest),
        None => (false, value),
    };
    Ok(Edit {
        place,
        negative,
        value: read_operand(value, program).map_err(EditFault::Line)?,
    })
}

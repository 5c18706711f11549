//! Programs with less work in them, and how far they are off.
//!
//! - this file: values in other values' places
//! - `difference`: the edited program, and the program of its error
//! - `omissions`: what was left out, one by one

mod difference;
mod omissions;

use dalembert_model::number::Exact;

use crate::program::{Input, Operand, Program};
pub(crate) use difference::deviation;
pub use difference::difference;
pub use omissions::{Omission, omissions};

/// The place of an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum EditSite {
    /// Every use of an input.
    Input(Input),
    /// The result of a step.
    Step(usize),
    /// The left operand of a step, there alone.
    Left(usize),
    /// The right operand of a step, there alone.
    Right(usize),
}

/// A value in place of another.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    /// The place that is replaced.
    pub place: EditSite,
    /// `true` if the replacement is negated.
    pub negative: bool,
    /// The replacement: computed before the place, or a constant.
    pub value: Operand,
}

/// A program and what is edited in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// The program.
    pub program: Program,
    /// Its edits, at most one a place.
    pub edits: Vec<Edit>,
}

impl Edit {
    /// Returns a constant in place of a value.
    pub fn constant(place: EditSite, value: Exact) -> Edit {
        Edit {
            place,
            negative: false,
            value: Operand::Constant(value),
        }
    }

    /// Returns true if it only puts another constant in the place of an operand, which saves
    /// nothing.
    pub fn corrects(&self) -> bool {
        matches!(self.place, EditSite::Left(_) | EditSite::Right(_))
            && matches!(self.value, Operand::Constant(_))
    }
}

impl Stage {
    /// Returns a program as it is.
    pub fn unedited(program: Program) -> Stage {
        Stage {
            program,
            edits: Vec::new(),
        }
    }
}

pub(crate) fn has_edits(stages: &[Stage]) -> bool {
    stages.iter().any(|stage| !stage.edits.is_empty())
}

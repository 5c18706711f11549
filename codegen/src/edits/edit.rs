//! Edits: values in other values' places.

use std::collections::BTreeSet;

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use crate::function::Function;
use crate::program::{Input, Operand, Program};
use crate::words::{Complaint, complaint};

/// What an edit replaces.
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
    /// What is replaced.
    pub place: EditSite,
    /// Whether the replacement is negated.
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

    /// Returns whether it puts another constant in the place of an operand: it saves
    /// nothing, but makes up for what other edits leave out.
    pub fn corrects(&self) -> bool {
        matches!(self.place, EditSite::Left(_) | EditSite::Right(_))
            && matches!(self.value, Operand::Constant(_))
    }

    /// Puts zero in place of a value: its term is dropped.
    pub fn zero(place: EditSite) -> Edit {
        Edit::constant(place, Exact::zero())
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

    /// Checks that every replacement exists before its place.
    ///
    /// # Errors
    /// The first edit that cannot be applied.
    pub fn check(&self) -> Result<(), Complaint> {
        let steps = self.program.dag.operations().count();
        let mut places = BTreeSet::new();
        for (index, edit) in self.edits.iter().enumerate() {
            let early = match (&edit.value, edit.place) {
                (Operand::Constant(_), _) => true,
                (_, EditSite::Input(_)) => false,
                (Operand::Input(_), _) => true,
                (
                    Operand::Step(value),
                    EditSite::Step(at) | EditSite::Left(at) | EditSite::Right(at),
                ) => *value < at,
            };
            let known = match edit.place {
                EditSite::Step(step) | EditSite::Left(step) | EditSite::Right(step) => step < steps,
                EditSite::Input(_) => true,
            };
            let twice = !places.insert(edit.place);
            if !early || !known || twice {
                return Err(complaint(format!(
                    "edit {} replaces a value twice, or by one that is not computed before it",
                    index + 1
                )));
            }
        }
        Ok(())
    }

    /// Returns the function that is computed.
    pub fn function(&self) -> Function {
        self.program.function
    }
}

/// Returns whether anything was edited.
pub(crate) fn has_edits(stages: &[Stage]) -> bool {
    stages.iter().any(|stage| !stage.edits.is_empty())
}

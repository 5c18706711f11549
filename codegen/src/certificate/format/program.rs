//! Programs and their edits as lists of lines.

use serde::Serialize;

use crate::edits::Stage;
use crate::edits::text::write_edit;
use crate::program::text::write_operand;
use crate::program::{Output, Program, Step};

/// A program: an operation a line, and what is returned.
#[derive(Serialize)]
pub(super) struct Listing {
    steps: Vec<String>,
    results: Vec<String>,
}

/// A program and what is edited in it.
#[derive(Serialize)]
pub(super) struct StageListing {
    program: Listing,
    edits: Vec<String>,
}

impl Listing {
    pub(super) fn of(program: &Program) -> Listing {
        let line = |step: &Step| {
            let (left, right) = (write_operand(&step.left), write_operand(&step.right));
            format!("{left} {} {right}", step.operation.symbol())
        };
        let result = |output: &Output| {
            let sign = if output.negative { "~" } else { "" };
            format!("{sign}{}", write_operand(&output.value))
        };
        Listing {
            steps: program.steps.iter().map(line).collect(),
            results: program.outputs.iter().map(result).collect(),
        }
    }
}

impl StageListing {
    pub(super) fn of(stage: &Stage) -> StageListing {
        StageListing {
            program: Listing::of(&stage.program),
            edits: stage.edits.iter().map(write_edit).collect(),
        }
    }
}

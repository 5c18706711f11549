//! Programs and their edits as lists of lines.

use serde::Serialize;

use crate::edits::Stage;
use crate::edits::text::write_edit;
use crate::program::text::{write_output, write_step};
use crate::program::{Program, Steps};

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
    pub(super) fn new(program: &Program) -> Listing {
        let Steps { steps, outputs } = program.dag.steps();
        Listing {
            steps: steps.iter().map(write_step).collect(),
            results: outputs.iter().map(write_output).collect(),
        }
    }
}

impl StageListing {
    pub(super) fn new(stage: &Stage) -> StageListing {
        StageListing {
            program: Listing::new(&stage.program),
            edits: stage.edits.iter().map(write_edit).collect(),
        }
    }
}

//! Programs and their edits as lists of lines.

use serde::{Deserialize, Serialize};

use super::error::{FormatFault, Listed};
use crate::certificate::work;
use crate::edits::Stage;
use crate::edits::text::{self, EditFault};
use crate::program::text::{
    read_emitted_step, read_results, read_step, without_quotient, write_operand,
};
use crate::program::{Output, Program, Step};

/// A program: an operation a line, and what is returned.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Listing {
    steps: Vec<String>,
    results: Vec<String>,
}

/// A program and what is edited in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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

    /// The program, of the same function, rows and arguments as an empty one.
    pub(super) fn program(&self, of: Listed, empty: &Program) -> Result<Program, FormatFault> {
        let count = self.steps.len();
        if count > work::MAX_STEPS {
            return Err(FormatFault::Steps(of, count));
        }
        let mut program = empty.clone();
        for (index, line) in self.steps.iter().enumerate() {
            let words: Vec<&str> = line.split(' ').collect();
            let read = match of {
                Listed::Emitted => read_emitted_step(&words, &program),
                Listed::Stage(_) => read_step(&words, &program),
            };
            let read = read.and_then(without_quotient);
            let read = read.map_err(|fault| FormatFault::Step(of, index + 1, fault))?;
            program.steps.push(read);
        }
        let words: Vec<&str> = self.results.iter().map(String::as_str).collect();
        read_results(&words, &mut program).map_err(|fault| FormatFault::Results(of, fault))?;
        Ok(program)
    }
}

impl StageListing {
    pub(super) fn of(stage: &Stage) -> StageListing {
        StageListing {
            program: Listing::of(&stage.program),
            edits: stage.edits.iter().map(text::write_edit).collect(),
        }
    }

    pub(super) fn stage(&self, of: Listed, empty: &Program) -> Result<Stage, FormatFault> {
        let program = self.program.program(of, empty)?;
        if self.edits.len() > work::MAX_EDITS {
            return Err(FormatFault::Edits(of, self.edits.len()));
        }
        let edits = self
            .edits
            .iter()
            .map(|edit| text::read_edit(edit, &program));
        let edits: Result<Vec<_>, EditFault> = edits.collect();
        let edits = edits.map_err(|fault| FormatFault::Edit(of, fault))?;
        Ok(Stage { program, edits })
    }
}

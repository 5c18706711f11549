//! What was left out, one by one.

use super::Pruned;
use crate::certify::bound::{Budget, magnitudes};
use crate::certify::edits::{Edit, Place, Stage, difference};
use crate::certify::input_box::InputBox;
use crate::emit::function::input_name;
use crate::graph::{Counts, Folding};
use crate::plan::write::operand;

/// One edit, what it saves and what it costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Omission {
    /// Which program it edits, from zero.
    pub stage: usize,
    /// The edit.
    pub edit: Edit,
    /// The step or input that is replaced, and by what:
    /// `t12 = qd[3] * t4 -> 0`.
    pub words: String,
    /// Operations that come back if it alone is put back.
    pub operations: usize,
    /// Sines and cosines that come back with them.
    pub sincos: usize,
    /// The certified largest |error| of each output, in its unit, if it alone
    /// is left out of its program.
    pub errors: Vec<f64>,
}

impl Pruned {
    /// What was left out, stage after stage.
    pub fn omissions(&self, limits: &InputBox) -> Vec<Omission> {
        let mut omissions = Vec::new();
        for (index, stage) in self.stages.iter().enumerate() {
            let paid = stage.program(Folding::Syntactic).counts();
            for edit in &stage.edits {
                let back = without(stage, edit);
                let alone = Stage {
                    program: stage.program.clone(),
                    edits: vec![edit.clone()],
                };
                let ones = vec![1.0; stage.program.outputs.len()];
                let graph = difference(std::slice::from_ref(&alone));
                omissions.push(Omission {
                    stage: index,
                    edit: edit.clone(),
                    words: words(stage, edit),
                    operations: back.operations().saturating_sub(paid.operations()),
                    sincos: back.sincos.saturating_sub(paid.sincos),
                    errors: magnitudes(&graph, limits, &ones, 0.0, Budget::GLANCE),
                });
            }
        }
        omissions
    }
}

/// What the stage costs with one edit put back.
fn without(stage: &Stage, edit: &Edit) -> Counts {
    let edits = stage.edits.iter().filter(|e| e.place != edit.place);
    let back = Stage {
        program: stage.program.clone(),
        edits: edits.cloned().collect(),
    };
    back.program(Folding::Syntactic).counts()
}

fn words(stage: &Stage, edit: &Edit) -> String {
    let place = match edit.place {
        Place::Input(input) => input_name(input),
        Place::Step(step) => match stage.program.steps.get(step) {
            Some(work) => format!(
                "t{} = {} {} {}",
                step + 1,
                readable(&operand(&work.left)),
                work.operation.symbol(),
                readable(&operand(&work.right))
            ),
            None => format!("t{}", step + 1),
        },
    };
    let sign = if edit.negative { "-" } else { "" };
    format!("{place} -> {sign}{}", readable(&operand(&edit.value)))
}

/// Without the mark of constants.
fn readable(operand: &str) -> &str {
    operand.strip_prefix('#').unwrap_or(operand)
}

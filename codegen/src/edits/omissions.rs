//! What was left out, one by one.

use dalembert_model::number::{Exact, Rounded};

use super::{Edit, EditSite, Stage};
use crate::dag::Folding;
use crate::program::{Counts, Operand, Operation, Steps};

/// A value that was left out, and what that saves.
#[derive(Clone, Debug, PartialEq)]
pub struct Omission {
    /// What is replaced, as an expression cut short where it is deep, and by
    /// what: `qd[3] * (s4 * …) -> 0`.
    pub words: String,
    /// Operations that come back if it alone is put back.
    pub operations: usize,
    /// Sines and cosines that come back with them.
    pub sincos: usize,
}

/// Returns what was left out, stage after stage.
/// Constants that were corrected are no omissions: they save nothing.
pub fn omissions(stages: &[Stage]) -> Vec<Omission> {
    let mut omissions = Vec::new();
    for stage in stages {
        let steps = stage.program.dag.steps();
        let paid = stage.program(Folding::Syntactic).counts();
        for edit in stage.edits.iter().filter(|edit| !edit.corrects()) {
            let back = without(stage, edit);
            omissions.push(Omission {
                words: words(&steps, edit),
                operations: back.operations().saturating_sub(paid.operations()),
                sincos: back.sincos.saturating_sub(paid.sincos),
            });
        }
    }
    omissions
}

fn without(stage: &Stage, edit: &Edit) -> Counts {
    let edits = stage.edits.iter().filter(|e| e.place != edit.place);
    let back = Stage {
        program: stage.program.clone(),
        edits: edits.cloned().collect(),
    };
    back.program(Folding::Syntactic).counts()
}

/// Operations deeper than this below the one that is replaced are not shown.
const DEPTH: usize = 2;

fn words(program: &Steps, edit: &Edit) -> String {
    let place = match edit.place {
        EditSite::Input(input) => input.name(),
        EditSite::Step(step) | EditSite::Left(step) | EditSite::Right(step) => {
            expression(program, &Operand::Step(step), DEPTH + 1).0
        }
    };
    let value = match (edit.negative, expression(program, &edit.value, DEPTH)) {
        (false, (text, _)) => text,
        (true, (text, Strength::Sum)) => format!("-({text})"),
        (true, (text, _)) => format!("-{text}"),
    };
    format!("{place} -> {value}")
}

/// The weakest binding first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Atom,
}

fn expression(program: &Steps, operand: &Operand, depth: usize) -> (String, Strength) {
    let step = match operand {
        Operand::Input(input) => return (input.name(), Strength::Atom),
        Operand::Constant(constant) => return (roughly(constant), Strength::Atom),
        Operand::Step(step) => program.steps.get(*step),
    };
    let Some(step) = step.filter(|_| depth > 0) else {
        return ("…".into(), Strength::Atom);
    };
    let part = |operand, least| {
        let (text, strength) = expression(program, operand, depth - 1);
        if strength < least {
            format!("({text})")
        } else {
            text
        }
    };
    let (least, strength) = match step.operation {
        Operation::Mul | Operation::Fused | Operation::Div => {
            ([Strength::Product; 2], Strength::Product)
        }
        Operation::Add => ([Strength::Sum; 2], Strength::Sum),
        Operation::Sub => ([Strength::Sum, Strength::Product], Strength::Sum),
    };
    let (left, right) = (part(&step.left, least[0]), part(&step.right, least[1]));
    let symbol = step.operation.symbol();
    (format!("{left} {symbol} {right}"), strength)
}

/// Four digits are enough to recognise a constant.
fn roughly(constant: &Exact) -> String {
    let value = f64::nearest(constant);
    let short = format!("{value:.3e}").parse::<f64>().unwrap_or(value);
    if short == 0.0 || (1e-3..1e5).contains(&short.abs()) {
        format!("{short}")
    } else {
        format!("{short:e}")
    }
}

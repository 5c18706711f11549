//! Reads what a tolerance left of a program: `edited`, then for each program
//! its edits and, after `next`, what they gave; then the bounds, before them
//! that of D's least eigenvalue where D was edited.

use super::{Edited, Entry};
use crate::edits::text::read_edit;
use crate::edits::{Edit, Stage, has_edits};
use crate::program::text::{read_results, read_step, without_quotient};
use crate::program::{Program, Steps, has_inertia};
use crate::split::ErrorByCause;
use crate::words::{Complaint, complaint};

/// A variant that is being read.
pub(super) struct Variant {
    stages: Vec<Stage>,
    /// The last program that is whole, and the number of its steps.
    program: Program,
    count: usize,
    /// The steps of the next one, so far.
    steps: Steps,
    edits: Vec<Edit>,
    is_open: bool,
    bounds: Vec<ErrorByCause>,
    lambda_min: Option<f64>,
}

impl Variant {
    /// Makes the variant of an entry's program.
    pub(super) fn new(entry: &Entry) -> Variant {
        Variant {
            stages: Vec::new(),
            program: entry.program.clone(),
            count: entry.program.dag.operations().count(),
            steps: Steps::default(),
            edits: Vec::new(),
            is_open: false,
            bounds: Vec::new(),
            lambda_min: None,
        }
    }

    /// Returns whether it must be known that D is still positive definite.
    fn has_edited_inertia(&self) -> bool {
        has_edits(&self.stages) && has_inertia(&self.program)
    }

    /// Reads a line; the variant is whole with the last of its bounds.
    pub(super) fn line(&mut self, line: &str, words: &[&str]) -> Result<Option<Edited>, Complaint> {
        match (words[0], self.is_open) {
            ("edit", false) => {
                let edit = line.split_once(' ').map_or("", |(_, edit)| edit);
                self.edits.push(read_edit(edit, &self.program, self.count)?);
            }
            ("next", false) => {
                self.stages.push(Stage {
                    program: self.program.clone(),
                    edits: std::mem::take(&mut self.edits),
                });
                self.is_open = true;
            }
            ("return", true) => {
                let steps = std::mem::take(&mut self.steps);
                self.count = steps.steps.len();
                read_results(&words[1..], steps, &mut self.program)?;
                self.is_open = false;
            }
            (_, true) => {
                let step =
                    without_quotient(read_step(words, &self.program, self.steps.steps.len())?)?;
                self.steps.steps.push(step);
            }
            ("eigenvalue", false) if self.edits.is_empty() && self.bounds.is_empty() => {
                if !self.has_edited_inertia() {
                    return Err(complaint(
                        "no `eigenvalue` is needed: D is no output, or as it was",
                    ));
                }
                self.lambda_min = Some(eigenvalue(&words[1..])?);
            }
            ("bound", false) if self.edits.is_empty() => {
                if self.has_edited_inertia() && self.lambda_min.is_none() {
                    return Err(complaint(
                        "expected `eigenvalue`: D is an output and was edited",
                    ));
                }
                self.bounds.push(bound(&words[1..])?);
                if self.bounds.len() == self.program.dag.outputs.len() {
                    return Ok(Some(Edited {
                        stages: std::mem::take(&mut self.stages),
                        program: self.program.clone(),
                        bounds: std::mem::take(&mut self.bounds),
                        lambda_min: self.lambda_min,
                    }));
                }
            }
            (word, false) => {
                return Err(complaint(format!(
                    "expected `edit`, `next`, `eigenvalue` or `bound`, found `{word}`"
                )));
            }
        }
        Ok(None)
    }
}

fn bound(words: &[&str]) -> Result<ErrorByCause, Complaint> {
    match numbers(words)[..] {
        [model, sincos, rounding] if model >= 0.0 && sincos >= 0.0 && rounding >= 0.0 => {
            Ok(ErrorByCause {
                model,
                sincos,
                rounding,
            })
        }
        _ => Err(complaint("expected three numbers of zero or more")),
    }
}

fn eigenvalue(words: &[&str]) -> Result<f64, Complaint> {
    match numbers(words)[..] {
        [least] if least > 0.0 && least.is_finite() => Ok(least),
        _ => Err(complaint("expected one number above zero")),
    }
}

/// Returns the words as numbers; none if one of them is no number.
fn numbers(words: &[&str]) -> Vec<f64> {
    let numbers: Option<Vec<f64>> = words.iter().map(|word| word.parse().ok()).collect();
    numbers.unwrap_or_default()
}

//! The edited program, and the program of its error.
//!
//! **Soundness.** Write x for a value of the program, x' for the same place
//! after the edits, Δx = x' − x. Then, exactly and for every state,
//!
//! - Δ(a ± b) = Δa ± Δb
//! - Δ(a·b) = a'·Δb + b·Δa
//! - where a + b is replaced by a: Δ = Δa − b, and so on
//!
//! so [`difference`] is a program for Δ of the outputs, not an approximation of one: nothing is
//! left of second order. It forms no difference of two large values, so bounding *it* over a box
//! bounds the error without the difference of two enclosures.

use std::collections::BTreeMap;

use super::{Edit, EditSite, Stage};
use crate::dag::{Builder, Dag, Edge, Folding};
use crate::program::{Operand, Operation, Program, Steps};

impl Stage {
    /// Returns the edited program's graph, folded; what nothing reads is gone.
    pub fn edited(&self, folding: Folding) -> Dag {
        let mut run = Run::new(self, Builder::new(folding));
        let values = run.outputs(Run::after);
        run.builder.finish(values)
    }

    /// Returns the edited program.
    pub fn program(&self, folding: Folding) -> Program {
        self.program.with_graph(&self.edited(folding))
    }
}

/// edited − exact, output by output; written out as polynomials, common terms cancel.
pub(crate) fn deviation(exact: &Program, edited: &Program) -> Dag {
    let mut builder = Builder::new(Folding::Syntactic);
    let before = builder.results(&exact.dag);
    let after = builder.results(&edited.dag);
    let pairs = after.iter().zip(&before);
    let sums: Vec<Edge> = pairs.map(|(a, b)| builder.sub(*a, *b)).collect();
    builder.finish(sums)
}

/// Returns the errors of all stages together: edited − exact, output by output. Each
/// stage's edited program must be equal to the next stage's program.
pub fn difference(stages: &[Stage]) -> Dag {
    let mut builder = Builder::new(Folding::Syntactic);
    let mut sums: Vec<Edge> = Vec::new();
    for stage in stages {
        let mut run = Run::new(stage, builder);
        let deltas = run.outputs(Run::delta);
        builder = run.builder;
        sums = if sums.is_empty() {
            deltas
        } else {
            let pairs = sums.iter().zip(&deltas);
            pairs.map(|(a, b)| builder.add(*a, *b)).collect()
        };
    }
    builder.finish(sums)
}

/// A stage's values before (x) and after (x') its edits, and Δx.
struct Run<'a> {
    program: Steps,
    /// The edit of each place; its first, if a place has several.
    edits: BTreeMap<EditSite, &'a Edit>,
    builder: Builder,
    values: Vec<[Edge; 3]>,
}

impl<'a> Run<'a> {
    fn new(stage: &'a Stage, builder: Builder) -> Self {
        let edits = stage.edits.iter().rev();
        Run {
            program: stage.program.dag.steps(),
            edits: edits.map(|edit| (edit.place, edit)).collect(),
            builder,
            values: Vec::new(),
        }
    }

    fn edit(&self, place: EditSite) -> Option<&'a Edit> {
        self.edits.get(&place).copied()
    }

    fn before(&mut self, operand: &Operand) -> Edge {
        match operand {
            Operand::Input(input) => self.builder.input(*input),
            Operand::Constant(constant) => self.builder.constant(constant),
            Operand::Step(index) => self.values[*index][0],
        }
    }

    fn after(&mut self, operand: &Operand) -> Edge {
        match operand {
            Operand::Input(input) => match self.edit(EditSite::Input(*input)) {
                Some(edit) => self.replacement(edit),
                None => self.builder.input(*input),
            },
            Operand::Constant(constant) => self.builder.constant(constant),
            Operand::Step(index) => self.values[*index][1],
        }
    }

    fn replacement(&mut self, edit: &Edit) -> Edge {
        self.after(&edit.value).negated_if(edit.negative)
    }

    /// Returns replacement after − operand before
    fn moved(&mut self, edit: &Edit, operand: &Operand) -> Edge {
        let after = self.replacement(edit);
        let before = self.before(operand);
        self.builder.sub(after, before)
    }

    fn delta(&mut self, operand: &Operand) -> Edge {
        match operand {
            Operand::Input(input) => match self.edit(EditSite::Input(*input)) {
                Some(edit) => self.moved(edit, operand),
                None => self.builder.zero(),
            },
            Operand::Constant(_) => self.builder.zero(),
            Operand::Step(index) => self.values[*index][2],
        }
    }

    fn operand(&mut self, operand: &Operand, place: EditSite) -> [Edge; 3] {
        let before = self.before(operand);
        match self.edit(place) {
            None => [before, self.after(operand), self.delta(operand)],
            Some(edit) => {
                let after = self.replacement(edit);
                [before, after, self.moved(edit, operand)]
            }
        }
    }

    fn steps(&mut self) {
        let steps = std::mem::take(&mut self.program.steps);
        for (index, step) in steps.iter().enumerate() {
            let [a, a_after, da] = self.operand(&step.left, EditSite::Left(index));
            let [b, b_after, db] = self.operand(&step.right, EditSite::Right(index));
            let exact = self.builder.apply(step.operation, a, b);
            let (edited, delta) = match self.edit(EditSite::Step(index)) {
                None => (
                    self.builder.apply(step.operation, a_after, b_after),
                    self.unedited(step.operation, [b, da, db, a_after]),
                ),
                Some(edit) => {
                    let edited = self.replacement(edit);
                    // s·r' − x = s·Δr + (s·r − x); for an operand of the sum
                    // the second part is the other operand.
                    let minus = step.operation == Operation::Sub;
                    let sum = minus || step.operation == Operation::Add;
                    let rest = if sum && edit.value == step.left && !edit.negative {
                        b.negated_if(!minus)
                    } else if sum && edit.value == step.right && edit.negative == minus {
                        a.negated_if(true)
                    } else {
                        let before = self.before(&edit.value).negated_if(edit.negative);
                        self.builder.sub(before, exact)
                    };
                    let moved = self.delta(&edit.value).negated_if(edit.negative);
                    (edited, self.builder.add(moved, rest))
                }
            };
            self.values.push([exact, edited, delta]);
        }
    }

    fn outputs(&mut self, of: fn(&mut Self, &Operand) -> Edge) -> Vec<Edge> {
        self.steps();
        let outputs = std::mem::take(&mut self.program.outputs).into_iter();
        outputs
            .map(|own| of(self, &own.value).negated_if(own.negative))
            .collect()
    }

    fn unedited(&mut self, operation: Operation, [b, da, db, a_after]: [Edge; 4]) -> Edge {
        match operation {
            Operation::Add => self.builder.add(da, db),
            Operation::Sub => self.builder.sub(da, db),
            Operation::Mul | Operation::Fused => {
                let left = self.builder.mul(a_after, db);
                let right = self.builder.mul(b, da);
                self.builder.add(left, right)
            }
            // (a + Δa)/(b + Δb) − a/b = (Δa − (a/b) Δb)/(b + Δb)
            Operation::Div => {
                let before = self.builder.sub(a_after, da);
                let quotient = self.builder.div(before, b);
                let part = self.builder.mul(quotient, db);
                let moved = self.builder.sub(da, part);
                let divisor = self.builder.add(b, db);
                self.builder.div(moved, divisor)
            }
        }
    }
}

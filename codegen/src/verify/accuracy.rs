//! Accepts programs whose rounding error is at most a few times that of a textbook form.

use std::cell::Cell;

use dalembert_model::equations::Formulation;

use super::rounding::Rounding;
use crate::dag::Dag;
use crate::program::Counts;
use crate::seeds;
use crate::setup::Task;

/// An error of this many u is nothing to mend.
const FLOOR: f64 = 4.0;

/// The factor in rounding error that fewer operations may cost.
pub(crate) const WORSE: f64 = 4.0;

/// Longer chains are not measured: their programs are what the recursion is.
const MAX_MEASURED: usize = 16;

/// The most joints for which h_ikm is held against Lagrange–Euler.
const MAX_WRITTEN: usize = 7;

/// A program with fewer operations than the one taken, and a larger error than is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefusedProgram {
    pub counts: Counts,
    /// Its estimated normwise error, in units of u.
    pub error: f64,
    /// That of the program taken.
    pub taken: f64,
}

#[derive(Clone, Debug)]
pub(crate) struct AccuracyFilter<'a> {
    task: Task<'a>,
    reference: Option<Rounding>,
    /// The chunk of states that refused the last program: it may refuse the next one, too.
    worst_states: Cell<usize>,
}

impl<'a> AccuracyFilter<'a> {
    /// The textbook form is the link-frame recursion; for h_ikm Lagrange–Euler: no differences.
    pub(crate) fn new(task: Task<'a>, is_lenient: bool) -> Self {
        let mut quantities = task.function.quantities().iter();
        let (most, by) = match quantities.any(|quantity| quantity.facts().by_differences) {
            true => (MAX_WRITTEN, Formulation::LagrangeEuler),
            false => (MAX_MEASURED, Formulation::NewtonEulerLink),
        };
        let is_measured = !is_lenient && task.setup.joints() <= most;
        let textbook = is_measured.then(|| seeds::trace(task, by).graph);
        AccuracyFilter {
            task,
            reference: textbook.map(|textbook| estimate(task, &textbook)),
            worst_states: Cell::default(),
        }
    }

    pub(crate) fn accepts(&self, graph: &Dag) -> bool {
        self.excess(graph, 1.0_f64.next_up()) <= 1.0
    }

    /// Relative to the largest error that is accepted. At or above the bound it need not be exact.
    pub(crate) fn excess(&self, graph: &Dag, bound: f64) -> f64 {
        let Some(reference) = &self.reference else {
            return 0.0;
        };
        let excess = |rounding: &Rounding| rounding.factor(reference, FLOOR) / WORSE;
        let reaches = |rounding: &Rounding| excess(rounding) >= bound;
        let (task, first) = (&self.task, &self.worst_states);
        let program = task.program(graph);
        excess(&Rounding::until(task.setup, &program, first, reaches))
    }

    /// Returns the largest normwise error of the textbook form, in units of u.
    pub(crate) fn textbook(&self) -> f64 {
        let reference = self.reference.as_ref();
        reference.map_or(f64::INFINITY, Rounding::worst)
    }

    /// Returns the program's largest normwise error, in units of u.
    pub(crate) fn error(&self, graph: &Dag) -> f64 {
        estimate(self.task, graph).worst()
    }
}

fn estimate(task: Task<'_>, graph: &Dag) -> Rounding {
    Rounding::estimate(task.setup, &task.program(graph))
}

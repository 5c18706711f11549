//! A function of a robot in its scene: its formula in any scalar, with the arm and the motion that
//! it takes, and its program.

use dalembert_model::equations::load::{Loading, PAYLOAD, carried};
use dalembert_model::equations::matrix::Columns;
use dalembert_model::equations::regressor::Column;
use dalembert_model::equations::{Arm, DhVariables, Formulation, exact_pose};
use dalembert_model::number::Exact;
use dalembert_model::outputs::{Motion, RuntimeParameter, Sizes, Written};
use dalembert_model::scalar::{Divide, Scalar};

use super::Setup;
use crate::dag::{Dag, Leaves};
use crate::function::{Argument, Function, Quantity};
use crate::program::{Input, Program};

/// A function of a robot in its scene.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The robot in its scene.
    pub setup: &'a Setup,
    /// The function.
    pub function: Function,
}

/// The arm and motion that a formula is evaluated with.
#[derive(Clone, Debug)]
pub struct Posed<'a, S> {
    task: Task<'a>,
    /// The arm, gravity as the argument says and the payload on the last link,
    /// where the function takes them.
    pub arm: Arm<S>,
    /// Its motion.
    pub motion: Motion<S>,
    /// The columns of the regressor.
    pub columns: Vec<Column<S>>,
    /// The rows that results are over before the scene's are selected: with a payload
    /// one more, behind the last, which does not move.
    rows: Vec<usize>,
}

impl<'a> Task<'a> {
    /// Creates the program of a graph of the function.
    pub fn program(&self, graph: &Dag) -> Program {
        let Task { setup, function } = *self;
        let empty = Program {
            rows: setup.rows().to_vec(),
            arguments: setup.arguments(function),
            load: setup.sizes(function).load,
            speeds: setup.speeds(),
            ..Program::empty(function, Sizes::of(setup.robot()))
        };
        empty.with_graph(graph)
    }

    /// Evaluates the function by a textbook's formula, in the scalar of the leaves, over the whole
    /// arm: a locked joint has a constant pair or position, and rates that are zero. Returns the
    /// results over the scene's rows, flat.
    pub fn textbook<L: Leaves>(&self, by: Formulation, leaves: &L) -> Vec<L::Value> {
        self.posed(leaves).results(by)
    }

    /// Returns the scene's arm and its motion as the function takes them.
    pub fn posed<L: Leaves>(&self, leaves: &L) -> Posed<'a, L::Value> {
        self.posed_arm(self.setup.arm(|constant| leaves.constant(constant)), leaves)
    }

    /// Returns the arm and its motion as the function takes them, from the scene's arm in the scalar.
    pub fn posed_arm<L: Leaves>(&self, arm: Arm<L::Value>, leaves: &L) -> Posed<'a, L::Value> {
        let constant = |constant: &Exact| leaves.constant(constant);
        let columns = self.setup.columns(self.function, constant);
        self.posed_over(arm, leaves, columns)
    }

    pub(super) fn posed_over<L: Leaves>(
        &self,
        mut arm: Arm<L::Value>,
        leaves: &L,
        columns: Vec<Column<L::Value>>,
    ) -> Posed<'a, L::Value> {
        let Task { setup, function } = *self;
        let (input, constant) = (
            |input| leaves.input(input),
            |constant: &Exact| leaves.constant(constant),
        );
        let mut motion = setup.motion(input, constant);
        arm = arm.at_speeds(&motion.per_speed);
        let mut rows: Vec<usize> = (0..arm.links.len()).collect();
        if setup.takes(function, RuntimeParameter::Gravity) {
            let entry = |axis| input(Input::Entry(Argument::Gravity, axis));
            arm = arm.with_gravity(&[0, 1, 2].map(entry));
        }
        if function == Function::Load {
            motion.loading = Some(setup.loading(input, constant));
        } else if setup.takes(function, RuntimeParameter::Payload) {
            let frame = setup.payload_frame(constant);
            arm.links.push(carried(&payload(input), frame.as_ref()));
            motion = motion.with_still_link();
            rows.push(rows.len());
        }
        Posed {
            task: *self,
            arm,
            motion,
            columns,
            rows,
        }
    }
}

impl Setup {
    /// Returns one of its functions.
    pub fn task(&self, function: Function) -> Task<'_> {
        Task {
            setup: self,
            function,
        }
    }

    /// Returns the scene's arm in a scalar, with all its joints.
    pub fn arm<S: Scalar>(&self, mut constant: impl FnMut(&Exact) -> S) -> Arm<S> {
        Arm::from_robot(self.robot(), &mut constant)
    }

    pub(crate) fn loading<S: Scalar>(
        &self,
        input: impl FnMut(Input) -> S,
        mut constant: impl FnMut(&Exact) -> S,
    ) -> Loading<S> {
        let rows = self.load().map_or(&[][..], |load| &load.rows);
        Loading {
            payload: payload(input),
            rows: rows.iter().map(|row| row.map(&mut constant)).collect(),
            frame: self.payload_frame(constant),
        }
    }

    fn payload_frame<S>(&self, constant: impl FnMut(&Exact) -> S) -> Option<Columns<S>> {
        let frame = self.robot().payload_frame.as_ref()?;
        Some(exact_pose(frame).map(constant))
    }
}

fn payload<S>(mut input: impl FnMut(Input) -> S) -> Vec<S> {
    let entry = |index| input(Input::Entry(Argument::Payload, index));
    (0..PAYLOAD).map(entry).collect()
}

impl<S: Divide> Posed<'_, S> {
    fn written<'p>(
        &'p self,
        formulation: Formulation,
        at: &'p [DhVariables<S>],
        columns: &'p [Column<S>],
    ) -> Written<'p, S> {
        Written {
            formulation,
            arm: &self.arm,
            at,
            motion: &self.motion,
            columns,
        }
    }

    pub(crate) fn regressor(
        &self,
        by: Formulation,
        quantity: Quantity,
        columns: &[Column<S>],
    ) -> Vec<Vec<S>> {
        let at = self.arm.at(&self.motion.q);
        let entries = quantity.written(&self.written(by, &at, columns));
        let (setup, following) = (self.task.setup, &self.arm.following);
        let rows: Vec<usize> = (0..self.arm.links.len()).collect();
        let base = columns.len();
        let sizes = Sizes {
            base,
            ..Sizes::of(setup.robot())
        };
        let own = setup.select(quantity, sizes, &rows, following, entries);
        own.chunks(base.max(1)).map(<[S]>::to_vec).collect()
    }

    /// Returns the results over all joints there are.
    pub fn all(&self, by: Formulation) -> Vec<S> {
        let function = self.task.function;
        function.evaluate(by, &self.arm, &self.motion, &self.columns)
    }

    /// Returns the matrix that each quantity of the function inverts beside D.
    pub fn divisors(&self) -> Vec<Vec<S>> {
        let at = self.arm.at(&self.motion.q);
        let written = self.written(Formulation::NewtonEulerLink, &at, &self.columns);
        let quantities = self.task.function.quantities().iter();
        quantities
            .map(|quantity| quantity.divisor(&written))
            .collect()
    }

    /// Returns the results over the scene's rows, from those over all.
    pub fn select(&self, all: Vec<S>) -> Vec<S> {
        let Task { setup, function } = self.task;
        let (rows, following) = (&self.rows, &self.arm.following);
        let sizes = setup.sizes(function);
        let mut all = all.into_iter();
        let mut selected = Vec::with_capacity(function.outputs(sizes));
        for &quantity in function.quantities() {
            let own = all.by_ref().take(quantity.len(sizes.over_all(rows.len())));
            selected.extend(setup.select(quantity, sizes, rows, following, own.collect()));
        }
        selected
    }

    /// Returns the results over the scene's rows.
    pub fn results(&self, by: Formulation) -> Vec<S> {
        self.select(self.all(by))
    }
}

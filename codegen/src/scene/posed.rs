//! An arm and its motion as a function takes them, in the scalar of
//! a computation.

use dalembert_model::equations::load::{Loading, carried};
use dalembert_model::equations::matrix::Columns;
use dalembert_model::equations::regressor::Column;
use dalembert_model::equations::{Arm, Formulation, exact_pose};
use dalembert_model::number::Exact;
use dalembert_model::outputs::{Motion, RuntimeParameter, Written};
use dalembert_model::scalar::{Divide, Scalar};

use super::SceneRobot;
use crate::function::{Argument, Function};
use crate::program::Input;

/// The arm and motion that a formula is evaluated with.
#[derive(Clone, Debug)]
pub struct Posed<S> {
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

impl SceneRobot {
    /// Returns the scene's arm, given in the scalar, and its motion from the values of a
    /// program's inputs and of constants.
    pub fn posed<S: Scalar>(
        &self,
        function: Function,
        mut arm: Arm<S>,
        mut input: impl FnMut(Input) -> S,
        mut constant: impl FnMut(&Exact) -> S,
    ) -> Posed<S> {
        let mut motion = self.motion(&mut input, &mut constant);
        arm = arm.at_speeds(&motion.per_speed);
        let mut rows: Vec<usize> = (0..arm.links.len()).collect();
        if self.takes(function, RuntimeParameter::Gravity) {
            let entry = |axis| input(Input::Entry(Argument::Gravity, axis));
            arm = arm.with_gravity(&[0, 1, 2].map(entry));
        }
        if self.takes(function, RuntimeParameter::Payload) || function == Function::Load {
            if function == Function::Load {
                motion.loading = Some(self.loading(&mut input, &mut constant));
            } else {
                let frame = self.payload_frame(&mut constant);
                let link = carried(&self.payload(&mut input), frame.as_ref());
                arm = arm.with_link(link);
                motion = motion.with_still_link();
                rows.push(rows.len());
            }
        }
        Posed {
            arm,
            motion,
            columns: self.columns(function, constant),
            rows,
        }
    }

    /// Returns the numbers of a payload.
    fn payload<S>(&self, mut input: impl FnMut(Input) -> S) -> Vec<S> {
        let length = Argument::Payload.length(self.sizes(Function::Load));
        let entry = |index| input(Input::Entry(Argument::Payload, index));
        (0..length).map(entry).collect()
    }

    /// Returns the numbers of the load that a payload is.
    pub fn load_of<S: Scalar>(
        &self,
        input: impl FnMut(Input) -> S,
        constant: impl FnMut(&Exact) -> S,
    ) -> Vec<S> {
        self.loading(input, constant).load()
    }

    /// Returns a payload, and what turns it into a load.
    fn loading<S: Scalar>(
        &self,
        input: impl FnMut(Input) -> S,
        mut constant: impl FnMut(&Exact) -> S,
    ) -> Loading<S> {
        let rows = self.load().map_or(&[][..], |load| &load.rows);
        Loading {
            payload: self.payload(input),
            rows: rows.iter().map(|row| row.map(&mut constant)).collect(),
            frame: self.payload_frame(constant),
        }
    }

    /// Returns the frame that payloads are given in, in the last link's, where it is another.
    fn payload_frame<S>(&self, constant: impl FnMut(&Exact) -> S) -> Option<Columns<S>> {
        let frame = self.robot().payload_frame.as_ref()?;
        Some(exact_pose(frame).map(constant))
    }
}

impl<S: Divide> Posed<S> {
    /// Returns the results over all joints there are.
    pub fn all(&self, function: Function, formulation: Formulation) -> Vec<S> {
        function.evaluate(formulation, &self.arm, &self.motion, &self.columns)
    }

    /// Returns what each quantity of a function inverts beside D.
    pub fn divisors(&self, function: Function) -> Vec<Vec<S>> {
        let written = Written {
            formulation: Formulation::NewtonEulerLink,
            arm: &self.arm,
            at: &self.arm.at(&self.motion.q),
            motion: &self.motion,
            columns: &self.columns,
        };
        let quantities = function.quantities().iter();
        quantities
            .map(|quantity| quantity.divisor(&written))
            .collect()
    }

    /// Returns the results over the scene's rows, from those over all.
    pub fn select(&self, scene_robot: &SceneRobot, function: Function, all: Vec<S>) -> Vec<S> {
        scene_robot.select(function, &self.rows, &self.arm.following, all)
    }

    /// Returns the results over the scene's rows.
    pub fn results(
        &self,
        scene_robot: &SceneRobot,
        function: Function,
        formulation: Formulation,
    ) -> Vec<S> {
        self.select(scene_robot, function, self.all(function, formulation))
    }
}

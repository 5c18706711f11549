//! From a robot to the graph of one function: the equations run once with
//! symbols.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::{Arm, Formulation, JointPosition, Rotor};
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::Scalar;

use crate::function::{Function, Quantity};
use crate::graph::symbol::Symbol;
use crate::graph::{AngleSum, Builder, Counts, Folding, Graph, Input, Points};

/// q, q̇ and q̈ in the scalar of a computation.
#[derive(Clone, Debug)]
pub struct Motion<S> {
    /// Positions.
    pub q: Vec<JointPosition<S>>,
    /// Velocities.
    pub qd: Vec<S>,
    /// Accelerations.
    pub qdd: Vec<S>,
}

impl<S> Motion<S> {
    /// The motion of a robot from the values of a program's inputs.
    pub fn of(robot: &Robot, mut input: impl FnMut(Input) -> S) -> Motion<S> {
        let n = robot.joints.len();
        let q = robot.joints.iter().enumerate().map(|(i, joint)| {
            let angle = AngleSum::joint(i);
            match joint.kind {
                JointKind::Revolute => JointPosition::Revolute(Rotor {
                    sin: input(Input::Sin(angle)),
                    cos: input(Input::Cos(angle)),
                }),
                JointKind::Prismatic => JointPosition::Prismatic(input(Input::Position(i))),
            }
        });
        Motion {
            q: q.collect(),
            qd: (0..n).map(|i| input(Input::Velocity(i))).collect(),
            qdd: (0..n).map(|i| input(Input::Acceleration(i))).collect(),
        }
    }
}

/// The outputs of a function by one formulation, flat, in the order of its
/// quantities; each array row by row.
pub fn evaluate<S: Scalar>(
    function: Function,
    formulation: Formulation,
    arm: &Arm<S>,
    motion: &Motion<S>,
) -> Vec<S> {
    let at = arm.at(&motion.q);
    let mut outputs = Vec::with_capacity(function.outputs(arm.links.len()));
    for quantity in function.quantities() {
        match quantity {
            Quantity::Torque => {
                outputs.extend(formulation.inverse_dynamics(arm, &at, &motion.qd, &motion.qdd))
            }
            Quantity::Inertia => {
                outputs.extend(formulation.inertia(arm, &at).into_iter().flatten());
            }
            Quantity::Coriolis => {
                outputs.extend(formulation.velocity_terms(arm, &at, &motion.qd));
            }
            Quantity::Christoffel => {
                let h = formulation.christoffel(arm, &at);
                outputs.extend(h.into_iter().flatten().flatten());
            }
            Quantity::Gravity => outputs.extend(formulation.gravity(arm, &at)),
        }
    }
    outputs
}

/// A traced function.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Folded as it was built, nothing more.
    pub graph: Graph,
    /// The operations of the formula as it was executed, before folding.
    pub traced: Counts,
}

/// Runs a formulation with symbols.
pub fn trace(robot: &Robot, function: Function, formulation: Formulation) -> Trace {
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    let arm = Arm::from_robot(robot, &mut |constant| Symbol::from(constant.clone()));
    let motion = Motion::of(robot, |input| Symbol::input(&builder, input));
    let outputs: Vec<_> = evaluate(function, formulation, &arm, &motion)
        .iter()
        .map(Symbol::value)
        .collect();
    drop(motion);
    let traced = builder.borrow().asked();
    let graph = std::mem::replace(&mut *builder.borrow_mut(), Builder::new(Folding::Syntactic))
        .finish(&outputs);
    Trace { graph, traced }
}

impl Points {
    /// The outputs of a function at a robot's point, by a formulation in the
    /// field; `None` if a parameter's denominator is divisible by the prime.
    pub fn evaluate(
        &self,
        robot: &Robot,
        function: Function,
        formulation: Formulation,
        point: usize,
    ) -> Option<Vec<dalembert_model::scalar::field::Field>> {
        let mut failed = false;
        let arm = Arm::from_robot(robot, &mut |constant| match self.constant(constant) {
            Some(print) => print.0[point],
            None => {
                failed = true;
                Scalar::zero()
            }
        });
        let motion = Motion::of(robot, |input| self.input(input).0[point]);
        (!failed).then(|| evaluate(function, formulation, &arm, &motion))
    }
}

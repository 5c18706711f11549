//! From a robot to the graph of one function: the equations run once with
//! symbols.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use dalembert_model::equations::{Arm, Formulation, JointPosition, Rotor};
use dalembert_model::number::Exact;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use crate::function::{Function, Quantity};
use crate::graph::symbol::Symbol;
use crate::graph::{AngleSum, Builder, Counts, Folding, Graph, Input, Points};
use crate::scene::Setting;

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

impl<S: Clone> Motion<S> {
    /// The motion of these joints alone.
    pub fn of_joints(&self, joints: &[usize]) -> Motion<S> {
        let pick = |values: &[S]| joints.iter().map(|&joint| values[joint].clone()).collect();
        Motion {
            q: joints.iter().map(|&joint| self.q[joint].clone()).collect(),
            qd: pick(&self.qd),
            qdd: pick(&self.qdd),
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
    trace_in(&Setting::whole(robot), function, formulation)
}

/// Runs a formulation with symbols in a setting.
pub fn trace_in(setting: &Setting, function: Function, formulation: Formulation) -> Trace {
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    let constant = |constant: &Exact| Symbol::from(constant.clone());
    let arm = Arm::from_robot(setting.robot(), &mut { constant });
    let motion = setting.motion(|input| Symbol::input(&builder, input), constant);
    let outputs = evaluate(function, formulation, &arm, &motion);
    let outputs: Vec<_> = setting
        .select(function, setting.joints(), outputs)
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
    /// The outputs of a function at a point of a setting, by a formulation in
    /// the field; `None` if a parameter's denominator is divisible by the
    /// prime.
    ///
    /// The formulation runs on the whole arm: a locked joint is one whose
    /// pair or position is constant and whose rates are zero.
    pub fn evaluate(
        &self,
        setting: &Setting,
        function: Function,
        formulation: Formulation,
        point: usize,
    ) -> Option<Vec<Field>> {
        let failed = Cell::new(false);
        let constant = |constant: &Exact| match self.constant(constant) {
            Some(print) => print.0[point],
            None => {
                failed.set(true);
                Field::zero()
            }
        };
        let arm = Arm::from_robot(setting.robot(), &mut { constant });
        let motion = setting.motion(|input| self.input(input).0[point], constant);
        let evaluate = || {
            let outputs = evaluate(function, formulation, &arm, &motion);
            setting.select(function, setting.joints(), outputs)
        };
        (!failed.get()).then(evaluate)
    }
}

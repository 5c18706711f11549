//! The reference: the link-frame recursion over a big float of 134 digits, at
//! the exact parameters and the exact binary state.

use std::cell::RefCell;
use std::collections::BTreeMap;

use dalembert_model::equations::{Arm, Formulation, SinCosPair};
use dalembert_model::number::{Angle, Exact};
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::big::Big;

use dalembert_codegen::workspace::function::{Argument, Function};
use dalembert_codegen::workspace::program::{AngleSum, Input};
use dalembert_codegen::workspace::scene::SceneRobot;
use dalembert_codegen::workspace::states::JointState;

/// A robot in the big float, or in a scene.
#[derive(Clone, Debug)]
pub struct Truth {
    scene_robot: SceneRobot,
    arm: Arm<Big>,
    /// The sines and cosines of the last states' positions, by their bits: most of
    /// the work of a state, and functions are compared at the same states.
    sines: RefCell<BTreeMap<u64, (Big, Big)>>,
}

/// The most sines that are kept.
const MAX_SINES: usize = 1 << 14;

impl Truth {
    /// Takes a robot, nothing snapped, each parameter rounded to 448 bits.
    pub fn new(robot: &Robot) -> Truth {
        Truth::in_scene(&SceneRobot::whole(robot))
    }

    /// Takes a robot in a scene: whatever a state says, locked joints are exactly
    /// where they are locked.
    pub fn in_scene(scene_robot: &SceneRobot) -> Truth {
        Truth {
            arm: Arm::from_robot(scene_robot.robot(), &mut number),
            scene_robot: scene_robot.clone(),
            sines: RefCell::default(),
        }
    }

    /// Returns sine and cosine of a position.
    fn pair(&self, q: f64) -> (Big, Big) {
        let mut sines = self.sines.borrow_mut();
        if sines.len() >= MAX_SINES {
            sines.clear();
        }
        let made = || Big::from_f64(q).unwrap_or_else(Big::zero).sin_cos();
        sines.entry(q.to_bits()).or_insert_with(made).clone()
    }

    /// Returns the results of a function over the scene's rows, flat; `None` at a
    /// state that is not finite.
    pub fn run(&self, function: Function, state: &JointState) -> Option<Vec<Big>> {
        if !state.is_finite() {
            return None;
        }
        let finite = |x: f64| Big::from_f64(x).unwrap_or_else(Big::zero);
        // A motion reads the angles of single joints only.
        let joint = |sum: AngleSum| sum.terms().map(|(joint, _)| joint).sum::<usize>();
        let pair = |sum: AngleSum| self.pair(state.q[joint(sum)]);
        let input = |input| match input {
            Input::Sin(sum) => pair(sum).0,
            Input::Cos(sum) => pair(sum).1,
            Input::PerSpeed(joint) => {
                let qd = finite(state.entry(Argument::Velocity, joint));
                self.scene_robot.per_speed(joint, &qd, number, Big::sqrt)
            }
            Input::Entry(argument, joint) => finite(state.entry(argument, joint)),
        };
        let scene_robot = &self.scene_robot;
        let posed = scene_robot.posed(function, self.arm.clone(), input, number);
        Some(posed.results(scene_robot, function, Formulation::NewtonEulerLink))
    }
}

/// Returns an exact constant, rounded to 448 bits.
pub fn number(constant: &Exact) -> Big {
    let value = constant.map(&mut |x| Some(Big::from_rational(x)), &mut |angle| {
        let (sin, cos) = match angle {
            Angle::PiTimes(multiple) => Big::sin_cos_pi(multiple),
            Angle::Radians(radians) => Big::sin_cos_of(radians),
        };
        SinCosPair { sin, cos }
    });
    // Every rational has its big float.
    value.unwrap_or_else(Big::zero)
}

//! The reference: the link-frame recursion over a float of 76 digits, at
//! the exact parameters and the exact binary state.

use std::cell::RefCell;
use std::collections::BTreeMap;

use dalembert_model::equations::{Arm, Formulation, SinCosPair};
use dalembert_model::number::{Angle, Wide};
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;

use dalembert_codegen::workspace::function::{Argument, Function};
use dalembert_codegen::workspace::program::{AngleSum, Input};
use dalembert_codegen::workspace::scene::SceneRobot;
use dalembert_codegen::workspace::states::JointState;

/// A robot in the wide float, or in a scene.
#[derive(Clone, Debug)]
pub struct Truth {
    scene_robot: SceneRobot,
    arm: Arm<Wide>,
    /// The sines and cosines of the last states' positions, by their bits: most of
    /// the work of a state, and functions are compared at the same states.
    sines: RefCell<BTreeMap<u64, SinCosPair<Wide>>>,
}

/// The most sines that are kept.
const MAX_SINES: usize = 1 << 14;

impl Truth {
    /// Takes a robot, nothing snapped, each parameter cut to 256 bits.
    pub fn new(robot: &Robot) -> Truth {
        Truth::in_scene(&SceneRobot::whole(robot))
    }

    /// Takes a robot in a scene: whatever a state says, locked joints are exactly
    /// where they are locked.
    pub fn in_scene(scene_robot: &SceneRobot) -> Truth {
        Truth {
            arm: Arm::from_robot(scene_robot.robot(), &mut Wide::from_exact),
            scene_robot: scene_robot.clone(),
            sines: RefCell::default(),
        }
    }

    /// Returns sine and cosine of a position.
    fn pair(&self, q: f64) -> SinCosPair<Wide> {
        let mut sines = self.sines.borrow_mut();
        if sines.len() >= MAX_SINES {
            sines.clear();
        }
        let none = || Wide::sincos(&Angle::right_angles(0));
        let made = || Wide::sincos_of(q).unwrap_or_else(none);
        sines.entry(q.to_bits()).or_insert_with(made).clone()
    }

    /// Returns the results of a function over the scene's rows, flat; `None` at a
    /// state that is not finite.
    pub fn run(&self, function: Function, state: &JointState) -> Option<Vec<Wide>> {
        if !state.is_finite() {
            return None;
        }
        let finite = |x: f64| Wide::from_f64(x).unwrap_or_else(Wide::zero);
        // A motion reads the angles of single joints only.
        let joint = |sum: AngleSum| sum.terms().map(|(joint, _)| joint).sum::<usize>();
        let pair = |sum: AngleSum| self.pair(state.q[joint(sum)]);
        let input = |input| match input {
            Input::Sin(sum) => pair(sum).sin,
            Input::Cos(sum) => pair(sum).cos,
            Input::PerSpeed(joint) => {
                let qd = finite(state.entry(Argument::Velocity, joint));
                self.scene_robot
                    .per_speed(joint, &qd, Wide::from_exact, Wide::sqrt)
            }
            Input::Entry(argument, joint) => finite(state.entry(argument, joint)),
        };
        let scene_robot = &self.scene_robot;
        let posed = scene_robot.posed(function, self.arm.clone(), input, Wide::from_exact);
        Some(posed.results(scene_robot, function, Formulation::NewtonEulerLink))
    }
}

//! A robot and states that may be changed on trial, and how far they are apart.

use dalembert_codegen::function::{Function, Quantity};
use dalembert_codegen::verify::floating::Runtime;
use dalembert_model::robot::Robot;

use super::{GivenState, float, worst};

/// What is compared on trial.
#[derive(Clone)]
pub(super) struct Case {
    pub robot: Robot,
    pub states: Vec<GivenState>,
    /// What the file's h has besides the Coriolis and centripetal load.
    pub load: Load,
}

/// What a load may include.
#[derive(Clone, Copy, Default)]
pub(super) struct Load {
    pub gravity: bool,
    pub damping: bool,
}

impl Case {
    /// The largest error relative to a state's largest entry; no more states
    /// are looked at after one above `limit`.
    pub fn error(&self, limit: f64) -> f64 {
        let runtime = Runtime::new(&self.robot);
        let mut most = 0.0f64;
        for given in &self.states {
            most = most.max(self.error_at(&runtime, given));
            if most > limit {
                break;
            }
        }
        most
    }

    fn error_at(&self, runtime: &Runtime, given: &GivenState) -> f64 {
        let GivenState { state, known } = given;
        let run = |function: Function| runtime.run(function, state);
        let mut most = 0.0f64;
        for (quantity, known) in known {
            let values = match quantity {
                Quantity::Torque => run(Function::InverseDynamics),
                Quantity::Inertia => run(Function::Inertia),
                Quantity::Gravity => run(Function::Gravity),
                Quantity::LinkRegressor => run(Function::FullRegressor),
                Quantity::Coriolis => {
                    let mut load = run(Function::Coriolis);
                    if self.load.gravity {
                        let gravity = run(Function::Gravity);
                        load.iter_mut().zip(gravity).for_each(|(h, c)| *h += c);
                    }
                    if self.load.damping {
                        let joints = self.robot.joints.iter().zip(&state.qd);
                        let damping = joints.map(|(joint, qd)| float(&joint.viscous) * qd);
                        load.iter_mut().zip(damping).for_each(|(h, b)| *h += b);
                    }
                    load
                }
                // No cause that is tried concerns the others.
                _ => continue,
            };
            most = most.max(worst(&values, known).1);
        }
        most
    }
}

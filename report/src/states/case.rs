//! A robot and states that may be changed on trial, and how far they are apart.

use dalembert_codegen::workspace::function::{Columns, Function, Quantity, Sizes};
use dalembert_codegen::workspace::states::JointState;
use dalembert_codegen::workspace::verify::floating::Runtime;
use dalembert_model::robot::Robot;

use super::{GivenState, float, worst};

/// The most that the condition of D excuses.
const MAX_CONDITION: f64 = 1e4;

/// A comparison on trial.
#[derive(Clone)]
pub(super) struct Case {
    pub robot: Robot,
    pub states: Vec<GivenState>,
    /// The loads in the file's h besides the Coriolis and centripetal load.
    pub load: Load,
}

/// The parts that a load may include.
#[derive(Clone, Copy, Default)]
pub(super) struct Load {
    pub gravity: bool,
    pub damping: bool,
}

impl Case {
    /// Returns the largest error relative to a state's largest entry; no more states
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
                other => match by_its_function(runtime, *other, state) {
                    Some(values) => values,
                    None => continue,
                },
            };
            most = most.max(worst(&values, known).1 / granted(runtime, *quantity, state));
        }
        most
    }
}

/// Returns a quantity as its own function returns it; nothing of those whose columns are the
/// robot's.
fn by_its_function(runtime: &Runtime, quantity: Quantity, state: &JointState) -> Option<Vec<f64>> {
    let function = quantity.function();
    if function == Function::Load || matches!(function.columns(), Columns::Base(_)) {
        return None;
    }
    let sizes = Sizes::whole(state.q.len());
    let before = function.quantities().iter().take_while(|q| **q != quantity);
    let start: usize = before.map(|q| q.len(sizes)).sum();
    let values = runtime.run(function, state);
    Some(values.get(start..start + quantity.len(sizes))?.to_vec())
}

/// Returns how many times more than others a quantity may be off at a state. A change on trial
/// that makes D singular must not excuse everything.
fn granted(runtime: &Runtime, quantity: Quantity, state: &JointState) -> f64 {
    let condition = runtime.granted(quantity.function(), state).to(quantity);
    condition.min(MAX_CONDITION)
}

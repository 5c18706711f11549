//! The plan on the arm.

use example_shared::integrate::largest;

use crate::model::{State, UPRIGHT, step};
use crate::plan::{self, Plan};
use crate::{limited, model};

/// The period of the controller, s.
pub const PERIOD: f64 = 1e-3;

/// The motion and torques of a run.
#[derive(Clone, Debug)]
pub struct Run {
    /// When, s; the state; the torque from then on, N·m.
    pub samples: Vec<(f64, State, f64)>,
    /// The state at the end.
    pub end: State,
}

impl Run {
    /// Returns how far the end is from upright at rest.
    pub fn off(&self) -> f64 {
        largest((self.end - UPRIGHT).abs().iter().copied())
    }
}

/// Swings the arm up by the plan, its gains on the states between those planned, then
/// holds it upright for so many seconds. `push` is what q̇₁ is off at the start, rad/s.
pub fn follow(plan: &Plan, hold: f64, push: f64) -> Run {
    let each = (plan::PERIOD / PERIOD).round() as usize;
    let swing = each * plan.torques.len();
    let upright = plan::holding(PERIOD);
    let mut state = model::HANGING;
    state[2] += push;
    // Where the plan is; it has a torque for longer than a period.
    let mut planned = model::HANGING;
    let mut samples = Vec::new();
    for k in 0..swing + (hold / PERIOD).round() as usize {
        let torque = match k < swing {
            true => {
                let torque = plan.torques[k / each];
                let answer = plan.gains[k / each].dot(&(state - planned));
                planned = match (k + 1) % each {
                    0 => plan.states[(k + 1) / each],
                    _ => step(&planned, torque, PERIOD),
                };
                limited(torque + answer)
            }
            false => limited(upright.dot(&(state - UPRIGHT))),
        };
        samples.push((k as f64 * PERIOD, state, torque));
        state = step(&state, torque, PERIOD);
    }
    Run {
        samples,
        end: state,
    }
}

//! Runs the plan on the arm.

use example_shared::largest;

use crate::limited;
use crate::model::{HANGING, UPRIGHT, step};
use crate::plan::{self, Plan};

/// The period of the controller, s.
const PERIOD: f64 = 1e-3;

/// Swings the arm up by the plan and its gains at 1 kHz, then holds it upright for `hold`
/// seconds. `push` is the error of q̇₁ at the start, rad/s. Returns the largest error of the last
/// state from upright at rest, and the largest torque, N·m.
pub fn follow(plan: &Plan, hold: f64, push: f64) -> [f64; 2] {
    let periods = (plan::PERIOD / PERIOD).round() as usize;
    let swing = periods * plan.torques.len();
    let upright = plan::holding(PERIOD);
    let mut state = HANGING;
    state[2] += push;
    // The planned state; a torque of the plan lasts several periods.
    let mut planned = HANGING;
    let mut most = 0.0;
    for k in 0..swing + (hold / PERIOD).round() as usize {
        let torque = match k < swing {
            true => {
                let torque = plan.torques[k / periods];
                let answer = plan.gains[k / periods].dot(&(state - planned));
                planned = match (k + 1) % periods {
                    0 => plan.states[(k + 1) / periods],
                    _ => step(&planned, torque, PERIOD),
                };
                limited(torque + answer)
            }
            false => limited(upright.dot(&(state - UPRIGHT))),
        };
        most = largest([most, torque]);
        state = step(&state, torque, PERIOD);
    }
    [largest((state - UPRIGHT).iter().copied()), most]
}

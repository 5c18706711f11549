//! The motion while feet stand, and what happens when others touch the ground.

use crate::{Rates, Stance, State, go2};

/// λ² of the forces: small beside J D⁻¹ Jᵀ, 1/kg.
const DAMPING: [f64; 1] = [1e-9];

/// Returns the accelerations and the forces on the feet that stand, in the base's axes and in the
/// order of the legs.
pub fn accelerations(state: &State, stance: Stance, tau: &Rates) -> (Rates, Vec<f64>) {
    let (q, v, tau, g) = (&state.q, &state.v.into(), &(*tau).into(), &state.gravity());
    match stance {
        Stance::Four => {
            let solution = go2::contact_forward_dynamics_fl_foot_fr_foot_rl_foot_rr_foot(
                q, v, tau, g, &DAMPING,
            );
            let forces = solution.forces_fl_foot_fr_foot_rl_foot_rr_foot.to_vec();
            (solution.qdd_fl_foot_fr_foot_rl_foot_rr_foot.into(), forces)
        }
        Stance::RightThree => {
            let solution =
                go2::contact_forward_dynamics_fr_foot_rl_foot_rr_foot(q, v, tau, g, &DAMPING);
            let forces = solution.forces_fr_foot_rl_foot_rr_foot.to_vec();
            (solution.qdd_fr_foot_rl_foot_rr_foot.into(), forces)
        }
        Stance::LeftThree => {
            let solution =
                go2::contact_forward_dynamics_fl_foot_rl_foot_rr_foot(q, v, tau, g, &DAMPING);
            let forces = solution.forces_fl_foot_rl_foot_rr_foot.to_vec();
            (solution.qdd_fl_foot_rl_foot_rr_foot.into(), forces)
        }
    }
}

/// Returns the state after a time in which the torques do not change, by the midpoint rule, and the
/// work of the joints, J.
pub fn step(state: &State, stance: Stance, tau: &Rates, period: f64) -> (State, f64) {
    let moved = |by: &Rates, rate: &Rates, time: f64| {
        let base = std::array::from_fn(|i| time * by[i]);
        State {
            pose: state.pose.integrate(base),
            q: std::array::from_fn(|i| state.q[i] + time * by[6 + i]),
            v: state.v + rate * time,
        }
    };
    let (first, _) = accelerations(state, stance, tau);
    let middle = moved(&state.v, &first, 0.5 * period);
    let (rate, _) = accelerations(&middle, stance, tau);
    let work = tau.dot(&middle.v) * period;
    (moved(&middle.v, &rate, period), work)
}

/// Returns the state after all feet have touched the ground and stay, without a bounce, and the
/// energy that is lost, J: v⁺ = v − D⁻¹ Jᵀ (J D⁻¹ Jᵀ)⁻¹ J v.
pub fn touch_down(state: &State) -> (State, f64) {
    let rows = go2::inertia(&state.q);
    let inertia = nalgebra::SMatrix::<f64, { go2::NV }, { go2::NV }>::from_fn(|i, k| rows[i][k]);
    let jacobian = state.jacobian();
    let factor = inertia.cholesky().expect("D is positive definite");
    let driven = factor.solve(&jacobian.transpose());
    let mobility = (jacobian * driven).lu();
    let pushed = mobility
        .solve(&(jacobian * state.v))
        .expect("the feet move on their own");
    let after = State {
        v: state.v - driven * pushed,
        ..*state
    };
    (after, state.energy() - after.energy())
}

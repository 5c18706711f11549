//! The controller: accelerations that keep the base where it is, forces of the feet that give
//! them, and the torques of the joints that give the forces.

use dalembert_pose::Pose;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::{LEGS, Rates, Stance, State, go2};

/// Stiffness and damping of the base, 1/s² and 1/s.
const BASE: [f64; 2] = [200.0, 28.0];
/// Stiffness and damping of a leg in the air, 1/s² and 1/s.
const LEG: [f64; 2] = [2500.0, 100.0];

/// Torques of the joints, and the forces of the feet that the controller counts on.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    /// Torques; nothing acts on the base.
    pub tau: Rates,
    /// Forces on the feet in the base's axes, three a leg, N.
    pub forces: [f64; 3 * LEGS],
}

/// Returns the torques that bring the base to a pose, while the legs that do not stand take
/// positions, three a leg.
///
/// The forces are the least squares of those that give the base its acceleration: the weight is
/// shared.
pub fn command(
    state: &State,
    stance: Stance,
    target: &Pose<f64>,
    legs: &[[f64; 3]; LEGS],
) -> Command {
    let accelerations = wished(state, stance, target, legs);
    let g = state.gravity();
    let (v, a) = (state.v.into(), accelerations.into());
    let needed = Rates::from(go2::inverse_dynamics(&state.q, &v, &a, &g));
    let jacobian = state.jacobian();
    let standing = (0..LEGS).filter(|leg| stance.has(*leg));
    let rows: Vec<usize> = standing.flat_map(|leg| 3 * leg..3 * leg + 3).collect();
    // The effect of a force on a foot on the base.
    let on_base = DMatrix::from_fn(6, rows.len(), |i, k| jacobian[(rows[k], i)]);
    let wrench = DVector::from_fn(6, |i, _| needed[i]);
    let decomposition = on_base.svd(true, true);
    let shared = decomposition
        .solve(&wrench, 1e-6)
        .expect("both sides of the decomposition were asked for");
    let mut forces = [0.0; 3 * LEGS];
    for (row, force) in rows.iter().zip(shared.iter()) {
        forces[*row] = *force;
    }
    let mut tau = needed;
    for (row, force) in forces.iter().enumerate() {
        tau -= jacobian.row(row).transpose() * *force;
    }
    tau.fixed_rows_mut::<6>(go2::BASE).fill(0.0);
    Command { tau, forces }
}

/// Returns accelerations under which feet that stand stay where they are.
fn wished(state: &State, stance: Stance, target: &Pose<f64>, legs: &[[f64; 3]; LEGS]) -> Rates {
    let mut wished = Rates::zeros();
    let away = state.pose.difference(target);
    for (i, away) in away.into_iter().enumerate() {
        wished[i] = BASE[0] * away - BASE[1] * state.v[i];
    }
    let jacobian = state.jacobian();
    let v = state.v.into();
    let bias = go2::contact_bias_fl_foot_fr_foot_rl_foot_rr_foot(&state.q, &v);
    for leg in 0..LEGS {
        let first = go2::FL_HIP_JOINT + 3 * leg;
        if stance.has(leg) {
            let block = Matrix3::from_fn(|i, k| jacobian[(3 * leg + i, first + k)]);
            let taken = |i: usize| {
                let row = jacobian.row(3 * leg + i);
                let by_base: f64 = (0..6).map(|k| row[k] * wished[k]).sum();
                -bias[3 * leg + i] - by_base
            };
            let taken = Vector3::from_fn(|i, _| taken(i));
            let rates = block.lu().solve(&taken).unwrap_or_default();
            wished.fixed_rows_mut::<3>(first).copy_from(&rates);
        } else {
            for joint in 0..3 {
                let off = legs[leg][joint] - state.q[3 * leg + joint];
                wished[first + joint] = LEG[0] * off - LEG[1] * state.v[first + joint];
            }
        }
    }
    wished
}

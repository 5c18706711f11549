//! A moving UR10 is pushed at its hand, and detects the push by its momentum.
//!
//! - [`observer`]: the external torques, from the torques of the drives and the motion
//! - [`simulate`]: the arm, its controller and the push, at 1 kHz
//!
//! The arm has no force sensor: the observer takes positions, velocities and the torques of the
//! drives. De Luca and Mattone, "Sensorless robot collision detection and
//! hybrid force/motion control", 2005.
#![forbid(unsafe_code)]

pub mod observer;

use std::ops::Range;

use example_shared::largest;
use observer::Observer;

dalembert::dynamics! {
    /// The arm, with the functions that detect a push.
    pub mod ur10 = "../../generated/robots/ur10.toml";
    outputs: inverse_dynamics, forward_dynamics_with_wrench, momentum_observer, contact_wrench;
    scalar: f64;
}

/// A value for each joint.
pub type Joints = [f64; ur10::N];

/// Positions and velocities of the arm.
pub type State = example_shared::State<{ ur10::N }>;

/// Force over moment on the hand, in base axes.
pub type Wrench = [f64; 6];

/// The period of controller and observer, s.
pub const PERIOD: f64 = 1e-3;

/// An external torque above this is a push, N·m. Without a push the observer stays below a
/// thousandth of it.
pub const THRESHOLD: f64 = 1.0;

/// λ², the damping of the wrench estimate: small beside J Jᵀ where the arm is bent.
const DAMPING: [f64; 1] = [1e-6];

/// The closed loop's frequency, rad/s.
const FREQUENCY: f64 = 20.0;

/// A push on the hand.
pub struct Push {
    /// When it begins and ends, s.
    pub during: Range<f64>,
    /// Its force and moment.
    pub wrench: Wrench,
}

/// The observer's result at one time.
#[derive(Debug)]
pub struct Noticed {
    /// When, s.
    pub time: f64,
    /// The largest external torque, N·m: above [`THRESHOLD`] it is a push.
    pub torque: f64,
    /// The wrench on the hand that explains the torques.
    pub wrench: Wrench,
}

/// Returns the target's q, q̇ and q̈ at a time, s: slow swings of every joint from a bent pose.
fn target(time: f64) -> [Joints; 3] {
    let centre = [0.2, -1.2, 1.6, -1.9, -1.4, 0.3];
    let (s, c) = time.sin_cos();
    let q = centre.map(|q| q + 0.2 * (1.0 - c));
    [q, [0.2 * s; ur10::N], [0.2 * c; ur10::N]]
}

/// Simulates the pushed arm for `duration` seconds; returns the observer's results.
pub fn simulate(push: &Push, duration: f64) -> Vec<Noticed> {
    let [q, qd, _] = target(0.0);
    let mut state = State { q, qd };
    let mut observer = Observer::new(&state);
    let mut samples = Vec::new();
    for step in 0..(duration / PERIOD).round() as u32 {
        let time = f64::from(step) * PERIOD;
        let [q, qd, qdd] = target(time);
        let wanted = core::array::from_fn(|i| {
            let (error, rate) = (q[i] - state.q[i], qd[i] - state.qd[i]);
            qdd[i] + 2.0 * FREQUENCY * rate + FREQUENCY * FREQUENCY * error
        });
        let tau = ur10::inverse_dynamics(&state.q, &state.qd, &wanted);
        let is_pushed = push.during.contains(&time);
        let wrench = if is_pushed { push.wrench } else { [0.0; 6] };
        let next = state.step(PERIOD, |at| {
            ur10::forward_dynamics_with_wrench(&at.q, &at.qd, &tau, &wrench)
        });
        let outside = observer.observe(&state, &next, &tau);
        state = next;
        samples.push(Noticed {
            time: time + PERIOD,
            torque: largest(outside),
            wrench: ur10::contact_wrench(&state.q, &outside, &DAMPING),
        });
    }
    samples
}

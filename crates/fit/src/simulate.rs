//! Seeded logs of an arm whose parameters are known: what identification and watching are tried on.

mod controlled;

use crate::error::{Error, check, ensure};
use crate::fourier::Trajectory;
use crate::model::Model;
use crate::random::{Random, normal};
pub use controlled::{Collision, ControlledArm, control};

/// The settings of a simulated log.
#[derive(Clone, Debug, PartialEq)]
pub struct LogSettings {
    /// Time between two states, s.
    pub period: f64,
    /// Number of states.
    pub states: usize,
    /// Standard deviation of each joint's torque, N·m or N.
    pub noise: Vec<f64>,
    /// The encoders' step, rad or m; zero for exact positions.
    pub resolution: f64,
    /// The seed of the noise.
    pub seed: u64,
}

impl LogSettings {
    fn check(&self, joints: usize) -> Result<(), Error> {
        check("noise", &self.noise, joints)?;
        let expected = "a recording needs a positive period and a resolution of zero or more";
        ensure(self.period > 0.0 && self.resolution >= 0.0, expected)
    }

    fn noisy(&self, tau: &[f64], random: &mut Random) -> Vec<f64> {
        let noisy = |(tau, noise): (&f64, &f64)| tau + noise * normal(random);
        tau.iter().zip(&self.noise).map(noisy).collect()
    }

    /// Returns positions as the encoders tell them.
    pub fn read(&self, q: &[f64]) -> Vec<f64> {
        let step = self.resolution;
        let read = |q: &f64| match step > 0.0 {
            true => step * libm::round(*q / step),
            false => *q,
        };
        q.iter().map(read).collect()
    }
}

/// A log: of each state the joints' values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// Positions as the encoders tell them.
    pub q: Vec<Vec<f64>>,
    /// True velocities.
    pub qd: Vec<Vec<f64>>,
    /// True accelerations.
    pub qdd: Vec<Vec<f64>>,
    /// Torques with noise.
    pub tau: Vec<Vec<f64>>,
}

impl Log {
    fn push(&mut self, q: Vec<f64>, [qd, qdd]: [Vec<f64>; 2], tau: Vec<f64>) {
        self.q.push(q);
        self.qd.push(qd);
        self.qdd.push(qdd);
        self.tau.push(tau);
    }
}

/// Records an arm of these parameters, one a column of the model, on the exact trajectory.
///
/// # Errors
/// [`Error::Length`], [`Error::Value`] and [`Error::Option`].
pub fn record(
    model: &Model,
    parameters: &[f64],
    trajectory: &Trajectory,
    recording: &LogSettings,
) -> Result<Log, Error> {
    check("parameters", parameters, model.columns().len())?;
    recording.check(model.joints())?;
    let mut random = Random::new(recording.seed);
    let mut log = Log::default();
    for k in 0..recording.states {
        let [q, qd, qdd] = trajectory.at(k as f64 * recording.period);
        let y = model.regressor(&q, &qd, &qdd)?;
        let tau = crate::dense::apply(&y, parameters);
        let tau = recording.noisy(&tau, &mut random);
        log.push(recording.read(&q), [qd, qdd], tau);
    }
    Ok(log)
}

//! Seeded logs of an arm whose parameters are known: what identification is tried on.

use crate::error::{Error, check};
use crate::fourier::Trajectory;
use crate::model::Model;
use crate::random::{Random, normal};

/// How an arm is logged.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Time between two states, s.
    pub period: f64,
    /// Number of states.
    pub states: usize,
    /// Standard deviation of each joint's torque, N·m or N.
    pub noise: Vec<f64>,
    /// The encoders' step, rad or m; zero for exact positions.
    pub resolution: f64,
    /// What the noise is drawn from.
    pub seed: u64,
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

/// Records an arm of these parameters, an entry a column of the model, on a trajectory.
///
/// # Errors
/// [`Error::Length`], [`Error::Value`] and [`Error::Option`].
pub fn record(
    model: &Model,
    parameters: &[f64],
    trajectory: &Trajectory,
    recording: &Recording,
) -> Result<Log, Error> {
    check("parameters", parameters, model.columns().len())?;
    check("noise", &recording.noise, model.joints())?;
    if !(recording.period > 0.0 && recording.resolution >= 0.0) {
        return Err(Error::Option(
            "a recording has a positive period and a resolution that is not negative",
        ));
    }
    let mut random = Random::new(recording.seed);
    let mut log = Log::default();
    for k in 0..recording.states {
        let [mut q, qd, qdd] = trajectory.at(k as f64 * recording.period);
        let y = model.regressor(&q, &qd, &qdd)?;
        let mut tau = crate::dense::apply(&y, parameters);
        for (tau, noise) in tau.iter_mut().zip(&recording.noise) {
            *tau += noise * normal(&mut random);
        }
        if recording.resolution > 0.0 {
            for q in &mut q {
                *q = recording.resolution * libm::round(*q / recording.resolution);
            }
        }
        log.q.push(q);
        log.qd.push(qd);
        log.qdd.push(qdd);
        log.tau.push(tau);
    }
    Ok(log)
}

//! An arm under computed torque: it does not quite follow, and things happen to it.

use dalembert_model::reference::Reference;
use dalembert_model::robot::Robot;
use nalgebra::DVector;

use super::{Log, LogSettings};
use crate::error::{Error, check};
use crate::fourier::Trajectory;
use crate::random::Random;

/// An arm with what happens to it.
#[derive(Clone, Debug)]
pub struct ControlledArm {
    /// The arm from each time on, s, in order; the first is the arm from the beginning.
    pub arms: Vec<(f64, Robot)>,
    /// The controller's model of it.
    pub controller: Robot,
    /// The bandwidth at which the controller corrects errors of position, rad/s.
    pub bandwidth: f64,
    /// Contacts with something.
    pub collisions: Vec<Collision>,
}

/// A contact that pushes the joints, from nothing to a peak and back in half a sine.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision {
    /// When it begins, s.
    pub start: f64,
    /// The duration, s.
    pub duration: f64,
    /// The torque on each joint at its peak, N·m or N.
    pub torque: Vec<f64>,
}

impl Collision {
    /// Returns the part of the peak at a time.
    pub fn part(&self, time: f64) -> f64 {
        let phase = (time - self.start) / self.duration;
        match (0.0..1.0).contains(&phase) {
            true => libm::sin(core::f64::consts::PI * phase),
            false => 0.0,
        }
    }
}

/// Records an arm that computed torque drives along a trajectory,
///
/// ```text
/// τ = D (q̈_d + 2 ω (q̇_d − q̇) + ω² (q_d − q)) + h + c + friction
/// ```
///
/// in the controller's parameters. A state and the controller's torque are held for the
/// recording's period, at the end of which velocities are taken for those of all of it
/// (semi-implicit Euler): the period is that of a controller, 1 ms.
///
/// # Errors
/// [`Error::Length`] and [`Error::Option`]; [`Error::Value`] where the arm gets out of control.
pub fn control(
    controlled: &ControlledArm,
    trajectory: &Trajectory,
    recording: &LogSettings,
) -> Result<Log, Error> {
    let n = controlled.controller.joints.len();
    recording.check(n)?;
    check("middle", &trajectory.middle, n)?;
    let reference = |(from, arm): &(f64, Robot)| (*from, Reference::from_robot(arm));
    let arms: Vec<(f64, Reference<f64>)> = controlled.arms.iter().map(reference).collect();
    for (_, arm) in &arms {
        if arm.joints() != n {
            return Err(Error::Length {
                argument: "arms",
                expected: n,
                found: arm.joints(),
            });
        }
    }
    for collision in &controlled.collisions {
        check("collisions", &collision.torque, n)?;
    }
    let Some((_, first)) = arms.first() else {
        return Err(Error::Option("an arm is needed from the beginning"));
    };
    let model = Reference::<f64>::from_robot(&controlled.controller);
    let other = |_| Error::OtherModel;
    let mut random = Random::new(recording.seed);
    let mut log = Log::default();
    let [q, qd, _] = trajectory.at(0.0);
    let [mut q, mut qd] = [q, qd].map(DVector::from_vec);
    let omega = controlled.bandwidth;
    for k in 0..recording.states {
        let time = k as f64 * recording.period;
        let now = arms.iter().rev().find(|(from, _)| *from <= time);
        let arm = now.map_or(first, |(_, arm)| arm);
        let [wanted, rates, accelerations] = trajectory.at(time).map(DVector::from_vec);
        let corrected =
            accelerations + (rates - &qd) * (2.0 * omega) + (wanted - &q) * omega.powi(2);
        let tau = model.inverse_dynamics(&q, &qd, &corrected).map_err(other)?;
        let mut pushed = tau.clone();
        for collision in &controlled.collisions {
            pushed += DVector::from_column_slice(&collision.torque) * collision.part(time);
        }
        let qdd = arm.forward_dynamics(&q, &qd, &pushed).map_err(other)?;
        check("qdd", qdd.as_slice(), n)?;
        let tau = recording.noisy(tau.as_slice(), &mut random);
        let read = recording.read(q.as_slice());
        log.push(read, [&qd, &qdd].map(|x| x.as_slice().to_vec()), tau);
        qd += qdd * recording.period;
        q += &qd * recording.period;
    }
    Ok(log)
}

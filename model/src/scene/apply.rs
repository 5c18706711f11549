//! The robot that a scene makes of a robot, exactly.

use num_traits::Zero;

use super::Scene;
use crate::number::Rational;
use crate::placed::{Body, frame};
use crate::robot::{Inertia, Joint, Robot};

impl Scene {
    /// Returns the robot with the scene's gravity and payload, and with the box as
    /// its limits. Locks change no parameter: they fix positions.
    ///
    /// The scene must be valid for the robot ([`Scene::validate`]).
    pub fn apply(&self, robot: &Robot) -> Robot {
        let mut robot = robot.clone();
        if let Some(gravity) = &self.gravity {
            robot.gravity = gravity.clone();
        }
        let frame = robot.payload_frame.clone();
        if let (Some(payload), Some(last)) = (&self.payload, robot.last_row_mut()) {
            let own = Body {
                com: payload.com.clone(),
                inertia: payload.inertia.clone(),
            };
            let body = match &frame {
                None => own,
                Some(frame) => frame::moved(&own, &frame::pose(frame), &frame.size()),
            };
            carry(last, &payload.mass, &body);
        }
        for (i, joint) in robot.joints.iter_mut().enumerate() {
            let limits = &mut joint.limits;
            let bounds = &self.bounds;
            let position = bounds.position.as_ref().and_then(|all| all.get(i));
            let velocity = bounds.velocity.as_ref().and_then(|all| all.get(i));
            let acceleration = bounds.acceleration.as_ref().and_then(|all| all.get(i));
            limits.position = position.or(limits.position.as_ref()).cloned();
            limits.velocity = velocity.or(limits.velocity.as_ref()).cloned();
            limits.acceleration = acceleration.or(limits.acceleration.as_ref()).cloned();
        }
        robot
    }
}

/// Makes a link and what is fixed to it, in the same frame, one: with d between the centres of
/// mass and μ = m₁m₂/(m₁ + m₂), I = I₁ + I₂ + μ (d·d 1 − d dᵀ).
fn carry(link: &mut Joint, mass: &Rational, payload: &Body) {
    let total = &link.mass + mass;
    let share = if total.is_zero() {
        Rational::zero()
    } else {
        mass / &total
    };
    let reduced = &link.mass * &share;
    let d: [Rational; 3] = core::array::from_fn(|i| &payload.com[i] - &link.com[i]);
    let square: Rational = d.iter().map(|x| x * x).sum();
    let own = |i: usize| &reduced * (&square - &d[i] * &d[i]);
    let mixed = |i: usize, k: usize| -(&reduced * &d[i] * &d[k]);
    let (a, b) = (&link.inertia, &payload.inertia);
    link.inertia = Inertia {
        xx: &a.xx + &b.xx + own(0),
        yy: &a.yy + &b.yy + own(1),
        zz: &a.zz + &b.zz + own(2),
        xy: &a.xy + &b.xy + mixed(0, 1),
        yz: &a.yz + &b.yz + mixed(1, 2),
        xz: &a.xz + &b.xz + mixed(0, 2),
    };
    link.com = core::array::from_fn(|i| &link.com[i] + &share * &d[i]);
    link.mass = total;
}

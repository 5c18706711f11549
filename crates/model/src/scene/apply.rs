//! The robot that a scene makes of a robot, exactly.

use num_traits::Zero;

use super::{Payload, Scene};
use crate::number::Rational;
use crate::placed::frame;
use crate::robot::{FloatingBase, Inertia, Joint, Limit, Parent, Robot};

impl Scene {
    /// Returns the robot with the scene's gravity and payload, and with the box as
    /// its limits. Locks of joints change no parameter: they fix positions. A base that is locked is a
    /// fixed one, without the frames that are on it.
    ///
    /// The scene must be valid for the robot ([`Scene::validate`]).
    pub fn apply(&self, robot: &Robot) -> Robot {
        let mut robot = robot.clone();
        if let Some(gravity) = &self.gravity {
            robot.gravity = gravity.clone();
        }
        if let Some(payload) = self.carried(&robot) {
            let last = Parent::Row(robot.rows().len().saturating_sub(1));
            match (self.payload_link.unwrap_or(last), &mut robot.floating) {
                (Parent::Base, Some(base)) => {
                    let mut body = base.body();
                    carry(&mut body, &payload);
                    (base.mass, base.com, base.inertia) = (body.mass, body.com, body.inertia);
                }
                (Parent::Base, None) => {}
                (Parent::Row(row), _) => {
                    if let Some(link) = robot.row_mut(row) {
                        carry(link, &payload);
                    }
                }
            }
        }
        if self.lock_base && robot.floating.take().is_some() {
            robot.frames.retain(|frame| frame.row.is_some());
            // Its joints stay placed, as those of a tree, where one limb alone is left, too.
            if let Some(first) = robot.row_mut(0) {
                first.parent = Some(Parent::Base);
            }
        }
        let (base, bounds) = (robot.base_coordinates(), &self.bounds);
        robot.payload_range = bounds.payload.clone().or(robot.payload_range);
        if let Some(FloatingBase { limits, .. }) = &mut robot.floating {
            let six = |rate: Limit| bounds.rate(rate)?.first_chunk().cloned();
            limits.velocity = six(Limit::Velocity).or(limits.velocity.take());
            limits.acceleration = six(Limit::Acceleration).or(limits.acceleration.take());
        }
        for (i, Joint { limits, .. }) in robot.joints.iter_mut().enumerate() {
            let position = bounds.position.as_ref().and_then(|ranges| ranges.get(i));
            let bound = |rate: Limit| bounds.rate(rate)?.get(base + i).cloned();
            limits.position = position.cloned().or(limits.position.take());
            limits.velocity = bound(Limit::Velocity).or(limits.velocity.take());
            limits.acceleration = bound(Limit::Acceleration).or(limits.acceleration.take());
        }
        robot
    }

    /// Returns the payload in the last row's frame, to some twenty digits where its own is tilted.
    pub fn carried(&self, robot: &Robot) -> Option<Payload> {
        let payload = self.payload.as_ref()?;
        Some(match &robot.payload_frame {
            None => payload.clone(),
            Some(frame) => frame::moved(payload, &frame::pose(frame), &frame.size()),
        })
    }
}

/// With d between the centres of mass and μ = m₁m₂/(m₁ + m₂), I = I₁ + I₂ + μ (d·d 1 − d dᵀ).
fn carry(link: &mut Joint, payload: &Payload) {
    let total = &link.mass + &payload.mass;
    let share = match total.is_zero() {
        true => Rational::zero(),
        false => &payload.mass / &total,
    };
    let reduced = &link.mass * &share;
    let d: [Rational; 3] = core::array::from_fn(|i| &payload.com[i] - &link.com[i]);
    let square: Rational = d.iter().map(|x| x * x).sum();
    let (a, b) = (link.inertia.rows(), payload.inertia.rows());
    link.inertia = Inertia::symmetric(|i, k| {
        let product = &d[i] * &d[k];
        let moved = match i == k {
            true => &square - product,
            false => -product,
        };
        &a[i][k] + &b[i][k] + &reduced * moved
    });
    link.com = core::array::from_fn(|i| &link.com[i] + &share * &d[i]);
    link.mass = total;
}

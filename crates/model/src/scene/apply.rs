//! The robot that a scene makes of a robot, exactly.

use alloc::vec::Vec;

use num_traits::Zero;

use super::{Payload, Scene};
use crate::number::Rational;
use crate::placed::frame;
use crate::robot::{Inertia, Joint, Parent, Robot};

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
        let payload = self.carried(&robot);
        if let Some(payload) = payload {
            let last = robot.rows().len().saturating_sub(1);
            match (self.payload_link, &mut robot.floating) {
                (Some(Parent::Base), Some(base)) => {
                    let mut body = base.body();
                    carry(&mut body, &payload);
                    (base.mass, base.com, base.inertia) = (body.mass, body.com, body.inertia);
                }
                (Some(Parent::Base), None) => {}
                (Some(Parent::Row(row)), _) => robot.carry(row, &payload),
                (None, _) => robot.carry(last, &payload),
            }
        }
        if self.lock_base && robot.floating.take().is_some() {
            robot.frames.retain(|frame| frame.row.is_some());
            // Its joints stay placed, as those of a tree, where one limb alone is left, too.
            if let Some(first) = robot.row_mut(0) {
                first.parent = Some(Parent::Base);
            }
        }
        if let Some(range) = &self.bounds.payload {
            robot.payload_range = Some(range.clone());
        }
        let (base, bounds) = (robot.base_coordinates(), &self.bounds);
        if let Some(floating) = &mut robot.floating {
            let limits = &mut floating.limits;
            bound(&mut limits.velocity, &bounds.velocity, |velocities| {
                velocities.first_chunk()
            });
            bound(
                &mut limits.acceleration,
                &bounds.acceleration,
                |accelerations| accelerations.first_chunk(),
            );
        }
        for (i, joint) in robot.joints.iter_mut().enumerate() {
            let limits = &mut joint.limits;
            bound(&mut limits.position, &bounds.position, |positions| {
                positions.get(i)
            });
            bound(&mut limits.velocity, &bounds.velocity, |velocities| {
                velocities.get(base + i)
            });
            bound(
                &mut limits.acceleration,
                &bounds.acceleration,
                |accelerations| accelerations.get(base + i),
            );
        }
        robot
    }

    /// Returns the payload in the frame of the robot's last row: to some twenty digits, where the
    /// robot's frame of payloads is tilted.
    pub fn carried(&self, robot: &Robot) -> Option<Payload> {
        let payload = self.payload.as_ref()?;
        Some(match &robot.payload_frame {
            None => payload.clone(),
            Some(frame) => frame::moved(payload, &frame::pose(frame), &frame.size()),
        })
    }
}

impl Robot {
    fn carry(&mut self, row: usize, payload: &Payload) {
        if let Some(link) = self.row_mut(row) {
            carry(link, payload);
        }
    }
}

fn bound<T: Clone, A>(
    limit: &mut Option<T>,
    bounds: &Option<Vec<A>>,
    part: impl Fn(&[A]) -> Option<&T>,
) {
    if let Some(bound) = bounds.as_deref().and_then(part) {
        *limit = Some(bound.clone());
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

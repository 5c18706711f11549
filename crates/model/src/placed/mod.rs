//! Joints by placements: from frames in frames to the rows of a DH table.
//!
//! A data sheet or a URDF says where each link's frame is in the one before at q = 0, and about
//! which of its axes the joint moves. The equations want DH rows. [`derive()`] finds these, once,
//! when the robot is read: every formulation, proof and search sees the same rows either way.
//!
//! - this file: what is given, and the walk from the base to the hand
//! - `row`: one row, from an axis to the next
//! - [`frame`]: poses in wide floats: inverses, placements, bodies that move over
//!
//! The rows are of the standard convention. Frame i lies on the axis of joint i + 1, its x along
//! the common normal from the axis of joint i, as far as there is one; of the two directions that
//! it can have, it is the one in which θ_i is nearer to zero. Frame 0 is on the first axis, next to
//! the origin of the base; the last frame is at the origin of the last link's own frame. What is
//! left over at both ends are the robot's base, its tool and the frame of its payloads, so that
//! poses are those of the frames which were given, and loads of the hand are in the last link's.
//!
//! Everything is computed with 256 bits and then recovered ([`recover`](crate::number::recover)):
//! exact where the geometry is, rounded once where it is not.
//!
//! # Parallel axes
//!
//! Between *parallel* axes, sin α < 2⁻¹⁵⁰, there are many common normals: the one beside the link's
//! own origin is taken. Between *nearly* parallel ones, sin α below [`NEARLY_PARALLEL`], there is
//! one only, and it may be anywhere: with 1e-4 rad between axes 0.4 m apart, 4 km away, and lengths
//! of that size would take seven digits of every torque with them. There the frame stays where the
//! next axis passes the plane beside the link's own origin, and turns by an angle β about y after
//! the twist (Hayati's fifth parameter), [`Joint::beta`].
//!
//! [`Joint::beta`]: crate::robot::Joint::beta

pub mod frame;
mod row;

use alloc::vec::Vec;

use num_traits::{One, Signed, Zero};

use crate::equations::matrix::Columns;
use crate::number::recover::{near, recovered};
use crate::number::{Rational, Wide};
use crate::robot::{Joint, JointKind, Placed, Placement, Robot};
use crate::scalar::Scalar;

pub use frame::Body;
pub use row::NEARLY_PARALLEL;

/// A joint's axis has no direction; the joint is counted from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoDirection(pub usize);

/// Gives the joints of a robot whose links branch their places, each with an axis of length one: as
/// it is where that is a fraction, else within 3e-18. An axis without a direction, which is
/// an error of its own, is left alone.
pub fn place(robot: &mut Robot, placed: &[Placed]) {
    for (joint, placed) in robot.joints.iter_mut().zip(placed) {
        let axis = frame::unit_fraction(&placed.axis).unwrap_or_else(|| placed.axis.clone());
        let placement = placed.placement.clone();
        joint.place = Some(Placed { placement, axis });
    }
}

/// Gives a robot whose joints are placed its DH rows.
///
/// The robot's centres of mass and inertias are in the links' own frames, its tool and its frame of
/// payloads in the last link's; its rows are not read. All of them are replaced, and so is the
/// base. Where there are fewer placements than joints, or more, the rest is left alone.
///
/// # Errors
/// [`NoDirection`], and then the robot is unchanged.
pub fn derive(robot: &mut Robot, placed: &[Placed]) -> Result<(), NoDirection> {
    let steps = placed.iter().enumerate().map(|(joint, placed)| {
        let axis = frame::direction(&placed.axis).ok_or(NoDirection(joint))?;
        let link = frame::pose(&placed.placement);
        let along = link.rotate(&axis);
        Ok(row::JointAxis { along, link })
    });
    let axes = steps.collect::<Result<Vec<row::JointAxis>, NoDirection>>()?;
    let Some(first) = axes.first() else {
        return Ok(());
    };
    let size = size(robot, placed);

    let mut before = row::first_frame(first);
    let base = match &robot.base {
        None => before.clone(),
        Some(base) => frame::pose(base).then(&before),
    };
    robot.base = frame::placement(&base, &size).unless_identity();
    robot.convention = crate::robot::Convention::Standard;
    for (i, joint) in robot.joints.iter_mut().enumerate().take(axes.len()) {
        // The frame before, seen from the link's own at q = 0: its z is the axis.
        let here = frame::inverse(&axes[i].link).then(&before);
        let row = match axes.get(i + 1) {
            Some(next) => row::to_axis(&here, next, &size),
            None => row::to_link(&here),
        };
        (joint.theta, joint.alpha, joint.beta) = (row.theta, row.alpha, row.beta);
        [joint.d, joint.a] = [row.d, row.a].map(|length| recovered(&length, &size));
        let back = frame::inverse(&row.frame);
        let moved = frame::moved(&joint.body(), &back, &size);
        (joint.com, joint.inertia) = (moved.com, moved.inertia);
        // Moments are about the origin of the link's frame. Without one they are about that of the frame
        // before the joint, which is the same point if the row has no length along its axis.
        let frame = placed_in(&back, joint.frame.as_ref(), &size);
        joint.frame = match joint.d.is_zero() && joint.kind == JointKind::Revolute {
            true => frame.unless_identity(),
            false => Some(frame),
        };
        let fixed = robot.frames.iter_mut().filter(|frame| frame.row == Some(i));
        for frame in fixed {
            frame.placement = placed_in(&back, Some(&frame.placement), &size);
        }
        before = row.frame;
    }
    let last = frame::inverse(&before);
    for end in [&mut robot.tool, &mut robot.payload_frame] {
        *end = placed_in(&last, end.as_ref(), &size).unless_identity();
    }
    Ok(())
}

impl Joint {
    /// In the frame of the joint's row.
    fn body(&self) -> Body {
        Body {
            mass: self.mass.clone(),
            com: self.com.clone(),
            inertia: self.inertia.clone(),
        }
    }

    /// Returns the link's body in the link's own frame.
    pub fn own_body(&self) -> Body {
        let body = self.body();
        let Some(placement) = &self.frame else {
            return body;
        };
        let back = frame::inverse(&frame::pose(placement));
        frame::moved(&body, &back, &placement.size())
    }

    /// Replaces the link's body by one in the link's own frame.
    pub fn set_own_body(&mut self, body: Body) {
        let body = match &self.frame {
            None => body,
            Some(placement) => frame::moved(&body, &frame::pose(placement), &placement.size()),
        };
        (self.mass, self.com, self.inertia) = (body.mass, body.com, body.inertia);
    }
}

/// Returns the placement of a frame in another one, in which its reference frame has this pose;
/// without a placement it is the reference frame itself.
fn placed_in(back: &Columns<Wide>, placement: Option<&Placement>, size: &Rational) -> Placement {
    let pose = match placement {
        None => back.clone(),
        Some(placement) => back.then(&frame::pose(placement)),
    };
    frame::placement(&pose, size)
}

/// The length that others are small against: the arm stretched out, or a metre if it has none.
fn size(robot: &Robot, placed: &[Placed]) -> Rational {
    let ends = robot.placements().into_iter().filter_map(|(_, end)| end);
    let frames = robot.frames.iter().map(|frame| &frame.placement);
    let joints = placed.iter().map(|placed| &placed.placement);
    let total: Rational = joints.chain(ends).chain(frames).map(Placement::size).sum();
    if total.is_zero() { One::one() } else { total }
}

fn is_nothing(value: &Wide, size: &Rational) -> bool {
    value.to_rational().abs() <= size * near()
}

fn along(a: &[Wide; 3], s: &Wide, b: &[Wide; 3]) -> [Wide; 3] {
    core::array::from_fn(|i| a[i].add(&s.mul(&b[i])))
}

//! From a robot with exact parameters to an arm in any scalar.

use super::following::Following;
use super::frames::{Frames, NamedFrame};
use super::friction::{Coulomb, Friction};
use super::matrix::Columns;
use super::{Arm, Link, SinCosPair};
use crate::number::{Angle, Exact, Rational};
use crate::robot::{Placement, Position, Robot};
use crate::scalar::Scalar;

impl<S> Arm<S> {
    /// Returns the arm of a robot, each exact parameter sent through `scalar`:
    /// rounding for floats, a constant for symbols, a residue for fields.
    pub fn from_robot(robot: &Robot, scalar: &mut dyn FnMut(&Exact) -> S) -> Arm<S> {
        let base = robot.base.as_ref().map(exact_pose);
        let tool = robot.tool.as_ref().map(exact_pose);
        // The robot has gravity in base axes, the equations in those of frame 0.
        let gravity = robot.gravity.each_ref().map(|g| Exact::from(g.clone()));
        let gravity = match &base {
            None => gravity,
            Some(base) => base.rotate_back(&gravity),
        };
        let gravity = gravity.each_ref().map(&mut *scalar);
        let [base, tool] = [base, tool].map(|pose| pose.map(|pose| pose.map(&mut *scalar)));
        let (following, rows) = (Following::of(robot, scalar), robot.rows());
        let links = rows.iter().enumerate().map(|(row, joint)| {
            let mut followers = robot.followers.iter();
            let offset = followers.find(|follower| follower.row == row);
            let (turn, shift) = match offset.map(|follower| &follower.offset) {
                Some(Position::Angle(turn)) => (Some(turn), None),
                Some(Position::Length(shift)) => (None, Some(shift)),
                None => (None, None),
            };
            let mut pair = |angle: &Angle, more: Option<&Angle>| {
                let pair = Exact::sincos(angle);
                let pair = more.map_or(pair.clone(), |more| pair.compose(&Exact::sincos(more)));
                SinCosPair {
                    sin: scalar(&pair.sin),
                    cos: scalar(&pair.cos),
                }
            };
            let (alpha, theta) = (pair(&joint.alpha, None), pair(&joint.theta, turn));
            let beta = (!joint.beta.is_zero()).then(|| pair(&joint.beta, None));
            let mut number = |value: &Rational| scalar(&Exact::from(value.clone()));
            Link {
                kind: joint.kind,
                alpha,
                beta,
                theta,
                a: number(&joint.a),
                d: number(&shift.map_or(joint.d.clone(), |shift| &joint.d + shift)),
                mass: number(&joint.mass),
                com: [0, 1, 2].map(|axis| number(&joint.com[axis])),
                inertia: joint.inertia.map(&mut number),
                friction: Friction {
                    viscous: number(&joint.viscous),
                    coulomb: joint.has_coulomb().then(|| Coulomb {
                        force: number(&joint.coulomb),
                        width: number(&joint.coulomb_width),
                        per_speed: number(&joint.coulomb_width.recip()),
                    }),
                },
                armature: number(&joint.armature),
            }
        });
        let links = links.collect();
        let mut posed = |placement: &Placement| exact_pose(placement).map(&mut *scalar);
        let own = rows.iter();
        let own = own.map(|joint| joint.frame.as_ref().map(&mut posed));
        let own = own.collect();
        let named = robot.frames.iter().map(|frame| NamedFrame {
            name: frame.name.clone(),
            joint: frame.joint,
            pose: posed(&frame.placement),
        });
        Arm {
            convention: robot.convention,
            gravity,
            base,
            tool,
            links,
            following,
            frames: Frames {
                named: named.collect(),
                links: own,
                ..Frames::default()
            },
        }
    }
}

/// Returns [R | p] of a placement, exactly.
pub fn exact_pose(placement: &Placement) -> Columns<Exact> {
    pose_of(placement, Exact::sincos, |x| Exact::from(x.clone()))
}

/// Returns [R | p] of a placement, R = Rz(yaw) Ry(pitch) Rx(roll), from what its angles
/// and lengths are in a scalar.
pub fn pose_of<S: Scalar>(
    placement: &Placement,
    pair: impl Fn(&Angle) -> SinCosPair<S>,
    length: impl Fn(&Rational) -> S,
) -> Columns<S> {
    let [roll, pitch, yaw] = placement.rpy.each_ref().map(pair);
    let turned = Columns::identity()
        .turn_z(&yaw)
        .turn_y(&pitch)
        .turn_x(&roll);
    Columns {
        origin: placement.xyz.each_ref().map(length),
        ..turned
    }
}

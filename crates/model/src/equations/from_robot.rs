//! From a robot with exact parameters to an arm in any scalar, and what its base cannot feel.

use super::following::Following;
use super::frames::{Frames, NamedFrame};
use super::friction::{Coulomb, Friction};
use super::matrix::Columns;
use super::{Arm, Link, SinCosPair};
use crate::number::{Angle, Exact, Rational};
use crate::robot::{Convention, JointKind, Placement, Position, Robot};
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
                pair.map(&mut *scalar)
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
        let own = rows.iter().map(|joint| joint.frame.as_ref());
        let own = own.map(|frame| frame.map(&mut posed)).collect();
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

impl<S: Scalar + PartialEq> Arm<S> {
    /// Returns the same dynamics without the lengths that have no effect on it.
    ///
    /// While the links only slide, nothing turns: where the later links are cannot matter. While
    /// they turn about parallel axes alone, a shift of all that follows *along* these axes changes
    /// no velocity, no moment about an axis, and the potential energy by a constant. So these are
    /// set to zero:
    ///
    /// - a_i and d_i of the leading prismatic joints;
    /// - d_i of the first revolute joint (modified DH: a_i too, both act before
    ///   anything turns), and of the joints after it as long as their axes are
    ///   parallel, sin α = 0.
    ///
    /// In exact arithmetic no output changes. In floating point a base that
    /// stands 1e6 m away would take every digit of an f32 torque with it: the
    /// length cancels only after it has been multiplied and rounded.
    pub fn fold_base(mut self) -> Self {
        let is_modified = self.convention == Convention::Modified;
        let mut turned = false;
        for link in &mut self.links {
            // Modified DH: the twist comes before the joint.
            let parallel = link.alpha.sin == S::zero() && link.beta.is_none();
            if is_modified && turned && !parallel {
                break;
            }
            link.d = S::zero();
            let turns = turned || link.kind == JointKind::Revolute;
            let own_length_turns = if is_modified { turned } else { turns };
            if !own_length_turns {
                link.a = S::zero();
            }
            turned = turns;
            // Standard DH: the twist comes after it, and turns the next axis.
            if !is_modified && turned && !parallel {
                break;
            }
        }
        self
    }
}

/// Returns [R | p] of a placement, exactly.
pub fn exact_pose(placement: &Placement) -> Columns<Exact> {
    pose_of(placement, Exact::sincos, |x| Exact::from(x.clone()))
}

/// Returns [R | p] of a placement, R = Rz(yaw) Ry(pitch) Rx(roll), in a scalar.
pub fn pose_of<S: Scalar>(
    placement: &Placement,
    pair: impl Fn(&Angle) -> SinCosPair<S>,
    length: impl Fn(&Rational) -> S,
) -> Columns<S> {
    let [roll, pitch, yaw] = placement.rpy.each_ref().map(pair);
    let turned = Columns::identity().turn_z(&yaw).turn_y(&pitch);
    let turned = turned.turn_x(&roll);
    Columns {
        origin: placement.xyz.each_ref().map(length),
        ..turned
    }
}

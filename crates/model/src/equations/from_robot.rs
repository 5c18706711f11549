//! From a robot with exact parameters to an arm in any scalar, and what its base cannot feel.

use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::following::FollowerLine;
use super::frames::{Frames, NamedFrame};
use super::friction::{Coulomb, Friction};
use super::matrix::*;
use super::{Arm, Link, SinCosPair};
use crate::number::{Angle, Exact, Rational};
use crate::robot::{
    Convention, FloatingBase, Joint, JointKind, Parent, Placement, Position, Robot,
};
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
        let (following, rows) = (FollowerLine::of(robot, scalar), robot.rows());
        let places = places(&rows);
        let first = robot.base_coordinates();
        let body = robot.floating.iter().map(FloatingBase::body);
        let base_links = body.flat_map(|body| Link::of_base(exact_link(&body, None, None)));
        let joints = rows.iter().enumerate().map(|(row, joint)| {
            let mut followers = robot.followers.iter();
            let follower = followers.find(|follower| follower.row == row);
            let offset = follower.map(|follower| &follower.offset);
            let link = exact_link(joint, offset, places[row].as_ref());
            let parent = match (joint.parent, first) {
                (Some(Parent::Base), 1..) => Some(Parent::Row(first - 1)),
                (Some(Parent::Row(carrier)), _) => Some(Parent::Row(first + carrier)),
                (parent, _) => parent,
            };
            Link { parent, ..link }
        });
        let exact_links = base_links.chain(joints);
        let links = exact_links.map(|link| link.map(&mut *scalar)).collect();
        let in_row = |row: usize, placement: Option<&Placement>| {
            let link = places[row].as_ref().map(|place| place.link.clone());
            match (link, placement.map(exact_pose)) {
                (Some(link), Some(pose)) => Some(link.then(&pose)),
                (link, pose) => link.or(pose),
            }
        };
        let numbered = rows.iter().enumerate();
        let of_rows = numbered.map(|(row, joint)| in_row(row, joint.frame.as_ref()));
        let exact_frames = core::iter::repeat_n(None, first).chain(of_rows);
        let link_frames = exact_frames
            .map(|pose| Some(pose?.map(&mut *scalar)))
            .collect();
        let named = robot.frames.iter().map(|frame| {
            let pose = match frame.row {
                Some(row) => in_row(row, Some(&frame.placement)),
                None => Some(exact_pose(&frame.placement)),
            };
            NamedFrame {
                name: frame.name.clone(),
                joint: frame.row.map_or(first.saturating_sub(1), |row| first + row),
                pose: pose.unwrap_or_else(Columns::identity).map(&mut *scalar),
            }
        });
        let convention = match robot.is_tree() {
            true => Convention::Modified,
            false => robot.convention,
        };
        Arm {
            convention,
            gravity,
            base,
            tool,
            floats: robot.floating.is_some(),
            links,
            following,
            frames: Frames {
                named: named.collect(),
                links: link_frames,
                ..Frames::default()
            },
        }
    }
}

fn exact_link(joint: &Joint, offset: Option<&Position>, place: Option<&Place>) -> Link<Exact> {
    let exact = |value: &Rational| Exact::from(value.clone());
    let (turn, shift) = match offset {
        Some(Position::Angle(turn)) => (Exact::sincos(turn), Exact::zero()),
        Some(Position::Length(shift)) => (SinCosPair::straight(), exact(shift)),
        None => (SinCosPair::straight(), Exact::zero()),
    };
    let com = joint.com.each_ref().map(exact);
    let inertia = joint.inertia.map(exact);
    let (com, inertia, theta, d) = match place {
        None => (com, inertia, Exact::sincos(&joint.theta), exact(&joint.d)),
        Some(Place { link, theta, d, .. }) => {
            let (com, inertia) = (link.rotate(&com), link.turn_tensor(&inertia));
            (com, inertia, theta.clone(), d.clone())
        }
    };
    Link {
        parent: joint.parent,
        kind: joint.kind,
        place: place.map(|place| place.before.clone()),
        alpha: Exact::sincos(&joint.alpha),
        beta: (!joint.beta.is_zero()).then(|| Exact::sincos(&joint.beta)),
        theta: theta.compose(&turn),
        a: exact(&joint.a),
        d: d.add(&shift),
        mass: exact(&joint.mass),
        com,
        inertia,
        friction: Friction {
            viscous: exact(&joint.viscous),
            coulomb: joint.has_coulomb().then(|| Coulomb {
                force: exact(&joint.coulomb),
                width: exact(&joint.coulomb_width),
                per_speed: exact(&joint.coulomb_width.recip()),
            }),
        },
        armature: exact(&joint.armature),
    }
}

/// A joint that is placed, as a row of modified DH with a pose instead of α and a: its z is the
/// joint's axis. A step along the axis and a turn about it, which commute with the joint, are the
/// row's d and θ.
struct Place {
    before: Columns<Exact>,
    theta: SinCosPair<Exact>,
    d: Exact,
    /// The link's frame in that of the row: a turn.
    link: Columns<Exact>,
}

fn places(rows: &[&Joint]) -> Vec<Option<Place>> {
    let mut turns: Vec<Columns<Exact>> = Vec::with_capacity(rows.len());
    let places = rows.iter().enumerate().map(|(row, joint)| {
        let placed = joint.place.as_ref();
        // The link's axes, as rows' frames see them.
        let turn = placed.map_or_else(Columns::identity, |placed| link_in_row(&placed.axis));
        turns.push(turn.clone());
        let before = exact_pose(&placed?.placement).then(&inverse(&turn));
        let before = match joint.carrier(row) {
            None => before,
            Some(carrier) => turns[carrier].then(&before),
        };
        Some(Place::new(before, turn))
    });
    places.collect()
}

impl Place {
    fn new(before: Columns<Exact>, link: Columns<Exact>) -> Place {
        let d = dot(&before.origin, &before.axes[2]);
        let origin = difference(&before.origin, &scaled(&d, &before.axes[2]));
        let axes = turned_least(&before.axes[2]).unwrap_or_else(|| before.axes.clone());
        let [cos, sin] = [0, 1].map(|axis| dot(&axes[axis], &before.axes[0]));
        let theta = SinCosPair { sin, cos };
        Place {
            before: Columns { axes, origin },
            theta,
            d,
            link,
        }
    }
}

/// Returns the axes of a frame of this z that has turned about x or y, or about z and then by a right
/// angle; none if z is not across one of them.
fn turned_least(z: &Vector<Exact>) -> Option<[Vector<Exact>; 3]> {
    let [x, y, z_0] = identity::<Exact>();
    let [across, level] = match z.each_ref().map(Exact::is_zero) {
        [true, _, _] => [x.clone(), cross(z, &x)],
        [_, true, _] => [cross(&y, z), y],
        [_, _, true] => [cross(z, &z_0).map(|x| x.neg()), z_0],
        _ => return None,
    };
    Some([across, level, z.clone()])
}

/// Returns the turn by the least angle that takes z to an axis of length one, seen from there: 1 + V +
/// V² / (1 + z·e), V = [z × e]×.
fn link_in_row(axis: &[Rational; 3]) -> Columns<Exact> {
    let [x, y, z] = axis;
    let zero = Rational::zero;
    let rows = if *z == -Rational::one() {
        // Half a turn about x.
        [
            [Rational::one(), zero(), zero()],
            [zero(), -Rational::one(), zero()],
            [zero(), zero(), -Rational::one()],
        ]
    } else {
        let per = (Rational::one() + z).recip();
        let mixed = -(x * y * &per);
        [
            [Rational::one() - x * x * &per, mixed.clone(), x.clone()],
            [mixed, Rational::one() - y * y * &per, y.clone()],
            [-x, -y, z.clone()],
        ]
    };
    // The rows of the turn are the columns of its inverse.
    Columns::turned(rows.map(|row| row.map(Exact::from)))
}

fn inverse(turn: &Columns<Exact>) -> Columns<Exact> {
    Columns::turned(transposed(&turn.axes))
}

impl<S: Scalar + PartialEq> Arm<S> {
    /// Drops the lengths that have no effect on the dynamics.
    ///
    /// While the links only slide, nothing turns: where the later links are cannot matter. While
    /// they turn about parallel axes alone, a shift of all that follows *along* these axes changes
    /// no velocity, no moment about an axis, and the potential energy by a constant. So these are
    /// set to zero:
    ///
    /// - a_i and d_i of the leading prismatic joints;
    /// - d_i of the first revolute joint (modified DH: a_i too, both act before anything turns), and
    ///   of the joints after it as long as their axes are parallel, sin α = 0.
    ///
    /// In exact arithmetic no output changes. In floating point a base that stands 1e6 m away would
    /// take every digit of an f32 torque: the length cancels only after it has been rounded.
    pub fn fold_base(mut self) -> Self {
        if self.links.iter().any(|link| link.place.is_some()) {
            self.fold_places();
            return self;
        }
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

impl<S: Scalar> Arm<S> {
    /// As [`Arm::fold_base`], along each branch.
    fn fold_places(&mut self) {
        // Before a link moves: whether all before it slide, or turn about parallel axes.
        let mut ways: Vec<Option<bool>> = Vec::with_capacity(self.links.len());
        for i in 0..self.links.len() {
            let turned = self.carrier(i).map_or(Some(false), |carrier| ways[carrier]);
            let link = &mut self.links[i];
            let is_parallel = |place: &Columns<S>| place.axes[2][..2].iter().all(S::is_zero);
            let goes_on = match (turned, &mut link.place) {
                (Some(false), Some(place)) => {
                    place.origin = zero_vector();
                    true
                }
                (Some(true), Some(place)) if is_parallel(place) => {
                    place.origin[2] = S::zero();
                    true
                }
                _ => false,
            };
            if goes_on {
                link.d = S::zero();
            }
            let turns = turned == Some(true) || link.kind == JointKind::Revolute;
            ways.push(goes_on.then_some(turns));
        }
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
    let mut pose = turned.turn_x(&roll);
    pose.origin = placement.xyz.each_ref().map(length);
    pose
}

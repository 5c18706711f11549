//! A base that floats: its coordinates come before those of the joints, linear over angular in its
//! own axes, of velocities, accelerations and loads alike.

use alloc::vec::Vec;

use super::composite::{Composite, JointEffect};
use super::derivatives::{Flow, Slopes, inertial};
use super::recursion::LinkMotion;
use super::{Chain, MomentBody};
use crate::equations::BASE_COORDINATES;
use crate::equations::matrix::*;
use crate::equations::screws::{Twist, Wrench};
use crate::robot::JointKind::{Prismatic, Revolute};
use crate::scalar::{Divide, Scalar};

impl<S> Chain<S> {
    /// Returns how many coordinates are those of a base that floats: six, or none.
    pub fn base_coordinates(&self) -> usize {
        self.base.as_ref().map_or(0, |_| BASE_COORDINATES)
    }

    /// Returns the number of coordinates of a velocity.
    pub fn coordinates(&self) -> usize {
        self.base_coordinates() + self.links.len()
    }

    /// Returns the entries of the joints among those of all coordinates.
    pub fn of_joints<'v, T>(&self, values: &'v [T]) -> &'v [T] {
        &values[self.base_coordinates()..]
    }
}

/// Returns the linear, then the angular units.
pub(super) fn unit_twists<S: Scalar>() -> [Twist<S>; BASE_COORDINATES] {
    core::array::from_fn(|k| {
        let unit = three(|i| if i == k % 3 { S::one() } else { S::zero() });
        let kind = if k < 3 { Prismatic } else { Revolute };
        Twist::of_joint(kind, unit)
    })
}

impl<S: Scalar> Chain<S> {
    /// Returns the twist of the base, at rest if it is fixed.
    pub(super) fn base_twist(&self, qd: &[S]) -> Twist<S> {
        if self.base.is_none() {
            return Twist::rest();
        }
        let [linear, turn] = parts(qd);
        let shift = scaled(&self.per_unit, &linear);
        Twist { turn, shift }
    }

    /// Returns the twist of a base that turns as this one does, and stays where it is.
    pub(super) fn base_turning(&self, qd: &[S]) -> Twist<S> {
        Twist {
            shift: zero_vector(),
            ..self.base_twist(qd)
        }
    }

    /// Returns the motion of the base, which rises instead of being pulled down. The velocity of
    /// its origin turns with its axes: the acceleration is v̇ + ω × v.
    pub(super) fn base_motion(&self, [qd, qdd]: [&[S]; 2], gravity: &Vector<S>) -> LinkMotion<S> {
        if self.base.is_none() {
            return LinkMotion::base([zero_vector(), zero_vector()], opposite(gravity));
        }
        let ([v, omega], [v_dot, omega_dot]) = (parts(qd), parts(qdd));
        let acceleration = scaled(&self.per_unit, &sum(&v_dot, &cross(&omega, &v)));
        let rising = difference(&acceleration, gravity);
        LinkMotion::base([omega, omega_dot], rising)
    }

    /// Returns a load of a coordinate, or a slope by it, in metres.
    pub(super) fn coordinate_in_metres(&self, coordinate: usize, value: S) -> S {
        match coordinate.checked_sub(self.base_coordinates()) {
            Some(joint) => self.rescaled(joint, value),
            None if coordinate < 3 => times(&self.per_unit, &value),
            None => value,
        }
    }

    /// Returns a wrench on the base in metres.
    pub(super) fn on_base(&self, wrench: &Wrench<S>) -> [S; BASE_COORDINATES] {
        let [x, y, z] = scaled(&self.per_unit, &wrench.force);
        let [a, b, c] = wrench.moment.clone();
        [x, y, z, a, b, c]
    }

    /// Returns the loads of all coordinates: what arrives at a base that floats with what its own
    /// body takes, then those of the joints.
    pub(super) fn with_base(
        &self,
        (joints, arrived): (Vec<S>, Wrench<S>),
        base_wrench: impl FnOnce(&MomentBody<S>) -> Wrench<S>,
    ) -> Vec<S> {
        let Some(body) = &self.base else {
            return joints;
        };
        let base = self.on_base(&arrived.with(&base_wrench(body)));
        base.into_iter().chain(joints).collect()
    }

    /// Returns the loads of its weight on a base that floats with all that it carries.
    pub(super) fn weight(&self, body: &MomentBody<S>) -> [S; BASE_COORDINATES] {
        let force = opposite(&scaled(&body.mass, &self.gravity));
        let moment = opposite(&cross(&body.first, &self.gravity));
        self.on_base(&Wrench { force, moment })
    }
}

impl<S: Divide> Chain<S> {
    /// Returns accelerations of a base that floats which shorten the recursion, and the motion that
    /// they give: it falls freely, and ω̇ makes U_12, U_23 and U_31 vanish.
    pub(super) fn falling(&self, qd: &[S]) -> ([S; BASE_COORDINATES], LinkMotion<S>) {
        let [v, omega] = parts(qd);
        let [x, y, z] = &omega;
        let omega_dot = [times(y, z), times(x, z), times(x, y)];
        let fall = self.gravity.each_ref().map(|g| g.div(&self.per_unit));
        let [a, b, c] = difference(&fall, &cross(&omega, &v));
        let [d, e, f] = omega_dot.clone();
        let motion = LinkMotion::base([omega, omega_dot], zero_vector());
        ([a, b, c, d, e, f], motion)
    }
}

impl<S: Scalar> Composite<'_, S> {
    /// Returns a matrix over all coordinates, from that of the joints: `felt` has the wrenches on the
    /// base by each joint, and by unit twists of the base `base` returns that on itself, `to_joint`
    /// the load of a joint.
    fn bordered(
        &self,
        base: impl Fn(&Twist<S>) -> Wrench<S>,
        felt: &[Wrench<S>],
        to_joint: impl Fn(usize, usize, &Twist<S>) -> S,
        joints: Matrix<S>,
    ) -> Matrix<S> {
        let chain = self.chain;
        let n = felt.len();
        let units = unit_twists();
        let in_metres = |k: usize, value: S| chain.coordinate_in_metres(k, value);
        let base_row = |k: usize| chain.on_base(&base(&units[k])).map(|x| in_metres(k, x));
        let base_rows: Vec<[S; 6]> = (0..BASE_COORDINATES).map(base_row).collect();
        let arrived_row = |k: usize| chain.on_base(&felt[k]).map(|x| chain.rescaled(k, x));
        let arrived: Vec<[S; 6]> = (0..n).map(arrived_row).collect();
        let corner = matrix(BASE_COORDINATES, BASE_COORDINATES, |i, k| {
            base_rows[k][i].clone()
        });
        let rows = matrix(BASE_COORDINATES, n, |i, k| arrived[k][i].clone());
        let columns = matrix(n, BASE_COORDINATES, |i, k| {
            let load = chain.rescaled(i, to_joint(i, k, &units[k]));
            in_metres(k, load)
        });
        let above = corner.into_iter().zip(rows);
        let halves = above.chain(columns.into_iter().zip(joints));
        halves.map(|(left, right)| [left, right].concat()).collect()
    }

    /// Returns D of all coordinates, from that of the joints.
    pub(super) fn bordered_inertia(&self, body: &MomentBody<S>, joints: Matrix<S>) -> Matrix<S> {
        let pushes: Vec<Wrench<S>> = (0..joints.len()).map(|k| self.push_on_base(k)).collect();
        let base = |unit: &Twist<S>| inertial(body, unit);
        let along = |i: usize, k: usize, _: &Twist<S>| {
            let Wrench { force, moment } = &pushes[i];
            [force, moment][k / 3][k % 3].clone()
        };
        self.bordered(base, &pushes, along, joints)
    }

    /// Returns the wrench of a unit acceleration of joint k about the base's origin.
    pub(super) fn push_on_base(&self, k: usize) -> Wrench<S> {
        let before = |push: Wrench<S>, i: usize| self.chain.to_previous(i, self.at, &push);
        self.chain.way(k).fold(self.momentum(k), before)
    }

    /// Returns slopes of all coordinates, from those of the joints. With a = v̇ + ω × v − g nothing else
    /// depends on v or g: of a unit twist (e, t) of the base a has the slopes ω × t + e × v by
    /// velocity, and e × g as the base turns.
    pub(super) fn bordered_slopes(
        &self,
        (body, flow): (&MomentBody<S>, &Flow<S>),
        qd: &[S],
        later: Vec<JointEffect<S, 3, 1>>,
        joints: Slopes<S>,
    ) -> Slopes<S> {
        let later = self.all_seen_from_base(later);
        let (chain, flow) = (self.chain, self.with_flow_of_base(flow, qd));
        let Twist { turn, shift } = chain.base_twist(qd);
        let changed = |unit: &Twist<S>| Twist {
            turn: cross(&turn, &unit.turn),
            shift: sum(&cross(&turn, &unit.shift), &cross(&unit.turn, &shift)),
        };
        let lifted =
            |unit: &Twist<S>| Twist::of_joint(Prismatic, cross(&unit.turn, &chain.gravity));
        let felt = |of: usize| -> Vec<Wrench<S>> {
            let effects = later.iter();
            effects.map(|effect| effect.wrenches[of].clone()).collect()
        };
        let position = self.bordered(
            |unit| inertial(body, &lifted(unit)),
            &felt(0),
            |i, _, unit| later[i].wrenches[2].along(&lifted(unit)),
            joints.position,
        );
        let velocity = self.bordered(
            |unit| (flow.of_turn(&unit.turn)).with(&inertial(body, &changed(unit))),
            &felt(1),
            |i, _, unit| {
                let ([_, _, push], [swing]) = (&later[i].wrenches, &later[i].vectors);
                plus(&dot(swing, &unit.turn), &push.along(&changed(unit)))
            },
            joints.velocity,
        );
        Slopes { position, velocity }
    }

    /// Returns C of all coordinates, from that of the joints and from what each does to its composite:
    /// a unit twist of the base turns with its axes.
    pub(super) fn bordered_coriolis(
        &self,
        (body, flow): (&MomentBody<S>, &Flow<S>),
        qd: &[S],
        later: Vec<JointEffect<S, 2, 1>>,
        joints: Matrix<S>,
    ) -> Matrix<S> {
        let later = self.all_seen_from_base(later);
        let flow = self.with_flow_of_base(flow, qd);
        let velocity = self.chain.base_turning(qd);
        let base = |unit: &Twist<S>| {
            let felt = flow.half_of_turn(&unit.turn);
            felt.with(&inertial(body, &velocity.cross(unit)))
        };
        let effects = later.iter();
        let felt: Vec<_> = effects.map(|effect| effect.wrenches[0].clone()).collect();
        let along = |i: usize, _: usize, unit: &Twist<S>| {
            let ([_, push], [swing]) = (&later[i].wrenches, &later[i].vectors);
            plus(&dot(swing, &unit.turn), &push.along(&velocity.cross(unit)))
        };
        self.bordered(base, &felt, along, joints)
    }

    fn all_seen_from_base<const WRENCHES: usize, const VECTORS: usize>(
        &self,
        later: Vec<JointEffect<S, WRENCHES, VECTORS>>,
    ) -> Vec<JointEffect<S, WRENCHES, VECTORS>> {
        let seen_from_base = |(k, effect): (usize, JointEffect<S, WRENCHES, VECTORS>)| {
            let way = self.chain.way(k);
            way.fold(effect, |effect, i| effect.carried(self, i))
        };
        later.into_iter().enumerate().map(seen_from_base).collect()
    }

    fn with_flow_of_base(&self, flow: &Flow<S>, qd: &[S]) -> Flow<S> {
        match &self.chain.base {
            None => flow.clone(),
            Some(body) => flow.with(&Flow::of(body, &self.chain.base_turning(qd))),
        }
    }
}

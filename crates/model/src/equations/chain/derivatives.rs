//! ∂τ/∂q and ∂τ/∂q̇ from composite bodies: each entry is the power of a wrench on a twist. C is
//! half of the slopes of h by velocities.

use alloc::vec::Vec;

use super::composite::{Composite, CompositeOrder, JointEffect};
use super::recursion::{AccelerationForm, LinkMotion, MomentForm};
use super::{ChainLink, Displacement, MomentBody, Rotation};
use crate::equations::matrix::*;
use crate::equations::screws::{Twist, Wrench};
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// The slopes of the torques: row i has those of τ_i.
#[derive(Clone, Debug)]
pub struct Slopes<S> {
    /// ∂τ/∂q
    pub position: Matrix<S>,
    /// ∂τ/∂q̇
    pub velocity: Matrix<S>,
}

/// ∫ V dm and ∫ V rᵀ dm, row by row, of bodies in motion, V the velocity of the point r.
#[derive(Clone, Debug)]
pub(super) struct Flow<S> {
    momentum: Vector<S>,
    moment: Rotation<S>,
}

pub(super) struct JointSlopes<S> {
    /// The first and second rate of the joint's twist.
    pub(super) drift: [Twist<S>; 2],
    pub(super) push: Wrench<S>,
    /// The part of the composite's rate along the joint for each turn of all that it is part of.
    swing: Vector<S>,
    /// ∂τ_i/∂q_i, and the wrench that the joints before feel.
    pub(super) position: (S, Wrench<S>),
    /// ∂τ_i/∂q̇_i, and the wrench that the joints before feel.
    pub(super) velocity: (S, Wrench<S>),
    pub(super) flow: Flow<S>,
}

impl<S: Scalar> Composite<'_, S> {
    /// Returns ∂τ/∂q and ∂τ/∂q̇ of all coordinates. For a base that floats the first is as it moves in
    /// its axes, velocities kept.
    pub fn slopes(&self, qd: &[S], qdd: &[S], travel: CompositeOrder) -> Slopes<S> {
        let (joints, flow) = self.joint_slopes(qd, qdd);
        let n = joints.len();
        let [position, velocity] = [zero_matrix(n), zero_matrix(n)];
        let mut slopes = Slopes { position, velocity };
        let twists = joints.iter().enumerate().map(|(i, joint)| {
            let [first, second] = joint.drift.clone();
            [self.twist(i, i), first, second]
        });
        let acting = joints.iter().map(|joint| JointEffect {
            wrenches: [&joint.position.1, &joint.velocity.1, &joint.push].map(Wrench::clone),
            vectors: [joint.swing.clone()],
        });
        let (earlier, later) = (twists.collect::<Vec<_>>(), acting.collect::<Vec<_>>());
        let of_base = self.base.as_ref().map(|body| (body, later.clone()));
        self.each_pair(travel, &earlier, later, |[j, i], twists, effect| {
            if j == i {
                slopes.position[i][i] = joints[i].position.0.clone();
                slopes.velocity[i][i] = joints[i].velocity.0.clone();
                return;
            }
            let [twist, first, second] = twists;
            let ([position, velocity, push], [swing]) = (&effect.wrenches, &effect.vectors);
            slopes.position[j][i] = position.along(twist);
            slopes.velocity[j][i] = velocity.along(twist);
            slopes.position[i][j] = plus(&dot(swing, &first.turn), &push.along(second));
            slopes.velocity[i][j] = plus(&dot(swing, &twist.turn), &twice(&push.along(first)));
        });
        for matrix in [&mut slopes.position, &mut slopes.velocity] {
            self.matrix_in_metres(matrix);
        }
        for (i, link) in self.chain.links.iter().enumerate() {
            slopes.velocity[i][i] = plus(&slopes.velocity[i][i], &link.friction.slope());
        }
        match of_base {
            None => slopes,
            Some((body, later)) => self.bordered_slopes((body, &flow), qd, later, slopes),
        }
    }

    /// Returns each joint's contribution, and the flow of all bodies at the base. That a base moves
    /// along has no effect but on its acceleration: velocities are those of one that only turns.
    pub(super) fn joint_slopes(&self, qd: &[S], qdd: &[S]) -> (Vec<JointSlopes<S>>, Flow<S>) {
        let chain = self.chain;
        let velocities = chain.velocities(self.at, chain.base_turning(qd), qd);
        let moving = chain.motions(self.at, qd, qdd, AccelerationForm::Column);
        let whole = |i: usize, outer: Option<(Flow<S>, Wrench<S>)>| {
            let (flow, load) = outer.unwrap_or_else(|| (Flow::nothing(), Wrench::zero()));
            let (velocity, motion, body) = (&velocities[i], &moving.links[i], &self.bodies[i]);
            let link = &chain.links[i];
            let flow = flow.with(&Flow::of(&link.body, velocity));
            let load = load.with(&motion.wrench(&link.body, MomentForm::SecondMoments));
            let twist = self.twist(i, i);
            let drift = drift(link, velocity, motion);
            let push = self.momentum(i);
            let [first, second] = &drift;
            let changing = flow.of_turn(&first.turn).with(&inertial(body, second));
            let turned = load.turned(&twist);
            let turning = flow.of_turn(&twist.turn);
            let damping = turning.with(&inertial(body, &first.doubled()));
            let joint = JointSlopes {
                push,
                swing: flow.swing(link),
                position: (changing.along(&twist), changing.with(&turned)),
                velocity: (damping.along(&twist), damping),
                flow: flow.clone(),
                drift,
            };
            ((flow, load), joint)
        };
        let back = |i: usize, (flow, load): (Flow<S>, Wrench<S>)| {
            let flow = flow.carried(&chain.links[i], &self.at[i]);
            (flow, chain.to_previous(i, self.at, &load))
        };
        let both = |(flow, load): &(Flow<S>, Wrench<S>), (other, more): &(Flow<S>, Wrench<S>)| {
            (flow.with(other), load.with(more))
        };
        let (joints, arrived) = chain.inward(whole, back, both);
        (joints, arrived.map_or_else(Flow::nothing, |(flow, _)| flow))
    }

    /// Returns C of all coordinates, by composite momenta.
    pub fn coriolis_matrix(&self, qd: &[S], travel: CompositeOrder) -> Matrix<S> {
        let (earlier, later, flow) = self.velocity_parts(qd);
        let of_base = self.base.as_ref().map(|body| (body, later.clone()));
        let mut matrix = zero_matrix(later.len());
        self.each_pair(travel, &earlier, later, |[j, i], [twist, rate], effect| {
            let ([felt, push], [swing]) = (&effect.wrenches, &effect.vectors);
            matrix[j][i] = felt.along(twist);
            if j < i {
                matrix[i][j] = plus(&dot(swing, &twist.turn), &push.along(rate));
            }
        });
        self.matrix_in_metres(&mut matrix);
        match of_base {
            None => matrix,
            Some((body, later)) => self.bordered_coriolis((body, &flow), qd, later, matrix),
        }
    }

    fn velocity_parts(&self, qd: &[S]) -> (Vec<Earlier<S>>, Vec<Later<S>>, Flow<S>) {
        let chain = self.chain;
        let velocities = chain.velocities(self.at, chain.base_turning(qd), qd);
        let whole = |i: usize, outer: Option<Flow<S>>| {
            let link = &chain.links[i];
            let outer = outer.unwrap_or_else(Flow::nothing);
            let flow = outer.with(&Flow::of(&link.body, &velocities[i]));
            let rate = rate(link, &velocities[i]);
            let push = self.momentum(i);
            let twist = self.twist(i, i);
            let turning = flow.half_of_turn(&twist.turn);
            let felt = turning.with(&inertial(&self.bodies[i], &rate));
            let (wrenches, vectors) = ([felt, push], [flow.half_swing(link)]);
            (flow, ([twist, rate], JointEffect { wrenches, vectors }))
        };
        let back = |i: usize, flow: Flow<S>| flow.carried(&chain.links[i], &self.at[i]);
        let (joints, arrived) = chain.inward(whole, back, Flow::with);
        let (earlier, later) = joints.into_iter().unzip();
        (earlier, later, arrived.unwrap_or_else(Flow::nothing))
    }
}

/// The twist of a joint and its rate.
type Earlier<S> = [Twist<S>; 2];

/// Half of the wrench per unit velocity that the joints before feel, the wrench of a unit
/// acceleration, and half of the composite's rate along the joint per turn.
type Later<S> = JointEffect<S, 2, 1>;

/// Returns V × Δ: how the twist of a joint changes.
pub(super) fn rate<S: Scalar>(link: &ChainLink<S>, velocity: &Twist<S>) -> Twist<S> {
    match link.kind {
        JointKind::Revolute => Twist {
            turn: across_z(&velocity.turn),
            shift: across_z(&velocity.shift),
        },
        JointKind::Prismatic => Twist::of_joint(link.kind, cross(&velocity.turn, &link.axis)),
    }
}

/// Returns V × Δ and its rate: of a joint that turns the third column of U, and of the origin.
fn drift<S: Scalar>(
    link: &ChainLink<S>,
    velocity: &Twist<S>,
    motion: &LinkMotion<S>,
) -> [Twist<S>; 2] {
    let first = rate(link, velocity);
    let second = match link.kind {
        JointKind::Revolute => {
            let across = across_z(&motion.acceleration);
            let shift = cross(&velocity.shift, &first.turn);
            let shift = sum(&across, &shift.each_ref().map(twice));
            let turn = motion.u[2].clone();
            Twist { turn, shift }
        }
        JointKind::Prismatic => Twist::of_joint(link.kind, motion.u_times(&link.axis)),
    };
    [first, second]
}

/// Returns the wrench of t + α × r of a body: m t + α × s, and s × t + I α with I = tr(Σ)·1 − Σ.
pub(super) fn inertial<S: Scalar>(body: &MomentBody<S>, twist: &Twist<S>) -> Wrench<S> {
    let Twist { turn, shift } = twist;
    let force = sum(&scaled(&body.mass, shift), &cross(turn, &body.first));
    let moment = tensor_times(&body.tensor(), turn);
    let moment = sum(&moment, &cross(&body.first, shift));
    Wrench { force, moment }
}

/// Returns tr(M) v − M v
fn traced<S: Scalar>(m: &Rotation<S>, v: &Vector<S>) -> Vector<S> {
    three(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let main = times(&plus(&m[j][j], &m[k][k]), &v[i]);
        let other = plus(&times(&m[i][j], &v[j]), &times(&m[i][k], &v[k]));
        minus(&main, &other)
    })
}

impl<S: Scalar> Flow<S> {
    pub(super) fn nothing() -> Self {
        let (momentum, moment) = (zero_vector(), three(|_| zero_vector()));
        Flow { momentum, moment }
    }

    /// Returns V = v + ω × r over one body: ∫ V dm = m v + ω × s and ∫ V rᵀ dm = v sᵀ + [ω]× Σ.
    pub(super) fn of(body: &MomentBody<S>, velocity: &Twist<S>) -> Self {
        let (omega, origin) = (&velocity.turn, &velocity.shift);
        let columns = body.second.rows().map(|column| cross(omega, &column));
        let entry = |r: usize, c: usize| plus(&times(&origin[r], &body.first[c]), &columns[c][r]);
        let momentum = sum(&scaled(&body.mass, origin), &cross(omega, &body.first));
        let moment = three(|r| three(|c| entry(r, c)));
        Flow { momentum, moment }
    }

    pub(super) fn with(&self, other: &Flow<S>) -> Self {
        let momentum = sum(&self.momentum, &other.momentum);
        let moment = three(|row| sum(&self.moment[row], &other.moment[row]));
        Flow { momentum, moment }
    }

    /// Returns them in the frame before, r from its origin: R (∫ V rᵀ dm) Rᵀ + (R ∫ V dm) pᵀ.
    pub(super) fn carried(&self, link: &ChainLink<S>, at: &Displacement<S>) -> Self {
        let momentum = link.outward(at, &self.momentum);
        // Rows turn as r, then columns as V.
        let rows = self.moment.each_ref().map(|row| link.outward(at, row));
        let column = |c: usize| link.outward(at, &rows.each_ref().map(|row| row[c].clone()));
        let columns = [0, 1, 2].map(column);
        let lever = link.lever(at);
        let entry = |r: usize, c: usize| plus(&columns[c][r], &times(&momentum[r], &lever[c]));
        let moment = three(|r| three(|c| entry(r, c)));
        Flow { momentum, moment }
    }

    /// Returns 2 ∫ (α × V) dm = 2 α × ∫ V dm, and its moment 2 (tr(M) α − M α), M = ∫ V rᵀ dm.
    pub(super) fn of_turn(&self, turn: &Vector<S>) -> Wrench<S> {
        self.half_of_turn(&turn.each_ref().map(twice))
    }

    pub(super) fn half_of_turn(&self, turn: &Vector<S>) -> Wrench<S> {
        let force = cross(turn, &self.momentum);
        let moment = traced(&self.moment, turn);
        Wrench { force, moment }
    }

    /// Returns ∫ V dm, and its moment ∫ r × V dm.
    pub(super) fn wrench(&self) -> Wrench<S> {
        let m = &self.moment;
        let force = self.momentum.clone();
        let moment = [(2, 1), (0, 2), (1, 0)].map(|(v, r)| minus(&m[v][r], &m[r][v]));
        Wrench { force, moment }
    }

    /// Returns ∫ V × (t + α × r) dm = ∫ V dm × t + tr(M) α − Mᵀ α.
    pub(super) fn across(&self, twist: &Twist<S>) -> Vector<S> {
        let shifted = cross(&self.momentum, &twist.shift);
        sum(&shifted, &traced(&transposed(&self.moment), &twist.turn))
    }

    /// Returns the result of [`Flow::of_turn`] along the joint, as a form in the turn.
    pub(super) fn swing(&self, link: &ChainLink<S>) -> Vector<S> {
        self.half_swing(link).each_ref().map(twice)
    }

    pub(super) fn half_swing(&self, link: &ChainLink<S>) -> Vector<S> {
        match link.kind {
            JointKind::Revolute => {
                let m = &self.moment;
                let [x, y] = [&m[2][0], &m[2][1]].map(negative);
                [x, y, plus(&m[0][0], &m[1][1])]
            }
            JointKind::Prismatic => cross(&self.momentum, &link.axis),
        }
    }
}

//! The quantities by the textbook's formulations: what everything else is proved against.

use alloc::vec::Vec;

use super::{Motion, Quantity};
use crate::equations::contact::squared;
use crate::equations::dalembert::Part;
use crate::equations::following::{gathered, gathered_columns, spread};
use crate::equations::forward::free;
use crate::equations::friction::Friction;
use crate::equations::kinematics::link_poses;
use crate::equations::load::Loading;
use crate::equations::matrix::{Columns, minus, plus};
use crate::equations::operational::{damped, products};
use crate::equations::regressor::Column;
use crate::equations::second_derivatives::OfAccelerations;
use crate::equations::{Arm, DhVariables, Formulation};
use crate::scalar::{Divide, Scalar};

/// An arm in motion, and the formulation that is asked.
#[derive(Clone, Copy, Debug)]
pub struct Written<'a, S> {
    /// Which of the textbook's.
    pub formulation: Formulation,
    /// The arm.
    pub arm: &'a Arm<S>,
    /// Where it is.
    pub at: &'a [DhVariables<S>],
    /// The motion of the arm.
    pub motion: &'a Motion<S>,
    /// The columns of a regressor; none where nothing asked is one.
    pub columns: &'a [Column<S>],
}

impl Quantity {
    /// Computes its entries by a textbook formulation, flat, row by row.
    pub fn written<S: Divide>(self, own: &Written<'_, S>) -> Vec<S> {
        let Written {
            formulation: form,
            arm,
            at,
            motion,
            columns,
        } = *own;
        let Motion {
            qd,
            qdd,
            tau,
            v,
            a,
            damping,
            multiplier,
            moves,
            ..
        } = motion;
        let state = [&qd[..], qdd, multiplier];
        match self {
            Quantity::Torque => form.inverse_dynamics(arm, at, qd, qdd),
            Quantity::Gravity => form.gravity(arm, at),
            Quantity::Inertia => form.inertia(arm, at).concat(),
            Quantity::Coriolis => form.velocity_terms(arm, at, qd),
            Quantity::Christoffel => form.christoffel(arm, at).concat().concat(),
            Quantity::KineticEnergy => alloc::vec![form.kinetic_energy(arm, at, qd)],
            Quantity::PotentialEnergy => alloc::vec![form.potential_energy(arm, at)],
            Quantity::Momentum => form.momentum(arm, at, qd),
            Quantity::MomentumSlope => form.momentum_slope(arm, at, qd),
            Quantity::CoriolisMatrix => form.coriolis_matrix(arm, at, qd).concat(),
            Quantity::RotationInertia => form.inertia_part(Part::Rotation, arm, at).concat(),
            Quantity::TranslationInertia => form.inertia_part(Part::Translation, arm, at).concat(),
            Quantity::RotationCoriolis => form.velocity_part(Part::Rotation, arm, at, qd),
            Quantity::TranslationCoriolis => form.velocity_part(Part::Translation, arm, at, qd),
            Quantity::Pose => form.hand(arm, at).rows(),
            Quantity::LinkPoses => link_poses(arm, at).iter().flat_map(Columns::rows).collect(),
            Quantity::Jacobian => form.task_jacobian(arm, at).concat(),
            Quantity::JacobianRate => {
                let rate = form.jacobian_rate(arm, at, qd);
                arm.frames.rows.pick(&rate.concat())
            }
            Quantity::Wrench => {
                let wrenches = form.wrenches(arm, at, qd, qdd).into_iter();
                let numbers = wrenches.flat_map(|wrench| [wrench.force, wrench.moment]);
                numbers.flatten().collect()
            }
            Quantity::TorqueByPosition => form.torque_by_position(arm, at, qd, qdd).concat(),
            Quantity::TorqueByVelocity => form.torque_by_velocity(arm, at, qd).concat(),
            Quantity::Passivity => form.passivity(arm, at, qd, [&v[..], a]),
            Quantity::Acceleration => form.forward_dynamics(arm, at, qd, tau, moves),
            Quantity::InertiaInverse | Quantity::AccelerationByTorque => {
                form.inertia_inverse(arm, at, moves).concat()
            }
            Quantity::AccelerationByPosition => {
                let [position, _] = form.acceleration_slopes(arm, at, qd, tau, moves);
                position.concat()
            }
            Quantity::AccelerationByVelocity => {
                let [_, velocity] = form.acceleration_slopes(arm, at, qd, tau, moves);
                velocity.concat()
            }
            Quantity::BaseRegressor | Quantity::LinkRegressor => {
                form.regressor(arm, at, qd, qdd, columns).concat()
            }
            Quantity::PassivityRegressor => {
                let rows = form.passivity_regressor(arm, at, qd, [&v[..], a], columns);
                rows.concat()
            }
            Quantity::MomentumDrift => {
                let friction = arm.links.iter().map(|link| &link.friction);
                let slope = form.momentum_slope(arm, at, qd);
                drift(&slope, &form.gravity(arm, at), friction, qd)
            }
            Quantity::ContactTorque => {
                less(&form.inverse_dynamics(arm, at, qd, qdd), &own.of_wrench())
            }
            Quantity::ContactAcceleration => {
                let tau = added(tau, &own.of_wrench());
                form.forward_dynamics(arm, at, qd, &tau, moves)
            }
            Quantity::ContactWrench => form.wrench_of_torques(arm, at, [&tau[..], damping], moves),
            Quantity::OperationalInertiaInverse => {
                form.task_space(arm, at, moves).mobility().concat()
            }
            Quantity::OperationalInertia => form
                .task_space(arm, at, moves)
                .inertia(&damping[0])
                .concat(),
            Quantity::ConsistentInverse => {
                let space = form.task_space(arm, at, moves);
                space.consistent_inverse(&damping[0]).concat()
            }
            Quantity::OperationalBias => form.operational_bias(arm, at, qd, &damping[0], moves),
            Quantity::NullSpace => {
                let space = form.task_space(arm, at, moves);
                space.null_space(&damping[0], moves).concat()
            }
            Quantity::TorqueByPositions => form.torque_by_positions(arm, at, state).concat(),
            Quantity::TorqueByPositionAndVelocity => {
                let given = [&qd[..], multiplier];
                form.torque_by_position_and_velocity(arm, at, given)
                    .concat()
            }
            Quantity::TorqueByVelocities => form
                .torque_by_velocities(arm, at, [&qd[..], multiplier])
                .concat(),
            Quantity::TorqueByAccelerationAndPosition => {
                let slopes = form.torque_by_acceleration_and_position(arm, at, multiplier);
                slopes.concat()
            }
            Quantity::AccelerationByPositions => {
                let inverted = Inverted::new(own);
                let qdd = form.forward_dynamics(arm, at, qd, tau, moves);
                let second = form.torque_by_positions(arm, at, [&qd[..], &qdd, &inverted.raised]);
                let slopes = form.torque_by_position(arm, at, qd, &qdd);
                let all = inverted.of_accelerations(own);
                all.by_positions(&second, &slopes).concat()
            }
            Quantity::AccelerationByPositionAndVelocity => {
                let inverted = Inverted::new(own);
                let given = [&qd[..], &inverted.raised];
                let second = form.torque_by_position_and_velocity(arm, at, given);
                let slopes = form.torque_by_velocity(arm, at, qd);
                let all = inverted.of_accelerations(own);
                all.by_position_and_velocity(&second, &slopes).concat()
            }
            Quantity::AccelerationByVelocities => {
                let inverted = Inverted::new(own);
                let second = form.torque_by_velocities(arm, at, [&qd[..], &inverted.raised]);
                let all = inverted.of_accelerations(own);
                all.by_velocities(&second).concat()
            }
            Quantity::AccelerationByTorqueAndPosition => {
                let all = Inverted::new(own).of_accelerations(own);
                all.by_torque_and_position().concat()
            }
            Quantity::Load => motion.loading.as_ref().map_or_else(Vec::new, Loading::load),
            Quantity::At(view) => view
                .seen(own, |quantity, own| quantity.written(own))
                .unwrap_or_default(),
        }
    }

    /// Returns the symmetric matrix that it inverts beside D, row by row, of which the condition
    /// says how far rounding may move it; nothing if it inverts no other.
    pub fn divisor<S: Divide>(self, own: &Written<'_, S>) -> Vec<S> {
        match self {
            Quantity::OperationalInertia
            | Quantity::ConsistentInverse
            | Quantity::OperationalBias
            | Quantity::NullSpace => own.damped_mobility().concat(),
            Quantity::ContactWrench => own.damped_square().1.concat(),
            Quantity::At(view) => view
                .seen(own, |quantity, own| quantity.divisor(own))
                .unwrap_or_default(),
            _ => Vec::new(),
        }
    }

    /// Returns what vanishes if these entries over all joints are its own, by an equation that
    /// it solves; nothing where [`Quantity::written`] says what it is.
    pub fn residual<S: Divide>(self, own: &Written<'_, S>, values: &[S]) -> Vec<S> {
        let (form, arm, at, motion) = (own.formulation, own.arm, own.at, own.motion);
        let (qd, tau, moves) = (&motion.qd, &motion.tau, &motion.moves);
        match self {
            Quantity::Acceleration => own.rest(values, tau),
            Quantity::ContactAcceleration => own.rest(values, &added(tau, &own.of_wrench())),
            // D D⁻¹ − 1 over the joints that move.
            Quantity::InertiaInverse | Quantity::AccelerationByTorque => {
                let (d, free) = (form.gathered_inertia(arm, at), free(moves));
                less_one(&d, values, &free)
            }
            // D ∂q̈/∂q + ∂τ/∂q at the motion that τ brings about.
            Quantity::AccelerationByPosition => {
                let qdd = form.forward_dynamics(arm, at, qd, tau, moves);
                let qdd = spread(&arm.following, qdd);
                own.defect(values, form.torque_by_position(arm, at, qd, &qdd))
            }
            Quantity::AccelerationByVelocity => {
                own.defect(values, form.torque_by_velocity(arm, at, qd))
            }
            // D X + ∂(D μ)/∂q with D μ = λ, of the joints that move.
            Quantity::AccelerationByTorqueAndPosition => {
                let mut driven = Inverted::new(own).driven(own);
                for row in &mut driven {
                    let held = row.iter_mut().zip(moves);
                    held.filter(|(_, moves)| !**moves)
                        .for_each(|(entry, _)| *entry = S::zero());
                }
                own.defect(values, driven)
            }
            // (J Jᵀ + λ² 1) ŵ − J τ
            Quantity::ContactWrench => {
                let (j, damped) = own.damped_square();
                let left = products(&damped, values);
                let right = products(&j, tau);
                left.iter().zip(&right).map(|(a, b)| a.sub(b)).collect()
            }
            // (Λ⁻¹ + λ² 1) Λ − 1
            Quantity::OperationalInertia => {
                let matrix = own.damped_mobility();
                let all: Vec<usize> = (0..matrix.len()).collect();
                less_one(&matrix, values, &all)
            }
            Quantity::ConsistentInverse => own.inverse_defect(values),
            Quantity::At(view) => {
                let residual =
                    |quantity: Quantity, own: &Written<'_, S>| quantity.residual(own, values);
                view.seen(own, residual).unwrap_or_default()
            }
            _ => Vec::new(),
        }
    }
}

impl<S: Divide> Written<'_, S> {
    /// Returns Jᵀ w over all joints of the arm.
    pub(super) fn of_wrench(&self) -> Vec<S> {
        self.formulation
            .torques_of_wrench(self.arm, self.at, &self.motion.wrench)
    }

    /// Returns Λ⁻¹ + λ² 1, which all that has Λ divides by.
    fn damped_mobility(&self) -> Vec<Vec<S>> {
        let space = self
            .formulation
            .task_space(self.arm, self.at, &self.motion.moves);
        space.damped(&self.motion.damping[0])
    }

    /// Returns J and J Jᵀ + λ² 1 of the joints that move.
    fn damped_square(&self) -> (Vec<Vec<S>>, Vec<Vec<S>>) {
        let motion = self.motion;
        let j = self
            .formulation
            .moving_jacobian(self.arm, self.at, &motion.moves);
        let damped = damped(&squared(&j), &motion.damping[0]);
        (j, damped)
    }

    /// Returns inverse dynamics of a motion less τ, of the joints that move by themselves.
    fn rest(&self, qdd: &[S], tau: &[S]) -> Vec<S> {
        let (following, motion) = (&self.arm.following, self.motion);
        let qdd = spread(following, qdd.to_vec());
        let taken = self
            .formulation
            .inverse_dynamics(self.arm, self.at, &motion.qd, &qdd);
        let rest = gathered(following, less(&taken, tau));
        let rest = rest.into_iter().zip(&motion.moves);
        let moving = rest.filter(|(_, moves)| **moves);
        moving.map(|(rest, _)| rest).collect()
    }

    /// Returns D X + S over the joints that move, for the slopes X of q̈ and S of τ.
    fn defect(&self, x: &[S], slopes: Vec<Vec<S>>) -> Vec<S> {
        let d = self.formulation.gathered_inertia(self.arm, self.at);
        let slopes = gathered_columns(&self.arm.following, slopes);
        let (free, n) = (free(&self.motion.moves), d.len());
        let entry = |i: usize, k: usize| {
            let products = free.iter().map(|&j| d[i][j].mul(&x[j * n + k]));
            products.fold(slopes[i][k].clone(), |sum, product| sum.add(&product))
        };
        let rows = free.iter().flat_map(|&i| (0..n).map(move |k| (i, k)));
        rows.map(|(i, k)| entry(i, k)).collect()
    }

    /// Returns D J̄ (Λ⁻¹ + λ² 1) − Jᵀ over the joints that move.
    fn inverse_defect(&self, inverse: &[S]) -> Vec<S> {
        let matrix = self.damped_mobility();
        let d = self.formulation.gathered_inertia(self.arm, self.at);
        let j = self.formulation.gathered_jacobian(self.arm, self.at);
        let (m, moves) = (j.len(), &self.motion.moves);
        let sum = |products: &mut dyn Iterator<Item = S>| {
            products.fold(S::zero(), |sum, product| sum.add(&product))
        };
        // J̄ (Λ⁻¹ + λ² 1)
        let given =
            |i: usize, r: usize| sum(&mut (0..m).map(|s| inverse[i * m + s].mul(&matrix[s][r])));
        let mut residual = Vec::new();
        for (r, row) in j.iter().enumerate() {
            let column: Vec<S> = (0..moves.len()).map(|k| given(k, r)).collect();
            for i in free(moves) {
                let left = sum(&mut column.iter().zip(&d[i]).map(|(x, d)| d.mul(x)));
                residual.push(left.sub(&row[i]));
            }
        }
        residual
    }
}

/// D⁻¹ as written, and μ = D⁻¹λ.
struct Inverted<S> {
    inverse: Vec<Vec<S>>,
    raised: Vec<S>,
}

impl<S: Divide> Inverted<S> {
    fn new(own: &Written<'_, S>) -> Self {
        let motion = own.motion;
        let inverse = own
            .formulation
            .inertia_inverse(own.arm, own.at, &motion.moves);
        let raised = products(&inverse, &motion.multiplier);
        Inverted { inverse, raised }
    }

    fn driven(&self, own: &Written<'_, S>) -> Vec<Vec<S>> {
        own.formulation
            .torque_by_acceleration_and_position(own.arm, own.at, &self.raised)
    }

    fn of_accelerations<'a>(&self, own: &Written<'a, S>) -> OfAccelerations<'a, S> {
        let by_inverse = |values: &[S]| products(&self.inverse, values);
        OfAccelerations::new(&self.driven(own), by_inverse, &own.motion.moves)
    }
}

/// Returns A X − 1 over these rows and columns.
fn less_one<S: Scalar>(a: &[Vec<S>], x: &[S], over: &[usize]) -> Vec<S> {
    let n = a.len();
    let entry = |i: usize, k: usize| {
        let one = if i == k { S::one() } else { S::zero() };
        let products = over.iter().map(|&j| a[i][j].mul(&x[j * n + k]));
        products.fold(one.neg(), |sum, product| sum.add(&product))
    };
    let rows = over.iter().flat_map(|&i| over.iter().map(move |&k| (i, k)));
    rows.map(|(i, k)| entry(i, k)).collect()
}

/// Returns Cᵀq̇ − c less the torques of friction.
pub(super) fn drift<'a, S: Scalar + 'a>(
    slope: &[S],
    gravity: &[S],
    friction: impl Iterator<Item = &'a Friction<S>>,
    qd: &[S],
) -> Vec<S> {
    let rest = slope.iter().zip(gravity).map(|(slope, c)| minus(slope, c));
    let rest = rest.zip(friction.zip(qd));
    rest.map(|(rest, (friction, qd))| minus(&rest, &friction.torque(qd)))
        .collect()
}

/// Returns a + b
pub(super) fn added<S: Scalar>(a: &[S], b: &[S]) -> Vec<S> {
    a.iter().zip(b).map(|(a, b)| plus(a, b)).collect()
}

/// Returns a − b
pub(super) fn less<S: Scalar>(a: &[S], b: &[S]) -> Vec<S> {
    a.iter().zip(b).map(|(a, b)| minus(a, b)).collect()
}

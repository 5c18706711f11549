//! The quantities by the chain formulas with regrouped parameters.

use alloc::vec::Vec;
use core::cell::OnceCell;

use super::textbook::{added, drift, less};
use super::{Motion, Quantity, Written};
use crate::equations::chain::composite::Composite;
use crate::equations::chain::second_derivatives::SecondDerivatives;
use crate::equations::chain::{Chain, Displacement, EliminatedTip, Form, Unknowns};
use crate::equations::energy::contracted;
use crate::equations::factor::{Factor, scatter, submatrix};
use crate::equations::following::{
    Following, gathered, gathered_columns, gathered_rows, gathered_square, spread,
};
use crate::equations::forward::{against, free, inverted, solved};
use crate::equations::link_axes::SeenHand;
use crate::equations::matrix::{Vector, zero_vector, zeros};
use crate::equations::operational::{NormalEquations, TaskSpace, driven_by};
use crate::equations::second_derivatives::OfAccelerations;
use crate::scalar::Divide;

/// A chain in motion, and how its formulas are associated.
#[derive(Clone, Debug)]
pub struct Regrouped<'a, S> {
    /// The chain at its position.
    pub chain: &'a Chain<S>,
    /// Where its joints are.
    pub at: &'a [Displacement<S>],
    /// Its composite bodies.
    pub composite: Composite<'a, S>,
    /// The motion of its joints.
    pub motion: &'a Motion<S>,
    /// The association.
    pub form: Form,
    /// The whole arm in motion, where something asked is of a frame: the chain has none.
    pub textbook: Option<Written<'a, S>>,
    /// The joints of the chain among those of the arm.
    pub joints: &'a [usize],
    /// Those of the chain that follow others, by their places in it.
    pub following: &'a [Following<S>],
    /// Results that several quantities are read off.
    pub shared: Shared<S>,
}

/// Results that several quantities of one function are read off, computed where first asked for.
#[derive(Clone, Debug)]
pub struct Shared<S> {
    /// The second derivatives of λᵀτ.
    of_torques: OnceCell<SecondDerivatives<S>>,
    /// The second derivatives of λᵀq̈.
    of_accelerations: OnceCell<SecondDerivatives<S>>,
}

impl<S> Default for Shared<S> {
    fn default() -> Self {
        Shared {
            of_torques: OnceCell::new(),
            of_accelerations: OnceCell::new(),
        }
    }
}

impl Quantity {
    /// Computes its entries by the chain formulas, over the chain's joints; `None` if these do
    /// not give it: then [`Quantity::written`] is where a search starts.
    pub fn regrouped<S: Divide>(self, own: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let (chain, composite, motion) = (own.chain, &own.composite, own.motion);
        let (at, form) = (own.at, own.form);
        let Motion {
            qd,
            qdd,
            v,
            a,
            damping,
            moves,
            ..
        } = motion;
        Some(match self {
            Quantity::Torque => own.torques(qdd),
            Quantity::Gravity => composite.gravity(form.composite_h),
            Quantity::Inertia => composite.inertia().concat(),
            Quantity::Coriolis => own.loads(&zero_vector()),
            Quantity::Christoffel => composite.christoffel().concat().concat(),
            Quantity::KineticEnergy => alloc::vec![chain.kinetic_energy(at, qd)],
            Quantity::Momentum => {
                let [p, _] = chain.momentum(at, qd);
                p
            }
            Quantity::MomentumSlope => {
                let [_, slope] = chain.momentum(at, qd);
                slope
            }
            Quantity::CoriolisMatrix => match form.flows {
                true => composite.coriolis_matrix(qd).concat(),
                false => contracted(&composite.christoffel(), qd).concat(),
            },
            Quantity::TorqueByPosition => composite.slopes(qd, qdd).position.concat(),
            Quantity::TorqueByVelocity => composite.slopes(qd, qdd).velocity.concat(),
            Quantity::Passivity => chain.passivity(at, qd, v, a),
            Quantity::Acceleration => own.accelerations(Unknowns::AgainstBase),
            Quantity::InertiaInverse | Quantity::AccelerationByTorque => {
                own.inertia_inverse().concat()
            }
            Quantity::AccelerationByPosition => {
                let [position, _] = own.slopes();
                position.concat()
            }
            Quantity::AccelerationByVelocity => {
                let [_, velocity] = own.slopes();
                velocity.concat()
            }
            Quantity::BaseRegressor | Quantity::LinkRegressor => {
                chain.regressor(at, qd, qdd).concat()
            }
            Quantity::PassivityRegressor => chain.passivity_regressor(at, qd, [v, a]).concat(),
            Quantity::MomentumDrift => {
                let [_, slope] = chain.momentum(at, qd);
                let friction = chain.links.iter().map(|link| &link.friction);
                drift(&slope, &composite.gravity(form.composite_h), friction, qd)
            }
            Quantity::ContactTorque => less(&own.torques(qdd), &own.of_wrench()?),
            Quantity::ContactAcceleration => {
                let motion = Motion {
                    tau: added(&motion.tau, &own.of_wrench()?),
                    ..motion.clone()
                };
                let pushed = Regrouped {
                    motion: &motion,
                    ..own.clone()
                };
                pushed.accelerations(Unknowns::AgainstBase)
            }
            Quantity::OperationalInertiaInverse => {
                let hand = own.hand()?;
                hand.turned_matrix(own.space(&hand).mobility()).concat()
            }
            Quantity::OperationalInertia => {
                let hand = own.hand()?;
                let inertia = own.space(&hand).inertia(&damping[0]);
                hand.turned_matrix(&inertia).concat()
            }
            Quantity::ConsistentInverse => {
                let hand = own.hand()?;
                let inverse = match own.normal(&hand) {
                    Some(normal) => normal.consistent_inverse(),
                    None => own.space(&hand).consistent_inverse(&damping[0]),
                };
                hand.turned(&inverse).concat()
            }
            Quantity::NullSpace => {
                let hand = own.hand()?;
                let projector = match own.normal(&hand) {
                    Some(normal) => normal.null_space(),
                    None => own.space(&hand).null_space(&damping[0], moves),
                };
                projector.concat()
            }
            Quantity::OperationalBias => own.operational_bias()?,
            Quantity::TorqueByPositions => own.of_torques().position.concat(),
            Quantity::TorqueByPositionAndVelocity => own.of_torques().mixed.concat(),
            Quantity::TorqueByVelocities => own.of_torques().velocity.concat(),
            Quantity::TorqueByAccelerationAndPosition => own.of_torques().driven.concat(),
            Quantity::AccelerationByPositions => own.of_accelerations().position.concat(),
            Quantity::AccelerationByPositionAndVelocity => own.of_accelerations().mixed.concat(),
            Quantity::AccelerationByVelocities => own.of_accelerations().velocity.concat(),
            Quantity::AccelerationByTorqueAndPosition => own.of_accelerations().driven.concat(),
            Quantity::At(view) => {
                let textbook = own.textbook.as_ref()?;
                let regrouped = |quantity: Quantity, textbook: &Written<'_, S>| {
                    quantity.regrouped(&Regrouped {
                        textbook: Some(textbook.clone()),
                        ..own.clone()
                    })
                };
                view.seen(textbook, regrouped)??
            }
            _ => return None,
        })
    }
}

impl<S: Divide> Regrouped<'_, S> {
    /// Returns the part of τ that the links take under this gravity without q̈.
    fn loads(&self, gravity: &Vector<S>) -> Vec<S> {
        let motion = [&self.motion.qd[..], &zeros(self.motion.qd.len())];
        (self.composite).loads(gravity, motion, &zero_vector(), self.form.composite_h)
    }

    /// Returns τ at these accelerations.
    fn torques(&self, qdd: &[S]) -> Vec<S> {
        let motion = [&self.motion.qd[..], qdd];
        let (gravity, exerted) = (&self.chain.gravity, zero_vector());
        let loads = (self.composite).loads(gravity, motion, &exerted, self.form.composite_h);
        self.chain.with_drives(&loads, motion)
    }

    /// Returns q̈: a last joint that nothing depends on first, D of the others.
    fn accelerations(&self, unknowns: Unknowns) -> Vec<S> {
        let motion = self.motion;
        let (given, moves) = ([motion.qd.as_slice(), &motion.tau], &motion.moves);
        let bias = || self.torques(&zeros(motion.qd.len()));
        if !self.following.is_empty() {
            let [bias, tau] =
                [bias(), motion.tau.clone()].map(|loads| gathered(self.following, loads));
            return solved(&self.gathered_inertia(), &bias, &tau, moves);
        }
        if let Some(unspun) = EliminatedTip::new(&self.composite, moves) {
            return unspun.forward_dynamics(given, moves, self.form, unknowns);
        }
        let shoulder = self.form.shoulder.then_some(&self.composite);
        let by_shoulder = shoulder.and_then(|all| all.forward_dynamics_by_shoulder(given, moves));
        if let Some(accelerations) = by_shoulder {
            return accelerations;
        }
        let d = self.composite.inertia();
        match self.form.composite_h {
            true => (self.chain).accelerations(&d, [&bias(), &motion.tau], moves, unknowns),
            false => (self.chain).forward_dynamics((self.at, &d), given, moves, unknowns),
        }
    }

    /// Returns D⁻¹: a last joint that nothing depends on first, D of the others.
    fn inertia_inverse(&self) -> Vec<Vec<S>> {
        let moves = &self.motion.moves;
        match EliminatedTip::new(&self.composite, moves).filter(|_| self.following.is_empty()) {
            Some(unspun) => unspun.inertia_inverse(moves),
            None => inverted(&self.gathered_inertia(), moves),
        }
    }

    /// Computes ∂q̈/∂q and ∂q̈/∂q̇ of the joints that move: with q̈ in the place of the free
    /// argument, D q̈ + h + c + b∘q̇ = τ for all q and q̇, so that D ∂q̈/∂q = −∂τ/∂q at that q̈.
    fn slopes(&self) -> [Vec<Vec<S>>; 2] {
        let qdd = spread(self.following, self.accelerations(Unknowns::Joints));
        let inverse = self.inertia_inverse();
        let slopes = self.composite.slopes(&self.motion.qd, &qdd);
        [slopes.position, slopes.velocity]
            .map(|slopes| against(&inverse, &gathered_columns(self.following, slopes)))
    }

    /// Returns Jᵀ w over the joints of the chain.
    fn of_wrench(&self) -> Option<Vec<S>> {
        Some(self.pick(&self.textbook.as_ref()?.of_wrench()))
    }

    /// Returns D of the chain, gathered at the leaders of joints that follow.
    fn gathered_inertia(&self) -> Vec<Vec<S>> {
        gathered_square(self.following, self.composite.inertia())
    }

    /// Returns the factors of D over the joints of the chain that move.
    fn factor(&self) -> Factor<S> {
        let d = self.gathered_inertia();
        Factor::new(&submatrix(&d, &free(&self.motion.moves)))
    }

    /// Returns the hand of the arm, seen as the form says.
    fn hand(&self) -> Option<SeenHand<'_, S>> {
        let whole = self.textbook.as_ref()?;
        let arm = (whole.arm, whole.at);
        Some(SeenHand::new(whole.formulation, arm, self.form.hand.axes))
    }

    /// Returns J′ over the joints of the chain, gathered at the leaders of those that follow.
    fn jacobian(&self, hand: &SeenHand<'_, S>) -> Vec<Vec<S>> {
        let rows = hand.jacobian();
        let rows = rows.iter().map(|row| self.pick(row));
        gathered_rows(self.following, rows.collect())
    }

    /// Returns the dynamics of the hand by J′ and D's factors.
    fn space(&self, hand: &SeenHand<'_, S>) -> TaskSpace<S> {
        TaskSpace::by_factor(self.jacobian(hand), &self.factor(), &self.motion.moves)
    }

    /// Returns J̄ and N by normal equations, if the form says so and there are such.
    fn normal(&self, hand: &SeenHand<'_, S>) -> Option<NormalEquations<S>> {
        let jacobian = self.form.hand.normal.then(|| self.jacobian(hand))?;
        let (inertia, motion) = (self.gathered_inertia(), self.motion);
        NormalEquations::new(&jacobian, &inertia, &motion.damping[0], &motion.moves)
    }

    /// Returns μ; friction is no part of it.
    fn operational_bias(&self) -> Option<Vec<S>> {
        let (motion, hand) = (self.motion, self.hand()?);
        let qd = &self.textbook.as_ref()?.motion.qd;
        let loads = gathered(self.following, self.loads(&self.chain.gravity));
        let (jacobian, factor) = (self.jacobian(&hand), self.factor());
        let driven = driven_by(&jacobian, &factor, &loads, &motion.moves);
        let space = TaskSpace::by_factor(jacobian, &factor, &motion.moves);
        let bias = space.bias(&driven, &hand.rate(qd), &motion.damping[0]);
        Some(hand.turned(&[bias]).concat())
    }

    /// Returns the second derivatives of λᵀτ.
    fn of_torques(&self) -> &SecondDerivatives<S> {
        let motion = self.motion;
        let given = [&motion.qd[..], &motion.qdd, &motion.multiplier];
        let all = || self.composite.second_derivatives(given);
        self.shared.of_torques.get_or_init(all)
    }

    /// Returns the second derivatives of λᵀq̈.
    fn of_accelerations(&self) -> &SecondDerivatives<S> {
        let motion = self.motion;
        let all = || {
            let (factor, free) = (self.factor(), free(&motion.moves));
            let by_inverse = |values: &[S]| {
                let load: Vec<S> = free.iter().map(|&i| values[i].clone()).collect();
                scatter(&factor.solve(&load), &free, values.len())
            };
            let qdd = self.accelerations(Unknowns::Joints);
            let raised = by_inverse(&motion.multiplier);
            let own = (self.composite).second_derivatives([&motion.qd[..], &qdd, &raised]);
            let slopes = self.composite.slopes(&motion.qd, &qdd);
            let all = OfAccelerations::new(&own.driven, by_inverse, &motion.moves);
            SecondDerivatives {
                position: all.by_positions(&own.position, &slopes.position),
                mixed: all.by_position_and_velocity(&own.mixed, &slopes.velocity),
                velocity: all.by_velocities(&own.velocity),
                driven: all.by_torque_and_position(),
            }
        };
        self.shared.of_accelerations.get_or_init(all)
    }

    /// Values over all joints of the arm, over those of the chain.
    fn pick(&self, values: &[S]) -> Vec<S> {
        let joints = self.joints.iter();
        joints.map(|&joint| values[joint].clone()).collect()
    }
}

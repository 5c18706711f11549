//! Energies, momenta and the Coriolis matrix, from every formulation.

use alloc::vec::Vec;

use super::dalembert::{Dalembert, Part};
use super::derivatives::constants;
use super::matrix::{
    Columns, Vector, columns_of, dot, halved, minus, negative, plus, product, products, scaled,
    sum, zero_vector, zeros,
};
use super::{Arm, DhVariables, Formulation};
use crate::robot::JointKind;
use crate::scalar::Scalar;
use crate::scalar::dual::Dual;

impl Formulation {
    /// Returns p = D q̇, length n. A recursion gives it as the torques that would
    /// accelerate the arm at rest, weightless, as fast as it moves.
    pub fn momentum<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>], qd: &[S]) -> Vec<S> {
        match self {
            Self::LagrangeEuler | Self::Dalembert => products(&self.inertia(arm, at), qd),
            _ => self.inverse_dynamics(&arm.weightless(), at, &zeros(qd.len()), qd),
        }
    }

    /// Returns T = ½ q̇ᵀ D q̇, the rotors' part included.
    pub fn kinetic_energy<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>], qd: &[S]) -> S {
        halved(&product(&self.momentum(arm, at, qd), qd))
    }

    /// Returns Cᵀ q̇ = ∂T/∂q, length n: Lagrange–Euler from the Christoffel symbols;
    /// elsewhere Ḋ q̇ − h, where Ḋ q̇ is the rate of the momentum of a motion
    /// that keeps its velocities.
    pub fn momentum_slope<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
    ) -> Vec<S> {
        if self == Self::LagrangeEuler {
            return products(&columns_of(&self.coriolis_matrix(arm, at, qd)), qd);
        }
        let h = self.velocity_terms(arm, at, qd);
        let (arm_moving, at_moving) = moving(arm, at, qd);
        let p = self.momentum(&arm_moving, &at_moving, &constants(qd));
        p.iter().zip(&h).map(|(p, h)| minus(&p.rate, h)).collect()
    }

    /// Returns C, n×n: C_ik = Σ_m h_ikm q̇_m, so that C q̇ = h and Ḋ − 2C is skew.
    pub fn coriolis_matrix<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
    ) -> Vec<Vec<S>> {
        contracted(&self.christoffel(arm, at), qd)
    }

    /// Returns D a + C v + c + (b + F∘r)∘v, length n: Coulomb friction is taken as the
    /// damping that it is at q̇, as C is taken at q̇. A recursion gives C v, which is bilinear
    /// in q̇ and v, as h of half their sum less h of half their difference.
    pub fn passivity<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
        [v, a]: [&[S]; 2],
    ) -> Vec<S> {
        let load = match self {
            Self::LagrangeEuler | Self::Dalembert => {
                let (d, c) = (self.inertia(arm, at), self.coriolis_matrix(arm, at, qd));
                let rows = d.iter().zip(&c).zip(self.gravity(arm, at));
                let rows =
                    rows.map(|((d, c), load)| plus(&plus(&product(d, a), &product(c, v)), &load));
                rows.collect::<Vec<S>>()
            }
            _ => {
                let of = |combine: fn(&S, &S) -> S| -> Vec<S> {
                    let rates = qd.iter().zip(v);
                    rates.map(|(qd, v)| halved(&combine(qd, v))).collect()
                };
                let free = arm.clone().without_friction();
                let with = self.inverse_dynamics(&free, at, &of(plus), a);
                let without = self.velocity_terms(arm, at, &of(minus));
                let pairs = with.iter().zip(&without);
                pairs.map(|(with, without)| minus(with, without)).collect()
            }
        };
        let links = load.iter().zip(&arm.links).zip(v);
        let damped = links.map(|((load, link), v)| plus(load, &link.friction.torque(v)));
        damped.collect()
    }

    /// Returns D^rot or D^tran, n×n, the armature in neither.
    pub fn inertia_part<S: Scalar>(
        self,
        part: Part,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
    ) -> Vec<Vec<S>> {
        if self != Self::Dalembert {
            return self.inertia(&part.of(arm), at);
        }
        let parts = Dalembert::new(arm, at).inertia_parts();
        parts[part as usize].clone()
    }

    /// Returns h^rot or h^tran, length n.
    pub fn velocity_part<S: Scalar>(
        self,
        part: Part,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
    ) -> Vec<S> {
        if self != Self::Dalembert {
            return self.velocity_terms(&part.of(arm), at, qd);
        }
        let parts = Dalembert::new(arm, at).velocity_parts(qd);
        parts[part as usize].clone()
    }

    /// Returns U = −Σ_j m_j g·r_j, r_j from the origin of the base, not of frame 0: Lagrange–Euler
    /// from the pose of each link; elsewhere from first moments, gathered from the hand inward.
    pub fn potential_energy<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>]) -> S {
        let moment = match self {
            Self::LagrangeEuler => first_moment_by_poses(arm, at),
            _ => first_moment(arm, at),
        };
        negative(&dot(&arm.gravity, &moment))
    }
}

/// Returns C_ik = Σ_m h_ikm q̇_m
pub fn contracted<S: Scalar>(h: &[Vec<Vec<S>>], qd: &[S]) -> Vec<Vec<S>> {
    h.iter().map(|h| products(h, qd)).collect()
}

pub(super) fn moving<S: Scalar>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
) -> (Arm<Dual<S>>, Vec<DhVariables<Dual<S>>>) {
    let links = arm.links.iter().zip(at).zip(qd);
    let at = links.map(|((link, at), rate)| match link.kind {
        JointKind::Revolute => DhVariables {
            theta: at.theta.clone().turning(rate),
            d: Dual::constant(at.d.clone()),
        },
        JointKind::Prismatic => DhVariables {
            theta: at.theta.map(|x| Dual::constant(x.clone())),
            d: Dual {
                value: at.d.clone(),
                rate: rate.clone(),
            },
        },
    });
    (arm.map(|x| Dual::constant(x.clone())), at.collect())
}

/// Returns the lever from the base's origin to that of frame 0, in the axes of frame 0.
fn base_lever<S: Scalar>(arm: &Arm<S>) -> Vector<S> {
    match &arm.base {
        None => zero_vector(),
        Some(base) => base.rotate_back(&base.origin),
    }
}

/// Returns Σ_j m_j r_j from the base's origin in the axes of frame 0, link by link.
fn first_moment_by_poses<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>]) -> Vector<S> {
    let mut pose = Columns {
        origin: base_lever(arm),
        ..Columns::identity()
    };
    let mut moment = zero_vector();
    for (link, at) in arm.links.iter().zip(at) {
        pose = link.append(arm.convention, at, &pose);
        let centre = pose.apply(&link.com, &S::one());
        moment = sum(&moment, &scaled(&link.mass, &centre));
    }
    moment
}

fn first_moment<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>]) -> Vector<S> {
    let mut moment = zero_vector();
    let mut mass = S::zero();
    for (link, at) in arm.links.iter().zip(at).rev() {
        moment = sum(&moment, &scaled(&link.mass, &link.com));
        mass = plus(&mass, &link.mass);
        let step = link.append(arm.convention, at, &Columns::identity());
        let turned = link.to_previous(arm.convention, at, &moment);
        moment = sum(&turned, &scaled(&mass, &step.origin));
    }
    match &arm.base {
        None => moment,
        Some(_) => sum(&moment, &scaled(&mass, &base_lever(arm))),
    }
}

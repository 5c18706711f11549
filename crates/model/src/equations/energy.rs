//! Energies, momenta and the Coriolis matrix, from every formulation.

use alloc::vec::Vec;

use super::arm::Posed;
use super::dalembert::{Dalembert, Part};
use super::derivatives::{constants, still};
use super::matrix::*;
use super::{Arm, At, DhVariables, Formulation};
use crate::robot::JointKind;
use crate::scalar::Scalar;
use crate::scalar::dual::Dual;

impl Formulation {
    /// Returns p = D q̇: of a recursion the torques that give the weightless arm at rest q̈ = q̇.
    pub fn momentum<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> Vec<S> {
        match self {
            Self::LagrangeEuler | Self::Dalembert => products(&self.inertia(arm, at), qd),
            _ => self.inverse_dynamics(&arm.weightless(), at, &zeros(qd.len()), qd),
        }
    }

    /// Returns T = ½ q̇ᵀ D q̇, the rotors' part included.
    pub fn kinetic_energy<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> S {
        halved(&product(&self.momentum(arm, at, qd), qd))
    }

    /// Returns Cᵀ q̇ = ∂T/∂q: Lagrange–Euler from the Christoffel symbols; elsewhere Ḋ q̇ − h, with
    /// Ḋ q̇ the rate of the momentum of a motion that keeps its velocities.
    pub fn momentum_slope<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> Vec<S> {
        if self == Self::LagrangeEuler {
            return products(&columns_of(&self.coriolis_matrix(arm, at, qd)), qd);
        }
        let h = self.velocity_terms(arm, at, qd);
        let (arm_moving, at_moving) = arm.bending(at, qd);
        let p = self.momentum(&arm_moving, &at_moving, &constants(qd));
        p.iter().zip(&h).map(|(p, h)| minus(&p.rate, h)).collect()
    }

    /// Returns C, n×n: C_ik = Σ_m h_ikm q̇_m, so that C q̇ = h and Ḋ − 2C is skew.
    pub fn coriolis_matrix<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> Matrix<S> {
        let c = contracted(&self.christoffel(arm, at), qd);
        match arm.floats {
            false => c,
            true => matrix_sum(&c, &arm.of_drift(&self.inertia(arm, at), qd)),
        }
    }

    /// Returns D a + C v + c + (b + F∘r)∘v, length n: Coulomb friction is taken as the damping that
    /// it is at q̇, as C is. A recursion gives C v, which is bilinear in q̇ and v, as h of half their
    /// sum less h of half their difference, and D [q̇, v] / 2 of a base that floats.
    pub fn passivity<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, [qd, v, a]: [&[S]; 3]) -> Vec<S> {
        let load: Vec<S> = match self {
            Self::LagrangeEuler | Self::Dalembert => {
                let (d, c) = (self.inertia(arm, at), self.coriolis_matrix(arm, at, qd));
                let gravity = self.gravity(arm, at);
                let both = |i: usize| plus(&product(&d[i], a), &product(&c[i], v));
                (0..d.len()).map(|i| plus(&both(i), &gravity[i])).collect()
            }
            _ => {
                let of = |combine: fn(&S, &S) -> S| -> Vec<S> {
                    let rates = qd.iter().zip(v);
                    rates.map(|(qd, v)| halved(&combine(qd, v))).collect()
                };
                let free = arm.clone().without_friction();
                let a = arm.with_half_bracket(a, [qd, v]);
                let with = self.inverse_dynamics(&free, at, &of(plus), &a);
                differences(&with, &self.velocity_terms(arm, at, &of(minus)))
            }
        };
        let links = load.iter().zip(&arm.links).zip(v);
        let damped = links.map(|((load, link), v)| plus(load, &link.friction.torque(v)));
        damped.collect()
    }

    /// Returns D^rot or D^tran, n×n, the armature in neither.
    pub fn inertia_part<S: Scalar>(self, part: Part, arm: &Arm<S>, at: &At<S>) -> Matrix<S> {
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
        at: &At<S>,
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
    pub fn potential_energy<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> S {
        let moment = match self {
            Self::LagrangeEuler => first_moment_by_poses(arm, at),
            _ => first_moment(arm, at),
        };
        negative(&dot(&arm.gravity, &moment))
    }
}

/// Returns C_ik = Σ_m h_ikm q̇_m
pub fn contracted<S: Scalar>(h: &[Matrix<S>], qd: &[S]) -> Matrix<S> {
    h.iter().map(|h| products(h, qd)).collect()
}

pub(super) fn moving<S: Scalar>(arm: &Arm<S>, at: &At<S>, qd: &[S]) -> Posed<Dual<S>> {
    let links = arm.links.iter().zip(at).zip(qd);
    let at = links.map(|((link, at), rate)| {
        let (theta, d) = match link.kind {
            JointKind::Revolute => (at.theta.clone().turning(rate), still(&at.d)),
            JointKind::Prismatic => {
                let [value, rate] = [&at.d, rate].map(S::clone);
                (at.theta.map(still), Dual { value, rate })
            }
        };
        DhVariables { theta, d }
    });
    (arm.map(still), at.collect())
}

/// Returns the lever from the base's origin to that of frame 0, in the axes of frame 0.
fn base_lever<S: Scalar>(arm: &Arm<S>) -> Vector<S> {
    match &arm.base {
        None => zero_vector(),
        Some(base) => base.rotate_back(&base.origin),
    }
}

/// Returns Σ_j m_j r_j from the base's origin in the axes of frame 0, link by link.
fn first_moment_by_poses<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vector<S> {
    let mut base = Columns::identity();
    base.origin = base_lever(arm);
    let mut moment = zero_vector();
    arm.outward(&base, |i, before| {
        let pose = arm.step(i, at).append(before);
        let centre = pose.apply(&arm.links[i].com, &S::one());
        moment = sum(&moment, &scaled(&arm.links[i].mass, &centre));
        pose
    });
    moment
}

fn first_moment<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vector<S> {
    let (mut moment, mut mass) = (zero_vector(), S::zero());
    arm.inward(|i, arrived: Vec<(usize, (Vector<S>, S))>| {
        let (mut tree_moment, mut tree_mass) = (zero_vector(), S::zero());
        for (_, (outer_moment, outer_mass)) in &arrived {
            tree_moment = sum(&tree_moment, outer_moment);
            tree_mass = plus(&tree_mass, outer_mass);
        }
        let (step, link) = (arm.step(i, at), &arm.links[i]);
        tree_moment = sum(&tree_moment, &scaled(&link.mass, &link.com));
        tree_mass = plus(&tree_mass, &link.mass);
        let (lever, turned) = (step.lever(), step.to_previous(&tree_moment));
        tree_moment = sum(&turned, &scaled(&tree_mass, &lever));
        if arm.carrier(i).is_none() {
            (moment, mass) = (sum(&moment, &tree_moment), plus(&mass, &tree_mass));
        }
        ((tree_moment, tree_mass), ())
    });
    match &arm.base {
        None => moment,
        Some(_) => sum(&moment, &scaled(&mass, &base_lever(arm))),
    }
}

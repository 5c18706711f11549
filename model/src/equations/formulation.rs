//! Every output from every formulation, by name.

use alloc::vec::Vec;

use super::dalembert::Dalembert;
use super::lagrange_euler::{self, LagrangeEuler};
use super::newton_euler::{table1, table2};
use super::{Arm, DhVariables, from_torques};
use crate::scalar::Scalar;

/// A way to write the dynamics. All give the same functions of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Formulation {
    /// Traces of derivatives of poses: [`lagrange_euler`].
    LagrangeEuler,
    /// Closed vector forms: [`Dalembert`].
    Dalembert,
    /// The recursion in base axes: [`table1`].
    NewtonEulerBase,
    /// The recursion in link axes as printed: [`table2::Moment::AsPrinted`].
    NewtonEulerLinkAsPrinted,
    /// The recursion in link axes: [`table2::Moment::RotateFirst`].
    NewtonEulerLink,
    /// The recursion in link axes that rounds least: [`table2::Moment::Differences`].
    NewtonEulerLinkDifferences,
}

impl Formulation {
    /// Every formulation.
    pub const ALL: [Self; 6] = [
        Self::LagrangeEuler,
        Self::Dalembert,
        Self::NewtonEulerBase,
        Self::NewtonEulerLinkAsPrinted,
        Self::NewtonEulerLink,
        Self::NewtonEulerLinkDifferences,
    ];

    /// Returns whether it has D and h by formulas of their own, not as torques
    /// of chosen motions.
    pub(super) fn has_closed_form(self) -> bool {
        matches!(self, Self::LagrangeEuler | Self::Dalembert)
    }

    /// Returns τ = D q̈ + h + c + b∘q̇, length n.
    pub fn inverse_dynamics<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
        qdd: &[S],
    ) -> Vec<S> {
        use table2::Moment;
        match self {
            Self::LagrangeEuler => lagrange_euler::inverse_dynamics(arm, at, qd, qdd),
            Self::Dalembert => Dalembert::new(arm, at).inverse_dynamics(qd, qdd),
            Self::NewtonEulerBase => table1::inverse_dynamics(arm, at, qd, qdd),
            Self::NewtonEulerLinkAsPrinted => {
                table2::inverse_dynamics(arm, at, qd, qdd, Moment::AsPrinted)
            }
            Self::NewtonEulerLink => {
                table2::inverse_dynamics(arm, at, qd, qdd, Moment::RotateFirst)
            }
            Self::NewtonEulerLinkDifferences => {
                table2::inverse_dynamics(arm, at, qd, qdd, Moment::Differences)
            }
        }
    }

    /// Returns D, n×n, symmetric, armature on the diagonal.
    pub fn inertia<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<Vec<S>> {
        match self {
            Self::LagrangeEuler => LagrangeEuler::new(arm, at).inertia(),
            Self::Dalembert => Dalembert::new(arm, at).inertia(),
            _ => from_torques::inertia(
                |arm, at, qd, qdd| self.inverse_dynamics(arm, at, qd, qdd),
                arm,
                at,
            ),
        }
    }

    /// Returns h_i = Σ_k Σ_m h_ikm q̇_k q̇_m, length n, without damping.
    pub fn velocity_terms<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
    ) -> Vec<S> {
        match self {
            Self::LagrangeEuler => {
                lagrange_euler::velocity_terms(&LagrangeEuler::new(arm, at).christoffel(), qd)
            }
            Self::Dalembert => Dalembert::new(arm, at).velocity_terms(qd),
            _ => from_torques::velocity_terms(
                |arm, at, qd, qdd| self.inverse_dynamics(arm, at, qd, qdd),
                arm,
                at,
                qd,
            ),
        }
    }

    /// Returns c, length n.
    pub fn gravity<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<S> {
        match self {
            Self::LagrangeEuler => LagrangeEuler::new(arm, at).gravity(),
            Self::Dalembert => Dalembert::new(arm, at).gravity(),
            _ => from_torques::gravity(
                |arm, at, qd, qdd| self.inverse_dynamics(arm, at, qd, qdd),
                arm,
                at,
            ),
        }
    }

    /// Returns `h[i][k][m]` = h_ikm, n×n×n, symmetric in k and m.
    pub fn christoffel<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<Vec<Vec<S>>> {
        match self {
            Self::LagrangeEuler => LagrangeEuler::new(arm, at).christoffel(),
            Self::Dalembert => {
                // h alone: the terms that q̈ and g multiply are not asked for.
                let terms = Dalembert::new(arm, at);
                let h =
                    |_: &Arm<S>, _: &[DhVariables<S>], qd: &[S], _: &[S]| terms.velocity_terms(qd);
                from_torques::christoffel(h, arm, at)
            }
            _ => from_torques::christoffel(
                |arm, at, qd, qdd| self.inverse_dynamics(arm, at, qd, qdd),
                arm,
                at,
            ),
        }
    }
}

//! Every output from every formulation, by name.
//!
//! The recursions give D, h, c and h_ikm as torques of chosen motions. Their rates and
//! accelerations are zeros and ones by structure, so that a symbolic scalar folds what they
//! switch off.

use alloc::vec::Vec;

use super::dalembert::Dalembert;
use super::lagrange_euler::{self, LagrangeEuler};
use super::matrix::*;
use super::newton_euler::table1;
use super::newton_euler::table2::{self, Moment};
use super::{Arm, At};
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
    /// The recursion in link axes as printed: [`table2::Moment::AsPrinted`]. It has a second way to
    /// poses, too: two axes of the hand, and the third by their product.
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

    /// True if D and h have formulas of their own, and are not torques of chosen motions.
    pub(super) fn has_closed_form(self) -> bool {
        matches!(self, Self::LagrangeEuler | Self::Dalembert)
    }

    /// Returns τ = D q̈ + h + c + b∘q̇, length n.
    pub fn inverse_dynamics<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        qd: &[S],
        qdd: &[S],
    ) -> Vec<S> {
        let qdd = &*arm.accelerations(qd, qdd);
        if let Some(moment) = self.moment() {
            return table2::inverse_dynamics(arm, at, [qd, qdd], moment);
        }
        match self {
            Self::LagrangeEuler => LagrangeEuler::new(arm, at).inverse_dynamics(qd, qdd),
            Self::Dalembert => Dalembert::new(arm, at).inverse_dynamics(qd, qdd),
            _ => table1::inverse_dynamics(arm, at, qd, qdd),
        }
    }

    /// Returns the form of a recursion in link axes, if it is one.
    pub(super) fn moment(self) -> Option<Moment> {
        match self {
            Self::NewtonEulerLinkAsPrinted => Some(Moment::AsPrinted),
            Self::NewtonEulerLink => Some(Moment::RotateFirst),
            Self::NewtonEulerLinkDifferences => Some(Moment::Differences),
            Self::LagrangeEuler | Self::Dalembert | Self::NewtonEulerBase => None,
        }
    }

    /// Returns D, n×n, symmetric, armature on the diagonal.
    pub fn inertia<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Matrix<S> {
        match self {
            Self::LagrangeEuler => LagrangeEuler::new(arm, at).inertia(),
            Self::Dalembert => Dalembert::new(arm, at).inertia(),
            // Column k is τ of q̈ = e_k at rest, without gravity: of its rows those of i ≥ k.
            _ => {
                let (arm, n) = (arm.weightless(), at.len());
                let column = |k: usize| self.inverse_dynamics(&arm, at, &zeros(n), &unit(n, k));
                let columns: Matrix<S> = (0..n).map(column).collect();
                symmetric(n, |i, k| columns[k][i].clone())
            }
        }
    }

    /// Returns h_i = Σ_k Σ_m h_ikm q̇_k q̇_m, length n, without damping.
    pub fn velocity_terms<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> Vec<S> {
        let h = match self {
            Self::LagrangeEuler => lagrange_euler::velocity_terms(&self.christoffel(arm, at), qd),
            Self::Dalembert => Dalembert::new(arm, at).velocity_terms(qd),
            _ => {
                let arm = arm.weightless().without_friction();
                return self.inverse_dynamics(&arm, at, qd, &zeros(qd.len()));
            }
        };
        match arm.floats {
            false => h,
            true => sums(&h, &products(&self.inertia(arm, at), &arm.drift(qd, qd))),
        }
    }

    /// Returns c, length n.
    pub fn gravity<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Vec<S> {
        match self {
            Self::LagrangeEuler => LagrangeEuler::new(arm, at).gravity(),
            Self::Dalembert => Dalembert::new(arm, at).gravity(),
            _ => {
                let rest = zeros(at.len());
                self.inverse_dynamics(arm, at, &rest, &rest)
            }
        }
    }

    /// Returns `h[i][k][m]` = h_ikm, n×n×n, symmetric in k and m; of a floating base in its joints.
    pub fn christoffel<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Vec<Matrix<S>> {
        match self {
            Self::LagrangeEuler => LagrangeEuler::new(arm, at).christoffel(),
            Self::Dalembert => {
                let terms = Dalembert::new(arm, at);
                polarised(at.len(), &|qd| terms.velocity_terms(qd))
            }
            // In all joints: of a floating base's six, too, q̈ is zero.
            _ => {
                let mut fixed = arm.clone();
                fixed.floats = false;
                polarised(at.len(), &|qd| self.velocity_terms(&fixed, at, qd))
            }
        }
    }
}

/// Returns `h[i][k][m]` = h_ikm of any h(q̇) by polarisation: h_ikk = h_i(e_k) and
/// h_ikm = (h_i(e_k + e_m) − h_i(e_k) − h_i(e_m)) / 2.
fn polarised<S: Scalar>(n: usize, velocity_terms: &dyn Fn(&[S]) -> Vec<S>) -> Vec<Matrix<S>> {
    let squares: Matrix<S> = (0..n).map(|k| velocity_terms(&unit(n, k))).collect();
    let pair = |k: usize, m: usize| {
        let mut both = unit(n, k);
        both[m] = S::one();
        velocity_terms(&both)
    };
    let row = |m: usize| (0..m).map(|k| pair(k, m)).collect();
    let pairs: Vec<Matrix<S>> = (0..n).map(row).collect();
    symmetric_each(n, |i, m, k| match m == k {
        true => squares[k][i].clone(),
        false => {
            let mixed = minus(&minus(&pairs[m][k][i], &squares[k][i]), &squares[m][i]);
            halved(&mixed)
        }
    })
}

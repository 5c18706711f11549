//! Derivatives of the torques, of every formulation, by duals: the formula's
//! own text over a value and its rate of change.
//!
//! Second derivatives are of λᵀτ and λᵀq̈ for a given λ: n² numbers each where those of all torques
//! are n³. Closed forms have those of the torques by duals of duals. In a recursion hardly a digit
//! would be left of that for a light wrist on a heavy arm, since forces turn out and back in:
//! recursions have them from [composite bodies](super::chain), which tests hold against the closed
//! forms. Those of the accelerations follow, since D q̈ + h + c + b∘q̇ = τ holds for all q and q̇:
//! with D μ = λ, L the second derivatives of μᵀτ at that q̈, and X = ∂(μᵀD)/∂q D⁻¹, those of λᵀq̈
//! are −L and what X makes of the slopes of τ.

use alloc::vec::Vec;

use super::chain::composite::{Composite, CompositeOrder};
use super::chain::second_derivatives::SecondDerivatives;
use super::chain::{Chain, Regrouping, Skeleton};
use super::energy::{contracted, moving};
use super::forward::free;
use super::lagrange_euler::LagrangeEuler;
use super::matrix::*;
use super::{Arm, At, DhVariables, Formulation, JointPosition, SinCosPair};
use crate::robot::JointKind;
use crate::scalar::Scalar;
use crate::scalar::dual::Dual;

pub(super) fn still<S: Scalar>(value: &S) -> Dual<S> {
    Dual::constant(value.clone())
}

pub(super) fn constants<S: Scalar>(values: &[S]) -> Vec<Dual<S>> {
    values.iter().map(still).collect()
}

pub(super) fn with_rates<S: Scalar>(values: &[S], rates: &[S]) -> Vec<Dual<S>> {
    let pairs = values.iter().cloned().zip(rates.iter().cloned());
    pairs.map(|(value, rate)| Dual { value, rate }).collect()
}

pub(super) fn columns<S: Scalar>(n: usize, column: &dyn Fn(usize) -> Vec<Dual<S>>) -> Matrix<S> {
    let rates = |k: usize| column(k).into_iter().map(|x| x.rate).collect();
    columns_of(&(0..n).map(rates).collect::<Matrix<S>>())
}

fn weighed<'a, S: Scalar + 'a>(multiplier: &[S], values: impl Iterator<Item = &'a S>) -> S {
    total(multiplier.iter().zip(values).map(|(l, x)| times(l, x)))
}

fn rates_of<S: Scalar>(multiplier: &[S], matrix: &[Vec<Dual<S>>]) -> Vec<S> {
    let column = |j: usize| weighed(multiplier, matrix.iter().map(|row| &row[j].rate));
    (0..matrix.len()).map(column).collect()
}

fn by_composites<S: Scalar>(arm: &Arm<S>, at: &At<S>, inputs: [&[S]; 3]) -> SecondDerivatives<S> {
    // The constants of a joint go into its position: `at` has both as one value.
    let mut arm = arm.clone();
    let links = arm.links.iter_mut().zip(at);
    let position: Vec<JointPosition<S>> = links
        .map(|(link, at)| match link.kind {
            JointKind::Revolute => {
                link.theta = SinCosPair::straight();
                JointPosition::Revolute(at.theta.clone())
            }
            JointKind::Prismatic => {
                link.d = S::zero();
                JointPosition::Prismatic(at.d.clone())
            }
        })
        .collect();
    let skeleton = Skeleton::new(&arm, &[]);
    let (chain, at) = Chain::new(&skeleton, &Regrouping::base(&skeleton)).posed(&position);
    Composite::new(&chain, &at).second_derivatives(inputs, CompositeOrder::Inward)
}

impl Formulation {
    /// Returns ∂τ/∂q, n×n: row i has the slopes of τ_i, joint by joint as it moves at a unit rate.
    pub fn torque_by_position<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        qd: &[S],
        qdd: &[S],
    ) -> Matrix<S> {
        let [qd, qdd] = [qd, qdd].map(|rates| constants(rates));
        columns(at.len(), &|coordinate| {
            let (arm, at) = arm.displaced(at, coordinate);
            self.inverse_dynamics(&arm, &at, &qd, &qdd)
        })
    }

    /// Returns ∂τ/∂q̇, n×n, what friction grows by on its diagonal: joint by joint as its velocity
    /// grows at a unit rate. The part of q̈ and gravity in the torques does not depend on q̇ and is
    /// left out. Lagrange–Euler has it from the symbols: Σ_m (h_ikm + h_imk) q̇_m.
    pub fn torque_by_velocity<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> Matrix<S> {
        let mut rows = if self == Self::LagrangeEuler {
            let c = contracted(&self.christoffel(arm, at), qd);
            let doubled = |row: &Vec<S>| row.iter().map(twice).collect();
            let rows: Matrix<S> = c.iter().map(doubled).collect();
            match arm.floats {
                false => rows,
                true => matrix_sum(&rows, &arm.of_drift_slopes(&self.inertia(arm, at), qd)),
            }
        } else {
            let still_arm = arm.map(still);
            let still_row = |at: &DhVariables<S>| {
                let (theta, d) = (at.theta.map(still), still(&at.d));
                DhVariables { theta, d }
            };
            let at: Vec<_> = at.iter().map(still_row).collect();
            columns(at.len(), &|joint| {
                let mut qd = constants(qd);
                qd[joint].rate = S::one();
                self.velocity_terms(&still_arm, &at, &qd)
            })
        };
        for (i, (row, link)) in rows.iter_mut().zip(&arm.links).enumerate() {
            row[i] = plus(&row[i], &link.friction.slope());
        }
        rows
    }

    /// Returns λᵀτ without friction.
    fn virtual_power<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, [qd, qdd, l]: [&[S]; 3]) -> S {
        if self == Self::LagrangeEuler {
            return LagrangeEuler::new(arm, at).virtual_power(qd, qdd, l);
        }
        let arm = arm.clone().without_friction();
        product(l, &self.inverse_dynamics(&arm, at, qd, qdd))
    }

    /// Returns ∂²(λᵀτ)/∂q∂q, symmetric.
    pub fn torque_by_positions<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        [qd, qdd, multiplier]: [&[S]; 3],
    ) -> Matrix<S> {
        if !self.has_closed_form() {
            return by_composites(arm, at, [qd, qdd, multiplier]).position;
        }
        let n = at.len();
        symmetric(n, |i, k| {
            let (arm, at) = moving(arm, at, &unit(n, i));
            let (arm, at) = moving(&arm, &at, &unit(n, k));
            let [qd, qdd, l] = [qd, qdd, multiplier].map(|x| constants(&constants(x)));
            self.virtual_power(&arm, &at, [&qd, &qdd, &l]).rate.rate
        })
    }

    /// Returns ∂²(λᵀτ)/∂q∂q̇: the slopes by velocity as one joint moves.
    pub fn torque_by_position_and_velocity<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        [qd, multiplier]: [&[S]; 2],
    ) -> Matrix<S> {
        if !self.has_closed_form() {
            return by_composites(arm, at, [qd, &zeros(qd.len()), multiplier]).mixed;
        }
        let n = at.len();
        let row = |k: usize| {
            let (arm, at) = moving(arm, at, &unit(n, k));
            let slopes = self.torque_by_velocity(&arm, &at, &constants(qd));
            rates_of(multiplier, &slopes)
        };
        (0..n).map(row).collect()
    }

    /// Returns ∂²(λᵀτ)/∂q̇∂q̇, symmetric: Lagrange–Euler from the symbols, 2 Σ_i λ_i h_ikm;
    /// elsewhere from the slopes as one velocity grows. Coulomb friction bends by itself.
    pub fn torque_by_velocities<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        [qd, multiplier]: [&[S]; 2],
    ) -> Matrix<S> {
        if !self.has_closed_form() {
            return by_composites(arm, at, [qd, &zeros(qd.len()), multiplier]).velocity;
        }
        let n = at.len();
        let mut matrix = if self == Self::LagrangeEuler {
            let h = self.christoffel(arm, at);
            let half = |k: usize, m: usize| weighed(multiplier, h.iter().map(|h| &h[k][m]));
            symmetric(n, |k, m| twice(&half(k, m)))
        } else {
            let (arm, at) = moving(arm, at, &zeros(n));
            let row = |k: usize| {
                let mut qd = constants(qd);
                qd[k].rate = S::one();
                rates_of(multiplier, &self.torque_by_velocity(&arm, &at, &qd))
            };
            (0..n).map(row).collect()
        };
        for (i, link) in arm.links.iter().enumerate() {
            let bent = times(&multiplier[i], &link.friction.curvature(&qd[i]));
            matrix[i][i] = plus(&matrix[i][i], &bent);
        }
        matrix
    }

    /// Returns ∂²(λᵀτ)/∂q̈∂q = ∂(D λ)/∂q: row i has the slopes of (D λ)_i.
    pub fn torque_by_acceleration_and_position<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        multiplier: &[S],
    ) -> Matrix<S> {
        let n = at.len();
        if !self.has_closed_form() {
            return by_composites(arm, at, [&zeros(n), &zeros(n), multiplier]).driven;
        }
        columns(n, &|k| {
            let (arm, at) = moving(arm, at, &unit(n, k));
            self.momentum(&arm, &at, &constants(multiplier))
        })
    }
}

/// The parts of the second derivatives of λᵀq̈ besides those of μᵀτ, D μ = λ: X, and the
/// joints that move. Rows and columns of those that are held are zero.
#[derive(Clone, Debug)]
pub struct OfAccelerations<'a, S> {
    /// X_ki, zero unless joints k and i move.
    x: Matrix<S>,
    moves: &'a [bool],
}

impl<'a, S: Scalar> OfAccelerations<'a, S> {
    /// Makes it from ∂(D μ)/∂q and what multiplies by D⁻¹ over the joints that move.
    pub fn new(driven: &[Vec<S>], by_inverse: impl Fn(&[S]) -> Vec<S>, moves: &'a [bool]) -> Self {
        let columns = columns_of(driven);
        let x = |k: usize| match moves[k] {
            true => by_inverse(&columns[k]),
            false => zeros(moves.len()),
        };
        OfAccelerations {
            x: (0..moves.len()).map(x).collect(),
            moves,
        }
    }

    /// Returns ∂²(λᵀq̈)/∂q∂q, from ∂²(μᵀτ)/∂q∂q and ∂τ/∂q.
    pub fn by_positions(&self, curvatures: &[Vec<S>], slopes: &[Vec<S>]) -> Matrix<S> {
        self.entries(|k, m| {
            let both = plus(&self.along(k, slopes, m), &self.along(m, slopes, k));
            minus(&both, &curvatures[k][m])
        })
    }

    /// Returns ∂²(λᵀq̈)/∂q∂q̇, from ∂²(μᵀτ)/∂q∂q̇ and ∂τ/∂q̇.
    pub fn by_position_and_velocity(&self, curvatures: &[Vec<S>], slopes: &[Vec<S>]) -> Matrix<S> {
        self.entries(|k, m| minus(&self.along(k, slopes, m), &curvatures[k][m]))
    }

    /// Returns ∂²(λᵀq̈)/∂q̇∂q̇, from ∂²(μᵀτ)/∂q̇∂q̇.
    pub fn by_velocities(&self, curvatures: &[Vec<S>]) -> Matrix<S> {
        self.entries(|k, m| negative(&curvatures[k][m]))
    }

    /// Returns ∂²(λᵀq̈)/∂τ∂q: row i has the slopes of (D⁻¹λ)_i.
    pub fn by_torque_and_position(&self) -> Matrix<S> {
        self.entries(|i, k| negative(&self.x[k][i]))
    }

    /// Returns Σ_i X_ki times the slope of τ_i by joint m.
    fn along(&self, k: usize, slopes: &[Vec<S>], m: usize) -> S {
        let moving = free(self.moves).into_iter();
        total(moving.map(|i| times(&self.x[k][i], &slopes[i][m])))
    }

    fn entries(&self, entry: impl Fn(usize, usize) -> S) -> Matrix<S> {
        let n = self.moves.len();
        matrix(n, n, |k, m| match self.moves[k] && self.moves[m] {
            true => entry(k, m),
            false => S::zero(),
        })
    }
}

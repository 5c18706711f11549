//! Dynamics in the space of the hand (Khatib, "A unified approach for motion and force
//! control of robot manipulators: the operational space formulation", 1987).
//!
//! With J of the components that are asked for, m×n:
//!
//! ```text
//! Λ⁻¹ = J D⁻¹ Jᵀ        Λ = (Λ⁻¹ + λ² 1)⁻¹        J̄ = D⁻¹ Jᵀ Λ
//! μ = Λ (J D⁻¹ (h + c) − J̇ q̇)        N = 1 − J̄ J
//! ```
//!
//! Where no more joints move than there are components, J̄ and N need no D⁻¹ (`NormalEquations`):
//!
//! ```text
//! J̄ = (Jᵀ J + λ² D)⁻¹ Jᵀ        N = (Jᵀ J + λ² D)⁻¹ λ² D
//! ```
//!
//! Λ⁻¹ is positive semidefinite: singular where J loses rank, and always where m > n.
//! With λ² > 0 the pivots of Λ⁻¹ + λ² 1 are λ² at least, and nothing divides by zero;
//! with λ² = 0 they vanish where J loses rank, and there is no Λ. Jᵀ J + λ² D is positive
//! definite where Λ exists, and with λ² = 0 also of less joints than components.

use alloc::vec::Vec;

use super::factor::{Factor, picked, placed, scatter, submatrix};
use super::following::gathered_rows;
use super::forward::free;
use super::matrix::*;
use super::{Arm, At, Formulation};
use crate::scalar::{Divide, Scalar};

/// The quantities that follow from J and D alone.
#[derive(Clone, Debug)]
pub struct TaskSpace<S> {
    /// J, m×n.
    jacobian: Matrix<S>,
    /// J D⁻¹, m×n; zero of joints that do not move.
    driven: Matrix<S>,
    /// Λ⁻¹, m×m.
    pub mobility: Matrix<S>,
}

impl<S: Divide> TaskSpace<S> {
    /// Makes it from J and D⁻¹.
    pub fn by_inverse(jacobian: Matrix<S>, inverse: &[Vec<S>]) -> TaskSpace<S> {
        // D⁻¹ is symmetric: its rows are its columns.
        let driven: Matrix<S> = jacobian.iter().map(|row| products(inverse, row)).collect();
        let mobility = symmetric(jacobian.len(), |i, k| product(&driven[i], &jacobian[k]));
        TaskSpace {
            jacobian,
            driven,
            mobility,
        }
    }

    /// Makes it from J and the factors of D over the joints that move: Λ⁻¹ = Xᵀ d⁻¹ X with X =
    /// U⁻¹ Jᵀ, which keeps the zeros of J behind the joint that a column is of.
    pub fn by_factor(jacobian: Matrix<S>, factor: &Factor<S>, moves: &[bool]) -> TaskSpace<S> {
        let joints = free(moves);
        let halves = factor.eliminated_rows(&jacobian, &joints);
        let scaled: Matrix<S> = halves.iter().map(|half| factor.scaled(half)).collect();
        let mobility = symmetric(jacobian.len(), |i, k| product(&scaled[i], &halves[k]));
        let drive = |row: Vec<S>| scatter(&factor.substituted(row), &joints, moves.len());
        TaskSpace {
            driven: scaled.into_iter().map(drive).collect(),
            jacobian,
            mobility,
        }
    }

    /// Returns Λ⁻¹ + λ² 1
    pub fn damped(&self, damping: &S) -> Matrix<S> {
        damped(&self.mobility, damping)
    }

    /// Returns Λ
    pub fn inertia(&self, damping: &S) -> Matrix<S> {
        Factor::new(&self.damped(damping)).inverse()
    }

    /// Returns J̄, n×m.
    pub fn consistent_inverse(&self, damping: &S) -> Matrix<S> {
        let factor = Factor::new(&self.damped(damping));
        // A row of J̄ is Λ times a column of J D⁻¹: Λ is symmetric.
        let columns = columns_of(&self.driven);
        columns.iter().map(|column| factor.solve(column)).collect()
    }

    /// Returns N, n×n, over the joints that move.
    pub fn null_space(&self, damping: &S, moves: &[bool]) -> Matrix<S> {
        let inverse = self.consistent_inverse(damping);
        let columns = columns_of(&self.jacobian);
        matrix(moves.len(), moves.len(), |i, k| {
            let product = product(&inverse[i], &columns[k]);
            match (moves[i] && moves[k], i == k) {
                (false, _) => S::zero(),
                (true, true) => minus(&S::one(), &product),
                (true, false) => negative(&product),
            }
        })
    }

    /// Returns μ, from J D⁻¹ (h + c) and J̇ q̇.
    pub fn bias(&self, driven: &[S], rate: &[S], damping: &S) -> Vec<S> {
        let rest = differences(driven, rate);
        Factor::new(&self.damped(damping)).solve(&rest)
    }
}

/// Jᵀ J + λ² D over the joints that move, factored: from J̄ᵀ (Λ⁻¹ + λ² 1) = (D⁻¹ Jᵀ)ᵀ follows
/// (Jᵀ J + λ² D) J̄ = Jᵀ by D from the left.
#[derive(Clone, Debug)]
pub struct NormalEquations<S> {
    jacobian: Matrix<S>,
    /// λ² D over these joints.
    damping: Matrix<S>,
    factor: Factor<S>,
    joints: Vec<usize>,
    n: usize,
}

impl<S: Divide> NormalEquations<S> {
    /// Returns `None` where more joints move than J has components: with λ² = 0 there are none.
    pub fn new(
        jacobian: &[Vec<S>],
        inertia: &[Vec<S>],
        damping: &S,
        moves: &[bool],
    ) -> Option<NormalEquations<S>> {
        let joints = free(moves);
        if jacobian.len() < joints.len() {
            return None;
        }
        let jacobian: Matrix<S> = jacobian.iter().map(|row| picked(row, &joints)).collect();
        let inertia = submatrix(inertia, &joints);
        let damping = symmetric(joints.len(), |i, k| times(damping, &inertia[i][k]));
        let columns = columns_of(&jacobian);
        let square = |i: usize, k: usize| plus(&product(&columns[i], &columns[k]), &damping[i][k]);
        Some(NormalEquations {
            factor: Factor::new(&symmetric(joints.len(), square)),
            jacobian,
            damping,
            joints,
            n: moves.len(),
        })
    }

    /// Returns J̄, n×m.
    pub fn consistent_inverse(&self) -> Matrix<S> {
        self.solved(&self.jacobian)
    }

    /// Returns N, n×n, over the joints that move.
    pub fn null_space(&self) -> Matrix<S> {
        let whole = |row: &Vec<S>| scatter(row, &self.joints, self.n);
        self.solved(&self.damping).iter().map(whole).collect()
    }

    fn solved(&self, right: &[Vec<S>]) -> Matrix<S> {
        let columns: Matrix<S> = right.iter().map(|x| self.factor.solve(x)).collect();
        let nothing = alloc::vec![zeros(right.len()); self.n];
        placed(nothing, &self.joints, columns_of(&columns))
    }
}

/// Returns a symmetric matrix with λ² added to its diagonal.
pub fn damped<S: Scalar>(matrix: &[Vec<S>], damping: &S) -> Matrix<S> {
    symmetric(matrix.len(), |i, k| match i == k {
        true => plus(&matrix[i][i], damping),
        false => matrix[i][k].clone(),
    })
}

/// Returns J D⁻¹ b, from the factors of D over the joints that move.
pub fn driven_by<S: Divide>(
    jacobian: &[Vec<S>],
    factor: &Factor<S>,
    b: &[S],
    moves: &[bool],
) -> Vec<S> {
    let joints = free(moves);
    let scaled = factor.scaled(&factor.eliminated(&picked(b, &joints)));
    products(&factor.eliminated_rows(jacobian, &joints), &scaled)
}

impl Formulation {
    /// Returns J of the components that the arm is asked for, m×n.
    pub fn task_jacobian<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Matrix<S> {
        arm.frames.rows.pick(&self.jacobian(arm, at))
    }

    /// Returns the Jacobian gathered at the leaders of joints that follow.
    pub fn gathered_jacobian<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Matrix<S> {
        gathered_rows(&arm.following, self.task_jacobian(arm, at))
    }

    /// Returns the quantities that follow from J and D.
    pub fn task_space<S: Divide>(self, arm: &Arm<S>, at: &At<S>, moves: &[bool]) -> TaskSpace<S> {
        let inverse = self.inertia_inverse(arm, at, moves);
        TaskSpace::by_inverse(self.gathered_jacobian(arm, at), &inverse)
    }

    /// Returns μ
    pub fn operational_bias<S: Divide>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        qd: &[S],
        damping: &S,
        moves: &[bool],
    ) -> Vec<S> {
        let space = self.task_space(arm, at, moves);
        // Without friction and torques the joints fall by −D⁻¹ (h + c).
        let still = zeros(qd.len());
        let free = arm.clone().without_friction();
        let falling = self.forward_dynamics(&free, at, qd, &still, moves);
        let fallen = products(&space.jacobian, &falling);
        let driven: Vec<S> = fallen.iter().map(negative).collect();
        let rate = self.jacobian_rate(arm, at, qd).concat();
        space.bias(&driven, &arm.frames.rows.pick(&rate), damping)
    }
}

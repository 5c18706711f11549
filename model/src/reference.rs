//! The generic runtime: the dynamics of any arm, without generated code.
//!
//! It evaluates the recursion of Table 2 in its most accurate form
//! ([`Moment::Differences`]) in f64 or f32, with nalgebra vectors at its surface. Generated code is checked against it.

use alloc::vec::Vec;
use core::fmt;

use nalgebra::{DMatrix, DVector};

use crate::equations::newton_euler::table2::{self, Moment};
use crate::equations::{Arm, DhVariables, JointPosition, Rotor, from_torques};
use crate::number::{Exact, Rounded};
use crate::robot::{JointKind, Robot};
use crate::scalar::Scalar;

/// The floats that a [`Reference`] computes in: f64 and f32.
pub trait Float: Scalar + Rounded + fmt::Debug + sealed::Sealed + 'static {
    /// sin and cos, within an ulp at every size.
    fn sin_cos(self) -> (Self, Self);
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for f32 {}
}

impl Float for f64 {
    fn sin_cos(self) -> (f64, f64) {
        libm::sincos(self)
    }
}

impl Float for f32 {
    fn sin_cos(self) -> (f32, f32) {
        libm::sincosf(self)
    }
}

/// A vector of joint values that is not as long as the arm has joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WrongLength {
    /// Which argument: `"q"`, `"qd"` or `"qdd"`.
    pub argument: &'static str,
    /// The number of joints.
    pub expected: usize,
    /// The length given.
    pub found: usize,
}

impl fmt::Display for WrongLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let WrongLength {
            argument,
            expected,
            found,
        } = self;
        write!(
            f,
            "`{argument}` has {found} values, the arm has {expected} joints"
        )
    }
}

impl core::error::Error for WrongLength {}

/// The dynamics of one arm in floating point.
///
/// All vectors are of length n, from the base to the hand: q in rad or m, q̇
/// and q̈ in the same per second, torques in N·m, or N at a prismatic joint.
/// A vector of another length is a [`WrongLength`] error; NaN and infinities
/// spread to the outputs.
///
/// ```
/// use dalembert_model::equations::{Arm, Link, Rotor};
/// use dalembert_model::reference::Reference;
/// use dalembert_model::robot::{Convention, Inertia, JointKind};
/// use nalgebra::DVector;
///
/// // A pendulum of 1 kg at 0.5 m, swinging in the x-y plane.
/// let straight = Rotor { sin: 0.0, cos: 1.0 };
/// let arm = Arm {
///     convention: Convention::Standard,
///     gravity: [0.0, -9.81, 0.0],
///     links: vec![Link {
///         kind: JointKind::Revolute,
///         alpha: straight.clone(),
///         theta: straight,
///         a: 0.5,
///         d: 0.0,
///         mass: 1.0,
///         com: [0.0; 3],
///         inertia: Inertia::default(),
///         viscous: 0.1,
///         armature: 0.0,
///     }],
/// };
/// let pendulum = Reference::new(arm);
/// let [q, qd, qdd] = [0.0, 2.0, 4.0].map(|x| DVector::from_element(1, x));
/// let tau = pendulum.inverse_dynamics(&q, &qd, &qdd)?;
/// assert_eq!(tau[0], 0.25 * 4.0 + 0.5 * 9.81 + 0.1 * 2.0);
/// # Ok::<(), dalembert_model::reference::WrongLength>(())
/// ```
#[derive(Clone, Debug)]
pub struct Reference<T> {
    arm: Arm<T>,
}

impl<T: Float> Reference<T> {
    /// The dynamics of an arm; lengths without effect are folded away first
    /// ([`Arm::fold_base`]).
    pub fn new(arm: Arm<T>) -> Self {
        Reference {
            arm: arm.fold_base(),
        }
    }

    /// The dynamics of a robot, each parameter rounded once.
    pub fn from_robot(robot: &Robot) -> Self {
        // Folded while exact: sin α of a parallel axis is zero here, not small.
        let exact: Arm<Exact> = Arm::from_robot(robot, &mut Exact::clone);
        Reference {
            arm: exact.fold_base().map(T::nearest),
        }
    }

    /// The arm as it is computed with.
    pub fn arm(&self) -> &Arm<T> {
        &self.arm
    }

    /// n
    pub fn joints(&self) -> usize {
        self.arm.links.len()
    }

    /// τ = D q̈ + h + c + b∘q̇.
    pub fn inverse_dynamics(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        qdd: &DVector<T>,
    ) -> Result<DVector<T>, WrongLength> {
        let at = self.at(q)?;
        let [qd, qdd] = [self.values("qd", qd)?, self.values("qdd", qdd)?];
        let tau = torques(&self.arm, &at, qd, qdd);
        Ok(DVector::from_vec(tau))
    }

    /// D, n×n, symmetric, armature on its diagonal.
    pub fn inertia(&self, q: &DVector<T>) -> Result<DMatrix<T>, WrongLength> {
        let at = self.at(q)?;
        Ok(matrix(&from_torques::inertia(torques, &self.arm, &at)))
    }

    /// h: Coriolis and centrifugal torques, without damping.
    pub fn coriolis(&self, q: &DVector<T>, qd: &DVector<T>) -> Result<DVector<T>, WrongLength> {
        let at = self.at(q)?;
        let qd = self.values("qd", qd)?;
        let h = from_torques::velocity_terms(torques, &self.arm, &at, qd);
        Ok(DVector::from_vec(h))
    }

    /// c: what holds the arm against gravity.
    pub fn gravity(&self, q: &DVector<T>) -> Result<DVector<T>, WrongLength> {
        let at = self.at(q)?;
        let c = from_torques::gravity(torques, &self.arm, &at);
        Ok(DVector::from_vec(c))
    }

    /// h_ikm: for each joint i the symmetric n×n matrix with
    /// h_i = Σ_k Σ_m h_ikm q̇_k q̇_m.
    pub fn christoffel(&self, q: &DVector<T>) -> Result<Vec<DMatrix<T>>, WrongLength> {
        let at = self.at(q)?;
        let h = from_torques::christoffel(torques, &self.arm, &at);
        Ok(h.iter().map(|h| matrix(h)).collect())
    }

    fn at(&self, q: &DVector<T>) -> Result<Vec<DhVariables<T>>, WrongLength> {
        let q = self.values("q", q)?;
        let position = |(link, q): (&crate::equations::Link<T>, &T)| match link.kind {
            JointKind::Revolute => {
                let (sin, cos) = q.sin_cos();
                JointPosition::Revolute(Rotor { sin, cos })
            }
            JointKind::Prismatic => JointPosition::Prismatic(*q),
        };
        let position: Vec<_> = self.arm.links.iter().zip(q).map(position).collect();
        Ok(self.arm.at(&position))
    }

    fn values<'a>(
        &self,
        argument: &'static str,
        vector: &'a DVector<T>,
    ) -> Result<&'a [T], WrongLength> {
        let [expected, found] = [self.joints(), vector.len()];
        if found != expected {
            return Err(WrongLength {
                argument,
                expected,
                found,
            });
        }
        Ok(vector.as_slice())
    }
}

fn torques<T: Float>(arm: &Arm<T>, at: &[DhVariables<T>], qd: &[T], qdd: &[T]) -> Vec<T> {
    table2::inverse_dynamics(arm, at, qd, qdd, Moment::Differences, None)
}

fn matrix<T: Float>(rows: &[Vec<T>]) -> DMatrix<T> {
    DMatrix::from_fn(rows.len(), rows.len(), |i, k| rows[i][k])
}

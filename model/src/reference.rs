//! The generic runtime: the dynamics of any arm, without generated code.
//!
//! It evaluates the recursion of Table 2 in its most accurate form
//! ([`Moment::Differences`]) in f64 or f32, with nalgebra vectors at its surface.
//! Generated code is checked against it. `derivatives` has its slopes,
//! `forward` what motions torques bring about, `regressor` what each parameter
//! takes of them.

mod derivatives;
mod forward;
mod regressor;

use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::fmt;

use nalgebra::{DMatrix, DVector};

use crate::equations::dalembert::Part;
use crate::equations::energy::contracted;
use crate::equations::kinematics::poses;
use crate::equations::load::Loading;
use crate::equations::matrix::{Columns, total};
use crate::equations::newton_euler::Wrench;
use crate::equations::newton_euler::table2::{self, Moment};
use crate::equations::regressor::Column;
use crate::equations::{Arm, DhVariables, Formulation, JointPosition, SinCosPair, from_torques};
use crate::number::{Exact, Rounded};
use crate::robot::{JointKind, Robot};
use crate::scalar::{Divide, Scalar};

/// The floats that a [`Reference`] computes in: f64 and f32.
pub trait Float: Divide + Rounded + fmt::Debug + sealed::Sealed + 'static {
    /// sin and cos, within an ulp at every size.
    fn sin_cos(self) -> (Self, Self);
    /// The square root, correctly rounded.
    fn root(self) -> Self;
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
    fn root(self) -> f64 {
        libm::sqrt(self)
    }
}

impl Float for f32 {
    fn sin_cos(self) -> (f32, f32) {
        libm::sincosf(self)
    }
    fn root(self) -> f32 {
        libm::sqrtf(self)
    }
}

/// A vector of joint values that is not as long as the arm has joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WrongLength {
    /// The argument's name, such as `"qd"`.
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

/// The joint vectors that the outputs of an arm depend on.
#[derive(Clone, Debug)]
pub struct JointVectors<T> {
    /// Positions.
    pub q: DVector<T>,
    /// Velocities.
    pub qd: DVector<T>,
    /// Accelerations.
    pub qdd: DVector<T>,
    /// Torques.
    pub tau: DVector<T>,
    /// Velocities wished for.
    pub v: DVector<T>,
    /// Accelerations wished for.
    pub a: DVector<T>,
    /// What the columns of a regressor are; none where it is not asked for.
    pub columns: Vec<Column<T>>,
    /// What the hand carries, where a load is asked for.
    pub loading: Option<Loading<T>>,
}

impl<T> JointVectors<T> {
    /// From the entries of each argument, in the order of signatures: q, q̇, q̈,
    /// τ, v and a; of those that nothing reads none.
    pub fn new([q, qd, qdd, tau, v, a]: [DVector<T>; 6]) -> Self {
        JointVectors {
            q,
            qd,
            qdd,
            tau,
            v,
            a,
            columns: Vec::new(),
            loading: None,
        }
    }
}

/// The dynamics of one arm in floating point.
///
/// All vectors are of length n, from the base to the hand: q in rad or m, q̇
/// and q̈ in the same per second, torques in N·m, or N at a prismatic joint.
/// A vector of another length is a [`WrongLength`] error; NaN and infinities
/// spread to the outputs.
///
/// ```
/// use dalembert_model::equations::friction::Friction;
/// use dalembert_model::equations::{Arm, Link, SinCosPair};
/// use dalembert_model::reference::Reference;
/// use dalembert_model::robot::{Convention, Inertia, JointKind};
/// use nalgebra::DVector;
///
/// // A pendulum of 1 kg at 0.5 m, swinging in the x-y plane.
/// let straight = SinCosPair { sin: 0.0, cos: 1.0 };
/// let arm = Arm {
///     convention: Convention::Standard,
///     gravity: [0.0, -9.81, 0.0],
///     base: None,
///     tool: None,
///     links: vec![Link {
///         kind: JointKind::Revolute,
///         alpha: straight.clone(),
///         beta: None,
///         theta: straight,
///         a: 0.5,
///         d: 0.0,
///         mass: 1.0,
///         com: [0.0; 3],
///         inertia: Inertia::default(),
///         friction: Friction { viscous: 0.1, coulomb: None },
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
    /// Without the lengths that no torque depends on.
    arm: Arm<T>,
    /// With them: where things are depends on all.
    whole: Arm<T>,
}

impl<T: Float> Reference<T> {
    /// The dynamics of an arm; lengths without effect are folded away first
    /// ([`Arm::fold_base`]).
    pub fn new(arm: Arm<T>) -> Self {
        Reference {
            arm: arm.clone().fold_base(),
            whole: arm,
        }
    }

    /// The dynamics of a robot, each parameter rounded once.
    pub fn from_robot(robot: &Robot) -> Self {
        // Folded while exact: sin α of a parallel axis is zero here, not small.
        let exact: Arm<Exact> = Arm::from_robot(robot, &mut Exact::clone);
        Reference {
            whole: exact.map(T::nearest),
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

    /// τ = D q̈ + h + c + (b + F∘r)∘q̇, r_i = 1/√(q̇_i² + w_i²).
    pub fn inverse_dynamics(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        qdd: &DVector<T>,
    ) -> Result<DVector<T>, WrongLength> {
        let at = self.at(q)?;
        let [qd, qdd] = [self.values("qd", qd)?, self.values("qdd", qdd)?];
        let tau = torques(&self.arm_at(qd), &at, qd, qdd);
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

    /// p = D q̇.
    pub fn momentum(&self, q: &DVector<T>, qd: &DVector<T>) -> Result<DVector<T>, WrongLength> {
        let at = self.at(q)?;
        let qd = self.values("qd", qd)?;
        let d = from_torques::inertia(torques, &self.arm, &at);
        let row = |row: &Vec<T>| total(row.iter().zip(qd).map(|(d, qd)| d.mul(qd)));
        Ok(DVector::from_vec(d.iter().map(row).collect()))
    }

    /// T = ½ q̇ᵀ D q̇.
    pub fn kinetic_energy(&self, q: &DVector<T>, qd: &DVector<T>) -> Result<T, WrongLength> {
        let p = self.momentum(q, qd)?;
        Ok(total(p.iter().zip(qd.iter()).map(|(p, qd)| p.mul(qd))).half())
    }

    /// ∂T/∂q = Cᵀ q̇.
    pub fn momentum_slope(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
    ) -> Result<DVector<T>, WrongLength> {
        let c = self.coriolis_matrix(q, qd)?;
        let column = |k| total((0..qd.len()).map(|i| c[(i, k)].mul(&qd[i])));
        Ok(DVector::from_vec((0..qd.len()).map(column).collect()))
    }

    /// C, n×n: C_ik = Σ_m h_ikm q̇_m, so that C q̇ = h and Ḋ − 2C is skew.
    pub fn coriolis_matrix(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
    ) -> Result<DMatrix<T>, WrongLength> {
        let at = self.at(q)?;
        let qd = self.values("qd", qd)?;
        let h = from_torques::christoffel(torques, &self.arm, &at);
        Ok(matrix(&contracted(&h, qd)))
    }

    /// U = −Σ_j m_j g·r_j, from the base's origin.
    pub fn potential_energy(&self, q: &DVector<T>) -> Result<T, WrongLength> {
        let at = self.whole_at(q)?;
        Ok(Formulation::NewtonEulerLink.potential_energy(&self.whole, &at))
    }

    /// ⁰A_n: where the hand is.
    pub fn hand(&self, q: &DVector<T>) -> Result<Columns<T>, WrongLength> {
        let at = self.whole_at(q)?;
        Ok(Formulation::NewtonEulerLink.hand(&self.whole, &at))
    }

    /// ⁰A_i: where every link is.
    pub fn poses(&self, q: &DVector<T>) -> Result<Vec<Columns<T>>, WrongLength> {
        Ok(poses(&self.whole, &self.whole_at(q)?))
    }

    /// J, 6×n: linear over angular velocity of frame n, in base axes.
    pub fn jacobian(&self, q: &DVector<T>) -> Result<Vec<Vec<T>>, WrongLength> {
        let at = self.whole_at(q)?;
        Ok(Formulation::NewtonEulerLink.jacobian(&self.whole, &at))
    }

    /// J̇ q̇, linear over angular.
    pub fn jacobian_rate(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
    ) -> Result<[[T; 3]; 2], WrongLength> {
        let at = self.whole_at(q)?;
        let qd = self.values("qd", qd)?;
        Ok(Formulation::NewtonEulerLink.jacobian_rate(&self.whole, &at, qd))
    }

    /// What each link exerts on the next, gravity included, in base axes, about
    /// the origin of the frame whose z is the joint's axis.
    pub fn wrenches(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        qdd: &DVector<T>,
    ) -> Result<Vec<Wrench<T>>, WrongLength> {
        let at = self.whole_at(q)?;
        let [qd, qdd] = [self.values("qd", qd)?, self.values("qdd", qdd)?];
        Ok(Formulation::NewtonEulerLink.wrenches(&self.whole, &at, qd, qdd))
    }

    /// The dynamics by which parts of the links: of their rotation alone, or
    /// their translation alone.
    pub fn part(&self, part: Part) -> Reference<T> {
        Reference {
            arm: part.of(&self.arm),
            whole: part.of(&self.whole),
        }
    }

    /// The arm with its Coulomb friction at these velocities.
    fn arm_at(&self, qd: &[T]) -> Cow<'_, Arm<T>> {
        let links = &self.arm.links;
        if links.iter().all(|link| link.friction.coulomb.is_none()) {
            return Cow::Borrowed(&self.arm);
        }
        let speeds = links.iter().zip(qd);
        let speeds = speeds.map(|(link, qd)| link.friction.per_speed(qd, |x| x.root()));
        let speeds: Vec<Option<T>> = speeds.collect();
        Cow::Owned(self.arm.clone().at_speeds(&speeds))
    }

    fn at(&self, q: &DVector<T>) -> Result<Vec<DhVariables<T>>, WrongLength> {
        Ok(self.arm.at(&self.positions(q)?))
    }

    fn whole_at(&self, q: &DVector<T>) -> Result<Vec<DhVariables<T>>, WrongLength> {
        Ok(self.whole.at(&self.positions(q)?))
    }

    fn positions(&self, q: &DVector<T>) -> Result<Vec<JointPosition<T>>, WrongLength> {
        let q = self.values("q", q)?;
        let position = |(link, q): (&crate::equations::Link<T>, &T)| match link.kind {
            JointKind::Revolute => {
                let (sin, cos) = q.sin_cos();
                JointPosition::Revolute(SinCosPair { sin, cos })
            }
            JointKind::Prismatic => JointPosition::Prismatic(*q),
        };
        Ok(self.arm.links.iter().zip(q).map(position).collect())
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

fn torques<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>], qd: &[S], qdd: &[S]) -> Vec<S> {
    table2::inverse_dynamics(arm, at, qd, qdd, Moment::Differences, None)
}

fn matrix<T: Float>(rows: &[Vec<T>]) -> DMatrix<T> {
    DMatrix::from_fn(rows.len(), rows.len(), |i, k| rows[i][k])
}

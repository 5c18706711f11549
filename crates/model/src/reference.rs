//! The generic runtime: the dynamics of any arm, without generated code.
//!
//! It evaluates the formulas of [`outputs`](crate::outputs) as textbooks have them, by the
//! recursion of Table 2 in its most accurate form ([`Formulation::NewtonEulerLinkDifferences`]), in
//! f64 or f32, with nalgebra vectors at its surface. Generated code is checked against it.

use alloc::borrow::Cow;
use alloc::format;
use alloc::vec::Vec;
use core::fmt;

use nalgebra::{DMatrix, DVector};

use crate::diagnostic::Diagnostic;
use crate::equations::kinematics::poses;
use crate::equations::load::LoadArguments;
use crate::equations::matrix::{Columns, zeros};
use crate::equations::regressor::{Column, of_links};
use crate::equations::{
    Arm, DhVariables, Formulation, JointPosition, Link, SinCosPair, base_position,
};
use crate::number::{Exact, Rounded};
use crate::outputs::{Argument, Axis, Motion, Quantity, Sizes, Written};
use crate::robot::{JointKind, Robot, limb_starts};
use crate::scalar::Divide;

/// The floats that a [`Reference`] computes in: f64 and f32.
pub trait Float: Divide + Rounded + fmt::Debug + sealed::Sealed + 'static {
    /// Returns sin and cos, within an ulp at every size.
    fn sin_cos(self) -> (Self, Self);
    /// Returns the square root, correctly rounded.
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

/// The vectors that the outputs of an arm depend on.
#[derive(Clone, Debug)]
pub struct JointVectors<T> {
    /// By the [index](Argument::index) of their arguments.
    by_argument: [DVector<T>; Argument::COUNT],
    /// The columns of a regressor; none where it is not asked for.
    pub columns: Vec<Column<T>>,
    /// The payload at the hand, where a load is asked for.
    pub loading: Option<LoadArguments<T>>,
}

impl<T: Float> JointVectors<T> {
    /// Makes a state from the entries of those arguments that something reads and no arm has.
    pub fn new(vectors: impl IntoIterator<Item = (Argument, DVector<T>)>) -> Self {
        let mut by_argument = Argument::ALL.map(|_| DVector::from_vec(Vec::new()));
        for (argument, vector) in vectors {
            by_argument[argument.index()] = vector;
        }
        JointVectors {
            by_argument,
            columns: Vec::new(),
            loading: None,
        }
    }
}

/// The dynamics of one arm in floating point.
///
/// All vectors are of length n, from the base to the hand: q in rad or m, q̇ and q̈ in the same per
/// second, torques in N·m, or N at a prismatic joint. Where the base floats, all but q have six
/// entries of it first, linear over angular in its axes, and the arm's gravity is in these. A vector of another length is a
/// [`Diagnostic`]; NaN and infinities spread to the outputs.
///
/// ```
/// use dalembert_model::equations::frames::Frames;
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
///     floats: false,
///     links: vec![Link {
///         parent: None,
///         kind: JointKind::Revolute,
///         place: None,
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
///     following: Vec::new(),
///     frames: Frames::default(),
/// };
/// let pendulum = Reference::new(arm);
/// let [q, qd, qdd] = [0.0, 2.0, 4.0].map(|x| DVector::from_element(1, x));
/// let tau = pendulum.inverse_dynamics(&q, &qd, &qdd)?;
/// assert_eq!(tau[0], 0.25 * 4.0 + 0.5 * 9.81 + 0.1 * 2.0);
/// # Ok::<(), dalembert_model::diagnostic::Diagnostic>(())
/// ```
#[derive(Clone, Debug)]
pub struct Reference<T> {
    /// Without the lengths that no torque depends on.
    arm: Arm<T>,
    /// With them: where things are depends on all.
    whole: Arm<T>,
}

impl<T: Float> Reference<T> {
    /// Returns the dynamics of an arm; lengths without effect are [folded](Arm::fold_base) away.
    pub fn new(whole: Arm<T>) -> Self {
        let arm = whole.clone().fold_base();
        Reference { arm, whole }
    }

    /// Returns the dynamics of a robot, each parameter rounded once.
    pub fn from_robot(robot: &Robot) -> Self {
        // Folded while exact: sin α of a parallel axis is zero here, not small.
        let exact: Arm<Exact> = Arm::from_robot(robot, &mut Exact::clone);
        let whole = exact.map(T::nearest);
        let arm = exact.fold_base().map(T::nearest);
        Reference { arm, whole }
    }

    /// Returns the arm as it is computed with.
    pub fn arm(&self) -> &Arm<T> {
        &self.arm
    }

    /// Returns n, without the joints that follow others.
    pub fn joints(&self) -> usize {
        self.coordinates() - self.arm.base_joints()
    }

    /// Returns the number of coordinates of a velocity: six of a base that floats, then n.
    pub fn coordinates(&self) -> usize {
        self.arm.links.len() - self.arm.following.len()
    }

    /// Computes the entries of a quantity, row by row, by its own formula.
    ///
    /// A full regressor is over all parameters of all links; any other takes its columns from `at`.
    ///
    /// # Errors
    /// A vector that the quantity depends on has another length than the arm has joints.
    pub fn entries(&self, quantity: Quantity, at: &JointVectors<T>) -> Result<Vec<T>, Diagnostic> {
        use Argument::{Armature, Bodies, Gravity, Load, Payload, Position, Viscous};
        let vector = |argument: Argument| &at.by_argument[argument.index()];
        let q = self.positions(self.values(Position, vector(Position))?);
        let mut by_argument = Argument::ALL.map(|_| Vec::new());
        for (argument, values) in Argument::ALL.into_iter().zip(&mut by_argument) {
            *values = match argument {
                Gravity | Load | Bodies | Armature | Viscous | Payload => continue,
                _ if quantity.arguments().contains(&argument) => {
                    self.values(argument, vector(argument))?.to_vec()
                }
                _ => zeros(argument.length(self.sizes())),
            };
        }
        let mut motion = Motion::new(q, |argument| {
            core::mem::take(&mut by_argument[argument.index()])
        });
        motion.loading.clone_from(&at.loading);
        let is_of_whole = quantity.facts().depends_on_base;
        let arm = if is_of_whole { &self.whole } else { &self.arm };
        let motion = motion.of_rows(&arm.following);
        let arm = at_speeds(arm, &motion.qd);
        let columns = match quantity.shape().0.contains(&Axis::LinkParameters) {
            true => &of_links(&arm),
            false => &at.columns,
        };
        let values = quantity.written(&Written {
            formulation: Formulation::NewtonEulerLinkDifferences,
            at: &arm.at(&motion.q),
            arm: &arm,
            motion: &motion,
            columns,
        });
        let rows: Vec<usize> = (0..arm.links.len()).collect();
        let mut sizes = self.sizes();
        sizes.base = columns.len();
        Ok(quantity.selected(values, [&rows, &self.rows()], &arm.following, sizes))
    }

    /// Computes τ = D q̈ + h + c + (b + F∘r)∘q̇, r_i = 1/√(q̇_i² + w_i²).
    ///
    /// # Errors
    /// A vector has another length than the arm has joints.
    pub fn inverse_dynamics(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        qdd: &DVector<T>,
    ) -> Result<DVector<T>, Diagnostic> {
        self.vector(Quantity::Torque, [q, qd, qdd])
    }

    /// Computes q̈ = D⁻¹ (τ − h − c − (b + F∘r)∘q̇): infinities and NaN where D is singular.
    ///
    /// # Errors
    /// A vector has another length than the arm has joints.
    pub fn forward_dynamics(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        tau: &DVector<T>,
    ) -> Result<DVector<T>, Diagnostic> {
        self.vector(Quantity::Acceleration, [q, qd, tau])
    }

    /// Computes D, n×n, symmetric, armature on its diagonal.
    ///
    /// # Errors
    /// `q` has another length than the arm has joints.
    pub fn inertia(&self, q: &DVector<T>) -> Result<DMatrix<T>, Diagnostic> {
        let d = self.vector(Quantity::Inertia, [q])?;
        Ok(self.matrix(d.as_slice()))
    }

    /// Computes h, the Coriolis and centrifugal torques, without damping.
    ///
    /// # Errors
    /// A vector has another length than the arm has joints.
    pub fn coriolis(&self, q: &DVector<T>, qd: &DVector<T>) -> Result<DVector<T>, Diagnostic> {
        self.vector(Quantity::Coriolis, [q, qd])
    }

    /// Computes c, what holds the arm against gravity.
    ///
    /// # Errors
    /// `q` has another length than the arm has joints.
    pub fn gravity(&self, q: &DVector<T>) -> Result<DVector<T>, Diagnostic> {
        self.vector(Quantity::Gravity, [q])
    }

    /// Computes h_ikm: for each joint i a symmetric n×n matrix, h_i = Σ_k Σ_m h_ikm q̇_k q̇_m.
    ///
    /// # Errors
    /// `q` has another length than the arm has joints.
    pub fn christoffel(&self, q: &DVector<T>) -> Result<Vec<DMatrix<T>>, Diagnostic> {
        let h = self.vector(Quantity::Christoffel, [q])?;
        let n = self.coordinates();
        let matrices = h.as_slice().chunks(n * n);
        Ok(matrices.map(|h| self.matrix(h)).collect())
    }

    /// Computes U = −Σ_j m_j g·r_j, from the base's origin.
    ///
    /// # Errors
    /// `q` has another length than the arm has joints.
    pub fn potential_energy(&self, q: &DVector<T>) -> Result<T, Diagnostic> {
        let at = self.whole_at(q)?;
        Ok(Formulation::NewtonEulerLink.potential_energy(&self.whole, &at))
    }

    /// Computes ⁰A_n: where the hand is.
    ///
    /// # Errors
    /// `q` has another length than the arm has joints.
    pub fn hand(&self, q: &DVector<T>) -> Result<Columns<T>, Diagnostic> {
        let at = self.whole_at(q)?;
        Ok(Formulation::NewtonEulerLink.hand(&self.whole, &at))
    }

    /// Computes ⁰A_i: where every row's frame is; where the base floats, in its axes.
    ///
    /// # Errors
    /// `q` has another length than the arm has joints.
    pub fn poses(&self, q: &DVector<T>) -> Result<Vec<Columns<T>>, Diagnostic> {
        let mut poses = poses(&self.whole, &self.whole_at(q)?);
        Ok(poses.split_off(self.whole.base_joints()))
    }

    fn vector<const N: usize>(
        &self,
        quantity: Quantity,
        vectors: [&DVector<T>; N],
    ) -> Result<DVector<T>, Diagnostic> {
        let arguments = quantity.arguments().iter().copied();
        let at = JointVectors::new(arguments.zip(vectors.map(Clone::clone)));
        self.entries(quantity, &at).map(DVector::from_vec)
    }

    fn sizes(&self) -> Sizes {
        let (base, rows) = (self.arm.base_joints(), self.rows());
        let limbs = (base..self.arm.links.len()).map(|row| {
            let followed = self.arm.following.iter().find(|line| line.row == row);
            let mover = followed.map_or(row, |follower| follower.leader);
            let carrier = self.arm.carrier(row);
            let joint = rows.binary_search(&mover).unwrap_or_default();
            (carrier.and_then(|row| row.checked_sub(base)), joint - base)
        });
        let limbs = if base > 0 { limb_starts(limbs) } else { 0 };
        Sizes::floating(base, self.joints(), limbs)
    }

    fn whole_at(&self, q: &DVector<T>) -> Result<Vec<DhVariables<T>>, Diagnostic> {
        let q = self.values(Argument::Position, q)?;
        let motion = Motion::new(self.positions(q), |_| zeros(self.coordinates()))
            .of_rows(&self.whole.following);
        Ok(self.whole.at(&motion.q))
    }

    fn matrix(&self, rows: &[T]) -> DMatrix<T> {
        DMatrix::from_row_slice(self.coordinates(), self.coordinates(), rows)
    }

    fn positions(&self, q: &[T]) -> Vec<JointPosition<T>> {
        let position = |(row, q): (usize, &T)| match self.arm.links[row].kind {
            JointKind::Revolute => {
                let (sin, cos) = q.sin_cos();
                JointPosition::Revolute(SinCosPair { sin, cos })
            }
            JointKind::Prismatic => JointPosition::Prismatic(*q),
        };
        let base = self.arm.base_joints();
        let rows = self.rows().into_iter().skip(base);
        let fixed = base_position().into_iter().take(base);
        fixed.chain(rows.zip(q).map(position)).collect()
    }

    fn rows(&self) -> Vec<usize> {
        let mut rows: Vec<usize> = (0..self.arm.links.len()).collect();
        rows.retain(|row| self.arm.following.iter().all(|line| line.row != *row));
        rows
    }

    fn values<'a>(
        &self,
        argument: Argument,
        vector: &'a DVector<T>,
    ) -> Result<&'a [T], Diagnostic> {
        let [expected, count] = [argument.length(self.sizes()), vector.len()];
        if count == expected {
            return Ok(vector.as_slice());
        }
        let name = argument.name();
        let message = format!("`{name}` has {count} values, the arm has {expected} joints");
        Err(Diagnostic::error(message))
    }
}

fn at_speeds<'a, T: Float>(arm: &'a Arm<T>, qd: &[T]) -> Cow<'a, Arm<T>> {
    let links = arm.links.iter();
    if links.clone().all(|link| link.friction.coulomb.is_none()) {
        return Cow::Borrowed(arm);
    }
    let at_speed = |(link, qd): (&Link<T>, &T)| link.friction.per_speed(qd, |x| x.root());
    let speeds: Vec<_> = links.zip(qd).map(at_speed).collect();
    Cow::Owned(arm.clone().at_speeds(&speeds))
}

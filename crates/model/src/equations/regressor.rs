//! Y in τ = Y π: what one unit of an inertial parameter alone takes of torque.
//!
//! Torques are linear in the mass, the first moments and the tensor about a fixed origin of every
//! link, in the rotors' inertias and in the coefficients of viscous friction. A column of Y is
//! therefore the torque of an arm that has nothing but that parameter. Its velocities and
//! accelerations are the same for all columns; [`super::chain`] shares them. Here each column comes
//! from any formulation of inverse dynamics, and the two check each other.

use alloc::vec::Vec;

use super::chain::body::{MomentBody, entry};
pub use super::chain::{Column, Probed};
use super::factor::scatter;
use super::matrix::*;
use super::{Arm, At, Formulation, Link};
use crate::robot::{Inertia, Robot};
use crate::scalar::Scalar;

/// An inertial parameter of a link, about the origin and in the axes of the link's own frame, as
/// poses of links have it; the tensor's entries as they stand in the matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LinkParameter {
    /// m
    Mass,
    /// A component of ∫ r dm.
    First(usize),
    /// An entry of the tensor, row ≤ column.
    Tensor(usize, usize),
}

impl LinkParameter {
    /// In the order of the columns of a full regressor.
    pub const ALL: [LinkParameter; 10] = [
        LinkParameter::Mass,
        LinkParameter::First(0),
        LinkParameter::First(1),
        LinkParameter::First(2),
        LinkParameter::Tensor(0, 0),
        LinkParameter::Tensor(1, 1),
        LinkParameter::Tensor(2, 2),
        LinkParameter::Tensor(0, 1),
        LinkParameter::Tensor(1, 2),
        LinkParameter::Tensor(0, 2),
    ];

    /// The number of parameters of a link.
    pub const COUNT: usize = Self::ALL.len();

    /// Returns its name without the link's number.
    pub fn name(self) -> &'static str {
        match self {
            LinkParameter::Mass => "m",
            LinkParameter::First(axis) => ["mx", "my", "mz"][axis.min(2)],
            LinkParameter::Tensor(row, column) => [
                ["Ixx", "Ixy", "Ixz"],
                ["Ixy", "Iyy", "Iyz"],
                ["Ixz", "Iyz", "Izz"],
            ][row.min(2)][column.min(2)],
        }
    }

    /// Returns a body with a unit of it and nothing else.
    pub fn unit<S: Scalar>(self) -> MomentBody<S> {
        let mut body = MomentBody::zero();
        match self {
            LinkParameter::Mass => body.mass = S::one(),
            LinkParameter::First(axis) => body.first[axis] = S::one(),
            LinkParameter::Tensor(row, column) => {
                let mut link = Link::still();
                link.inertia = Inertia::symmetric(|i, k| match (i, k) == (row, column) {
                    true => S::one(),
                    false => S::zero(),
                });
                body = MomentBody::of(&link);
            }
        }
        body
    }

    /// Returns its value for a body.
    pub fn of_body<S: Scalar>(self, body: &MomentBody<S>) -> S {
        match self {
            LinkParameter::Mass => body.mass.clone(),
            LinkParameter::First(axis) => body.first[axis].clone(),
            LinkParameter::Tensor(row, column) => entry(&body.tensor(), row, column).clone(),
        }
    }
}

/// Returns the columns of a full regressor: every parameter of every link, link by link.
pub fn of_links<S: Scalar>(arm: &Arm<S>) -> Vec<Column<S>> {
    let of = |joint| {
        let frame = arm.frames.of_link(joint);
        let in_row = move |unit: MomentBody<S>| match frame {
            None => unit,
            Some(frame) => unit.carried(&transposed(&frame.axes), &frame.origin),
        };
        LinkParameter::ALL.map(|parameter| Column {
            joint,
            of: Probed::Body(in_row(parameter.unit())),
        })
    };
    (arm.first_body()..arm.links.len()).flat_map(of).collect()
}

impl<S: Scalar> Arm<S> {
    /// Returns the body of a link, about the origin and in the axes of the link's own frame.
    pub fn body(&self, joint: usize) -> MomentBody<S> {
        let body = MomentBody::of(&self.links[joint]);
        match self.frames.of_link(joint) {
            None => body,
            Some(frame) => body.moved(&opposite(&frame.origin)).turned(&frame.axes),
        }
    }

    /// Returns every parameter of every link, in the order of [`of_links`].
    pub fn parameters(&self) -> Vec<S> {
        let of_link = |joint| {
            let body = self.body(joint);
            LinkParameter::ALL.map(|parameter| parameter.of_body(&body))
        };
        let bodies = self.first_body()..self.links.len();
        bodies.flat_map(of_link).collect()
    }
}

/// Returns the columns of the drives that a robot has: rotors' inertias, then viscous friction.
pub fn of_drives<S>(robot: &Robot) -> Vec<Column<S>> {
    use num_traits::Zero;
    let joints = || (robot.base_coordinates()..).zip(robot.rows());
    let armatures = joints().filter(|(_, joint)| !joint.armature.is_zero());
    let viscous = joints().filter(|(_, joint)| !joint.viscous.is_zero());
    let armatures = armatures.map(|(joint, _)| (joint, Probed::Armature));
    let drives = armatures.chain(viscous.map(|(joint, _)| (joint, Probed::Viscous)));
    drives.map(|(joint, of)| Column { joint, of }).collect()
}

impl Formulation {
    /// Returns a regressor, n rows, each column as the difference of the torques of two arms.
    pub fn regressor<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        qd: &[S],
        qdd: &[S],
        columns: &[Column<S>],
    ) -> Matrix<S> {
        by_differences(arm, columns, [qd, qdd], |arm| {
            self.inverse_dynamics(arm, at, qd, qdd)
        })
    }

    /// Computes the regressor of D a + C v + c + b∘v.
    pub fn passivity_regressor<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        qd: &[S],
        [v, a]: [&[S]; 2],
        columns: &[Column<S>],
    ) -> Matrix<S> {
        by_differences(arm, columns, [v, a], |arm| {
            self.passivity(arm, at, [qd, v, a])
        })
    }
}

/// An arm's link has a mass, a centre of mass and a tensor about that: a first moment without a
/// mass is not a link. With (m, s, Σ) = (1, s, Σ) − (1 − m, 0, 0) a body is the difference of two
/// links, the first with its centre at s.
fn by_differences<S: Scalar>(
    arm: &Arm<S>,
    columns: &[Column<S>],
    [qd, qdd]: [&[S]; 2],
    torques: impl Fn(&Arm<S>) -> Vec<S>,
) -> Matrix<S> {
    let n = arm.links.len();
    let empty = without_bodies(arm);
    let column = |Column { joint, of }: &Column<S>| {
        let drive = |rates: &[S]| scatter(&[rates[*joint].clone()], &[*joint], n);
        match of {
            Probed::Body(body) => of_body(&empty, *joint, body, &torques),
            Probed::Armature => drive(qdd),
            Probed::Viscous => drive(qd),
        }
    };
    let columns: Matrix<S> = columns.iter().map(column).collect();
    matrix(n, columns.len(), |i, k| columns[k][i].clone())
}

fn without_bodies<S: Scalar>(arm: &Arm<S>) -> Arm<S> {
    let mut empty = arm.clone().without_friction();
    for link in &mut empty.links {
        (link.mass, link.armature) = (S::zero(), S::zero());
        (link.com, link.inertia) = (zero_vector(), Inertia::symmetric(|_, _| S::zero()));
    }
    empty
}

fn of_body<S: Scalar>(
    empty: &Arm<S>,
    joint: usize,
    body: &MomentBody<S>,
    torques: &impl Fn(&Arm<S>) -> Vec<S>,
) -> Vec<S> {
    let with = |mass: S, com: [S; 3], inertia: Inertia<S>| {
        let mut arm = empty.clone();
        let link = &mut arm.links[joint];
        (link.mass, link.com, link.inertia) = (mass, com, inertia);
        torques(&arm)
    };
    if body.first.iter().all(S::is_zero) {
        return with(body.mass.clone(), zero_vector(), body.tensor());
    }
    // About its centre at s a mass of one has Σ − s sᵀ.
    let mut about_centre = body.clone();
    about_centre.second = Inertia::symmetric(|i, j| {
        let term = times(&body.first[i], &body.first[j]);
        minus(entry(&body.second, i, j), &term)
    });
    let whole = with(S::one(), body.first.clone(), about_centre.tensor());
    let rest = minus(&S::one(), &body.mass);
    if rest.is_zero() {
        return whole;
    }
    let point = with(rest, zero_vector(), Inertia::symmetric(|_, _| S::zero()));
    differences(&whole, &point)
}

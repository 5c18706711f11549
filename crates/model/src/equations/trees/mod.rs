//! Random trees in a prime field: the textbook's formulations against each other, and the chain, in
//! any regrouping and on a base that is fixed or floats, against Lagrange–Euler as written
//! (eqs. 2.2–2.15); slopes against dual numbers.

mod chains;
mod draw;
mod floating;
mod textbook;

use alloc::vec;
use alloc::vec::Vec;
use core::fmt::Debug;

use super::chain::composite::{Composite, CompositeOrder};
use super::chain::recursion::{AccelerationForm, MomentForm};
use super::chain::{
    Chain, Column, EliminatedTip, Form, HandChoice, LinkRegrouping, MetricChain, MomentBody,
    Posture, Probed, Regrouping, Segment, Skeleton, Unknowns,
};
use super::derivatives::constants;
use super::frames::{Frames, NamedFrame};
use super::friction::Friction;
use super::lagrange_euler::LagrangeEuler;
use super::matrix::*;
use super::{Arm, DhVariables, Formulation, JointPosition, Link, SinCosPair, base_position};
use crate::robot::{Convention, Inertia, JointKind, Parent};
use crate::scalar::dual::Dual;
use crate::scalar::field::{Field, Points};
use crate::scalar::sparse::Sparse;
use crate::scalar::{Divide, Scalar};

use draw::Draw;

type S = Sparse<Field>;
type Positions = Vec<JointPosition<S>>;

const TRAVELS: [CompositeOrder; 2] = [CompositeOrder::Inward, CompositeOrder::Outward];
const SPINS: [AccelerationForm; 2] = [AccelerationForm::Column, AccelerationForm::Rates];
const COUPLES: [MomentForm; 2] = [MomentForm::SecondMoments, MomentForm::Euler];

fn field(x: &S) -> Field {
    x.value().expect("no division by zero")
}

fn fields(values: &[S]) -> Vec<Field> {
    values.iter().map(field).collect()
}

fn flat(rows: &[Vec<S>]) -> Vec<Field> {
    rows.iter().flat_map(|row| fields(row)).collect()
}

#[track_caller]
fn agree(actual: &[S], expected: &[S], round: usize, what: impl Debug) {
    assert_eq!(fields(actual), fields(expected), "{round} {what:?}");
}

fn friction(arm: &Arm<S>, rates: &[S]) -> Vec<S> {
    let links = arm.links.iter().zip(rates);
    let torques = links.map(|(link, rate)| link.friction.torque(rate));
    torques.collect()
}

fn dual(chain: &Chain<S>) -> Chain<Dual<S>> {
    chain.map(|x| Dual::constant(*x))
}

fn growing(values: &[S], at: usize) -> Vec<Dual<S>> {
    let mut values = constants(values);
    values[at].rate = S::one();
    values
}

fn moving(position: &[JointPosition<S>], at: Option<usize>) -> Vec<JointPosition<Dual<S>>> {
    let joints = position.iter().enumerate().map(|(i, q)| {
        let rate = if at == Some(i) { S::one() } else { S::zero() };
        match q {
            JointPosition::Revolute(pair) => JointPosition::Revolute(pair.clone().turning(&rate)),
            JointPosition::Prismatic(q) => JointPosition::Prismatic(Dual { value: *q, rate }),
        }
    });
    joints.collect()
}

fn rates(values: Vec<Dual<S>>) -> Vec<Field> {
    values.iter().map(|x| field(&x.rate)).collect()
}

/// Returns a matrix whose columns are the slopes of some results by each joint.
fn columns(n: usize, slopes: impl Fn(usize) -> Vec<Field>) -> Vec<Field> {
    let columns: Vec<Vec<Field>> = (0..n).map(slopes).collect();
    let rows = 0..columns.first().map_or(0, Vec::len);
    rows.flat_map(|i| columns.iter().map(move |column| column[i]))
        .collect()
}

fn form(travel: CompositeOrder) -> Form {
    let mut form = Form::all(true, true, false, HandChoice::None)[0];
    form.travel = travel;
    form
}

//! Random general arms in the prime field: every parameter its own residue, so
//! that no slip can hide behind a zero or a right angle.

use dalembert_model::equations::friction::Coulomb;
use dalembert_model::equations::matrix::Columns;
use dalembert_model::equations::{Arm, DhVariables, JointPosition, Link, SinCosPair};
use dalembert_model::robot::{Convention, Inertia, JointKind};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

use super::{arm, link};
use crate::equations_slips::Known;

pub const CONVENTIONS: [Convention; 2] = [Convention::Standard, Convention::Modified];

#[derive(Clone)]
pub struct Case<S = Field> {
    pub arm: Arm<S>,
    pub at: Vec<DhVariables<S>>,
    pub qd: Vec<S>,
    pub qdd: Vec<S>,
}

/// The bits say which of the joints slide.
pub fn case(convention: Convention, n: usize, bits: u32, points: &mut Points) -> Case {
    let gravity = triple(points);
    let links = (0..n).map(|i| match bits >> i & 1 {
        0 => general_link(JointKind::Revolute, points),
        _ => general_link(JointKind::Prismatic, points),
    });
    let arm = arm(convention, gravity, links.collect());
    let at = arm.at(&position(&arm, points, |x| x));
    let [qd, qdd] = [(); 2].map(|()| fields(n, points));
    Case { arm, at, qd, qdd }
}

pub fn every_kind(most: usize, points: &mut Points) -> Vec<Case> {
    let mut cases = Vec::new();
    for convention in CONVENTIONS {
        for n in 1..=most {
            cases.extend((0..1 << n).map(|bits| case(convention, n, bits, points)));
        }
    }
    cases
}

pub fn position<S: Scalar>(
    arm: &Arm<S>,
    points: &mut Points,
    wrap: impl Fn(Field) -> S,
) -> Vec<JointPosition<S>> {
    let draw = |link: &Link<S>| match link.kind {
        JointKind::Revolute => JointPosition::Revolute(pair(points).map(|x| wrap(*x))),
        JointKind::Prismatic => JointPosition::Prismatic(wrap(points.field())),
    };
    arm.links.iter().map(draw).collect()
}

pub fn pose(points: &mut Points) -> Columns<Field> {
    let turned = Columns::identity()
        .turn_z(&pair(points))
        .turn_y(&pair(points))
        .turn_x(&pair(points));
    let axes = turned.axes;
    let origin = triple(points);
    Columns { axes, origin }
}

fn general_link(kind: JointKind, points: &mut Points) -> Link<Field> {
    let angles = [(); 2].map(|()| pair(points));
    let [lengths, com] = [(); 2].map(|()| triple(points));
    let [viscous, armature, force, width, per_speed, _] = [(); 6].map(|()| points.field());
    let inertia = Inertia::of([(); 6].map(|()| points.field()));
    let mut link = link(kind, angles, lengths, com, inertia);
    // Any three numbers: what formulations agree on rests on no relation of them.
    link.friction.coulomb = Some(Coulomb {
        force,
        width,
        per_speed,
    });
    (link.friction.viscous, link.armature) = (viscous, armature);
    link
}

pub fn pair(points: &mut Points) -> SinCosPair<Field> {
    let (sin, cos) = points.circle();
    SinCosPair { sin, cos }
}

fn triple(points: &mut Points) -> [Field; 3] {
    [(); 3].map(|()| points.field())
}

pub fn fields(n: usize, points: &mut Points) -> Vec<Field> {
    (0..n).map(|_| points.field()).collect()
}

pub fn known(values: &[Field]) -> Vec<Known> {
    values.iter().copied().map(Known).collect()
}

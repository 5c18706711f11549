//! Random general arms in the prime field: every parameter its own residue, so
//! that no slip can hide behind a zero or a right angle.

use dalembert_model::equations::frames::Frames;
use dalembert_model::equations::friction::{Coulomb, Friction};
use dalembert_model::equations::matrix::Columns;
use dalembert_model::equations::{Arm, DhVariables, JointPosition, Link, SinCosPair};
use dalembert_model::robot::{Convention, Inertia, JointKind};
use dalembert_model::scalar::field::{Field, Points};

/// An arm and one state of it.
#[derive(Clone)]
pub struct Case {
    pub arm: Arm<Field>,
    pub at: Vec<DhVariables<Field>>,
    pub qd: Vec<Field>,
    pub qdd: Vec<Field>,
}

/// Returns the joint kinds of bit pattern `bits`, 1 for prismatic.
pub fn kinds(n: usize, bits: u32) -> Vec<JointKind> {
    let kind = |i| match bits >> i & 1 {
        0 => JointKind::Revolute,
        _ => JointKind::Prismatic,
    };
    (0..n).map(kind).collect()
}

/// Returns a general arm of the kinds given, at a general state.
pub fn case(convention: Convention, kinds: &[JointKind], points: &mut Points) -> Case {
    let arm = Arm {
        convention,
        gravity: triple(points),
        base: None,
        tool: None,
        links: kinds.iter().map(|kind| link(*kind, points)).collect(),
        following: Vec::new(),
        frames: Frames::default(),
    };
    let position = |kind: &JointKind| match kind {
        JointKind::Revolute => JointPosition::Revolute(pair(points)),
        JointKind::Prismatic => JointPosition::Prismatic(points.field()),
    };
    let position: Vec<_> = kinds.iter().map(position).collect();
    Case {
        at: arm.at(&position),
        arm,
        qd: kinds.iter().map(|_| points.field()).collect(),
        qdd: kinds.iter().map(|_| points.field()).collect(),
    }
}

/// Draws a pose somewhere, turned about all three axes.
pub fn pose(points: &mut Points) -> Columns<Field> {
    let turned = Columns::identity()
        .turn_z(&pair(points))
        .turn_y(&pair(points))
        .turn_x(&pair(points));
    Columns {
        origin: triple(points),
        ..turned
    }
}

fn link(kind: JointKind, points: &mut Points) -> Link<Field> {
    Link {
        kind,
        alpha: pair(points),
        beta: None,
        theta: pair(points),
        a: points.field(),
        d: points.field(),
        mass: points.field(),
        com: triple(points),
        inertia: Inertia::of([(); 6].map(|()| points.field())),
        friction: Friction {
            viscous: points.field(),
            // Any three numbers: what formulations agree on rests on no relation of them.
            coulomb: Some(Coulomb {
                force: points.field(),
                width: points.field(),
                per_speed: points.field(),
            }),
        },
        armature: points.field(),
    }
}

pub fn pair(points: &mut Points) -> SinCosPair<Field> {
    let (sin, cos) = points.circle();
    SinCosPair { sin, cos }
}

pub fn triple(points: &mut Points) -> [Field; 3] {
    [points.field(), points.field(), points.field()]
}

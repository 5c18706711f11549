//! Arms for the tests of the equations: golden robots and random general ones.

pub mod golden;
pub mod random;

use dalembert_model::equations::frames::Frames;
use dalembert_model::equations::friction::Friction;
use dalembert_model::equations::{Arm, DhVariables, JointPosition, Link, SinCosPair};
use dalembert_model::robot::{Convention, Inertia, JointKind};
use dalembert_model::scalar::Scalar;

pub fn arm<S>(convention: Convention, gravity: [S; 3], links: Vec<Link<S>>) -> Arm<S> {
    Arm {
        convention,
        gravity,
        base: None,
        tool: None,
        floats: false,
        links,
        following: Vec::new(),
        frames: Frames::default(),
    }
}

pub fn link<S: Scalar>(
    kind: JointKind,
    [alpha, theta]: [SinCosPair<S>; 2],
    [a, d, mass]: [S; 3],
    com: [S; 3],
    inertia: Inertia<S>,
) -> Link<S> {
    Link {
        parent: None,
        kind,
        place: None,
        alpha,
        beta: None,
        theta,
        a,
        d,
        mass,
        com,
        inertia,
        friction: Friction::none(),
        armature: S::zero(),
    }
}

pub fn placed<S: Scalar>(
    arm: &Arm<S>,
    q: &[f64],
    number: impl Fn(f64) -> S,
    pair: impl Fn(f64) -> SinCosPair<S>,
) -> Vec<DhVariables<S>> {
    let position = |(link, q): (&Link<S>, &f64)| match link.kind {
        JointKind::Revolute => JointPosition::Revolute(pair(*q)),
        JointKind::Prismatic => JointPosition::Prismatic(number(*q)),
    };
    let position: Vec<_> = arm.links.iter().zip(q).map(position).collect();
    arm.at(&position)
}

pub fn sincos(angle: f64) -> SinCosPair<f64> {
    let (sin, cos) = libm::sincos(angle);
    SinCosPair { sin, cos }
}

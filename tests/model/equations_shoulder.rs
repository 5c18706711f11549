//! Forward dynamics of arms whose first axes meet: its torques are those that were given.

use crate::equations_slips::Known;
use crate::equations_support::random::{self, known};
use dalembert_model::equations::chain::composite::Composite;
use dalembert_model::equations::chain::{
    Chain, EliminatedTip, Form, HandChoice, Regrouping, Skeleton, Unknowns,
};
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::robot::Convention;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

fn arm(n: usize, slides: u32, four: bool, points: &mut Points) -> Arm<Known> {
    let mut arm = random::case(Convention::Modified, n, slides, points).arm;
    let meeting = if four { 4 } else { 3 };
    for (i, link) in arm.links.iter_mut().enumerate().take(meeting) {
        if i > 0 {
            link.a = Field::ZERO;
        }
        // Along the first axis and the last there is nothing that it could miss.
        if i > 0 && i + 1 < meeting {
            link.d = Field::ZERO;
        }
        (link.alpha.sin, link.alpha.cos) = (Field::ONE, Field::ZERO);
    }
    arm.map(|x| Known(*x))
}

fn chain(arm: &Arm<Known>) -> Chain<Known> {
    let skeleton = Skeleton::new(arm, &[]);
    Chain::new(&skeleton, &Regrouping::base(&skeleton))
}

fn compare(arm: &Arm<Known>, moves: &[bool], by_tip: bool, points: &mut Points) {
    let position = random::position(arm, points, Known);
    let [qd, tau] = [(); 2].map(|()| known(&random::fields(arm.links.len(), points)));
    let chain = chain(arm);
    assert!(chain.has_shoulder());
    let (posed, at) = chain.posed(&position);
    let composite = Composite::new(&posed, &at);
    for form in Form::with_shoulder(&Form::all(true, true, false, HandChoice::None)) {
        let inputs = [&qd[..], &tau];
        let solution = match by_tip {
            false => composite.forward_dynamics_by_shoulder(inputs, moves, form),
            true => EliminatedTip::new(&composite, moves)
                .map(|tip| tip.forward_dynamics(inputs, moves, form, Unknowns::Joints)),
        };
        let qdd = solution.unwrap();
        let textbook = Formulation::LagrangeEuler;
        let torques = textbook.inverse_dynamics(arm, &arm.at(&position), &qd, &qdd);
        for (i, moves) in moves.iter().enumerate() {
            match moves {
                true => assert_eq!(torques[i], tau[i], "{form:?} {i}"),
                false => assert_eq!(qdd[i], Known::zero(), "{form:?} {i}"),
            }
        }
    }
}

#[test]
fn torques_are_those_that_were_given() {
    let mut points = Points::new(0x5401);
    for (n, slides, four) in [
        (5, 0, false),
        (5, 0b0_1000, false),
        (6, 0, true),
        (6, 0b10_0000, false),
        (7, 0, false),
        (7, 0b101_0000, true),
    ] {
        let mut arm = arm(n, slides, four, &mut points);
        for still in [None, Some(0), Some(1), Some(3), Some(n - 1)] {
            let moves: Vec<bool> = (0..n).map(|i| Some(i) != still).collect();
            compare(&arm, &moves, false, &mut points);
        }
        for link in &mut arm.links {
            link.armature = Known::zero();
        }
        compare(&arm, &vec![true; n], false, &mut points);
    }
}

#[test]
fn so_they_are_where_the_tip_is_eliminated_before() {
    let mut points = Points::new(0x5402);
    for armature in [Known(Field::ZERO), Known(points.field())] {
        let mut arm = arm(7, 0, false, &mut points);
        let last = arm.links.last_mut().unwrap();
        let zero = Known::zero();
        (last.com[0], last.com[1], last.armature) = (zero, zero, armature);
        (last.inertia.xz, last.inertia.yz) = (zero, zero);
        compare(&arm, &[true; 7], true, &mut points);
    }
}

#[test]
fn a_shoulder_has_axes_that_meet_and_joints_beyond() {
    let mut points = Points::new(0x5403);
    let mut arms = vec![arm(4, 0, false, &mut points), arm(5, 0, true, &mut points)];
    for missed in [1, 2] {
        let mut arm = arm(7, 0, false, &mut points);
        arm.links[missed].a = Known(points.field());
        arms.push(arm);
    }
    assert!(arms.iter().all(|arm| !chain(arm).has_shoulder()));
}

//! The textbook's formulations, which go about the sums in their ways.

use super::*;
use crate::equations::dalembert::Part;
use crate::equations::frames::{Axes, Rows, View};
use crate::equations::kinematics::{link_poses, poses};
use crate::equations::link_axes::{HandAxes, SeenHand};
use crate::robot::HAND;

#[test]
fn formulations_agree_on_random_trees() {
    let mut draw = Draw(Points::new(0x70b5));
    for round in 0..60 {
        let arm = match round < 40 {
            true => draw.arm(1 + round % 6),
            false => draw.floating(round % 5),
        };
        let at = arm.at(&draw.position_of(&arm));
        dynamics(&arm, &at, &mut draw, round);
        for axes in [Axes::Mixed, Axes::Local, Axes::World] {
            for frame in ["tip", HAND] {
                let rows = Rows::ALL;
                let arm_in_view = arm.seen(&View { frame, axes, rows }).expect("a frame");
                kinematics(&arm_in_view, &at, &mut draw, round);
            }
        }
    }
}

fn dynamics(arm: &Arm<S>, at: &[DhVariables<S>], draw: &mut Draw, round: usize) {
    let n = arm.links.len();
    let [qd, qdd, v, a, multiplier] = [(); 5].map(|()| draw.values(n));
    let first = Formulation::LagrangeEuler;
    let results = |by: Formulation| {
        let christoffel = by.christoffel(arm, at).concat();
        let loads = by.wrenches(arm, at, [&qd, &qdd]).into_iter();
        let wrenches = loads.map(|wrench| [wrench.force, wrench.moment].concat());
        let kinetic = by.kinetic_energy(arm, at, &qd);
        let inputs = [&qd[..], &qdd, &multiplier];
        let [rotation, translation] =
            [Part::Rotation, Part::Translation].map(|part| by.inertia_part(part, arm, at).concat());
        [
            by.inverse_dynamics(arm, at, &qd, &qdd),
            by.inertia(arm, at).concat(),
            by.velocity_terms(arm, at, &qd),
            by.gravity(arm, at),
            christoffel.concat(),
            by.momentum(arm, at, &qd),
            by.momentum_slope(arm, at, &qd),
            vec![kinetic, by.potential_energy(arm, at)],
            by.passivity(arm, at, [&qd, &v, &a]),
            by.torque_by_position(arm, at, &qd, &qdd).concat(),
            by.torque_by_velocity(arm, at, &qd).concat(),
            match arm.floats {
                true => Vec::new(),
                false => by.torque_by_positions(arm, at, inputs).concat(),
            },
            wrenches.collect::<Vec<_>>().concat(),
            rotation,
            translation,
        ]
    };
    let expected = results(first);
    for by in Formulation::ALL {
        for (k, (found, expected)) in results(by).iter().zip(&expected).enumerate() {
            assert_eq!(fields(found), fields(expected), "{round} {by:?} result {k}");
        }
        let moves = vec![true; n];
        let accelerations = by.forward_dynamics(arm, at, &qd, &expected[0], &moves);
        assert_eq!(fields(&accelerations), fields(&qdd), "{round} {by:?} q̈");
    }
    // Folding the base away changes no torque.
    let folded = arm.clone().fold_base();
    let torques = first.inverse_dynamics(&folded, at_of(&folded, arm, at).as_slice(), &qd, &qdd);
    assert_eq!(fields(&torques), fields(&expected[0]), "{round} folded");
}

/// Returns where joints are whose rows have other constants along their axes.
fn at_of(folded: &Arm<S>, arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<DhVariables<S>> {
    let links = folded.links.iter().zip(&arm.links).zip(at);
    let at = links.map(|((folded, link), at)| DhVariables {
        theta: at.theta.clone(),
        d: plus(&minus(&at.d, &link.d), &folded.d),
    });
    at.collect()
}

fn kinematics(arm: &Arm<S>, at: &[DhVariables<S>], draw: &mut Draw, round: usize) {
    let n = arm.links.len();
    let (qd, wrench) = (draw.values(n), draw.values(6));
    let results = |by: Formulation| {
        [
            by.hand(arm, at).rows(),
            by.jacobian(arm, at).concat(),
            by.jacobian_rate(arm, at, &qd).concat(),
            by.torques_of_wrench(arm, at, &wrench),
        ]
    };
    let expected = results(Formulation::LagrangeEuler);
    for by in Formulation::ALL {
        for (k, (found, expected)) in results(by).iter().zip(&expected).enumerate() {
            assert_eq!(fields(found), fields(expected), "{round} {by:?} result {k}");
        }
        for axes in [HandAxes::FirstAndLast, HandAxes::Last] {
            let hand = SeenHand::new(by, (arm, at), axes);
            let jacobian = hand.turned(&columns_of(&hand.jacobian())).concat();
            let expected = columns_of(&by.jacobian(arm, at)).concat();
            agree(&jacobian, &expected, round, (by, axes));
            let rate = hand.turned(&[hand.rate(&qd)]).concat();
            let expected = by.jacobian_rate(arm, at, &qd).concat();
            agree(&rate, &expected, round, (by, axes));
        }
    }
    // Links' frames are those of their rows, where no other is given.
    let [rows, links] = [poses(arm, at), link_poses(arm, at)];
    for (row, link) in rows.iter().zip(&links) {
        assert_eq!(fields(&row.rows()), fields(&link.rows()));
    }
}

//! Chains, in any regrouping, against Lagrange–Euler.

use super::*;

#[test]
fn random_trees_move_as_lagrange_and_euler_say() {
    let mut draw = Draw(Points::new(0x7ee5));
    for round in 0..40 {
        let arm = draw.arm(2 + round % 5);
        compare(&arm, &mut draw, round);
    }
}

#[test]
fn random_floating_trees_move_as_lagrange_and_euler_say() {
    let mut draw = Draw(Points::new(0xf10a7));
    for round in 0..30 {
        let arm = draw.floating(round % 5);
        compare(&arm, &mut draw, round);
    }
}

fn compare(arm: &Arm<S>, draw: &mut Draw, round: usize) {
    let (n, first) = (arm.links.len(), arm.base_joints());
    let whole_position = draw.position_of(arm);
    let dh = arm.at(&whole_position);
    let position = &whole_position[first..].to_vec();
    let [qd, qdd, v, a] = [(); 4].map(|()| draw.values(n));
    let written = Formulation::LagrangeEuler;
    let (d, c) = (written.inertia(arm, &dh), written.gravity(arm, &dh));
    let torques = written.inverse_dynamics(arm, &dh, &qd, &qdd);
    let columns = draw.columns(arm.first_body()..n);
    let skeleton = &Skeleton::with_columns(arm, &vec![None; n], &columns);
    let chain = draw.chain(skeleton);
    let (posed, at) = chain.posed(position);
    let composite = Composite::new(&posed, &at);
    for spin in SPINS {
        for couple in COUPLES {
            let actual = posed.inverse_dynamics(&at, &qd, &qdd, spin, couple);
            agree(&actual, &torques, round, (spin, couple));
        }
        let loads = composite.torques(&posed.gravity, &qd, &qdd, spin, &zero_vector());
        let actual = posed.driven(loads, &qd, &qdd);
        agree(&actual, &torques, round, "composite");
    }
    let coriolis = written.coriolis_matrix(arm, &dh, &qd);
    for travel in TRAVELS {
        agree(&composite.inertia(travel).concat(), &d.concat(), round, "D");
        agree(&composite.gravity(travel), &c, round, "c");
        let actual = composite.coriolis_matrix(&qd, travel).concat();
        agree(&actual, &coriolis.concat(), round, "C");
    }
    if !arm.floats {
        let [actual, expected] = [composite.christoffel(), written.christoffel(arm, &dh)];
        agree(
            &actual.concat().concat(),
            &expected.concat().concat(),
            round,
            "h",
        );
    }
    let momentum = products(&d, &qd);
    let energy = product(&momentum, &qd).half();
    agree(&[posed.kinetic_energy(&at, &qd)], &[energy], round, "T");
    let [actual, slopes] = posed.momentum(&at, &qd);
    agree(&actual, &momentum, round, "p");
    // ∂T/∂q = Cᵀ q̇, since Ḋ = C + Cᵀ and Ḋ q̇ − ∂T/∂q = C q̇.
    let expected = products(&columns_of(&coriolis), &qd);
    agree(&slopes, &expected, round, "∂T/∂q");
    let wished = sums(&products(&d, &a), &products(&coriolis, &v));
    let wanted = sums(&sums(&wished, &c), &friction(arm, &v));
    agree(
        &posed.passivity(&at, &qd, &v, &a),
        &wanted,
        round,
        "passivity",
    );
    forward(&posed, &at, [&qd, &qdd, &torques], &d, round);
    derivatives(&chain, position, [&qd, &qdd, &v], round);
    regressors(skeleton, &chain, position, [&qd, &qdd, &v, &a], round);
    if !position.is_empty() {
        locked(arm, draw, &whole_position, &d, round);
    }
}

/// A locked link is a part of the one that carries it: D loses a row and a column.
fn locked(arm: &Arm<S>, draw: &mut Draw, position: &Positions, d: &[Vec<S>], round: usize) {
    let (n, first) = (position.len(), arm.base_joints());
    let joint = first + round % (n - first);
    let mut locks: Vec<Option<JointPosition<S>>> = vec![None; n];
    locks[joint] = Some(position[joint].clone());
    let skeleton = Skeleton::new(arm, &locks);
    let chain = draw.chain(&skeleton);
    let mut moving = position[first..].to_vec();
    moving.remove(joint - first);
    let (posed, at) = chain.posed(&moving);
    let rest: Vec<usize> = (0..n).filter(|row| *row != joint).collect();
    let expected = flat(&super::super::factor::submatrix(d, &rest));
    let found = Composite::new(&posed, &at).inertia(CompositeOrder::Inward);
    assert_eq!(flat(&found), expected, "{round} with joint {joint} locked");
}

fn forward(
    chain: &Chain<S>,
    at: &Posture<S>,
    [qd, qdd, tau]: [&[S]; 3],
    d: &[Vec<S>],
    round: usize,
) {
    let (moves, form) = (vec![true; qd.len()], form(CompositeOrder::Inward));
    for unknowns in [Unknowns::Joints, Unknowns::AgainstBase] {
        let actual = chain.forward_dynamics((at, d), [qd, tau], &moves, form, unknowns);
        agree(&actual, qdd, round, ("q̈", unknowns));
    }
    let composite = Composite::new(chain, at);
    if let Some(tip) = EliminatedTip::new(&composite, &moves) {
        let actual = tip.forward_dynamics([qd, tau], &moves, form, Unknowns::Joints);
        agree(&actual, qdd, round, "q̈ by the tip");
    }
}

fn derivatives(chain: &Chain<S>, position: &Positions, [qd, qdd, v]: [&[S]; 3], round: usize) {
    let n = qd.len();
    let (posed, at) = chain.posed(position);
    let composite = Composite::new(&posed, &at);
    let chain = dual(chain);
    let (spin, couple) = (SPINS[0], COUPLES[0]);
    let displaced = |k: usize| {
        let mut chain = chain.clone();
        let joint = k.checked_sub(chain.base_coordinates());
        if let (None, Some(axis)) = (joint, k.checked_sub(3)) {
            // The base turns, and gravity the other way.
            let unit = three(|i| if i == axis { Dual::one() } else { Dual::zero() });
            let turning = cross(&chain.gravity, &unit);
            for (component, turning) in chain.gravity.iter_mut().zip(turning) {
                component.rate = turning.value;
            }
        }
        chain.posed(&moving(position, joint))
    };
    let by_position = |k: usize| {
        let (chain, at) = displaced(k);
        rates(chain.inverse_dynamics(&at, &constants(qd), &constants(qdd), spin, couple))
    };
    let (still, at_rest) = chain.posed(&moving(position, None));
    let by_velocity = |k: usize| {
        rates(still.inverse_dynamics(&at_rest, &growing(qd, k), &constants(qdd), spin, couple))
    };
    let power = |slopes: &[Vec<Dual<S>>], k: usize| {
        let rows = slopes.iter().zip(v);
        total(rows.map(|(row, v)| row[k].mul(&Dual::constant(*v))))
    };
    let powers = |slopes: &[Vec<Dual<S>>]| rates((0..n).map(|k| power(slopes, k)).collect());
    let position_slopes = columns(n, by_position);
    let velocity_slopes = columns(n, by_velocity);
    for travel in TRAVELS {
        let slopes = composite.slopes(qd, qdd, travel);
        assert_eq!(flat(&slopes.position), position_slopes, "{round} ∂τ/∂q");
        assert_eq!(flat(&slopes.velocity), velocity_slopes, "{round} ∂τ/∂q̇");
        if chain.base.is_some() {
            continue;
        }
        let second = composite.second_derivatives([qd, qdd, v], travel);
        let of = |k: usize| {
            let (chain, at) = chain.posed(&moving(position, Some(k)));
            let composite = Composite::new(&chain, &at);
            composite.slopes(&constants(qd), &constants(qdd), travel)
        };
        let position_slopes = columns(n, |k| powers(&of(k).position));
        assert_eq!(flat(&second.position), position_slopes, "{round} ∂²/∂q²");
        let mixed: Vec<Field> = (0..n).flat_map(|k| powers(&of(k).velocity)).collect();
        assert_eq!(flat(&second.mixed), mixed, "{round} ∂²/∂q∂q̇");
        let composite = Composite::new(&still, &at_rest);
        let by_rate = |k: usize| {
            let slopes = composite.slopes(&growing(qd, k), &constants(qdd), travel);
            powers(&slopes.velocity)
        };
        let velocity_slopes = columns(n, by_rate);
        assert_eq!(flat(&second.velocity), velocity_slopes, "{round} ∂²/∂q̇²");
        let driven = |k: usize| {
            let (chain, at) = chain.posed(&moving(position, Some(k)));
            let d = Composite::new(&chain, &at).inertia(travel);
            let row =
                |row: &Vec<Dual<S>>| total(row.iter().zip(&constants(v)).map(|(x, y)| x.mul(y)));
            rates(d.iter().map(row).collect())
        };
        assert_eq!(flat(&second.driven), columns(n, driven), "{round} ∂(Dλ)/∂q");
    }
}

/// The columns of a regressor times values are the torques of what they are columns of.
fn regressors(
    skeleton: &Skeleton<S>,
    chain: &Chain<S>,
    position: &Positions,
    [qd, qdd, v, a]: [&[S]; 4],
    round: usize,
) {
    let values = Draw(Points::new(round as u64)).values(skeleton.columns);
    let more = skeleton.clone().with_values(&values);
    let plain = Regrouping::base(&more);
    let (heavier, at_heavier) = Chain::new(&more, &plain).posed(position);
    let (posed, at) = chain.posed(position);
    let (spin, couple) = (SPINS[0], COUPLES[0]);
    let torques = posed.inverse_dynamics(&at, qd, qdd, spin, couple);
    let whole = heavier.inverse_dynamics(&at_heavier, qd, qdd, spin, couple);
    let passive = posed.passivity(&at, qd, v, a);
    let all_passive = heavier.passivity(&at_heavier, qd, v, a);
    for travel in TRAVELS {
        let y = posed.regressor(&at, qd, qdd, travel);
        let torque_sums = sums(&torques, &products(&y, &values));
        agree(&torque_sums, &whole, round, "Y");
        let y = posed.passivity_regressor(&at, qd, [v, a], travel);
        let passive_sums = sums(&passive, &products(&y, &values));
        agree(&passive_sums, &all_passive, round, "Y of passivity");
    }
}

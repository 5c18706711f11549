//! Trees on a base that stands still.

use super::*;

#[test]
fn random_trees_move_as_lagrange_and_euler_say() {
    let mut draw = Draw(Points::new(0x7ee5));
    for round in 0..40 {
        let skeleton = draw.skeleton(2 + round % 5, false);
        fixed(&skeleton, &mut draw, round);
    }
}

fn fixed(skeleton: &Skeleton<S>, draw: &mut Draw, round: usize) {
    let n = skeleton.links.len();
    let position = draw.position(skeleton);
    let [qd, qdd, v, a] = [(); 4].map(|()| draw.values(n));
    let links: Vec<&ChainLink<S>> = skeleton.links.iter().map(|own| &own.link).collect();
    let written = LagrangeEuler::of(&links, &position, &skeleton.gravity);
    let torques = sums(&written.torques(&qd, &qdd), &friction(skeleton, &qd));
    let chain = Chain::new(skeleton, &draw.regrouping(skeleton));
    let (posed, at) = chain.posed(&position);
    let composite = Composite::new(&posed, &at);
    for spin in SPINS {
        for couple in COUPLES {
            let found = posed.inverse_dynamics(&at, &qd, &qdd, spin, couple);
            assert_eq!(
                fields(&found),
                fields(&torques),
                "{round} {spin:?} {couple:?}"
            );
        }
        let found = composite.torques(&posed.gravity, &qd, &qdd, spin, &zero_vector());
        let drives = (0..n)
            .map(|i| posed.drive(i, &qd, &qdd))
            .collect::<Vec<S>>();
        assert_eq!(
            fields(&sums(&found, &drives)),
            fields(&torques),
            "{round} composite"
        );
    }
    let coriolis = written.coriolis(&qd);
    for travel in TRAVELS {
        assert_eq!(
            flat(&composite.inertia(travel)),
            flat(&written.inertia),
            "{round} D"
        );
        assert_eq!(
            fields(&composite.gravity(travel)),
            fields(&written.gravity),
            "{round} c"
        );
        assert_eq!(
            flat(&composite.coriolis_matrix(&qd, travel)),
            flat(&coriolis),
            "{round} C"
        );
    }
    for (found, expected) in composite.christoffel().iter().zip(&written.christoffel) {
        assert_eq!(flat(found), flat(expected), "{round} h");
    }
    let momentum = product_of(&written.inertia, &qd);
    let energy = total(momentum.iter().zip(&qd).map(|(p, q)| times(p, q))).half();
    assert_eq!(
        field(&posed.kinetic_energy(&at, &qd)),
        field(&energy),
        "{round} T"
    );
    let [found, slopes] = posed.momentum(&at, &qd);
    assert_eq!(fields(&found), fields(&momentum), "{round} p");
    // ∂T/∂q = Cᵀ q̇, since Ḋ = C + Cᵀ and Ḋ q̇ − ∂T/∂q = C q̇.
    let expected = product_of(&columns_of(&coriolis), &qd);
    assert_eq!(fields(&slopes), fields(&expected), "{round} ∂T/∂q");
    let wanted = sums(
        &product_of(&written.inertia, &a),
        &product_of(&coriolis, &v),
    );
    let wanted = sums(&sums(&wanted, &written.gravity), &friction(skeleton, &v));
    assert_eq!(
        fields(&posed.passivity(&at, &qd, &v, &a)),
        fields(&wanted),
        "{round}"
    );
    forward(&posed, &at, [&qd, &qdd, &torques], &written.inertia, round);
    derivatives(&chain, &position, [&qd, &qdd, &v], round);
    regressors(skeleton, &chain, &position, [&qd, &qdd, &v, &a], round);
}

fn forward(
    chain: &Chain<S>,
    at: &[Displacement<S>],
    [qd, qdd, tau]: [&[S]; 3],
    d: &[Vec<S>],
    round: usize,
) {
    let moves = vec![true; qd.len()];
    for unknowns in [Unknowns::Joints, Unknowns::AgainstBase] {
        let form = form(CompositeOrder::Inward);
        let found = chain.forward_dynamics((at, d), [qd, tau], &moves, form, unknowns);
        assert_eq!(fields(&found), fields(qdd), "{round} q̈ {unknowns:?}");
    }
    let composite = Composite::new(chain, at);
    if let Some(tip) = EliminatedTip::new(&composite, &moves) {
        let form = form(CompositeOrder::Inward);
        let found = tip.forward_dynamics([qd, tau], &moves, form, Unknowns::Joints);
        assert_eq!(fields(&found), fields(qdd), "{round} q̈ by the tip");
    }
}

fn derivatives(chain: &Chain<S>, position: &Position, [qd, qdd, v]: [&[S]; 3], round: usize) {
    let n = qd.len();
    let (posed, at) = chain.posed(position);
    let composite = Composite::new(&posed, &at);
    let chain = dual(chain);
    let (spin, couple) = (SPINS[0], COUPLES[0]);
    let by_position = |k: usize| {
        let (chain, at) = chain.posed(&moving(position, Some(k)));
        rates(chain.inverse_dynamics(&at, &constants(qd), &constants(qdd), spin, couple))
    };
    let (still, at_rest) = chain.posed(&moving(position, None));
    let by_velocity = |k: usize| {
        rates(still.inverse_dynamics(&at_rest, &growing(qd, k), &constants(qdd), spin, couple))
    };
    let power = |slopes: &[Vec<Dual<S>>], k: usize| {
        let terms = slopes.iter().zip(v);
        let terms = terms.map(|(row, v)| row[k].mul(&Dual::constant(*v)));
        total(terms)
    };
    let powers = |slopes: &[Vec<Dual<S>>]| rates((0..n).map(|k| power(slopes, k)).collect());
    for travel in TRAVELS {
        let slopes = composite.slopes(qd, qdd, travel);
        assert_eq!(
            flat(&slopes.position),
            columns(n, by_position),
            "{round} ∂τ/∂q"
        );
        assert_eq!(
            flat(&slopes.velocity),
            columns(n, by_velocity),
            "{round} ∂τ/∂q̇"
        );
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
        assert_eq!(
            flat(&second.velocity),
            columns(n, by_rate),
            "{round} ∂²/∂q̇²"
        );
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
    position: &Position,
    [qd, qdd, v, a]: [&[S]; 4],
    round: usize,
) {
    let n = qd.len();
    let mut weights = Points::new(round as u64);
    let values: Vec<S> = (0..n).map(|_| Sparse::Value(weights.field())).collect();
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
        let found = sums(&torques, &product_of(&y, &values));
        assert_eq!(fields(&found), fields(&whole), "{round} Y");
        let y = posed.passivity_regressor(&at, qd, [v, a], travel);
        let found = sums(&passive, &product_of(&y, &values));
        assert_eq!(
            fields(&found),
            fields(&all_passive),
            "{round} Y of passivity"
        );
    }
}

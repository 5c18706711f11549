//! Identities that hold for every arm, checked exactly in the prime field.
//!
//! Equality at a random point means equality of the rational functions but for
//! a chance of about 1e-16 each.

use crate::equations_structure::nonzero_and_distinct;
use crate::equations_support::random::{self, CONVENTIONS, Case, case};
use dalembert_model::equations::lagrange_euler::velocity_terms;
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

/// Returns every kind pattern up to four joints, then random patterns up to eight.
fn cases() -> Vec<Case> {
    let mut points = Points::new(20);
    let mut cases = random::every_kind(4, &mut points);
    for (convention, n) in CONVENTIONS
        .map(|own| [5, 6, 7, 8].map(|n| (own, n)))
        .concat()
    {
        let bits = [(); 3].map(|()| points.bits() as u32 & points.bits() as u32);
        let all = bits.into_iter().chain([0]);
        cases.extend(all.map(|bits| case(convention, n, bits, &mut points)));
    }
    cases
}

/// τ, D, c and h of a formulation, and the Christoffel symbols.
type Outputs = (
    Vec<Field>,
    Vec<Vec<Field>>,
    Vec<Field>,
    Vec<Field>,
    Vec<Vec<Vec<Field>>>,
);

fn outputs(formulation: Formulation, Case { arm, at, qd, qdd }: &Case) -> Outputs {
    (
        formulation.inverse_dynamics(arm, at, qd, qdd),
        formulation.inertia(arm, at),
        formulation.gravity(arm, at),
        formulation.velocity_terms(arm, at, qd),
        formulation.christoffel(arm, at),
    )
}

#[test]
fn formulations_agree() {
    for case in cases() {
        let mut truth = outputs(Formulation::LagrangeEuler, &case);
        truth.3 = velocity_terms(&truth.4, &case.qd);
        for formulation in Formulation::ALL {
            let what = format!(
                "{formulation:?} {:?} {}",
                case.arm.convention,
                case.qd.len()
            );
            assert_eq!(outputs(formulation, &case), truth, "{what}");
        }
    }
}

#[test]
fn christoffel_symbols_obey_their_relations() {
    for case in cases() {
        let h = Formulation::LagrangeEuler.christoffel(&case.arm, &case.at);
        let n = h.len();
        let prismatic = |i: usize| case.arm.links[i].kind == JointKind::Prismatic;
        let triples = (0..n * n * n).map(|t| (t / n / n, t / n % n, t % n));
        for (i, k, m) in triples {
            assert_eq!(h[i][k][m], h[i][m][k]);
            if m <= i.min(k) {
                assert_eq!(h[i][k][m], h[k][i][m].neg());
            }
            if i == k && k == m || prismatic(k.min(m)) {
                assert_eq!(h[i][k][m], Field::ZERO);
            }
        }
    }
}

/// n(n² − 1)/3 independent ones: that many are left up to sign.
#[test]
fn all_rotary_chains_have_as_many_symbols_as_counted() {
    let mut points = Points::new(22);
    for (convention, n) in CONVENTIONS
        .map(|own| [2, 3, 4, 5, 6].map(|n| (own, n)))
        .concat()
    {
        let case = case(convention, n, 0, &mut points);
        let h = Formulation::LagrangeEuler.christoffel(&case.arm, &case.at);
        let (_, distinct) = nonzero_and_distinct(h.concat().concat());
        assert_eq!(distinct, n * (n * n - 1) / 3);
    }
}

#[test]
fn inertia_is_free_of_the_first_joint() {
    let mut points = Points::new(23);
    let three = random::every_kind(3, &mut points);
    for mut case in three.into_iter().filter(|case| case.qd.len() == 3) {
        let d = Formulation::Dalembert.inertia(&case.arm, &case.at);
        let position = random::position(&case.arm, &mut points, |x| x);
        case.at[0] = case.arm.at(&position).remove(0);
        assert_eq!(Formulation::Dalembert.inertia(&case.arm, &case.at), d);
    }
}

/// fold_base changes no output, and leaves no length that has no effect.
#[test]
fn the_base_folds_without_a_trace() {
    let mut points = Points::new(24);
    let four = random::every_kind(4, &mut points)
        .into_iter()
        .filter(|case| case.qd.len() == 4);
    // Each axis in turn the first that is not parallel to the one before.
    for (mut case, parallel) in four.flat_map(|case| [0, 1, 2, 3].map(|p| (case.clone(), p))) {
        for link in &mut case.arm.links[..parallel] {
            (link.alpha.sin, link.alpha.cos) = (Field::ZERO, Field::ONE);
        }
        let folded = case.arm.clone().fold_base();
        let mut lengths = case.arm.links.iter().zip(&folded.links);
        assert!(lengths.any(|(a, b)| a.d != b.d));
        // Positions are applied after folding, as a runtime does.
        let position = random::position(&folded, &mut points, |x| x);
        let of = |arm: &Arm<Field>| {
            let at = arm.at(&position);
            outputs(
                Formulation::NewtonEulerLink,
                &Case {
                    arm: arm.clone(),
                    at,
                    ..case.clone()
                },
            )
        };
        let truth = of(&case.arm);
        let kinds: Vec<JointKind> = folded.links.iter().map(|link| link.kind).collect();
        let what = format!("{:?} {kinds:?} {parallel}", folded.convention);
        assert_eq!(of(&folded), truth, "{what}");
        // What was kept has an effect.
        for i in (0..4).filter(|i| folded.links[*i].d != Field::ZERO) {
            let mut changed = folded.clone();
            changed.links[i].d = points.field();
            assert_ne!(of(&changed), truth, "{what} d{i}");
        }
    }
}

//! Identities that hold for every arm, checked exactly at random points of the prime field: they
//! err with a chance of about 1e-16 each.

use std::collections::BTreeSet;

use crate::equations_support::golden;
use crate::equations_support::random::{self, CONVENTIONS, Case, case};
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

fn outputs(formulation: Formulation, Case { arm, at, qd, qdd }: &Case) -> [Vec<Field>; 5] {
    [
        formulation.inverse_dynamics(arm, at, qd, qdd),
        formulation.inertia(arm, at).concat(),
        formulation.gravity(arm, at),
        formulation.velocity_terms(arm, at, qd),
        formulation.christoffel(arm, at).concat().concat(),
    ]
}

fn nonzero_and_distinct(entries: impl IntoIterator<Item = Field>) -> (usize, usize) {
    let nonzero: Vec<Field> = entries.into_iter().filter(|h| *h != Field::ZERO).collect();
    let sizes: BTreeSet<Field> = nonzero.iter().map(|h| *h.min(&h.neg())).collect();
    (nonzero.len(), sizes.len())
}

/// n(n² − 1)/3 independent ones: that many are left up to sign.
#[test]
fn all_rotary_chains_have_as_many_symbols_as_counted() {
    let mut points = Points::new(22);
    for convention in CONVENTIONS {
        for n in 2..=6 {
            let case = case(convention, n, 0, &mut points);
            let h = Formulation::LagrangeEuler.christoffel(&case.arm, &case.at);
            let (_, distinct) = nonzero_and_distinct(h.concat().concat());
            assert_eq!(distinct, n * (n * n - 1) / 3);
        }
    }
}

#[test]
fn zeros_and_coincidences_are_those_known() {
    let exact = Formulation::LagrangeEuler;
    let decimal = |x: &f64| Field::from_rational(&parse_decimal(&format!("{x:e}")).unwrap());
    let lower = |rows: &[Vec<Field>]| -> Vec<Field> {
        (0..6).flat_map(|m| rows[m][..=m].to_vec()).collect()
    };
    for (robot, expected) in [("puma560", (84, 35)), ("stanford", (62, 34))] {
        let arm = golden::read(robot).0.map(|x| decimal(x).unwrap());
        let at = arm.at(&random::position(&arm, &mut Points::new(40), |x| x));
        let h = exact.christoffel(&arm, &at);
        let halves: Vec<Field> = h.iter().flat_map(|h| lower(h)).collect();
        assert_eq!(halves.len(), 126);
        assert_eq!(nonzero_and_distinct(halves), expected, "{robot}");
        if robot == "puma560" {
            assert_eq!(nonzero_and_distinct(lower(&exact.inertia(&arm, &at))).0, 19);
            assert_eq!(nonzero_and_distinct(exact.gravity(&arm, &at)).0, 4);
        }
    }
}

#[test]
fn the_base_folds_without_a_trace() {
    let mut points = Points::new(24);
    let mut four = random::every_kind(4, &mut points);
    four.retain(|case| case.qd.len() == 4);
    let four = four.iter();
    for (mut case, parallel) in four.flat_map(|case| [0, 1, 2, 3].map(|p| (case.clone(), p))) {
        for link in &mut case.arm.links[..parallel] {
            (link.alpha.sin, link.alpha.cos) = (Field::ZERO, Field::ONE);
        }
        let folded = case.arm.clone().fold_base();
        let mut lengths = case.arm.links.iter().zip(&folded.links);
        assert!(lengths.any(|(a, b)| a.d != b.d));
        let position = random::position(&folded, &mut points, |x| x);
        let of = |arm: &Arm<Field>| {
            let (arm, at) = (arm.clone(), arm.at(&position));
            let case = case.clone();
            outputs(Formulation::NewtonEulerLink, &Case { arm, at, ..case })
        };
        let truth = of(&case.arm);
        let kinds: Vec<JointKind> = folded.links.iter().map(|link| link.kind).collect();
        let what = format!("{:?} {kinds:?} {parallel}", folded.convention);
        assert_eq!(of(&folded), truth, "{what}");
        for i in (0..4).filter(|i| folded.links[*i].d != Field::ZERO) {
            let mut changed = folded.clone();
            changed.links[i].d = points.field();
            assert_ne!(of(&changed), truth, "{what} d{i}");
        }
    }
}

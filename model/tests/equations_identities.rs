//! Identities that hold for every arm, checked exactly in the prime field.
//!
//! Equality at a random point means equality of the rational functions but for
//! a chance of about 1e-16 each.

use crate::equations_support::random::{self, Case, case, kinds};
use dalembert_model::equations::lagrange_euler::velocity_terms;
use dalembert_model::equations::{Arm, DhVariables, Formulation, JointPosition};
use dalembert_model::robot::{Convention, JointKind};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

const CONVENTIONS: [Convention; 2] = [Convention::Standard, Convention::Modified];

/// Returns every kind pattern up to four joints, then random patterns up to eight.
fn cases() -> Vec<Case> {
    let mut points = Points::new(20);
    let mut cases = Vec::new();
    for convention in CONVENTIONS {
        for n in 1..=4 {
            for bits in 0..1 << n {
                cases.push(case(convention, &kinds(n, bits), &mut points));
            }
        }
        for n in 5..=8 {
            for _ in 0..3 {
                let bits = points.bits() as u32 & points.bits() as u32;
                cases.push(case(convention, &kinds(n, bits), &mut points));
            }
            cases.push(case(convention, &kinds(n, 0), &mut points));
        }
    }
    cases
}

#[test]
fn formulations_agree() {
    for case in cases() {
        let Case { arm, at, qd, qdd } = &case;
        let truth = Formulation::LagrangeEuler;
        let tau = truth.inverse_dynamics(arm, at, qd, qdd);
        let d = truth.inertia(arm, at);
        let c = truth.gravity(arm, at);
        let coefficients = truth.christoffel(arm, at);
        let h = velocity_terms(&coefficients, qd);
        for formulation in Formulation::ALL {
            let at_case = || format!("{formulation:?} {:?} {}", arm.convention, arm.links.len());
            assert_eq!(
                formulation.inverse_dynamics(arm, at, qd, qdd),
                tau,
                "{}",
                at_case()
            );
            assert_eq!(formulation.inertia(arm, at), d, "{}", at_case());
            assert_eq!(formulation.gravity(arm, at), c, "{}", at_case());
            assert_eq!(formulation.velocity_terms(arm, at, qd), h, "{}", at_case());
            assert_eq!(
                formulation.christoffel(arm, at),
                coefficients,
                "{}",
                at_case()
            );
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

#[test]
fn all_rotary_chains_have_as_many_symbols_as_counted() {
    // n(n² − 1)/3 independent ones: that many are left up to sign.
    let mut points = Points::new(22);
    for convention in CONVENTIONS {
        for n in 2..=6 {
            let case = case(convention, &kinds(n, 0), &mut points);
            let h = Formulation::LagrangeEuler.christoffel(&case.arm, &case.at);
            let sizes = h
                .concat()
                .concat()
                .into_iter()
                .filter(|h| *h != Field::ZERO);
            let mut sizes: Vec<_> = sizes.map(|h| h.min(h.neg())).collect();
            sizes.sort();
            sizes.dedup();
            assert_eq!(sizes.len(), n * (n * n - 1) / 3);
        }
    }
}

#[test]
fn inertia_is_free_of_the_first_joint() {
    let mut points = Points::new(23);
    for convention in CONVENTIONS {
        for bits in 0..8 {
            let mut case = case(convention, &kinds(3, bits), &mut points);
            let d = Formulation::Dalembert.inertia(&case.arm, &case.at);
            case.at[0] = match case.arm.links[0].kind {
                JointKind::Revolute => DhVariables {
                    theta: random::pair(&mut points),
                    ..case.at[0].clone()
                },
                JointKind::Prismatic => DhVariables {
                    d: points.field(),
                    ..case.at[0].clone()
                },
            };
            assert_eq!(Formulation::Dalembert.inertia(&case.arm, &case.at), d);
        }
    }
}

/// fold_base changes no output, and leaves no length that has no effect.
#[test]
fn the_base_folds_without_a_trace() {
    let mut points = Points::new(24);
    for convention in CONVENTIONS {
        for bits in 0..16 {
            // Each axis in turn the first that is not parallel to the one before.
            for parallel in 0..4 {
                let mut case = case(convention, &kinds(4, bits), &mut points);
                for link in &mut case.arm.links[..parallel] {
                    link.alpha.sin = Field::ZERO;
                    link.alpha.cos = Field::ONE;
                }
                let folded = case.arm.clone().fold_base();
                assert!(
                    case.arm
                        .links
                        .iter()
                        .zip(&folded.links)
                        .any(|(a, b)| a.d != b.d)
                );
                // Positions are applied after folding, as a runtime does.
                let position: Vec<_> = folded
                    .links
                    .iter()
                    .map(|link| match link.kind {
                        JointKind::Revolute => JointPosition::Revolute(random::pair(&mut points)),
                        JointKind::Prismatic => JointPosition::Prismatic(points.field()),
                    })
                    .collect();
                let outputs = |arm: &Arm<Field>| {
                    let at = arm.at(&position);
                    let form = Formulation::NewtonEulerLink;
                    let tau = form.inverse_dynamics(arm, &at, &case.qd, &case.qdd);
                    (
                        tau,
                        form.inertia(arm, &at),
                        form.christoffel(arm, &at),
                        form.gravity(arm, &at),
                    )
                };
                let truth = outputs(&case.arm);
                assert_eq!(
                    outputs(&folded),
                    truth,
                    "{convention:?} {bits:04b} {parallel}"
                );
                // What was kept has an effect.
                for i in 0..4 {
                    let mut changed = folded.clone();
                    if folded.links[i].d != Field::ZERO {
                        changed.links[i].d = points.field();
                        assert_ne!(
                            outputs(&changed),
                            truth,
                            "{convention:?} {bits:04b} {parallel} d{i}"
                        );
                    }
                }
            }
        }
    }
}

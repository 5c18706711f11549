//! What is special about two robots: which h_ikm vanish or coincide, found with
//! their exact parameters at a random point of the prime field.

use std::collections::BTreeSet;

use crate::equations_support::{golden, random};
use dalembert_model::equations::Formulation;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

/// Returns how many of all entries do not vanish, and how many of these differ by more than a
/// sign.
pub fn nonzero_and_distinct(entries: impl IntoIterator<Item = Field>) -> (usize, usize) {
    let nonzero: Vec<Field> = entries.into_iter().filter(|h| *h != Field::ZERO).collect();
    let sizes: BTreeSet<Field> = nonzero.iter().map(|h| *h.min(&h.neg())).collect();
    (nonzero.len(), sizes.len())
}

#[test]
fn zeros_and_coincidences_are_those_known() {
    let exact = Formulation::LagrangeEuler;
    // The decimal number that a float is written as.
    let decimal = |x: &f64| Field::from_rational(&parse_decimal(&format!("{x:e}")).unwrap());
    let lower = |rows: &[Vec<Field>]| {
        (0..6)
            .flat_map(|m| rows[m][..=m].to_vec())
            .collect::<Vec<_>>()
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

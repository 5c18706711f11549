//! What is special about two robots: which h_ikm vanish or coincide, found with
//! their exact parameters at a random point of the prime field.

use std::collections::BTreeSet;

use crate::equations_support::{golden, random};
use dalembert_model::equations::{Formulation, JointPosition};
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};
use num_bigint::BigInt;
use num_rational::BigRational;

/// Returns the decimal number that a float is written as.
fn decimal(x: f64) -> Field {
    let text = format!("{x:e}");
    let (digits, exponent) = text.split_once('e').unwrap();
    let exponent: i32 = exponent.parse().unwrap();
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let numer: BigInt = format!("{whole}{fraction}").parse().unwrap();
    let power = exponent - fraction.len() as i32;
    let scale = BigRational::from_integer(10.into()).pow(power);
    Field::from_rational(&(BigRational::from_integer(numer) * scale)).unwrap()
}

/// Returns Non-zero entries among all those given, and how many of them differ by more
/// than a sign.
fn nonzero_and_distinct(entries: &[Field]) -> (usize, usize) {
    let nonzero = entries.iter().filter(|h| **h != Field::ZERO);
    let sizes: BTreeSet<Field> = nonzero.clone().map(|h| *h.min(&h.neg())).collect();
    (nonzero.count(), sizes.len())
}

#[test]
fn zeros_and_coincidences_are_those_known() {
    for (robot, expected) in [("puma560", (84, 35)), ("stanford", (62, 34))] {
        let arm = golden::read(robot).0.map(|x| decimal(*x));
        let mut points = Points::new(40);
        let position: Vec<_> = arm
            .links
            .iter()
            .map(|link| match link.kind {
                JointKind::Revolute => JointPosition::Revolute(random::pair(&mut points)),
                JointKind::Prismatic => JointPosition::Prismatic(points.field()),
            })
            .collect();
        let at = arm.at(&position);
        let h = Formulation::LagrangeEuler.christoffel(&arm, &at);
        let halves = h
            .iter()
            .flat_map(|h| (0..6).flat_map(move |m| h[m][..=m].to_vec()));
        let halves: Vec<Field> = halves.collect();
        assert_eq!(halves.len(), 126);
        assert_eq!(nonzero_and_distinct(&halves), expected, "{robot}");
        if robot == "puma560" {
            let d = Formulation::LagrangeEuler.inertia(&arm, &at);
            let lower: Vec<_> = (0..6).flat_map(|i| d[i][..=i].to_vec()).collect();
            assert_eq!(nonzero_and_distinct(&lower).0, 19);
            let c = Formulation::LagrangeEuler.gravity(&arm, &at);
            assert_eq!(nonzero_and_distinct(&c).0, 4);
        }
    }
}
